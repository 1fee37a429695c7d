//! The map of a case.

use super::super::compute::{Counter, automatic};
use super::super::{Deadline, Effort};
use super::cell::{MethodStability, by_tolerance, on_grid};
use super::condition::{Condition, Measurement, Reference, Variant};
use crate::app::case;
use crate::app::case::{Case, RunCase};
use crate::app::commands::run::choice::ModelChoice;
use crate::app::error::ComputeError;
use crate::app::scene::{RunModel, Scene};
use crate::numerics::Watch;
use crate::numerics::ode::{Linearised, Method, fastest};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::time::Instant;

/// Shortest and longest step of the grid, s.
const STEPS: [f64; 2] = [5e-8, 1e-5];

/// Steps a decade, full and quick.
const PER_DECADE: [f64; 2] = [10.0, 5.0];

/// Steps of a run, full and quick; of an implicit method and in all modes, where a step takes ten times as long.
const RUN: [u32; 2] = [2000, 600];
const SLOW_RUN: [u32; 2] = [400, 200];

/// Phases that are looked at for resonances, full and quick.
const PHASES: [usize; 2] = [24, 8];

/// Steps of the reference, in units of the least limit that is predicted, and the largest phase of a mode in them.
const FINER: f64 = 0.125;
const FINER_PHASE: f64 = 1.5;

/// Spectral radius of generalized-alpha, as the program's own choice.
const SPECTRAL_RADIUS: f64 = 0.8;

/// Methods with equal steps; those that solve their equations last.
const EQUAL: [Method; 6] = [
    Method::Exponential,
    Method::ExponentialAdams { tolerance: None },
    Method::NewmarkExplicit,
    Method::Splitting,
    Method::Newmark,
    Method::GeneralizedAlpha { spectral_radius: SPECTRAL_RADIUS },
];

/// Methods that choose their steps, with the program's own tolerances for an error of a percent.
const BY_TOLERANCE: [Method; 2] =
    [Method::ExponentialAdams { tolerance: Some(1e-2) }, Method::Dop853 { tolerance: 1e-6, events: true }];

const METHODS: usize = EQUAL.len() + BY_TOLERANCE.len();

/// Time between samples of these, s, and how many: 2 ms.
const SAMPLES: [f64; 2] = [4e-7, 5000.0];

/// Which steps methods can take, under which conditions.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "StabilitySummary")]
pub struct Stability {
    /// What of the case was modelled.
    pub model: StabilityModel,
    /// Steps of the grid, s, ascending.
    pub steps_s: Vec<f64>,
    /// The conditions, the case itself first.
    pub conditions: Vec<ConditionSummary>,
}

/// What of the case was modelled.
#[derive(Debug, Serialize, JsonSchema)]
pub struct StabilityModel {
    /// Kept modes of ring and housing.
    pub modes: usize,
    /// Of how many.
    pub of_modes: usize,
    /// Whether the static residual of the others was in use.
    pub residual: bool,
}

/// All methods under a condition.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ConditionSummary {
    /// What is other than in the case.
    pub condition: &'static str,
    /// Its value, in `unit`; `None` for a condition without.
    pub value: Option<f64>,
    /// Unit of the value, "x" for a factor.
    pub unit: Option<&'static str>,
    /// Both in words.
    pub label: String,
    /// The methods; `None` where the bearing cannot be in the condition.
    pub methods: Option<Vec<MethodStability>>,
    /// Why it cannot.
    pub reason: Option<String>,
}

/// A condition made ready.
struct Prepared {
    variant: Variant,
    steps: u32,
    slow_steps: u32,
    all_modes: bool,
    reference: Reference,
}

/// Why a condition has no methods that the budget took.
pub(crate) const NO_TIME: &str = "left out: the budget ended before";

/// Computes the map of a case, whose scene is `scene`, over conditions, such as [all](Condition::all). Where there is an end they
/// are computed one after the other, and those that are not done by then are left out.
///
/// # Errors
/// [`ComputeError`]; a condition that the bearing cannot be in is no error.
pub(crate) fn compute_stability(
    run: RunCase<'_>,
    scene: &Scene,
    conditions: Vec<Condition>,
    effort: Effort,
    until: Deadline,
    watch: &impl Watch,
) -> Result<Stability, ComputeError> {
    let transient = &automatic(run.transient, case::Method::Auto);
    let choice = ModelChoice::of_case(RunCase { transient, ..run }, scene)?;
    let (model, grid) = (choice.model, grid(effort));
    watch.stage("stability");
    let progress = Counter::new(watch, conditions.len() * (1 + METHODS));
    let at_once = if until.is_never() { conditions.len() } else { 1 };
    let mut kept = None;
    let mut summaries: Vec<ConditionSummary> = Vec::with_capacity(conditions.len());
    let mut longest_s = 0.0_f64;
    for group in conditions.chunks(at_once.max(1)) {
        let begun = Instant::now();
        let mut of_group = if until.is_over() || longest_s > until.left_s() {
            Vec::new()
        } else {
            let prepared = prepared(group, (run.case, scene, &model), effort, until, &progress);
            kept = kept.or_else(|| Some(prepared.first()?.as_ref().ok()?.variant.system.modes()));
            summarised(group, prepared, &grid, effort, &progress)
        };
        longest_s = longest_s.max(begun.elapsed().as_secs_f64());
        if of_group.is_empty() || until.is_over() {
            of_group =
                group.iter().map(|condition| ConditionSummary::of(*condition, Err(NO_TIME.to_owned()))).collect();
        }
        summaries.extend(of_group);
    }
    Ok(Stability {
        model: StabilityModel {
            modes: kept.unwrap_or(0),
            of_modes: scene.stage.modes.count(),
            residual: model.residual,
        },
        conditions: summaries,
        steps_s: grid,
    })
}

