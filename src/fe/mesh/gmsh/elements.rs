//! `$Elements`: known kinds, tags unique, nodes that exist and differ.
//!
//! Format: gmsh reference manual, section "MSH file format".
//!
//! `$Elements` of MSH 2.2: a list of single elements, each with its kind, its group and its entity.
//!
//! Format: gmsh reference manual, section "MSH file format version 2".

use super::MshError;
use super::cursor::Cursor;
use super::entities::one_partition;
use super::nodes::{check_range, entity, no_elements, not_as_announced, tag_range};
use super::numbers::{Item, NodeIndex, TagSet};
use crate::fe::mesh::{ElementBlock, ElementKind, Entity, LeftOut, MshVersion};
use std::collections::BTreeSet;

/// Elements of MSH 4.
pub(super) fn read_blocks(
    cursor: &mut Cursor<'_>,
    version: MshVersion,
    nodes: &NodeIndex,
) -> Result<(Vec<ElementBlock>, Degenerate), MshError> {
    let is_41 = version == MshVersion::V41;
    let item = |numbers: usize| if is_41 { Item::new(numbers, 0, 0) } else { Item::new(0, numbers, 0) };
    let number = |cursor: &mut Cursor<'_>, what| match is_41 {
        true => cursor.size(what),
        false => cursor.unsigned_int(what, what),
    };
    let block_count = cursor.count("the number of blocks", Item::new(1, 3, 0))?;
    let announced = cursor.count("the number of elements", item(2))?;
    if is_41 {
        tag_range(cursor, ["the smallest element tag", "the largest element tag"])?;
    }
    let mut tags = TagSet::for_count(announced);
    let mut blocks = Vec::with_capacity(block_count);
    let mut degenerate = Degenerate::default();
    let mut listed = 0;
    for _ in 0..block_count {
        let entity = entity(cursor, version)?;
        let kind = kind(cursor, Some(entity))?;
        if kind.dimension() != entity.dimension {
            let expected = format!("elements of dimension {} like their entity", entity.dimension);
            return Err(cursor.malformed(expected, kind.name().as_bytes()));
        }
        let count = cursor.count("the number of elements of a block", item(1 + kind.nodes()))?;
        let mut block = ElementBlock {
            kind,
            tags: Vec::with_capacity(count),
            connectivity: Vec::with_capacity(count * kind.nodes()),
            entity,
        };
        for _ in 0..count {
            let tag = number(cursor, "an element tag")?;
            check_tag(cursor, &mut tags, tag)?;
            let first = block.connectivity.len();
            let mut repeated = false;
            for _ in 0..kind.nodes() {
                let node = number(cursor, "the tag of a node of an element")?;
                let index = node_index(cursor, nodes, [tag, node])?;
                if block.connectivity[first..].contains(&index) {
                    repeated = true;
                    degenerate.say(cursor, kind, [tag, node]);
                }
                block.connectivity.push(index);
            }
            if repeated {
                block.connectivity.truncate(first);
                degenerate.list.push(LeftOut { tag, dimension: kind.dimension(), entity: entity.tag, physical: 0 });
            } else {
                block.tags.push(tag);
            }
        }
        listed += count;
        blocks.push(block);
    }
    if listed != announced {
        return Err(not_as_announced(cursor, "elements", announced, listed));
    }
    (listed > 0).then_some((blocks, degenerate)).ok_or_else(no_elements)
}

/// A tag greater than 0 that has not occurred.
#[inline]
pub(super) fn check_tag(cursor: &Cursor<'_>, seen: &mut TagSet, tag: u64) -> Result<(), MshError> {
    check_range(cursor, "an element tag", tag)?;
    if !seen.insert(tag) {
        return Err(cursor.fault(format_args!("element tag {tag} occurs a second time: expected every tag once")));
    }
    Ok(())
}

/// Elements that have a node twice. Those of the body make no mesh; those below it are left out.
#[derive(Default)]
pub(super) struct Degenerate {
    list: Vec<LeftOut>,
    /// What is wrong with the first of each dimension.
    faults: [Option<MshError>; 4],
}

impl Degenerate {
    fn say(&mut self, cursor: &Cursor<'_>, kind: ElementKind, [element, node]: [u64; 2]) {
        self.faults[kind.dimension()].get_or_insert_with(|| {
            cursor.fault(format_args!("element {element} has the node {node} twice: expected different nodes"))
        });
    }

