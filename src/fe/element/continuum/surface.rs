//! Edges and faces of elements in space: how much length or area each node stands for.

use nalgebra::DMatrix;

use super::geometry::not_finite;
use super::{ContinuumKind, QuadratureRule, shape_derivatives, shape_values};
use crate::fe::element::ElementError;

/// Most nodes that an edge or a face has.
pub const MAX_SURFACE_NODES: usize = 8;

/// `N_i` at a point of an edge or face; entries beyond its nodes are zero.
pub type SurfaceValues = [f64; MAX_SURFACE_NODES];

/// `[dN_i/dxi, dN_i/deta]`; entries beyond the nodes, and the second of edges, are zero.
pub type SurfaceDerivatives = [[f64; 2]; MAX_SURFACE_NODES];

/// Smallest area accepted, as a part of the squared size; see the Jacobian of the elements.
const SMALLEST_AREA: f64 = 1e-12;

/// An edge or a face of an element, in space: curved and warped ones too.
///
/// Natural coordinates: edges on [-1, 1]; faces as the plane elements of the same name. Nodes in gmsh's
/// order: ends or corners, then middle nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SurfaceKind {
    /// Edge, two nodes, straight.
    Line2,
    /// Edge, two ends and a middle node; may be curved.
    Line3,
    /// Triangle, three nodes, flat.
    Tri3,
    /// Triangle, six nodes; may be curved.
    Tri6,
    /// Quadrilateral, four nodes; may be warped.
    Quad4,
    /// Quadrilateral, eight nodes; may be curved.
    Quad8,
}

impl SurfaceKind {
    /// Every kind of edge and face.
    pub const ALL: [Self; 6] = [Self::Line2, Self::Line3, Self::Tri3, Self::Tri6, Self::Quad4, Self::Quad8];

    /// Name as in reports and errors.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Line2 => "Line2",
            Self::Line3 => "Line3",
            _ => self.plane().map_or("", ContinuumKind::name),
        }
    }

    /// Number of nodes.
    pub(crate) fn nodes(self) -> usize {
        match self {
            Self::Line2 => 2,
            Self::Line3 => 3,
            Self::Tri3 => 3,
            Self::Tri6 => 6,
            Self::Quad4 => 4,
            Self::Quad8 => 8,
        }
    }

    /// 1 for edges, 2 for faces.
    pub(crate) fn dimension(self) -> usize {
        match self {
            Self::Line2 | Self::Line3 => 1,
            _ => 2,
        }
    }

    /// The rule of [`surface_weights`]: exact for straight edges and for flat faces with straight edges; curved
    /// and warped ones have square roots to integrate, for which no rule is exact.
    pub(crate) fn rule(self) -> QuadratureRule {
        match self {
            Self::Line2 | Self::Line3 => QuadratureRule::LINE_4,
            Self::Tri3 => QuadratureRule::TRIANGLE_3,
            Self::Tri6 => QuadratureRule::TRIANGLE_12,
            Self::Quad4 | Self::Quad8 => QuadratureRule::SQUARE_4X4,
        }
    }

    /// The plane element with the same shape functions, if it is a face.
    fn plane(self) -> Option<ContinuumKind> {
        match self {
            Self::Line2 | Self::Line3 => None,
            Self::Tri3 => Some(ContinuumKind::Tri3),
            Self::Tri6 => Some(ContinuumKind::Tri6),
            Self::Quad4 => Some(ContinuumKind::Quad4),
            Self::Quad8 => Some(ContinuumKind::Quad8),
        }
    }
}

