//! What the chart measures by: two methods of different kind on the fullest model, refined until they agree.
//!
//! How fast nearby solutions part, and how long they stay together.

use super::budget::Deadline;
use super::scene::Ready;
use super::trace::{Failure, FailureKind, LEAST_STARTS, Trace};
use super::{Settings, Start, Starts};
use crate::app::error::ComputeError;
use crate::app::scene::RunModel;
use crate::numerics::ode::Method;
use crate::signal::SignalError;
use crate::system::{BallsInertia, ModeSelection};
use rayon::prelude::*;
use std::time::Instant;

/// First step of the method with fixed steps, in output intervals, and first tolerance of the other: the roughest that
/// agreed to a ten-thousandth in the dented bearing of `examples/tadina2011`.
pub(super) const FIRST: (f64, f64) = (1.0 / 128.0, 1e-6);

/// Time between the samples of the method that chooses its steps, in output intervals: what the sensor shows above half
/// this rate would fold into the band.
const SAMPLES: f64 = 1.0 / 16.0;

/// Refinements: step halved, tolerance a tenth.
const REFINEMENTS: usize = 3;

/// Part of the target below which the two methods agree well enough to stop refining, and to measure by.
const WANTED: f64 = 0.01;
const AGREED: f64 = 0.1;

/// What a refinement takes, in units of the run before it: twice the steps, and a tenth of the tolerance of a method of eighth
/// order.
const DEARER: [f64; 2] = [1.34, 2.0];

/// The reference of one start.
#[derive(Debug, Clone)]
pub struct StartReference {
    /// The start.
    pub start: Start,
    /// Signals of the method that chooses its steps, over the chart's span.
    pub trace: Trace,
    /// Distance of a perturbed solution by the other method.
    pub growth: Growth,
    /// Distance of the two methods.
    pub between: Growth,
    /// Time over which nearby solutions stay together, s.
    pub horizon_s: f64,
    /// Relative difference of the two methods over it.
    pub disagreement: f64,
    /// Refinements that it took.
    pub refinements: usize,
    /// Whether the budget ended before the two methods agreed as far as is wanted.
    pub cut_short: bool,
}

/// The reference of a chart.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Of every start, in order.
    pub starts: Vec<StartReference>,
    /// The model and method measured by and the one beside it, as the last refined start has them.
    pub models: [RunModel; 2],
    /// Mean of the starts' disagreements: the floor of the chart.
    pub disagreement: f64,
    /// Whether it is well below the target.
    pub agreed: bool,
}

impl Reference {
    /// Finds the reference of every start, in parallel; `done` is called after each. Starts that are not done at `until` are left
    /// out; as many at once as there are threads, so that some are.
    ///
    /// # Errors
    /// [`ComputeError::Failed`] if a method fails, [`ComputeError::Interrupted`] with fewer than two starts done; that of
    /// signals that cannot be compared.
    pub(super) fn find(
        system: &Ready,
        starts: &Starts,
        settings: &Settings,
        until: Deadline,
        done: impl Fn() + Sync,
    ) -> Result<Self, ComputeError> {
        let at_once = if until.is_never() { starts.starts.len() } else { rayon::current_num_threads() };
        let mut found = Vec::with_capacity(starts.starts.len());
        let mut cut = None;
        let mut groups = starts.starts.chunks(at_once.max(1));
        while let Some(group) = groups.next() {
            let share = until.part(groups.len() + 1);
            let of_group = group.par_iter().map(|start| {
                let found = of_start(system, start, settings, [share, until]);
                done();
                found
            });
            let of_group: Vec<_> = of_group.collect();
            for of_start in of_group {
                match of_start {
                    Err(error @ ComputeError::Interrupted { .. }) => cut = Some(error),
                    other => found.push(other?),
                }
            }
        }
        if let Some(cut) = cut.filter(|_| found.len() < LEAST_STARTS) {
            return Err(cut);
        }
        let starts = found;
        let count = starts.len() as f64;
        let disagreement = starts.iter().map(|start| start.disagreement).sum::<f64>() / count;
        let most = starts.iter().map(|start| start.refinements).max();
        Ok(Self {
            models: models(settings, most.unwrap_or(0)),
            disagreement,
            agreed: disagreement <= AGREED * settings.target,
            starts,
        })
    }

