//! Plane triangles and quadrilaterals: stiffness and consistent mass in plane stress or plane strain.
//!
//! `K = t int B^T D B dA`, `M = rho t int N^T N dA`, degrees of freedom node by node: (u_x, u_y) of
//! node 0, of node 1, ... Nodes are in gmsh's order: corners anticlockwise, then the middle of the
//! edges in the order of the edges.
//!
//! Frequencies from these matrices lie above those of the continuum and fall as the mesh is refined
//! (displacement elements, consistent mass), as far as the integration is exact; see [`QuadratureRule`]
//! for which rule is exact for what.
//!
//! Source of all formulas: Bathe, Finite Element Procedures (1996), chapter 5; Dunavant, Int. J.
//! Numer. Methods Eng. 21 (1985) 1129 for the triangle rules.
//!
//! # Limitations
//! [`PlaneKind::Quad4`] is the plain element and locks in bending; [`PlaneKind::Tri3`] still more.

mod edge;
mod jacobian;
mod kind;
mod mass;
mod properties;
mod quadrature;
mod shape;
mod stiffness;
#[cfg(test)]
mod tests;

pub use edge::{EdgeKind, edge_weights};
pub use jacobian::area;
pub use kind::{MAX_NODES, PlaneKind};
pub use mass::{mass, mass_into};
pub use properties::{PlaneAssumption, PlaneProperties};
pub use quadrature::{QuadraturePoint, QuadratureRule};
pub use shape::{ShapeDerivatives, ShapeValues, shape_derivatives, shape_values};
pub use stiffness::{stiffness, stiffness_into};
