//! All checks of a condensed housing.

use super::matrices::check_matrices;
use super::{Check, CraigBampton, InterfaceReduction, ReductionError, RigidMotions, basis};
use crate::fe::assembly::SystemMatrices;

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
