//! Is a superelement what it says it is? Checks with relative limits: a healthy model in any units passes, a broken one
//! fails by name.

mod basis;
mod matrices;
mod rigid;

pub use rigid::RigidMotions;
use schemars::JsonSchema;
use serde::Serialize;

use super::{CraigBampton, InterfaceReduction, ReductionError, Superelement};
use crate::fe::assembly::SystemMatrices;

/// Which side of its limit a value should be on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub enum Bound {
    /// Good up to the limit.
    #[serde(rename = "at most")]
    AtMost,
    /// Good from the limit on.
    #[serde(rename = "at least")]
    AtLeast,
}

/// A check and its verdict.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Check {
    /// Short name.
    pub name: &'static str,
    /// What the value is.
    pub what: String,
    /// What was found, relative to what `what` says.
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// What passes.
    pub limit: f64,
    /// On which side of the limit.
    pub bound: Bound,
}

impl Check {
    /// A value that is good up to its limit.
    pub(crate) fn at_most(name: &'static str, what: impl Into<String>, value: f64, limit: f64) -> Self {
        Self { name, what: what.into(), value, limit, bound: Bound::AtMost }
    }

    /// A value that is good from its limit on.
    pub(crate) fn at_least(name: &'static str, what: impl Into<String>, value: f64, limit: f64) -> Self {
        Self { bound: Bound::AtLeast, ..Self::at_most(name, what, value, limit) }
    }

    /// Whether it passes; a value that is no number does not.
    pub fn ok(&self) -> bool {
        match self.bound {
            Bound::AtMost => self.value <= self.limit,
            Bound::AtLeast => self.value >= self.limit,
        }
    }
}

/// Checks of the matrices alone: they hold for a superelement from anywhere.
///
/// # Errors
/// What the dense eigenvalue solver reports.
pub(crate) fn check_matrices(element: &Superelement) -> Result<Vec<Check>, ReductionError> {
    matrices::checks(element)
}

/// All checks of a condensed housing against the matrices that it was condensed from.
///
/// # Errors
/// What the dense eigenvalue solver reports.
pub(crate) fn check_craig_bampton(
    condensed: &CraigBampton,
    matrices: &SystemMatrices,
    rigid: &RigidMotions,
    band_hz: f64,
) -> Result<Vec<Check>, ReductionError> {
    let mut checks = check_matrices(&condensed.superelement)?;
    checks.extend(basis::checks(condensed, matrices, band_hz));
    checks.extend(rigid.checks(condensed, None, matrices)?);
    Ok(checks)
}

/// Checks of a condensed housing on modes of its interface: all of [`check_craig_bampton`] that still hold. Static
/// response of the interface does not, and is not among them.
///
/// # Errors
/// What the dense eigenvalue solver reports.
pub(crate) fn check_interface_reduction(
    condensed: &CraigBampton,
    reduction: &InterfaceReduction,
    matrices: &SystemMatrices,
    rigid: &RigidMotions,
    band_hz: f64,
) -> Result<Vec<Check>, ReductionError> {
    let mut checks = check_matrices(&reduction.superelement)?;
    let of_basis = basis::checks(condensed, matrices, band_hz).into_iter();
    checks.extend(of_basis.filter(|check| check.name != basis::STATIC_INTERFACE));
    checks.extend(rigid.checks(condensed, Some(reduction), matrices)?);
    Ok(checks)
}

#[cfg(test)]
mod tests;
