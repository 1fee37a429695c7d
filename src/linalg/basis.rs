//! A basis of vectors that are orthonormal in the product of the mass matrix.

use super::symmetric::SymmetricMatrix;
use super::{DenseMatrix, LinalgError, symmetric_eigen};
use faer::linalg::matmul::matmul;
use faer::{Accum, MatRef, Par};

/// Part of a new vector outside the basis, relative to it, below which it adds nothing but round-off.
const NOTHING_NEW: f64 = 1e-10;

/// Eigenvalue of the Gram matrix of unit vectors below which a direction is round-off of the others.
const DEPENDENT: f64 = 1e-11;

/// Eigenvalue below which the vectors are orthonormalised once more.
const NEARLY_DEPENDENT: f64 = 1e-6;

/// Vectors V [n x size] with `V^T M V = 1`, beside their products `M V`.
#[derive(Debug)]
pub(super) struct Basis<'p> {
    mass: &'p SymmetricMatrix,
    vectors: DenseMatrix,
    products: DenseMatrix,
    size: usize,
}

impl<'p> Basis<'p> {
    /// An empty basis with room for so many vectors.
    pub fn new(mass: &'p SymmetricMatrix, room: usize) -> Self {
        Self {
            mass,
            vectors: DenseMatrix::zeros(mass.order(), room),
            products: DenseMatrix::zeros(mass.order(), room),
            size: 0,
        }
    }

    /// Number of vectors.
    pub fn size(&self) -> usize {
        self.size
    }

    /// How many more vectors it can hold.
    pub fn room(&self) -> usize {
        self.vectors.ncols() - self.size
    }

    /// V [n x size].
    pub fn vectors(&self) -> MatRef<'_, f64> {
        self.vectors.as_ref().subcols(0, self.size)
    }

    /// M V [n x size].
    pub fn products(&self) -> MatRef<'_, f64> {
        self.products.as_ref().subcols(0, self.size)
    }

    /// Adds what `w` [n x k] adds to the span, as far as there is room; returns how many vectors that are.
    ///
    /// # Errors
    /// [`LinalgError::DenseEigen`] for values that are not finite.
    pub fn extend(&mut self, w: DenseMatrix) -> Result<usize, LinalgError> {
        if w.ncols() == 0 {
            return Ok(0);
        }
        let mut product = self.mass.times(w.as_ref());
        let mut w = w;
        let unit = norms(&w, &product)
            .into_iter()
            .map(|norm| if norm > 0.0 { norm.recip() } else { 0.0 });
        for (column, factor) in unit.enumerate() {
            for entry in w.col_as_slice_mut(column) {
                *entry *= factor;
            }
            for entry in product.col_as_slice_mut(column) {
                *entry *= factor;
            }
        }
        for _ in 0..2 {
            self.project(&mut w, &mut product);
            self.project(&mut w, &mut product);
            let smallest = orthonormalise(&mut w, &mut product)?;
            if smallest > NEARLY_DEPENDENT {
                break;
            }
            product = self.mass.times(w.as_ref());
        }
        let added = w.ncols().min(self.room());
        let place = self.size;
        let into = |to: &mut DenseMatrix, from: &DenseMatrix| {
            to.as_mut()
                .subcols_mut(place, added)
                .copy_from(from.subcols(0, added));
        };
        into(&mut self.vectors, &w);
        into(&mut self.products, &product);
        self.size += added;
        Ok(added)
    }

    /// Takes from `w` what lies in the basis.
    fn project(&self, w: &mut DenseMatrix, product: &mut DenseMatrix) {
        if self.size == 0 {
            return;
        }
        let along = times(self.vectors().transpose(), product.as_ref());
        subtract(w, self.vectors(), along.as_ref());
        subtract(product, self.products(), along.as_ref());
    }

    /// Replaces the basis by the combinations `V y`, y [size x k] with orthonormal columns.
    pub fn rotate(&mut self, y: MatRef<'_, f64>) {
        let (vectors, products) = (times(self.vectors(), y), times(self.products(), y));
        self.size = y.ncols();
        self.vectors
            .as_mut()
            .subcols_mut(0, self.size)
            .copy_from(&vectors);
        self.products
            .as_mut()
            .subcols_mut(0, self.size)
            .copy_from(&products);
    }
}

/// `A B`.
pub(super) fn times(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> DenseMatrix {
    let mut product = DenseMatrix::zeros(a.nrows(), b.ncols());
    matmul(product.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    product
}

/// `C - A B` in place of C.
pub(super) fn subtract(c: &mut DenseMatrix, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    matmul(c.as_mut(), Accum::Add, a, b, -1.0, Par::Seq);
}

/// `sqrt(x^T M x)` of every column, from x and its product with M.
pub(super) fn norms(x: &DenseMatrix, product: &DenseMatrix) -> Vec<f64> {
    (0..x.ncols())
        .map(|column| {
            let pairs = x
                .col_as_slice(column)
                .iter()
                .zip(product.col_as_slice(column));
            pairs.map(|(a, b)| a * b).sum::<f64>().max(0.0).sqrt()
        })
        .collect()
}

/// Makes the columns of `w` orthonormal through the eigenvectors of their Gram matrix and drops what depends on the
/// others; returns the smallest eigenvalue kept, of unit vectors.
fn orthonormalise(w: &mut DenseMatrix, product: &mut DenseMatrix) -> Result<f64, LinalgError> {
    let lengths = norms(w, product);
    let new: Vec<usize> = (0..w.ncols())
        .filter(|&j| lengths[j] > NOTHING_NEW)
        .collect();
    let gram = times(w.transpose(), product.as_ref());
    let unit = DenseMatrix::from_fn(new.len(), new.len(), |row, column| {
        let (i, j) = (new[row], new[column]);
        0.5 * (gram[(i, j)] + gram[(j, i)]) / (lengths[i] * lengths[j])
    });
    let spectrum = symmetric_eigen(&unit)?;
    let largest = spectrum.values.last().copied().unwrap_or(0.0);
    let kept: Vec<usize> = (0..new.len())
        .filter(|&j| spectrum.values[j] > DEPENDENT * largest)
        .collect();
    let mut turn = DenseMatrix::zeros(w.ncols(), kept.len());
    for (column, &j) in kept.iter().enumerate() {
        for (row, &i) in new.iter().enumerate() {
            turn[(i, column)] =
                spectrum.vectors[(row, j)] / (lengths[i] * spectrum.values[j].sqrt());
        }
    }
    *w = times(w.as_ref(), turn.as_ref());
    *product = times(product.as_ref(), turn.as_ref());
    let shortest = new.iter().map(|&j| lengths[j]).fold(1.0, f64::min);
    let smallest = kept.first().map_or(1.0, |&j| spectrum.values[j] / largest);
    Ok(smallest.min(shortest))
}
