//! A basis of vectors that are orthonormal in the product of the mass matrix.

use super::{DenseMatrix, LinalgError, SymmetricMatrix, symmetric_eigen};
use faer::linalg::matmul::matmul;
use faer::prelude::*;
use faer::{Accum, ColMut, MatMut, MatRef, Par};
use rayon::prelude::*;

/// Rows of tall matrices that are multiplied at once; threads share them.
const ROWS: usize = 8192;

/// Part of a new vector outside the basis, relative to it, below which it adds nothing but round-off.
const NOTHING_NEW: f64 = 1e-10;

/// Eigenvalue of the Gram matrix of unit vectors below which a direction is round-off of the others.
const DEPENDENT: f64 = 1e-11;

/// Eigenvalue below which the vectors are orthonormalised once more.
const NEARLY_DEPENDENT: f64 = 1e-6;

/// Part of a new unit vector that a projection leaves, below which it is projected once more (Daniel, Gragg, Kaufman and Stewart,
/// Math. Comp. 30 (1976) 772-795). One projection grows the basis's own errors by the reciprocal of that part. With a limit of 0.1
/// they grew threefold from block to block, and 1000 equal bodies got motions below their lowest.
const MOSTLY_INSIDE: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Part of a new vector that a projection takes away, below which its product with M stays what it was: round-off of the product.
const UNCHANGED: f64 = 1e-14;

/// Columns of zeros in memory that the system gives when it is written first, to the thread that writes.
#[derive(Debug)]
pub(super) struct Columns {
    rows: usize,
    entries: Vec<f64>,
}

impl Columns {
    pub(super) fn new(rows: usize, columns: usize) -> Self {
        Self { rows, entries: vec![0.0; rows * columns] }
    }

    fn count(&self) -> usize {
        self.entries.len() / self.rows.max(1)
    }

    /// The first columns.
    pub(super) fn first(&mut self, count: usize) -> MatMut<'_, f64> {
        MatMut::from_column_major_slice_mut(&mut self.entries[..self.rows * count], self.rows, count)
    }
}

/// Vectors V [n x size] with `V^T M V = 1`.
#[derive(Debug)]
pub(super) struct Basis<'p> {
    mass: &'p SymmetricMatrix,
    vectors: Columns,
    /// Number of vectors.
    pub size: usize,
}

impl<'p> Basis<'p> {
    /// An empty basis with room for so many vectors.
    pub(super) fn new(mass: &'p SymmetricMatrix, room: usize) -> Self {
        Self { mass, vectors: Columns::new(mass.order(), room), size: 0 }
    }

    /// How many more vectors it can hold.
    pub(super) fn room(&self) -> usize {
        self.vectors.count() - self.size
    }

    /// V [n x size].
    pub(super) fn vectors(&self) -> MatRef<'_, f64> {
        let rows = self.vectors.rows;
        MatRef::from_column_major_slice(&self.vectors.entries[..rows * self.size], rows, self.size)
    }

    /// Adds what `w` [n x k] adds to the span, as far as there is room; returns how many vectors that are. `product` is
    /// `M w`; both become what is added, and `spare` of the same shape is overwritten.
    ///
    /// # Errors
    /// [`LinalgError::DenseEigen`] for values that are not finite.
    pub(super) fn extend(
        &mut self,
        mut w: MatMut<'_, f64>,
        mut product: MatMut<'_, f64>,
        mut spare: MatMut<'_, f64>,
    ) -> Result<usize, LinalgError> {
        let lengths = norms(w.rb(), product.rb());
        let both = w.rb_mut().par_col_iter_mut().zip(product.rb_mut().par_col_iter_mut());
        both.zip(lengths).for_each(|((w, product), length)| {
            let factor = if length > 0.0 { length.recip() } else { 0.0 };
            scale(w, factor);
            scale(product, factor);
        });
        let mut count = w.ncols();
        for _ in 0..2 {
            let (w, product) = (&mut w, &mut product);
            let left = self.project(columns(w, count), columns(product, count));
            if left < MOSTLY_INSIDE {
                self.project(columns(w, count), columns(product, count));
            }
            let (kept, smallest) = orthonormalise(columns(w, count), columns(product, count), spare.rb_mut())?;
            count = kept;
            if smallest > NEARLY_DEPENDENT {
                break;
            }
            self.mass.times_into(columns(w, count).rb(), columns(product, count));
        }
        let added = count.min(self.room());
        copy(self.vectors.first(self.size + added).subcols_mut(self.size, added), w.rb().subcols(0, added));
        self.size += added;
        Ok(added)
    }

    /// Takes from vectors `w` what lies in the basis; returns the smallest part of a length that is left.
    fn project(&self, mut w: MatMut<'_, f64>, product: MatMut<'_, f64>) -> f64 {
        if self.size == 0 {
            return 1.0;
        }
        let lengths = norms(w.rb(), product.rb());
        let along = times(self.vectors().transpose(), product.rb());
        tall_times(w.rb_mut(), Accum::Add, self.vectors(), along.as_ref(), -1.0);
        let taken = (0..w.ncols()).map(|column| along.col(column).norm_l2() / lengths[column]).fold(0.0, f64::max);
        if taken > UNCHANGED {
            self.mass.times_into(w.rb(), product);
        }
        (1.0 - taken * taken).max(0.0).sqrt()
    }

    /// Replaces the basis by the combinations `V y`, y [size x k] with orthonormal columns.
    pub(super) fn rotate(&mut self, y: MatRef<'_, f64>) {
        let vectors = times(self.vectors(), y);
        self.size = y.ncols();
        copy(self.vectors.first(self.size), vectors.as_ref());
    }
}

