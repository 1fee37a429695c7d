//! What a mesh contains, for reports and for a look before computing.
//!
//! Plain data: counts, groups, extent, and what is often wrong with a mesh (unused and duplicate nodes,
//! parts that hang in the air, elements in no group). Volume, mass and the shape of elements are
//! computed elsewhere, with shape functions.

mod extent;
mod groups;
mod nodes;
mod parts;
#[cfg(test)]
mod tests;

use schemars::JsonSchema;
use serde::Serialize;

use super::{ElementKind, Mesh, MshFormat};

pub use extent::BoundingBox;
pub use groups::{GroupOverlap, GroupSummary};
pub use nodes::{DuplicateNodes, UnusedNodes};
pub use parts::Part;
pub(crate) use parts::Sets;

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
    /// Pairs of groups of one dimension that share elements, in the order of the mesh.
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
        let dimension = self.blocks.iter().map(|block| block.kind.dimension());
        let dimension = dimension.max().unwrap_or(0);
        let unused = nodes::unused(self);
        Inventory {
            format: self.format,
            nodes: self.nodes.len(),
            unused_nodes: unused.count,
            unused,
            duplicates: nodes::duplicates(self, &bounding_box),
            bounding_box,
            dimension,
            elements: counted(self.blocks.iter().map(|block| (block.kind, block.len()))),
            groups: groups::summaries(self),
            overlaps: groups::overlaps(self),
            ungrouped_elements: groups::ungrouped(self, dimension),
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
