//! Craig-Bampton: a housing with thousands of degrees of freedom becomes a small matrix pair on its interface (the
//! ring's displacements, or nodes of the mesh) and a few amplitudes, with an estimate of what that costs.

mod checks;
mod coupled_modes;
mod craig_bampton;
mod error;
mod estimate;
pub mod frf;
mod interior_basis;
mod residual_flexibility;
mod response_estimate;
#[cfg(test)]
mod samples;
mod selection;
mod smallest_basis;
mod substructure;
mod superelement;

pub use checks::{Bound, Check, RigidMotions, check_craig_bampton, check_matrices};
pub use coupled_modes::Attached;
pub use craig_bampton::{CraigBampton, craig_bampton};
pub use error::ReductionError;
pub use estimate::{ErrorEstimate, EstimatedMode};
pub use interior_basis::InteriorBasis;
pub use residual_flexibility::ResidualFlexibility;
pub use response_estimate::ResponseEstimate;
pub use selection::{BasisChoice, BasisSize, choose_basis};
pub use substructure::Substructure;
pub use superelement::Superelement;
