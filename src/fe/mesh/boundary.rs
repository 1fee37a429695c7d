//! The boundary of a set of elements: the faces that only one of them has.

use serde::Serialize;

use super::{ElementId, ElementKind, Mesh};

/// A face of one element and of no other.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct BoundaryFace {
    /// The element that it belongs to.
    pub element: ElementId,
    /// Kind of the face.
    pub kind: ElementKind,
    /// Indices of its nodes; the orientation is that of [`Face`](super::Face).
    pub nodes: Vec<usize>,
}

/// A face by its sorted corners; `NO_CORNER` fills up.
type Corners = [u32; 4];

const NO_CORNER: u32 = u32::MAX;

impl Mesh {
    /// The faces that exactly one of these elements has, in the order of the elements: the surface of solids
    /// with outward normals, the rim of plane elements.
    ///
    /// Faces are the same if their corners are. Elements of several dimensions do not mix: give those
    /// of a part. A mesh has fewer than 2^32 - 1 nodes, which the reader sees to.
    pub fn boundary_faces(&self, elements: impl Iterator<Item = ElementId>) -> Vec<BoundaryFace> {
        let elements: Vec<ElementId> = elements.collect();
        let mut faces: Vec<(Corners, usize, u8)> = Vec::new();
        for (position, &id) in elements.iter().enumerate() {
            let block = &self.blocks[id.block];
            let nodes = block.nodes_of(id.index);
            for (number, face) in (0..).zip(block.kind.faces()) {
                let mut corners = [NO_CORNER; 4];
                let local = &face.nodes[..face.kind.corners()];
                for (corner, &local) in corners.iter_mut().zip(local) {
                    *corner = nodes[local] as u32;
                }
                corners.sort_unstable();
                faces.push((corners, position, number));
            }
        }
        faces.sort_unstable();
        let once = faces.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
        let mut once: Vec<(usize, u8)> = once.map(|same| (same[0].1, same[0].2)).collect();
        once.sort_unstable();
        let describe = |(position, number): (usize, u8)| {
            let element = elements[position];
            let block = &self.blocks[element.block];
            let face = block.kind.faces()[usize::from(number)];
            let nodes = block.nodes_of(element.index);
            BoundaryFace { element, kind: face.kind, nodes: face.nodes.iter().map(|&local| nodes[local]).collect() }
        };
        once.into_iter().map(describe).collect()
    }
}
