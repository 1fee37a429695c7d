//! Physical groups in numbers, and which elements are in several or in none.

use schemars::JsonSchema;
use serde::Serialize;

use super::{KindCount, counted};
use crate::fe::mesh::{ElementId, Mesh};

/// A physical group in numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct GroupSummary {
    /// Name, or the tag in digits.
    pub name: String,
    /// 0 points, 1 curves, 2 surfaces, 3 volumes.
    pub dimension: usize,
    /// gmsh's tag.
    pub tag: i32,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of elements.
    pub elements: usize,
    /// Its elements by kind, kinds that occur only.
    pub kinds: Vec<KindCount>,
}

/// Two groups of one dimension that share elements: which material would those have?
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct GroupOverlap {
    /// Dimension of both.
    pub dimension: usize,
    /// Their tags, smaller first.
    pub tags: [i32; 2],
    /// Their names.
    pub names: [String; 2],
    /// Elements that are in both, > 0.
    pub elements: usize,
}

pub(super) fn summaries(mesh: &Mesh) -> Vec<GroupSummary> {
    let groups = mesh.groups.iter();
    groups
        .map(|group| GroupSummary {
            name: group.name.clone(),
            dimension: group.dimension,
            tag: group.tag,
            nodes: group.nodes.len(),
            elements: group.elements.len(),
            kinds: counted(group.elements.iter().map(|id| (mesh.blocks[id.block].kind, 1))),
        })
        .collect()
}

pub(super) fn overlaps(mesh: &Mesh) -> Vec<GroupOverlap> {
    let mut found = Vec::new();
    for (position, group) in mesh.groups.iter().enumerate() {
        let others = mesh.groups[position + 1..].iter();
        for other in others.take_while(|other| other.dimension == group.dimension) {
            let elements = common(&group.elements, &other.elements);
            if elements > 0 {
                found.push(GroupOverlap {
                    dimension: group.dimension,
                    tags: [group.tag, other.tag],
                    names: [group.name.clone(), other.name.clone()],
                    elements,
                });
            }
        }
    }
    found
}

/// How many elements two sorted lists share.
fn common(a: &[ElementId], b: &[ElementId]) -> usize {
    let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
    let mut count = 0;
    while let (Some(first), Some(second)) = (a.peek(), b.peek()) {
        match first.cmp(second) {
            std::cmp::Ordering::Less => drop(a.next()),
            std::cmp::Ordering::Greater => drop(b.next()),
            std::cmp::Ordering::Equal => {
                count += 1;
                a.next();
                b.next();
            }
        }
    }
    count
}

/// Elements of a dimension that no group holds.
pub(super) fn ungrouped(mesh: &Mesh, dimension: usize) -> usize {
    let blocks = mesh.blocks.iter();
    let mut grouped: Vec<Vec<bool>> = blocks.map(|block| vec![false; block.len()]).collect();
    for id in mesh.groups.iter().flat_map(|group| &group.elements) {
        grouped[id.block][id.index] = true;
    }
    let own = mesh.blocks.iter().zip(&grouped);
    own.filter(|(block, _)| block.kind.dimension() == dimension)
        .map(|(_, grouped)| grouped.iter().filter(|grouped| !**grouped).count())
        .sum()
}
