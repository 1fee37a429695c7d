//! A walk through `$Entities`, `$Nodes` and `$Elements` that checks every number where it stands.
//!
//! Format: gmsh reference manual, section "MSH file format version 4.1".

use std::collections::{HashMap, HashSet};

use super::MshError;
use super::cursor::Cursor;
use crate::mesh::ElementKind;
use crate::mesh::kind::unsupported;

/// What the walk through `$Nodes` keeps.
pub(super) struct NodeWalk {
    /// Tags in the order of the file.
    pub(super) tags: Vec<u64>,
    /// Index of each tag in that order.
    pub(super) index: HashMap<u64, usize>,
}

/// What the walk through `$Elements` keeps: nothing, its checks are the point.
pub(super) struct ElementWalk;

/// `$Entities`: points, curves, surfaces and volumes with their physical tags and boundaries.
pub(super) fn entities(cursor: &mut Cursor<'_>) -> Result<(), MshError> {
    const KINDS: [&str; 4] = ["points", "curves", "surfaces", "volumes"];
    let mut counts = [0; 4];
    for (count, kind) in counts.iter_mut().zip(KINDS) {
        *count = cursor.count(&format!("the number of {kind}"), 5)?;
    }
    for (dimension, count) in counts.into_iter().enumerate() {
        let coordinates = if dimension == 0 { 3 } else { 6 };
        for _ in 0..count {
            cursor.int("the tag of an entity")?;
            for _ in 0..coordinates {
                cursor.float("a coordinate of an entity")?;
            }
            for _ in 0..cursor.count("the number of physical tags", 1)? {
                cursor.int("a physical tag")?;
            }
            if dimension > 0 {
                for _ in 0..cursor.count("the number of bounding entities", 1)? {
                    cursor.int("the tag of a bounding entity")?;
                }
            }
        }
    }
    Ok(())
}

/// The four numbers at the start of `$Nodes` and `$Elements`.
struct Header {
    blocks: usize,
    items: u64,
}

fn header(cursor: &mut Cursor<'_>, what: &str, numbers: usize) -> Result<Header, MshError> {
    let blocks = cursor.count("the number of blocks", 4)?;
    let items = cursor.count(&format!("the number of {what}s"), numbers)?;
    cursor.size(&format!("the smallest {what} tag"))?;
    cursor.size(&format!("the largest {what} tag"))?;
    Ok(Header {
        blocks,
        items: items as u64,
    })
}

/// The items listed are as many as announced.
fn check_total(
    cursor: &Cursor<'_>,
    what: &str,
    announced: u64,
    listed: usize,
) -> Result<(), MshError> {
    if announced == listed as u64 {
        Ok(())
    } else {
        let expected = format!("{announced} {what}s as announced at the start of the section");
        Err(cursor.malformed(expected, listed.to_string().as_bytes()))
    }
}

fn positive_tag(cursor: &mut Cursor<'_>, what: &str) -> Result<u64, MshError> {
    match cursor.size(what)? {
        0 => Err(cursor.malformed(format!("{what}, greater than 0"), b"0")),
        tag => Ok(tag),
    }
}

fn dimension(cursor: &mut Cursor<'_>) -> Result<usize, MshError> {
    let what = "the dimension of an entity, 0 to 3";
    let found = cursor.int(what)?;
    usize::try_from(found)
        .ok()
        .filter(|&dimension| dimension <= 3)
        .ok_or_else(|| cursor.malformed(what, found.to_string().as_bytes()))
}

