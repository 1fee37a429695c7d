//! Eigenpairs of a sparse symmetric problem, with a residual and a bound for each and a proof that none is missing.

use super::bound::Quality;
use super::count::{CountCheck, count_below, count_between};
use super::factor::{Factor, FactorMemory};
use super::lowest::{Ritz, Search, largest_basis};
use super::numeric::Kind;
use super::ordering::Ordering;
use super::symbolic::Symbolic;
use super::symmetric::SymmetricMatrix;
use super::{DenseMatrix, LinalgError, SparseCholesky, SparseMatrix, band, small};
use std::sync::Arc;
use std::time::Instant;

/// Largest order that is solved densely whatever is asked: below it the dense solver is faster and needs no shift.
const DENSE_LIMIT: usize = 60;

/// Pairs pursued beyond those wanted: among them a gap is found in which to count.
const BEYOND: usize = 4;

/// Gap in which it is counted, relative to the distance from the shift.
const SMALLEST_GAP: f64 = 1e-5;

/// How often missing pairs, or a gap, are looked for.
const ROUNDS: usize = 5;

/// Shift for a structure that can move freely, in units of the smallest `K_ii / M_ii`: far below the first elastic
/// eigenvalue of a mesh worth computing, far above the round-off of a rigid motion.
const FREE_SHIFT: f64 = -1e-4;

/// Entries of a factor above which `L B L^T` is faster than `L L^T`, definite or not (9.1 s against 11.1 s for 2.1e8
/// entries; 0.7 s against 0.5 s for 2.1e7).
const LARGE: usize = 1 << 26;

/// Largest relative residual of a mode. That of a rigid mode is a ratio of round-off to the shift's term; a
/// frequency's relative error is below the square of it.
const LARGEST_RESIDUAL: f64 = 1e-5;

/// Where the time of an eigenvalue computation went, s.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EigenTimes {
    /// Ordering, permutation, symbolic analysis.
    pub order: f64,
    /// Numerical factorisation for the iteration.
    pub factor: f64,
    /// Iteration.
    pub iterate: f64,
    /// Factorisations that count eigenvalues.
    pub count: f64,
}

