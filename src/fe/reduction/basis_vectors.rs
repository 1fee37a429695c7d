//! The vectors that a basis is made of: fixed-interface modes, and residual vectors for modes of the coupled structure.
//!
//! A residual vector `K_ii^-1 r` is the static response of the interior to what a mode of the reduced structure lacks:
//! the residual flexibility of all modes left out, applied to the inertia that this mode puts on them. (Residual
//! flexibility: MacNeal, Computers and Structures 1 (1971) 581-601. Kim and Lee, International Journal for Numerical
//! Methods in Engineering 103 (2015) 79-93, fold it into the constraint modes instead, at no coordinate; that takes
//! m^-1 k of the reduced structure, whose highest eigenvalues drown the correction where a ring of beams is attached.)

use super::coupled_modes::interior_residuals;
use super::{InteriorBasis, ReductionError, Substructure};
use crate::numerics::linalg::{EigenPairs, SymmetricSpectrum};

/// How many vectors a basis has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BasisSize {
    /// So many.
    Count(usize),
    /// Fixed-interface modes up to a frequency, Hz.
    UpTo(f64),
    /// The same, but no more than have so many numbers: modes times degrees of freedom of the interior.
    AtMost(f64, usize),
    /// As few as keep the estimated relative error of the frequencies in the band below this.
    Auto(f64),
}

/// What is asked of a basis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasisChoice {
    /// Its size.
    pub size: BasisSize,
    /// Whether residual vectors are among it: of `Count` every second one, to `UpTo` one for each elastic mode of the
    /// coupled structure in the band.
    pub enhanced: bool,
    /// Top of the band of interest, Hz.
    pub band_hz: f64,
}

/// Modes computed at first when nobody says how many.
const FIRST_MODES: usize = 8;

/// A basis with residual vectors up to `count`; `modes_of` gives at least as many modes of the coupled structure beyond the
/// quasi-static ones as its second argument says, if there are.
pub(super) fn filled(
    substructure: &Substructure,
    mut basis: InteriorBasis,
    count: usize,
    modes_of: impl Fn(&InteriorBasis, usize) -> Result<SymmetricSpectrum, ReductionError>,
) -> Result<InteriorBasis, ReductionError> {
    // an interface of few coordinates has few residual vectors; those of the basis with them are further ones
    while basis.count() < count {
        let missing = count - basis.count();
        let spectrum = modes_of(&basis, missing)?;
        let elastic = elastic(&basis, &spectrum);
        let more = corrected(substructure, &basis, &spectrum, elastic..elastic + missing)?;
        if more.count() == basis.count() {
            break;
        }
        basis = more;
    }
    Ok(basis)
}

/// The lowest modes, and one more to say up to where they are complete.
pub(super) fn modes(substructure: &Substructure, count: usize) -> Result<EigenPairs, ReductionError> {
    substructure.lowest_modes((count + 1).min(substructure.interior_dof()))
}

/// Modes of which at least one and `beyond` more are above an eigenvalue, and how many are not; `most` of these at most.
pub(super) fn modes_to(
    substructure: &Substructure,
    value: f64,
    beyond: usize,
    most: usize,
) -> Result<(EigenPairs, usize), ReductionError> {
    let mut asked = FIRST_MODES + beyond;
    loop {
        let pairs = modes(substructure, asked)?;
        let below = pairs.values.partition_point(|&found| found <= value);
        if below > most {
            return Ok((pairs, most));
        }
        if below + beyond < pairs.values.len() || pairs.values.len() == substructure.interior_dof() {
            return Ok((pairs, below));
        }
        asked = (2 * asked).max(below + beyond);
        // beyond the most one more says up to where they are complete
        asked = asked.min(most.saturating_add(1 + beyond));
    }
}

/// How many modes of the coupled structure are quasi-static: those beyond are elastic.
pub(super) fn elastic(basis: &InteriorBasis, spectrum: &SymmetricSpectrum) -> usize {
    let limit = basis.quasi_static();
    spectrum.values.partition_point(|&value| value <= limit)
}

/// A basis with residual vectors of those of the chosen modes of the coupled structure that there are.
pub(super) fn corrected(
    substructure: &Substructure,
    basis: &InteriorBasis,
    spectrum: &SymmetricSpectrum,
    chosen: impl IntoIterator<Item = usize>,
) -> Result<InteriorBasis, ReductionError> {
    let mut chosen: Vec<usize> = chosen.into_iter().collect();
    chosen.retain(|&mode| spectrum.values.get(mode).is_some_and(|value| value.is_finite()));
    if chosen.is_empty() {
        return Ok(basis.clone());
    }
    let residual = interior_residuals(substructure, basis, spectrum, &chosen);
    basis.extended(substructure, substructure.solve_interior(residual)?)
}
