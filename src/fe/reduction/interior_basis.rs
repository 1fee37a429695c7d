//! What the interior of a condensed housing may do while the interface is held.
//!
//! Fixed-interface modes alone converge slowly where the interface is stiff: every mode that is left out is missing as
//! a static correction. Residual vectors put that correction back for the modes that matter (see `residual`). Both
//! kinds stand in one basis Q with
//!
//! ```text
//! Q^T M_ii Q = 1,    Q^T K_ii Q = diag(values)
//! ```
//!
//! so that a superelement looks the same with or without them: K_bq = 0, M_qq = 1, static response exact.

use super::substructure::{diagonal, normalised, symmetric};
use super::{ReductionError, Substructure};
use crate::numerics::linalg::{DenseMatrix, EigenPairs, symmetric_eigen};

/// Directions of new vectors that are dropped as dependent: squared length, relative to the longest.
const DEPENDENT: f64 = 1e-12;

/// Length of a vector beside what it was before the projection, below which it is round-off: it lay in the basis.
const CONTAINED: f64 = 1e-9;

/// A mode is quasi-static up to this share of the first fixed-interface eigenvalue: what the interior's inertia does in it
/// is below that share, and so are its residual and its relative error. Among them are the rigid modes.
const QUASI_STATIC: f64 = 1e-10;

/// Vectors of the interior with their Ritz values.
#[derive(Debug, Clone)]
pub struct InteriorBasis {
    /// The vectors Q [interior x q].
    pub(super) vectors: DenseMatrix,
    pub(super) values: Vec<f64>,
    /// `Q^T A` [q x interface]: how the interface's accelerations drive them, kg^(1/2).
    pub(super) participation: DenseMatrix,
    /// How many of the vectors are residual vectors.
    pub(crate) residual_vectors: usize,
    /// Eigenvalue of the lowest fixed-interface mode that is left out, 1/s^2; infinite if none is.
    pub(crate) complete_below: f64,
}

impl InteriorBasis {
    /// The first `count` of some fixed-interface modes, of which one more is known unless there are no more.
    pub fn of_modes(substructure: &Substructure, pairs: &EigenPairs, count: usize) -> Self {
        let count = count.min(pairs.values.len());
        let vectors = pairs.vectors.subcols(0, count).to_owned();
        Self {
            participation: substructure.follow_transposed(&vectors).transpose().to_owned(),
            values: pairs.values[..count].to_vec(),
            vectors,
            residual_vectors: 0,
            complete_below: pairs.values.get(count).copied().unwrap_or(f64::INFINITY),
        }
    }

    /// Number of vectors q.
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// Ritz values `q_j^T K_ii q_j`, 1/s^2, ascending; those of a basis of modes are their squared frequencies.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Eigenvalue up to which a mode of the coupled structure is quasi-static, 1/s^2.
    pub(super) fn quasi_static(&self) -> f64 {
        QUASI_STATIC * self.lowest_value()
    }

    /// The lowest fixed-interface eigenvalue, kept or left out, 1/s^2.
    pub(super) fn lowest_value(&self) -> f64 {
        let kept = self.values.first().copied().unwrap_or(f64::INFINITY);
        kept.min(self.complete_below)
    }

    /// The basis with further vectors `z` [interior x k], made orthogonal to it and to each other. Vectors that it
    /// contains add nothing.
    ///
    /// # Errors
    /// [`ReductionError::Linalg`] for vectors that are not finite.
    pub(crate) fn extended(&self, substructure: &Substructure, mut z: DenseMatrix) -> Result<Self, ReductionError> {
        // what is left of vectors that lie almost in the basis is made long again, and with it what round-off left in
        // the basis; twice is enough (Parlett, The Symmetric Eigenvalue Problem, section 6.9)
        for _ in 0..2 {
            z = self.independent(substructure, z)?;
        }
        self.joined(substructure, &z)
    }

    /// Of vectors `z` [interior x k] what is orthogonal to the basis, orthonormal.
    fn independent(&self, substructure: &Substructure, mut z: DenseMatrix) -> Result<DenseMatrix, ReductionError> {
        let before = lengths(&substructure.interior.mass_times(&z), &z);
        let inside = self.vectors.transpose() * substructure.interior.mass_times(&z);
        z -= &self.vectors * inside;
        let after = lengths(&substructure.interior.mass_times(&z), &z);
        let new: Vec<usize> = (0..z.ncols()).filter(|&column| after[column] > CONTAINED * before[column]).collect();
        let z = DenseMatrix::from_fn(z.nrows(), new.len(), |row, column| z[(row, new[column])] / after[new[column]]);
        let normal = normalised(&(z.transpose() * substructure.interior.mass_times(&z)), DEPENDENT)?;
        Ok(z * normal)
    }

    /// The basis with orthonormal vectors that are orthogonal to it, turned to its Ritz vectors.
    fn joined(&self, substructure: &Substructure, z: &DenseMatrix) -> Result<Self, ReductionError> {
        let q = self.count();
        let stiff = substructure.interior.stiffness_times(z);
        let coupling = self.vectors.transpose() * &stiff;
        let own = z.transpose() * &stiff;
        let stiffness = faer::concat![[diagonal(&self.values), coupling], [coupling.transpose(), symmetric(&own)]];
        let ritz = symmetric_eigen(&stiffness)?;
        let (old, new) = (ritz.vectors.subrows(0, q), ritz.vectors.subrows(q, z.ncols()));
        let of_new = substructure.follow_transposed(z);
        Ok(Self {
            vectors: &self.vectors * old + z * new,
            participation: old.transpose() * &self.participation + new.transpose() * of_new.transpose(),
            values: ritz.values,
            residual_vectors: self.residual_vectors + z.ncols(),
            complete_below: self.complete_below,
        })
    }
}

/// Root of `x^T (M x)` of every column.
fn lengths(moved: &DenseMatrix, x: &DenseMatrix) -> Vec<f64> {
    (0..x.ncols())
        .map(|column| {
            let (x, moved) = (x.col_as_slice(column), moved.col_as_slice(column));
            let square: f64 = x.iter().zip(moved).map(|(x, y)| x * y).sum();
            square.max(0.0).sqrt()
        })
        .collect()
}
