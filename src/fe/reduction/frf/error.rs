//! What can go wrong in a frequency response.

use crate::numerics::linalg::LinalgError;
use thiserror::Error;

/// A frequency response that does not exist or cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FrfError {
    /// Matrices that do not fit together.
    #[error("{what}: expected {expected}, found {found}")]
    Shape {
        /// Which operand, and what of it is counted.
        what: &'static str,
        /// The number expected.
        expected: usize,
        /// The number found.
        found: usize,
    },
    /// A frequency below zero, infinite or not a number.
    #[error("a frequency must be zero or more and finite, found {hz} Hz")]
    Frequency {
        /// The frequency, Hz.
        hz: f64,
    },
    /// Frequencies that do not ascend.
    #[error("frequencies must ascend, found {next} Hz after {hz} Hz")]
    Order {
        /// A frequency, Hz.
        hz: f64,
        /// The one after it, Hz.
        next: f64,
    },
    /// A band without width, or out of range.
    #[error("a band goes from a frequency of zero or more to a higher one, found {low} Hz to {high} Hz")]
    Band {
        /// Its lower end, Hz.
        low: f64,
        /// Its upper end, Hz.
        high: f64,
    },
    /// A band of which a part was not computed.
    #[error("the band {low} Hz to {high} Hz is not covered by the response, which goes from {first} Hz to {last} Hz")]
    NotCovered {
        /// The band's lower end, Hz.
        low: f64,
        /// The band's upper end, Hz.
        high: f64,
        /// First frequency computed, Hz.
        first: f64,
        /// Last frequency computed, Hz.
        last: f64,
    },
    /// A number of points that makes no list.
    #[error("{what} must be {rule}, found {value}")]
    Grid {
        /// Which number.
        what: &'static str,
        /// What it must be.
        rule: &'static str,
        /// The value found.
        value: f64,
    },
    /// A resonance without damping at this frequency.
    #[error(
        "at {hz} Hz the structure is in resonance without damping (at 0 Hz: it is held by nothing, or so softly that round-off hides it): its response is without bound; give it damping, or leave this frequency out"
    )]
    Unbounded {
        /// The frequency, Hz.
        hz: f64,
    },
    /// More modes asked for than there are.
    #[error("{asked} modes asked for, but the system has only {available} with mass")]
    TooManyModes {
        /// Number asked for.
        asked: usize,
        /// Number there.
        available: usize,
    },
    /// A damping ratio out of range.
    #[error("a damping ratio must be zero or more and below 1, found {ratio}")]
    Ratio {
        /// The value found.
        ratio: f64,
    },
    /// A damping coefficient that drives, or is no number.
    #[error("the damping coefficient {name} must be zero or more and finite, found {value}")]
    Coefficient {
        /// Which.
        name: &'static str,
        /// The value found.
        value: f64,
    },
    /// A list of damping ratios without an entry.
    #[error("damping ratios over frequency need at least one point")]
    NoPoints,
    /// A path that is not there.
    #[error("{what} {index} asked for, there are {count}")]
    NoSuchPath {
        /// Sensor or load.
        what: &'static str,
        /// Its index, from 0.
        index: usize,
        /// Number there.
        count: usize,
    },
    /// A linear algebra step failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}

/// Frequencies that are zero or more, finite and ascending.
pub(super) fn check_frequencies(frequencies_hz: &[f64]) -> Result<(), FrfError> {
    if let Some(&hz) = frequencies_hz.iter().find(|hz| !(**hz >= 0.0 && hz.is_finite())) {
        return Err(FrfError::Frequency { hz });
    }
    match frequencies_hz.windows(2).find(|pair| pair[1] <= pair[0]) {
        Some(pair) => Err(FrfError::Order { hz: pair[0], next: pair[1] }),
        None => Ok(()),
    }
}
