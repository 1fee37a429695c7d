//! Eigenpairs of a sparse symmetric problem, with a residual and a bound for each and a proof that none is missing.

mod factors;
mod iteration;
mod pairs;

pub use pairs::{EigenPairs, EigenTimes};

use super::bound::Quality;
use super::count::{CountCheck, count_below, count_between};
use super::factor::{Factor, FactorMemory};
use super::lowest::{Ritz, largest_basis};
use super::numeric::Kind;
use super::ordering::Ordering;
use super::symbolic::Symbolic;
use super::symmetric::SymmetricMatrix;
use super::{DenseMatrix, LinalgError, SparseCholesky, SparseMatrix, band, small};
use iteration::Iterated;
use std::sync::Arc;
use std::time::Instant;

/// Largest order that is solved densely whatever is asked: below it the dense solver is faster and needs no shift.
const DENSE_LIMIT: usize = 60;

/// Pairs pursued beyond those wanted: among them a gap is found in which to count.
const BEYOND: usize = 4;

/// How often missing pairs, or a gap, are looked for.
const ROUNDS: usize = 5;

/// Largest relative residual of a mode. That of a rigid mode is a ratio of round-off to the shift's term; a
/// frequency's relative error is below the square of it.
const LARGEST_RESIDUAL: f64 = 1e-5;

/// Stiffness K and mass M in the order in which they are factorised.
#[derive(Debug, Clone)]
pub struct EigenProblem {
    ordering: Arc<Ordering>,
    stiffness: SymmetricMatrix,
    mass: SymmetricMatrix,
    symbolic: Arc<Symbolic>,
    /// Factor of K, if somebody has it.
    factor: Option<Arc<Factor>>,
    order_s: f64,
}

impl EigenProblem {
    /// Orders and analyses `K x = lambda M x`; both matrices [n x n] symmetric, both triangles stored. Nothing of them
    /// is kept: the caller may drop them.
    ///
    /// # Errors
    /// [`LinalgError::NothingThere`] for a row without stiffness and mass, [`LinalgError::Factorisation`] of order and
    /// analysis.
    pub fn new(k: &SparseMatrix, m: &SparseMatrix) -> Result<Self, LinalgError> {
        let all: Vec<usize> = (0..k.rows()).collect();
        Self::restricted(k, m, &all)
    }

    /// The same over the rows and columns `kept` alone, ascending.
    ///
    /// # Errors
    /// As [`EigenProblem::new`].
    pub fn restricted(
        k: &SparseMatrix,
        m: &SparseMatrix,
        kept: &[usize],
    ) -> Result<Self, LinalgError> {
        let started = Instant::now();
        // of semidefinite matrices a row is empty if its diagonal is
        let empty = |a: &SparseMatrix, row| a.get(row, row).is_none_or(|value| *value == 0.0);
        if let Some(&row) = kept.iter().find(|&&row| empty(k, row) && empty(m, row)) {
            return Err(LinalgError::NothingThere { row });
        }
        let ordering = Ordering::of_part(k, kept)?;
        let stiffness = SymmetricMatrix::permuted(k, &ordering);
        let mass = SymmetricMatrix::permuted(m, &ordering);
        let symbolic = Arc::new(Symbolic::new(&stiffness.shifted(1.0, &mass))?);
        Ok(Self {
            ordering: Arc::new(ordering),
            stiffness,
            mass,
            symbolic,
            factor: None,
            order_s: started.elapsed().as_secs_f64(),
        })
    }

