//! Which vectors a basis has: fixed-interface modes by number, by frequency, or as few as an error allows; with
//! residual vectors for the modes of the coupled structure if it is enhanced.

use super::interior_basis::{
    Attached, BasisChoice, BasisSize, corrected, coupled_modes, elastic, filled, modes, modes_to,
};
use super::smallest_basis::smallest_basis;
use super::{InteriorBasis, ReductionError, Substructure};
use crate::numerics::Watch;
use std::f64::consts::TAU;

/// Chooses a basis; `watch` is told of its stages.
///
/// # Errors
/// [`ReductionError::Refused`] for `Auto`; what the eigenvalue iteration reports.
pub fn choose_basis(
    substructure: &Substructure,
    choice: BasisChoice,
    attached: Option<Attached<'_>>,
    watch: &dyn Watch,
) -> Result<InteriorBasis, ReductionError> {
    match choice.size {
        BasisSize::Count(count) => {
            let count = count.min(substructure.interior_dof());
            let pairs = modes(substructure, count, watch)?;
            let fixed_interface = if choice.enhanced { count - count / 2 } else { count };
            let basis = InteriorBasis::of_modes(substructure, &pairs, fixed_interface);
            filled(substructure, basis, count, |basis, _| coupled_modes(substructure, basis, attached))
        }
        BasisSize::UpTo(hz) => up_to(substructure, choice, (hz, usize::MAX), attached, watch),
        BasisSize::AtMost(hz, numbers) => {
            let most = (numbers / substructure.interior_dof().max(1)).max(1);
            up_to(substructure, choice, (hz, most), attached, watch)
        }
        BasisSize::Auto(target) => smallest_basis(substructure, choice, target, attached, watch),
    }
}

/// Fixed-interface modes up to a frequency (Hz) and a number.
fn up_to(
    substructure: &Substructure,
    choice: BasisChoice,
    (hz, most): (f64, usize),
    attached: Option<Attached<'_>>,
    watch: &dyn Watch,
) -> Result<InteriorBasis, ReductionError> {
    let band = (TAU * choice.band_hz).powi(2);
    let (pairs, count) = modes_to(substructure, (TAU * hz).powi(2), 0, most, watch)?;
    watch.stage("residual vectors");
    let basis = InteriorBasis::of_modes(substructure, &pairs, count);
    let spectrum = coupled_modes(substructure, &basis, attached)?;
    let end = if choice.enhanced { spectrum.values.partition_point(|&value| value <= band) } else { 0 };
    corrected(substructure, &basis, &spectrum, elastic(&basis, &spectrum)..end)
}
