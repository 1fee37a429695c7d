//! The smallest basis of which the estimated error in a band is below a target.

use super::interior_basis::{Attached, BasisChoice, coupled_modes, modes, modes_to};
use super::{ErrorEstimate, InteriorBasis, ReductionError, Substructure, interior_basis};
use crate::numerics::Watch;
use crate::numerics::linalg::SymmetricSpectrum;
use std::f64::consts::TAU;

/// Modes looked at beyond those in the band before it is decided.
const BEYOND: usize = 8;

/// How often a basis is enlarged that turns out too small.
const ENLARGEMENTS: usize = 12;

/// Modes below the band are always in it: they resonate whatever is attached. Beyond them an enhanced basis takes a
/// residual vector for every mode of the coupled structure whose error is too large, or further fixed-interface modes
/// where fewer of them serve; a plain basis takes further modes alone. Errors of all sizes follow from those of the
/// largest, see [`growth`]; the estimate of the chosen basis itself decides.
pub(super) fn smallest_basis(
    substructure: &Substructure,
    choice: BasisChoice,
    target: f64,
    attached: Option<Attached<'_>>,
    watch: &dyn Watch,
) -> Result<InteriorBasis, ReductionError> {
    let all = substructure.interior_dof();
    let (mut pairs, in_band) = modes_to(substructure, (TAU * choice.band_hz).powi(2), BEYOND, usize::MAX, watch)?;
    let mut reached = f64::INFINITY;
    let mut least = in_band;
    for _ in 0..ENLARGEMENTS {
        watch.stage("estimate");
        let count = if pairs.values.len() == all { all } else { pairs.values.len() - 1 };
        let largest = InteriorBasis::of_modes(substructure, &pairs, count);
        let estimate = ErrorEstimate::of(substructure, &largest, attached, choice.band_hz)?;
        let spectrum = coupled_modes(substructure, &largest, attached)?;
        let size = smallest_size(&largest, &spectrum, &estimate, least, target, choice.enhanced);
        if let Some((modes_kept, residuals)) = size {
            let basis = InteriorBasis::of_modes(substructure, &pairs, modes_kept);
            let (basis, error) = corrected(substructure, choice, target, attached, (basis, residuals))?;
            if error <= target {
                return Ok(basis);
            }
            reached = error;
            // the forecast was too good by a little
            least = modes_kept + 1;
        } else {
            reached = estimate.largest();
            least = count;
        }
        if count == all {
            break;
        }
        if least >= count {
            pairs = modes(substructure, 2 * count, watch)?;
        }
    }
    Err(ReductionError::Refused(format!(
        "no basis of up to {least} vectors brings the estimated error in the band to {} Hz below {target}: {reached:.1e} was reached",
        choice.band_hz
    )))
}

/// Number of modes, and the modes of the coupled structure that need a residual vector, for the smallest sum; `None`
/// if a plain basis needs more modes than are known.
fn smallest_size(
    largest: &InteriorBasis,
    spectrum: &SymmetricSpectrum,
    estimate: &ErrorEstimate,
    least: usize,
    target: f64,
    enhanced: bool,
) -> Option<(usize, Vec<usize>)> {
    let quasi_static = largest.quasi_static();
    let too_large = |count: usize| -> Vec<usize> {
        let is_too_large = |&place: &usize| {
            // the error of a mode that moves may be zero now and grow
            let error = estimate.modes[place].relative_error;
            spectrum.values[place] > quasi_static && error + growth(largest, spectrum, place, count) > target
        };
        (0..estimate.modes.len()).filter(is_too_large).collect()
    };
    let mut sizes = (least.min(largest.count())..=largest.count()).map(|count| (count, too_large(count)));
    match enhanced {
        true => sizes.min_by_key(|(count, residuals)| count + residuals.len()),
        false => sizes.find(|(_, residuals)| residuals.is_empty()),
    }
}

/// How much the relative error of a mode grows when only the first `count` fixed-interface modes are kept:
///
/// ```text
/// (f~ - f) / f = lambda / 2 sum_d (p_d . u_b)^2 / (lambda_d - lambda)
/// ```
///
/// over the modes left out, p_d = phi_d^T A, u_b the mode at the interface, `x^T m x = 1`. (From the dynamic stiffness
/// of the interface, lambda^2 sum_d p_d p_d^T / (lambda_d - lambda), to first order.)
fn growth(largest: &InteriorBasis, spectrum: &SymmetricSpectrum, mode: usize, count: usize) -> f64 {
    let (lambda, p) = (spectrum.values[mode], &largest.participation);
    let share = |left_out: usize| {
        let push: f64 = (0..p.ncols()).map(|column| p[(left_out, column)] * spectrum.vectors[(column, mode)]).sum();
        let distance = largest.values()[left_out] - lambda;
        if distance > 0.0 { 0.5 * lambda * push * push / distance } else { f64::INFINITY }
    };
    (count..largest.count()).map(share).sum()
}

/// The basis with its residual vectors, and its estimated error; with further ones where these do not suffice.
fn corrected(
    substructure: &Substructure,
    choice: BasisChoice,
    target: f64,
    attached: Option<Attached<'_>>,
    (mut basis, mut residuals): (InteriorBasis, Vec<usize>),
) -> Result<(InteriorBasis, f64), ReductionError> {
    let mut rounds = 0;
    loop {
        let before = basis.count();
        let spectrum = coupled_modes(substructure, &basis, attached)?;
        basis = interior_basis::corrected(substructure, &basis, &spectrum, residuals)?;
        let estimate = ErrorEstimate::of(substructure, &basis, attached, choice.band_hz)?;
        let error = estimate.largest();
        let stuck = basis.count() == before && before > 0;
        rounds += 1;
        if error <= target || !choice.enhanced || stuck || rounds == ENLARGEMENTS {
            return Ok((basis, error));
        }
        let modes = estimate.modes.iter().enumerate();
        residuals = modes.filter(|(_, mode)| mode.relative_error > target).map(|(place, _)| place).collect();
    }
}
