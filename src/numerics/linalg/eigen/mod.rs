//! Eigenpairs of a sparse symmetric problem, with a residual and a bound for each and a proof that none is missing.

mod cuts;
mod factors;
mod iteration;
mod pairs;
mod slices;

pub use pairs::{EigenPairs, EigenTimes};

use super::bound::{Quality, ROUNDING};
use super::count::CountCheck;
use super::factor::Factor;
use super::lowest::{Ritz, largest_basis};
use super::numeric::Kind;
use super::ordering::Ordering;
use super::symbolic::Symbolic;
use super::symmetric::SymmetricMatrix;
use super::{DenseMatrix, LinalgError, SparseCholesky, SparseMatrix, memory, small};
use cuts::{Side, check_of};
use iteration::Iterated;
use slices::FIRST;
use std::sync::Arc;
use std::time::Instant;

/// Largest order that is solved densely whatever is asked: below it the dense solver is faster and needs no shift.
const DENSE_LIMIT: usize = 60;

/// Largest order that is solved densely where the search for the lowest pairs would fill the whole space; beyond it, slices
/// are faster.
const DENSE_SHARE_LIMIT: usize = 1200;

/// Largest order that is solved densely where an iteration failed: 0.4 GB and a minute.
const DENSE_RESCUE_LIMIT: usize = 4000;

/// Pairs that are searched for at once in any problem, and the most in a large one: where the space is at most a
/// [`SHARE`] of the order, that is faster than slices up to here.
const AT_ONCE: [usize; 2] = [100, 200];

/// Part of the order, as a divisor, beyond which round-off of the highest Ritz values hides the lowest ones.
const SHARE: usize = 4;

/// Blocks [n x count] that are held at the same time, about.
const COPIES: u64 = 6;

/// Pairs pursued beyond those wanted: among them a gap is found in which to count.
const BEYOND: usize = 4;

/// How often missing pairs, or a gap, are looked for.
const ROUNDS: usize = 5;

/// Missing pairs beyond which it is asked first whether the wanted ones are the lowest all the same: a crowd of hundreds of equal
/// eigenvalues would take a space larger than itself.
const MISSING: usize = 16;

