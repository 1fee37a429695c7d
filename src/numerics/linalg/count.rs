//! How many eigenvalues lie below a value: Sylvester's law of inertia.

use super::LinalgError;
use super::factor::{Factor, FactorMemory};
use super::numeric::Kind;
use super::symbolic::Symbolic;
use super::symmetric::SymmetricMatrix;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Where in a gap eigenvalues are counted, one place after the other until the factor is good.
const PLACES: [f64; 5] = [0.5, 0.41, 0.59, 0.32, 0.68];

/// Eigenvalues below a value: how many there are, and how many were found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CountCheck {
    /// Value above which it was counted, 1/s^2; `None`: from the lowest.
    pub above: Option<f64>,
    /// Value below which it was counted, 1/s^2.
    pub below: f64,
    /// Eigenvalues below it, from the inertia of `K - below M`.
    pub counted: usize,
    /// Eigenvalues below it that were found.
    pub found: usize,
}

impl CountCheck {
    /// The error of a count that does not agree.
    pub(super) fn missing(self) -> LinalgError {
        LinalgError::MissingModes {
            below_hz: self.below.max(0.0).sqrt() / TAU,
            counted: self.counted,
            found: self.found,
        }
    }
}

/// Number of eigenvalues of `K x = lambda M x` below `value`; `symbolic` is the analysis of their common pattern.
///
/// # Errors
/// [`LinalgError::NearlySingular`] if `value` is an eigenvalue, or [`LinalgError::Factorisation`].
pub(super) fn count_below(
    symbolic: &Arc<Symbolic>,
    stiffness: &SymmetricMatrix,
    mass: &SymmetricMatrix,
    value: f64,
    memory: FactorMemory,
) -> Result<usize, LinalgError> {
    let shifted = stiffness.shifted(value, mass);
    Ok(Factor::new(symbolic, &shifted, Kind::Indefinite, memory)?.negative())
}

/// Counts somewhere between `low` and `high`, between which no eigenvalue is known; the place is moved when the
/// factor says that it sits on one.
///
/// # Errors
/// As [`count_below`], of the last place tried.
pub(super) fn count_between(
    symbolic: &Arc<Symbolic>,
    stiffness: &SymmetricMatrix,
    mass: &SymmetricMatrix,
    [low, high]: [f64; 2],
    mut memory: FactorMemory,
) -> Result<(f64, usize), LinalgError> {
    let mut failed = None;
    for place in PLACES {
        let value = low + place * (high - low);
        match count_below(symbolic, stiffness, mass, value, std::mem::take(&mut memory)) {
            Ok(counted) => return Ok((value, counted)),
            Err(error @ LinalgError::NearlySingular { .. }) => failed = Some(error),
            Err(error) => return Err(error),
        }
    }
    Err(failed.unwrap_or(LinalgError::NearlySingular { order: stiffness.order(), contraction: f64::INFINITY }))
}
