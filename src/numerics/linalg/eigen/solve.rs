//! The pairs that are asked for, by the way that suits their number: dense, by one search, in slices.

use super::super::lowest::largest_basis;
use super::super::{
    CountCheck, DenseMatrix, EigenPairs, EigenProblem, EigenTimes, Factor, Kind, LinalgError, SymmetricMatrix,
    SymmetricSpectrum, symmetric_generalised_eigen,
};
use super::cuts::{ABOVE, BELOW, check_of};
use super::iteration::BEYOND;
use super::slices::FIRST;
use crate::numerics::Told;
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

/// Gap in which the dense solver's pairs are counted, relative to the distance from the shift: equal values of one motion
/// differ by round-off.
const SMALLEST_GAP: f64 = 1e-5;

impl EigenProblem {
    /// The `count` lowest eigenpairs.
    ///
    /// # Errors
    /// [`LinalgError::TooManyModes`] if the problem has fewer; [`LinalgError::Refused`] if there is no memory for
    /// them; [`LinalgError::Iteration`] if pairs that exist were not found, or for a pair that
    /// does not satisfy its equation; what factorisation and iteration report.
    pub fn lowest(&self, count: usize) -> Result<EigenPairs, LinalgError> {
        self.lowest_told(count, &|_| {})
    }

    /// The same; `told` hears which part is found.
    ///
    /// # Errors
    /// As [`EigenProblem::lowest`].
    pub(crate) fn lowest_told(&self, count: usize, told: Told<'_>) -> Result<EigenPairs, LinalgError> {
        let order = self.order();
        if count == 0 || count > order {
            return Err(LinalgError::TooManyModes { asked: count, available: order });
        }
        self.find_room(count)?;
        let fills = largest_basis(count + BEYOND.min(order - count)) > order;
        let dense =
            order <= DENSE_LIMIT || self.is_too_small_for_slices() && fills || order <= DENSE_SHARE_LIMIT && fills;
        if dense {
            let found = self.by_dense_solver(count);
            return found.map_err(|error| self.explained(error));
        }
        let [any, large] = AT_ONCE;
        let small_share = SHARE * largest_basis(count + BEYOND) <= order;
        let mut found = Err(LinalgError::no_gap(count));
        if count <= any || count <= large && small_share {
            found = self.lowest_at_once(count, told);
        }
        if count > FIRST && failed(&found) {
            found = self.lowest_in_slices(count, told);
        }
        if order <= DENSE_RESCUE_LIMIT && failed(&found) {
            found = self.by_dense_solver(count);
        }
        found.map_err(|error| self.explained(error))
    }

    /// All eigenpairs below `limit`, 1/s^2, of which there may be none.
    ///
    /// # Errors
    /// As [`EigenProblem::lowest`].
    pub(crate) fn below(&self, limit: f64, told: Told<'_>) -> Result<EigenPairs, LinalgError> {
        let started = Instant::now();
        let (below, count) = self.count_near(limit, ABOVE)?;
        let elapsed = started.elapsed().as_secs_f64();
        if count == 0 {
            let mut none = EigenPairs::none(self.order(), below);
            none.times.order = self.order_s;
            none.times.count = elapsed;
            return Ok(none);
        }
        let mut pairs = self.lowest_told(count, told)?;
        pairs.times.count += elapsed;
        Ok(pairs)
    }

    /// All eigenpairs with values between `low` and `high`, 1/s^2; one that lies on an end is among them. An end that
    /// round-off cannot tell from zero is below the rigid motions if it is `low`, above them if it is `high`.
    ///
    /// # Errors
    /// As [`EigenProblem::lowest`].
    pub(crate) fn between(&self, low: f64, high: f64, told: Told<'_>) -> Result<EigenPairs, LinalgError> {
        let started = Instant::now();
        let low = self.count_near(low, BELOW)?;
        let high = self.count_near(high, ABOVE)?;
        let elapsed = started.elapsed().as_secs_f64();
        let check = check_of(low, high);
        let mut pairs = if check.counted == 0 {
            EigenPairs::none(self.order(), high.0)
        } else if low.1 == 0 {
            self.lowest_told(high.1, told)?
        } else {
            self.find_room(check.counted)?;
            let mut found = Err(LinalgError::no_gap(high.1));
            if !self.is_too_small_for_slices() {
                let nearer = self.nearer_end(high)?;
                let of_band = |part: f64| told((part * high.1 as f64 - low.1 as f64) / check.counted as f64);
                found = self.slices(low, high.1, Some(nearer), &of_band).and_then(|(slices, _)| self.joined(slices));
            }
            if self.order() <= DENSE_RESCUE_LIMIT && failed(&found) {
                found = self.by_dense_solver(high.1);
                if let Ok(pairs) = &mut found {
                    pairs.keep(low.1..pairs.values.len());
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

    /// The `count` lowest of all eigenpairs, counted in the first gap behind them.
    ///
    /// # Errors
    /// [`LinalgError::TooManyModes`] if fewer have mass; what the dense solver reports.
    fn by_dense_solver(&self, count: usize) -> Result<EigenPairs, LinalgError> {
        let mut times = EigenTimes { order: self.order_s, ..EigenTimes::default() };
        let started = Instant::now();
        let shift = self.free_shift();
        let spectrum = symmetric_generalised_eigen(&dense(&self.stiffness), &dense(&self.mass))?;
        let available = spectrum.values.iter().take_while(|value| value.is_finite()).count();
        if count > available {
            return Err(LinalgError::TooManyModes { asked: count, available });
        }
        let values = spectrum.values[..available].to_vec();
        let gap = |place: &usize| values[*place] - values[place - 1] > SMALLEST_GAP * (values[*place] - shift);
        let counted = (count..available).find(gap).unwrap_or(available);
        let below = match values.get(counted) {
            Some(next) => 0.5 * (values[counted - 1] + next),
            None => 2.0 * values[counted - 1].abs(),
        };
        let check = CountCheck::from_lowest(below, counted, counted);
        let vectors = spectrum.vectors.subcols(0, available).to_owned();
        let ritz = SymmetricSpectrum { values, vectors };
        let shifted = self.stiffness.shifted(shift, &self.mass);
        let factor = Factor::double(&self.plan, &shifted, Kind::Indefinite)?;
        let pairs = EigenPairs::judged(&self.stiffness, &self.mass, &factor, shift, &ritz, count);
        times.iterate = started.elapsed().as_secs_f64();
        self.finished(pairs, check, times)
    }
}

/// Both triangles of a matrix, zeros and all.
fn dense(a: &SymmetricMatrix) -> DenseMatrix {
    let mut full = DenseMatrix::zeros(a.order(), a.order());
    for column in 0..a.order() {
        for (row, value) in a.column(column) {
            full[(row, column)] = value;
            full[(column, row)] = value;
        }
    }
    if let Some(followers) = &a.followers {
        followers.add_dense(&mut full);
    }
    full
}

/// Whether an iteration failed where another way may not.
fn failed(found: &Result<EigenPairs, LinalgError>) -> bool {
    matches!(found, Err(LinalgError::Iteration(_)))
}
