//! Symmetric matrices over unknowns of which a few follow the others.
//!
//! With `u_d = g^T u` for a few followers d, a matrix over both becomes one over the others alone:
//!
//! ```text
//! | I |^T | A    B | | I   |
//! | g^T | | B^T  D | | g^T |  =  A + U S U^T,     U = [B, g],   S = | 0  I |   S^-1 = | -D  I |
//!                                                                   | I  D |          |  I  0 |
//! ```
//!
//! Where `g` is full on many unknowns, as for a mean over a surface, the sum has a dense block that a factorisation fills. It
//! is never formed. The factor of A and the small matrix `C = S^-1 + U^T A^-1 U` solve with it (Woodbury; Golub and Van
//! Loan, *Matrix Computations*, section 2.1.4), and count its eigenvalues: from the two Schur complements of
//! `[A, U; U^T, -S^-1]` and with p eigenvalues of `S^-1` of each sign, `negative(A + U S U^T) = negative(A) + positive(C) - p`
//! (Haynsworth, *Linear Algebra and its Applications* 1 (1968) 73-81).

use super::ordering::Ordering;
use super::{DenseMatrix, SparseMatrix, TripletBuilder, symmetric_eigen, transpose_times_dense};
use faer::prelude::*;
use faer::{MatMut, MatRef};
use std::sync::Arc;

/// Eigenvalue of the scaled matrix C beside the largest, below which it is singular.
const SINGULAR: f64 = 1e-14;

/// What followers add to a sparse matrix A [n x n].
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Followers {
    /// g [n x p]: how they follow.
    follow: Arc<SparseMatrix>,
    /// B [n x p].
    coupling: SparseMatrix,
    /// D [p x p].
    corner: DenseMatrix,
}

impl Followers {
    /// Followers by `g` and `B` [n x p], compressed columns, and a symmetric `D` [p x p].
    pub(crate) fn new(follow: Arc<SparseMatrix>, coupling: SparseMatrix, corner: DenseMatrix) -> Self {
        Self { follow, coupling, corner }
    }

    /// Their number p.
    fn count(&self) -> usize {
        self.corner.nrows()
    }

    /// The same with the rows in another order.
    pub(super) fn permuted(&self, ordering: &Ordering) -> Self {
        let permuted = |a: &SparseMatrix| {
            let mut rows = TripletBuilder::new(a.rows(), a.cols());
            for (column, entries) in a.outer_iterator().enumerate() {
                entries.iter().for_each(|(row, &value)| rows.add(ordering.place(row), column, value));
            }
            rows.build()
        };
        Self {
            follow: Arc::new(permuted(&self.follow)),
            coupling: permuted(&self.coupling),
            corner: self.corner.clone(),
        }
    }

    /// `self - sigma other` of the same followers.
    pub(super) fn shifted(&self, sigma: f64, other: &Self) -> Self {
        Self {
            follow: Arc::clone(&self.follow),
            coupling: &self.coupling + &other.coupling.map(|value| -sigma * value),
            corner: &self.corner - &other.corner * faer::Scale(sigma),
        }
    }

    /// Adds `(U S U^T) X` to `Y`, both [n x k].
    pub(super) fn add_times(&self, x: MatRef<'_, f64>, mut y: MatMut<'_, f64>) {
        for lane in 0..x.ncols() {
            let (x, mut y) = (x.col(lane), y.as_mut().col_mut(lane));
            let dot = |a: &SparseMatrix, column: usize| -> f64 {
                a.outer_view(column).map_or(0.0, |entries| entries.iter().map(|(row, &value)| value * x[row]).sum())
            };
            let followed: Vec<f64> = (0..self.count()).map(|column| dot(&self.follow, column)).collect();
            for column in 0..self.count() {
                let corner: f64 = followed.iter().enumerate().map(|(k, x)| self.corner[(column, k)] * x).sum();
                let force = corner + dot(&self.coupling, column);
                for (a, factor) in [(&self.coupling, followed[column]), (&*self.follow, force)] {
                    let entries = a.outer_view(column);
                    entries
                        .iter()
                        .flat_map(|entries| entries.iter())
                        .for_each(|(row, &value)| y[row] += value * factor);
                }
            }
        }
    }

    /// Adds the diagonal of `U S U^T` to `diagonal` \[n\].
    pub(super) fn add_diagonal(&self, diagonal: &mut [f64]) {
        let by_row = self.follow.to_csr();
        for (column, entries) in self.coupling.outer_iterator().enumerate() {
            for (row, &value) in entries.iter() {
                diagonal[row] += 2.0 * value * by_row.get(row, column).copied().unwrap_or(0.0);
            }
        }
        for (row, entries) in by_row.outer_iterator().enumerate() {
            for (j, a) in entries.iter() {
                diagonal[row] += entries.iter().map(|(k, b)| a * self.corner[(j, k)] * b).sum::<f64>();
            }
        }
    }

