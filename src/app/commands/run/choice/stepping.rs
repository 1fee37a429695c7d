//! Method and step.

use super::model_choice::ChosenPart;
use super::quantities::{IMPACT, dynamic};
use super::travel;
use crate::app::case::{self, StepLength};
use crate::app::error::ComputeError;
use crate::app::scene::{RunModel, Scene};
use crate::numerics::ode::{Method, Schedule};
use crate::report::significant;
use crate::system::{CoupledSystem, Equilibrium, ModeSelection};

/// Tolerance of exponential-adams for a target of one percent, and the error that it makes: on the dented bearing of
/// `examples/tadina2011`, over 20 starts of up to 8 ms. What it bounds falls with the third power of the step, or the second where a
/// contact begins; the error fell with the tolerance to the power [`ADAMS_ORDER`].
const ADAMS_TOLERANCE: f64 = 1e-3;
const ADAMS_TARGET: f64 = 1e-2;
pub(crate) const ADAMS_ORDER: f64 = 0.75;

/// Part of the target that the steps may take.
const SHARE: f64 = 0.8;

/// Shortest steps that the program chooses for the exponential method, in units of those that resolve the contacts: where shorter ones do not help,
/// such a motion cannot be predicted.
const SHORTEST: f64 = 1.0 / 32.0;

/// Largest phase of the highest kept mode in a step: exponential-adams lets energy creep through modes that it does not
/// resolve, and with a tolerance halves its steps where that shows.
const MODE_PHASE: f64 = 2.0;

/// Least number of steps in an output interval: the displacement of a sensor is differentiated from them, with an error of 3e-4 for
/// four.
const LEAST_SAMPLES: f64 = 4.0;

/// Part of the stable step that is used: contacts at other angles of the balls are a little stiffer.
const STABLE: f64 = 0.9;

/// Step of the other methods: phase of the stiffest ball vibration, rad.
const PHASE: f64 = 0.1;

/// The source's step for explicit Newmark, s (section 4.1).
const NEWMARK_STEP: f64 = 1.5e-8;

/// Tolerance of `dop853` unless one is given: far below one percent after some milliseconds of impacts.
const DOP853_TOLERANCE: f64 = 1e-6;

/// Relative difference of two steps that are the same but for round-off.
const SAME_STEP: f64 = 1e-6;

/// Default of generalized-alpha: takes what is not resolved out within some tens of steps, and of a motion of 0.1 rad a step
/// 7e-8 of the amplitude.
const SPECTRAL_RADIUS: f64 = 0.8;

/// The tolerance of exponential-adams for a target.
pub(crate) fn tolerance(target: f64) -> f64 {
    ADAMS_TOLERANCE * (SHARE * target / ADAMS_TARGET).powf(1.0 / ADAMS_ORDER)
}

/// exponential-adams with a tolerance.
pub(crate) fn adams(tolerance: f64) -> Method {
    Method::ExponentialAdams { tolerance: Some(tolerance) }
}

