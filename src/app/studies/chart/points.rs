//! The points of the chart: how far each candidate is from the reference, and what it costs.

use super::starts::{Ready, Systems};
use super::trace::{Failure, FailureKind, Trace};
use super::{Estimate, Reference, Settings, StartReference};
use crate::app::commands::run::Span;
use crate::app::scene::{RunModel, Scene};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};

/// An error of the signal's own size or more shows nothing.
const TOO_INACCURATE: f64 = 1.0;

/// An error from which a refinement is expected to bring something, and what it must then bring to go on.
const CONVERGING: f64 = 0.3;
const GAIN: f64 = 0.85;

/// Points in a row that differ by less than this part, where the error is larger: refining does not reach what is wrong.
const STUCK: (usize, f64) = (3, 0.1);

/// Simulated time by which costs are measured, s, and how often; the median counts.
const TIMED: f64 = 2e-3;
const ROUNDS: usize = 3;

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

/// Part of the target below which nothing finer is tried.
const FINE: f64 = 0.01;

/// What candidates are simulated on, and what they are compared with.
#[derive(Clone, Copy)]
pub(super) struct Comparison<'a> {
    pub(super) scene: &'a Scene,
    pub(super) reference: &'a Reference,
    pub(super) settings: &'a Settings,
}

impl Comparison<'_> {
    /// Computes a family's points from the roughest on, until refining brings nothing more, what is left being the model's own error,
    /// or until the error is far below the target or at the floor. Starts in parallel.
    pub(super) fn evaluate(self, family: &[RunModel]) -> Vec<Point> {
        let mut points: Vec<Point> = Vec::with_capacity(family.len());
        let mut means: Vec<f64> = Vec::new();
        let mut systems = Systems::new(self.scene);
        for model in family {
            let point = self.point(systems.of(model), model);
            let (mean, refused) = match &point.error {
                Ok(error) => (Some(error.mean), false),
                Err(failure) => (failure.error, failure.kind == FailureKind::Refused),
            };
            points.push(point);
            match mean {
                Some(mean) => means.push(mean),
                None => means.clear(),
            }
            let fine = self.reference.disagreement.max(FINE * self.settings.target);
            let fine_enough = means.last().is_some_and(|mean| *mean <= fine);
            if refused || fine_enough || gains_nothing(&means) {
                break;
            }
        }
        points
    }

    /// A point without its cost.
    pub(super) fn point(self, system: Result<&Ready, Failure>, model: &RunModel) -> Point {
        let error = system.and_then(|system| self.error(system, model, self.settings.point_stride()));
        Point { model: *model, wall_s: None, error }
    }

    /// Error of a model over every start, where a point takes some of them.
    pub(super) fn over_all_starts(self, model: &RunModel) -> Result<PointError, Failure> {
        self.error(Systems::new(self.scene).of(model)?, model, 1)
    }

    /// Mean error over every so many of the starts.
    fn error(self, system: &Ready, model: &RunModel, stride: usize) -> Result<PointError, Failure> {
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
            return judged(&values);
        }
        // that of the first start that fails, computed where it was left out
        let known = starts.iter().zip(errors);
        let mut all = known.map(|(start, known)| known.unwrap_or_else(|| self.error_of(system, model, start)));
        let first = all.find_map(Result::err);
        Err(first.unwrap_or_else(|| Failure::new(FailureKind::Refused, String::new())))
    }

    /// Relative differences from the reference over a start's horizon and parts of it.
    fn error_of(self, system: &Ready, model: &RunModel, start: &StartReference) -> Result<StartErrors, Failure> {
        let run = system.simulate(&start.start, model, self.settings.simulated(start.horizon_s), None)?;
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
        Ok(StartErrors { over_horizon: over(start.horizon_s)?, by_growth })
    }

    /// Measures what the points cost, one run at a time and on this thread: the median of some rounds over all points, so that what
    /// else the machine does for a while falls on a round and not on a point. `done` is told the share that is done.
    pub(super) fn measure(self, points: &mut [Point], start: &StartReference, done: impl Fn(f64)) {
        let Settings { span_s, output_hz, .. } = *self.settings;
        let span = Span { duration: TIMED.min(span_s), output_hz };
        let mut systems = Systems::new(self.scene);
        let mut walls: Vec<Vec<f64>> = vec![Vec::with_capacity(ROUNDS); points.len()];
        for round in 0..ROUNDS {
            for (place, point) in points.iter().enumerate() {
                walls[place].extend(wall(&mut systems, point, start, span));
                let count = (ROUNDS * points.len()) as f64;
                done((round * points.len() + place + 1) as f64 / count);
            }
        }
        for (point, mut walls) in points.iter_mut().zip(walls) {
            walls.sort_by(f64::total_cmp);
            point.wall_s = walls.get(walls.len() / 2).copied();
        }
    }
}

/// Whether the last of a family's errors, from the roughest on, say that refining brings nothing more.
fn gains_nothing(means: &[f64]) -> bool {
    let [.., before, last] = means else {
        return false;
    };
    let (count, part) = STUCK;
    let stuck =
        means.len() >= count && means[means.len() - count..].iter().all(|mean| (mean / last - 1.0).abs() < part);
    (*last < CONVERGING && *last > GAIN * before) || stuck
}

/// Errors from one start.
#[derive(Debug, Clone, Copy)]
struct StartErrors {
    over_horizon: f64,
    by_growth: [GrowthError; GROWTHS.len()],
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
            reason: format!("the signal differs from the reference by {mean:.2e} of its root mean square"),
            error: Some(mean),
        })
    }
}

/// Wall time of one run over its simulated time; `None` for a point without an error.
fn wall(systems: &mut Systems, point: &Point, start: &StartReference, span: Span) -> Option<f64> {
    point.error.as_ref().ok()?;
    let simulation = systems.of(&point.model).ok()?.simulate(&start.start, &point.model, span, None).ok()?;
    Some(simulation.stepping_s / simulation.simulated_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refining_ends_where_it_brings_nothing() {
        assert!(!gains_nothing(&[0.01]));
        assert!(!gains_nothing(&[0.1, 0.05]));
        assert!(gains_nothing(&[0.1, 0.05, 0.049]));
        // far from converged: errors that are alike by chance go on, three of them do not
        assert!(!gains_nothing(&[1.47, 1.46]));
        assert!(!gains_nothing(&[3.0, 1.47, 1.46]));
        assert!(gains_nothing(&[1.47, 1.46, 1.47]));
    }

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
        assert!(failure.reason.contains("by 1.50e0 of its"), "{}", failure.reason);
    }
}