    /// Mean of the starts' horizons, s.
    pub(crate) fn mean_horizon_s(&self) -> f64 {
        let sum: f64 = self.starts.iter().map(|start| start.horizon_s).sum();
        sum / self.starts.len() as f64
    }

    /// Least of the starts' horizons, s.
    pub(crate) fn least_horizon_s(&self) -> f64 {
        let horizons = self.starts.iter().map(|start| start.horizon_s);
        horizons.fold(f64::INFINITY, f64::min)
    }

    /// Mean rate of growth, 1/s, over the starts that have one.
    pub(crate) fn growth_rate_per_s(&self) -> Option<f64> {
        let rates = self.starts.iter().filter_map(|s| s.growth.rate_per_s());
        let rates: Vec<f64> = rates.collect();
        (!rates.is_empty()).then(|| rates.iter().sum::<f64>() / rates.len() as f64)
    }
}

/// The fullest model by the method measured by, and by that beside it, refined so often.
pub(super) fn models(settings: &Settings, refinements: usize) -> [RunModel; 2] {
    let (step, tolerance) = FIRST;
    // a few refinements
    let times = refinements as i32;
    let fullest = |method, step| RunModel {
        modes: ModeSelection::All,
        residual: false,
        balls_inertia: BallsInertia::Dynamic,
        method,
        step,
    };
    [
        fullest(
            Method::Dop853 { tolerance: tolerance * 0.1_f64.powi(times), events: true },
            SAMPLES * settings.interval(),
        ),
        fullest(Method::ExponentialAdams { tolerance: None }, step * settings.interval() * 0.5_f64.powi(times)),
    ]
}

/// The reference of a start. Refined as long as the next refinement is expected to end within its `share` of the time.
///
/// # Errors
/// [`ComputeError::Interrupted`] if it has not been computed once at the end of all time.
fn of_start(
    system: &Ready,
    start: &Start,
    settings: &Settings,
    [share, until]: [Deadline; 2],
) -> Result<StartReference, ComputeError> {
    let (span, window) = (settings.span_s, settings.window_s);
    let run = |model: &RunModel, perturbed| -> Result<Trace, ComputeError> {
        let run = system.simulate(start, model, settings.simulated(span), perturbed, until);
        run.and_then(|run| Trace::of_run(&run, settings)).map_err(|failure| of_run(&failure, model, start, span))
    };
    let timed = |model: &RunModel| {
        let begun = Instant::now();
        run(model, None).map(|trace| (trace, begun.elapsed().as_secs_f64()))
    };
    let [by, beside] = models(settings, 0);
    let (witness, beside_s) = timed(&beside)?;
    let nearby = run(&beside, Some(settings.ensemble))?;
    let growth = Growth::between(&nearby, &witness, span, window)?;
    let horizon_s = growth.horizon_s(1.0 / settings.target);
    let (trace, by_s) = timed(&by)?;
    let measured = |[trace, witness]: [Trace; 2], growth, refinements| -> Result<StartReference, ComputeError> {
        let disagreement = witness.error(&trace, 0.0, horizon_s)?;
        Ok(StartReference {
            between: Growth::between(&witness, &trace, span, window)?,
            start: start.clone(),
            trace,
            growth,
            horizon_s,
            disagreement,
            refinements,
            cut_short: false,
        })
    };
    let mut found = measured([trace, witness], growth, 0)?;
    let mut seconds = [by_s, beside_s];
    while found.disagreement > WANTED * settings.target && found.refinements < REFINEMENTS {
        let expected: f64 = seconds.iter().zip(DEARER).map(|(took, times)| times * took).sum();
        if expected > share.left_s() {
            return Ok(StartReference { cut_short: true, ..found });
        }
        let refinements = found.refinements + 1;
        let [by, beside] = models(settings, refinements);
        match timed(&beside).and_then(|witness| Ok((witness, timed(&by)?))) {
            Ok(((witness, beside_s), (trace, by_s))) => {
                found = measured([trace, witness], found.growth, refinements)?;
                seconds = [by_s, beside_s];
            }
            Err(ComputeError::Interrupted { .. }) => return Ok(StartReference { cut_short: true, ..found }),
            Err(error) => return Err(error),
        }
    }
    Ok(found)
}

