//! Faces of solids, edges of plane elements, ends of lines: the boundary of one element, and of a set of them.
//!
//! Source of the node order: gmsh reference manual, section "Node ordering".

use super::{ElementId, ElementKind, Mesh};
use rayon::prelude::*;
use serde::Serialize;

/// A face of an element kind: an element of one dimension less.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Face {
    /// Its kind: of the same order as the element.
    pub kind: ElementKind,
    /// Local node indices from 0, in gmsh's order for the kind of the face. The normal of a face of a
    /// solid, by the right-hand rule on its corners, leads out of the element; an edge of a plane
    /// element runs counter-clockwise round it.
    pub nodes: &'static [usize],
}

/// A face by its sorted corners; `u32::MAX` fills up. A mesh has fewer than 2^32 - 1 nodes, which the reader sees to.
type FaceCorners = [u32; 4];

/// Corners in ascending order; `u32::MAX` fills up.
pub(crate) fn sorted_corners<const N: usize>(corners: impl Iterator<Item = usize>) -> [u32; N] {
    let mut sorted = [u32::MAX; N];
    sorted.iter_mut().zip(corners).for_each(|(slot, corner)| *slot = corner as u32);
    sorted.sort_unstable();
    sorted
}

/// Faces of the complete element of second order of each shape: corners, middles of the edges, centre. A kind with fewer
/// nodes has the first ones of each, see [`faces_of`].
type Complete<const N: usize> = [&'static [usize]; N];

const LINE: Complete<2> = [&[0], &[1]];
const TRIANGLE: Complete<3> = [&[0, 1, 3], &[1, 2, 4], &[2, 0, 5]];
const QUADRILATERAL: Complete<4> = [&[0, 1, 4], &[1, 2, 5], &[2, 3, 6], &[3, 0, 7]];
const TETRAHEDRON: Complete<4> = [&[0, 2, 1, 6, 5, 4], &[0, 1, 3, 4, 9, 7], &[0, 3, 2, 7, 8, 6], &[1, 2, 3, 5, 8, 9]];
const HEXAHEDRON: Complete<6> = [
    &[0, 3, 2, 1, 9, 13, 11, 8, 20],
    &[0, 1, 5, 4, 8, 12, 16, 10, 21],
    &[0, 4, 7, 3, 10, 17, 15, 9, 22],
    &[1, 2, 6, 5, 11, 14, 18, 12, 23],
    &[2, 3, 7, 6, 13, 15, 19, 14, 24],
    &[4, 5, 6, 7, 16, 18, 19, 17, 25],
];
const WEDGE: Complete<5> = [
    &[0, 2, 1, 7, 9, 6],
    &[3, 4, 5, 12, 14, 13],
    &[0, 1, 4, 3, 6, 10, 12, 8, 15],
    &[0, 3, 5, 2, 8, 13, 11, 7, 16],
    &[1, 2, 5, 4, 9, 11, 14, 10, 17],
];
const PYRAMID: Complete<5> = [
    &[0, 3, 2, 1, 6, 10, 8, 5, 13],
    &[0, 1, 4, 5, 9, 7],
    &[1, 2, 4, 8, 11, 9],
    &[2, 3, 4, 10, 12, 11],
    &[3, 0, 4, 6, 7, 12],
];

/// The faces of a kind: of each complete face the nodes that the kind has, which come first.
const fn faces_of<const N: usize>(kind: ElementKind, complete: Complete<N>) -> [Face; N] {
    let mut faces = [Face { kind: ElementKind::Point, nodes: &[] }; N];
    let mut i = 0;
    while i < N {
        let mut count = 0;
        while count < complete[i].len() && complete[i][count] < kind.nodes() {
            count += 1;
        }
        let of_face = match (complete[i].len(), count) {
            (3, 2) => ElementKind::Line2,
            (3, _) => ElementKind::Line3,
            (6, 3) => ElementKind::Tri3,
            (6, _) => ElementKind::Tri6,
            (9, 4) => ElementKind::Quad4,
            (9, 8) => ElementKind::Quad8,
            (9, _) => ElementKind::Quad9,
            _ => ElementKind::Point,
        };
        faces[i] = Face { kind: of_face, nodes: complete[i].split_at(count).0 };
        i += 1;
    }
    faces
}

impl ElementKind {
    /// Faces of a solid, edges of a plane element, ends of a line, none of a point.
    pub fn faces(self) -> &'static [Face] {
        match self {
            Self::Point => &[],
            Self::Line2 => const { &faces_of(Self::Line2, LINE) },
            Self::Line3 => const { &faces_of(Self::Line3, LINE) },
            Self::Tri3 => const { &faces_of(Self::Tri3, TRIANGLE) },
            Self::Tri6 => const { &faces_of(Self::Tri6, TRIANGLE) },
            Self::Quad4 => const { &faces_of(Self::Quad4, QUADRILATERAL) },
            Self::Quad8 => const { &faces_of(Self::Quad8, QUADRILATERAL) },
            Self::Quad9 => const { &faces_of(Self::Quad9, QUADRILATERAL) },
            Self::Tet4 => const { &faces_of(Self::Tet4, TETRAHEDRON) },
            Self::Tet10 => const { &faces_of(Self::Tet10, TETRAHEDRON) },
            Self::Hex8 => const { &faces_of(Self::Hex8, HEXAHEDRON) },
            Self::Hex20 => const { &faces_of(Self::Hex20, HEXAHEDRON) },
            Self::Hex27 => const { &faces_of(Self::Hex27, HEXAHEDRON) },
            Self::Wedge6 => const { &faces_of(Self::Wedge6, WEDGE) },
            Self::Wedge15 => const { &faces_of(Self::Wedge15, WEDGE) },
            Self::Wedge18 => const { &faces_of(Self::Wedge18, WEDGE) },
            Self::Pyramid5 => const { &faces_of(Self::Pyramid5, PYRAMID) },
            Self::Pyramid13 => const { &faces_of(Self::Pyramid13, PYRAMID) },
            Self::Pyramid14 => const { &faces_of(Self::Pyramid14, PYRAMID) },
        }
    }

    /// Edges by their two corners, each once, in gmsh's order: of an element of second order edge i carries node
    /// `corners() + i`.
    pub(crate) const fn corner_edges(self) -> &'static [[usize; 2]] {
        match self {
            Self::Point => &[],
            Self::Line2 | Self::Line3 => &[[0, 1]],
            Self::Tri3 | Self::Tri6 => &[[0, 1], [1, 2], [2, 0]],
            Self::Quad4 | Self::Quad8 | Self::Quad9 => &[[0, 1], [1, 2], [2, 3], [3, 0]],
            Self::Tet4 | Self::Tet10 => &[[0, 1], [1, 2], [2, 0], [3, 0], [3, 2], [3, 1]],
            Self::Hex8 | Self::Hex20 | Self::Hex27 => {
                &[[0, 1], [0, 3], [0, 4], [1, 2], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 7], [5, 6], [6, 7]]
            }
            Self::Wedge6 | Self::Wedge15 | Self::Wedge18 => {
                &[[0, 1], [0, 2], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [3, 5], [4, 5]]
            }
            Self::Pyramid5 | Self::Pyramid13 | Self::Pyramid14 => {
                &[[0, 1], [0, 3], [0, 4], [1, 2], [1, 4], [2, 3], [2, 4], [3, 4]]
            }
        }
    }

    /// The edges with a middle node, as their two corners; edge i carries node `corners() + i`. Empty for the linear elements.
    pub(crate) const fn middle_edges(self) -> &'static [[usize; 2]] {
        if self.order() == 2 { self.corner_edges() } else { &[] }
    }

    /// The corners round each node in the centre of a face or of the element, in the order of these nodes, which are the
    /// last of the element. On a straight element a node is in the mean of them.
    pub(crate) const fn centres(self) -> &'static [&'static [usize]] {
        match self {
            Self::Quad9 => &[&[0, 1, 2, 3]],
            Self::Hex27 => &[
                &[0, 3, 2, 1],
                &[0, 1, 5, 4],
                &[0, 4, 7, 3],
                &[1, 2, 6, 5],
                &[2, 3, 7, 6],
                &[4, 5, 6, 7],
                &[0, 1, 2, 3, 4, 5, 6, 7],
            ],
            Self::Wedge18 => &[&[0, 1, 4, 3], &[0, 3, 5, 2], &[1, 2, 5, 4]],
            Self::Pyramid14 => &[&[0, 3, 2, 1]],
            _ => &[],
        }
    }

    /// The corners round each node behind the corners, in the order of these nodes: the two of an edge, those of a face, all.
    pub(crate) fn beyond_corners(self) -> impl Iterator<Item = &'static [usize]> {
        self.middle_edges().iter().map(<[usize; 2]>::as_slice).chain(self.centres().iter().copied())
    }
}

