//! Modes of a housing without ring, free or supported.

use super::full_modes::FullModes;
use super::{ModalBasis, ModalError, ModeRange, strain_products};
use crate::fe::assembly::{CoupledMatrices, CoupledMotions, SystemMatrices};
use crate::fe::model::HousingModel;
use crate::numerics::Unwatched;
use crate::numerics::linalg::DenseMatrix;

/// Modes over the free degrees of freedom, those near zero by the energies of elements: the frequencies of `plummer modes`. Whether
/// the housing is held need not be said.
///
/// # Errors
/// [`ModalError`] of factorisation, iteration, proof or elements; [`ModalError::NoModes`] for a range without any.
pub fn housing_modes(
    model: &HousingModel,
    matrices: SystemMatrices,
    range: ModeRange,
) -> Result<ModalBasis, ModalError> {
    let matrices = CoupledMatrices::of_housing(matrices, model);
    let products = |motions: &CoupledMotions, all: &DenseMatrix| {
        strain_products(model, &motions.housing(model, all))
    };
    Ok(FullModes::sharpened(matrices, range, products, &Unwatched)?.basis)
}
