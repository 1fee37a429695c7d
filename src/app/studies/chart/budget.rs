//! The time that a chart may take: shares of it for the stages, and runs that end with it.

use crate::app::commands::run::{Checkpoints, RunRequest};
use crate::app::error::ComputeError;
use crate::numerics::ode::Snapshot;
use crate::report::duration;
use crate::system::{RecordLayout, RunRecord};
use std::time::{Duration, Instant};

/// Shares of the time after the scene is built and its model chosen at which stages end: the reference at its first, second and last attempt, the
/// points, their wall times, the statistics, the stability map. The rest is for files and the report, which take about a
/// second.
const REFERENCE: [f64; 3] = [0.33, 0.45, 0.52];
const POINTS: f64 = 0.62;
const TIMES: f64 = 0.7;
const STATISTICS: f64 = 0.78;
const MAP: f64 = 0.93;

/// Least part of a budget that must be left then.
const LEAST: f64 = 0.1;

/// The time that a chart may take.
#[derive(Debug, Clone, Copy)]
pub struct Budget {
    begun: Instant,
    whole: Option<Duration>,
    /// Part of the shares that falls to the stages before the map: 1 with it.
    stretch: f64,
}

/// Stages with a share of the budget.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stage {
    /// The reference at an attempt, from 0.
    Reference(usize),
    Points,
    Times,
    Statistics,
    Map,
}

impl Budget {
    /// `whole` from `begun` on, `None` for as long as it takes; with the stability map, or without it.
    pub(crate) fn new(begun: Instant, whole: Option<Duration>, with_map: bool) -> Self {
        Self { begun, whole, stretch: if with_map { 1.0 } else { MAP / STATISTICS } }
    }

    /// What is left after the scene is built and its model chosen, which cannot be cut short.
    ///
    /// # Errors
    /// [`ComputeError::Failed`] if that is too little to begin with.
    pub(crate) fn after_scene(self) -> Result<Self, ComputeError> {
        let Some(whole) = self.whole else {
            return Ok(self);
        };
        let spent = self.begun.elapsed();
        let left = whole.saturating_sub(spent);
        if left < whole.mul_f64(LEAST) {
            return Err(ComputeError::failed(
                format!(
                    "the scene and its model took {} of the budget of {}: too little is left for a chart",
                    duration(spent.as_secs_f64()),
                    duration(whole.as_secs_f64())
                ),
                "a longer --budget, beyond that time",
            ));
        }
        Ok(Self { begun: Instant::now(), whole: Some(left), ..self })
    }

    /// When a stage must end.
    pub(crate) fn until(self, stage: Stage) -> Deadline {
        let (share, stretch) = match stage {
            Stage::Reference(attempt) => (REFERENCE[attempt.min(REFERENCE.len() - 1)], self.stretch),
            Stage::Points => (POINTS, self.stretch),
            Stage::Times => (TIMES, self.stretch),
            Stage::Statistics => (STATISTICS, self.stretch),
            Stage::Map => (MAP, 1.0),
        };
        Deadline(self.whole.map(|whole| self.begun + whole.mul_f64(share * stretch)))
    }

    /// How often the reference may be tried.
    pub(super) fn attempts(self) -> usize {
        if self.whole.is_some() { REFERENCE.len() } else { 1 }
    }

    /// The whole, s; `None` without an end.
    pub(crate) fn seconds(self) -> Option<f64> {
        self.whole.map(|whole| whole.as_secs_f64())
    }
}

/// When something must end, if ever.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Deadline(Option<Instant>);

impl Deadline {
    #[cfg(test)]
    pub(crate) const NEVER: Self = Self(None);

    pub(crate) fn is_over(self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }

    pub(crate) fn is_never(self) -> bool {
        self.0.is_none()
    }

    /// Time left, s; infinite without an end.
    pub(crate) fn left_s(self) -> f64 {
        self.0.map_or(f64::INFINITY, |end| end.saturating_duration_since(Instant::now()).as_secs_f64())
    }

    /// The end of the first of so many equal parts of what is left.
    pub(super) fn part(self, of: usize) -> Self {
        let now = Instant::now();
        Self(self.0.map(|end| now + end.saturating_duration_since(now).div_f64(of.max(1) as f64)))
    }
}

/// Keeps rows in memory as long as there is time.
impl Checkpoints for Deadline {
    type Record = RunRecord;

    fn open(&mut self, layout: RecordLayout) -> Result<(RunRecord, Option<Snapshot>), ComputeError> {
        Ok((RunRecord::blank(layout), None))
    }

    fn request(&mut self) -> RunRequest {
        if self.is_over() { RunRequest::Stop } else { RunRequest::GoOn }
    }

    fn save(&mut self, _: &RunRecord, _: f64, _: &Snapshot) -> Result<(), ComputeError> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_end_one_after_the_other_and_before_the_whole() {
        let whole = Duration::from_secs(1000);
        for with_map in [true, false] {
            let budget = Budget::new(Instant::now(), Some(whole), with_map);
            let stages = [Stage::Reference(0), Stage::Reference(2), Stage::Points, Stage::Times, Stage::Statistics];
            let mut ends: Vec<f64> = stages.map(|stage| budget.until(stage).left_s()).to_vec();
            ends.push(budget.until(Stage::Map).left_s() + 1e-3);
            assert!(ends.is_sorted_by(|a, b| a < b), "{ends:?}");
            assert!(ends.iter().all(|&end| end < 950.0), "{ends:?}");
        }
        let endless = Budget::new(Instant::now(), None, true);
        assert!(endless.until(Stage::Points).is_never() && !endless.until(Stage::Map).is_over());
        assert!(endless.until(Stage::Points).part(3).is_never());
        assert_eq!((endless.attempts(), endless.seconds()), (1, None));
    }

    #[test]
    fn a_scene_that_takes_the_budget_is_said_and_one_that_leaves_enough_is_not() {
        let begun = Instant::now().checked_sub(Duration::from_secs(44)).unwrap();
        let budget = |seconds| Budget::new(begun, Some(Duration::from_secs(seconds)), true).after_scene();
        let error = budget(45).unwrap_err();
        assert!(!error.is_input());
        assert_eq!(
            error.to_string(),
            "the scene and its model took 44 s of the budget of 45 s: too little is left for a chart"
        );
        let left = budget(104).unwrap().seconds().unwrap();
        assert!((left - 60.0).abs() < 1.0, "{left}");
        // over at once, and a part of nothing is nothing
        let over = Budget::new(begun, Some(Duration::from_secs(20)), true).until(Stage::Map);
        assert!(over.is_over() && over.part(2).is_over() && over.left_s() <= 0.0);
    }
}
