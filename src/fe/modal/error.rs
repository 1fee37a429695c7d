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
    /// Something that is not a finite number.
    #[error("{what} {index}: expected a finite number, found {value}")]
    NotFinite {
        /// What it is.
        what: &'static str,
        /// Which one, from 0.
        index: usize,
        /// What was found.
        value: f64,
    },
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
    /// An option out of its range.
    #[error("{name}: expected {expected}, found {found}")]
    Option {
        /// Its name.
        name: &'static str,
        /// Admissible range.
        expected: &'static str,
        /// What was found.
        found: f64,
    },
    /// Fewer meshes than an extrapolation needs.
    #[error("{found} meshes: an estimate of the discretisation error needs at least 2")]
    TooFewMeshes {
        /// Number of meshes.
        found: usize,
    },
    /// Two meshes of the same size.
    #[error("two meshes have sizes {finer:e} and {coarser:e}: expected them to differ by 1 % at least")]
    SameSize {
        /// Smaller size.
        finer: f64,
        /// Larger size.
        coarser: f64,
    },
}

/// Finite, or an error that names the first value that is not.
pub(super) fn check_finite<'a>(
    what: &'static str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), ModalError> {
    for (index, &value) in values.into_iter().enumerate() {
        if !value.is_finite() {
            return Err(ModalError::NotFinite { what, index, value });
        }
    }
    Ok(())
}

/// Equal, or an error with both numbers.
pub(super) fn check_count(what: &'static str, expected: usize, found: usize) -> Result<(), ModalError> {
    if expected == found {
        return Ok(());
    }
    Err(ModalError::Shape { what, expected, found })
}
