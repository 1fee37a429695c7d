//! What every method does: it goes from sample to sample, counts what that takes, and can be written to a snapshot.

use super::{Divergence, Exchange, SnapshotError};

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
    /// Writes the counts, or reads them.
    pub(super) fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError> {
        let Self { steps, rejected, evaluations, solves, events } = self;
        [steps, rejected, evaluations, solves, events].into_iter().try_for_each(|count| words.count(count))
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

    /// Writes all that the next steps depend on, beside state and force, and the counts; or reads them into a stepper made
    /// for the same system and step.
    ///
    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    fn exchange(&mut self, words: &mut Exchange<'_, '_>) -> Result<(), SnapshotError>;
}