    /// The problem of a stiffness that is factorised already: its order and its factor are used again.
    ///
    /// # Errors
    /// As [`EigenProblem::new`]; [`LinalgError::Shape`] if the factor is that of another matrix.
    pub fn with_factor(
        k: &SparseMatrix,
        m: &SparseMatrix,
        factor: &SparseCholesky,
    ) -> Result<Self, LinalgError> {
        if factor.order() != k.rows() {
            return Err(LinalgError::Shape {
                what: "factor of the stiffness",
                expected: k.rows(),
                found: factor.order(),
            });
        }
        let started = Instant::now();
        let (ordering, factor) = factor.shared();
        let stiffness = SymmetricMatrix::permuted(k, &ordering);
        let mass = SymmetricMatrix::permuted(m, &ordering);
        let symbolic = if stiffness.covers(&mass) {
            Arc::clone(factor.symbolic())
        } else {
            Arc::new(Symbolic::new(&stiffness.shifted(1.0, &mass))?)
        };
        Ok(Self {
            ordering,
            stiffness,
            mass,
            symbolic,
            factor: Some(factor),
            order_s: started.elapsed().as_secs_f64(),
        })
    }

    /// Number of degrees of freedom.
    pub fn order(&self) -> usize {
        self.stiffness.order()
    }

    /// `K X` for `X` [n x k].
    pub fn stiffness_times(&self, x: &DenseMatrix) -> DenseMatrix {
        self.product(&self.stiffness, x)
    }

    /// `M X` for `X` [n x k].
    pub fn mass_times(&self, x: &DenseMatrix) -> DenseMatrix {
        self.product(&self.mass, x)
    }

    fn product(&self, a: &SymmetricMatrix, x: &DenseMatrix) -> DenseMatrix {
        let permuted = a.times(self.ordering.forward(x).as_ref());
        let mut y = DenseMatrix::zeros(x.nrows(), x.ncols());
        self.ordering.backward(&permuted, &mut y);
        y
    }

    /// The `count` lowest eigenpairs.
    ///
    /// # Errors
    /// [`LinalgError::TooManyModes`] if the problem has fewer; [`LinalgError::MissingModes`] if pairs that exist were not
    /// found; [`LinalgError::Residual`] for a pair that does not satisfy its equation; what factorisation and
    /// iteration report.
    pub fn lowest(&self, count: usize) -> Result<EigenPairs, LinalgError> {
        let order = self.order();
        if count == 0 || count > order {
            return Err(LinalgError::TooManyModes {
                asked: count,
                available: order,
            });
        }
        let mut times = EigenTimes {
            order: self.order_s,
            ..EigenTimes::default()
        };
        let mut beyond = BEYOND.min(order - count);
        let mut check = None;
        for round in 1..=ROUNDS {
            if order <= DENSE_LIMIT || largest_basis(count + beyond) > order {
                return self.by_dense_solver(count, times);
            }
            let iterated = self.iterate(count, beyond, round, &mut times)?;
            let Iterated {
                ritz,
                quality,
                shift,
                counted,
            } = iterated;
            let Some((value, counted)) = counted else {
                beyond = (2 * beyond + BEYOND).min(order - count);
                continue;
            };
            let below = ritz.values.iter().filter(|&&found| found < value).count();
            let found = CountCheck {
                above: None,
                below: value,
                counted,
                found: below,
            };
            if counted == below {
                return self.finished(ritz, quality, count, found, shift, times);
            }
            check = Some(found);
            beyond = (beyond + counted.saturating_sub(below) + BEYOND).min(order - count);
        }
        Err(check.map_or(LinalgError::NoGap { asked: count }, LinalgError::missing))
    }

    /// All eigenpairs below `limit`, 1/s^2, of which there may be none.
    ///
    /// # Errors
    /// As [`EigenProblem::lowest`].
    pub fn below(&self, limit: f64) -> Result<EigenPairs, LinalgError> {
        let started = Instant::now();
        let (below, count) = self.count_near(limit)?;
        let elapsed = started.elapsed().as_secs_f64();
        if count == 0 {
            let mut none = EigenPairs::none(self.order(), below);
            none.times.order = self.order_s;
            none.times.count = elapsed;
            return Ok(none);
        }
        let mut pairs = self.lowest(count)?;
        pairs.times.count += elapsed;
        Ok(pairs)
    }