/// The faces of some elements, given by kind and nodes, sorted: corners, place of the element, number of the face in it.
/// A mesh has fewer than 2^32 - 1 elements, which the reader sees to.
pub(crate) fn sorted_faces<'a>(
    elements: impl IndexedParallelIterator<Item = (ElementKind, &'a [usize])>,
) -> Vec<(FaceCorners, u32, u8)> {
    let faces = elements.enumerate().flat_map_iter(|(place, (kind, nodes))| {
        (0..).zip(kind.faces()).map(move |(number, face)| {
            let corners = face.nodes[..face.kind.corners()].iter().map(|&local| nodes[local]);
            (sorted_corners(corners), place as u32, number)
        })
    });
    let mut faces: Vec<_> = faces.collect();
    faces.par_sort_unstable();
    faces
}

/// A face of one element and of no other, or a whole element.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct BoundaryFace {
    /// The element that it belongs to.
    pub element: ElementId,
    /// Kind of the face.
    pub kind: ElementKind,
    /// Indices of its nodes; the orientation is that of [`Face`].
    pub nodes: Vec<usize>,
}

impl Mesh {
    /// An element as a face of its own.
    pub(crate) fn whole_element(&self, element: ElementId) -> BoundaryFace {
        let block = &self.blocks[element.block];
        BoundaryFace { element, kind: block.kind, nodes: block.nodes_of(element.index).to_vec() }
    }

