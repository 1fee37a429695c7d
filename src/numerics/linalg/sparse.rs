//! The sparse matrix that travels between modules, and the few products that the mechanics needs.

use super::DenseMatrix;
use nalgebra_sparse::{CooMatrix, CscMatrix};
use rayon::prelude::*;

/// Sparse matrix in compressed columns, rows sorted; a symmetric matrix stores both triangles.
pub type SparseMatrix = sprs::CsMat<f64>;

/// Collects `(row, column, value)` entries of small matrices (springs, ties); repeated entries add
/// up. Big meshes are assembled on a pattern instead (`assembly`).
#[derive(Debug)]
pub struct TripletBuilder {
    entries: CooMatrix<f64>,
}

impl TripletBuilder {
    /// An empty matrix of `rows` x `columns`.
    pub fn new(rows: usize, columns: usize) -> Self {
        Self { entries: CooMatrix::new(rows, columns) }
    }

    /// Adds `value` at (`row`, `column`); an index outside the matrix is a programming error and
    /// panics, as indexing does.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries.push(row, column, value);
    }

    /// Compresses the entries to columns.
    pub fn build(self) -> SparseMatrix {
        let compressed = CscMatrix::from(&self.entries);
        let (rows, columns) = (compressed.nrows(), compressed.ncols());
        let (offsets, indices, values) = compressed.disassemble();
        sprs::CsMat::new_csc((rows, columns), offsets, indices, values)
    }
}

/// `T^T A T` for a sparse `A` [n x n] and `T` [n x m].
pub(crate) fn congruence(a: &SparseMatrix, t: &SparseMatrix) -> SparseMatrix {
    let at: SparseMatrix = a * t;
    let transposed: SparseMatrix = t.transpose_view().to_csc();
    (&transposed * &at).to_csc()
}

/// The entries of `a` in the given rows and columns, in the given order.
pub fn submatrix(a: &SparseMatrix, rows: &[usize], columns: &[usize]) -> SparseMatrix {
    let mut place = vec![usize::MAX; a.rows()];
    for (new, &old) in rows.iter().enumerate() {
        place[old] = new;
    }
    let mut offsets = Vec::with_capacity(columns.len() + 1);
    let mut indices = Vec::new();
    let mut values = Vec::new();
    let mut column_entries: Vec<(usize, f64)> = Vec::new();
    offsets.push(0);
    for &column in columns {
        column_entries.clear();
        if let Some(entries) = a.outer_view(column) {
            for (row, &value) in entries.iter() {
                if place[row] != usize::MAX {
                    column_entries.push((place[row], value));
                }
            }
        }
        column_entries.sort_unstable_by_key(|entry| entry.0);
        indices.extend(column_entries.iter().map(|entry| entry.0));
        values.extend(column_entries.iter().map(|entry| entry.1));
        offsets.push(indices.len());
    }
    sprs::CsMat::new_csc((rows.len(), columns.len()), offsets, indices, values)
}

/// A square dense matrix at a place on the diagonal of an empty one [order x order]; zeros are left out.
pub(crate) fn placed(part: &DenseMatrix, first: usize, order: usize) -> SparseMatrix {
    let mut whole = TripletBuilder::new(order, order);
    for column in 0..part.ncols() {
        for (row, &value) in part.col_as_slice(column).iter().enumerate() {
            if value != 0.0 {
                whole.add(first + row, first + column, value);
            }
        }
    }
    whole.build()
}

/// The rows of `part` [rows x k] at the given places of `order` rows, the others zero.
pub(crate) fn scattered_rows(part: &DenseMatrix, rows: &[usize], order: usize) -> DenseMatrix {
    let mut whole = DenseMatrix::zeros(order, part.ncols());
    for column in 0..part.ncols() {
        for (row, &at) in rows.iter().enumerate() {
            whole[(at, column)] = part[(row, column)];
        }
    }
    whole
}

/// `A X` for a sparse `A` [n x m] and a dense `X` [m x k].
pub fn sparse_times_dense(a: &SparseMatrix, x: &DenseMatrix) -> DenseMatrix {
    let mut product = DenseMatrix::zeros(a.rows(), x.ncols());
    product.par_col_iter_mut().enumerate().for_each(|(column, mut product)| {
        for (entries, &factor) in a.outer_iterator().zip(x.col_as_slice(column)) {
            for (row, &value) in entries.iter() {
                product[row] += value * factor;
            }
        }
    });
    product
}

/// `A^T X` for a sparse `A` [n x m] and a dense `X` [n x k].
pub fn transpose_times_dense(a: &SparseMatrix, x: &DenseMatrix) -> DenseMatrix {
    let mut product = DenseMatrix::zeros(a.cols(), x.ncols());
    product.par_col_iter_mut().enumerate().for_each(|(column, product)| {
        let x = x.col_as_slice(column);
        for (product, entries) in product.iter_mut().zip(a.outer_iterator()) {
            *product = entries.iter().map(|(inner, &value)| value * x[inner]).sum();
        }
    });
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> SparseMatrix {
        let mut builder = TripletBuilder::new(3, 3);
        for (row, column, value) in [(0, 0, 2.0), (1, 1, 3.0), (2, 2, 4.0), (0, 1, -1.0), (1, 0, -1.0)] {
            builder.add(row, column, value);
        }
        builder.add(2, 2, 1.0);
        builder.build()
    }

    #[test]
    fn repeated_entries_add_up() {
        assert_eq!(sample().get(2, 2), Some(&5.0));
    }

    #[test]
    fn congruence_is_the_triple_product() {
        let mut t = TripletBuilder::new(3, 2);
        t.add(0, 0, 1.0);
        t.add(1, 0, 2.0);
        t.add(2, 1, 3.0);
        let product = congruence(&sample(), &t.build());
        // t0' A t0 = 2 - 2 - 2 + 12, t1' A t1 = 9 * 5
        assert_eq!(product.get(0, 0), Some(&10.0));
        assert_eq!(product.get(1, 1), Some(&45.0));
    }

    #[test]
    fn submatrix_keeps_the_order_asked_for() {
        let part = submatrix(&sample(), &[1, 0], &[0, 2]);
        assert_eq!(part.get(0, 0), Some(&-1.0));
        assert_eq!(part.get(1, 0), Some(&2.0));
        assert_eq!(part.get(0, 1), None);
    }

    #[test]
    fn scattered_rows_stand_at_their_places() {
        let part = DenseMatrix::from_fn(2, 2, |row, column| (1 + row + 2 * column) as f64);
        let whole = scattered_rows(&part, &[3, 1], 4);
        let expected = [[0.0, 2.0, 0.0, 1.0], [0.0, 4.0, 0.0, 3.0]];
        for (column, expected) in expected.iter().enumerate() {
            assert_eq!(whole.col_as_slice(column), expected);
        }
    }

    #[test]
    fn products_with_dense_columns() {
        let x = DenseMatrix::from_fn(3, 1, |row, _| row as f64 + 1.0);
        let forward = sparse_times_dense(&sample(), &x);
        let backward = transpose_times_dense(&sample(), &x);
        // sums of small integers are exact
        for (row, expected) in [0.0, 5.0, 15.0].into_iter().enumerate() {
            assert!((forward[(row, 0)] - expected).abs() < f64::EPSILON);
            assert!((backward[(row, 0)] - expected).abs() < f64::EPSILON);
        }
    }
}
