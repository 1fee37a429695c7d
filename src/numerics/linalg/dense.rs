//! Dense symmetric and general eigenvalue problems, by faer.

use super::{DenseMatrix, LinalgError};
use faer::linalg::solvers::Llt;
use faer::prelude::Solve;
use faer::{Side, c64};

/// Eigenvalues in ascending order with eigenvectors in columns.
#[derive(Debug, Clone)]
pub struct SymmetricSpectrum {
    /// Eigenvalues, ascending, length n.
    pub values: Vec<f64>,
    /// Eigenvectors [n x n]; normalised as the function that made them says.
    pub vectors: DenseMatrix,
}

/// Eigenvalues of a matrix that need not be symmetric, with eigenvectors in columns.
#[derive(Debug, Clone)]
pub struct GeneralSpectrum {
    /// Eigenvalues, in no particular order, length n.
    pub values: Vec<c64>,
    /// Eigenvectors [n x n], of length 1.
    pub vectors: faer::Mat<c64>,
}

/// Cholesky factor of a dense symmetric positive definite matrix.
#[derive(Debug, Clone)]
pub struct DenseCholesky {
    factor: Llt<f64>,
}

impl DenseCholesky {
    /// Factorises `a` [n x n]; its lower triangle is read.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`].
    pub fn new(a: &DenseMatrix) -> Result<Self, LinalgError> {
        run_sequentially();
        let factor = a.llt(Side::Lower).map_err(|error| {
            let faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot { index } = error;
            LinalgError::NotPositiveDefinite { order: a.nrows(), pivot: index }
        })?;
        Ok(Self { factor })
    }

    /// Smallest over largest pivot of the factor scaled to a unit diagonal, squared: about the
    /// reciprocal condition number; round-off (1e-15) for a singular matrix.
    pub(crate) fn reciprocal_condition(&self) -> f64 {
        let lower = self.factor.L();
        (0..lower.nrows())
            .map(|i| {
                let diagonal: f64 = (0..=i).map(|j| lower[(i, j)].powi(2)).sum();
                lower[(i, i)].powi(2) / diagonal
            })
            .fold(1.0, f64::min)
    }

    /// `A^-1 B` for `B` [n x k].
    pub fn solve(&self, b: &DenseMatrix) -> DenseMatrix {
        self.factor.solve(b)
    }
}

/// All eigenpairs of `A x = lambda x` for a symmetric `A` [n x n], vectors of length 1.
///
/// # Errors
/// [`LinalgError::DenseEigen`] if the iteration does not converge (values that are not finite).
pub(crate) fn symmetric_eigen(a: &DenseMatrix) -> Result<SymmetricSpectrum, LinalgError> {
    run_sequentially();
    let failed = || LinalgError::DenseEigen { order: a.nrows() };
    if a.nrows() == 0 {
        // faer's solver expects one row at least
        return Ok(SymmetricSpectrum { values: Vec::new(), vectors: DenseMatrix::zeros(0, 0) });
    }
    // faer's solver has thresholds that are not relative: entries of 1e15 cost it half its digits
    let largest = a.norm_max();
    let scale = if largest > 0.0 { largest } else { 1.0 };
    if !scale.is_finite() {
        return Err(failed());
    }
    let eigen = (a * faer::Scale(scale.recip())).self_adjoint_eigen(Side::Lower).map_err(|_| failed())?;
    let values = eigen.S().column_vector().iter();
    Ok(SymmetricSpectrum { values: values.map(|value| scale * value).collect(), vectors: eigen.U().to_owned() })
}

/// All eigenpairs of `K x = lambda M x`, `K` and `M` symmetric positive semidefinite [n x n] and not both singular in
/// one direction, vectors normalised to `x^T M x = 1`. A motion without mass has the eigenvalue infinity, a vector of
/// zeros, and stands last.
///
/// The inverse problem `M x = mu (K + s M) x` is reduced by the Cholesky factor of `K + s M` (Golub
/// and Van Loan, Matrix Computations, 4th ed., section 8.7.2, roles exchanged) and
/// `lambda = 1 / mu - s`. Reduced by the mass instead, round-off would be relative to the highest
/// eigenvalue (1e16 1/s^2 for a ring of beams) and the rigid modes would drown in it; this way it
/// is relative to the low ones.
///
/// # Errors
/// [`LinalgError::NotPositiveDefinite`] for `K + s M`, [`LinalgError::DenseEigen`].
pub fn symmetric_generalised_eigen(k: &DenseMatrix, m: &DenseMatrix) -> Result<SymmetricSpectrum, LinalgError> {
    use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
    let order = k.nrows();
    let shift = inverse_shift(k, m);
    let shifted = k + m * faer::Scale(shift);
    let factor = DenseCholesky::new(&shifted)?;
    let lower = factor.factor.L();
    // C = L^-1 s M L^-T, formed from both sides and made exactly symmetric; eigenvalues s mu in
    // (0, 1]
    let mut half = m * faer::Scale(shift);
    solve_lower_triangular_in_place(lower, half.as_mut(), faer::Par::Seq);
    let mut whole = half.transpose().to_owned();
    solve_lower_triangular_in_place(lower, whole.as_mut(), faer::Par::Seq);
    let symmetric =
        DenseMatrix::from_fn(order, order, |row, column| 0.5 * (whole[(row, column)] + whole[(column, row)]));
    let inverse = symmetric_eigen(&symmetric)?;
    // mu descends as lambda ascends
    let mu = |mode: usize| inverse.values[order - 1 - mode] / shift;
    let round_off = order as f64 * f64::EPSILON * inverse.values.last().copied().unwrap_or(0.0) / shift;
    if order > 0 && mu(order - 1) < -round_off {
        return Err(LinalgError::NotPositiveDefinite { order, pivot: 0 });
    }
    let has_mass = |mode: usize| mu(mode) > round_off;
    let mut vectors = DenseMatrix::from_fn(order, order, |row, mode| {
        if has_mass(mode) { inverse.vectors[(row, order - 1 - mode)] / mu(mode).sqrt() } else { 0.0 }
    });
    solve_upper_triangular_in_place(lower.transpose(), vectors.as_mut(), faer::Par::Seq);
    Ok(SymmetricSpectrum {
        values: (0..order).map(|mode| if has_mass(mode) { 1.0 / mu(mode) - shift } else { f64::INFINITY }).collect(),
        vectors,
    })
}

