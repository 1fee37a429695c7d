//! One step of the pair on the first-order form (y, v)' = (v, g - damping v - omega^2 y).

use super::tableau::{Combination, ERROR_3, ERROR_5, EXTENDED, NODES, ROWS, STAGES};
use crate::numerics::ode::{Exchange, LinearCoordinate, SecondOrderSystem, SnapshotError};
use std::ops::Range;

/// Numbers that are combined at once.
const BLOCK: usize = 8;

/// Number of the slope at the end of a step, the next one's first.
pub(super) const LAST: usize = STAGES - 1;

/// A step in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    pub from: f64,
    pub to: f64,
    /// Last instant that has the force of this span: the force may jump at `to`.
    inside: f64,
}

impl Span {
    /// The step between two instants (s), with the next jump of the force by time at `change`.
    pub(super) fn new(from: f64, to: f64, change: f64) -> Self {
        Self { from, to, inside: if to < change { to } else { change.next_down() } }
    }

    pub(super) fn length(&self) -> f64 {
        self.to - self.from
    }

    /// Instant of a place (0 to 1), s.
    pub(super) fn at(&self, place: f64) -> f64 {
        if place < 1.0 { (self.from + place * self.length()).min(self.inside) } else { self.inside }
    }

    /// Writes it, or reads it.
    pub(super) fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        let Self { from, to, inside } = self;
        [from, to, inside].into_iter().try_for_each(|instant| words.number(instant))
    }

    /// Place of an instant.
    pub(super) fn place(&self, t: f64) -> f64 {
        (t - self.from) / self.length()
    }
}

/// States and slopes of a step.
#[derive(Debug)]
pub(super) struct Stages {
    linear: Vec<LinearCoordinate>,
    /// Both parts of the state one after the other, filled up with zeros to whole blocks; so are all below.
    start: Vec<f64>,
    end: Vec<f64>,
    stage: Vec<f64>,
    /// \[stages x states\].
    slopes: Vec<f64>,
    force: Vec<f64>,
    pub evaluations: u64,
}

impl Stages {
    pub(super) fn new(linear: &[LinearCoordinate]) -> Self {
        let length = (2 * linear.len()).next_multiple_of(BLOCK);
        let zeros = vec![0.0; length];
        Self {
            start: zeros.clone(),
            end: zeros.clone(),
            stage: zeros,
            slopes: vec![0.0; length * EXTENDED],
            force: vec![0.0; linear.len()],
            linear: linear.to_vec(),
            evaluations: 0,
        }
    }

    /// Number of coordinates.
    pub(super) fn dof(&self) -> usize {
        self.linear.len()
    }

    /// Numbers of a state with what fills it up.
    pub(super) fn length(&self) -> usize {
        self.start.len()
    }

    /// Position and velocity at the end of the last step.
    pub(super) fn end(&self) -> [&[f64]; 2] {
        let dof = self.dof();
        [&self.end[..dof], &self.end[dof..2 * dof]]
    }

    /// State at its start and at its end with what fills them up.
    pub(super) fn states(&self) -> [&[f64]; 2] {
        [&self.start, &self.end]
    }

    /// A slope with what fills it up.
    pub(super) fn slope(&self, number: usize) -> &[f64] {
        &self.slopes[self.range(number)]
    }

    fn range(&self, number: usize) -> Range<usize> {
        number * self.length()..(number + 1) * self.length()
    }

    /// Puts the state at which the next step begins, with the force there.
    pub(super) fn begin(&mut self, y: &[f64], v: &[f64], g: &[f64]) {
        let dof = self.dof();
        self.end[..dof].copy_from_slice(y);
        self.end[dof..2 * dof].copy_from_slice(v);
        self.stage.copy_from_slice(&self.end);
        self.force.copy_from_slice(g);
        self.keep_slope(LAST);
    }

    /// Makes the end of the last step the start of the next one.
    pub(super) fn turn_over(&mut self) {
        std::mem::swap(&mut self.start, &mut self.end);
        let last = self.range(LAST);
        self.slopes.copy_within(last, 0);
    }

