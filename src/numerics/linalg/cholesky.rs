//! Sparse Cholesky factorisation `P A P^T = L L^T` (multifrontal, nested dissection).

use super::factor::LARGEST_CONTRACTION;
use super::{DenseMatrix, Factor, FactorMemory, Kind, LinalgError, Ordering, Plan, SparseMatrix, SymmetricMatrix};
use std::sync::Arc;

/// Factor of a symmetric positive definite sparse matrix in double precision; serves any number of right-hand sides.
#[derive(Debug, Clone)]
pub struct SparseCholesky {
    ordering: Arc<Ordering>,
    factor: Arc<Factor>,
}

impl SparseCholesky {
    /// Factorises `a` [n x n], symmetric, both triangles stored.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] with the row of `a` at which it stopped, [`LinalgError::IllConditioned`] for a
    /// matrix of which round-off leaves not one digit to solve with, or [`LinalgError::Factorisation`].
    pub fn new(a: &SparseMatrix) -> Result<Self, LinalgError> {
        let (expected, found) = (a.rows(), a.cols());
        if found != expected || !a.is_csc() {
            let what = "matrix to factorise (square, compressed columns)";
            return Err(LinalgError::Shape { what, expected, found });
        }
        let ordering = Arc::new(Ordering::of(a)?);
        Self::of_permuted(&SymmetricMatrix::permuted(a, &ordering), ordering)
    }

    /// Factorises a matrix that is in this order already.
    ///
    /// # Errors
    /// As [`SparseCholesky::new`].
    pub(super) fn of_permuted(permuted: &SymmetricMatrix, ordering: Arc<Ordering>) -> Result<Self, LinalgError> {
        let plan = Arc::new(Plan::of(permuted)?);
        let row = |place: usize| ordering.old.get(place).map_or(0, |&row| row as usize);
        let memory = FactorMemory::default();
        let factor = Factor::unjudged(&plan, permuted, Kind::Definite, true, memory);
        let factor = factor.map_err(|error| match error {
            LinalgError::NotPositiveDefinite { order, pivot } => {
                LinalgError::NotPositiveDefinite { order, pivot: row(pivot) }
            }
            other => other,
        })?;
        if factor.contraction > LARGEST_CONTRACTION {
            return Err(LinalgError::IllConditioned {
                order: permuted.order(),
                row: row(factor.weakest),
                contraction: factor.contraction,
                limit: LARGEST_CONTRACTION,
            });
        }
        Ok(Self { factor: Arc::new(factor), ordering })
    }

    /// Number of rows of the factorised matrix.
    pub fn order(&self) -> usize {
        self.ordering.old.len()
    }

    /// Relative error that round-off leaves in a solution, estimated: the factor by which iterative refinement would reduce
    /// it. The lowest eigenvalues are right to as much, frequencies to half of it.
    pub(crate) fn contraction(&self) -> f64 {
        self.factor.contraction
    }

    /// Row of the matrix in which round-off is felt most.
    pub(crate) fn weakest_row(&self) -> usize {
        let place = self.ordering.old.get(self.factor.weakest);
        place.map_or(0, |&row| row as usize)
    }

    /// The factor, for an eigenvalue problem with the same matrix.
    pub(super) fn factor(&self) -> Arc<Factor> {
        Arc::clone(&self.factor)
    }

    /// Solves `A x = b` for one right-hand side of length n, in place.
    ///
    /// # Errors
    /// As [`SparseCholesky::solve_columns`].
    pub fn solve_vector(&self, right_hand_side: &mut [f64]) -> Result<(), LinalgError> {
        let mut column = DenseMatrix::from_fn(right_hand_side.len(), 1, |row, _| right_hand_side[row]);
        self.solve_columns(&mut column)?;
        right_hand_side.copy_from_slice(column.col_as_slice(0));
        Ok(())
    }

    /// Solves `A X = B` for all columns of `B` [n x k] at once, in place.
    ///
    /// # Errors
    /// [`LinalgError::Shape`] if `B` has not n rows, [`LinalgError::Library`] if the library that has the factor fails.
    pub fn solve_columns(&self, right_hand_sides: &mut DenseMatrix) -> Result<(), LinalgError> {
        let (expected, found) = (self.order(), right_hand_sides.nrows());
        if found != expected {
            return Err(LinalgError::Shape { what: "right-hand side", expected, found });
        }
        let mut permuted = self.ordering.forward(right_hand_sides);
        self.factor.solve(permuted.as_mut());
        self.factor.check()?;
        self.ordering.backward(&permuted, right_hand_sides);
        Ok(())
    }
}
#[cfg(test)]
mod tests {
    use super::super::TripletBuilder;
    use super::*;

    /// Second difference matrix, grounded at one end by `ground`.
    fn chain(order: usize, ground: f64) -> SparseMatrix {
        let mut builder = TripletBuilder::new(order, order);
        for row in 0..order {
            let diagonal = if row == 0 { 1.0 + ground } else { 2.0 };
            builder.add(row, row, if row + 1 == order { 1.0 } else { diagonal });
            if row + 1 < order {
                builder.add(row, row + 1, -1.0);
                builder.add(row + 1, row, -1.0);
            }
        }
        builder.build()
    }

    #[test]
    fn solves_a_chain_pulled_at_its_end() {
        let factor = SparseCholesky::new(&chain(50, 1.0)).expect("positive definite");
        let mut load = vec![0.0; 50];
        load[49] = 1.0;
        factor.solve_vector(&mut load).expect("same length");
        for (node, displacement) in load.iter().enumerate() {
            assert!((displacement - (node as f64 + 1.0)).abs() < 1e-11);
        }
    }

    #[test]
    fn an_indefinite_matrix_is_an_error() {
        let result = SparseCholesky::new(&chain(5, -3.0));
        assert!(matches!(result, Err(LinalgError::NotPositiveDefinite { order: 5, .. })));
    }

    #[test]
    fn a_wrong_length_is_an_error() {
        let factor = SparseCholesky::new(&chain(4, 1.0)).expect("positive definite");
        assert_eq!(
            factor.solve_vector(&mut [0.0; 3]),
            Err(LinalgError::Shape { what: "right-hand side", expected: 4, found: 3 })
        );
    }
}
