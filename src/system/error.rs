//! What can go wrong between structure and bearing.

use crate::fe::reduction::frf::FrfError;
use crate::numerics::linalg::LinalgError;
use thiserror::Error;

/// Failure of a coupled computation.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SystemError {
    /// A linear algebra step failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// Damping out of range.
    #[error(transparent)]
    Damping(#[from] FrfError),
    /// A superelement or a sensor row of another size than the structure's.
    #[error("{0}")]
    OtherSize(String),
    /// What the input asks for does not exist, and what to change.
    #[error("{0}")]
    Refused(&'static str),
    /// A selection without modes.
    #[error(
        "no mode of the structure is kept: the lowest is at {lowest_hz:.4e} Hz; raise accuracy.band_hz or set transient.modes"
    )]
    NoModesKept {
        /// Lowest frequency of the structure, Hz.
        lowest_hz: f64,
    },
    /// No stable equilibrium found.
    #[error(
        "no static equilibrium found after {iterations} iterations: the forces on shaft and balls are still {residual_n:.3e} N out of balance; check loads and clearance"
    )]
    NoEquilibrium {
        /// Iterations made.
        iterations: usize,
        /// Largest force out of balance, N.
        residual_n: f64,
    },
}
