//! What a mesh contains, in numbers: elements by kind, physical groups, and which elements are in several or in none.

use super::parts;
use super::parts::{BoundingBox, DuplicateNodes, Part, UnusedNodes};
use crate::fe::mesh::{ElementId, ElementKind, Mesh, MeshNotes, MshFormat, PhysicalGroup};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// How many elements of a kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct KindCount {
    /// The kind.
    pub kind: ElementKind,
    /// Elements of it, > 0.
    pub count: usize,
}

/// Contents of a mesh.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Inventory {
    /// Version and encoding of the file.
    pub format: MshFormat,
    /// What of the file is not in the mesh.
    pub notes: MeshNotes,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of nodes that no element uses: `unused.count`.
    pub unused_nodes: usize,
    /// Nodes that no element uses.
    pub unused: UnusedNodes,
    /// Nodes in the same place.
    pub duplicates: DuplicateNodes,
    /// Extent of the nodes.
    pub bounding_box: BoundingBox,
    /// Highest dimension of an element: 2 for a plane mesh, 3 for solids.
    pub dimension: usize,
    /// Elements by kind, in the order of [`ElementKind`], kinds that occur only.
    pub elements: Vec<KindCount>,
    /// Physical groups in the order of the mesh.
    pub groups: Vec<GroupSummary>,
    /// Pairs of groups of one dimension that share elements, in the order of the mesh, a hundred at most.
    pub overlaps: Vec<GroupOverlap>,
    /// Elements of the highest dimension in no group: the mesh was saved with `Mesh.SaveAll`, and they would
    /// get no material.
    pub ungrouped_elements: usize,
    /// Connected parts of the elements of the highest dimension, largest first: more than one is a part that
    /// hangs in the air, unless something is meant to join them.
    pub parts: Vec<Part>,
}

impl Mesh {
    /// Counts and extent of this mesh, and what is often wrong with one.
    pub fn inventory(&self) -> Inventory {
        let bounding_box = BoundingBox::of(self.nodes.iter().copied());
        let dimension = self.dimension();
        let unused = parts::unused(self);
        Inventory {
            format: self.format,
            notes: self.notes.clone(),
            nodes: self.nodes.len(),
            unused_nodes: unused.count,
            unused,
            duplicates: parts::duplicates(self, &bounding_box),
            bounding_box,
            dimension,
            elements: counted(self.blocks.iter().map(|block| (block.kind, block.len()))),
            groups: self.groups.iter().map(|group| GroupSummary::new(self, group)).collect(),
            overlaps: overlaps(self),
            ungrouped_elements: ungrouped(self, dimension),
            parts: parts::parts(self, dimension),
        }
    }
}

/// Elements by kind, in the order of [`ElementKind`], kinds that occur only.
fn counted(blocks: impl Iterator<Item = (ElementKind, usize)>) -> Vec<KindCount> {
    let mut counts: Vec<KindCount> = ElementKind::all().map(|kind| KindCount { kind, count: 0 }).collect();
    for (kind, count) in blocks {
        // the table of kinds is in the order of the enum
        counts[kind as usize].count += count;
    }
    counts.retain(|entry| entry.count > 0);
    counts
}

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

impl GroupSummary {
    fn new(mesh: &Mesh, group: &PhysicalGroup) -> Self {
        Self {
            name: group.name.clone(),
            dimension: group.dimension,
            tag: group.tag,
            nodes: group.nodes.len(),
            elements: group.elements.len(),
            kinds: counted(group.elements.iter().map(|id| (mesh.blocks[id.block].kind, 1))),
        }
    }
}

/// Pairs of groups that are listed: sets of a file may all hold the same.
const LISTED_PAIRS: usize = 100;

fn overlaps(mesh: &Mesh) -> Vec<GroupOverlap> {
    let mut held: Vec<(ElementId, usize)> = Vec::new();
    for (position, group) in mesh.groups.iter().enumerate() {
        held.extend(group.elements.iter().map(|&id| (id, position)));
    }
    held.sort_unstable();
    held.dedup();
    let mut pairs: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for own in held.chunk_by(|(id, _), (next, _)| id == next) {
        for (place, &(_, a)) in own.iter().enumerate() {
            for &(_, b) in own[place + 1..].iter().take(LISTED_PAIRS) {
                if pairs.len() < LISTED_PAIRS || pairs.contains_key(&[a, b]) {
                    *pairs.entry([a, b]).or_default() += 1;
                }
            }
        }
    }
    let named = |([a, b], elements): ([usize; 2], usize)| {
        let [a, b] = [a, b].map(|place| &mesh.groups[place]);
        GroupOverlap { dimension: a.dimension, tags: [a.tag, b.tag], names: [a.name.clone(), b.name.clone()], elements }
    };
    pairs.into_iter().map(named).collect()
}

/// Elements of a dimension that no group holds.
fn ungrouped(mesh: &Mesh, dimension: usize) -> usize {
    let mut grouped = mesh.for_each_element(false);
    for id in mesh.groups.iter().flat_map(|group| &group.elements) {
        grouped[id.block][id.index] = true;
    }
    mesh.element_ids(dimension).filter(|id| !grouped[id.block][id.index]).count()
}
