//! Sparse Cholesky factorisation `P A P^T = L L^T` by faer (supernodal, approximate minimum degree
//! ordering).

use super::{DenseMatrix, LinalgError, SparseMatrix, run_sequentially};
use faer::Side;
use faer::linalg::cholesky::llt::factor::LltError as PivotError;
use faer::prelude::Solve;
use faer::sparse::linalg::LltError;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

/// Factor of a symmetric positive definite sparse matrix; serves any number of right-hand sides.
#[derive(Debug)]
pub struct SparseCholesky {
    factor: Llt<usize, f64>,
    order: usize,
}

impl SparseCholesky {
    /// Factorises `a` [n x n], symmetric, both triangles stored.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] with the pivot at which it stopped, or
    /// [`LinalgError::Factorisation`].
    pub fn new(a: &SparseMatrix) -> Result<Self, LinalgError> {
        run_sequentially();
        let order = a.rows();
        if a.cols() != order || !a.is_csc() {
            return Err(LinalgError::Shape {
                what: "matrix to factorise (square, compressed columns)",
                expected: order,
                found: a.cols(),
            });
        }
        let offsets = a.indptr();
        let offsets = offsets.raw_storage();
        let pattern =
            SymbolicSparseColMatRef::new_checked(order, order, offsets, None, a.indices());
        let failed = |reason| LinalgError::Factorisation { order, reason };
        let symbolic =
            SymbolicLlt::try_new(pattern, Side::Lower).map_err(|_| failed("symbolic analysis"))?;
        let values = SparseColMatRef::new(pattern, a.data());
        let factor = Llt::try_new_with_symbolic(symbolic, values, Side::Lower).map_err(
            |error| match error {
                LltError::Numeric(PivotError::NonPositivePivot { index }) => {
                    LinalgError::NotPositiveDefinite {
                        order,
                        pivot: index,
                    }
                }
                LltError::Generic(_) => failed("out of memory or index overflow"),
            },
        )?;
        Ok(Self { factor, order })
    }

    /// Number of rows of the factorised matrix.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Solves `A x = b` for one right-hand side of length n, in place.
    ///
    /// # Errors
    /// [`LinalgError::Shape`] if the length is not n.
    pub fn solve_vector(&self, right_hand_side: &mut [f64]) -> Result<(), LinalgError> {
        self.check(right_hand_side.len())?;
        let order = self.order;
        let columns = faer::MatMut::from_column_major_slice_mut(right_hand_side, order, 1);
        self.factor.solve_in_place(columns);
        Ok(())
    }

    /// Solves `A X = B` for all columns of `B` [n x k] at once, in place.
    ///
    /// # Errors
    /// [`LinalgError::Shape`] if `B` has not n rows.
    pub fn solve_columns(&self, right_hand_sides: &mut DenseMatrix) -> Result<(), LinalgError> {
        self.check(right_hand_sides.nrows())?;
        self.factor.solve_in_place(right_hand_sides.as_mut());
        Ok(())
    }

    fn check(&self, rows: usize) -> Result<(), LinalgError> {
        if rows == self.order {
            Ok(())
        } else {
            Err(LinalgError::Shape {
                what: "right-hand side",
                expected: self.order,
                found: rows,
            })
        }
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
        assert!(matches!(
            result,
            Err(LinalgError::NotPositiveDefinite { order: 5, .. })
        ));
    }

    #[test]
    fn a_wrong_length_is_an_error() {
        let factor = SparseCholesky::new(&chain(4, 1.0)).expect("positive definite");
        assert_eq!(
            factor.solve_vector(&mut [0.0; 3]),
            Err(LinalgError::Shape {
                what: "right-hand side",
                expected: 4,
                found: 3
            })
        );
    }
}
