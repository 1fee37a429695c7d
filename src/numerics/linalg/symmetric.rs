//! A symmetric sparse matrix in the order in which it is factorised: its lower triangle with 32-bit rows, a third of
//! the memory of both triangles with 64-bit ones, and its product with blocks of vectors.

use super::ordering::{ABSENT, Ordering};
use super::{DenseMatrix, Followers, SparseMatrix};
use faer::prelude::*;
use faer::{MatMut, MatRef};
use multiversion::{multiversion, target::target_cfg_f};
use rayon::prelude::*;
use std::cell::RefCell;

/// Vectors that are multiplied at once: an entry is loaded once for all of them.
const LANES: usize = 8;

/// Columns that one thread permutes in a row.
const COLUMNS: usize = 2048;

/// Rows that are turned from columns to lanes at once: they stay in the first cache.
const TILE: usize = 256;

/// Lower triangle in compressed columns, rows ascending, the diagonal first where it is stored.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SymmetricMatrix {
    /// Where each column begins, one more than columns.
    pub offsets: Vec<u32>,
    /// Rows.
    pub rows: Vec<u32>,
    /// Values.
    pub values: Vec<f64>,
    /// What unknowns that follow the others add.
    pub followers: Option<Followers>,
}

impl SymmetricMatrix {
    /// The matrix `a` [n x n], both triangles stored, in another order and without what that leaves out.
    pub(super) fn permuted(a: &SparseMatrix, ordering: &Ordering) -> Self {
        let begins = a.indptr().into_raw_storage();
        let below = |place: usize| {
            let column = ordering.old[place] as usize;
            let range = begins[column]..begins[column + 1];
            let rows = a.indices()[range.clone()].iter().map(|&row| ordering.new[row]);
            let entries = rows.zip(a.data()[range].iter().copied());
            entries.filter(move |entry| entry.0 != ABSENT && entry.0 as usize >= place)
        };
        let order = ordering.old.len();
        let mut offsets = vec![0; order + 1];
        offsets[1..].par_iter_mut().enumerate().for_each(|(place, length)| *length = below(place).count() as u32);
        for place in 0..order {
            offsets[place + 1] += offsets[place];
        }
        let stored = offsets[order] as usize;
        let (mut rows, mut values) = (vec![0; stored], vec![0.0; stored]);
        let (mut rows_left, mut values_left) = (&mut rows[..], &mut values[..]);
        let mut pieces = Vec::with_capacity(order.div_ceil(COLUMNS));
        for first in (0..order).step_by(COLUMNS) {
            let last = (first + COLUMNS).min(order);
            let length = (offsets[last] - offsets[first]) as usize;
            let own = (rows_left.split_off_mut(..length), values_left.split_off_mut(..length));
            pieces.push((first..last, own.0.unwrap_or_default(), own.1.unwrap_or_default()));
        }
        pieces.into_par_iter().for_each(|(places, rows, values)| {
            let mut column: Vec<(u32, f64)> = Vec::new();
            let mut to = rows.iter_mut().zip(values);
            for place in places {
                column.clear();
                column.extend(below(place));
                column.sort_unstable_by_key(|entry| entry.0);
                column.iter().zip(to.by_ref()).for_each(|(entry, (row, value))| (*row, *value) = *entry);
            }
        });
        Self { offsets, rows, values, followers: None }
    }

