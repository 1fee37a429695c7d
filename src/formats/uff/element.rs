//! Element descriptors and node order of dataset 2412.
//!
//! Source: SDRC I-DEAS finite element descriptors; surfaces are thin shells, which may lie anywhere in space. Middle nodes
//! stand between their corners: round the first face, then those between the faces, then round the second face.

use crate::fe::mesh::ElementKind;

/// Descriptor and, for each place in the dataset, the place in gmsh's order.
pub(super) struct Descriptor {
    pub(super) id: u32,
    pub(super) order: &'static [usize],
}

const SAME: [usize; 8] = [0, 1, 2, 3, 4, 5, 6, 7];

/// The descriptor of a surface or solid element; none for points and lines.
pub(super) fn descriptor(kind: ElementKind) -> Option<Descriptor> {
    let (id, order): (u32, &[usize]) = match kind {
        ElementKind::Point | ElementKind::Line2 | ElementKind::Line3 => return None,
        ElementKind::Tri3 => (91, &SAME[..3]),
        ElementKind::Tri6 => (92, &[0, 3, 1, 4, 2, 5]),
        ElementKind::Quad4 => (94, &SAME[..4]),
        ElementKind::Quad8 => (95, &[0, 4, 1, 5, 2, 6, 3, 7]),
        ElementKind::Tet4 => (111, &SAME[..4]),
        ElementKind::Wedge6 => (112, &SAME[..6]),
        ElementKind::Wedge15 => (113, &[0, 6, 1, 9, 2, 7, 8, 10, 11, 3, 12, 4, 14, 5, 13]),
        ElementKind::Hex8 => (115, &SAME),
        ElementKind::Hex20 => (116, &[0, 8, 1, 11, 2, 13, 3, 9, 10, 12, 14, 15, 4, 16, 5, 18, 6, 19, 7, 17]),
        ElementKind::Tet10 => (118, &[0, 4, 1, 5, 2, 6, 7, 9, 8, 3]),
    };
    Some(Descriptor { id, order })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places of the dataset: a middle node and the two corners that it stands between.
    fn ring(first: usize, corners: usize) -> Vec<[usize; 3]> {
        let places = 2 * corners;
        let odd = (0..corners).map(|k| 2 * k + 1);
        odd.map(|k| [first + k, first + k - 1, first + (k + 1) % places]).collect()
    }

    #[allow(clippy::float_cmp)] // halves of small integers are exact
    #[test]
    fn middle_nodes_stand_between_their_corners() {
        let between = |first: usize, corners: usize| {
            let sides = (0..corners).map(move |k| {
                let above = first + corners + 2 * k;
                [first + k, 2 * k, above]
            });
            sides.collect::<Vec<_>>()
        };
        let tet10: Vec<[usize; 3]> = (0..3).map(|k| [6 + k, 2 * k, 9]).collect();
        let kinds = [
            (ElementKind::Tri6, ring(0, 3)),
            (ElementKind::Quad8, ring(0, 4)),
            (ElementKind::Tet10, [ring(0, 3), tet10].concat()),
            (ElementKind::Hex20, [ring(0, 4), between(8, 4), ring(12, 4)].concat()),
            (ElementKind::Wedge15, [ring(0, 3), between(6, 3), ring(9, 3)].concat()),
        ];
        for (kind, middles) in kinds {
            let order = descriptor(kind).unwrap().order;
            let mut sorted = order.to_vec();
            sorted.sort_unstable();
            assert_eq!(sorted, (0..kind.nodes()).collect::<Vec<_>>(), "{kind:?}");
            assert_eq!(middles.len(), kind.middle_edges().len(), "{kind:?}");
            for [middle, from, to] in middles {
                let place = |own: usize| kind.natural_nodes()[order[own]];
                let (from, to) = (place(from), place(to));
                let expected = [0, 1, 2].map(|axis| (from[axis] + to[axis]) / 2.0);
                assert_eq!(place(middle), expected, "{kind:?} node {middle}");
            }
        }
    }

    /// gmsh 4's own UNV export of the first element of tests/data/cube_*_msh41.msh against its MSH numbers.
    #[test]
    fn order_is_that_of_gmsh() {
        let cases: [(ElementKind, &[u64], &[u64]); 3] = [
            (ElementKind::Tet10, &[1, 9, 18, 81, 10, 46, 20, 87, 83, 100], &[1, 10, 9, 46, 18, 20, 87, 100, 83, 81]),
            (
                ElementKind::Hex20,
                &[1, 9, 45, 18, 33, 50, 75, 65, 10, 20, 34, 46, 51, 47, 76, 66, 52, 69, 77, 78],
                &[1, 10, 9, 46, 45, 47, 18, 20, 34, 51, 76, 66, 33, 52, 50, 77, 75, 78, 65, 69],
            ),
            (
                ElementKind::Wedge15,
                &[1, 9, 18, 33, 54, 69, 10, 20, 34, 46, 55, 70, 56, 73, 84],
                &[1, 10, 9, 46, 18, 20, 34, 55, 70, 33, 56, 54, 84, 69, 73],
            ),
        ];
        for (kind, own, expected) in cases {
            let order = descriptor(kind).unwrap().order;
            let found: Vec<u64> = order.iter().map(|&place| own[place]).collect();
            assert_eq!(found, expected, "{kind:?}");
        }
    }
}
