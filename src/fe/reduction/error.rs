//! Reductions that cannot be made.

use super::frf::FrfError;
use crate::numerics::linalg::LinalgError;
use thiserror::Error;

/// A reduction that cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ReductionError {
    /// The interior can move while the interface is held.
    #[error(
        "with the interface held, part of the housing can still move: its stiffness is zero but for round-off ({interior} interior degrees of freedom); expected every part to hang on the interface or on a support"
    )]
    FloatingInterior {
        /// Number of interior degrees of freedom.
        interior: usize,
        /// One of the housing that can.
        dof: usize,
    },
    /// The interior is held too softly for the digits that there are.
    #[error(
        "with the interface held, part of the housing is held so softly, or has elements so flat, that its displacements under given forces are right to {error:.0e} only, expected {limit:.0e}"
    )]
    SoftInterior {
        /// Degree of freedom of the housing with the largest error.
        dof: usize,
        /// Relative error of solutions.
        error: f64,
        /// Largest one accepted.
        limit: f64,
    },
    /// A basis, an interface or a number of modes that does not exist, and why.
    #[error("{0}")]
    Refused(String),
    /// A linear algebra step failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// A response of the reduced model that does not exist.
    #[error(transparent)]
    Frf(#[from] FrfError),
}
