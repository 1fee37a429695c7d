//! Modes of a structure with everything that proves them.

use crate::linalg::{DenseMatrix, EigenPairs, EigenProblem, EigenTimes, LinalgError};
use std::f64::consts::TAU;

/// Error bounds below which an eigenvalue counts as zero: the bound itself is an estimate.
const ZERO: f64 = 4.0;

/// Which modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModeRange {
    /// The lowest so many, at least 1.
    Count(usize),
    /// All below a frequency, Hz.
    UpToHz(f64),
    /// All between two frequencies, Hz.
    BandHz([f64; 2]),
}

/// The proof that no mode is missing: Sylvester's law of inertia at one or two shifts.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct FrequencyCount {
    /// Frequency above which was counted, Hz; `None`: from zero.
    pub above_hz: Option<f64>,
    /// Frequency below which was counted, Hz.
    pub below_hz: f64,
    /// Modes that exist there, from the signs of the pivots of `K - sigma M`.
    pub counted: usize,
    /// Modes that were found there.
    pub found: usize,
}

/// Modes Phi of `K phi = lambda M phi`, mass-normalised, with what is known of their accuracy.
#[derive(Debug, Clone)]
pub struct ModalBasis {
    /// Eigenvalues lambda, 1/s^2, ascending.
    pub eigenvalues: Vec<f64>,
    /// Frequencies `sqrt(lambda) / 2 pi`, Hz; zero for an eigenvalue that round-off made negative.
    pub frequencies_hz: Vec<f64>,
    /// How far each frequency may be from that of the same matrices in exact arithmetic, Hz.
    pub error_bounds_hz: Vec<f64>,
    /// `|K phi - lambda M phi|` relative to its terms.
    pub residuals: Vec<f64>,
    /// Shapes [n x count], `Phi^T M Phi = 1`.
    pub shapes: DenseMatrix,
    /// Largest entry of `Phi^T M Phi - 1`.
    pub orthogonality: f64,
    /// Modes without strain energy: those whose energy `phi^T K phi = lambda` is zero within its error bound.
    pub rigid_modes: usize,
    /// The proof of completeness.
    pub count_check: FrequencyCount,
    /// Shift of the factorisation, 1/s^2.
    pub shift: f64,
    /// Where the time went.
    pub times: EigenTimes,
}

impl ModalBasis {
    /// The modes of a problem.
    ///
    /// # Errors
    /// [`LinalgError`] of factorisation, iteration or proof.
    pub fn of(problem: &EigenProblem, range: ModeRange) -> Result<Self, LinalgError> {
        let squared = |hz: f64| (TAU * hz).powi(2);
        let pairs = match range {
            ModeRange::Count(count) => problem.lowest(count),
            ModeRange::UpToHz(hz) => problem.below(squared(hz)),
            ModeRange::BandHz([low, high]) => problem.between(squared(low), squared(high)),
        }?;
        Ok(Self::new(pairs))
    }

    fn new(pairs: EigenPairs) -> Self {
        let hz = |value: f64| value.max(0.0).sqrt() / TAU;
        let zero = |(value, bound): &(&f64, &f64)| value.abs() <= ZERO * **bound;
        let check = pairs.count_check;
        Self {
            rigid_modes: pairs.values.iter().zip(&pairs.bounds).filter(zero).count(),
            frequencies_hz: pairs.values.iter().map(|&value| hz(value)).collect(),
            // the larger of both sides; near zero that is the square root of the bound
            error_bounds_hz: (pairs.values.iter().zip(&pairs.bounds))
                .map(|(&value, &bound)| {
                    let (low, high) = (hz(value - bound), hz(value + bound));
                    (high - hz(value)).max(hz(value) - low)
                })
                .collect(),
            eigenvalues: pairs.values,
            residuals: pairs.residuals,
            shapes: pairs.vectors,
            orthogonality: pairs.orthogonality,
            count_check: FrequencyCount {
                above_hz: check.above.map(hz),
                below_hz: hz(check.below),
                counted: check.counted,
                found: check.found,
            },
            shift: pairs.shift,
            times: pairs.times,
        }
    }

    /// Number of modes.
    pub fn count(&self) -> usize {
        self.eigenvalues.len()
    }
}
