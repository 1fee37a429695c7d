//! Edges and faces of elements in space, curved and warped ones too: how much length or area each node stands for.

use nalgebra::DMatrix;

use super::QuadratureRule;
use super::geometry::{cross, not_finite, wrong_node_count};
use super::shape::{ShapeDerivatives, ShapeValues, shape};
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;
use crate::numerics::Brief;

/// Smallest area accepted, as a part of the squared size; see the Jacobian of the elements.
const SMALLEST_AREA: f64 = 1e-12;

/// Tributary lengths or areas `w_i = int N_i ds` (m) or `int N_i dA` (m^2), one a node: a stiffness or load per
/// metre or square metre times `w_i` is what node i receives. Their sum is the length or area; corners of
/// quadratic faces have zero (Tri6) or negative (Quad8) shares, and that is right.
///
/// `coords`: one (x, y, z) a node in gmsh's order, m. Points have none and solids are no surface. On arcs of 20 degrees the
/// size is right to 2e-10 (measured for Line3, Quad8 and Tri6 against the length of the parabola).
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates, coordinates that are not finite, or an edge or face
/// without size.
pub(crate) fn surface_weights(kind: ElementKind, coords: &[[f64; 3]]) -> Result<Vec<f64>, ElementError> {
    if coords.len() != kind.nodes() {
        return Err(wrong_node_count(kind, coords));
    }
    if !coords.as_flattened().iter().all(|value| value.is_finite()) {
        return Err(not_finite(kind, coords));
    }
    if !(1..=2).contains(&kind.dimension()) {
        return Err(ElementError(format!("a {} element is neither an edge nor a face", kind.name())));
    }
    let origin = coords[0];
    let mut weights = vec![0.0; kind.nodes()];
    for (size, values) in sizes(kind, coords) {
        for (weight, value) in weights.iter_mut().zip(values) {
            *weight += size * value;
        }
    }
    let total: f64 = weights.iter().sum();
    let squared = |node: &[f64; 3]| {
        let along = |i: usize| (node[i] - origin[i]).powi(2);
        along(0) + along(1) + along(2)
    };
    let extent = coords.iter().map(squared).fold(0.0, f64::max);
    let smallest = if kind.dimension() == 2 { SMALLEST_AREA * extent } else { 0.0 };
    if total > smallest && total.is_finite() {
        Ok(weights)
    } else {
        let [x, y, z] = origin;
        let (what, size) = if kind.dimension() == 1 { ("edge", "length") } else { ("surface", "area") };
        let name = kind.name();
        Err(ElementError(format!("the {name} {what} at ({}, {}, {}) m has no {size}", Brief(x), Brief(y), Brief(z))))
    }
}

/// Length or area that each point of a rule stands for, and the shape functions there.
///
/// The rule is exact for straight edges and for flat faces with straight edges; curved and warped ones have square roots to
/// integrate, for which no rule is exact.
fn sizes(kind: ElementKind, coords: &[[f64; 3]]) -> impl Iterator<Item = (f64, ShapeValues)> {
    let rule = if kind == ElementKind::Quad4 { QuadratureRule::Square4 } else { kind.mass_rule() };
    rule.points().iter().map(move |point| {
        let (values, derivatives) = shape(kind, point.natural);
        (point.weight * stretch(kind, tangents(coords, &derivatives)), values)
    })
}

/// Derivatives of the place along the natural coordinates, m.
fn tangents(coords: &[[f64; 3]], derivatives: &ShapeDerivatives) -> [[f64; 3]; 2] {
    let origin = coords[0];
    let mut tangents = [[0.0; 3]; 2];
    for (node, derivative) in coords.iter().zip(derivatives) {
        for i in 0..3 {
            tangents[0][i] += derivative[0] * (node[i] - origin[i]);
            tangents[1][i] += derivative[1] * (node[i] - origin[i]);
        }
    }
    tangents
}

/// Consistent lengths or areas `w_ab = int N_a N_b ds` (m) or `int N_a N_b dA` (m^2) [nodes x nodes], positive: a
/// foundation or a mass spread over an edge or face acts between its nodes by it. Rows sum to
/// [`surface_weights`].
///
/// # Errors
/// As [`surface_weights`].
pub(crate) fn surface_matrix(kind: ElementKind, coords: &[[f64; 3]]) -> Result<DMatrix<f64>, ElementError> {
    surface_weights(kind, coords)?;
    let mut matrix = DMatrix::zeros(kind.nodes(), kind.nodes());
    for (size, values) in sizes(kind, coords) {
        for b in 0..kind.nodes() {
            for a in 0..kind.nodes() {
                matrix[(a, b)] += size * values[a] * values[b];
            }
        }
    }
    Ok(matrix)
}

/// Length of the tangent of an edge, or area of the parallelogram of both tangents of a face.
fn stretch(kind: ElementKind, [t, s]: [[f64; 3]; 2]) -> f64 {
    let length = |[x, y, z]: [f64; 3]| x.hypot(y).hypot(z);
    if kind.dimension() == 1 { length(t) } else { length(cross(t, s)) }
}