/// Shape functions and their derivatives with respect to the two natural coordinates, dimensionless. Edges read
/// the first coordinate alone.
pub(crate) fn surface_shape(kind: SurfaceKind, [xi, eta]: [f64; 2]) -> (SurfaceValues, SurfaceDerivatives) {
    let mut values = [0.0; MAX_SURFACE_NODES];
    let mut derivatives = [[0.0; 2]; MAX_SURFACE_NODES];
    if let Some(plane) = kind.plane() {
        let natural = [xi, eta, 0.0];
        values.copy_from_slice(&shape_values(plane, natural)[..MAX_SURFACE_NODES]);
        for (to, from) in derivatives.iter_mut().zip(shape_derivatives(plane, natural)) {
            *to = [from[0], from[1]];
        }
    } else if kind == SurfaceKind::Line2 {
        values[..2].copy_from_slice(&[0.5 * (1.0 - xi), 0.5 * (1.0 + xi)]);
        derivatives[..2].copy_from_slice(&[[-0.5, 0.0], [0.5, 0.0]]);
    } else {
        values[..3].copy_from_slice(&[0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi]);
        derivatives[..3].copy_from_slice(&[[xi - 0.5, 0.0], [xi + 0.5, 0.0], [-2.0 * xi, 0.0]]);
    }
    (values, derivatives)
}

/// Tributary lengths or areas `w_i = int N_i ds` (m) or `int N_i dA` (m^2), one a node: a stiffness or load per
/// metre or square metre times `w_i` is what node i receives. Their sum is the length or area; corners of
/// quadratic faces have zero (Tri6) or negative (Quad8) shares, and that is right.
///
/// `coords`: one (x, y, z) a node in gmsh's order, m. Rules: [`SurfaceKind::rule`]; on arcs of 20 degrees the
/// size is right to 2e-10 (measured for Line3, Quad8 and Tri6 against the length of the parabola).
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates, coordinates that are not finite, or an edge or face
/// without size.
pub(crate) fn surface_weights(kind: SurfaceKind, coords: &[[f64; 3]]) -> Result<Vec<f64>, ElementError> {
    if coords.len() != kind.nodes() {
        return Err(ElementError::NodeCount { kind: kind.name(), expected: kind.nodes(), found: coords.len() });
    }
    if !coords.as_flattened().iter().all(|value| value.is_finite()) {
        return Err(not_finite(kind.name(), coords));
    }
    let origin = coords[0];
    let mut weights = vec![0.0; kind.nodes()];
    for point in kind.rule().points() {
        let [xi, eta, _] = point.natural;
        let (values, derivatives) = surface_shape(kind, [xi, eta]);
        let size = point.weight * stretch(kind, tangents(coords, &derivatives));
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
        Err(ElementError::NoSize { kind: kind.name(), dimension: kind.dimension(), position: origin })
    }
}

/// Derivatives of the place along the natural coordinates, m.
fn tangents(coords: &[[f64; 3]], derivatives: &SurfaceDerivatives) -> [[f64; 3]; 2] {
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
pub(crate) fn surface_matrix(kind: SurfaceKind, coords: &[[f64; 3]]) -> Result<DMatrix<f64>, ElementError> {
    surface_weights(kind, coords)?;
    let mut matrix = DMatrix::zeros(kind.nodes(), kind.nodes());
    for point in kind.rule().points() {
        let [xi, eta, _] = point.natural;
        let (values, derivatives) = surface_shape(kind, [xi, eta]);
        let size = point.weight * stretch(kind, tangents(coords, &derivatives));
        for b in 0..kind.nodes() {
            for a in 0..kind.nodes() {
                matrix[(a, b)] += size * values[a] * values[b];
            }
        }
    }
    Ok(matrix)
}

/// Length of the tangent of an edge, or area of the parallelogram of both tangents of a face.
fn stretch(kind: SurfaceKind, [t, s]: [[f64; 3]; 2]) -> f64 {
    let length = |[x, y, z]: [f64; 3]| x.hypot(y).hypot(z);
    if kind.dimension() == 1 {
        length(t)
    } else {
        length([t[1] * s[2] - t[2] * s[1], t[2] * s[0] - t[0] * s[2], t[0] * s[1] - t[1] * s[0]])
    }
}
