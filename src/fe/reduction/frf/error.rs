//! What can go wrong in a frequency response.

use crate::numerics::linalg::LinalgError;
use thiserror::Error;

/// A frequency response that does not exist or cannot be computed, and why.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct FrfError(pub(super) String);

/// A linear algebra step failed.
impl From<LinalgError> for FrfError {
    fn from(error: LinalgError) -> Self {
        Self(error.to_string())
    }
}

/// A frequency below zero, infinite or not a number.
pub(super) fn wrong_frequency(hz: f64) -> FrfError {
    FrfError(format!("a frequency must be zero or more and finite, found {hz} Hz"))
}

/// Damping coefficients that are zero or more and finite, by their names.
pub(super) fn check_coefficients(coefficients: &[(&str, f64)]) -> Result<(), FrfError> {
    match coefficients.iter().find(|(_, value)| !(*value >= 0.0 && value.is_finite())) {
        Some((name, value)) => {
            Err(FrfError(format!("the damping coefficient {name} must be zero or more and finite, found {value}")))
        }
        None => Ok(()),
    }
}

/// A resonance without damping at this frequency.
pub(super) fn unbounded(hz: f64) -> FrfError {
    FrfError(format!(
        "at {hz} Hz the structure is in resonance without damping (at 0 Hz: it is held by nothing, or so softly that round-off hides it): its response is without bound; give it damping, or leave this frequency out"
    ))
}

/// Frequencies that are zero or more, finite and ascending.
pub(super) fn check_frequencies(frequencies_hz: &[f64]) -> Result<(), FrfError> {
    if let Some(&hz) = frequencies_hz.iter().find(|hz| !(**hz >= 0.0 && hz.is_finite())) {
        return Err(wrong_frequency(hz));
    }
    match frequencies_hz.windows(2).find(|pair| pair[1] <= pair[0]) {
        Some(pair) => Err(FrfError(format!("frequencies must ascend, found {} Hz after {} Hz", pair[1], pair[0]))),
        None => Ok(()),
    }
}
