//! Modes of a housing without ring, free or supported, by shift-invert ARPACK.

use crate::assembly::SystemMatrices;
use crate::linalg::{EigenOptions, LinalgError, SparseCholesky, lowest_eigenpairs, submatrix};
use std::f64::consts::TAU;

/// Lowest modes of a housing.
#[derive(Debug, Clone, PartialEq)]
pub struct HousingModes {
    /// Eigenvalues, 1/s^2, ascending.
    pub eigenvalues: Vec<f64>,
    /// Frequencies, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Relative residual of each pair.
    pub residuals: Vec<f64>,
}

/// The `count` lowest modes over the free degrees of freedom.
///
/// The shift is a little below zero, 1e-4 of the smallest `K_ii / M_ii`, so that free and supported
/// housings are factorised alike: `K + |sigma| M` is positive definite for both.
///
/// # Errors
/// [`LinalgError`] of factorisation or iteration.
pub fn housing_modes(
    matrices: &SystemMatrices,
    free_dofs: &[usize],
    count: usize,
) -> Result<HousingModes, LinalgError> {
    let k = submatrix(&matrices.stiffness, free_dofs, free_dofs);
    let m = submatrix(&matrices.mass, free_dofs, free_dofs);
    let diagonal = |a: &crate::linalg::SparseMatrix, i| a.get(i, i).copied().unwrap_or(0.0);
    let smallest = (0..free_dofs.len())
        .map(|i| diagonal(&k, i) / diagonal(&m, i))
        .filter(|ratio| ratio.is_finite() && *ratio > 0.0)
        .fold(f64::INFINITY, f64::min);
    let shift = if smallest.is_finite() {
        -1e-4 * smallest
    } else {
        -1.0
    };
    let shifted = &k + &m.map(|value| -shift * value);
    let factor = SparseCholesky::new(&shifted)?;
    let pairs = lowest_eigenpairs(&k, &m, &factor, EigenOptions { count, shift })?;
    Ok(HousingModes {
        frequencies_hz: pairs
            .values
            .iter()
            .map(|value| value.max(0.0).sqrt() / TAU)
            .collect(),
        eigenvalues: pairs.values,
        residuals: pairs.residuals,
    })
}
