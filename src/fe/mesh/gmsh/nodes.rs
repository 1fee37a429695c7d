//! `$Nodes`: tags unique, coordinates finite.
//!
//! Format: gmsh reference manual, sections "MSH file format" and "MSH file format version 2".

use super::MshError;
use super::cursor::Cursor;
use super::numbers::{Item, NodeIndex};
use crate::fe::mesh::{Entity, MshVersion};

/// Nodes in the order of the file.
pub(super) struct NodeTable {
    pub(super) tags: Vec<u64>,
    /// In metres.
    pub(super) coordinates: Vec<[f64; 3]>,
    pub(super) index: NodeIndex,
}

impl NodeTable {
    fn for_count(count: usize) -> Self {
        Self {
            tags: Vec::with_capacity(count),
            coordinates: Vec::with_capacity(count),
            index: NodeIndex::for_count(count),
        }
    }

    fn add_tag(&mut self, cursor: &mut Cursor<'_>, tag: u64) -> Result<(), MshError> {
        check_range(cursor, "a node tag", tag)?;
        let index = u32::try_from(self.tags.len()).ok();
        let index = index
            .filter(|&index| index < u32::MAX)
            .ok_or_else(|| cursor.feature("a mesh of more than 4294967295 nodes", "mesh more coarsely"))?;
        if !self.index.insert(tag, index) {
            return Err(cursor.fault(format_args!("node tag {tag} occurs a second time: expected every tag once")));
        }
        self.tags.push(tag);
        Ok(())
    }

    /// Reads the coordinates of the next node that has only a tag.
    #[inline]
    fn add_coordinates(&mut self, cursor: &mut Cursor<'_>, metres: f64) -> Result<(), MshError> {
        let mut node = [0.0; 3];
        for x in &mut node {
            let found = cursor.float("a coordinate of a node")?;
            if !found.is_finite() {
                let tag = self.tags[self.coordinates.len()];
                return Err(
                    cursor.fault(format_args!("node {tag} has the coordinate {found}: expected a finite number"))
                );
            }
            *x = found * metres;
        }
        self.coordinates.push(node);
        Ok(())
    }

    fn complete(self) -> Result<Self, MshError> {
        (!self.tags.is_empty()).then_some(self).ok_or_else(no_elements)
    }
}

/// A mesh without nodes or elements.
pub(super) fn no_elements() -> MshError {
    let question = "is a Physical group defined, is the geometry meshed?";
    MshError(format!("the mesh has no elements: expected at least one ({question})"))
}

/// Nodes of MSH 4; a file unit is so many metres. Parameters on curves and surfaces are passed over.
pub(super) fn read_blocks(cursor: &mut Cursor<'_>, version: MshVersion, metres: f64) -> Result<NodeTable, MshError> {
    let is_41 = version == MshVersion::V41;
    let item = if is_41 { Item::new(1, 0, 3) } else { Item::new(0, 1, 3) };
    let blocks = cursor.count("the number of blocks", Item::new(1, 3, 0))?;
    let announced = cursor.count("the number of nodes", item)?;
    if is_41 {
        tag_range(cursor, ["the smallest node tag", "the largest node tag"])?;
    }
    let mut nodes = NodeTable::for_count(announced);
    for _ in 0..blocks {
        let entity = entity(cursor, version)?;
        let flag = "the flag for parametric coordinates, 0 or 1";
        let parameters = match cursor.int(flag)? {
            0 => 0,
            1 => entity.dimension,
            found => return Err(cursor.malformed(flag, found.to_string().as_bytes())),
        };
        let count = cursor.count("the number of nodes of a block", item)?;
        if count > announced - nodes.tags.len() {
            return Err(not_as_announced(cursor, "nodes", announced, nodes.tags.len() + count));
        }
        // 4.1 lists all tags, then all coordinates
        if is_41 {
            for _ in 0..count {
                let tag = cursor.size("a node tag")?;
                nodes.add_tag(cursor, tag)?;
            }
        }
        for _ in 0..count {
            if !is_41 {
                let tag = cursor.unsigned_int("a node tag", "a node tag, greater than 0")?;
                nodes.add_tag(cursor, tag)?;
            }
            nodes.add_coordinates(cursor, metres)?;
            for _ in 0..parameters {
                cursor.float("a parameter of a node")?;
            }
        }
    }
    if nodes.tags.len() != announced {
        return Err(not_as_announced(cursor, "nodes", announced, nodes.tags.len()));
    }
    nodes.complete()
}