/// The method that a case asks for, or exponential-adams with steps by a tolerance, on all modes the exponential one: it has
/// no limit there.
pub(crate) fn method(asked: &case::Transient, model: &RunModel, target: f64) -> (Method, ChosenPart) {
    let by_steps = asked.step == StepLength::Auto;
    let adams = |given: Option<f64>| Method::ExponentialAdams {
        tolerance: given.or_else(|| by_steps.then(|| tolerance(target))),
    };
    let method = match asked.method {
        case::Method::Auto if model.modes == ModeSelection::All => Method::Exponential,
        case::Method::Auto | case::Method::ExponentialAdams => adams(asked.tolerance),
        case::Method::Exponential => Method::Exponential,
        case::Method::NewmarkExplicit => Method::NewmarkExplicit,
        case::Method::Splitting => Method::Splitting,
        case::Method::Newmark => Method::Newmark,
        case::Method::GeneralizedAlpha => {
            Method::GeneralizedAlpha { spectral_radius: asked.spectral_radius.unwrap_or(SPECTRAL_RADIUS) }
        }
        case::Method::Dop853 => Method::Dop853 { tolerance: asked.tolerance.unwrap_or(DOP853_TOLERANCE), events: true },
    };
    let chosen = asked.method == case::Method::Auto;
    let why = match (chosen, method) {
        (false, _) => "given".to_owned(),
        (true, Method::Exponential) => {
            "all modes: the linear part exactly, no limit from the highest".to_owned()
        }
        (true, _) => "one evaluation a step, the linear part and the balls' contacts as springs exactly, order and steps by the error of each".to_owned(),
    };
    let (text, estimated_error) = match method {
        Method::ExponentialAdams { tolerance: Some(tolerance) } => (
            format!("{}, tolerance {}", method.name(), significant(tolerance, 2)),
            Some(ADAMS_TARGET * (tolerance / ADAMS_TOLERANCE).powf(ADAMS_ORDER)),
        ),
        Method::Dop853 { tolerance, .. } => {
            (format!("{}, tolerance {}", method.name(), significant(tolerance, 2)), None)
        }
        _ => (method.name().to_owned(), None),
    };
    let part = ChosenPart { what: "method", chosen: text, why, estimated_error };
    (method, part)
}

/// The largest step, or the time between samples: the given one, so much shorter that a whole number fills an output interval, or the program's own.
///
/// # Errors
/// [`ComputeError::System`] for a model that does not fit the scene, [`ComputeError::Transient`] for a step that no run takes.
pub(crate) fn step(
    asked: &case::Transient,
    model: &RunModel,
    scene: &Scene,
    heaviest: Option<&(f64, Equilibrium)>,
) -> Result<(f64, ChosenPart), ComputeError> {
    let (step, why) = match asked.step {
        StepLength::Auto => {
            let (step, why) = own_step(asked, model, scene, heaviest)?;
            (step, why.to_owned())
        }
        StepLength::Seconds(given) => {
            let (duration, interval) = (asked.end - asked.start, 1.0 / asked.output_hz);
            let step = Schedule::covering(duration, interval, given)?.step();
            let why = match step < given * (1.0 - SAME_STEP) {
                true => {
                    format!("given: {} s, of which no whole number fills an output interval", significant(given, 3))
                }
                false => "given".to_owned(),
            };
            (step, why)
        }
    };
    let part = ChosenPart {
        what: "largest step",
        chosen: format!("{} s", significant(step, 3)),
        why,
        estimated_error: Some(0.0),
    };
    Ok((step, part))
}

/// The program's own largest step for a model, and why.
///
/// # Errors
/// [`ComputeError::System`] for a model that does not fit the scene.
pub(crate) fn own_step(
    asked: &case::Transient,
    model: &RunModel,
    scene: &Scene,
    heaviest: Option<&(f64, Equilibrium)>,
) -> Result<(f64, &'static str), ComputeError> {
    let system = scene.system(model)?;
    let interval = 1.0 / asked.output_hz;
    let highest = system.highest_squared_frequency().sqrt();
    let mut chosen = match model.method {
        Method::NewmarkExplicit => (
            // half the stability limit, and never above the source's own step
            NEWMARK_STEP.min(1.0 / highest.max(f64::MIN_POSITIVE)),
            "half the stability limit in all modes, at most the source's 1.5e-8 s",
        ),
        Method::ExponentialAdams { .. } => (
            (interval / LEAST_SAMPLES).min(MODE_PHASE / highest.max(f64::MIN_POSITIVE)),
            "four samples an output interval, and 2 rad of the highest mode; halved where the tolerance asks for it",
        ),
        Method::Dop853 { .. } => (
            // what a sensor shows above half its rate would fold into the band
            interval / 16.0,
            "sixteen samples an output interval",
        ),
        _ => (
            resolved(model, scene, &system),
            "0.1 rad of the fastest motion on the contacts at ten times the largest static force",
        ),
    };
    if let Some(stable) = stable_step(model, scene, heaviest, system)
        && stable < chosen.0
    {
        chosen = (
            stable,
            "in longer ones the contacts' small vibrations at rest grow up to the tolerance; halved where the tolerance asks for it",
        );
    }
    if let Some(passing) = travel::longest_step(asked, scene)
        && passing < chosen.0
    {
        chosen = (
            passing,
            "eight while a ball passes the shortest defect or wave at the highest speed; halved where a tolerance asks for it",
        );
    }
    Ok(chosen)
}