/// The error of a run that failed.
fn of_run(failure: &Failure, model: &RunModel, start: &Start, span_s: f64) -> ComputeError {
    match failure.kind {
        FailureKind::OutOfTime => ComputeError::Interrupted { at_s: start.time_s, end_s: start.time_s + span_s },
        _ => no_reference(model.method.name(), start.time_s, &failure.reason),
    }
}

/// The error of a method that failed from the start at `start_s` (s): there is nothing to compare with.
fn no_reference(method: &str, start_s: f64, reason: &str) -> ComputeError {
    ComputeError::failed(
        format!("the reference by {method} failed at the start at {start_s} s: {reason}"),
        "`plummer run` with transient.modes = \"all\" shows what happens there; another transient.start begins elsewhere",
    )
}

/// Distance of two solutions over time.
///
/// The time since the start is cut into windows of equal length. In each of them the distance is
///
/// ```text
/// d = sqrt(sum_s mean (a_s - b_s)^2) / sqrt(sum_s mean b_s^2 over all windows)
/// ```
///
/// with the band-limited accelerations a_s and b_s of sensor s in the two solutions; b is the reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Growth {
    window_s: f64,
    /// In each window, in units of the reference's root mean square over the span.
    pub(super) distances: Vec<f64>,
}

impl Growth {
    /// Distance of `other` from `reference` over `span_s` (s) from their start in windows of `window_s` (s).
    ///
    /// # Errors
    /// [`SignalError`] if they do not have the same instants or the reference is zero throughout.
    pub(crate) fn between(other: &Trace, reference: &Trace, span_s: f64, window_s: f64) -> Result<Self, SignalError> {
        let size = reference.rms(0.0, span_s)?;
        // a whole number of windows, up to round-off
        let count = (span_s / window_s * (1.0 + 1e-9)).floor() as usize;
        let distances = (0..count).map(|window| {
            let [from, to] = [window, window + 1].map(|place| place as f64 * window_s);
            Ok(other.difference(reference, from, to)? / size)
        });
        Ok(Self { window_s, distances: distances.collect::<Result<_, SignalError>>()? })
    }

    /// Ends of the windows since the start, s.
    pub(crate) fn times_s(&self) -> Vec<f64> {
        (1..=self.distances.len()).map(|window| window as f64 * self.window_s).collect()
    }

    /// Distance at the start: that of the first window in which there is one. `None`: the two are the same throughout.
    pub(crate) fn initial(&self) -> Option<f64> {
        self.distances.iter().copied().find(|&d| d > 0.0)
    }

    /// Growth G of the distance: that in each window over that at the start.
    pub(crate) fn growth(&self) -> Vec<f64> {
        let initial = self.initial().unwrap_or(1.0);
        self.distances.iter().map(|d| d / initial).collect()
    }

    /// Time since the start over which nearby solutions stay together, s: up to the begin of the first window in which the
    /// distance has grown by more than `factor`; the whole span if there is none.
    pub(crate) fn horizon_s(&self, factor: f64) -> f64 {
        let growth = self.growth();
        let windows = growth.iter().position(|&g| g > factor);
        windows.unwrap_or(growth.len()) as f64 * self.window_s
    }