/// `K_ii / M_ii` beside the largest one below which it is round-off.
const ROUND_OFF: f64 = 1e-12;

/// A shift well below the highest and not far from the lowest elastic eigenvalue: 1e-4 of the
/// smallest `K_ii / M_ii`. Two orders of magnitude either way change round-off, nothing else.
fn inverse_shift(k: &DenseMatrix, m: &DenseMatrix) -> f64 {
    let ratios = || (0..k.nrows()).map(|i| k[(i, i)] / m[(i, i)]);
    let finite = |ratio: &f64| ratio.is_finite();
    let largest = ratios().filter(finite).fold(0.0, f64::max);
    // a condensed rigid body has a diagonal of round-off
    let smallest = ratios().filter(|ratio| *ratio > ROUND_OFF * largest).fold(f64::INFINITY, f64::min);
    if smallest.is_finite() { 1e-4 * smallest } else { 1.0 }
}

/// All eigenpairs of `A x = lambda x` for any real square `A`.
///
/// # Errors
/// [`LinalgError::DenseEigen`] if the iteration does not converge (values that are not finite).
pub fn general_spectrum(a: &DenseMatrix) -> Result<GeneralSpectrum, LinalgError> {
    run_sequentially();
    let failed = LinalgError::DenseEigen { order: a.nrows() };
    let finite = (0..a.ncols()).all(|column| a.col(column).iter().all(|value| value.is_finite()));
    if !finite {
        return Err(failed);
    }
    let eigen = a.eigen().map_err(|_| failed)?;
    Ok(GeneralSpectrum { values: eigen.S().column_vector().iter().copied().collect(), vectors: eigen.U().to_owned() })
}

/// Makes faer run sequentially: sums are then formed in one order whatever the machine.
pub(super) fn run_sequentially() {
    use std::sync::Once;
    static ONCE: Once = Once::new();
    ONCE.call_once(|| faer::set_global_parallelism(faer::Par::Seq));
}

/// Numbers in (-1/2, 1/2) without pattern (xorshift, Marsaglia, J. Stat. Soft. 8 (2003) 14), the same for the same
/// `start`: no mode is orthogonal to them by accident, and every run repeats.
pub(super) fn pseudo_random(rows: usize, columns: usize, start: u64) -> DenseMatrix {
    let mut state = 0x9e37_79b9_7f4a_7c15 ^ start.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut matrix = DenseMatrix::zeros(rows, columns);
    for column in 0..columns {
        matrix.col_as_slice_mut(column).fill_with(&mut next);
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_masses_and_two_springs() {
        // K = [[3, -1], [-1, 1]], M = diag(2, 1): lambda^2 - 2.5 lambda + 1 = 0
        let k = DenseMatrix::from_fn(2, 2, |i, j| [[3.0, -1.0], [-1.0, 1.0]][i][j]);
        let m = DenseMatrix::from_fn(2, 2, |i, j| [[2.0, 0.0], [0.0, 1.0]][i][j]);
        let spectrum = symmetric_generalised_eigen(&k, &m).expect("definite");
        assert!((spectrum.values[0] - 0.5).abs() < 1e-14);
        assert!((spectrum.values[1] - 2.0).abs() < 1e-14);
        let gram = spectrum.vectors.transpose() * &m * &spectrum.vectors;
        for i in 0..2 {
            for j in 0..2 {
                assert!((gram[(i, j)] - f64::from(i == j)).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn a_rotation_has_imaginary_eigenvalues() {
        let a = DenseMatrix::from_fn(2, 2, |i, j| [[0.0, -1.0], [1.0, 0.0]][i][j]);
        let spectrum = general_spectrum(&a).expect("finite");
        for value in spectrum.values {
            assert!(value.re.abs() < 1e-14 && (value.im.abs() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn values_that_are_not_finite_are_an_error() {
        let a = DenseMatrix::from_fn(2, 2, |_, _| f64::NAN);
        assert!(matches!(general_spectrum(&a), Err(LinalgError::DenseEigen { order: 2 })));
    }
}
