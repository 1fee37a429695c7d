//! How far the frequencies of a condensed housing are from those of the full one, without the full solution.
//!
//! The residual r of a mode in the interior's equations, measured by `z = K_ii^-1 r`, says what the basis lacks. The
//! modes are computed once more in the basis with all these z: what the frequencies fall by is the error that they
//! had, but for what z lacks in its turn. That remainder falls by (lambda / lambda_cut)^2 a round, lambda_cut
//! the first fixed-interface mode left out; rounds go on until it is small, and it is added.
//!
//! To first order the fall is `lambda~ - lambda = r^T K_ii^-1 r`, the estimate of Kim, Lee and Lee (Computers and
//! Structures 139 (2014) 54-64); residuals of component modes in this norm: Jakobsson, Bengzon and Larson (International
//! Journal for Numerical Methods in Engineering 86 (2011) 829-844). Computing the fall itself stays right where modes
//! lie close together and where errors are large.

use super::interior_basis::{Attached, coupled_modes, interior_residuals};
use super::{InteriorBasis, ReductionError, Substructure};
use std::f64::consts::TAU;

/// Part of an estimate that may be left to the extrapolation.
const REMAINDER: f64 = 0.25;

/// Largest ratio that a round is believed to reduce the remainder by: of modes near the first one left out, or above it,
/// the formula says nothing.
const SLOWEST: f64 = 0.9;

/// Rounds at most.
const ROUNDS: usize = 8;

/// Modes up to so many times the band's top are followed: one that lies in the band may come out that much too high.
const REACH: f64 = 1.5;

/// Errors below this are round-off of the reduced matrices' eigenvalues, relative.
const ROUND_OFF: f64 = 1e-11;

/// A mode of the reduced model in the band, with its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EstimatedMode {
    /// Of the reduced model, Hz; infinite if it has too few coordinates to have the mode at all.
    pub frequency_hz: f64,
    /// Estimate of `(reduced - full) / full`, both in Hz; not negative.
    pub relative_error: f64,
}

/// Estimated errors of a reduction in a band.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorEstimate {
    /// Top of the band, Hz.
    pub band_hz: f64,
    /// The modes of the full model that are estimated to lie in the band, each as the reduced model has it; rigid ones
    /// first.
    pub modes: Vec<EstimatedMode>,
    /// How many of `modes` the reduced model has above the band.
    pub out_of_band: usize,
    /// Rounds that it took.
    pub rounds: usize,
    /// Whether the remainder became small.
    pub converged: bool,
}

impl ErrorEstimate {
    /// The largest error in the band; 0 without modes.
    pub(crate) fn largest(&self) -> f64 {
        self.modes.iter().map(|mode| mode.relative_error).fold(0.0, f64::max)
    }

    /// Estimates the errors of a basis.
    ///
    /// # Errors
    /// What the dense eigenvalue solver reports.
    pub fn of(
        substructure: &Substructure,
        basis: &InteriorBasis,
        attached: Option<Attached<'_>>,
        band_hz: f64,
    ) -> Result<Self, ReductionError> {
        let top = (TAU * band_hz).powi(2);
        let reduced = coupled_modes(substructure, basis, attached)?;
        let quasi_static = basis.quasi_static();
        let (mut refined, mut modes) = (basis.clone(), reduced.clone());
        let mut last_fall = Vec::new();
        let mut estimate = Self { band_hz, modes: Vec::new(), out_of_band: 0, rounds: 0, converged: false };
        while estimate.rounds < ROUNDS && !estimate.converged {
            let followed = modes.values.partition_point(|&value| value <= REACH * REACH * top);
            let count = modes.values.partition_point(|&value| value <= top);
            let moving: Vec<usize> = (0..followed).filter(|&mode| modes.values[mode] > quasi_static).collect();
            let before = modes.values.clone();
            if !moving.is_empty() {
                let residual = interior_residuals(substructure, &refined, &modes, &moving);
                let more = substructure.solve_interior(residual)?;
                refined = refined.extended(substructure, more)?;
                modes = coupled_modes(substructure, &refined, attached)?;
            }
            estimate.rounds += 1;
            let now = modes.values.partition_point(|&value| value <= top);
            last_fall = (0..now).map(|mode| fall(at(&before, mode), modes.values[mode])).collect();
            estimate.converged = now == count
                && (0..now).all(|mode| {
                    let total = fall(at(&reduced.values, mode), modes.values[mode]);
                    let left = last_fall[mode] * remainder(modes.values[mode], basis);
                    left <= REMAINDER * total || left <= ROUND_OFF
                });
        }
        for (mode, &fallen) in last_fall.iter().enumerate() {
            let (was, is) = (at(&reduced.values, mode), modes.values[mode]);
            let total = fall(was, is) + fallen * remainder(is, basis);
            estimate.out_of_band += usize::from(was > top);
            estimate.modes.push(EstimatedMode {
                frequency_hz: was.abs().sqrt() / TAU,
                relative_error: if is > quasi_static { total } else { 0.0 },
            });
        }
        Ok(estimate)
    }

    /// The same of a model with further restraints, of which the squared frequencies `values` are known (1/s^2, ascending), such
    /// as those with a reduced interface: its frequencies, each with both errors, and what each rises by, relative. The rise is exact.
    pub(crate) fn raised(&self, basis: &InteriorBasis, values: &[f64]) -> (Self, Vec<f64>) {
        let quasi_static = basis.quasi_static();
        let top = (TAU * self.band_hz).powi(2);
        let raise = |(place, mode): (usize, &EstimatedMode)| {
            let before = (TAU * mode.frequency_hz).powi(2);
            let rise = if before > quasi_static { fall(at(values, place), before) } else { 0.0 };
            let raised = EstimatedMode {
                frequency_hz: at(values, place).abs().sqrt() / TAU,
                relative_error: (1.0 + mode.relative_error) * (1.0 + rise) - 1.0,
            };
            (raised, rise)
        };
        let (modes, rises) = self.modes.iter().enumerate().map(raise).unzip();
        let out_of_band = (0..self.modes.len()).filter(|&place| at(values, place) > top).count();
        (Self { modes, out_of_band, ..*self }, rises)
    }
}

/// An eigenvalue, or infinity where a basis has too few vectors for it.
fn at(values: &[f64], mode: usize) -> f64 {
    values.get(mode).copied().unwrap_or(f64::INFINITY)
}

/// `(f~ - f) / f` from the squares of both.
fn fall(before: f64, after: f64) -> f64 {
    if after > 0.0 { ((before / after).max(1.0)).sqrt() - 1.0 } else { 0.0 }
}

/// What further rounds would add, relative to the last one: a geometric series.
fn remainder(value: f64, basis: &InteriorBasis) -> f64 {
    let ratio = (value / basis.complete_below).powi(2).min(SLOWEST);
    ratio / (1.0 - ratio)
}

#[cfg(test)]
#[path = "estimate_tests.rs"]
mod tests;
