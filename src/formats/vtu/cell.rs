//! VTK's cell types and its node order.
//!
//! Source: VTK file formats, "The VTK user's guide" appendix, and the class pages of `vtkQuadraticTetra`,
//! `vtkQuadraticHexahedron`, `vtkQuadraticWedge`: corners first, then the middle nodes edge by edge. The corners and the
//! edges of triangles and quadrilaterals are numbered as by gmsh. Middle nodes of solids lie on the edges
//! - tetrahedron: (0,1) (1,2) (2,0) (0,3) (1,3) (2,3), the last two swapped against gmsh,
//! - hexahedron: (0,1) (1,2) (2,3) (3,0), (4,5) (5,6) (6,7) (7,4), (0,4) (1,5) (2,6) (3,7),
//! - wedge: (0,1) (1,2) (2,0), (3,4) (4,5) (5,3), (0,3) (1,4) (2,5).

use crate::fe::mesh::ElementKind;

const SAME: [usize; 20] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19];
const TET10: [usize; 10] = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8];
const HEX20: [usize; 20] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15];
const WEDGE15: [usize; 15] = [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11];

/// VTK's number of a cell type (`vtkCellType.h`).
pub(super) fn cell_type(kind: ElementKind) -> u8 {
    match kind {
        ElementKind::Point => 1,
        ElementKind::Line2 => 3,
        ElementKind::Line3 => 21,
        ElementKind::Tri3 => 5,
        ElementKind::Tri6 => 22,
        ElementKind::Quad4 => 9,
        ElementKind::Quad8 => 23,
        ElementKind::Tet4 => 10,
        ElementKind::Tet10 => 24,
        ElementKind::Hex8 => 12,
        ElementKind::Hex20 => 25,
        ElementKind::Wedge6 => 13,
        ElementKind::Wedge15 => 26,
    }
}

/// For each place in VTK's order, the place in gmsh's.
pub(super) fn node_order(kind: ElementKind) -> &'static [usize] {
    match kind {
        ElementKind::Tet10 => &TET10,
        ElementKind::Hex20 => &HEX20,
        ElementKind::Wedge15 => &WEDGE15,
        other => &SAME[..other.nodes()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];
    const QUADRILATERAL: [[usize; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];
    const TETRAHEDRON: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
    const HEXAHEDRON: [[usize; 2]; 12] =
        [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
    const WEDGE: [[usize; 2]; 9] = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];

    #[allow(clippy::float_cmp)] // halves of small integers are exact
    #[test]
    fn middle_nodes_lie_between_the_corners_of_their_edge() {
        let kinds: [(ElementKind, &[[usize; 2]]); 10] = [
            (ElementKind::Tri3, &[]),
            (ElementKind::Tri6, &TRIANGLE),
            (ElementKind::Quad4, &[]),
            (ElementKind::Quad8, &QUADRILATERAL),
            (ElementKind::Tet4, &[]),
            (ElementKind::Tet10, &TETRAHEDRON),
            (ElementKind::Hex8, &[]),
            (ElementKind::Hex20, &HEXAHEDRON),
            (ElementKind::Wedge6, &[]),
            (ElementKind::Wedge15, &WEDGE),
        ];
        for (kind, edges) in kinds {
            let place = |vtk: usize| kind.natural_nodes()[node_order(kind)[vtk]];
            let corners = kind.nodes() - edges.len();
            assert_eq!(node_order(kind)[..corners], SAME[..corners], "{kind:?}");
            for (index, &[from, to]) in edges.iter().enumerate() {
                let (found, from, to) = (place(corners + index), place(from), place(to));
                let expected = [0, 1, 2].map(|axis| (from[axis] + to[axis]) / 2.0);
                assert_eq!(found, expected, "{kind:?} edge {index}");
            }
        }
    }
}
