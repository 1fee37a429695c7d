//! Craig-Bampton: a housing with thousands of degrees of freedom becomes a small matrix pair on the
//! ring's displacements and a few modal amplitudes.

mod craig_bampton;
mod superelement;

pub use craig_bampton::{FixedModeSelection, ReductionError, craig_bampton};
pub use superelement::Superelement;
