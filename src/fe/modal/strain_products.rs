//! Strain energy of shapes, and between shapes, without the round-off of an assembled matrix.

use super::ModalError;
use super::element_work::{CHUNK, ElementWork, MAX_DOF};
use super::error::check_count;
use super::spring_rows::spring_rows;
use crate::fe::model::{HousingModel, ModelError};
use crate::numerics::linalg::DenseMatrix;
use rayon::prelude::*;

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
    let chunks: Vec<Result<DenseMatrix, ModelError>> = model
        .elements
        .list
        .par_chunks(CHUNK)
        .map(|elements| {
            let mut sum = DenseMatrix::zeros(count, count);
            let mut work = ElementWork::new();
            let mut moves = vec![[0.0; MAX_DOF]; count];
            let mut force = [0.0; MAX_DOF];
            for element in elements {
                work.load(model, element)?;
                for (mode, moves) in moves.iter_mut().enumerate() {
                    work.moves(model, element, shapes.col_as_slice(mode), moves);
                    work.take_rigid_out(model.dimension, moves);
                }
                for (b, own) in moves.iter().enumerate() {
                    work.force(own, &mut force);
                    for (a, other) in moves.iter().enumerate() {
                        let pairs = other.iter().zip(&force).take(work.dof());
                        sum[(a, b)] += pairs.map(|(u, f)| u * f).sum::<f64>();
                    }
                }
            }
            Ok(sum)
        })
        .collect();
    let mut total = DenseMatrix::zeros(count, count);
    for chunk in chunks {
        total += chunk?;
    }
    add_springs(&mut total, model, shapes);
    Ok(total)
}

fn add_springs(total: &mut DenseMatrix, model: &HousingModel, shapes: &DenseMatrix) {
    let (d, count) = (model.dimension, shapes.ncols());
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
}

#[cfg(test)]
#[path = "strain_products_tests.rs"]
mod tests;