/// Conditions made ready, in parallel, or why they cannot be.
fn prepared(
    conditions: &[Condition],
    (case, scene, model): (&Case, &Scene, &RunModel),
    effort: Effort,
    until: Deadline,
    progress: &Counter<'_, impl Watch>,
) -> Vec<Result<Prepared, String>> {
    let prepared = conditions.par_iter().map(|condition| {
        let prepared = prepare(*condition, case, scene, model, effort, until);
        progress.done();
        prepared.map_err(|error| error.to_string())
    });
    prepared.collect()
}

/// All methods under conditions, in parallel.
fn summarised(
    conditions: &[Condition],
    prepared: Vec<Result<Prepared, String>>,
    grid: &[f64],
    effort: Effort,
    progress: &Counter<'_, impl Watch>,
) -> Vec<ConditionSummary> {
    let cells: Vec<Option<MethodStability>> = (0..conditions.len() * METHODS)
        .into_par_iter()
        .map(|place| {
            let of = prepared[place / METHODS].as_ref().ok();
            let cell = of.and_then(|of| cell(of, place % METHODS, grid, effort));
            progress.done();
            cell
        })
        .collect();
    let all = conditions.iter().zip(prepared).zip(cells.chunks(METHODS));
    all.map(|((condition, prepared), cells)| {
        ConditionSummary::of(*condition, prepared.map(|_| cells.iter().flatten().cloned().collect()))
    })
    .collect()
}

impl ConditionSummary {
    /// Its methods, or why it has none.
    fn of(condition: Condition, methods: Result<Vec<MethodStability>, String>) -> Self {
        let (name, value) = condition.axis_and_value();
        let (value, unit) = value.unzip();
        let (methods, reason) = methods.map_or_else(|reason| (None, Some(reason)), |methods| (Some(methods), None));
        Self { condition: name, value, unit, label: condition.label(), methods, reason }
    }
}

fn prepare(
    condition: Condition,
    case: &Case,
    scene: &Scene,
    model: &RunModel,
    effort: Effort,
    until: Deadline,
) -> Result<Prepared, ComputeError> {
    let variant = condition.variant(case, scene, model, until)?;
    let all_modes = matches!(condition, Condition::AllModes | Condition::AllModesUndamped);
    let slow_steps = effort.pick(SLOW_RUN);
    let steps = if all_modes { slow_steps } else { effort.pick(RUN) };
    let mut linearised = Linearised::new(&mut variant.system.clone(), &variant.state);
    let limit = Method::Exponential.limit_of(&mut linearised);
    let limit = limit.map_or(1e-6, |limit| limit.step_s);
    let highest = variant.system.highest_squared_frequency().sqrt();
    let finer = (FINER * limit).min(FINER_PHASE / highest.max(f64::MIN_POSITIVE));
    let finer_steps = (f64::from(steps) * limit / finer).ceil() as u32;
    let rate = fastest(&linearised).unwrap_or(0.0);
    let reference = Reference::of(&variant, Method::Exponential, finer, finer_steps, rate);
    Ok(Prepared { variant, steps, slow_steps, all_modes, reference })
}

/// A method under a condition; none of an implicit one in all modes, where a step solves for all of them, and of one that chooses
/// steps by the highest.
fn cell(of: &Prepared, method: usize, grid: &[f64], effort: Effort) -> Option<MethodStability> {
    if of.variant.until.is_over() {
        return None;
    }
    let measurement = |steps| Measurement { variant: &of.variant, steps, reference: &of.reference };
    let mut linearised = Linearised::new(&mut of.variant.system.clone(), &of.variant.state);
    let Some(&equal) = EQUAL.get(method) else {
        let chosen = BY_TOLERANCE.get(method - EQUAL.len())?;
        let cell = || by_tolerance(&measurement(0), &mut linearised, *chosen, SAMPLES);
        return (!of.all_modes).then(cell);
    };
    if equal.is_implicit() && of.all_modes {
        return None;
    }
    let steps = if equal.is_implicit() { of.slow_steps } else { of.steps };
    let phases = effort.pick(PHASES);
    Some(on_grid(&measurement(steps), &mut linearised, equal, grid, phases))
}

fn grid(effort: Effort) -> Vec<f64> {
    let [first, last] = STEPS;
    let per_decade = effort.pick(PER_DECADE);
    let count = ((last / first).log10() * per_decade).floor() as i32;
    let step = |k: i32| first * 10_f64.powf(f64::from(k) / per_decade);
    (0..=count).map(step).collect()
}
