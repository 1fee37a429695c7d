//! The outside of a body, and which of its elements is behind a face.

use super::cylinder::Facet;
use super::{BoundaryFace, ElementId, Mesh};
use std::collections::HashMap;

/// The boundary of the housing's elements by their corners.
pub(crate) struct Rim {
    faces: Vec<BoundaryFace>,
    by_corners: HashMap<Vec<usize>, usize>,
}

fn key(nodes: &[usize], corners: usize) -> Vec<usize> {
    let mut key: Vec<usize> = nodes.iter().copied().take(corners).collect();
    key.sort_unstable();
    key
}

impl Rim {
    /// The rim of the elements of the highest dimension.
    pub(crate) fn of(mesh: &Mesh, dimension: usize) -> Self {
        let faces = mesh.boundary_faces(mesh.element_ids(dimension));
        let keys = faces.iter().enumerate().map(|(place, face)| (key(&face.nodes, face.kind.corners()), place));
        let by_corners = keys.collect();
        Self { faces, by_corners }
    }

    /// Each face of the rim with its element's middle.
    pub(crate) fn facets<'a>(&'a self, mesh: &'a Mesh) -> impl Iterator<Item = Facet> + 'a {
        self.faces.iter().map(move |face| {
            let nodes = face.nodes.iter().map(|&node| mesh.nodes[node]).collect();
            Facet { kind: face.kind, nodes, inside: Some(middle(mesh, face)) }
        })
    }

    /// Elements one dimension below the body, each with the middle of the element behind it.
    pub(crate) fn facets_of(&self, mesh: &Mesh, elements: &[ElementId]) -> Vec<Facet> {
        let faces = elements.iter().map(|id| {
            let block = &mesh.blocks[id.block];
            let (nodes, corners) = (block.nodes_of(id.index), block.kind.corners());
            let face = self.by_corners.get(&key(nodes, corners));
            Facet {
                kind: block.kind,
                nodes: nodes.iter().map(|&node| mesh.nodes[node]).collect(),
                inside: face.map(|&place| middle(mesh, &self.faces[place])),
            }
        });
        faces.collect()
    }
}

/// Mean of the corners of the element that a face belongs to.
fn middle(mesh: &Mesh, face: &BoundaryFace) -> [f64; 3] {
    let block = &mesh.blocks[face.element.block];
    let nodes = block.element(face.element.index).unwrap_or_default();
    let corners = block.kind.corners().min(nodes.len()).max(1);
    let mut sum = [0.0; 3];
    for &node in nodes.iter().take(corners) {
        for (sum, part) in sum.iter_mut().zip(mesh.nodes[node]) {
            *sum += part / corners as f64;
        }
    }
    sum
}
