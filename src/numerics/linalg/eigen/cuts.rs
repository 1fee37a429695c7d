//! Values below which eigenvalues are counted, by Sylvester's law of inertia.
//!
//! Which matrix is factorised: K itself, K with a shift below zero, or one from the middle of a band.

use super::super::lowest::{largest_ratio, round_off};
use super::super::{CountCheck, EigenProblem, Factor, FactorMemory, Kind, LinalgError, SymmetricMatrix};
use std::sync::Arc;

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
        Ok(Factor::new(&self.plan, &shifted, Kind::Indefinite, memory)?.negative())
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

/// Shift for a structure that can move freely, in units of the smallest `K_ii / M_ii`: far below the first elastic
/// eigenvalue of a mesh worth computing, far above the round-off of a rigid motion.
const FREE_SHIFT: f64 = -1e-4;

/// Smallest distance of a shift from a rigid motion, in units of the round-off of `K x`: the factor's contraction is
/// about its reciprocal.
pub(super) const FIRM: f64 = 1e6;

impl EigenProblem {
    /// Factor in the middle of a band, or beside it.
    pub(super) fn middle_factor(&self, low: f64, high: f64) -> Result<(f64, Factor), LinalgError> {
        let mut failed = LinalgError::no_gap(1);
        for place in [0.5, 0.47, 0.53, 0.44] {
            let sigma = low + place * (high - low);
            let shifted = self.stiffness.shifted(sigma, &self.mass);
            match Factor::double(&self.plan, &shifted, Kind::Indefinite) {
                Ok(factor) => return Ok((sigma, factor)),
                Err(error) => failed = error,
            }
        }
        Err(failed)
    }

    /// Factor of K, or of K less a shift below zero if K is not positive definite.
    pub(super) fn definite_factor(&self) -> Result<(f64, Arc<Factor>), LinalgError> {
        if let Some(factor) = self.factor.as_ref().filter(|factor| factor.is_sharp()) {
            let light = factor.lightened(&self.stiffness).map(Arc::new);
            return Ok((0.0, light.unwrap_or_else(|| Arc::clone(factor))));
        }
        let attempt = |sigma: f64| -> Result<(f64, Arc<Factor>), LinalgError> {
            let factor = match sigma {
                0.0 => self.definite(&self.stiffness, false)?,
                _ => self.definite(&self.stiffness.shifted(sigma, &self.mass), true)?,
            };
            Ok((sigma, Arc::new(factor)))
        };
        let mut tried = attempt(0.0);
        if let Ok((_, factor)) = &tried
            && !factor.is_sharp()
        {
            tried = Err(LinalgError::NearlySingular { order: self.order(), contraction: factor.contraction });
        }
        let first = self.free_shift();
        for larger in [1.0, 1e2, 1e4] {
            match tried {
                Err(LinalgError::Factorisation { .. } | LinalgError::Library { .. }) | Ok(_) => break,
                Err(_) => tried = attempt(larger * first),
            }
        }
        tried
    }

    /// Factor of a matrix that must be positive definite, in double precision only where it was asked for before.
    pub(super) fn definite(&self, a: &SymmetricMatrix, thorough: bool) -> Result<Factor, LinalgError> {
        let factorise = if thorough { Factor::new } else { Factor::quick };
        let factor = factorise(&self.plan, a, Kind::Definite, FactorMemory::default())?;
        match factor.negative() {
            0 => Ok(factor),
            negative => Err(LinalgError::Refused(format!(
                "the {0} x {0} matrix is not positive definite: {negative} of its eigenvalues are negative",
                a.order()
            ))),
        }
    }

    /// A shift below all eigenvalues.
    pub(super) fn free_shift(&self) -> f64 {
        let (k, m) = (self.stiffness.diagonal(), self.mass.diagonal());
        let smallest = k
            .iter()
            .zip(&m)
            .map(|(k, m)| k / m)
            .filter(|ratio| ratio.is_finite() && *ratio > 0.0)
            .fold(f64::INFINITY, f64::min);
        if smallest.is_finite() { FREE_SHIFT * smallest } else { -1.0 }
    }
}