    /// Sum of the squares of the terms `2 x_i B_ij u_j` and `u_j D_jk u_k` of `x^T A x` for one x \[n\]; entries of D
    /// beside the diagonal are one with their mirror images.
    pub(super) fn energy_scatter(&self, x: &[f64]) -> f64 {
        let sum_over = |a: &SparseMatrix, column: usize, term: &dyn Fn(usize, f64) -> f64| -> f64 {
            a.outer_view(column).map_or(0.0, |entries| entries.iter().map(|(row, &value)| term(row, value)).sum())
        };
        let squares: Vec<f64> = (0..self.count())
            .map(|column| sum_over(&self.follow, column, &|row, value| value * x[row]).powi(2))
            .collect();
        let of = |column: usize| {
            let coupling = 4.0 * sum_over(&self.coupling, column, &|row, value| (value * x[row]).powi(2));
            let corner = squares.iter().enumerate().map(|(other, square)| {
                let counted = if other == column { 1.0 } else { 2.0 };
                counted * self.corner[(column, other)].powi(2) * square
            });
            squares[column] * (coupling + corner.sum::<f64>())
        };
        (0..self.count()).map(of).sum()
    }

    /// `U S U^T` with all its zeros, added to `full` [n x n].
    pub(super) fn add_dense(&self, full: &mut DenseMatrix) {
        let unit = DenseMatrix::identity(full.nrows(), full.ncols());
        self.add_times(unit.as_ref(), full.as_mut());
    }

    /// What a solution with A lacks; `solve` overwrites a matrix by `A^-1` times it.
    pub(super) fn correction(&self, solve: impl Fn(MatMut<'_, f64>)) -> Correction {
        let (n, p) = (self.follow.rows(), self.count());
        let mut moved = DenseMatrix::zeros(n, 2 * p);
        for (first, a) in [(0, &self.coupling), (p, &*self.follow)] {
            for (column, entries) in a.outer_iterator().enumerate() {
                entries.iter().for_each(|(row, &value)| moved[(row, first + column)] = value);
            }
        }
        solve(moved.as_mut());
        let products = [&self.coupling, &*self.follow].map(|a| transpose_times_dense(a, &moved));
        // stiffness above, flexibility below: scaled to one size
        let size = (0..p).map(|k| self.corner[(k, k)].abs()).fold(0.0, f64::max).sqrt();
        let size = if size > 0.0 { size } else { 1.0 };
        let scale = |row: usize| if row < p { size.recip() } else { size };
        let entry = |row: usize, column: usize| {
            let of = |row: usize, column: usize| products[row / p][(row % p, column)];
            let inverse = match (row < p, column < p) {
                (true, true) => -self.corner[(row, column)],
                (false, false) => 0.0,
                _ => f64::from(u8::from(row % p == column % p)),
            };
            scale(row) * scale(column) * (inverse + 0.5 * (of(row, column) + of(column, row)))
        };
        let scaled = DenseMatrix::from_fn(2 * p, 2 * p, entry);
        let (values, vectors) = match symmetric_eigen(&scaled) {
            Ok(spectrum) => (spectrum.values, spectrum.vectors),
            Err(_) => (vec![f64::NAN; 2 * p], DenseMatrix::identity(2 * p, 2 * p)),
        };
        let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let regular = values.iter().all(|value| value.abs() > SINGULAR * largest);
        // C^-1 = Z diag(1 / values) Z^T with Z = scale vectors; one that does not exist makes solutions no numbers
        let z = DenseMatrix::from_fn(2 * p, 2 * p, |row, column| scale(row) * vectors[(row, column)]);
        let inverse = DenseMatrix::from_fn(2 * p, 2 * p, |row, column| {
            let terms = values.iter().enumerate().map(|(k, value)| z[(row, k)] * z[(column, k)] / value);
            if regular { terms.sum() } else { f64::NAN }
        });
        Correction {
            moved,
            inverse,
            sides: [Arc::new(self.coupling.clone()), Arc::clone(&self.follow)],
            positive: values.iter().filter(|value| **value > 0.0).count(),
        }
    }
}

/// `A^-1 U C^-1 U^T`, by which solutions with A are corrected.
#[derive(Debug)]
pub(super) struct Correction {
    /// `A^-1 U` [n x 2 p].
    moved: DenseMatrix,
    /// `C^-1` [2 p x 2 p].
    inverse: DenseMatrix,
    /// B and g [n x p].
    sides: [Arc<SparseMatrix>; 2],
    /// Positive eigenvalues of C.
    positive: usize,
}

impl Correction {
    /// Turns `Y = A^-1 R` [n x k] into the solution with the followers.
    pub(super) fn apply(&self, mut y: MatMut<'_, f64>) {
        for lane in 0..y.ncols() {
            let mut column = y.as_mut().col_mut(lane);
            let dots = self.sides.iter().flat_map(|side| side.outer_iterator());
            let dots: Vec<f64> =
                dots.map(|entries| entries.iter().map(|(row, &value)| value * column[row]).sum()).collect();
            for k in 0..self.moved.ncols() {
                let amplitude: f64 = dots.iter().enumerate().map(|(j, dot)| self.inverse[(k, j)] * dot).sum();
                for (entry, moved) in column.rb_mut().iter_mut().zip(self.moved.col_as_slice(k)) {
                    *entry -= amplitude * moved;
                }
            }
        }
    }

    /// Number of negative eigenvalues of the matrix with followers, where A alone has `alone`.
    pub(super) fn negative(&self, alone: usize) -> usize {
        (alone + self.positive).saturating_sub(self.moved.ncols() / 2)
    }
}

#[cfg(test)]
#[path = "followers_tests.rs"]
mod tests;