    /// All eigenpairs with values between `low` and `high`, 1/s^2.
    ///
    /// # Errors
    /// As [`EigenProblem::lowest`].
    pub fn between(&self, low: f64, high: f64) -> Result<EigenPairs, LinalgError> {
        let started = Instant::now();
        let (low, before) = self.count_near(low)?;
        let (high, below) = self.count_near(high)?;
        let count = below.saturating_sub(before);
        let elapsed = started.elapsed().as_secs_f64();
        let check = CountCheck {
            above: Some(low),
            below: high,
            counted: count,
            found: count,
        };
        if count == 0 {
            let mut none = EigenPairs::none(self.order(), high);
            none.count_check = check;
            none.times.count = elapsed;
            return Ok(none);
        }
        let mut times = EigenTimes {
            order: self.order_s,
            count: elapsed,
            ..EigenTimes::default()
        };
        if self.order() <= DENSE_LIMIT || band::largest_basis(count) > self.order() {
            let mut pairs = self.by_dense_solver(below, times)?;
            pairs.drop_first(before);
            pairs.count_check = check;
            return Ok(pairs);
        }
        let started = Instant::now();
        let middle = self.middle_factor(low, high)?;
        times.factor = started.elapsed().as_secs_f64();
        let started = Instant::now();
        let ritz = band::between(&self.stiffness, &self.mass, &middle, [low, high], count)?;
        let quality = Quality::of(
            &self.stiffness,
            &self.mass,
            &middle.1,
            middle.0,
            &ritz,
            count,
        );
        times.iterate = started.elapsed().as_secs_f64();
        self.finished(ritz, quality, count, check, middle.0, times)
    }

    /// Eigenvalues below a value that is moved a little if it is an eigenvalue itself.
    fn count_near(&self, value: f64) -> Result<(f64, usize), LinalgError> {
        let attempt = |value: f64| {
            count_below(
                &self.symbolic,
                &self.stiffness,
                &self.mass,
                value,
                FactorMemory::default(),
            )
        };
        match attempt(value) {
            Ok(count) => Ok((value, count)),
            Err(LinalgError::NearlySingular { .. }) => {
                let width = 1e-6 * value.abs();
                count_between(
                    &self.symbolic,
                    &self.stiffness,
                    &self.mass,
                    [value, value + width],
                    FactorMemory::default(),
                )
            }
            Err(error) => Err(error),
        }
    }

    fn finished(
        &self,
        ritz: Ritz,
        quality: Quality,
        count: usize,
        count_check: CountCheck,
        shift: f64,
        times: EigenTimes,
    ) -> Result<EigenPairs, LinalgError> {
        let too_large = |residual: &f64| residual.is_nan() || *residual > LARGEST_RESIDUAL;
        if let Some(mode) = quality.residuals.iter().position(too_large) {
            return Err(LinalgError::Residual {
                mode,
                residual: quality.residuals[mode],
                limit: LARGEST_RESIDUAL,
            });
        }
        let mut vectors = DenseMatrix::zeros(self.order(), count);
        let found = ritz.vectors.subcols(0, count).to_owned();
        self.ordering.backward(&found, &mut vectors);
        Ok(EigenPairs {
            values: quality.values,
            vectors,
            residuals: quality.residuals,
            bounds: quality.bounds,
            rounding: quality.rounding,
            orthogonality: quality.orthogonality,
            count_check,
            shift,
            times,
        })
    }

    fn by_dense_solver(
        &self,
        count: usize,
        mut times: EigenTimes,
    ) -> Result<EigenPairs, LinalgError> {
        let started = Instant::now();
        let (ritz, check) = small::all_pairs(&self.stiffness, &self.mass, count)?;
        let shift = self.free_shift();
        let shifted = self.stiffness.shifted(shift, &self.mass);
        let factor = Factor::double(&self.symbolic, &shifted, Kind::Indefinite)?;
        let quality = Quality::of(&self.stiffness, &self.mass, &factor, shift, &ritz, count);
        times.iterate += started.elapsed().as_secs_f64();
        self.finished(ritz, quality, count, check, shift, times)
    }
}

#[cfg(test)]
mod tests;
