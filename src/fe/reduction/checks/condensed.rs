//! All checks of a condensed housing.

use super::matrices::check_matrices;
use super::{Check, CraigBampton, InterfaceReduction, ReductionError, RigidMotions, basis};
use crate::fe::assembly::SystemMatrices;

/// All checks of a condensed housing against the matrices that it was condensed from; of one on modes of its interface, all that
/// still hold. Static response of the interface does not, and is not among them.
///
/// # Errors
/// What the dense eigenvalue solver reports.
pub(crate) fn check_craig_bampton(
    condensed: &CraigBampton,
    reduction: Option<&InterfaceReduction>,
    matrices: &SystemMatrices,
    rigid: &RigidMotions,
    band_hz: f64,
) -> Result<Vec<Check>, ReductionError> {
    let element = reduction.map_or(&condensed.superelement, |reduced| &reduced.superelement);
    let mut checks = check_matrices(element)?;
    let of_basis = basis::checks(condensed, matrices, band_hz).into_iter();
    checks.extend(of_basis.filter(|check| reduction.is_none() || check.name != basis::STATIC_INTERFACE));
    checks.extend(rigid.checks(condensed, reduction, matrices)?);
    Ok(checks)
}
