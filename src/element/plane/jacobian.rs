//! From natural to real coordinates, and the check that an element is one.

use super::{PlaneKind, QuadratureRule, ShapeDerivatives, shape_derivatives, shape_values};
use crate::element::ElementError;

/// Smallest Jacobian determinant accepted, as a part of the squared size of the element: far below
/// any useful shape (aspect ratio 1e6 has 1e-6) and above the rounding of collinear nodes (1e-16).
const SMALLEST_DETERMINANT: f64 = 1e-12;

/// Derivatives of the shape functions with respect to (x, y), and the determinant.
pub(super) struct Mapped {
    /// `[dN_i/dx, dN_i/dy]`, 1/m; zero beyond the element's nodes.
    pub(super) gradients: ShapeDerivatives,
    /// `det J`, m^2.
    pub(super) determinant: f64,
}

/// `J = [[dx/dxi, dy/dxi], [dx/deta, dy/deta]]`, m, from the shape derivatives.
fn jacobian(coords: &[[f64; 2]], derivatives: &ShapeDerivatives) -> [[f64; 2]; 2] {
    let mut j = [[0.0; 2]; 2];
    for (node, derivative) in coords.iter().zip(derivatives) {
        for direction in 0..2 {
            j[direction][0] += derivative[direction] * node[0];
            j[direction][1] += derivative[direction] * node[1];
        }
    }
    j
}

fn determinant(j: [[f64; 2]; 2]) -> f64 {
    j[0][0] * j[1][1] - j[0][1] * j[1][0]
}

/// `det J` at a natural point, m^2.
pub(super) fn determinant_at(kind: PlaneKind, coords: &[[f64; 2]], natural: [f64; 2]) -> f64 {
    determinant(jacobian(coords, &shape_derivatives(kind, natural)))
}

/// Gradients at a natural point of an element that has passed [`check`].
pub(super) fn map(kind: PlaneKind, coords: &[[f64; 2]], natural: [f64; 2]) -> Mapped {
    let derivatives = shape_derivatives(kind, natural);
    let j = jacobian(coords, &derivatives);
    let determinant = determinant(j);
    let mut gradients = derivatives;
    for (gradient, [d_xi, d_eta]) in gradients.iter_mut().zip(derivatives) {
        *gradient = [
            (j[1][1] * d_xi - j[0][1] * d_eta) / determinant,
            (j[0][0] * d_eta - j[1][0] * d_xi) / determinant,
        ];
    }
    Mapped {
        gradients,
        determinant,
    }
}

/// Number of coordinates, finite coordinates, and a positive determinant at every node and at every
/// point of the rule. At the corners that is sufficient for straight sides; a strongly curved
/// element could still fold between the points.
pub(super) fn check(
    kind: PlaneKind,
    coords: &[[f64; 2]],
    rule: QuadratureRule,
) -> Result<(), ElementError> {
    if coords.len() != kind.nodes() {
        return Err(ElementError::NodeCount {
            kind: kind.name(),
            expected: kind.nodes(),
            found: coords.len(),
        });
    }
    let bad = |node: &[f64; 2]| !(node[0].is_finite() && node[1].is_finite());
    if let Some(node) = coords.iter().position(bad) {
        return Err(ElementError::NotFinite {
            kind: kind.name(),
            node,
            position: coords[node],
        });
    }
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut low_at, mut high_at) = ([0.0; 2], [0.0; 2]);
    let nodes = kind.natural_nodes().iter().copied();
    for natural in nodes.chain(rule.points().map(|point| point.natural)) {
        let found = determinant_at(kind, coords, natural);
        if found < low {
            (low, low_at) = (found, natural);
        }
        if found > high {
            (high, high_at) = (found, natural);
        }
    }
    let limit = SMALLEST_DETERMINANT * size_squared(coords);
    if high < -limit {
        Err(ElementError::Inverted {
            kind: kind.name(),
            determinant: high,
            position: position(kind, coords, high_at),
        })
    } else if low > limit {
        Ok(())
    } else {
        Err(ElementError::Degenerate {
            kind: kind.name(),
            determinant: low,
            natural: low_at,
            position: position(kind, coords, low_at),
        })
    }
}

/// Squared longest distance from the first node, m^2.
fn size_squared(coords: &[[f64; 2]]) -> f64 {
    let origin = coords.first().copied().unwrap_or_default();
    coords
        .iter()
        .map(|node| (node[0] - origin[0]).powi(2) + (node[1] - origin[1]).powi(2))
        .fold(0.0, f64::max)
}

/// Real coordinates of a natural point, m.
fn position(kind: PlaneKind, coords: &[[f64; 2]], natural: [f64; 2]) -> [f64; 2] {
    let mut position = [0.0; 2];
    for (node, value) in coords.iter().zip(shape_values(kind, natural)) {
        position[0] += value * node[0];
        position[1] += value * node[1];
    }
    position
}

/// Area of an element, m^2, exact for straight and curved sides.
///
/// `coords`: one (x, y) a node in gmsh's order, m.
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates, or an element that is inverted, degenerate or
/// folded.
pub fn area(kind: PlaneKind, coords: &[[f64; 2]]) -> Result<f64, ElementError> {
    let rule = kind.mass_rule();
    check(kind, coords, rule)?;
    Ok(rule
        .points()
        .map(|point| point.weight * determinant_at(kind, coords, point.natural))
        .sum())
}
