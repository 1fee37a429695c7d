//! Shape functions: partition of unity, nodal property, derivatives.

use crate::fe::element::continuum::{shape, shape_derivatives, shape_values};
use crate::fe::mesh::ElementKind;

pub(super) fn check(kind: ElementKind) {
    counts(kind);
    partition_of_unity(kind);
    nodal_property(kind);
    derivatives_against_differences(kind);
    complete_to_its_order(kind);
    faces_are_those_of_their_kind(kind);
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
    use ElementKind::{Hex20, Hex27, Pyramid13, Pyramid14, Quad8, Quad9, Tet10, Tri6, Wedge15, Wedge18};
    let cases: [(ElementKind, usize, [f64; 3]); 28] = [
        (Quad9, 8, [0.0, 0.0, 0.0]),
        (Hex27, 17, [-1.0, 0.0, 1.0]),
        (Hex27, 20, [0.0, 0.0, -1.0]),
        (Hex27, 21, [0.0, -1.0, 0.0]),
        (Hex27, 22, [-1.0, 0.0, 0.0]),
        (Hex27, 24, [0.0, 1.0, 0.0]),
        (Hex27, 26, [0.0, 0.0, 0.0]),
        (Wedge18, 15, [0.5, 0.0, 0.0]),
        (Wedge18, 16, [0.0, 0.5, 0.0]),
        (Wedge18, 17, [0.5, 0.5, 0.0]),
        (Pyramid13, 6, [-1.0, 0.0, 0.0]),
        (Pyramid13, 9, [0.5, -0.5, 0.5]),
        (Pyramid14, 11, [0.5, 0.5, 0.5]),
        (Pyramid14, 13, [0.0, 0.0, 0.0]),
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

/// Fifth-order central differences: the error is `h^4 / 30` times the fifth derivative, at most 720 / s^3 of the pyramids'
/// functions, whose h is as small as their width s; rounding is 1e-16 / h.
fn derivatives_against_differences(kind: ElementKind) {
    for point in samples(kind) {
        let h = if kind.corners() == 5 { 1e-3 * (1.0 - point[2]) } else { 1e-3 };
        let exact = shape_derivatives(kind, point);
        for d in 0..3 {
            let at = |steps: f64| {
                let mut moved = point;
                moved[d] += steps * h;
                shape_values(kind, moved)
            };
            let [far_minus, minus, plus, far_plus] = [-2.0, -1.0, 1.0, 2.0].map(at);
            for i in 0..kind.nodes() {
                let difference = (far_minus[i] - far_plus[i] + 8.0 * (plus[i] - minus[i])) / (12.0 * h);
                let expected = if d < kind.dimension() { difference } else { 0.0 };
                let error = (expected - exact[i][d]).abs();
                assert!(error < 1e-10, "{kind:?} node {i} direction {d}: {error}");
            }
        }
    }
}

/// Every monomial up to the order is met, value and gradient, also at the apex of a pyramid and near it.
fn complete_to_its_order(kind: ElementKind) {
    let mut points = samples(kind);
    points.extend(kind.natural_nodes());
    if kind.corners() == 5 {
        points.extend([[0.0, 0.0, 1.0 - 1e-9], [4e-10, -9e-10, 1.0 - 1e-9]]);
    }
    let order = kind.order() as i32;
    let powers =
        |n: i32| (0..=n).flat_map(move |i| (0..=n - i).flat_map(move |j| (0..=n - i - j).map(move |k| [i, j, k])));
    for p in powers(order).filter(|p| kind.dimension() == 3 || p[2] == 0) {
        let field = |x: [f64; 3]| (0..3).map(|d| x[d].powi(p[d])).product::<f64>();
        let slope = |x: [f64; 3], d: usize| {
            let of = |i: usize| if i == d { f64::from(p[i]) * x[i].powi((p[i] - 1).max(0)) } else { x[i].powi(p[i]) };
            (0..3).map(of).product::<f64>()
        };
        for &point in &points {
            let (values, derivatives) = shape(kind, point);
            let nodes = kind.natural_nodes();
            let error = nodes.iter().zip(values).map(|(&x, n)| n * field(x)).sum::<f64>() - field(point);
            assert!(error.abs() < 1e-14, "{kind:?} {p:?} at {point:?}: {error:e}");
            for d in 0..kind.dimension() {
                let found: f64 = nodes.iter().zip(derivatives).map(|(&x, n)| n[d] * field(x)).sum();
                let error = found - slope(point, d);
                assert!(error.abs() < 1e-14, "{kind:?} {p:?} direction {d} at {point:?}: {error:e}");
            }
        }
    }
}

/// On a face the element's functions are those of the face's kind, so that neighbours of any kind conform there.
fn faces_are_those_of_their_kind(kind: ElementKind) {
    for face in kind.faces() {
        for at in samples(face.kind) {
            let on_face = shape_values(face.kind, at);
            let mut point = [0.0; 3];
            for (&node, value) in face.nodes.iter().zip(on_face) {
                (0..3).for_each(|d| point[d] += value * kind.natural_nodes()[node][d]);
            }
            let values = shape_values(kind, point);
            for (node, value) in values[..kind.nodes()].iter().enumerate() {
                let own = face.nodes.iter().position(|&of_face| of_face == node);
                let expected = own.map_or(0.0, |local| on_face[local]);
                assert!((value - expected).abs() < 1e-14, "{kind:?} N_{node} on {face:?}: {value} {expected}");
            }
        }
    }
}
