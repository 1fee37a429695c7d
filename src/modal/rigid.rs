//! Rigid modes, recognised by their energy.

use super::ModalError;
use super::error::check_count;
use crate::linalg::{DenseMatrix, SparseMatrix};
use rayon::prelude::*;

/// Ratio of strain energies below which a mode counts as rigid beside the next one: frequencies
/// 1e-5 apart. Round-off leaves 1e-14 and less, the softest support in use 1e-6 and more.
const ENERGY_RATIO: f64 = 1e-10;

/// Number of rigid modes among ascending eigenvalues (1/s^2): those whose strain energy at unit
/// kinetic energy vanishes beside that of the first mode after them. Three in the plane, six in space, more for
/// parts that are not connected and for mechanisms.
///
/// Needs an elastic mode after the rigid ones; with the matrix at hand [`rigid_modes`] does not.
pub fn rigid_mode_count(eigenvalues: &[f64]) -> usize {
    let rigid = |count: &usize| {
        let below = eigenvalues[..*count]
            .iter()
            .fold(0.0_f64, |largest, value| largest.max(value.abs()));
        eigenvalues
            .get(*count)
            .is_some_and(|&next| below < ENERGY_RATIO * next)
    };
    (1..=eigenvalues.len()).rfind(rigid).unwrap_or(0)
}

/// Largest energy of a rigid mode in units of round-off, `|phi^T K phi| / (eps sum_ij |phi_i| |K_ij| |phi_j|)`.
///
/// Measured on rigid motions and computed rigid modes of blocks of 8 to 4096 Hex8 cells: at most 0.4.
const ROUND_OFFS: f64 = 16.0;

/// Twice the strain energy of a mode, and the size of the terms that form it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModeEnergy {
    /// `phi^T K phi`; 1/s^2 for a mass-normalised mode, then its eigenvalue.
    pub doubled: f64,
    /// `sum_ij |phi_i| |K_ij| |phi_j|`, the same unit: round-off in `doubled` is about eps of it.
    pub terms: f64,
}

impl ModeEnergy {
    /// Whether the energy is no more than the round-off of its terms: a motion of the whole, of a loose part or of
    /// a mechanism. Neither a scale of the frequency nor an elastic mode beside it is needed.
    ///
    /// A mode on springs is told from a rigid one as long as its energy is above 3.6e-15 (16 eps) of its terms. A
    /// spring at one of n nodes leaves about 1.5 / n of its stiffness over K's diagonal (measured: 1e-12 of the
    /// diagonal at one of 60 nodes gives 115 eps), so that the softest one that counts is 2.4e-15 n of the
    /// diagonal: 2e-9 for a million nodes.
    pub fn is_rigid(&self) -> bool {
        self.doubled.abs() <= ROUND_OFFS * f64::EPSILON * self.terms
    }
}

/// Energies of modes Phi [dof x count] in a stiffness K [dof x dof].
///
/// # Errors
/// [`ModalError::Shape`] if the numbers of rows differ.
pub fn mode_energies(
    k: &SparseMatrix,
    shapes: &DenseMatrix,
) -> Result<Vec<ModeEnergy>, ModalError> {
    check_count("columns of the stiffness matrix", k.rows(), k.cols())?;
    check_count("rows of the modes", k.rows(), shapes.nrows())?;
    let energy = |mode: usize| {
        let (mut doubled, mut terms) = (0.0, 0.0);
        let shape = shapes.col_as_slice(mode);
        for (entries, own) in k.outer_iterator().zip(shape) {
            let (mut force, mut size) = (0.0, 0.0);
            for (row, &value) in entries.iter() {
                let part = value * shape[row];
                force += part;
                size += part.abs();
            }
            doubled += own * force;
            terms += own.abs() * size;
        }
        ModeEnergy { doubled, terms }
    };
    // a thread sums a whole mode: the result does not depend on how many there are
    Ok((0..shapes.ncols()).into_par_iter().map(energy).collect())
}

/// Number of rigid modes among Phi [dof x count]: those whose strain energy in K [dof x dof] is round-off
/// ([`ModeEnergy::is_rigid`]).
///
/// # Errors
/// As [`mode_energies`].
pub fn rigid_modes(k: &SparseMatrix, shapes: &DenseMatrix) -> Result<usize, ModalError> {
    let energies = mode_energies(k, shapes)?;
    Ok(energies.iter().filter(|energy| energy.is_rigid()).count())
}

#[cfg(test)]
#[path = "rigid_tests.rs"]
mod tests;
