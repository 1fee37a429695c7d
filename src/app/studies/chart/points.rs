//! The points of the chart: how far each candidate is from the reference, and what it costs.

use super::budget::Deadline;
use super::scene::Ready;
use super::starts::Systems;
use super::trace::{Failure, FailureKind, Trace};
use super::{Estimate, Reference, Settings, StartReference};
use crate::app::commands::run::Span;
use crate::app::scene::RunModel;
use crate::report::significant;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};

/// An error of the signal's own size or more shows nothing.
const TOO_INACCURATE: f64 = 1.0;

/// Simulated time by which costs are measured, s, and how often; the median counts.
pub(super) const TIMED: f64 = 2e-3;
pub(super) const ROUNDS: usize = 3;

/// Part of it that a budget leaves at least: what is shorter is the clock's and the cache's.
const LEAST_TIMED: f64 = 0.05;

/// Mean and scatter of the errors of a point.
#[derive(Debug, Clone, PartialEq)]
pub struct PointError {
    /// Mean over the starts.
    pub mean: f64,
    /// Standard deviation over the starts.
    pub deviation: f64,
    /// Largest.
    pub largest: f64,
    /// Over the earlier part of the horizons, growths ascending.
    pub by_growth: [GrowthError; GROWTHS.len()],
}

/// Growths of the distance of nearby solutions up to which errors are given beside that over the horizon: what a model leaves
/// out grows as they do.
pub const GROWTHS: [f64; 3] = [3.0, 10.0, 30.0];

/// Error while nearby solutions have parted by no more than a factor.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, JsonSchema)]
pub struct GrowthError {
    /// The factor.
    pub growth: f64,
    /// How long that takes, mean over the starts, s.
    pub span_s: f64,
    /// Relative difference from the reference over that time, mean over the starts.
    #[serde(rename = "error")]
    pub mean: f64,
}

/// A candidate and what came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Method, model and step.
    pub model: RunModel,
    /// Wall time a simulated second, on one thread, s; `None` where it was not measured.
    pub wall_s: Option<f64>,
    /// Relative difference from the reference over the horizons, or why there is none.
    pub error: Result<PointError, Failure>,
}

impl Point {
    /// Cost and mean error of a point that has both.
    pub(crate) fn measured(&self) -> Option<(f64, f64)> {
        Some((self.wall_s?, self.error.as_ref().ok()?.mean))
    }
}

/// What candidates are simulated on, and what they are compared with.
#[derive(Clone, Copy)]
pub(super) struct Comparison<'a> {
    pub(super) systems: &'a Systems<'a>,
    pub(super) reference: &'a Reference,
    pub(super) settings: &'a Settings,
    /// When runs end, done or not.
    pub(super) until: Deadline,
}