/// Rounds after which equal eigenvalues are taken for a crowd without end.
const CROWDED: usize = 3;

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

    /// Round-off of `x^T K x` where zero should be, 1/s^2: that of the motion in which all unknowns are equal, of unit mass, as far as there
    /// is mass. Motions of a rigid body have as much to an order of magnitude.
    pub fn rounding_of_zero(&self) -> f64 {
        let n = self.order();
        let ones = DenseMatrix::from_fn(n, 1, |_, _| 1.0);
        let mass: f64 = self.mass.times(ones.as_ref()).col_as_slice(0).iter().sum();
        let scatter: f64 = self.stiffness.energy_scatters(ones.as_ref()).iter().sum();
        let rounding = ROUNDING * f64::EPSILON * scatter / mass;
        if rounding.is_finite() { rounding } else { 0.0 }
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
    /// [`LinalgError::TooManyModes`] if the problem has fewer; [`LinalgError::ModesTooLarge`] if there is no memory for
    /// them; [`LinalgError::MissingModes`] if pairs that exist were not found; [`LinalgError::Residual`] for a pair that
    /// does not satisfy its equation; what factorisation and iteration report.
    pub fn lowest(&self, count: usize) -> Result<EigenPairs, LinalgError> {
        let order = self.order();
        if count == 0 || count > order {
            return Err(LinalgError::TooManyModes {
                asked: count,
                available: order,
            });
        }
        self.find_room(count)?;
        let fills = largest_basis(count + BEYOND.min(order - count)) > order;
        let dense = order <= DENSE_LIMIT
            || self.is_too_small_for_slices() && fills
            || order <= DENSE_SHARE_LIMIT && fills;
        if dense {
            let found = self.by_dense_solver(count);
            return found.map_err(|error| self.explained(error));
        }
        let [any, large] = AT_ONCE;
        let small_share = SHARE * largest_basis(count + BEYOND) <= order;
        let mut found = Err(LinalgError::NoGap { asked: count });
        if count <= any || count <= large && small_share {
            found = self.lowest_at_once(count);
        }
        if count > FIRST && failed(&found) {
            found = self.lowest_in_slices(count);
        }
        if order <= DENSE_RESCUE_LIMIT && failed(&found) {
            found = self.by_dense_solver(count);
        }
        found.map_err(|error| self.explained(error))
    }

    /// The `count` lowest pairs by one search, counted in a gap behind them.
    fn lowest_at_once(&self, count: usize) -> Result<EigenPairs, LinalgError> {
        let order = self.order();
        let mut times = EigenTimes {
            order: self.order_s,
            ..EigenTimes::default()
        };
        let mut beyond = BEYOND.min(order - count);
        let mut check = None;
        for round in 1..=ROUNDS {
            let iterated = self.iterate(count, beyond, round, &mut times)?;
            let Iterated {
                ritz,
                quality,
                shift,
                counted,
            } = iterated;
            let Some((value, counted)) = counted else {
                if round >= CROWDED
                    && let Some(found) = self.count_before(&ritz, count, shift)
                {
                    return self.finished(ritz, quality, count, found, shift, times);
                }
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
            if counted > below + MISSING
                && let Some(found) = self.count_before(&ritz, count, shift)
            {
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
        let (below, count) = self.count_near(limit, Side::Above)?;
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

    /// All eigenpairs with values between `low` and `high`, 1/s^2; one that lies on an end is among them. An end that
    /// round-off cannot tell from zero is below the rigid motions if it is `low`, above them if it is `high`.
    ///
    /// # Errors
    /// As [`EigenProblem::lowest`].
    pub fn between(&self, low: f64, high: f64) -> Result<EigenPairs, LinalgError> {
        let started = Instant::now();
        let low = self.count_near(low, Side::Below)?;
        let high = self.count_near(high, Side::Above)?;
        let elapsed = started.elapsed().as_secs_f64();
        let check = check_of(low, high);
        let mut pairs = if check.counted == 0 {
            EigenPairs::none(self.order(), high.0)
        } else if low.1 == 0 {
            self.lowest(high.1)?
        } else {
            self.find_room(check.counted)?;
            let mut found = Err(LinalgError::NoGap { asked: high.1 });
            if !self.is_too_small_for_slices() {
                let nearer = self.nearer_end(high)?;
                found = self
                    .slices(low, high.1, Some(nearer))
                    .and_then(|(slices, _)| self.joined(slices));
            }
            if self.order() <= DENSE_RESCUE_LIMIT && failed(&found) {
                found = self.by_dense_solver(high.1);
                if let Ok(pairs) = &mut found {
                    pairs.drop_first(low.1);
                }
            }
            found?
        };
        pairs.count_check = check;
        pairs.times.order = self.order_s;
        pairs.times.count += elapsed;
        Ok(pairs)
    }

    /// No eigenvalues at all: stiffness and mass are too far apart for any number.
    fn explained(&self, error: LinalgError) -> LinalgError {
        let largest = |a: &SymmetricMatrix| a.diagonal().into_iter().fold(0.0, f64::max);
        match error {
            LinalgError::TooManyModes { available: 0, .. } => LinalgError::NoFrequency {
                order: self.order(),
                stiffness: largest(&self.stiffness),
                mass: largest(&self.mass),
            },
            error => error,
        }
    }

    /// An error if there is no memory for so many pairs.
    fn find_room(&self, count: usize) -> Result<(), LinalgError> {
        let bytes = 8 * COPIES * self.order() as u64 * count as u64;
        match memory::available() {
            Some(free) if bytes > free => Err(LinalgError::ModesTooLarge {
                asked: count,
                order: self.order(),
                bytes,
                free,
            }),
            _ => Ok(()),
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

    fn by_dense_solver(&self, count: usize) -> Result<EigenPairs, LinalgError> {
        let mut times = EigenTimes {
            order: self.order_s,
            ..EigenTimes::default()
        };
        let started = Instant::now();
        let shift = self.free_shift();
        let (ritz, check) = small::all_pairs(&self.stiffness, &self.mass, count, shift)?;
        let shifted = self.stiffness.shifted(shift, &self.mass);
        let factor = Factor::double(&self.symbolic, &shifted, Kind::Indefinite)?;
        let quality = Quality::of(&self.stiffness, &self.mass, &factor, shift, &ritz, count);
        times.iterate = started.elapsed().as_secs_f64();
        self.finished(ritz, quality, count, check, shift, times)
    }
}

/// Whether an iteration failed where another way may not.
fn failed(found: &Result<EigenPairs, LinalgError>) -> bool {
    found.as_ref().is_err_and(LinalgError::is_of_iteration)
}

#[cfg(test)]
mod many_tests;
#[cfg(test)]
mod tests;
