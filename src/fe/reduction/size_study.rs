//! Error against size: what a coordinate more buys, by plain fixed-interface modes, with residual vectors, and with modes of
//! the interface in place of the interface itself.

use super::coupled_lowest::CoupledProblem;
use super::interior_basis::{filled, modes, with_amplitudes};
use super::parts::diagonal;
use super::{CharacteristicModes, InteriorBasis, ReductionError, Substructure};
use crate::numerics::Watch;
use crate::numerics::linalg::{DenseMatrix, symmetric_generalised_eigen};
use schemars::JsonSchema;
use serde::Serialize;

/// Sizes that are tried.
const SIZES: [usize; 10] = [4, 8, 12, 16, 24, 32, 40, 52, 64, 80];

/// Errors of reductions of one size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct SizeErrors {
    /// Coordinates: vectors of the interior beside the whole interface, or these and modes of the interface.
    pub size: usize,
    /// Largest relative error of a frequency with fixed-interface modes and the whole interface; `None` of too few
    /// coordinates to have all these frequencies.
    pub plain: Option<f64>,
    /// With residual vectors among them.
    pub enhanced: Option<f64>,
    /// With a reduced interface.
    #[serde(rename = "interface_reduced")]
    pub reduced: Option<ReducedSize>,
}

/// The best split of so many coordinates between interface and interior, of those tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ReducedSize {
    /// Largest relative error of a frequency.
    pub error: f64,
    /// Modes of the interface.
    pub interface_modes: usize,
    /// Fixed-interface modes.
    pub fixed_interface_modes: usize,
    /// Residual vectors.
    pub residual_vectors: usize,
}

/// Errors of reductions of some sizes against the frequencies of the full model, Hz, ascending, of which the first `rigid`
/// are not judged; `interface` are the modes of the interface with what is attached. Half of the vectors of an enhanced
/// basis are residual vectors. Splits tried have none or as many vectors of the interior as one of the smaller sizes, plain
/// or enhanced.
///
/// # Errors
/// What the eigenvalue solvers report.
pub(crate) fn size_study(
    substructure: &Substructure,
    interface: &CharacteristicModes,
    full_hz: &[f64],
    rigid: usize,
    watch: &dyn Watch,
) -> Result<Vec<SizeErrors>, ReductionError> {
    let largest = SIZES[SIZES.len() - 1];
    let pairs = modes(substructure, largest, watch)?;
    let available = pairs.values.len();
    let error = |values: &[f64]| largest_error(values, full_hz, rigid);
    let whole = CoupledProblem::new(interface);
    let of_whole = |basis: &InteriorBasis| -> Result<Option<f64>, ReductionError> {
        Ok(error(&whole.lowest(basis, full_hz.len())?.values))
    };
    let first_modes = interface.vectors.subcols(0, largest.min(interface.count())).to_owned();
    // rigid motions have exactly none: round-off in its place would not be positive
    let stiffness = diagonal(&interface.values[..first_modes.ncols()]);
    // squared frequencies on the first modes of the interface and a basis of the interior
    let on_modes = |basis: &InteriorBasis, kept: usize| -> Result<Vec<f64>, ReductionError> {
        let driven = &basis.participation * first_modes.subcols(0, kept);
        let unit = DenseMatrix::identity(kept, kept);
        let own = [stiffness.submatrix(0, 0, kept, kept), unit.as_ref()];
        let [k, m] = with_amplitudes(own, basis, driven.as_ref());
        Ok(symmetric_generalised_eigen(&k, &m)?.values)
    };
    let mut bases = vec![InteriorBasis::of_modes(substructure, &pairs, 0)];
    let mut rows = Vec::new();
    watch.stage("sizes");
    for size in SIZES.into_iter().filter(|&size| size <= available) {
        watch.fraction(rows.len() as f64 / SIZES.len() as f64);
        let plain = InteriorBasis::of_modes(substructure, &pairs, size);
        let half = InteriorBasis::of_modes(substructure, &pairs, size - size / 2);
        let enhanced = filled(substructure, half, size, |basis, missing| whole.lowest(basis, rigid + missing))?;
        let mut best: Option<ReducedSize> = None;
        for basis in &bases {
            let kept = size - basis.count();
            // rigid motions have no stiffness; without them all no frequency is judged
            if kept > interface.count() || kept < interface.rigid || size == interface.rigid {
                continue;
            }
            let found = error(&on_modes(basis, kept)?);
            if let Some(found) = found.filter(|found| best.is_none_or(|best| *found < best.error)) {
                best = Some(ReducedSize {
                    error: found,
                    interface_modes: kept,
                    fixed_interface_modes: basis.count() - basis.residual_vectors,
                    residual_vectors: basis.residual_vectors,
                });
            }
        }
        rows.push(SizeErrors { size, plain: of_whole(&plain)?, enhanced: of_whole(&enhanced)?, reduced: best });
        bases.extend([plain, enhanced]);
    }
    Ok(rows)
}

/// Largest relative error of the frequencies beyond the rigid ones.
fn largest_error(values: &[f64], full_hz: &[f64], rigid: usize) -> Option<f64> {
    let judged = values.get(..full_hz.len())?.iter().zip(full_hz).skip(rigid);
    let error = |(value, hz): (&f64, &f64)| (value.max(0.0).sqrt() / std::f64::consts::TAU / hz - 1.0).abs();
    let largest = judged.map(error).fold(0.0, f64::max);
    largest.is_finite().then_some(largest)
}

#[cfg(test)]
#[path = "size_study_tests.rs"]
mod tests;