impl Comparison<'_> {
    /// A point, with what it took while other runs were under way.
    pub(super) fn point(self, model: &RunModel) -> (Point, Option<f64>) {
        let found = self.systems.of(model).and_then(|system| self.error(system, model, self.settings.point_stride()));
        let (error, seconds) = match found {
            Ok((error, seconds)) => (Ok(error), Some(seconds)),
            Err(failure) => (Err(failure), None),
        };
        (Point { model: *model, wall_s: None, error }, seconds)
    }

    /// Error of a model over every start, where a point takes some of them.
    pub(super) fn over_all_starts(self, model: &RunModel) -> Result<PointError, Failure> {
        self.error(self.systems.of(model)?, model, 1).map(|(error, _)| error)
    }

    /// Mean error over every so many of the starts, and what a simulated second took, s.
    fn error(self, system: &Ready, model: &RunModel, stride: usize) -> Result<(PointError, f64), Failure> {
        // the first start that fails tells enough; which one does not depend on the number of threads
        let failed = AtomicBool::new(false);
        let starts: Vec<&StartReference> = self.reference.starts.iter().step_by(stride).collect();
        let errors: Vec<Option<Result<StartErrors, Failure>>> = starts
            .par_iter()
            .map(|start| {
                if failed.load(Ordering::Relaxed) {
                    return None;
                }
                let error = self.error_of(system, model, start);
                if error.is_err() {
                    failed.store(true, Ordering::Relaxed);
                }
                Some(error)
            })
            .collect();
        if !failed.into_inner() {
            let values: Vec<StartErrors> = errors.into_iter().flatten().flatten().collect();
            let seconds = values.iter().map(|of| of.wall_s).sum::<f64>() / values.len() as f64;
            return Ok((judged(&values)?, seconds));
        }
        // that of the first start that fails, computed where it was left out
        let known = starts.iter().zip(errors);
        let mut all = known.map(|(start, known)| known.unwrap_or_else(|| self.error_of(system, model, start)));
        let first = all.find_map(Result::err);
        Err(first.unwrap_or_else(|| Failure::new(FailureKind::Refused, String::new())))
    }

    /// Relative differences from the reference over a start's horizon and parts of it.
    fn error_of(self, system: &Ready, model: &RunModel, start: &StartReference) -> Result<StartErrors, Failure> {
        let run = system.simulate(&start.start, model, self.settings.simulated(start.horizon_s), None, self.until)?;
        let trace = Trace::of_run(&run, self.settings)?;
        let over = |span_s: f64| {
            let error = trace.error(&start.trace, 0.0, span_s);
            error.map_err(|error| Failure::new(FailureKind::Refused, error.to_string()))
        };
        let mut by_growth = [GrowthError::default(); GROWTHS.len()];
        for (part, growth) in by_growth.iter_mut().zip(GROWTHS) {
            let span_s = start.growth.horizon_s(growth).min(start.horizon_s);
            *part = GrowthError { growth, span_s, mean: over(span_s)? };
        }
        let wall_s = run.stepping_s / run.simulated_s;
        Ok(StartErrors { over_horizon: over(start.horizon_s)?, by_growth, wall_s })
    }

    /// Measures what the points cost, one run at a time and on this thread: the median of some rounds over all points, so that what
    /// else the machine does for a while falls on a round and not on a point. `taken` is what a simulated second took them beside
    /// others, s: where there is an end, runs are as short as it asks for, and the cheapest points come first. `done` is told the
    /// share that is done. Gives the simulated time of a run, s.
    pub(super) fn measure(
        self,
        points: &mut [Point],
        taken: &[Option<f64>],
        start: &StartReference,
        done: impl Fn(f64),
    ) -> f64 {
        let Settings { span_s, output_hz, .. } = *self.settings;
        let whole = TIMED.min(span_s);
        let second: f64 = taken.iter().flatten().sum();
        let fits = self.until.left_s() / (ROUNDS as f64 * second.max(f64::MIN_POSITIVE));
        let duration = whole.min(fits.max(LEAST_TIMED * whole));
        let span = Span { duration, output_hz };
        let mut order: Vec<usize> = (0..points.len()).collect();
        if !self.until.is_never() {
            let of = |place: &usize| taken.get(*place).copied().flatten().unwrap_or(f64::INFINITY);
            order.sort_by(|a, b| of(a).total_cmp(&of(b)));
        }
        let mut walls: Vec<Vec<f64>> = vec![Vec::with_capacity(ROUNDS); points.len()];
        for round in 0..ROUNDS {
            for (number, &place) in order.iter().enumerate() {
                walls[place].extend(self.wall(&points[place], start, span));
                let count = (ROUNDS * points.len()) as f64;
                done((round * points.len() + number + 1) as f64 / count);
            }
        }
        for (point, mut walls) in points.iter_mut().zip(walls) {
            walls.sort_by(f64::total_cmp);
            point.wall_s = walls.get(walls.len() / 2).copied();
        }
        duration
    }

    /// Wall time of one run over its simulated time; `None` for a point without an error, and where there is no time.
    fn wall(self, point: &Point, start: &StartReference, span: Span) -> Option<f64> {
        point.error.as_ref().ok()?;
        let system = self.systems.of(&point.model).ok()?;
        let simulation = system.simulate(&start.start, &point.model, span, None, self.until).ok()?;
        Some(simulation.stepping_s / simulation.simulated_s)
    }
}

/// Errors from one start.
#[derive(Debug, Clone, Copy)]
struct StartErrors {
    over_horizon: f64,
    by_growth: [GrowthError; GROWTHS.len()],
    /// Wall time a simulated second, s.
    wall_s: f64,
}

/// Mean and scatter, or that they show nothing.
fn judged(starts: &[StartErrors]) -> Result<PointError, Failure> {
    let count = starts.len() as f64;
    let errors: Vec<f64> = starts.iter().map(|start| start.over_horizon).collect();
    let Estimate { mean, deviation, .. } = Estimate::of(&errors);
    let largest = errors.iter().copied().fold(0.0, f64::max);
    if mean < TOO_INACCURATE {
        let mut by_growth = [GrowthError::default(); GROWTHS.len()];
        for (place, part) in by_growth.iter_mut().enumerate() {
            part.growth = GROWTHS[place];
            for start in starts {
                part.span_s += start.by_growth[place].span_s / count;
                part.mean += start.by_growth[place].mean / count;
            }
        }
        Ok(PointError { mean, deviation, largest, by_growth })
    } else {
        Err(Failure {
            kind: FailureKind::TooInaccurate,
            reason: format!(
                "the signal differs from the reference by {} of its root mean square",
                significant(mean, 3)
            ),
            error: Some(mean),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_a_mean_and_a_scatter_or_show_nothing() {
        let starts = |errors: [f64; 2]| {
            errors.map(|over_horizon| StartErrors {
                over_horizon,
                by_growth: GROWTHS.map(|growth| GrowthError {
                    growth,
                    span_s: 1e-3 * growth * over_horizon,
                    mean: 0.01 * growth * over_horizon,
                }),
                wall_s: 1.0,
            })
        };
        let error = judged(&starts([0.1, 0.3])).unwrap();
        for (part, growth) in error.by_growth.iter().zip(GROWTHS) {
            assert!((part.growth - growth).abs() < 1e-15);
            assert!((part.span_s - 0.2e-3 * growth).abs() < 1e-15);
            assert!((part.mean - 2e-3 * growth).abs() < 1e-15);
        }
        assert!((error.mean - 0.2).abs() < 1e-15 && (error.largest - 0.3).abs() < 1e-15);
        // the sample's: sqrt(2) 0.1
        assert!((error.deviation - 0.02_f64.sqrt()).abs() < 1e-15);
        let failure = judged(&starts([0.5, 2.5])).unwrap_err();
        assert_eq!(failure.kind, FailureKind::TooInaccurate);
        assert!(failure.reason.contains("by 1.50 of its"), "{}", failure.reason);
    }
}