    /// The elements below the dimension of a body of these blocks.
    pub(super) fn beside(mut self, blocks: &[ElementBlock]) -> Result<Vec<LeftOut>, MshError> {
        let of_blocks = blocks.iter().map(|block| block.kind.dimension());
        let dimension = of_blocks.chain(self.list.iter().map(|left| left.dimension)).max().unwrap_or(0);
        self.faults[dimension].take().map_or(Ok(self.list), Err)
    }
}

/// Index of a node of an element.
#[inline]
fn node_index(cursor: &Cursor<'_>, nodes: &NodeIndex, [element, node]: [u64; 2]) -> Result<usize, MshError> {
    let unknown =
        || cursor.fault(format_args!("element {element} refers to node {node}: expected a tag listed in $Nodes"));
    nodes.get(node).ok_or_else(unknown)
}

/// The kind of the element type at the cursor; MSH 2.2 gives the type before the entity.
pub(super) fn kind(cursor: &mut Cursor<'_>, entity: Option<Entity>) -> Result<ElementKind, MshError> {
    let gmsh_type = cursor.int("an element type")?;
    if let Some(kind) = ElementKind::from_gmsh_type(gmsh_type) {
        return Ok(kind);
    }
    let (name, advice) = unsupported(gmsh_type);
    let on_entity =
        entity.map_or(String::new(), |Entity { dimension, tag }| format!(" on entity {tag} of dimension {dimension}"));
    let known: Vec<&str> = ElementKind::all().map(ElementKind::name).collect();
    let known = known.join(", ");
    Err(cursor.fault(format_args!("element type {gmsh_type} ({name}){on_entity}: expected one of {known}; {advice}")))
}

/// Highest element type number in gmsh 4.15 (`GmshDefines.h`).
const LAST_GMSH_TYPE: i32 = 140;

/// Name of a gmsh element type that the program does not read, and what to do about it.
fn unsupported(gmsh_type: i32) -> (&'static str, &'static str) {
    match gmsh_type {
        21 => ("Tri10", OTHER_ORDER),
        26 => ("Line4", OTHER_ORDER),
        29 => ("Tet20", OTHER_ORDER),
        36 => ("Quad16", OTHER_ORDER),
        92 => ("Hex64", OTHER_ORDER),
        1..=LAST_GMSH_TYPE => ("of higher order or special purpose", OTHER_ORDER),
        _ => ("unknown to gmsh", "is the file damaged?"),
    }
}

/// What to do about elements of third order and beyond.
const OTHER_ORDER: &str = "make it one of second order with: gmsh IN.msh -3 -order 2 -o OUT.msh (-2 for a plane mesh)";

/// Elements in the order of the file.
#[derive(Default)]
pub(super) struct Listed {
    pub(super) tags: Vec<u64>,
    /// Node indices of one element after the other.
    pub(super) connectivity: Vec<u32>,
    /// What they are, in the same order.
    pub(super) pieces: Vec<Piece>,
    /// Partitions that they belong to, as far as the file tells.
    pub(super) partitions: BTreeSet<i32>,
    pub(super) degenerate: Degenerate,
}

/// Where an element belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Label {
    pub(super) kind: ElementKind,
    /// Tag of the entity, 0 if there is none.
    pub(super) entity: i32,
    /// Tag of the physical group, 0 for none.
    pub(super) physical: i32,
}

/// Elements that follow one another and agree in kind, entity and group, with their place in the lists.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) label: Label,
    pub(super) first: usize,
    pub(super) first_node: usize,
    pub(super) count: usize,
}

impl Piece {
    pub(super) fn nodes(self, listed: &Listed) -> &[u32] {
        let end = self.first_node + self.count * self.label.kind.nodes();
        &listed.connectivity[self.first_node..end]
    }

    pub(super) fn order(&self) -> (usize, i32, i32, usize) {
        let Label { kind, entity, .. } = self.label;
        (kind.dimension(), entity, kind.gmsh_type(), self.first)
    }
}

struct Reader<'a, 'b> {
    cursor: &'a mut Cursor<'b>,
    nodes: &'a NodeIndex,
    seen: TagSet,
    listed: Listed,
}

