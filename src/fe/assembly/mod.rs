//! Model to matrices: sparse stiffness and consistent mass of a housing, its weight, its mass.
//!
//! The pattern comes from the node graph once; element matrices are computed in parallel, batch by batch, and
//! added into it in element order, so that the sums depend on nothing but the model. Meanwhile the order of a factorisation can
//! be found: it needs the pattern alone.

mod coupled;
mod pattern;
mod system;

pub use coupled::{CoupledMatrices, CoupledMotions};
pub use system::{StructuralStiffness, SystemMatrices};