    /// The faces that exactly one of these elements has, in the order of the elements: the surface of solids
    /// with outward normals, the rim of plane elements.
    ///
    /// Faces are the same if their corners are. Elements of several dimensions do not mix: give those
    /// of a part. A mesh has fewer than 2^32 - 1 nodes, which the reader sees to.
    pub fn boundary_faces(&self, elements: impl Iterator<Item = ElementId>) -> Vec<BoundaryFace> {
        let elements: Vec<ElementId> = elements.collect();
        let faces = sorted_faces(elements.par_iter().map(|id| {
            let block = &self.blocks[id.block];
            (block.kind, block.nodes_of(id.index))
        }));
        let once = faces.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
        let mut once: Vec<(u32, u8)> = once.map(|same| (same[0].1, same[0].2)).collect();
        once.sort_unstable();
        let describe = |(position, number): (u32, u8)| {
            let element = elements[position as usize];
            let block = &self.blocks[element.block];
            let face = block.kind.faces()[usize::from(number)];
            let nodes = block.nodes_of(element.index);
            BoundaryFace { element, kind: face.kind, nodes: face.nodes.iter().map(|&local| nodes[local]).collect() }
        };
        once.into_iter().map(describe).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    /// Edges in gmsh's order, from which the middle nodes follow.
    fn edges(kind: ElementKind) -> &'static [[usize; 2]] {
        use ElementKind as K;
        match kind {
            K::Line3 => &[[0, 1]],
            K::Tri6 => &[[0, 1], [1, 2], [2, 0]],
            K::Quad8 | K::Quad9 => &[[0, 1], [1, 2], [2, 3], [3, 0]],
            K::Tet10 => &[[0, 1], [1, 2], [2, 0], [3, 0], [3, 2], [3, 1]],
            K::Hex20 | K::Hex27 => {
                &[[0, 1], [0, 3], [0, 4], [1, 2], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 7], [5, 6], [6, 7]]
            }
            K::Wedge15 | K::Wedge18 => &[[0, 1], [0, 2], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [3, 5], [4, 5]],
            K::Pyramid13 | K::Pyramid14 => &[[0, 1], [0, 3], [0, 4], [1, 2], [1, 4], [2, 3], [2, 4], [3, 4]],
            _ => &[],
        }
    }

    /// A middle node is on a face between the two corners that it is between in the element.
    #[test]
    fn middle_nodes_of_faces_are_those_of_the_element() {
        for kind in ElementKind::all() {
            assert_eq!(kind.corners() + edges(kind).len() + kind.centres().len(), kind.nodes(), "{kind:?}");
            for face in kind.faces() {
                assert_eq!(face.kind.dimension() + 1, kind.dimension());
                assert_eq!(face.nodes.len(), face.kind.nodes());
                let corners = face.kind.corners();
                for (&middle, [a, b]) in face.nodes[corners..].iter().zip(edges(face.kind)) {
                    let mut ends = [face.nodes[*a], face.nodes[*b]];
                    let mut expected = edges(kind)[middle - kind.corners()];
                    ends.sort_unstable();
                    expected.sort_unstable();
                    assert_eq!(ends, expected, "{kind:?}, face {:?}", face.nodes);
                }
                for centre in &face.nodes[corners + edges(face.kind).len()..] {
                    let of_element = kind.centres()[centre - kind.corners() - edges(kind).len()];
                    let [own, around] = [&face.nodes[..corners], of_element].map(|nodes| {
                        let mut sorted = nodes.to_vec();
                        sorted.sort_unstable();
                        sorted
                    });
                    assert_eq!(own, around, "{kind:?}, face {:?}", face.nodes);
                }
            }
        }
    }

    #[test]
    fn an_element_has_each_edge_once() {
        for kind in ElementKind::all().filter(|kind| kind.order() == 2) {
            let sorted = |mut ends: [usize; 2]| {
                ends.sort_unstable();
                ends
            };
            let found: Vec<_> = kind.corner_edges().iter().map(|&ends| sorted(ends)).collect();
            let expected: Vec<_> = edges(kind).iter().map(|&ends| sorted(ends)).collect();
            assert_eq!(found, expected, "{kind:?}");
        }
    }

    /// Every edge of a solid occurs in two faces, once in each direction.
    #[test]
    fn faces_of_a_solid_are_closed_and_agree_in_orientation() {
        for kind in ElementKind::all().filter(|kind| kind.dimension() == 3) {
            let mut seen = HashMap::new();
            for face in kind.faces() {
                for edge in face.kind.faces() {
                    let ends = [edge.nodes[0], edge.nodes[1]].map(|local| face.nodes[local]);
                    assert!(seen.insert(ends, ()).is_none());
                }
            }
            assert!(seen.keys().all(|[a, b]| seen.contains_key(&[*b, *a])), "{kind:?}");
        }
    }
}
