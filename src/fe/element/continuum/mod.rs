//! Plane and solid continua: stiffness and consistent mass of sixteen elements.
//!
//! `K = int B^T D B dV`, `M = rho int N^T N dV`; a plane element lies in the xy plane and has its thickness t
//! before both. Degrees of freedom node by node: (u_x, u_y, u_z) of node 0, of node 1, ...; without u_z in the
//! plane. Nodes are in gmsh's order, see [`ElementKind`](crate::fe::mesh::ElementKind).
//!
//! From coordinates to matrix: [`shape_derivatives`] at the points of a [`QuadratureRule`] are tabulated once a
//! kind; the Jacobian turns them into gradients, whose products are summed over the points and contracted with
//! the elasticity of [`ContinuumProperties`]; every element is checked on the way (`stiffness_into`,
//! `mass_into`). Nothing is allocated.
//!
//! Frequencies from the compatible elements lie above those of the continuum and fall as the mesh is refined,
//! as far as the integration is exact: which rule is exact for what stands with
//! `ElementKind::rules`. Quad4 and Hex8 have incompatible modes
//! by default ([`LinearFormulation`]), which bend without locking; their frequencies may come from below.
//!
//! # Limitations
//! Tri3, Tet4, Wedge6 and Pyramid5 lock in bending, and so do the plain Quad4 and Hex8. All elements lock as
//! Poisson's ratio comes near 1/2, except in plane stress.

mod geometry;
mod incompatible;
mod kernel;
mod mass;
mod properties;
mod quadrature;
mod rules;
mod shape;
mod stiffness;
mod surface;
mod table;
#[cfg(test)]
mod tests;

pub use geometry::ShapeQuality;
pub(crate) use geometry::{quality, straight_edges};
pub use mass::{mass, measure};
pub(crate) use mass::{mass_into, measure_matrix, nodal_mass_into};
pub use properties::{ContinuumProperties, PlaneAssumption};
pub use quadrature::{QuadraturePoint, QuadratureRule};
pub use rules::{Formulation, Integration, LinearFormulation};
pub(crate) use shape::shape;
pub use shape::{MAX_NODES, ShapeDerivatives, ShapeValues, shape_derivatives, shape_values};
pub use stiffness::stiffness;
pub(crate) use stiffness::stiffness_into;
pub(crate) use surface::{surface_matrix, surface_weights};