    /// Number of rows.
    pub(super) fn order(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Entries of a column from the diagonal down.
    pub(super) fn column(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.offsets[column] as usize..self.offsets[column + 1] as usize;
        let rows = self.rows[range.clone()].iter().map(|&row| row as usize);
        rows.zip(self.values[range].iter().copied())
    }

    /// Diagonal of what is stored [n].
    pub(super) fn stored_diagonal(&self) -> Vec<f64> {
        let first = |column: usize| self.column(column).next().filter(|entry| entry.0 == column);
        (0..self.order()).map(|column| first(column).map_or(0.0, |entry| entry.1)).collect()
    }

    /// Diagonal [n].
    pub(super) fn diagonal(&self) -> Vec<f64> {
        let mut diagonal = self.stored_diagonal();
        if let Some(followers) = &self.followers {
            followers.add_diagonal(&mut diagonal);
        }
        diagonal
    }

    /// `self - sigma other`; the pattern is that of both, and the followers are the same.
    pub(super) fn shifted(&self, sigma: f64, other: &Self) -> Self {
        let mut sum = Self {
            offsets: vec![0],
            rows: Vec::with_capacity(self.rows.len()),
            values: Vec::with_capacity(self.rows.len()),
            followers: self
                .followers
                .as_ref()
                .zip(other.followers.as_ref())
                .map(|(own, other)| own.shifted(sigma, other)),
        };
        for column in 0..self.order() {
            let mut others = other.column(column).peekable();
            for (row, value) in self.column(column) {
                while let Some((above, more)) = others.next_if(|entry| entry.0 < row) {
                    sum.rows.push(above as u32);
                    sum.values.push(-sigma * more);
                }
                let more = others.next_if(|entry| entry.0 == row).map_or(0.0, |entry| entry.1);
                sum.rows.push(row as u32);
                sum.values.push(value - sigma * more);
            }
            for (below, more) in others {
                sum.rows.push(below as u32);
                sum.values.push(-sigma * more);
            }
            sum.offsets.push(sum.rows.len() as u32);
        }
        sum
    }

    /// Whether every entry of another matrix has a place in this one.
    pub(super) fn covers(&self, other: &Self) -> bool {
        (0..self.order()).into_par_iter().all(|column| {
            let mut places = self.column(column);
            other.column(column).all(|(row, _)| places.any(|place| place.0 == row))
        })
    }

    /// `A X` for `X` [n x k].
    pub(super) fn times(&self, x: MatRef<'_, f64>) -> DenseMatrix {
        let mut y = DenseMatrix::zeros(self.order(), x.ncols());
        self.times_into(x, y.as_mut());
        y
    }

    /// `Y = A X` for `X` and `Y` [n x k]. Columns are independent: the result does not depend on the number of threads.
    pub(super) fn times_into(&self, x: MatRef<'_, f64>, mut y: MatMut<'_, f64>) {
        self.stored_times(&self.values, |row| row, x, y.rb_mut());
        if let Some(followers) = &self.followers {
            x.par_col_chunks(1).zip(y.par_col_chunks_mut(1)).for_each(|(x, y)| followers.add_times(x, y));
        }
    }

    /// `A X` for `X` [n x k], both with their rows in the order in which `ordering` has them kept.
    pub(super) fn times_kept(&self, ordering: &Ordering, x: &DenseMatrix) -> DenseMatrix {
        let mut y = DenseMatrix::zeros(x.nrows(), x.ncols());
        if self.followers.is_some() {
            ordering.backward(&self.times(ordering.forward(x).as_ref()), &mut y);
        } else {
            self.stored_times(&self.values, |row| ordering.place(row), x.as_ref(), y.as_mut());
        }
        y
    }

    /// `Y = A X` without followers for other values at the places of those stored; `place` is that of a row of X and Y.
    fn stored_times(
        &self,
        values: &[f64],
        place: impl Fn(usize) -> usize + Sync,
        x: MatRef<'_, f64>,
        y: MatMut<'_, f64>,
    ) {
        // fewer lanes load every entry more often, but no thread idles
        if x.ncols() <= LANES / 2 || rayon::current_num_threads() > x.ncols().div_ceil(LANES) {
            self.times_by::<{ LANES / 2 }>(values, place, x, y);
        } else {
            self.times_by::<LANES>(values, place, x, y);
        }
    }

    fn times_by<const L: usize>(
        &self,
        values: &[f64],
        place: impl Fn(usize) -> usize + Sync,
        x: MatRef<'_, f64>,
        y: MatMut<'_, f64>,
    ) {
        x.par_col_chunks(L).zip(y.par_col_chunks_mut(L)).for_each(|(x, y)| {
            SCRATCH.with_borrow_mut(|scratch| self.times_block::<L>(values, &place, x, y, scratch));
        });
    }

    /// Root of the sum of the squares of the terms `x_i a_ij x_j` of `x^T A x` for every column of `X` [n x k]: its
    /// round-off, in units of that of one entry, when the entries' errors are independent.
    pub(super) fn energy_scatters(&self, x: MatRef<'_, f64>) -> Vec<f64> {
        let squared: Vec<f64> = self.values.par_iter().map(|value| value * value).collect();
        let squares = DenseMatrix::from_fn(x.nrows(), x.ncols(), |i, j| x[(i, j)] * x[(i, j)]);
        let mut sums = DenseMatrix::zeros(x.nrows(), x.ncols());
        self.stored_times(&squared, |row| row, squares.as_ref(), sums.as_mut());
        let diagonal: Vec<f64> = self.stored_diagonal().into_iter().map(|entry| entry * entry).collect();
        let scatter = |column: usize| -> f64 {
            let rows = squares.col_as_slice(column).iter().zip(sums.col_as_slice(column));
            let terms = rows.zip(&diagonal);
            // the entries a_ij and a_ji are one, with one error: their squares count four times, not twice
            terms.map(|((x, sum), diagonal)| x * (2.0 * sum - diagonal * x)).sum()
        };
        let further = |column: usize| {
            let column: Vec<f64> = x.col(column).iter().copied().collect();
            self.followers.as_ref().map_or(0.0, |followers| followers.energy_scatter(&column))
        };
        (0..x.ncols()).into_par_iter().map(|column| (scatter(column) + further(column)).sqrt()).collect()
    }

    fn times_block<const L: usize>(
        &self,
        values: &[f64],
        place: impl Fn(usize) -> usize,
        x: MatRef<'_, f64>,
        mut y: MatMut<'_, f64>,
        scratch: &mut Scratch,
    ) {
        let [lanes, product] = scratch;
        lanes.resize(self.order() * L, 0.0);
        product.clear();
        product.resize(self.order() * L, 0.0);
        let (lanes, product) = (lanes.as_chunks_mut::<L>().0, product.as_chunks_mut::<L>().0);
        for tile in (0..self.order()).step_by(TILE) {
            let rows = tile..(tile + TILE).min(self.order());
            for (lane, column) in x.col_iter().enumerate() {
                let column = column.subrows(tile, rows.len());
                rows.clone().zip(column.iter()).for_each(|(row, &entry)| lanes[place(row)][lane] = entry);
            }
        }
        multiply(&self.offsets, &self.rows, values, lanes, product);
        for tile in (0..self.order()).step_by(TILE) {
            let rows = tile..(tile + TILE).min(self.order());
            for (lane, column) in y.rb_mut().col_iter_mut().enumerate() {
                let column = column.subrows_mut(tile, rows.len());
                rows.clone().zip(column.iter_mut()).for_each(|(row, entry)| *entry = product[place(row)][lane]);
            }
        }
    }
}

/// Factors and products of one block, row by row.
type Scratch = [Vec<f64>; 2];

thread_local! {
    /// Kept between products: to touch new memory costs a third of a product.
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

/// `product = A lanes` for a lower triangle in compressed columns, with the widest instructions that the machine has.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx2+fma", "x86_64+avx2+fma", "aarch64+neon"))]
fn multiply<const L: usize>(
    offsets: &[u32],
    rows: &[u32],
    values: &[f64],
    lanes: &[[f64; L]],
    product: &mut [[f64; L]],
) {
    // without the instruction a fused product is a call of the library
    if target_cfg_f!(any(target_feature = "fma", target_feature = "neon")) {
        multiply_by(offsets, rows, values, lanes, product, f64::mul_add);
    } else {
        multiply_by(offsets, rows, values, lanes, product, |a, b, sum| a * b + sum);
    }
}

#[inline(always)]
fn multiply_by<const L: usize>(
    offsets: &[u32],
    rows: &[u32],
    values: &[f64],
    lanes: &[[f64; L]],
    product: &mut [[f64; L]],
    add: impl Fn(f64, f64, f64) -> f64,
) {
    for (column, factor) in lanes.iter().enumerate() {
        let range = offsets[column] as usize..offsets[column + 1] as usize;
        let mut sum = [0.0; L];
        for (&row, &value) in rows[range.clone()].iter().zip(&values[range]) {
            let row = row as usize;
            if row == column {
                for lane in 0..L {
                    sum[lane] = add(value, factor[lane], sum[lane]);
                }
            } else {
                let (below, other) = (&mut product[row], &lanes[row]);
                for lane in 0..L {
                    below[lane] = add(value, factor[lane], below[lane]);
                    sum[lane] = add(value, other[lane], sum[lane]);
                }
            }
        }
        for lane in 0..L {
            product[column][lane] += sum[lane];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [[2, 1, 0], [1, 3, -2], [0, -2, 0]], the last diagonal entry not stored.
    fn sample() -> SymmetricMatrix {
        SymmetricMatrix {
            offsets: vec![0, 2, 4, 4],
            rows: vec![0, 1, 1, 2],
            values: vec![2.0, 1.0, 3.0, -2.0],
            followers: None,
        }
    }

    #[test]
    fn terms_scatter_as_their_squares() {
        let x = DenseMatrix::from_fn(3, 2, |row, column| [[1.0, 2.0, 3.0], [0.0, 1.0, 0.5]][column][row]);
        let found = sample().energy_scatters(x.as_ref());
        // terms 2, 12 on the diagonal, 2 * 2 and 2 * 12 beside it; then 3 and 2 * 1
        let expected = [(4.0 + 144.0 + 16.0 + 576.0_f64).sqrt(), 13.0_f64.sqrt()];
        for (found, expected) in found.iter().zip(expected) {
            // round-off of a few sums
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
    }

    #[test]
    fn a_pattern_covers_its_parts() {
        let whole = sample();
        let part =
            SymmetricMatrix { offsets: vec![0, 1, 2, 2], rows: vec![1, 1], values: vec![1.0, 1.0], followers: None };
        let other = SymmetricMatrix { offsets: vec![0, 0, 0, 1], rows: vec![2], values: vec![1.0], followers: None };
        let corner = SymmetricMatrix { offsets: vec![0, 1, 1, 1], rows: vec![0], values: vec![1.0], followers: None };
        assert!(whole.covers(&whole) && whole.covers(&part) && whole.covers(&corner));
        assert!(!part.covers(&corner) && !whole.covers(&other));
    }
}
