//! Motions that stand for the modes beyond the lowest ones: what forces excite of them.
//!
//! Ritz pairs of the block Krylov sequence `(K + s M)^-1 f, ((K + s M)^-1 M) (K + s M)^-1 f, ...` in the complement of modes that
//! are known. In responses between the forces, the sum over these pairs is a quadrature of Gauss kind over all modes beyond, right
//! for statics and as many moments as there are blocks, twice (Golub and Meurant, *Matrices, Moments and Quadrature* (2010),
//! chapters 6 and 7).

use super::super::basis::{Basis, times};
use super::super::{DenseMatrix, EigenProblem, Factor, Kind, LinalgError, SymmetricSpectrum, symmetric_eigen};
use faer::Scale;

/// Shift over the lowest eigenvalue beyond: the stiffness of a free body becomes definite, and that of a held one hardly changes.
const SHIFT: f64 = 0.01;

impl EigenProblem {
    /// Ritz pairs of what `forces` [n x p] excite beyond the complete modes [n x m], mass-normalised, up to the eigenvalue `limit` (1/s^2, > 0):
    /// at most `blocks` p pairs, whose vectors have unit mass and are orthogonal to the modes.
    ///
    /// # Errors
    /// [`LinalgError`] of the factorisation and of values that are not finite.
    pub(crate) fn beyond(
        &self,
        modes: &DenseMatrix,
        limit: f64,
        forces: &DenseMatrix,
        blocks: usize,
    ) -> Result<SymmetricSpectrum, LinalgError> {
        let shifted = self.stiffness.shifted(-SHIFT * limit, &self.mass);
        let factor = Factor::double(&self.plan, &shifted, Kind::Indefinite)?;
        let mut basis = Basis::new(&self.mass, modes.ncols() + blocks * forces.ncols());
        let mut add = |mut w: DenseMatrix| {
            let mut product = self.mass.times(w.as_ref());
            let mut spare = DenseMatrix::zeros(w.nrows(), w.ncols());
            let added = basis.extend(w.as_mut(), product.as_mut(), spare.as_mut())?;
            Ok::<_, LinalgError>((product.subcols(0, added).to_owned(), basis.size))
        };
        let (_, known) = add(self.ordering.forward(modes))?;
        let mut next = self.ordering.forward(forces);
        for _ in 0..blocks {
            if next.ncols() == 0 {
                break;
            }
            factor.solve(next.as_mut());
            factor.check()?;
            (next, _) = add(next)?;
        }
        let vectors = basis.vectors().subcols(known, basis.size - known);
        let projected = times(vectors.transpose(), self.stiffness.times(vectors).as_ref());
        let ritz = symmetric_eigen(&((&projected + projected.transpose()) * Scale(0.5)))?;
        let turned = times(vectors, ritz.vectors.as_ref());
        let mut own = DenseMatrix::zeros(turned.nrows(), turned.ncols());
        self.ordering.backward(&turned, &mut own);
        Ok(SymmetricSpectrum { values: ritz.values, vectors: own })
    }
}
