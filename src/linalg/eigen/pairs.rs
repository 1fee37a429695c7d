//! What is known of computed eigenpairs.

use super::super::DenseMatrix;
use super::super::count::CountCheck;

/// Where the time of an eigenvalue computation went, s. With several threads the count goes on beside the iteration.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EigenTimes {
    /// Ordering, permutation, symbolic analysis.
    pub order: f64,
    /// Numerical factorisation for the iteration.
    pub factor: f64,
    /// Iteration.
    pub iterate: f64,
    /// Factorisations that count eigenvalues.
    pub count: f64,
}

/// Eigenpairs of `K x = lambda M x`.
#[derive(Debug, Clone)]
pub struct EigenPairs {
    /// Eigenvalues lambda = (2 pi f)^2, 1/s^2, ascending.
    pub values: Vec<f64>,
    /// Eigenvectors [n x count], `x^T M x = 1`.
    pub vectors: DenseMatrix,
    /// `|K x - lambda M x| / (|K x| + |lambda - sigma| |M x|)` of every pair, sigma the shift.
    pub residuals: Vec<f64>,
    /// How far each eigenvalue may be from the true one of these matrices, 1/s^2.
    pub bounds: Vec<f64>,
    /// Part of the bound that is round-off of `x^T K x`, 1/s^2: an eigenvalue that is not larger is zero.
    pub rounding: Vec<f64>,
    /// Largest entry of `X^T M X - 1`.
    pub orthogonality: f64,
    /// Eigenvalues counted and found below a value: the proof that none is missing.
    pub count_check: CountCheck,
    /// Shift sigma of the factor that it was iterated with, 1/s^2.
    pub shift: f64,
    /// Where the time went.
    pub times: EigenTimes,
}

impl EigenPairs {
    pub(super) fn none(order: usize, below: f64) -> Self {
        Self {
            values: Vec::new(),
            vectors: DenseMatrix::zeros(order, 0),
            residuals: Vec::new(),
            bounds: Vec::new(),
            rounding: Vec::new(),
            orthogonality: 0.0,
            count_check: CountCheck {
                above: None,
                below,
                counted: 0,
                found: 0,
            },
            shift: 0.0,
            times: EigenTimes::default(),
        }
    }

    pub(super) fn drop_first(&mut self, dropped: usize) {
        for list in [
            &mut self.values,
            &mut self.residuals,
            &mut self.bounds,
            &mut self.rounding,
        ] {
            list.drain(..dropped);
        }
        self.vectors = self
            .vectors
            .subcols(dropped, self.vectors.ncols() - dropped)
            .to_owned();
    }
}
