//! `$Elements`: known kinds, tags unique, nodes that exist and differ.
//!
//! Format: gmsh reference manual, section "MSH file format".

use super::MshError;
use super::cursor::Cursor;
use super::nodes::{check_range, dimension, no_elements, not_as_announced, tag_range};
use super::numbers::Item;
use super::tags::{NodeIndex, TagSet};
use crate::fe::mesh::{ElementBlock, ElementKind, Entity};

/// Elements of MSH 4.1.
pub(super) fn read_v41(cursor: &mut Cursor<'_>, nodes: &NodeIndex) -> Result<Vec<ElementBlock>, MshError> {
    let block_count = cursor.count("the number of blocks", Item::new(3, 3, 0))?;
    let announced = cursor.count("the number of elements", Item::new(2, 0, 0))?;
    tag_range(cursor, ["the smallest element tag", "the largest element tag"])?;
    let mut tags = TagSet::for_count(announced);
    let mut blocks = Vec::with_capacity(block_count);
    let mut listed = 0;
    for _ in 0..block_count {
        let dimension = dimension(cursor)?;
        let entity = Entity { dimension, tag: cursor.int("the tag of an entity")? };
        let kind = kind(cursor, Some(entity))?;
        if kind.dimension() != dimension {
            let expected = format!("elements of dimension {dimension} like their entity");
            return Err(cursor.malformed(expected, kind.name().as_bytes()));
        }
        let item = Item::new(1 + kind.nodes(), 0, 0);
        let count = cursor.count("the number of elements of a block", item)?;
        let mut block = ElementBlock {
            kind,
            tags: Vec::with_capacity(count),
            connectivity: Vec::with_capacity(count * kind.nodes()),
            entity,
        };
        for _ in 0..count {
            let tag = cursor.size("an element tag")?;
            check_tag(cursor, &mut tags, tag)?;
            block.tags.push(tag);
            for read in 0..kind.nodes() {
                let node = cursor.size("the tag of a node of an element")?;
                let earlier = &block.connectivity[block.connectivity.len() - read..];
                let index = node_index(cursor, nodes, [tag, node], |index| earlier.contains(&index))?;
                block.connectivity.push(index);
            }
        }
        listed += count;
        blocks.push(block);
    }
    if listed != announced {
        return Err(not_as_announced(cursor, "elements", announced, listed));
    }
    (listed > 0).then_some(blocks).ok_or_else(no_elements)
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

/// Index of a node of an element, which is not among those that the element has already.
#[inline]
pub(super) fn node_index(
    cursor: &Cursor<'_>,
    nodes: &NodeIndex,
    [element, node]: [u64; 2],
    is_repeated: impl FnOnce(usize) -> bool,
) -> Result<usize, MshError> {
    match nodes.get(node) {
        Some(index) if is_repeated(index) => {
            Err(cursor.fault(format_args!("element {element} has the node {node} twice: expected different nodes")))
        }
        Some(index) => Ok(index),
        None => {
            Err(cursor.fault(format_args!("element {element} refers to node {node}: expected a tag listed in $Nodes")))
        }
    }
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
    let complete = "set Mesh.SecondOrderIncomplete = 1 in gmsh and mesh again";
    let pyramid = "pyramids join hexahedra to tetrahedra: mesh volumes that touch with one of the two (without \
                   Recombine for tetrahedra, with Mesh.SubdivisionAlgorithm = 2 as well for hexahedra)";
    let order = "set Mesh.ElementOrder = 1 or 2 in gmsh and mesh again";
    match gmsh_type {
        7 => ("Pyramid5", pyramid),
        10 => ("Quad9", complete),
        12 => ("Hex27", complete),
        13 => ("Wedge18", complete),
        14 => ("Pyramid14", pyramid),
        19 => ("Pyramid13", pyramid),
        1..=LAST_GMSH_TYPE => ("of higher order or special purpose", order),
        _ => ("unknown to gmsh", "is the file damaged?"),
    }
}