/// `A B`. Sums over long columns are added up piece by piece, the same whatever the number of threads.
pub(crate) fn times(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> DenseMatrix {
    let mut product = DenseMatrix::zeros(a.nrows(), b.ncols());
    if a.ncols() <= ROWS {
        tall_times(product.as_mut(), Accum::Replace, a, b, 1.0);
        return product;
    }
    let piece = |first: usize| {
        let rows = ROWS.min(a.ncols() - first);
        let mut part = DenseMatrix::zeros(a.nrows(), b.ncols());
        let (a, b) = (a.subcols(first, rows), b.subrows(first, rows));
        matmul(part.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
        part
    };
    let parts: Vec<DenseMatrix> = (0..a.ncols()).into_par_iter().step_by(ROWS).map(piece).collect();
    parts.iter().for_each(|part| product += part);
    product
}

/// `to = factor A B` or `to += factor A B` for a tall A, of which threads share the rows.
pub(super) fn tall_times(to: MatMut<'_, f64>, add: Accum, a: MatRef<'_, f64>, b: MatRef<'_, f64>, factor: f64) {
    let mut pieces = Vec::new();
    let (mut to, mut a) = (to, a);
    while to.nrows() > ROWS {
        let (own, others) = to.split_at_row_mut(ROWS);
        let (left, below) = a.split_at_row(ROWS);
        pieces.push((own, left));
        (to, a) = (others, below);
    }
    pieces.push((to, a));
    pieces.into_par_iter().for_each(|(to, a)| matmul(to, add, a, b, factor, Par::Seq));
}

/// `to = from`, of which threads share the columns.
pub(super) fn copy(to: MatMut<'_, f64>, from: MatRef<'_, f64>) {
    to.par_col_iter_mut().zip(from.par_col_iter()).for_each(|(mut to, from)| to.copy_from(from));
}

/// The first columns.
fn columns<'a>(a: &'a mut MatMut<'_, f64>, count: usize) -> MatMut<'a, f64> {
    a.rb_mut().subcols_mut(0, count)
}

fn scale(column: ColMut<'_, f64>, factor: f64) {
    for entry in column.iter_mut() {
        *entry *= factor;
    }
}

/// `sqrt(x^T M x)` of every column, from x and its product with M.
pub(super) fn norms(x: MatRef<'_, f64>, product: MatRef<'_, f64>) -> Vec<f64> {
    let square = |column: usize| -> f64 { x.col(column).transpose() * product.col(column) };
    (0..x.ncols()).into_par_iter().map(|column| square(column).max(0.0).sqrt()).collect()
}

/// Makes the columns of `w` orthonormal through the eigenvectors of their Gram matrix and drops what depends on the
/// others; returns how many remain and the smallest eigenvalue kept, of unit vectors.
fn orthonormalise(
    w: MatMut<'_, f64>,
    product: MatMut<'_, f64>,
    mut spare: MatMut<'_, f64>,
) -> Result<(usize, f64), LinalgError> {
    let lengths = norms(w.rb(), product.rb());
    let new: Vec<usize> = (0..w.ncols()).filter(|&j| lengths[j] > NOTHING_NEW).collect();
    let gram = times(w.rb().transpose(), product.rb());
    let unit = DenseMatrix::from_fn(new.len(), new.len(), |row, column| {
        let (i, j) = (new[row], new[column]);
        0.5 * (gram[(i, j)] + gram[(j, i)]) / (lengths[i] * lengths[j])
    });
    let spectrum = symmetric_eigen(&unit)?;
    let largest = spectrum.values.last().copied().unwrap_or(0.0);
    let kept: Vec<usize> = (0..new.len()).filter(|&j| spectrum.values[j] > DEPENDENT * largest).collect();
    let mut turn = DenseMatrix::zeros(w.ncols(), kept.len());
    for (column, &j) in kept.iter().enumerate() {
        for (row, &i) in new.iter().enumerate() {
            turn[(i, column)] = spectrum.vectors[(row, j)] / (lengths[i] * spectrum.values[j].sqrt());
        }
    }
    let mut rotate = |mut a: MatMut<'_, f64>| {
        let mut turned = columns(&mut spare, kept.len());
        tall_times(turned.rb_mut(), Accum::Replace, a.rb(), turn.as_ref(), 1.0);
        copy(columns(&mut a, kept.len()), turned.rb());
    };
    rotate(w);
    rotate(product);
    let shortest = new.iter().map(|&j| lengths[j]).fold(1.0, f64::min);
    let smallest = kept.first().map_or(1.0, |&j| spectrum.values[j] / largest);
    Ok((kept.len(), smallest.min(shortest)))
}

#[cfg(test)]
mod tests {
    use super::super::dense::pseudo_random;
    use super::*;

    /// A mass of 200 unequal entries.
    fn mass() -> SymmetricMatrix {
        let order: u32 = 200;
        SymmetricMatrix {
            offsets: (0..=order).collect(),
            rows: (0..order).collect(),
            values: (0..order).map(|row| 1.0 + f64::from(row)).collect(),
            followers: None,
        }
    }

    /// Adds vectors and returns the basis and how far it is from orthonormal.
    fn add(basis: &mut Basis, mass: &SymmetricMatrix, mut w: DenseMatrix) -> (DenseMatrix, f64) {
        let mut product = mass.times(w.as_ref());
        let mut spare = DenseMatrix::zeros(w.nrows(), w.ncols());
        let added = basis.extend(w.as_mut(), product.as_mut(), spare.as_mut());
        assert_eq!(added, Ok(w.ncols()));
        // what is added and its product come back
        assert!((mass.times(w.as_ref()) - &product).norm_max() < 1e-12);
        let all = basis.vectors().to_owned();
        let gram = all.transpose() * mass.times(all.as_ref());
        let error = (gram - DenseMatrix::identity(all.ncols(), all.ncols())).norm_max();
        (all, error)
    }

    /// New vectors that lie in the basis but for a small part: one projection leaves round-off of the size of that part, 1e-12 and more.
    #[test]
    fn what_is_mostly_inside_is_projected_twice() {
        let mass = mass();
        let mut basis = Basis::new(&mass, 12);
        let (first, _) = add(&mut basis, &mass, pseudo_random(200, 8, 1));
        let inside = &first * pseudo_random(8, 4, 2);
        let w = inside + pseudo_random(200, 4, 3) * faer::Scale(1e-4);
        let (_, error) = add(&mut basis, &mass, w);
        // round-off of sums of 200 terms
        assert!(error < 1e-13, "{error:e}");
    }

    /// Block after block of which a third is new, as a Krylov sequence of few eigenvalues has them: errors do not grow.
    #[test]
    fn a_long_sequence_stays_orthonormal() {
        let mass = mass();
        let mut basis = Basis::new(&mass, 120);
        let (mut all, _) = add(&mut basis, &mass, pseudo_random(200, 8, 1));
        for block in 1..15 {
            let inside = &all * pseudo_random(all.ncols(), 8, 2 * block);
            let new = pseudo_random(200, 8, 2 * block + 1);
            let [length, of_new] = [&inside, &new].map(|part| part.norm_l2());
            let (grown, error) = add(&mut basis, &mass, inside + new * faer::Scale(length / of_new / 3.0));
            assert!(error < 1e-13, "block {block}: {error:e}");
            all = grown;
        }
    }
}