/// Nodes of MSH 2; a file unit is so many metres. `$ParametricNodes` has an entity and parameters behind each node's
/// coordinates; they are passed over.
pub(super) fn read_list(cursor: &mut Cursor<'_>, metres: f64) -> Result<NodeTable, MshError> {
    let parametric = cursor.section == "ParametricNodes";
    if parametric && cursor.is_binary() {
        let advice = "save it again with: gmsh IN.msh -save -format msh41 -setnumber Mesh.SaveParametric 0 -o OUT.msh";
        return Err(cursor.feature("binary parametric coordinates of MSH 2", advice));
    }
    let count = cursor.text_count("the number of nodes", Item::new(0, 1, 3))?;
    let mut nodes = NodeTable::for_count(count);
    for _ in 0..count {
        let tag = cursor.unsigned_int("a node tag", "a node tag, greater than 0")?;
        nodes.add_tag(cursor, tag)?;
        nodes.add_coordinates(cursor, metres)?;
        if parametric {
            cursor.take_line();
        }
    }
    nodes.complete()
}

/// A tag of a node or an element is greater than 0; results keep it in 64 bits with a sign.
#[inline]
pub(super) fn check_range(cursor: &Cursor<'_>, what: &str, tag: u64) -> Result<(), MshError> {
    let expected = match i64::try_from(tag) {
        Ok(1..) => return Ok(()),
        Ok(_) => format!("{what}, greater than 0"),
        Err(_) => format!("{what}, at most {}", i64::MAX),
    };
    Err(cursor.malformed(expected, tag.to_string().as_bytes()))
}

/// The smallest and the largest tag at the start of a section: read for their order alone.
pub(super) fn tag_range(cursor: &mut Cursor<'_>, [smallest, largest]: [&'static str; 2]) -> Result<(), MshError> {
    let [low, high] = [cursor.size(smallest)?, cursor.size(largest)?];
    if high < low {
        return Err(cursor.malformed(format!("{largest}, not below the smallest"), high.to_string().as_bytes()));
    }
    Ok(())
}

/// The entity of a block: dimension and tag, in MSH 4.0 the other way round.
pub(super) fn entity(cursor: &mut Cursor<'_>, version: MshVersion) -> Result<Entity, MshError> {
    const TAG: &str = "the tag of an entity";
    match version {
        MshVersion::V40 => {
            let tag = cursor.int(TAG)?;
            Ok(Entity { dimension: dimension(cursor)?, tag })
        }
        _ => Ok(Entity { dimension: dimension(cursor)?, tag: cursor.int(TAG)? }),
    }
}

/// Dimension of an entity.
pub(super) fn dimension(cursor: &mut Cursor<'_>) -> Result<usize, MshError> {
    let what = "the dimension of an entity, 0 to 3";
    let found = cursor.int(what)?;
    usize::try_from(found)
        .ok()
        .filter(|&dimension| dimension <= 3)
        .ok_or_else(|| cursor.malformed(what, found.to_string().as_bytes()))
}

/// Blocks list more or fewer items than the section announces.
pub(super) fn not_as_announced(cursor: &Cursor<'_>, what: &str, announced: usize, listed: usize) -> MshError {
    let expected = format!("{announced} {what} as announced at the start of the section");
    cursor.malformed(expected, listed.to_string().as_bytes())
}
