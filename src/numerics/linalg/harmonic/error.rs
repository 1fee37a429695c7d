//! What can go wrong in a harmonic response.

use crate::numerics::linalg::LinalgError;
use thiserror::Error;

/// A response that does not exist, or that could not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum HarmonicError {
    /// A frequency or a damping coefficient below zero, or a value that is not finite; a sentence.
    #[error("{0}")]
    Input(String),
    /// No damping, and a resonance at this frequency.
    #[error(
        "at {hz} Hz the undamped structure is in resonance: its response is without bound (round-off times amplification is {uncertainty:.1e}); give it damping, or leave this frequency out"
    )]
    Resonance {
        /// The frequency, Hz.
        hz: f64,
        /// Share of a response that round-off may change.
        uncertainty: f64,
    },
    /// A constant force on what can move freely.
    #[error(
        "at 0 Hz the structure moves without bound: parts of it are held by nothing; hold them, or begin above 0 Hz"
    )]
    FreeAtRest,
    /// The iteration did not reach the solution.
    #[error(
        "at {hz} Hz the response to load {load} leaves a relative residual of {residual:.1e} after {iterations} iterations, where round-off explains {rounding:.1e}: the matrices are too ill-conditioned, or a part without damping is in resonance"
    )]
    NotSolved {
        /// The frequency, Hz.
        hz: f64,
        /// The load's column, from 0.
        load: usize,
        /// `|f - Z x| / |f|`.
        residual: f64,
        /// What round-off in `Z x` alone would leave.
        rounding: f64,
        /// Iterations made.
        iterations: usize,
    },
    /// Order, analysis, factorisation, or matrices that do not fit.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}
