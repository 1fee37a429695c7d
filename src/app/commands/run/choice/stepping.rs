//! Method and step: what a step jumps over, such as a defect under a ball, no control of its error can see.

use super::model_choice::ChosenPart;
use super::quantities::{IMPACT, RunTask, tangent};
use crate::app::case::{self, StepLength};
use crate::app::error::ComputeError;
use crate::app::scene::{RunModel, Scene};
use crate::bearing::Race;
use crate::numerics::ode::{Method, Schedule};
use crate::report::significant;
use crate::system::{BallsInertia, CoupledSystem, ModeSelection};
use std::f64::consts::TAU;

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
pub(crate) const MODE_PHASE: f64 = 2.0;

/// Least number of steps in an output interval: the displacement of a sensor is differentiated from them, with an error of 3e-4 for
/// four.
pub(crate) const LEAST_SAMPLES: f64 = 4.0;

/// Part of the stable step that is used: contacts at other angles of the balls are a little stiffer.
pub(crate) const STABLE: f64 = 0.9;

/// Step of the other methods: phase of the stiffest ball vibration, rad.
const PHASE: f64 = 0.1;

/// The source's step for explicit Newmark, s (section 4.1).
pub(super) const NEWMARK_STEP: f64 = 1.5e-8;

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
pub(crate) fn method(asked: &case::Transient, target: f64, modes: ModeSelection) -> (Method, ChosenPart) {
    let by_steps = asked.step == StepLength::Auto;
    let adams = |given: Option<f64>| Method::ExponentialAdams {
        tolerance: given.or_else(|| by_steps.then(|| tolerance(target))),
    };
    let method = match asked.method {
        case::Method::Auto if modes == ModeSelection::All => Method::Exponential,
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
    let with = |tolerance: f64| format!("{}, tolerance {}", method.name(), significant(tolerance, 2));
    let (text, estimated_error) = match method {
        Method::ExponentialAdams { tolerance: Some(tolerance) } => {
            (with(tolerance), Some(ADAMS_TARGET * (tolerance / ADAMS_TOLERANCE).powf(ADAMS_ORDER)))
        }
        Method::Dop853 { tolerance, .. } => (with(tolerance), None),
        _ => (method.name().to_owned(), None),
    };
    let part = ChosenPart { what: "method", chosen: text, why, estimated_error };
    (method, part)
}

/// The largest step, or the time between samples: the given one, so much shorter that a whole number fills an output interval, or the program's own.
///
/// # Errors
/// [`ComputeError::System`] for a model that does not fit the scene, [`ComputeError::Transient`] for a step that no run takes.
pub(crate) fn step(task: RunTask<'_>, model: &RunModel) -> Result<(f64, ChosenPart), ComputeError> {
    step_or(task.asked, || own_step(task, model))
}

/// The same with `own` for the program's own.
pub(crate) fn step_or(
    asked: &case::Transient,
    own: impl FnOnce() -> Result<(f64, &'static str), ComputeError>,
) -> Result<(f64, ChosenPart), ComputeError> {
    let (step, why) = match asked.step {
        StepLength::Auto => {
            let (step, why) = own()?;
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
pub(crate) fn own_step(task: RunTask<'_>, model: &RunModel) -> Result<(f64, &'static str), ComputeError> {
    let RunTask { scene, asked, .. } = task;
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
    let limits = [
        (
            stable_step(task, model, system, chosen.0),
            "in longer ones the contacts' small vibrations at rest grow up to the tolerance; halved where the tolerance asks for it",
        ),
        (
            longest_step(asked, scene),
            "eight while a ball passes the shortest defect or wave at the highest speed; halved where a tolerance asks for it",
        ),
    ];
    for (limit, why) in limits {
        if let Some(shorter) = limit.filter(|limit| *limit < chosen.0) {
            chosen = (shorter, why);
        }
    }
    Ok(chosen)
}

/// The longest stable step at rest (s), where the case gives a longer one.
///
/// # Errors
/// [`ComputeError::System`] for a model that does not fit the scene.
pub(crate) fn stable_below(task: RunTask<'_>, model: &RunModel) -> Result<Option<f64>, ComputeError> {
    let scene = task.scene;
    if task.asked.step == StepLength::Auto {
        return Ok(None);
    }
    let mut system = scene.system(model)?;
    let rest = scene.at_rest(&system);
    let limit = model.method.step_limit(&mut system, &rest);
    Ok(limit.map(|limit| limit.step_s).filter(|stable| model.step > *stable))
}

/// The step of the exponential method that keeps its `error` below its share of the target, if it is the program's to choose and the step of
/// `model` does not: the error falls with the square of the step, as long as it is above `resolved` times [`SHORTEST`].
pub(crate) fn shorter(task: RunTask<'_>, model: &RunModel, error: f64, resolved: f64) -> Option<f64> {
    let target = task.target;
    let chosen = task.asked.step == StepLength::Auto && model.method == Method::Exponential;
    let least = SHORTEST * resolved;
    if !chosen || error <= SHARE * target || model.step <= least {
        return None;
    }
    Some((0.9 * model.step * (SHARE * target / error).sqrt()).max(least))
}

/// The longest step of exponential-adams with a tolerance in which small motions about the equilibrium do not grow: the tolerance refers
/// to the largest force, and would let them; the shorter of those at the start and under the heaviest load. None for other methods, and where
/// it is not below `longest` (s).
fn stable_step(task: RunTask<'_>, model: &RunModel, mut system: CoupledSystem, longest: f64) -> Option<f64> {
    let RunTask { scene, heaviest, .. } = task;
    let Method::ExponentialAdams { tolerance: Some(_) } = model.method else {
        return None;
    };
    let heaviest = heaviest.map(|(t, rest)| system.state_at(*t, rest, &scene.stage.modes));
    let states = [Some(scene.at_rest(&system)), heaviest].into_iter().flatten();
    let limits = states.filter_map(|rest| model.method.step_limit_below(&mut system, &rest, longest / STABLE));
    let shortest = limits.map(|limit| limit.step_s).reduce(f64::min)?;
    Some(STABLE * shortest)
}

/// Step that resolves the fastest motion on the contacts, with `k' = 3/2 k^(2/3) F^(1/3)`: that of a ball between both,
/// `h = PHASE / sqrt((k_i' + k_o') / m_b)`, or without the balls' inertia that of race and shaft on both in series.
fn resolved(model: &RunModel, scene: &Scene, system: &CoupledSystem) -> f64 {
    let setup = &scene.setup;
    let forces = scene.equilibrium.balls.iter().map(|ball| ball.inner.max(ball.outer));
    let largest = forces.fold(setup.geometry.ball_mass() * 9.81, f64::max);
    let [inner, outer] = [setup.stiffness.inner(), setup.stiffness.outer()].map(|k| tangent(k, IMPACT * largest));
    let stiffness = match model.balls_inertia {
        BallsInertia::Dynamic => inner + outer,
        BallsInertia::QuasiStatic => inner * outer / (inner + outer),
    };
    PHASE / (stiffness * system.contact_mobility()).sqrt()
}

/// Steps in which a ball passes a defect from end to end, or a wave from crest to crest.
pub(crate) const STEPS_PER_PASS: f64 = 8.0;

/// The longest step (s) that takes no ball over too much of a defect, flat or wave, at the highest speed of the run; `None` if
/// there is none or nothing turns.
fn longest_step(asked: &case::Transient, scene: &Scene) -> Option<f64> {
    let setup = &scene.setup;
    let orders = setup.geometry.orders();
    let shaft = setup.cage.shaft().fastest(asked.start, asked.end);
    let [least_slip, most_slip] = setup.cage.slip.range();
    // of a ball along the race, rad/s; as seen from the inner race it is the faster the more the cage slips
    let along = |race: Race| match race {
        Race::Outer => shaft * orders.cage * (1.0 - least_slip),
        Race::Inner => shaft * (1.0 - orders.cage * (1.0 - most_slip)),
    };
    let defects = setup.race_defects.iter();
    let defects = defects.map(|defect| 2.0 * defect.contact_half_angle() / along(defect.race()));
    let flats = setup.flats.iter().flat_map(|flat| {
        let spin = shaft * orders.ball_spin;
        [Race::Inner, Race::Outer].map(|race| 2.0 * flat.shape.contact_half_angle(race) / spin)
    });
    let waves = setup.waves.iter();
    let waves = waves.map(|wave| TAU / f64::from(wave.order) / along(wave.race));
    let shortest = defects.chain(flats).chain(waves).fold(f64::INFINITY, f64::min);
    (shortest > 0.0 && shortest.is_finite()).then_some(shortest / STEPS_PER_PASS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::case::Case;
    use crate::bearing::defect::reduced;
    use crate::numerics::Unwatched;

    /// Five milliseconds of a shipped case at 30 Hz.
    fn case(name: &str, keys: &[&str]) -> (Case, Scene) {
        let steady =
            ["speed.profile=[{time=0,hz=30}]", "transient.start=0", "transient.end=5e-3", "analysis.envelope=[]"];
        let case = Case::example(name, &[&steady, keys].concat());
        let scene = Scene::build(case.for_run().unwrap(), &Unwatched).unwrap();
        (case, scene)
    }

    fn longest((case, scene): &(Case, Scene)) -> Option<f64> {
        longest_step(case.transient.as_ref().unwrap(), scene)
    }

    /// How many steps see ball 0 on what turns past it, while it passes once.
    fn seen(step: f64, on: impl Fn(f64) -> bool) -> usize {
        let seen: Vec<bool> = (0..).map(|k| on(f64::from(k) * step)).take(200_000).collect();
        let begins = (1..seen.len()).find(|&k| seen[k] && !seen[k - 1]).unwrap();
        seen[begins..].iter().take_while(|&&on| on).count()
    }

    #[test]
    fn a_ball_is_seen_on_every_defect_in_eight_steps() {
        for (name, slip) in [
            ("tadina2011/outer-dent", "0"),
            ("tadina2011/inner-dent", "0"),
            ("tadina2011/inner-dent", "0.2"),
            ("tadina2011/outer-dent", "0.2"),
        ] {
            let slipping = format!("bearing.slip={slip}");
            let scene = case(name, &[&slipping]);
            let step = longest(&scene).unwrap();
            let setup = &scene.1.setup;
            let defect = &setup.race_defects[0];
            let count = seen(step, |t| {
                let turned = match defect.race() {
                    Race::Outer => 0.0,
                    Race::Inner => setup.cage.shaft().angle(t),
                };
                let angle = setup.cage.motion(t).angle - turned;
                defect.contains(reduced(angle))
            });
            // one more or less by where the first one falls
            assert!((7..=9).contains(&count), "{name}, slip {slip}: {count}");
        }
        let scene = case("tadina2011/ball-flat", &[]);
        let step = longest(&scene).unwrap();
        let flat = &scene.1.setup.flats[0];
        let counts = [Race::Inner, Race::Outer].map(|race| {
            seen(step, |t| {
                let setup = &scene.1.setup;
                let (_, angle) = setup.spin(flat.ball, setup.cage.shaft().angle(t)).unwrap();
                flat.shape.contains(race, reduced(angle))
            })
        });
        assert!(counts.into_iter().min().is_some_and(|least| (7..=9).contains(&least)), "{counts:?}");
    }

    #[test]
    fn a_wave_passes_in_eight_steps_and_a_plain_race_has_no_limit() {
        let plain = case("tadina2011/healthy", &[]);
        assert_eq!(longest(&plain), None);
        let wave = "bearing.waviness=[{on='inner',order=40,amplitude=1e-8}]";
        let waved = case("tadina2011/healthy", &[wave]);
        // 0.6331 turns of the shaft a turn of it against the cage: 30 Hz * 0.6331 * 40 crests
        let expected = 1.0 / (30.0 * 0.633_145 * 40.0 * 8.0);
        let found = longest(&waved).unwrap();
        assert!((found / expected - 1.0).abs() < 1e-5, "{found}");
        let standing = case("tadina2011/healthy", &[wave, "speed.profile=[{time=0,hz=0}]"]);
        assert_eq!(longest(&standing), None);
    }
}