/// `$Nodes`: tags unique, coordinates finite.
pub(super) fn nodes(cursor: &mut Cursor<'_>) -> Result<NodeWalk, MshError> {
    let header = header(cursor, "node", 4)?;
    let mut walk = NodeWalk {
        tags: Vec::new(),
        index: HashMap::new(),
    };
    for _ in 0..header.blocks {
        dimension(cursor)?;
        cursor.int("the tag of an entity")?;
        let what = "the flag for parametric coordinates, 0 or 1";
        match cursor.int(what)? {
            0 => {}
            1 => {
                return Err(MshError::Feature {
                    section: cursor.section.clone(),
                    place: cursor.place(),
                    feature: "parametric coordinates",
                    advice: "set Mesh.SaveParametric = 0 in gmsh and save again",
                });
            }
            found => return Err(cursor.malformed(what, found.to_string().as_bytes())),
        }
        let first = walk.tags.len();
        for _ in 0..cursor.count("the number of nodes of a block", 4)? {
            let tag = positive_tag(cursor, "a node tag")?;
            if walk.index.insert(tag, walk.tags.len()).is_some() {
                let place = cursor.place();
                return Err(MshError::DuplicateNode { place, tag });
            }
            walk.tags.push(tag);
        }
        for &tag in &walk.tags[first..] {
            for _ in 0..3 {
                let found = cursor.float("a coordinate of a node")?;
                if !found.is_finite() {
                    let place = cursor.place();
                    return Err(MshError::NotFinite { place, tag, found });
                }
            }
        }
    }
    check_total(cursor, "node", header.items, walk.tags.len())?;
    if walk.tags.is_empty() {
        return Err(MshError::NoElements);
    }
    Ok(walk)
}

/// `$Elements`: known kinds, tags unique, nodes that exist and differ.
pub(super) fn elements(
    cursor: &mut Cursor<'_>,
    known_nodes: &HashMap<u64, usize>,
) -> Result<ElementWalk, MshError> {
    let header = header(cursor, "element", 2)?;
    let mut tags = HashSet::new();
    for _ in 0..header.blocks {
        let dimension = dimension(cursor)?;
        let entity_tag = cursor.int("the tag of an entity")?;
        let kind = element_kind(cursor, dimension, entity_tag)?;
        let what = "the number of elements of a block";
        for _ in 0..cursor.count(what, 1 + kind.nodes())? {
            let element = positive_tag(cursor, "an element tag")?;
            if !tags.insert(element) {
                let (place, tag) = (cursor.place(), element);
                return Err(MshError::DuplicateElement { place, tag });
            }
            check_nodes(cursor, kind, element, known_nodes)?;
        }
    }
    check_total(cursor, "element", header.items, tags.len())?;
    if tags.is_empty() {
        return Err(MshError::NoElements);
    }
    Ok(ElementWalk)
}

/// The element type, of the dimension of the entity that it lies on.
fn element_kind(
    cursor: &mut Cursor<'_>,
    dimension: usize,
    entity_tag: i32,
) -> Result<ElementKind, MshError> {
    let gmsh_type = cursor.int("an element type")?;
    let kind = ElementKind::from_gmsh_type(gmsh_type).ok_or_else(|| {
        let names: Vec<&str> = ElementKind::all().map(ElementKind::name).collect();
        let found = unsupported(gmsh_type);
        MshError::UnsupportedElement {
            place: cursor.place(),
            gmsh_type,
            name: found.name,
            dimension,
            entity_tag,
            known: names.join(", "),
            advice: found.advice,
        }
    })?;
    if kind.dimension() == dimension {
        Ok(kind)
    } else {
        let expected = format!("elements of dimension {dimension} like their entity");
        Err(cursor.malformed(expected, kind.name().as_bytes()))
    }
}

fn check_nodes(
    cursor: &mut Cursor<'_>,
    kind: ElementKind,
    element: u64,
    known_nodes: &HashMap<u64, usize>,
) -> Result<(), MshError> {
    let mut seen: Vec<u64> = Vec::with_capacity(kind.nodes());
    for _ in 0..kind.nodes() {
        let node = cursor.size("the tag of a node of an element")?;
        let place = cursor.place();
        if !known_nodes.contains_key(&node) {
            return Err(MshError::DanglingNode {
                place,
                element,
                node,
            });
        }
        if seen.contains(&node) {
            return Err(MshError::RepeatedNode {
                place,
                element,
                node,
            });
        }
        seen.push(node);
    }
    Ok(())
}
