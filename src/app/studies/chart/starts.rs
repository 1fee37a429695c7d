//! Where the runs of an ensemble begin: instants over one ball pass, each at rest in its own equilibrium; systems that begin there.

use super::Settings;
use super::budget::Deadline;
use super::scene::{ChartScene, Ready};
use super::trace::{Failure, FailureKind};
use crate::app::case;
use crate::app::commands::run::choice::perturbation::perturb;
use crate::app::commands::run::{RunEnd, Simulation, Span};
use crate::app::error::ComputeError;
use crate::app::scene::RunModel;
use crate::bearing::Cage;
use crate::system::Equilibrium;
use rayon::prelude::*;

/// Halvings that find the end of a ball pass.
const HALVINGS: usize = 60;

/// How many times faster the end of the simulated time must be, so that the starts lie there: more than roundings.
const FASTER: f64 = 1.01;

/// A start of a run.
#[derive(Debug, Clone)]
pub struct Start {
    /// Number in the ensemble, from 0.
    pub number: usize,
    /// When, s.
    pub time_s: f64,
    /// At rest in this in its plane; `None` in space, where each model rests by itself.
    pub equilibrium: Option<Equilibrium>,
}

/// The starts of a scene's ensemble.
#[derive(Debug, Clone)]
pub struct Starts {
    /// Those with an equilibrium, in order of time.
    pub starts: Vec<Start>,
    /// Time over which they are spread, s: a ball pass, or less if the simulated time ends before.
    pub spread_s: f64,
    /// Starts that have no equilibrium, and why.
    pub left_out: Vec<String>,
}

impl Starts {
    /// As many as the ensemble has runs, evenly over a ball pass: the first until `end` (s), or, in a run-up, the last whose
    /// runs end there. At rest a run-up has no signal to compare. Each starts from the equilibrium with cage and loads held as
    /// they are then.
    ///
    /// # Errors
    /// [`ComputeError::Failed`] if fewer than two have an equilibrium.
    pub(crate) fn over_ball_pass(scene: &ChartScene, settings: &Settings, end: f64) -> Result<Self, ComputeError> {
        let wanted = settings.ensemble.runs;
        let cage = scene.cage();
        let begin = scene.start();
        let speed = |time: f64| cage.motion(time).speed.abs();
        let last = end - settings.span_s.max(settings.statistics_s) - settings.edge_s;
        let (first, spread_s) = if last > begin && speed(last) > FASTER * speed(begin) {
            let spread = ball_pass(cage, last, begin);
            (last - spread, spread)
        } else {
            (begin, ball_pass(cage, begin, end))
        };
        let found: Vec<_> = (0..wanted)
            .into_par_iter()
            .map(|number| {
                let time_s = first + spread_s * number as f64 / wanted as f64;
                (time_s, number, scene.rest(time_s))
            })
            .collect();
        let mut starts = Vec::with_capacity(wanted);
        let mut left_out = Vec::new();
        let mut failed = None;
        for (time_s, number, found) in found {
            match found {
                Ok(equilibrium) => starts.push(Start { number, time_s, equilibrium }),
                Err(error) => {
                    left_out.push(format!("start at {time_s} s: {error}"));
                    failed.get_or_insert(error);
                }
            }
        }
        match failed {
            Some(source) if starts.len() < 2 => Err(ComputeError::failed(
                format!(
                    "{} of {wanted} starts over a ball pass have an equilibrium, at least 2 are needed: {source}",
                    starts.len()
                ),
                "another transient.start begins elsewhere",
            )),
            _ => Ok(Self { starts, spread_s, left_out }),
        }
    }

    /// When the first begins, s.
    pub(crate) fn first_s(&self) -> f64 {
        self.starts[0].time_s
    }
}

/// Time in which the cage turns by the distance of two balls between `from` and `to`, next to `from`, s; all of it where the
/// cage turns less. `to` may be the earlier one.
fn ball_pass(cage: &Cage, from: f64, to: f64) -> f64 {
    let begin = cage.motion(from).angle;
    let turned = |share: f64| (cage.motion(from + share * (to - from)).angle - begin).abs();
    let (mut low, mut high) = (0.0, 1.0);
    if turned(high) > cage.spacing {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if turned(middle) < cage.spacing {
                low = middle;
            } else {
                high = middle;
            }
        }
    }
    high * (to - from).abs()
}

/// The systems of a scene's models; models that differ by method or step alone share one.
pub(super) struct Systems<'a>(Vec<(RunModel, Result<Ready<'a>, Failure>)>);

impl Ready<'_> {
    /// A whole simulation of a model from rest at a start; perturbed as an ensemble's runs are, if one is given.
    ///
    /// # Errors
    /// [`Failure`] also for one that ended before its time, or that is not done at `until`.
    pub(super) fn simulate(
        &self,
        start: &Start,
        model: &RunModel,
        span: Span,
        perturbed: Option<case::Ensemble>,
        until: Deadline,
    ) -> Result<Simulation, Failure> {
        let mut state = self.at_rest(start.time_s, start.equilibrium.as_ref())?;
        if let Some(case::Ensemble { perturbation, seed, .. }) = perturbed {
            perturb(&mut state, perturbation, seed, start.number);
        }
        let simulation = self.from(state, model, span, until)?;
        match simulation.end {
            RunEnd::Complete => Ok(simulation),
            RunEnd::BlewUp(error) => Err(Failure::new(FailureKind::BlewUp, error.to_string())),
        }
    }
}

impl<'a> Systems<'a> {
    /// Those of some models, built in parallel.
    pub(super) fn of_all<'m>(scene: &'a ChartScene, models: impl IntoIterator<Item = &'m RunModel>) -> Self {
        let mut distinct: Vec<RunModel> = Vec::new();
        for model in models {
            if !distinct.iter().any(|other| same_system(model, other)) {
                distinct.push(*model);
            }
        }
        let built = distinct.into_par_iter().map(|model| (model, scene.ready(&model).map_err(Failure::from)));
        Self(built.collect())
    }

    /// The system of a model.
    ///
    /// # Errors
    /// [`Failure`] for a model that does not fit the scene, or that was not among them.
    pub(super) fn of(&self, model: &RunModel) -> Result<&Ready<'a>, Failure> {
        let known = self.0.iter().find(|(other, _)| same_system(model, other));
        let (_, ready) = known.ok_or_else(|| Failure::new(FailureKind::Refused, "no system was built".to_owned()))?;
        ready.as_ref().map_err(Clone::clone)
    }
}

fn same_system(model: &RunModel, other: &RunModel) -> bool {
    RunModel { method: model.method, step: model.step, ..*other } == *model
}
