//! Strain energy of shapes, and between shapes, without the round-off of an assembled matrix.

use super::element_work::sum_over_elements;
use super::error::{ModalError, check_count};
use super::spring_rows::spring_rows;
use crate::fe::model::HousingModel;
use crate::numerics::linalg::DenseMatrix;

/// `Phi^T K Phi` [count x count] of shapes Phi [dof x count] over all degrees of freedom of a housing, tied nodes
/// filled in.
///
/// The sum of `phi_e^T K_e phi_e` over the elements, each without its rigid part, and of `k (row . phi)^2` over the
/// springs. An assembled K leaves `eps |K| |phi|^2` of a rigid motion, this the square of eps: what strains
/// nothing is told from what hangs on a support, however soft. In parallel; the result is the same to the bit for any
/// number of threads.
///
/// # Errors
/// [`ModalError::Shape`] for another number of rows, [`ModalError::Model`] with the tag of an element that is inverted
/// or degenerate.
pub fn strain_products(model: &HousingModel, shapes: &DenseMatrix) -> Result<DenseMatrix, ModalError> {
    check_count("rows of the modes", model.dof(), shapes.nrows())?;
    let count = shapes.ncols();
    let mut total = sum_over_elements(model, [count; 2], |work, _, element, sum| {
        let of_mode = |mode| work.strains(model, element, shapes.col_as_slice(mode));
        let moves: Vec<_> = (0..count).map(of_mode).collect();
        for (b, own) in moves.iter().enumerate() {
            let force = work.force(own);
            for (a, other) in moves.iter().enumerate() {
                sum[(a, b)] += work.work(other, &force);
            }
        }
    })?;
    let d = model.dimension;
    for spring in &model.springs {
        for row in spring_rows(&spring.matrix) {
            let stretch = |mode: usize| -> f64 {
                let shape = shapes.col_as_slice(mode);
                let entries = row.factors.iter().enumerate();
                entries.map(|(place, factor)| factor * shape[d * spring.nodes[place / d] + place % d]).sum()
            };
            let stretches: Vec<f64> = (0..count).map(stretch).collect();
            for (b, own) in stretches.iter().enumerate() {
                for (a, other) in stretches.iter().enumerate() {
                    total[(a, b)] += row.stiffness * own * other;
                }
            }
        }
    }
    Ok(total)
}

#[cfg(test)]
#[path = "strain_products_tests.rs"]
mod tests;
