//! Craig-Bampton: a housing with thousands of degrees of freedom becomes a small matrix pair on its interface (the
//! ring's displacements, or nodes of the mesh) and a few amplitudes, with an estimate of what that costs.

#[cfg(test)]
mod centre_tests;
mod characteristic_modes;
mod checks;
mod coupled_lowest;
mod craig_bampton;
mod error;
mod estimate;
pub mod frf;
mod interface_reduction;
mod interior;
mod interior_basis;
mod parts;
mod residual_flexibility;
mod response_estimate;
#[cfg(test)]
#[path = "samples_tests.rs"]
mod samples;
mod selection;
mod size_study;
mod smallest_basis;
mod substructure;

pub use characteristic_modes::{CharacteristicModes, InterfaceSize, LostFlexibility};
pub use checks::{Bound, Check, RigidMotions};
pub(crate) use checks::{check_craig_bampton, check_matrices};
pub(crate) use craig_bampton::craig_bampton_watched;
pub use craig_bampton::{CraigBampton, Superelement, craig_bampton};
pub use error::ReductionError;
pub use estimate::{ErrorEstimate, EstimatedMode};
pub use interface_reduction::InterfaceReduction;
pub use interior_basis::{Attached, BasisChoice, BasisSize, InteriorBasis};
pub use residual_flexibility::ResidualFlexibility;
pub(crate) use response_estimate::UNCOUPLED;
pub use response_estimate::{InteriorDamping, ResponseEstimate};
pub use selection::choose_basis;
pub(crate) use size_study::size_study;
pub use size_study::{ReducedSize, SizeErrors};
pub use substructure::Substructure;
