//! Response of a sparse system to harmonic loads: `Z(w) x = f`, `Z(w) = K - w^2 M + i (w C + K_s)`.
//!
//! Z is complex symmetric, not Hermitian. The real matrix `K - w^2 M` is factorised (one analysis serves all
//! frequencies) and a Krylov iteration brings the damping in: preconditioned, the eigenvalues of Z are
//! `1 + i d_j / (lambda_j - w^2)` with `d_j` the damping of mode j, close to 1 but for the few modes whose resonance is
//! near. Amplitudes follow `exp(+i w t)`: a displacement that lags its force has a negative imaginary part.

mod dense;
mod error;
mod krylov;
mod matrices;

pub use dense::ComplexSolution;
pub(crate) use dense::complex_solve;
pub use error::HarmonicError;
pub use matrices::{HarmonicDamping, MotionDamping};

use super::{ComplexMatrix, DenseMatrix, Factor, FactorMemory, Kind, LinalgError, Ordering, Plan, SparseMatrix};
use faer::c64;
use matrices::HarmonicMatrices;
use std::f64::consts::TAU;
use std::mem::take;
use std::sync::{Arc, Mutex};
use std::time::Instant;

/// Residual that is round-off, in units of eps times what is summed in `Z x`.
const ROUNDING: f64 = 8.0;

/// Contractions up to which a factor serves the iteration, in single and in double precision. A single direction that
/// the factor has wrong costs an iteration or two; one that its inverse stretches until nothing else is left of
/// sixteen digits costs the solution. Measured on resonances of a solid of 56 000 degrees of freedom: 13 iterations at 1.0
/// and 1.3 in single precision, 196 at 51; in double precision 7 at 5e-8, none reached at 0.6.
const LARGEST_CONTRACTION: [f64; 2] = [2.0, 1e-6];

/// Squared frequencies beside a resonance, as factors: at 5 % off, 9 iterations instead of 13 on the same solid.
const BESIDE: [f64; 4] = [1.05, 0.95, 1.1, 0.9];

/// Contraction of a factor in double precision above which an undamped response has fewer than four certain digits.
const RESONANCE: f64 = 1e-4;

/// A harmonic problem, ordered and analysed.
#[derive(Debug)]
pub struct HarmonicProblem {
    ordering: Ordering,
    matrices: HarmonicMatrices,
    plan: Arc<Plan>,
    memory: Mutex<FactorMemory>,
}

/// Response at one frequency.
#[derive(Debug, Clone)]
pub struct HarmonicSolution {
    /// Angular frequency w, rad/s.
    pub omega: f64,
    /// Displacement amplitudes x [n x p], m (rad), rows as in the matrices restricted to what was kept.
    pub displacements: ComplexMatrix,
    /// `|f - Z x| / |f|` of each load \[p\], computed from x; 0 for a load of zeros.
    pub residuals: Vec<f64>,
    /// Iterations made for each load \[p\].
    pub iterations: Vec<usize>,
    /// What took how long.
    pub times: HarmonicTimes,
}

/// Times of one frequency, s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HarmonicTimes {
    /// Factorisation.
    pub factor: f64,
    /// Iteration.
    pub iterate: f64,
}

/// A real matrix [n x p] as a complex one.
pub(crate) fn complex_columns(real: &DenseMatrix) -> ComplexMatrix {
    ComplexMatrix::from_fn(real.nrows(), real.ncols(), |row, column| c64::new(real[(row, column)], 0.0))
}

impl HarmonicProblem {
    /// Orders and analyses K and M [n x n], symmetric, both triangles stored, with their damping. Nothing of them is kept:
    /// the caller may drop them.
    ///
    /// # Errors
    /// [`HarmonicError::Input`]; [`LinalgError::Shape`] for matrices that do not fit;
    /// [`LinalgError::Refused`] for a row without stiffness and mass; [`LinalgError::Factorisation`].
    pub fn new(k: &SparseMatrix, m: &SparseMatrix, damping: &HarmonicDamping<'_>) -> Result<Self, HarmonicError> {
        let all: Vec<usize> = (0..k.rows()).collect();
        Self::restricted(k, m, damping, &all)
    }

    /// The same over the rows and columns `kept` alone, ascending.
    ///
    /// # Errors
    /// As [`HarmonicProblem::new`].
    pub fn restricted(
        k: &SparseMatrix,
        m: &SparseMatrix,
        damping: &HarmonicDamping<'_>,
        kept: &[usize],
    ) -> Result<Self, HarmonicError> {
        let ordering = Ordering::of_problem(k, m, kept)?;
        let matrices = HarmonicMatrices::new(k, m, damping, &ordering)?;
        let plan = Arc::new(Plan::of(&matrices.real(1.0))?);
        Ok(Self { ordering, matrices, plan, memory: Mutex::default() })
    }

    /// Number of degrees of freedom.
    pub fn order(&self) -> usize {
        self.matrices.stiffness.order()
    }