    /// Rate at which the distance grows, 1/s: slope of the straight line through its logarithm over the span, by least
    /// squares. `None` with fewer than two windows that have a distance.
    pub(crate) fn rate_per_s(&self) -> Option<f64> {
        let times = self.times_s();
        let points = times.iter().zip(&self.distances);
        let points: Vec<(f64, f64)> = points.filter(|(_, d)| **d > 0.0).map(|(t, d)| (*t, d.ln())).collect();
        if points.len() < 2 {
            return None;
        }
        let mean = |value: fn(&(f64, f64)) -> f64| points.iter().map(value).sum::<f64>() / points.len() as f64;
        let (t_mean, ln_mean) = (mean(|p| p.0), mean(|p| p.1));
        let products = points.iter().map(|(t, ln)| (t - t_mean) * (ln - ln_mean));
        let squares = points.iter().map(|(t, _)| (t - t_mean).powi(2));
        Some(products.sum::<f64>() / squares.sum::<f64>())
    }
}

#[cfg(test)]
mod tests {
    use super::no_reference;

    #[test]
    fn a_reference_that_fails_is_not_the_input() {
        let error = no_reference("dop853", 2.3, "the solution blew up");
        assert!(!error.is_input());
        assert_eq!(error.to_string(), "the reference by dop853 failed at the start at 2.3 s: the solution blew up");
        assert_eq!(
            error.help().unwrap(),
            "`plummer run` with transient.modes = \"all\" shows what happens there; another transient.start begins elsewhere"
        );
    }
}

#[cfg(test)]
mod growth_tests {
    use super::*;
    use crate::numerics::series::TimeSeries;
    use std::f64::consts::TAU;

    /// A reference and a neighbour whose distance grows as `size exp(rate t)`: 8 ms at 200 kHz.
    fn pair(size: f64, rate: f64) -> (Trace, Trace) {
        let series = |other: bool| {
            let values = (0..1600).map(|k| {
                let t = f64::from(k) * 5e-6;
                let wave = (TAU * 20e3 * t).sin();
                let apart = if other { size * (rate * t).exp() } else { 0.0 };
                wave + apart * (TAU * 20e3 * t + 0.4).sin()
            });
            TimeSeries::new(2.3, 5e-6, "m/s^2", values.collect()).unwrap()
        };
        (Trace::of(vec![series(true)]), Trace::of(vec![series(false)]))
    }

    #[test]
    fn the_horizon_is_where_the_distance_has_grown_by_the_factor() {
        // 2 per ms: 100 times in ln(100) / 2 = 2.303 ms
        let (other, reference) = pair(1e-9, 2000.0);
        let growth = Growth::between(&other, &reference, 8e-3, 0.25e-3).unwrap();
        // measured from the first window's mean to another's: to a window
        assert!((growth.horizon_s(100.0) - 2.303e-3).abs() < 0.25e-3);
        // an exponential is exact but for the rounding of 1e-9 beside 1
        let rate = growth.rate_per_s().unwrap();
        assert!((rate / 2000.0 - 1.0).abs() < 1e-4, "{rate}");
        // rms over the first window: mean of exp(2 rate t) over 0 to 0.25 ms is e - 1 = 1.718
        let initial = growth.initial().unwrap();
        assert!((initial / (1e-9 * 1.7183_f64.sqrt()) - 1.0).abs() < 0.02, "{initial}");
        assert!((growth.times_s()[3] - 1e-3).abs() < 1e-12);
    }

    #[test]
    fn without_growth_the_horizon_is_the_whole_span() {
        for rate in [0.0, -1000.0] {
            let (other, reference) = pair(1e-9, rate);
            let growth = Growth::between(&other, &reference, 8e-3, 0.25e-3).unwrap();
            assert!((growth.horizon_s(100.0) - 8e-3).abs() < 1e-12);
        }
        let (same, reference) = pair(0.0, 0.0);
        let growth = Growth::between(&same, &reference, 8e-3, 0.25e-3).unwrap();
        assert!((growth.horizon_s(100.0) - 8e-3).abs() < 1e-12);
        assert_eq!((growth.initial(), growth.rate_per_s()), (None, None));
    }
}