pub(super) fn read(cursor: &mut Cursor<'_>, nodes: &NodeIndex) -> Result<Listed, MshError> {
    // number, type, number of tags and a node in ASCII, number and a node in binary: 8 bytes
    let smallest = if cursor.is_binary() { 2 } else { 4 };
    let count = cursor.text_count("the number of elements", Item::new(0, smallest, 0))?;
    if u32::try_from(count).is_err() {
        return Err(cursor.feature("a mesh of more than 4294967295 elements", "mesh more coarsely"));
    }
    let mut reader = Reader {
        seen: TagSet::for_count(count),
        listed: Listed { tags: Vec::with_capacity(count), ..Listed::default() },
        cursor,
        nodes,
    };
    match reader.cursor.is_binary() {
        true => reader.binary(count)?,
        false => reader.ascii(count)?,
    }
    let (listed, cursor) = (reader.listed, reader.cursor);
    let last = listed.partitions.last().copied().unwrap_or(0);
    if (1..last).any(|partition| !listed.partitions.contains(&partition)) {
        return Err(one_partition(cursor, &listed.partitions, format_args!("{last} or more")));
    }
    (count > 0).then_some(listed).ok_or_else(no_elements)
}

impl Reader<'_, '_> {
    fn ascii(&mut self, count: usize) -> Result<(), MshError> {
        for _ in 0..count {
            let tag = self.tag()?;
            let kind = kind(self.cursor, None)?;
            let tag_count = self.tag_count()?;
            self.rest_of_element(tag, kind, tag_count)?;
        }
        Ok(())
    }

    /// Blocks of elements of one kind; gmsh itself writes a header for every element.
    fn binary(&mut self, count: usize) -> Result<(), MshError> {
        let mut read = 0;
        while read < count {
            let kind = kind(self.cursor, None)?;
            let what = "the number of elements that follow";
            let found = self.cursor.int(what)?;
            let left = count - read;
            let following = usize::try_from(found).ok();
            let following = following.filter(|&following| (1..=left).contains(&following)).ok_or_else(|| {
                let expected = format!("{what}, 1 to {left}");
                self.cursor.malformed(expected, found.to_string().as_bytes())
            })?;
            let tag_count = self.tag_count()?;
            for _ in 0..following {
                let tag = self.tag()?;
                self.rest_of_element(tag, kind, tag_count)?;
            }
            read += following;
        }
        Ok(())
    }

    fn tag(&mut self) -> Result<u64, MshError> {
        let tag = self.cursor.unsigned_int("an element tag", "an element tag, greater than 0")?;
        check_tag(self.cursor, &mut self.seen, tag)?;
        Ok(tag)
    }

    fn tag_count(&mut self) -> Result<usize, MshError> {
        let what = "the number of tags of an element";
        let count = self.cursor.unsigned_int(what, what)?;
        let number_bytes = if self.cursor.is_binary() { 4 } else { 2 };
        self.cursor.check_count(what, count, number_bytes)
    }

    /// Tags (group, entity, number of partitions, the element's own partition) and nodes.
    fn rest_of_element(&mut self, tag: u64, kind: ElementKind, tag_count: usize) -> Result<(), MshError> {
        let mut tags = [0; 4];
        for position in 0..tag_count {
            let found = self.cursor.int("a tag of an element")?;
            if let Some(slot) = tags.get_mut(position) {
                *slot = found;
            }
        }
        let [physical, entity, count, partition] = tags;
        // MSH 2.0 and 2.1 have the partition alone
        if tag_count > 3 && count > 0 {
            self.listed.partitions.insert(partition);
        }
        let label = Label { kind, entity, physical: physical.saturating_abs() };
        let Listed { tags, connectivity, pieces, degenerate, .. } = &mut self.listed;
        let first_node = connectivity.len();
        let mut repeated = false;
        for _ in 0..kind.nodes() {
            let what = "the tag of a node of an element";
            let node = self.cursor.unsigned_int(what, what)?;
            // a node has an index below u32::MAX
            let index = node_index(self.cursor, self.nodes, [tag, node])? as u32;
            if connectivity[first_node..].contains(&index) {
                repeated = true;
                degenerate.say(self.cursor, kind, [tag, node]);
            }
            connectivity.push(index);
        }
        if repeated {
            connectivity.truncate(first_node);
            let Label { entity, physical, .. } = label;
            degenerate.list.push(LeftOut { tag, dimension: kind.dimension(), entity, physical });
            return Ok(());
        }
        match pieces.last_mut() {
            Some(piece) if piece.label == label => piece.count += 1,
            _ => pieces.push(Piece { label, first: tags.len(), first_node, count: 1 }),
        }
        tags.push(tag);
        Ok(())
    }
}
