//! Values below which eigenvalues are counted.

use super::super::LinalgError;
use super::super::count::{CountCheck, count_below, count_between};
use super::super::factor::FactorMemory;
use super::super::lowest::{largest_ratio, round_off};
use super::EigenProblem;
use super::iteration::FIRM;

/// How far a value on an eigenvalue is moved, relative to it.
const NEAR: f64 = 1e-6;

/// A value, 1/s^2, and how many eigenvalues lie below it.
pub(super) type Cut = (f64, usize);

/// To which side of an eigenvalue a value is moved that lies on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Below,
    Above,
}

/// The check of pairs of which all between two cuts were found.
pub(super) fn check_of(low: Cut, high: Cut) -> CountCheck {
    let counted = high.1.saturating_sub(low.1);
    CountCheck {
        above: (low.0 > 0.0).then_some(low.0),
        below: high.0,
        counted,
        found: counted,
    }
}

impl EigenProblem {
    /// Eigenvalues below a value, which is moved to one side if it is an eigenvalue itself or too near to zero.
    pub(super) fn count_near(&self, value: f64, side: Side) -> Result<Cut, LinalgError> {
        let value = value.min(self.above_all());
        let count = |value| {
            let memory = FactorMemory::default();
            count_below(&self.symbolic, &self.stiffness, &self.mass, value, memory)
        };
        let count_in = |ends| {
            let memory = FactorMemory::default();
            count_between(&self.symbolic, &self.stiffness, &self.mass, ends, memory)
        };
        let (sign, from_zero) = match side {
            Side::Below => (-1.0, value.min(0.0)),
            Side::Above => (1.0, value.max(0.0)),
        };
        let singular = |error: &LinalgError| matches!(error, LinalgError::NearlySingular { .. });
        let mut found = count(value).map(|counted| (value, counted));
        let nearest = sign * FIRM * round_off(&self.stiffness, &self.mass);
        for end in [
            value + sign * NEAR * value.abs(),
            value + sign * 1e2 * NEAR * value.abs(),
            from_zero + nearest,
            from_zero + 1e2 * nearest,
        ] {
            match &found {
                Err(error) if singular(error) => found = count_in([value, end]),
                _ => break,
            }
        }
        found
    }

    /// A value above all eigenvalues, 1/s^2: those of elements are at most some hundred times the largest
    /// `K_ii / M_ii`.
    pub(super) fn above_all(&self) -> f64 {
        1e6 * largest_ratio(&self.stiffness, &self.mass)
    }
}
