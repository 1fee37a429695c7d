//! Dense parts of sparse matrices, and small dense matrices that the reduction is made of.

use super::ReductionError;
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, symmetric_eigen};

/// A sparse matrix with all its zeros.
pub(super) fn dense(sparse: &SparseMatrix) -> DenseMatrix {
    columns_of(sparse, 0, sparse.cols())
}

/// Some columns of a sparse matrix with all their zeros.
pub(super) fn columns_of(sparse: &SparseMatrix, first: usize, width: usize) -> DenseMatrix {
    let mut full = DenseMatrix::zeros(sparse.rows(), width);
    add_columns(&mut full, sparse, first);
    full
}

/// Adds columns of a sparse matrix from `first` on.
pub(super) fn add_columns(to: &mut DenseMatrix, sparse: &SparseMatrix, first: usize) {
    for column in 0..to.ncols() {
        if let Some(entries) = sparse.outer_view(first + column) {
            for (row, &value) in entries.iter() {
                to[(row, column)] += value;
            }
        }
    }
}

/// A square matrix with these values on its diagonal.
pub(super) fn diagonal(values: &[f64]) -> DenseMatrix {
    DenseMatrix::from_fn(values.len(), values.len(), |row, column| if row == column { values[row] } else { 0.0 })
}

/// Some rows of a matrix.
pub(super) fn rows_of(a: &DenseMatrix, rows: &[usize]) -> DenseMatrix {
    DenseMatrix::from_fn(rows.len(), a.ncols(), |row, column| a[(rows[row], column)])
}

/// Combinations V of vectors with the Gram matrix G [n x n], `V^T G V = 1` [n x kept]. Those of which the squared length is
/// below `dependent` of the longest are left out.
pub(super) fn normalised(gram: &DenseMatrix, dependent: f64) -> Result<DenseMatrix, ReductionError> {
    let spectrum = symmetric_eigen(gram)?;
    let longest = spectrum.values.last().copied().unwrap_or(0.0);
    let values = spectrum.values.iter().enumerate();
    let kept: Vec<usize> = values.filter(|(_, value)| **value > dependent * longest).map(|(place, _)| place).collect();
    Ok(DenseMatrix::from_fn(gram.nrows(), kept.len(), |row, column| {
        spectrum.vectors[(row, kept[column])] / spectrum.values[kept[column]].sqrt()
    }))
}

/// `(A + A^T) / 2`.
pub(super) fn symmetric(a: &DenseMatrix) -> DenseMatrix {
    DenseMatrix::from_fn(a.nrows(), a.ncols(), |row, column| 0.5 * (a[(row, column)] + a[(column, row)]))
}
