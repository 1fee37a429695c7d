//! How large an error is, and how long the next step may be.
//!
//! The error of a step is measured coordinate by coordinate, in units of `tolerance` times what the coordinate reaches in the
//! run: coordinates may differ by any power of ten. A coordinate that stands still reaches nothing but round-off, which no step
//! is short enough for, so three floors hold:
//!
//! - its largest value so far, not its value now: nothing happens at a zero crossing;
//! - [`QUIET`] times the largest of its group, positions and velocities by themselves. Groups are the coordinates with a spring
//!   and those that only the force holds: with the former in kg^1/2 m and the latter in m, each has one unit;
//! - for a velocity, [`QUIET`] times the position's scale over the longest step so far: what moves a coordinate by so
//!   little while anything happens stands still. This one alone holds at a start from rest.
//!
//! There is none in metres: the model's units mean nothing to the method.

use super::stages::Stages;
use crate::numerics::ode::{Exchange, LinearCoordinate, SnapshotError};

/// How much smaller than the largest of its group a coordinate is still resolved to the whole tolerance. A static deflection
/// under a constant force falls with omega^2, so that this covers modes over 1.5 decades of frequency, and the others to
/// 1e-3 of the tolerance of the largest.
const QUIET: f64 = 1e-3;

/// Largest value of each part of the state so far.
#[derive(Debug)]
pub(super) struct Scale {
    dof: usize,
    /// Whether each coordinate has no spring: the number of its group.
    group: Vec<usize>,
    largest: Vec<f64>,
    /// Of positions and velocities \[part\]\[group\].
    floors: [[f64; 2]; 2],
    longest: f64,
    errors: [Vec<f64>; 2],
}

impl Scale {
    /// For states of so many numbers with what fills them up.
    pub(super) fn new(linear: &[LinearCoordinate], length: usize) -> Self {
        let group = |coordinate: &LinearCoordinate| usize::from(coordinate.squared_frequency <= 0.0);
        Self {
            dof: linear.len(),
            group: linear.iter().map(group).collect(),
            largest: vec![0.0; length],
            floors: [[0.0; 2]; 2],
            longest: 0.0,
            errors: [vec![0.0; length], vec![0.0; length]],
        }
    }

    /// Takes a state into account, reached by a step of so many seconds.
    pub(super) fn see(&mut self, state: &[f64], step: f64) {
        self.longest = self.longest.max(step);
        let dof = self.dof.max(1);
        let parts = state.chunks(dof).zip(self.largest.chunks_mut(dof));
        for ((values, largest), floors) in parts.zip(&mut self.floors) {
            for ((value, largest), &group) in values.iter().zip(largest).zip(&self.group) {
                *largest = value.abs().max(*largest);
                floors[group] = floors[group].max(QUIET * *largest);
            }
        }
    }

    /// Writes what was reached so far, or reads it.
    ///
    /// # Errors
    /// [`SnapshotError`] for that of another system.
    pub(super) fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        words.numbers("scales", &mut self.largest)?;
        for floors in &mut self.floors {
            words.numbers("groups of scales", floors)?;
        }
        words.number(&mut self.longest)
    }

    /// A step to begin with, s: a hundredth of what changes anything by its size at the present slope, a tenth of what turns
    /// the fastest spring by a radian; `otherwise` where nothing moves.
    pub(super) fn first_step(&self, linear: &[LinearCoordinate], slope: &[f64], otherwise: f64) -> f64 {
        let (mut rate, mut fastest): (f64, f64) = (0.0, 0.0);
        for i in 0..self.dof {
            let size = self.largest[i].max(self.floors[0][self.group[i]]);
            if size > 0.0 {
                let acceleration = slope[self.dof + i].abs();
                rate = rate.max(slope[i].abs() / size).max((acceleration / size).sqrt());
            }
            fastest = fastest.max(linear[i].squared_frequency.sqrt());
        }
        let step = (0.01 / rate).min(0.1 / fastest);
        if step.is_finite() && step > 0.0 { step } else { otherwise }
    }

    /// Error of the step that `stages` hold, `h` s long, in units of the scales: the largest over the coordinates of the
    /// estimate of order 5, made the smaller the better it agrees with that of order 3 (II.10, (10.17)). Infinite if the step
    /// led nowhere.
    pub(super) fn error(&mut self, stages: &Stages, h: f64) -> f64 {
        let [five, three] = &mut self.errors;
        stages.errors_into([five, three]);
        let ([_, end], dof) = (stages.states(), self.dof);
        let (mut worst, mut sound) = ([0.0; 2], true);
        let longest = self.longest.max(h);
        for i in 0..dof {
            let group = self.group[i];
            let [y, v] = [i, dof + i].map(|j| self.largest[j].max(end[j].abs()));
            let y = y.max(self.floors[0][group]);
            let v = v.max(self.floors[1][group]).max(QUIET * y / longest);
            for (j, size) in [(i, y), (dof + i, v)] {
                sound &= end[j].is_finite();
                for (worst, error) in worst.iter_mut().zip([five[j], three[j]]) {
                    let error = error.abs();
                    if error > *worst * size {
                        *worst = error / size;
                    }
                }
            }
        }
        let [five, three] = worst;
        if !sound {
            f64::INFINITY
        } else if five > 0.0 {
            h * five * (five / five.hypot(0.1 * three))
        } else {
            0.0
        }
    }
}

/// Share of the step that the tolerance would allow.
const SAFETY: f64 = 0.9;

/// Exponent of the last error: what damps the control.
const DAMPING: f64 = 0.04;

/// Exponent of the error: 1 / 8 less what the damping takes.
const EXPONENT: f64 = 0.125 - 0.2 * DAMPING;

/// Change of the step from one to the next.
const FACTORS: [f64; 2] = [1.0 / 3.0, 6.0];

/// Least change of the step after a trial that was not good enough: smaller than between steps, for a trial that ends deep in a
/// contact says nothing of the step that it needs.
const LEAST_RETRY: f64 = 0.1;

/// Least errors that are told apart: the factor is at its limit long before.
const LEAST_ERROR: f64 = 1e-10;

/// Factor for the step after one with this error, at most 1; not above 1 after a rejected trial. `before` is the error of the
/// step before, and becomes this one.
///
/// Proportional and integral control of the step by the error in units of the tolerance (IV.2 of the second volume; factors as in the
/// authors' code).
pub(super) fn after_success(before: &mut f64, error: f64, rejected: bool) -> f64 {
    let factor = SAFETY * error.max(LEAST_ERROR).powf(-EXPONENT) * before.powf(DAMPING);
    *before = error.max(1e-4);
    let most = if rejected { 1.0 } else { FACTORS[1] };
    factor.clamp(FACTORS[0], most)
}

/// Factor for another trial after one with this error, above 1.
pub(super) fn after_failure(error: f64) -> f64 {
    (SAFETY * error.powf(-EXPONENT)).max(LEAST_RETRY)
}
