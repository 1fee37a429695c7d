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
    /// Nothing left to reduce.
    #[error(
        "the interface takes every free displacement of the housing, so that nothing is left to condense: expected an interface of fewer nodes, or a finer mesh"
    )]
    NoInterior,
    /// Nothing to attach it by.
    #[error("the interface has no free degree of freedom: every one of its nodes is fixed or tied")]
    NoInterface,
    /// `auto` did not reach the target.
    #[error(
        "no basis of up to {vectors} vectors brings the estimated error in the band to {band_hz} Hz below {target}: {reached:.1e} was reached"
    )]
    TargetMissed {
        /// Vectors of the last basis.
        vectors: usize,
        /// Top of the band, Hz.
        band_hz: f64,
        /// Error asked for.
        target: f64,
        /// Error of the last basis.
        reached: f64,
    },
    /// Too few modes of an interface.
    #[error(
        "{found} modes of the interface are kept, expected at least {least}: rigid motions that nothing holds, or else one (the first has {first_hz:.0} Hz)"
    )]
    FewInterfaceModes {
        /// How many are kept.
        found: usize,
        /// How many it takes.
        least: usize,
        /// Frequency of the first mode, Hz.
        first_hz: f64,
    },
    /// A linear algebra step failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// A response of the reduced model that does not exist.
    #[error(transparent)]
    Frf(#[from] FrfError),
}
