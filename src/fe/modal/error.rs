//! What can be wrong with modes that are to be analysed.

use super::ModeRange;
use crate::fe::model::ModelError;
use crate::numerics::linalg::LinalgError;
use thiserror::Error;

/// Modes, matrices or frequencies that cannot be analysed.
#[derive(Debug, Error)]
pub enum ModalError {
    /// An element whose matrices cannot be computed.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A dense problem that failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// Matrices or lists that do not belong together.
    #[error("{what}: expected {expected}, found {found}")]
    Shape {
        /// What was counted.
        what: &'static str,
        /// Number expected.
        expected: usize,
        /// Number found.
        found: usize,
    },
    /// A value, an option or a list of meshes that makes no sense.
    #[error("{0}")]
    Invalid(String),
    /// A body without mass.
    #[error("the mass is {mass:e} kg: expected more than zero")]
    NoMass {
        /// Mass found, kg.
        mass: f64,
    },
    /// A range of frequencies without a mode.
    #[error(
        "modes: expected at least one mode {}, a count of eigenvalues finds none",
        range.words()
    )]
    NoModes {
        /// What was asked for.
        range: ModeRange,
    },
    /// More bodies than the search for mechanisms takes.
    #[error(
        "the mesh falls into {found} bodies that share no whole face; mechanisms are looked for among at most {limit}: are nodes doubled between the elements?"
    )]
    TooManyBodies {
        /// Number of bodies.
        found: usize,
        /// Largest number.
        limit: usize,
    },
    /// Two sets of modes with hardly a point in common.
    #[error(
        "only {matched} points of the two sets of modes coincide within {tolerance:.3e} m (first: {first} points, second: {second}): expected at least {least}; check units and frames"
    )]
    TooFewPoints {
        /// Number of common points.
        matched: usize,
        /// Fewest that are accepted.
        least: usize,
        /// Points of the first set.
        first: usize,
        /// Points of the second set.
        second: usize,
        /// Distance up to which points coincide, m.
        tolerance: f64,
    },
}

/// Finite, or an error that names the first value that is not.
pub(super) fn check_finite<'a>(
    what: &'static str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), ModalError> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((index, value)) => {
            Err(ModalError::Invalid(format!("{what} {index}: expected a finite number, found {value}")))
        }
        None => Ok(()),
    }
}

/// Valid, or an error that says what is.
pub(super) fn check_value(name: &str, expected: &str, found: f64, valid: bool) -> Result<(), ModalError> {
    match valid {
        true => Ok(()),
        false => Err(ModalError::Invalid(format!("{name}: expected {expected}, found {found}"))),
    }
}

/// Equal, or an error with both numbers.
pub(super) fn check_count(what: &'static str, expected: usize, found: usize) -> Result<(), ModalError> {
    if expected == found {
        return Ok(());
    }
    Err(ModalError::Shape { what, expected, found })
}
