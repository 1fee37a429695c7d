//! Why a bearing is refused.

use std::fmt::Display;
use thiserror::Error;

/// Why a dimension, a material, a motion or a defect of a bearing is refused: a sentence with the value and its rule.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct BearingError(pub(super) String);

/// The refusal of a value that breaks its rule.
pub(super) fn refused<T>(name: impl Display, value: f64, rule: &str) -> Result<T, BearingError> {
    Err(BearingError(format!("{name} = {value} {rule}")))
}

/// Refuses a value that is not positive and finite.
///
/// # Errors
/// [`BearingError`] with its name.
pub(super) fn positive(name: impl Display, value: f64) -> Result<(), BearingError> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { refused(name, value, "must be positive and finite") }
}
