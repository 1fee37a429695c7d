//! What is known of computed eigenpairs.

use super::super::{DenseMatrix, LinalgError};
use schemars::JsonSchema;
use serde::Serialize;
use std::ops::Range;

/// Eigenvalues below a value: how many there are, and how many were found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CountCheck {
    /// Value above which it was counted, 1/s^2; `None`: from the lowest.
    pub above: Option<f64>,
    /// Value below which it was counted, 1/s^2.
    pub below: f64,
    /// Eigenvalues below it, from the inertia of `K - below M`.
    pub counted: usize,
    /// Eigenvalues below it that were found.
    pub found: usize,
}

impl CountCheck {
    /// Counted from the lowest eigenvalue on.
    pub(super) fn from_lowest(below: f64, counted: usize, found: usize) -> Self {
        Self { above: None, below, counted, found }
    }

    /// The error of a count that does not agree.
    pub(super) fn missing(self) -> LinalgError {
        LinalgError::missing_modes(self.below, self.counted, self.found)
    }
}

/// Where the time of an eigenvalue computation went, s. With several threads the count goes on beside the iteration.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, JsonSchema)]
pub struct EigenTimes {
    /// Ordering where it is not found beside the assembly, permutation, symbolic analysis.
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

impl EigenPairs {
    /// No pairs, and none counted below a value (1/s^2).
    pub(in crate::numerics::linalg) fn none(order: usize, below: f64) -> Self {
        Self {
            values: Vec::new(),
            vectors: DenseMatrix::zeros(order, 0),
            residuals: Vec::new(),
            bounds: Vec::new(),
            rounding: Vec::new(),
            orthogonality: 0.0,
            count_check: CountCheck::from_lowest(below, 0, 0),
            shift: 0.0,
            times: EigenTimes::default(),
        }
    }

    /// Pairs of ascending parts, shift and check of the first; orthogonality is that of the worst part.
    pub(super) fn one_behind_the_other(parts: Vec<Self>, order: usize) -> Self {
        let count = parts.iter().map(|part| part.values.len()).sum();
        let mut vectors = DenseMatrix::zeros(order, count);
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_else(|| Self::none(order, 0.0));
        let mut place = 0;
        let mut add = |part: &DenseMatrix| {
            vectors.as_mut().subcols_mut(place, part.ncols()).copy_from(part);
            place += part.ncols();
        };
        add(&all.vectors);
        for part in parts {
            add(&part.vectors);
            all.values.extend(part.values);
            all.residuals.extend(part.residuals);
            all.bounds.extend(part.bounds);
            all.rounding.extend(part.rounding);
            all.orthogonality = all.orthogonality.max(part.orthogonality);
            all.times.factor += part.times.factor;
            all.times.iterate += part.times.iterate;
            all.times.count += part.times.count;
        }
        all.vectors = vectors;
        all
    }

    /// Leaves out all other pairs.
    pub(super) fn keep(&mut self, kept: Range<usize>) {
        for list in [&mut self.values, &mut self.residuals, &mut self.bounds, &mut self.rounding] {
            list.truncate(kept.end);
            list.drain(..kept.start);
        }
        self.vectors = self.vectors.subcols(kept.start, kept.len()).to_owned();
    }
}
