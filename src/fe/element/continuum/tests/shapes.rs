//! Shape functions: partition of unity, nodal property, derivatives.

use crate::fe::element::continuum::{shape_derivatives, shape_values};
use crate::fe::mesh::ElementKind;

pub(super) fn check(kind: ElementKind) {
    counts(kind);
    partition_of_unity(kind);
    nodal_property(kind);
    derivatives_against_differences(kind);
}

fn counts(kind: ElementKind) {
    assert_eq!(kind.nodes(), kind.natural_nodes().len());
    assert_eq!(kind.dof(), kind.nodes() * kind.dimension());
    let digits: String = kind.name().chars().filter(char::is_ascii_digit).collect();
    assert_eq!(digits, kind.nodes().to_string());
    let flat = kind.natural_nodes().iter().all(|n| n[2].abs() < 1e-15);
    assert_eq!(flat, kind.dimension() == 2);
}

/// Reference: the pictures of the gmsh reference manual, "Node ordering"; the nodes that other programs number
/// otherwise.
#[test]
fn middle_nodes_are_in_gmshs_order() {
    use ElementKind::{Hex20, Quad8, Tet10, Tri6, Wedge15};
    let cases: [(ElementKind, usize, [f64; 3]); 14] = [
        (Tri6, 5, [0.0, 0.5, 0.0]),
        (Quad8, 7, [-1.0, 0.0, 0.0]),
        (Tet10, 6, [0.0, 0.5, 0.0]),
        (Tet10, 7, [0.0, 0.0, 0.5]),
        (Tet10, 8, [0.0, 0.5, 0.5]),
        (Tet10, 9, [0.5, 0.0, 0.5]),
        (Hex20, 9, [-1.0, 0.0, -1.0]),
        (Hex20, 10, [-1.0, -1.0, 0.0]),
        (Hex20, 13, [0.0, 1.0, -1.0]),
        (Hex20, 17, [-1.0, 0.0, 1.0]),
        (Wedge15, 7, [0.0, 0.5, -1.0]),
        (Wedge15, 8, [0.0, 0.0, 0.0]),
        (Wedge15, 9, [0.5, 0.5, -1.0]),
        (Wedge15, 13, [0.0, 0.5, 1.0]),
    ];
    for (kind, node, expected) in cases {
        let found = kind.natural_nodes()[node];
        let same = found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-15);
        assert!(same, "{kind:?} node {node}: {found:?}");
    }
}

/// Points all over the natural element: means of its corners with changing weights.
fn samples(kind: ElementKind) -> Vec<[f64; 3]> {
    let corners = &kind.natural_nodes()[..kind.corners()];
    let point = |k: usize| {
        let weight = |i: usize| (1.3 * k as f64 + 2.1 * i as f64).sin().powi(4);
        let total: f64 = (0..corners.len()).map(weight).sum();
        [0, 1, 2].map(|d| {
            let terms = corners.iter().enumerate();
            terms.map(|(i, c)| weight(i) * c[d]).sum::<f64>() / total
        })
    };
    (0..60).map(point).collect()
}

/// Sums of 20 terms of order 1: 1e-14 is their rounding.
fn partition_of_unity(kind: ElementKind) {
    for point in samples(kind) {
        let values = shape_values(kind, point);
        let sum: f64 = values.iter().sum();
        assert!((sum - 1.0).abs() < 1e-14, "{kind:?} {point:?}: {sum}");
        assert!(values[kind.nodes()..].iter().all(|v| v.abs() < 1e-300));
        for d in 0..3 {
            let sum: f64 = shape_derivatives(kind, point).iter().map(|g| g[d]).sum();
            assert!(sum.abs() < 1e-14, "{kind:?} {point:?}: {sum}");
        }
    }
}

fn nodal_property(kind: ElementKind) {
    for (i, &point) in kind.natural_nodes().iter().enumerate() {
        for (j, value) in shape_values(kind, point).into_iter().enumerate() {
            let expected = if i == j { 1.0 } else { 0.0 };
            let error = (value - expected).abs();
            assert!(error < 1e-15, "{kind:?} N_{j} at node {i}: {value}");
        }
    }
}

/// Central differences of quadratic (in one direction) functions are exact but for rounding, 1e-16 / h.
fn derivatives_against_differences(kind: ElementKind) {
    let h = 1e-5;
    for point in samples(kind) {
        let exact = shape_derivatives(kind, point);
        for d in 0..3 {
            let (mut plus, mut minus) = (point, point);
            plus[d] += h;
            minus[d] -= h;
            let (plus, minus) = (shape_values(kind, plus), shape_values(kind, minus));
            for i in 0..kind.nodes() {
                let difference = (plus[i] - minus[i]) / (2.0 * h);
                let expected = if d < kind.dimension() { difference } else { 0.0 };
                let error = (expected - exact[i][d]).abs();
                assert!(error < 1e-10, "{kind:?} node {i} direction {d}: {error}");
            }
        }
    }
}