/// The longest stable step at rest (s), where the case gives a longer one.
///
/// # Errors
/// [`ComputeError::System`] for a model that does not fit the scene.
pub(crate) fn stable_below(
    asked: &case::Transient,
    model: &RunModel,
    scene: &Scene,
) -> Result<Option<f64>, ComputeError> {
    if asked.step == StepLength::Auto {
        return Ok(None);
    }
    let mut system = scene.system(model)?;
    let rest = scene.at_rest(&system);
    let limit = model.method.step_limit(&mut system, &rest);
    Ok(limit.map(|limit| limit.step_s).filter(|stable| model.step > *stable))
}

/// The step of the exponential method that keeps its `error` below its share of the target, if it is the program's to choose and the step of
/// `model` does not: the error falls with the square of the step, as long as it is above `resolved` times [`SHORTEST`].
pub(crate) fn shorter(
    asked: &case::Transient,
    model: &RunModel,
    error: f64,
    target: f64,
    resolved: f64,
) -> Option<f64> {
    let chosen = asked.step == StepLength::Auto && model.method == Method::Exponential;
    let least = SHORTEST * resolved;
    if !chosen || error <= SHARE * target || model.step <= least {
        return None;
    }
    Some((0.9 * model.step * (SHARE * target / error).sqrt()).max(least))
}

/// The longest step of exponential-adams with a tolerance in which small motions about the equilibrium do not grow: the tolerance refers
/// to the largest force, and would let them; the shorter of those at the start and under the heaviest load. None for other methods.
fn stable_step(
    model: &RunModel,
    scene: &Scene,
    heaviest: Option<&(f64, Equilibrium)>,
    mut system: CoupledSystem,
) -> Option<f64> {
    let Method::ExponentialAdams { tolerance: Some(_) } = model.method else {
        return None;
    };
    let heaviest = heaviest.map(|(t, rest)| system.state_at(*t, rest, &scene.stage.modes));
    let states = [Some(scene.at_rest(&system)), heaviest].into_iter().flatten();
    let limits = states.filter_map(|rest| model.method.step_limit(&mut system, &rest));
    let shortest = limits.map(|limit| limit.step_s).reduce(f64::min)?;
    Some(STABLE * shortest)
}

/// Step that resolves the fastest motion on the contacts, with `k' = 3/2 k^(2/3) F^(1/3)`: that of a ball between both,
/// `h = PHASE / sqrt((k_i' + k_o') / m_b)`, or without the balls' inertia that of race and shaft on both in series.
fn resolved(model: &RunModel, scene: &Scene, system: &CoupledSystem) -> f64 {
    let setup = &scene.setup;
    let largest = scene
        .equilibrium
        .balls
        .iter()
        .map(|ball| ball.inner.max(ball.outer))
        .fold(setup.geometry.ball_mass() * 9.81, f64::max);
    let tangent = |stiffness: f64| 1.5 * stiffness.cbrt().powi(2) * (IMPACT * largest).cbrt();
    let [inner, outer] = [setup.stiffness.inner(), setup.stiffness.outer()].map(tangent);
    let stiffness = match dynamic(model) {
        true => inner + outer,
        false => inner * outer / (inner + outer),
    };
    PHASE / (stiffness * system.contact_mobility()).sqrt()
}
