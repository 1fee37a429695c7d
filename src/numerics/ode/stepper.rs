//! What every method does: it goes from sample to sample, counts what that takes, and can be written to a snapshot.

use super::snapshot::{Snapshot, SnapshotError, SnapshotReader};
use super::system::Divergence;

/// Counts of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Statistics {
    /// Steps taken.
    pub steps: u64,
    /// Steps that were tried and not good enough.
    pub rejected: u64,
    /// Force evaluations.
    pub evaluations: u64,
    /// Linear systems solved.
    pub solves: u64,
    /// Steps that ended at an event.
    pub events: u64,
}

impl Statistics {
    /// Writes the counts.
    pub(super) fn remember(&self, snapshot: &mut Snapshot) {
        for count in [self.steps, self.rejected, self.evaluations, self.solves, self.events] {
            snapshot.count(count);
        }
    }

    /// The counts as they were written.
    ///
    /// # Errors
    /// [`SnapshotError::Short`].
    pub(super) fn recalled(snapshot: &mut SnapshotReader) -> Result<Self, SnapshotError> {
        Ok(Self {
            steps: snapshot.count()?,
            rejected: snapshot.count()?,
            evaluations: snapshot.count()?,
            solves: snapshot.count()?,
            events: snapshot.count()?,
        })
    }
}

/// A method on its way from sample to sample.
pub(super) trait Stepper<S> {
    /// Goes from the last instant to `t1` (s), the next sample's; `g` is the force at the state on entry and on return. A
    /// method with a step of its own goes beyond it and gives what is between.
    ///
    /// # Errors
    /// [`Divergence`] if no step can be found that the method can take.
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) -> Result<(), Divergence>;

    /// What it took so far.
    fn statistics(&self) -> Statistics;

    /// Writes all that the next steps depend on, beside state and force, and the counts.
    fn remember(&self, snapshot: &mut Snapshot);

    /// Reads what [`remember`](Self::remember) wrote, into a stepper made for the same system and step.
    ///
    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    fn recall(&mut self, snapshot: &mut SnapshotReader) -> Result<(), SnapshotError>;
}

/// A method of equal steps with one evaluation each, which remembers nothing.
pub(super) trait OneEvaluation<S> {
    /// As [`Stepper::step`]; every step can be taken.
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]);
}

/// Such a method with the count of its steps.
#[derive(Debug)]
pub(super) struct Counted<M> {
    method: M,
    steps: u64,
}

impl<M> Counted<M> {
    /// Before its first step.
    pub(super) fn new(method: M) -> Self {
        Self { method, steps: 0 }
    }
}

impl<S, M: OneEvaluation<S>> Stepper<S> for Counted<M> {
    fn step(&mut self, system: &mut S, t1: f64, y: &mut [f64], v: &mut [f64], g: &mut [f64]) -> Result<(), Divergence> {
        self.method.step(system, t1, y, v, g);
        self.steps += 1;
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        Statistics {
            steps: self.steps,
            // one before the first step
            evaluations: self.steps + 1,
            ..Statistics::default()
        }
    }

    fn remember(&self, snapshot: &mut Snapshot) {
        snapshot.count(self.steps);
    }

    fn recall(&mut self, snapshot: &mut SnapshotReader) -> Result<(), SnapshotError> {
        self.steps = snapshot.count()?;
        Ok(())
    }
}
