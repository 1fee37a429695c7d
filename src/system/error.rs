//! What can go wrong between structure and bearing.

use crate::numerics::linalg::LinalgError;
use thiserror::Error;

/// Failure of a coupled computation.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SystemError {
    /// A linear algebra step failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// A superelement or a sensor row of another size than the structure's.
    #[error("{0}")]
    OtherSize(String),
    /// The structure can move as a whole.
    #[error(
        "ring and housing are not held: they can move without force; add springs or fixed nodes under [housing] supports or [ring] supports"
    )]
    NotSupported,
    /// Reduced model and formulation that exclude each other.
    #[error(
        "formulation = \"printed\" couples the balls to the ring's mean acceleration and needs all modes: set transient.modes = \"all\""
    )]
    PrintedNeedsAllModes,
    /// Balls without inertia where their motion enters the equations.
    #[error(
        "balls_inertia = \"quasi-static\" leaves out how fast balls move, which contact_damping and formulation = \"printed\" need: set balls_inertia = \"dynamic\""
    )]
    BallsNeedInertia,
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
    /// Nothing holds the shaft.
    #[error("the shaft is not held in the loaded direction: without load on it, it can move in the clearance")]
    NothingHoldsTheShaft,
}