    /// Evaluates the slope at the start anew: the force jumps there.
    pub(super) fn restart<S: SecondOrderSystem>(&mut self, system: &mut S, t: f64) {
        self.stage.copy_from_slice(&self.start);
        self.evaluate(system, t, 0);
    }

    /// Goes through the stages to the end of a step; the slope there is left out.
    pub(super) fn attempt<S: SecondOrderSystem>(&mut self, system: &mut S, span: &Span) {
        for number in 1..LAST {
            self.evaluate_stage(system, span, number);
        }
        let (row, h) = (ROWS[LAST], span.length());
        combine(row, &self.slopes, h, &self.start, &mut self.end);
    }

    /// Evaluates the slope at the end.
    pub(super) fn close<S: SecondOrderSystem>(&mut self, system: &mut S, span: &Span) {
        self.stage.copy_from_slice(&self.end);
        self.evaluate(system, span.inside, LAST);
    }

    /// Evaluates the stages that the dense output takes.
    pub(super) fn extend<S: SecondOrderSystem>(&mut self, system: &mut S, span: &Span) {
        for number in STAGES..EXTENDED {
            self.evaluate_stage(system, span, number);
        }
    }

    fn evaluate_stage<S: SecondOrderSystem>(&mut self, system: &mut S, span: &Span, number: usize) {
        let (row, h) = (ROWS[number], span.length());
        combine(row, &self.slopes, h, &self.start, &mut self.stage);
        self.evaluate(system, span.at(NODES[number]), number);
    }

    fn evaluate<S: SecondOrderSystem>(&mut self, system: &mut S, t: f64, number: usize) {
        let dof = self.dof();
        let (y, v) = self.stage.split_at(dof);
        system.force_into(t, y, &v[..dof], &mut self.force);
        self.evaluations += 1;
        self.keep_slope(number);
    }

    /// Slope at the state and the force that stand in the buffers.
    fn keep_slope(&mut self, number: usize) {
        let (range, dof) = (self.range(number), self.dof());
        let (velocity, rest) = self.slopes[range].split_at_mut(dof);
        let (y, v) = self.stage.split_at(dof);
        velocity.copy_from_slice(&v[..dof]);
        for i in 0..dof {
            let linear = &self.linear[i];
            let pull = linear.damping * v[i] + linear.squared_frequency * y[i];
            rest[i] = self.force[i] - pull;
        }
    }

    /// Writes states and slopes of the last step, or reads them.
    ///
    /// # Errors
    /// [`SnapshotError`] for those of another system.
    pub(super) fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        words.count(&mut self.evaluations)?;
        for numbers in [&mut self.start, &mut self.end, &mut self.slopes] {
            words.numbers("numbers of a stage", numbers)?;
        }
        Ok(())
    }

    /// Differences to the formulas of order 5 and 3, by the step's length.
    pub(super) fn errors_into(&self, [five, three]: [&mut [f64]; 2]) {
        self.combine_into(ERROR_5, 1.0, five);
        self.combine_into(ERROR_3, 1.0, three);
    }

    /// `factor` times a combination of slopes.
    pub(super) fn combine_into(&self, row: Combination, factor: f64, out: &mut [f64]) {
        combine(row, &self.slopes, factor, &[], out);
    }
}

/// `out = start + h sum a_j k_j`; without `start` from zero.
fn combine(row: Combination, slopes: &[f64], h: f64, start: &[f64], out: &mut [f64]) {
    let length = out.len();
    for (number, out) in out.chunks_exact_mut(BLOCK).enumerate() {
        let mut sum = [0.0; BLOCK];
        for &(j, a) in row {
            let first = j * length + number * BLOCK;
            let slope = &slopes[first..first + BLOCK];
            for l in 0..BLOCK {
                sum[l] += a * slope[l];
            }
        }
        let start = start.get(number * BLOCK..(number + 1) * BLOCK);
        let start = start.unwrap_or(&[0.0; BLOCK]);
        for l in 0..BLOCK {
            out[l] = start[l] + h * sum[l];
        }
    }
}
