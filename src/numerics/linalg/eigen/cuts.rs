//! Values below which eigenvalues are counted, by Sylvester's law of inertia.

use super::super::lowest::{largest_ratio, round_off};
use super::super::{CountCheck, EigenProblem, Factor, FactorMemory, Kind, LinalgError};
use super::factors::FIRM;

/// Distance, relative to the value, within which an eigenvalue lies on it: ten times the usual error of a computed one.
const ON_AN_END: f64 = 1e-8;

/// How far a value on an eigenvalue is moved, relative to it.
const NEAR: f64 = 1e-6;

/// Where in a gap eigenvalues are counted, one place after the other until the factor is good.
const PLACES: [f64; 5] = [0.5, 0.41, 0.59, 0.32, 0.68];

/// A value, 1/s^2, and how many eigenvalues lie below it.
pub(super) type Cut = (f64, usize);

/// Signs of the sides of an eigenvalue, to one of which a value is moved that lies on it.
pub(super) const BELOW: f64 = -1.0;
pub(super) const ABOVE: f64 = 1.0;

/// The check of pairs of which all between two cuts were found.
pub(super) fn check_of(low: Cut, high: Cut) -> CountCheck {
    let counted = high.1.saturating_sub(low.1);
    CountCheck { above: (low.0 > 0.0).then_some(low.0), below: high.0, counted, found: counted }
}

impl EigenProblem {
    /// Eigenvalues below a value, which is moved to one side: a little, so that those that lie on it are on the other, and
    /// further if it cannot be told from an eigenvalue or from zero.
    pub(super) fn count_near(&self, value: f64, sign: f64) -> Result<Cut, LinalgError> {
        let value = value.min(self.above_all());
        let value = value + sign * ON_AN_END * value.abs();
        let from_zero = sign * (sign * value).max(0.0);
        let singular = |error: &LinalgError| matches!(error, LinalgError::NearlySingular { .. });
        let mut found = self.count_below(value, FactorMemory::default()).map(|counted| (value, counted));
        let nearest = sign * FIRM * round_off(&self.stiffness, &self.mass);
        for end in [
            value + sign * NEAR * value.abs(),
            value + sign * 1e2 * NEAR * value.abs(),
            from_zero + nearest,
            from_zero + 1e2 * nearest,
        ] {
            match &found {
                Err(error) if singular(error) => found = self.count_between([value, end], FactorMemory::default()),
                _ => break,
            }
        }
        found
    }

    /// Number of eigenvalues below `value`.
    ///
    /// # Errors
    /// [`LinalgError::NearlySingular`] if `value` is an eigenvalue, or [`LinalgError::Factorisation`].
    fn count_below(&self, value: f64, memory: FactorMemory) -> Result<usize, LinalgError> {
        let shifted = self.stiffness.shifted(value, &self.mass);
        Ok(Factor::new(&self.symbolic, &shifted, Kind::Indefinite, memory)?.negative())
    }

    /// Counts somewhere between `low` and `high`, between which no eigenvalue is known; the place is moved when the
    /// factor says that it sits on one.
    ///
    /// # Errors
    /// As `count_below`, of the last place tried.
    pub(super) fn count_between(&self, [low, high]: [f64; 2], mut memory: FactorMemory) -> Result<Cut, LinalgError> {
        let mut failed = LinalgError::NearlySingular { order: self.order(), contraction: f64::INFINITY };
        for place in PLACES {
            let value = low + place * (high - low);
            match self.count_below(value, std::mem::take(&mut memory)) {
                Ok(counted) => return Ok((value, counted)),
                Err(error @ LinalgError::NearlySingular { .. }) => failed = error,
                Err(error) => return Err(error),
            }
        }
        Err(failed)
    }

    /// The end of a band, lowered towards the eigenvalues if it is far above all.
    pub(super) fn nearer_end(&self, mut end: Cut) -> Result<f64, LinalgError> {
        while end.0 > largest_ratio(&self.stiffness, &self.mass) {
            let lower = self.count_near(0.25 * end.0, ABOVE)?;
            if lower.1 < end.1 {
                break;
            }
            end = lower;
        }
        Ok(end.0)
    }

    /// A value above all eigenvalues, 1/s^2: those of elements are at most some hundred times the largest
    /// `K_ii / M_ii`.
    pub(super) fn above_all(&self) -> f64 {
        1e6 * largest_ratio(&self.stiffness, &self.mass)
    }
}
