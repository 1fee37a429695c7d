//! What a chart is going to take, by short runs before it begins.

use super::budget::Deadline;
use super::candidates::kept;
use super::points::{ROUNDS, TIMED};
use super::reference::{FIRST, models};
use super::scene::Ready;
use super::starts::Systems;
use super::trace::Failure;
use super::{Settings, Start};
use crate::app::commands::run::Span;
use crate::app::scene::RunModel;
use crate::numerics::ode::Method;

/// A step of a method that solves its equations, in those of one that does not. It is a guess: it decides what is left out, not what is
/// computed.
const IMPLICIT: f64 = 10.0;

/// Tolerance of the pilot by it, which is that of the reference.
const FIRST_TOLERANCE: f64 = FIRST.1;

/// Order of `dop853`, which says how its steps follow a tolerance.
const ORDER: f64 = 8.0;

/// Runs of the reference of a start, one refinement among them, in first runs: of the method measured by, and of that beside it.
const RUNS: [f64; 2] = [2.34, 4.0];

/// Steps a candidate's output interval of the pilot on the program's own basis: stable in every shipped scene.
const FINE_STEPS: f64 = 16.0;

/// Longest pilot, s: a hundred times what a clock and a warm cache need.
const PILOT: f64 = 0.1;

/// Output intervals of the shortest pilot, and how many times longer the next one is.
const INTERVALS: usize = 4;
const LONGER: usize = 4;

/// What a chart is going to compute and what it takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plan {
    /// Most points: families end where refining brings nothing more.
    pub(crate) points: usize,
    /// Wall time, s; at most the budget.
    pub(crate) seconds: f64,
}

/// What a simulated second takes, s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Costs {
    /// Of the two methods of the reference, not refined.
    pub(super) reference: [f64; 2],
    /// Of the program's own choice.
    chosen: f64,
    /// A step of exponential-adams on the program's basis and on all modes, s.
    step_s: [f64; 2],
}

impl Costs {
    /// By short runs from a start.
    ///
    /// # Errors
    /// The [`Failure`] of a run of the reference: without it there is no chart.
    pub(super) fn measured(
        systems: &Systems<'_>,
        start: &Start,
        chosen: &RunModel,
        settings: &Settings,
        until: Deadline,
    ) -> Result<Self, Failure> {
        // on all threads at once, as the chart's runs are: on a busy machine two threads are not twice as fast
        let of = |model: &RunModel| -> Result<f64, Failure> {
            let system = systems.of(model)?;
            let all = rayon::broadcast(|_| pilot(system, start, model, settings, until));
            all.into_iter().try_fold(0.0, |slowest: f64, one| Ok(slowest.max(one?)))
        };
        let [by, beside] = models(settings, 0);
        let reference = [of(&by)?, of(&beside)?];
        let all = reference[1] * beside.step;
        let step = settings.interval() / FINE_STEPS;
        let fixed = RunModel { method: Method::ExponentialAdams { tolerance: None }, step, ..*chosen };
        // a choice that fails is a point with its reason; here it costs what the fullest model does
        let usual = of(&fixed).map_or(all, |second| second * step);
        let chosen = of(chosen).unwrap_or(reference[1]);
        Ok(Self { reference, chosen, step_s: [usual, all] })
    }

    /// Of the reference of a start, s of computing a simulated second.
    pub(super) fn of_reference(self) -> f64 {
        self.reference.iter().zip(RUNS).map(|(second, runs)| second * runs).sum()
    }

    /// Of a model by the number of its modes among so many; the program's choice keeps `usual`.
    fn of(self, model: &RunModel, modes: usize, [usual, all]: [usize; 2]) -> f64 {
        let [least, most] = self.step_s;
        let part = if all > usual { (modes as f64 - usual as f64) / (all - usual) as f64 } else { 1.0 };
        let step_s = (least + (most - least) * part).max(0.1 * least);
        match model.method {
            Method::Dop853 { tolerance, .. } => {
                self.reference[0] * step_s / most * (FIRST_TOLERANCE / tolerance).powf(1.0 / ORDER)
            }
            Method::ExponentialAdams { tolerance: Some(_) } => self.chosen * step_s / least,
            method if method.is_implicit() => IMPLICIT * step_s / model.step,
            _ => step_s / model.step,
        }
    }

    /// What the points, their wall times and the statistics take beside the reference.
    pub(super) fn plan(
        self,
        families: &[Vec<RunModel>],
        frequencies_hz: &[f64],
        [chosen, source]: &[RunModel; 2],
        settings: &Settings,
        threads: usize,
    ) -> Plan {
        let all = frequencies_hz.len();
        let of = |model: &RunModel| {
            self.of(model, kept(model.modes, frequencies_hz), [kept(chosen.modes, frequencies_hz), all])
        };
        let runs = settings.ensemble.runs as f64;
        let of_start = settings.span_s + settings.edge_s;
        let second: f64 = families.iter().flatten().map(of).sum();
        let parallel = self.of_reference() * runs * of_start
            + second * of_start * (runs / settings.point_stride() as f64)
            + (self.reference[1] + of(chosen) + of(source)) * runs * (settings.statistics_s + settings.edge_s);
        let alone = second * ROUNDS as f64 * TIMED.min(settings.span_s);
        Plan { points: families.iter().map(Vec::len).sum(), seconds: parallel / threads as f64 + alone }
    }
}

/// Wall time of a model a simulated second, on one thread, s, by a short run from a start.
///
/// # Errors
/// The [`Failure`] of that run.
fn pilot(
    system: &Ready,
    start: &Start,
    model: &RunModel,
    settings: &Settings,
    until: Deadline,
) -> Result<f64, Failure> {
    let mut intervals = INTERVALS;
    loop {
        let span = Span { duration: intervals as f64 * settings.interval(), output_hz: settings.output_hz };
        let run = system.simulate(start, model, span, None, until)?;
        if run.stepping_s > PILOT || span.duration >= settings.window_s {
            return Ok(run.stepping_s / run.simulated_s);
        }
        intervals *= LONGER;
    }
}