/// Eigenpairs of `K x = lambda M x`.
#[derive(Debug, Clone)]
pub struct EigenPairs {
    /// Eigenvalues lambda = (2 pi f)^2, 1/s^2, ascending.
    pub values: Vec<f64>,
    /// Eigenvectors [n x count], `x^T M x = 1`.
    pub vectors: DenseMatrix,
    /// `|K x - lambda M x| / (|K x| + |lambda - sigma| |M x|)` of every pair, sigma the shift.
    pub residuals: Vec<f64>,
    /// How far each eigenvalue may be from the true one of these matrices, 1/s^2.
    pub bounds: Vec<f64>,
    /// Part of the bound that is round-off of `x^T K x`, 1/s^2: an eigenvalue that is not larger is zero.
    pub rounding: Vec<f64>,
    /// Largest entry of `X^T M X - 1`.
    pub orthogonality: f64,
    /// Eigenvalues counted and found below a value: the proof that none is missing.
    pub count_check: CountCheck,
    /// Shift sigma of the factor that it was iterated with, 1/s^2.
    pub shift: f64,
    /// Where the time went.
    pub times: EigenTimes,
}

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
        let symbolic = Arc::new(Symbolic::new(&stiffness.shifted(1.0, &mass))?);
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
            let (ritz, quality, shift, memory) = self.iterate(count, beyond, round, &mut times)?;
            let Some((gap, below)) = widest_gap(&ritz.values, count, shift) else {
                beyond = (2 * beyond + BEYOND).min(order - count);
                continue;
            };
            let started = Instant::now();
            let (value, counted) =
                count_between(&self.symbolic, &self.stiffness, &self.mass, gap, memory)?;
            times.count += started.elapsed().as_secs_f64();
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

    fn middle_factor(&self, low: f64, high: f64) -> Result<(f64, Factor), LinalgError> {
        let mut failed = LinalgError::NoGap { asked: 1 };
        for place in [0.5, 0.47, 0.53, 0.44] {
            let sigma = low + place * (high - low);
            let shifted = self.stiffness.shifted(sigma, &self.mass);
            match Factor::double(&self.symbolic, &shifted, Kind::Indefinite) {
                Ok(factor) => return Ok((sigma, factor)),
                Err(error) => failed = error,
            }
        }
        Err(failed)
    }

    /// Factor of K, or of K less a shift below zero if K is not positive definite.
    fn definite_factor(&self) -> Result<(f64, Arc<Factor>), LinalgError> {
        if let Some(factor) = self.factor.as_ref().filter(|factor| factor.is_sharp()) {
            return Ok((0.0, Arc::clone(factor)));
        }
        let attempt = |sigma: f64| -> Result<(f64, Arc<Factor>), LinalgError> {
            let shifted = self.stiffness.shifted(sigma, &self.mass);
            let factor = self.definite(&shifted, sigma != 0.0)?;
            Ok((sigma, Arc::new(factor)))
        };
        let mut tried = attempt(0.0);
        if let Ok((_, factor)) = &tried
            && !factor.is_sharp()
        {
            tried = Err(LinalgError::NearlySingular {
                order: self.order(),
                contraction: factor.contraction,
            });
        }
        let first = self.free_shift();
        for larger in [1.0, 1e2, 1e4] {
            match tried {
                Err(LinalgError::Factorisation { .. }) | Ok(_) => break,
                Err(_) => tried = attempt(larger * first),
            }
        }
        tried
    }

    /// Factor of a matrix that must be positive definite, in double precision only where it was asked for before.
    fn definite(&self, a: &SymmetricMatrix, thorough: bool) -> Result<Factor, LinalgError> {
        let factorise = if thorough { Factor::new } else { Factor::quick };
        let large = self.symbolic.entries() > LARGE;
        let kind = if large {
            Kind::Indefinite
        } else {
            Kind::Definite
        };
        let factor = factorise(&self.symbolic, a, kind, FactorMemory::default())?;
        match factor.negative() {
            0 => Ok(factor),
            negative => Err(LinalgError::Indefinite {
                order: a.order(),
                negative,
            }),
        }
    }

    fn free_shift(&self) -> f64 {
        let (k, m) = (self.stiffness.diagonal(), self.mass.diagonal());
        let smallest = k
            .iter()
            .zip(&m)
            .map(|(k, m)| k / m)
            .filter(|ratio| ratio.is_finite() && *ratio > 0.0)
            .fold(f64::INFINITY, f64::min);
        if smallest.is_finite() {
            FREE_SHIFT * smallest
        } else {
            -1.0
        }
    }

    fn iterate(
        &self,
        count: usize,
        beyond: usize,
        rounds: usize,
        times: &mut EigenTimes,
    ) -> Result<(Ritz, Quality, f64, FactorMemory), LinalgError> {
        let started = Instant::now();
        let (mut shift, mut factor) = self.definite_factor()?;
        times.factor += started.elapsed().as_secs_f64();
        let started = Instant::now();
        let mut search = Search::new(&self.stiffness, &self.mass, shift, count, beyond);
        for _ in 0..rounds {
            search.explore(&factor)?;
        }
        // a shift far below the wanted values makes all of them look alike
        let last = search.value(count - 1)?;
        if shift < 0.0 && last > 0.0 && last < -0.1 * shift {
            let nearer = self.stiffness.shifted(-last, &self.mass);
            if let Ok(better) = self.definite(&nearer, false) {
                (shift, factor) = (-last, Arc::new(better));
                search.shift = shift;
                search.explore(&factor)?;
            }
        }
        let ritz = search.converge(&factor)?;
        drop(search);
        let quality = Quality::of(&self.stiffness, &self.mass, &factor, shift, &ritz, count);
        times.iterate += started.elapsed().as_secs_f64();
        let memory =
            Arc::into_inner(factor).map_or_else(FactorMemory::default, Factor::into_memory);
        Ok((ritz, quality, shift, memory))
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

impl EigenPairs {
    fn none(order: usize, below: f64) -> Self {
        Self {
            values: Vec::new(),
            vectors: DenseMatrix::zeros(order, 0),
            residuals: Vec::new(),
            bounds: Vec::new(),
            rounding: Vec::new(),
            orthogonality: 0.0,
            count_check: CountCheck {
                above: None,
                below,
                counted: 0,
                found: 0,
            },
            shift: 0.0,
            times: EigenTimes::default(),
        }
    }

    fn drop_first(&mut self, dropped: usize) {
        for list in [
            &mut self.values,
            &mut self.residuals,
            &mut self.bounds,
            &mut self.rounding,
        ] {
            list.drain(..dropped);
        }
        self.vectors = self
            .vectors
            .subcols(dropped, self.vectors.ncols() - dropped)
            .to_owned();
    }
}

/// The widest gap between the last wanted value and the last pursued one, relative to the distance from the shift,
/// and how many values lie below it; `None` if all are too narrow to count in.
fn widest_gap(values: &[f64], count: usize, shift: f64) -> Option<([f64; 2], usize)> {
    let width = |place: usize| (values[place] - values[place - 1]) / (values[place] - shift);
    let widest = (count..values.len()).max_by(|&a, &b| width(a).total_cmp(&width(b)));
    match widest {
        Some(place) if width(place) > SMALLEST_GAP => {
            Some(([values[place - 1], values[place]], place))
        }
        Some(_) => None,
        // every eigenvalue of the problem was asked for
        None => values
            .last()
            .map(|&last| ([last, 2.0 * last - shift], values.len())),
    }
}

#[cfg(test)]
#[path = "eigen_tests.rs"]
mod tests;
