//! Elements of one kind on one geometrical entity.

use serde::Serialize;

use super::{ElementKind, Mesh};

/// A geometrical entity of the CAD model behind the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct Entity {
    /// 0 point, 1 curve, 2 surface, 3 volume.
    pub dimension: usize,
    /// gmsh's tag, unique within its dimension.
    pub tag: i32,
}

/// Which element of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct ElementId {
    /// Index into the mesh's blocks.
    pub block: usize,
    /// Index into the block's elements.
    pub index: usize,
}

/// Elements of one kind on one entity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ElementBlock {
    /// Their kind.
    pub kind: ElementKind,
    /// gmsh's tag of each element, unique in the mesh, > 0.
    pub tags: Vec<u64>,
    /// Node indices from 0, `kind.nodes()` an element, gmsh's order.
    pub connectivity: Vec<usize>,
    /// The entity that they lie on.
    pub entity: Entity,
}

impl ElementBlock {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.tags.len()
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.tags.is_empty()
    }

    /// Node indices of each element in turn.
    pub fn elements(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        self.connectivity.chunks_exact(self.kind.nodes())
    }

    /// Node indices of one element, if there is one of this index.
    pub fn element(&self, index: usize) -> Option<&[usize]> {
        self.elements().nth(index)
    }

    /// Node indices of an element that is known to exist.
    pub(super) fn nodes_of(&self, index: usize) -> &[usize] {
        let nodes = self.kind.nodes();
        &self.connectivity[index * nodes..][..nodes]
    }
}

impl Mesh {
    /// The elements of one dimension (0 points to 3 volumes), in the order of the mesh.
    pub(crate) fn element_ids(&self, dimension: usize) -> impl Iterator<Item = ElementId> + '_ {
        let blocks = self.blocks.iter().enumerate();
        blocks
            .filter(move |(_, block)| block.kind.dimension() == dimension)
            .flat_map(|(block, list)| (0..list.len()).map(move |index| ElementId { block, index }))
    }
}