    /// Response to `loads` [n x p] (N, N m) at the angular frequency `omega` (rad/s, >= 0).
    ///
    /// # Errors
    /// [`HarmonicError::Input`], [`LinalgError::Shape`];
    /// [`HarmonicError::Resonance`] and [`HarmonicError::FreeAtRest`] where there is no response;
    /// [`HarmonicError::NotSolved`] if the iteration fails.
    pub fn solve(&self, omega: f64, loads: &ComplexMatrix) -> Result<HarmonicSolution, HarmonicError> {
        if !(omega >= 0.0 && omega.is_finite()) {
            let hz = omega / TAU;
            return Err(HarmonicError::Input(format!("a frequency must be zero or more and finite, found {hz} Hz")));
        }
        let f = self.split(loads)?;
        let started = Instant::now();
        let factor = self.factor(omega)?;
        let mut times = HarmonicTimes { factor: started.elapsed().as_secs_f64(), ..HarmonicTimes::default() };
        let started = Instant::now();
        let found = krylov::solve(&f, |x| self.matrices.times(omega, x), |x| factor.solve(x.as_mut()));
        factor.check()?;
        times.iterate = started.elapsed().as_secs_f64();
        for (load, &residual) in found.residuals.iter().enumerate() {
            self.judge(omega, load, residual, &f, &found)?;
        }
        self.keep(factor);
        Ok(HarmonicSolution {
            omega,
            displacements: self.joined(&found.x),
            residuals: found.residuals,
            iterations: found.iterations,
            times,
        })
    }

    /// A factor that the iteration can work with: of `K - w^2 M`, or of its neighbour where that is nearly singular.
    /// Without damping there is no neighbour: the factor must be good, or the structure is in resonance.
    fn factor(&self, omega: f64) -> Result<Factor, HarmonicError> {
        let squared = omega * omega;
        let mut factor = self.factorised(squared, false)?;
        if omega == 0.0 || !self.matrices.is_damped(omega) {
            if !factor.is_double() && factor.contraction > LARGEST_CONTRACTION[0] {
                drop(factor);
                factor = self.factorised(squared, true)?;
            }
            let limit = if factor.is_double() { RESONANCE } else { LARGEST_CONTRACTION[0] };
            return match factor.contraction {
                contraction if contraction <= limit => Ok(factor),
                uncertainty if omega > 0.0 => Err(HarmonicError::Resonance { hz: omega / TAU, uncertainty }),
                _ => Err(HarmonicError::FreeAtRest),
            };
        }
        let is_good = |factor: &Factor| factor.contraction <= LARGEST_CONTRACTION[usize::from(factor.is_double())];
        for double in [false, true] {
            for beside in BESIDE {
                if is_good(&factor) {
                    return Ok(factor);
                }
                self.keep(factor);
                factor = self.factorised(beside * squared, double)?;
            }
        }
        // the iteration says itself whether it comes to an end with this one
        Ok(factor)
    }

    fn factorised(&self, squared: f64, double: bool) -> Result<Factor, LinalgError> {
        let memory = self.memory.lock().map_or_else(|_| FactorMemory::default(), |mut kept| take(&mut *kept));
        let a = self.matrices.real(squared);
        Factor::unjudged(&self.plan, &a, Kind::Indefinite, double, memory)
    }

    fn keep(&self, factor: Factor) {
        if let Ok(mut kept) = self.memory.lock() {
            *kept = factor.into_memory();
        }
    }

    fn judge(
        &self,
        omega: f64,
        load: usize,
        residual: f64,
        f: &DenseMatrix,
        found: &krylov::Iterated,
    ) -> Result<(), HarmonicError> {
        if residual <= krylov::TOLERANCE {
            return Ok(());
        }
        let columns = [2 * load, 2 * load + 1];
        let [re, im] = columns.map(|column| found.x.col_as_slice(column));
        let size = columns.map(|column| f.col(column).norm_l2());
        let rounding = f64::EPSILON * self.matrices.scatter(omega, re, im) / size[0].hypot(size[1]);
        if residual <= ROUNDING * rounding {
            return Ok(());
        }
        Err(HarmonicError::NotSolved { hz: omega / TAU, load, residual, rounding, iterations: found.iterations[load] })
    }

    /// Power that damping takes from each motion [n x k] at `omega` (rad/s), averaged over a period \[k\], W:
    /// `w x^H (w C + K_s) x / 2`. It equals the power of the loads, `w Im(x^H f) / 2` with the sign of `exp(+i w t)`.
    ///
    /// # Errors
    /// [`LinalgError::Shape`], [`HarmonicError::Input`] for entries that are not finite.
    pub fn dissipated_power(&self, omega: f64, displacements: &ComplexMatrix) -> Result<Vec<f64>, HarmonicError> {
        let x = self.split(displacements)?;
        let energies = self.matrices.dissipation(omega, &x);
        Ok(energies.iter().map(|energy| 0.5 * omega * energy).collect())
    }

    /// Complex columns as pairs of real ones, in the factor's order.
    fn split(&self, complex: &ComplexMatrix) -> Result<DenseMatrix, HarmonicError> {
        if complex.nrows() != self.order() {
            return Err(LinalgError::Shape { what: "loads", expected: self.order(), found: complex.nrows() }.into());
        }
        let parts = DenseMatrix::from_fn(self.order(), 2 * complex.ncols(), |row, column| {
            let entry = complex[(row, column / 2)];
            if column % 2 == 0 { entry.re } else { entry.im }
        });
        for column in 0..parts.ncols() {
            if !parts.col_as_slice(column).iter().all(|x| x.is_finite()) {
                return Err(HarmonicError::Input(format!("load {} has an entry that is not finite", column / 2)));
            }
        }
        Ok(self.ordering.forward(&parts))
    }

    fn joined(&self, parts: &DenseMatrix) -> ComplexMatrix {
        let mut own = DenseMatrix::zeros(parts.nrows(), parts.ncols());
        self.ordering.backward(parts, &mut own);
        ComplexMatrix::from_fn(own.nrows(), own.ncols() / 2, |row, column| {
            c64::new(own[(row, 2 * column)], own[(row, 2 * column + 1)])
        })
    }
}

#[cfg(test)]
mod tests;
