//! Edges and faces.

use super::Outcome;
use super::fixtures::message;
use crate::fe::element::continuum::{shape, surface_matrix, surface_weights};
use crate::fe::mesh::ElementKind;

/// Reference: Zienkiewicz and Taylor, volume 1: uniform load on straight-edged faces.
#[test]
fn flat_surfaces_have_the_textbook_weights() -> Outcome {
    // the natural coordinates, blown up and turned in space: lengths by 2, areas by 4
    let place = |[x, y]: [f64; 2]| [2.0 * (0.6 * x - 0.8 * y), 5.0, 2.0 * (0.8 * x + 0.6 * y)];
    let natural = |kind: ElementKind| -> Vec<[f64; 2]> {
        match kind {
            ElementKind::Line2 | ElementKind::Line3 => vec![[-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]],
            ElementKind::Tri3 | ElementKind::Tri6 => {
                ElementKind::Tri6.natural_nodes().iter().map(|n| [n[0], n[1]]).collect()
            }
            _ => ElementKind::Quad9.natural_nodes().iter().map(|n| [n[0], n[1]]).collect(),
        }
    };
    let (corner, side, middle) = (1.0 / 36.0, 4.0 / 36.0, 16.0 / 36.0);
    let cases: [(ElementKind, f64, &[f64]); 7] = [
        (ElementKind::Quad9, 16.0, &[corner, corner, corner, corner, side, side, side, side, middle]),
        (ElementKind::Line2, 4.0, &[0.5; 2]),
        (ElementKind::Line3, 4.0, &[1.0 / 6.0, 1.0 / 6.0, 4.0 / 6.0]),
        (ElementKind::Tri3, 2.0, &[1.0 / 3.0; 3]),
        (ElementKind::Tri6, 2.0, &[0.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0]),
        (ElementKind::Quad4, 16.0, &[0.25; 4]),
        (
            ElementKind::Quad8,
            16.0,
            &[-1.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
        ),
    ];
    for (kind, size, shares) in cases {
        let coords: Vec<_> = natural(kind).into_iter().take(kind.nodes()).map(place).collect();
        let weights = surface_weights(kind, &coords)?;
        assert_eq!(weights.len(), shares.len());
        for (weight, share) in weights.iter().zip(shares) {
            assert!((weight - size * share).abs() < 1e-14 * size, "{kind:?}: {weights:?}");
        }
        for (i, &at) in natural(kind).iter().take(kind.nodes()).enumerate() {
            for (j, value) in shape(kind, [at[0], at[1], 0.0]).0.into_iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((value - expected).abs() < 1e-15, "{kind:?} N_{j} at node {i}: {value}");
            }
        }
    }
    Ok(())
}

#[test]
fn derivatives_against_differences() {
    let h = 1e-5;
    for kind in ElementKind::all().filter(|kind| (1..=2).contains(&kind.dimension())) {
        let at = [0.21, 0.34];
        let derivatives = shape(kind, [at[0], at[1], 0.0]).1;
        for d in 0..2 {
            let (mut plus, mut minus) = (at, at);
            plus[d] += h;
            minus[d] -= h;
            let (plus, minus) = (shape(kind, [plus[0], plus[1], 0.0]).0, shape(kind, [minus[0], minus[1], 0.0]).0);
            for i in 0..9 {
                let difference = (plus[i] - minus[i]) / (2.0 * h);
                assert!((difference - derivatives[i][d]).abs() < 1e-10, "{kind:?} {i} {d}");
            }
        }
    }
}

/// Reference: arc length of the parabola through the nodes, `y = h (1 - (x/c)^2)`,
/// `L = sqrt(c^2 + 4 h^2) + c^2 / (2 h) asinh(2 h / c)`.
#[test]
fn curved_edge_has_the_length_of_its_parabola() -> Outcome {
    let half_angle = 10.0_f64.to_radians();
    let (sin, cos) = half_angle.sin_cos();
    let nodes = [[0.6 * sin, 0.8 * sin, cos], [-0.6 * sin, -0.8 * sin, cos], [0.0, 0.0, 1.0]];
    let weights = surface_weights(ElementKind::Line3, &nodes)?;
    let (c, h) = (sin, 1.0 - cos);
    let length = c.hypot(2.0 * h) + c * c / (2.0 * h) * (2.0 * h / c).asinh();
    let total: f64 = weights.iter().sum();
    assert!((total / length - 1.0).abs() < 2e-10, "{total} {length}");
    assert!((weights[0] / weights[1] - 1.0).abs() < 1e-14);
    Ok(())
}

