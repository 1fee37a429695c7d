//! Shape functions and their derivatives with respect to the natural coordinates.
//!
//! Fixed-size arrays, zero beyond the element's nodes; the assembly loop reads them from tables made
//! once a kind. Sources: Bathe, Finite Element Procedures (1996), figures 5.4, 5.5 (quadrilaterals,
//! hexahedra), 5.11 and 5.13 (triangles, tetrahedra); Zienkiewicz and Taylor, The Finite Element Method,
//! volume 1 (2000), section 8.12 (wedges).

mod simplex;
mod tensor;
mod wedge;

use super::{ContinuumKind, MAX_NODES};

/// `N_i` at a point; entries beyond the element's nodes are zero.
pub type ShapeValues = [f64; MAX_NODES];

/// `[dN_i/dxi, dN_i/deta, dN_i/dzeta]` at a point; entries beyond the element's nodes, and the third of plane
/// elements, are zero.
pub type ShapeDerivatives = [[f64; 3]; MAX_NODES];

/// Shape functions `N_i(xi, eta, zeta)`, dimensionless: 1 at node i, 0 at the others, sum 1.
pub fn shape_values(kind: ContinuumKind, natural: [f64; 3]) -> ShapeValues {
    evaluate(kind, natural).0
}

/// Derivatives `dN_i/dxi`, `dN_i/deta`, `dN_i/dzeta`, dimensionless; their sums over i are zero.
pub fn shape_derivatives(kind: ContinuumKind, natural: [f64; 3]) -> ShapeDerivatives {
    evaluate(kind, natural).1
}

/// Values and derivatives together.
fn evaluate(kind: ContinuumKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    use ContinuumKind::{Hex8, Hex20, Quad4, Quad8, Tet4, Tet10, Tri3, Tri6, Wedge6, Wedge15};
    match kind {
        Tri3 | Tri6 | Tet4 | Tet10 => simplex::evaluate(kind, natural),
        Quad4 | Quad8 | Hex8 | Hex20 => tensor::evaluate(kind, natural),
        Wedge6 | Wedge15 => wedge::evaluate(kind, natural),
    }
}