/// A Quad8 and two Tri6 on a patch of a cylinder, 20 degrees round: the parabolic cylinder through the
/// nodes has the area of the parabola's length times the height.
#[test]
fn curved_faces_have_the_area_of_their_parabola() -> Outcome {
    let (sin, cos) = 10.0_f64.to_radians().sin_cos();
    let (left, right, top) = ([sin, cos], [-sin, cos], [0.0, 1.0]);
    let at = |[x, y]: [f64; 2], z: f64| [x, y, z];
    let quad = [
        at(left, 0.0),
        at(right, 0.0),
        at(right, 0.5),
        at(left, 0.5),
        at(top, 0.0),
        at(right, 0.25),
        at(top, 0.5),
        at(left, 0.25),
    ];
    // the middle of the diagonal lies on the parabola's crown too
    let lower = [quad[0], quad[1], quad[2], quad[4], quad[5], at(top, 0.25)];
    let upper = [quad[0], quad[2], quad[3], at(top, 0.25), quad[6], quad[7]];
    let (c, h) = (sin, 1.0 - cos);
    let length = c.hypot(2.0 * h) + c * c / (2.0 * h) * (2.0 * h / c).asinh();
    let area = |kind, coords: &[[f64; 3]]| -> Result<f64, Box<dyn std::error::Error>> {
        Ok(surface_weights(kind, coords)?.iter().sum())
    };
    let one = area(ElementKind::Quad8, &quad)? / (0.5 * length) - 1.0;
    let triangles = area(ElementKind::Tri6, &lower)? + area(ElementKind::Tri6, &upper)?;
    let two = triangles / (0.5 * length) - 1.0;
    assert!(one.abs() < 2e-10 && two.abs() < 2e-10, "{one:e} {two:e}");
    Ok(())
}

#[test]
fn every_rule_fires_with_its_message() {
    let message = |kind, coords: &[[f64; 3]]| message(surface_weights(kind, coords));
    assert_eq!(message(ElementKind::Line2, &[[0.0; 3]]), "a Line2 element has 2 nodes, found 1");
    assert_eq!(message(ElementKind::Line2, &[[0.5, 0.25, 0.0]; 2]), "the Line2 edge at (0.5, 0.25, 0) m has no length");
    assert_eq!(
        message(ElementKind::Tri3, &[[1.0, 0.0, 0.0], [2.0, 0.1, 0.0], [3.0, 0.2, 0.0]]),
        "the Tri3 surface at (1, 0, 0) m has no area"
    );
    assert_eq!(
        message(ElementKind::Line2, &[[0.0; 3], [f64::NAN, 0.0, 1.0]]),
        "node 1 of the Line2 element has the coordinates (NaN, 0, 1) m: expected finite numbers"
    );
}

/// Rows of the consistent matrix sum to the weights, and it is positive where the weights of Quad8 are not. Reference:
/// an edge of length 3 has 3/3 on the diagonal and 3/6 beside it.
#[test]
fn consistent_shares_are_positive() -> Outcome {
    for kind in ElementKind::all().filter(|kind| (1..=2).contains(&kind.dimension())) {
        let flat: Vec<[f64; 3]> = match kind {
            ElementKind::Line2 | ElementKind::Line3 => {
                vec![[0.0; 3], [3.0, 0.0, 0.0], [1.5, 0.0, 0.0]]
            }
            ElementKind::Tri3 | ElementKind::Tri6 => ElementKind::Tri6.natural_nodes().to_vec(),
            _ => ElementKind::Quad9.natural_nodes().to_vec(),
        };
        let coords = &flat[..kind.nodes()];
        let (matrix, weights) = (surface_matrix(kind, coords)?, surface_weights(kind, coords)?);
        for (row, weight) in weights.iter().enumerate() {
            assert!((matrix.row(row).sum() - weight).abs() < 1e-14, "{kind:?} {row}");
        }
        let lowest = matrix.clone().symmetric_eigenvalues().min();
        assert!(lowest > 1e-3 * matrix.trace() / kind.nodes() as f64, "{kind:?}: {lowest}");
        if kind == ElementKind::Line2 {
            assert!((matrix[(0, 0)] - 1.0).abs() < 1e-14 && (matrix[(0, 1)] - 0.5).abs() < 1e-14);
        }
    }
    Ok(())
}
