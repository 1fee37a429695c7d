//! The error of steps and modes, measured on a short stretch before the run.
//!
//! The stretch begins at rest at the highest speed, a ball just before the first defect. A second one, three times as long, begins
//! where the loads begin to change fastest, or near the end of that change. Both are stepped as the run will be, and by a [`finer`] model:
//! four times the modes with the static residual of the others, a tenth of the tolerance, half the steps that such a model would choose. With an
//! error that falls as `tolerance^p` the two differ by `1 - 10^-p` of it. Equal steps of the exponential method are halved: its error falls with the
//! square of the step where contacts are smooth, and with the step at least. A method without a tolerance is measured by one with it.

use super::model_choice::Measured;
use super::perturbation::perturb;
use super::quantities::{Asked, RunTask, fastest_change};
use super::stepping::{self, ADAMS_ORDER};
use crate::app::case;
use crate::app::commands::run::{InMemory, RunEnd, Simulation, Span};
use crate::app::error::ComputeError;
use crate::app::scene::{RunModel, Scene};
use crate::bearing::defect::RaceDefect;
use crate::bearing::{Cage, Race};
use crate::numerics::ode::Method;
use crate::numerics::series::TimeSeries;
use crate::report::significant;
use crate::signal::{band_limit_from_rest, relative_difference};
use crate::system::{Equilibrium, Formulation, ModeSelection, StaticCondition};

/// A scene that is stepped from rest at any instant.
pub(crate) trait Stepped: Sync {
    /// The simulation of a stretch that begins (s) at rest, in a state that is perturbed by a part of itself.
    ///
    /// # Errors
    /// [`ComputeError`] where nothing rests then, or for a model that does not fit.
    fn stepped_from_rest(&self, model: &RunModel, span: Span, from: [f64; 2]) -> Result<Simulation, ComputeError>;

    /// An instant (s) of the highest speed that leaves `spare` seconds of the run before it at most, just before a ball strikes.
    fn before_a_strike(&self, asked: &case::Transient, spare: f64) -> f64;

    /// Between which instants (s) the loads change fastest; `None` where they do not change.
    fn fastest_change(&self, asked: &case::Transient) -> Option<[f64; 2]>;
}

impl Stepped for Scene {
    fn stepped_from_rest(
        &self,
        model: &RunModel,
        span: Span,
        [begin, perturbation]: [f64; 2],
    ) -> Result<Simulation, ComputeError> {
        let condition = StaticCondition::at(&self.setup, begin);
        let rest = Equilibrium::find(&self.stage.structure, &self.setup, condition)?;
        let system = self.system(model)?;
        let mut state = system.state_at(begin, &rest, &self.stage.modes);
        perturb(&mut state, perturbation, 1, 0);
        Simulation::kept(system, state, model, span, false, &mut InMemory, |_| ())
    }

    fn before_a_strike(&self, asked: &case::Transient, spare: f64) -> f64 {
        begin(asked, self, spare)
    }

    fn fastest_change(&self, asked: &case::Transient) -> Option<[f64; 2]> {
        fastest_change(asked, self)
    }
}

/// Length of the stretch, s and in periods of the band's highest frequency: the filter to the band needs 26.
const LEAST_S: f64 = 2e-3;
const LEAST_PERIODS: f64 = 30.0;

/// Most steps of a stretch: some ten minutes. Heavily damped contacts in low bands take a million, a shaft of a picogram would take hours.
const MOST_STEPS: f64 = 1e8;

/// How much smaller the second tolerance is, and how much shorter its steps.
pub(crate) const FINER: f64 = 0.1;
pub(crate) const SHORTER: f64 = 0.5;

/// How many times as long the stretch of a change of load is.
const AFTER: f64 = 3.0;

/// How many times the modes the second one has.
pub(crate) const MORE: usize = 4;

/// Instants in the length of the stretch at which the error since the start is looked at.
const INSTANTS: u32 = 8;

/// Steps of half a first stretch: parts of a long one, of which that with the largest error counts. Contacts that nothing damps take half
/// of a stretch until their vibration has grown to the tolerance.
const PARTS: f64 = 2.0;

/// How much longer than the first stretch a run is looked at where no ball strikes: errors of steps add up there.
pub(crate) const LONG: f64 = 10.0;

/// What the error is taken for where no ball strikes, in units of what the stretch showed. The finer run errs as well: of some 90 preloaded bearings that nobody
/// had looked at, one erred by 1.04 times its estimate and three by 0.83 to 0.97 times.
pub(crate) const SAFETY: f64 = 1.5;

/// The error of `model` on a stretch, and on a second one where loads change. It is that of steps and modes, and of balls without inertia where `finer` has
/// them with it. Where balls strike it is that of a short stretch as a whole. Else the stretch is [`LONG`], and its worst part and its worst beginning count.
///
/// # Errors
/// Why a stretch says nothing.
pub(crate) fn measured(
    scene: &impl Stepped,
    Asked { transient: asked, band_hz, strikes }: Asked<'_>,
    model: &RunModel,
    finer: RunModel,
) -> Result<Measured, String> {
    let (first_s, run_s) = (stretch_s(asked, band_hz), asked.end - asked.start);
    let length_s = if strikes { first_s } else { (LONG * first_s).min(run_s) };
    let from_s =
        if strikes { scene.before_a_strike(asked, run_s - length_s) } else { long_begin(asked, scene, length_s) };
    let change = scene.fastest_change(asked).map(|[from, to]| {
        let latest = asked.start + run_s - first_s;
        let begin = from.max(to - first_s).min(latest);
        (begin, (AFTER * first_s).min(asked.end - begin))
    });
    let (mut most, mut rms) = (0.0_f64, 0.0_f64);
    for (begin, duration) in [Some((from_s, length_s)), change].into_iter().flatten() {
        let span = Span { duration, output_hz: asked.output_hz };
        let [run, finer] = compared(scene, [model, &finer], span, begin, band_hz)?;
        for (run, finer) in run.iter().zip(&finer) {
            let error = relative_difference(run, finer).map_err(|error| error.to_string())?;
            most = most.max(error);
            rms = rms.max(finer.rms());
            if !strikes {
                most = most.max(worst_part(run, finer, first_s));
            }
        }
    }
    let left = match model.method {
        Method::Exponential => SHORTER,
        Method::ExponentialAdams { tolerance: Some(_) } => FINER.powf(ADAMS_ORDER),
        _ => 0.0,
    };
    let safety = if strikes { 1.0 } else { SAFETY };
    Ok(Measured { error: safety * most / (1.0 - left), from_s, length_s, rms, finer })
}

/// What of a measured error the steps make, by a stretch beside the run's own modes; `None` where the finer model differed in other things too.
pub(crate) fn of_steps(task: RunTask<'_>, model: &RunModel, found: &Measured, strikes: bool) -> Option<f64> {
    let finer = RunModel { modes: model.modes, residual: model.residual, ..found.finer };
    let alike = model.balls_inertia == finer.balls_inertia && model.modes != found.finer.modes;
    let measured = alike.then(|| measured(task.scene, task.stretch(strikes), model, finer))?;
    measured.ok().map(|own| own.error)
}

/// The largest difference of two series in a part of `first_s / PARTS` relative to the size of the whole second one, or since the start up to the
/// end of such a part relative to the size until there, from `first_s` (s) on.
fn worst_part(run: &TimeSeries, finer: &TimeSeries, first_s: f64) -> f64 {
    let length = ((first_s / PARTS / run.step_s()) as usize).max(1);
    let size = finer.rms();
    let (mut most, mut apart, mut so_far) = (0.0_f64, 0.0, 0.0);
    let parts = run.values().chunks_exact(length);
    for (number, (run, finer)) in parts.zip(finer.values().chunks_exact(length)).enumerate() {
        let differences = run.iter().zip(finer).map(|(a, b)| (a - b) * (a - b));
        let part: f64 = differences.sum();
        apart += part;
        so_far += finer.iter().map(|b| b * b).sum::<f64>();
        most = most.max((part / length as f64).sqrt() / size);
        if (number + 1) as f64 >= PARTS && so_far > 0.0 {
            most = most.max((apart / so_far).sqrt());
        }
    }
    most
}

/// Begin of a long stretch: that of the run where the stretch is as long, else where a shorter one begins.
pub(crate) fn long_begin(asked: &case::Transient, scene: &impl Stepped, length_s: f64) -> f64 {
    match asked.end - asked.start - length_s {
        spare if spare > 0.0 => scene.before_a_strike(asked, spare),
        _ => asked.start,
    }
}

/// Length of the first stretch, s.
pub(crate) fn stretch_s(asked: &case::Transient, band_hz: f64) -> f64 {
    let least = LEAST_S.max(LEAST_PERIODS / band_hz);
    least.min(asked.end - asked.start)
}

/// The model that another is measured by; `None` for the printed equations, which take one method alone.
///
/// # Errors
/// [`ComputeError::System`] for a model that does not fit the scene.
pub(crate) fn finer(task: RunTask<'_>, model: &RunModel) -> Result<Option<RunModel>, ComputeError> {
    let scene = task.scene;
    if scene.setup.formulation == Formulation::Printed {
        return Ok(None);
    }
    let (method, as_the_model) = match (model.method, model.modes) {
        (Method::ExponentialAdams { tolerance: Some(tolerance) }, _) => (stepping::adams(FINER * tolerance), true),
        (Method::Exponential, _) => (Method::Exponential, true),
        (_, ModeSelection::All) => (Method::Exponential, false),
        _ => (stepping::adams(FINER * stepping::tolerance(task.target)), false),
    };
    let count = scene.stage.modes.count();
    let mut finer = RunModel {
        modes: match model.modes {
            ModeSelection::Count(modes) => ModeSelection::Count((MORE * modes).min(count)),
            all => all,
        },
        residual: true,
        method,
        ..*model
    };
    // what of the steps the tolerance does not govern follows the added modes
    if !(as_the_model && method == Method::Exponential) {
        let (step, _) = stepping::own_step(task, &finer)?;
        finer.step = if as_the_model { step.min(model.step) } else { step };
    }
    finer.step *= SHORTER;
    Ok(Some(finer))
}

/// The sensors' signals in the band by two models, over a stretch that begins at rest, stepped side by side.
///
/// # Errors
/// Why one of them cannot be stepped.
pub(crate) fn compared(
    scene: &impl Stepped,
    [model, finer]: [&RunModel; 2],
    span: Span,
    begin: f64,
    band_hz: f64,
) -> Result<[Vec<TimeSeries>; 2], String> {
    let steps = span.duration / finer.step;
    if steps > MOST_STEPS {
        return Err(format!("it would take {} steps", significant(steps, 2)));
    }
    let signals = |model: &RunModel| stretch(scene, model, span, [begin, 0.0], band_hz);
    let (run, finer) = rayon::join(|| signals(model), || signals(finer));
    Ok([run?, finer?])
}

/// The last instant at which no sensor's difference since the start is above `most`, relative, before one is for good, s; infinite where
/// none is. It is looked at every eighth of `first_s` (s), and counts from `first_s` on: a short beginning may be nearly still.
pub(crate) fn held_s([run, finer]: &[Vec<TimeSeries>; 2], most: f64, first_s: f64) -> f64 {
    let instant = |number: u32| f64::from(number) * first_s / f64::from(INSTANTS);
    let of_sensor = |(run, finer): (&TimeSeries, &TimeSeries)| {
        let (mut apart, mut size) = (0.0, 0.0);
        let (mut next, mut held) = (1, 0.0);
        for (number, (a, b)) in (1..).zip(run.values().iter().zip(finer.values())) {
            apart += (a - b) * (a - b);
            size += b * b;
            // half a sample for round-off
            if (f64::from(number) + 0.5) * run.step_s() < instant(next) {
                continue;
            }
            if apart <= most * most * size {
                held = instant(next);
            } else if next >= INSTANTS {
                return held;
            }
            next += 1;
        }
        f64::INFINITY
    };
    let sensors = run.iter().zip(finer).map(of_sensor);
    sensors.fold(f64::INFINITY, f64::min)
}

/// The largest of the sensors' differences since the start at any of the instants between two times (s), relative.
pub(crate) fn worst_since([run, finer]: &[Vec<TimeSeries>; 2], [from_s, to_s]: [f64; 2]) -> f64 {
    let of_sensor = |(run, finer): (&TimeSeries, &TimeSeries)| {
        let (mut apart, mut size, mut most) = (0.0, 0.0, 0.0_f64);
        for (number, (a, b)) in (1..).zip(run.values().iter().zip(finer.values())) {
            // half a sample for round-off
            let time_s = (f64::from(number) + 0.5) * run.step_s();
            if time_s > to_s + run.step_s() {
                break;
            }
            apart += (a - b) * (a - b);
            size += b * b;
            if time_s >= from_s && size > 0.0 {
                most = most.max((apart / size).sqrt());
            }
        }
        most
    };
    run.iter().zip(finer).map(of_sensor).fold(0.0, f64::max)
}

/// The sensors' signals in the band over a stretch that begins (s) at rest, but for a relative perturbation.
pub(crate) fn stretch(
    scene: &impl Stepped,
    model: &RunModel,
    span: Span,
    from: [f64; 2],
    band_hz: f64,
) -> Result<Vec<TimeSeries>, String> {
    let run = scene.stepped_from_rest(model, span, from).map_err(|error| error.to_string())?;
    if let RunEnd::BlewUp(error) = &run.end {
        return Err(error.to_string());
    }
    let sensors = 0..run.record.sensors.len();
    let signals = sensors.map(|sensor| {
        let signal = run.signal(sensor).map_err(|error| error.to_string())?;
        // a band that the sampling or the length of the stretch does not let out is not cut
        Ok(band_limit_from_rest(&signal, band_hz).unwrap_or(signal))
    });
    signals.collect()
}

/// The instant of the shaft's highest speed among those of the run that leave the stretch, and from there the time to the next impact.
pub(crate) fn begin(asked: &case::Transient, scene: &Scene, spare: f64) -> f64 {
    let setup = &scene.setup;
    let fastest = setup.cage.shaft().fastest_instant(asked.start, asked.start + spare);
    match next_strike(scene, fastest) {
        Some((until, _)) if until <= spare - (fastest - asked.start) => fastest + until,
        _ => fastest,
    }
}

/// In how many seconds from an instant (s) on the next ball comes to the edge of the first defect of a race, and in how many one that is
/// in it leaves it. `None` without such a defect, or where balls do not pass it.
pub(crate) fn next_strike(scene: &Scene, at: f64) -> Option<(f64, Option<f64>)> {
    let setup = &scene.setup;
    next_on(setup.race_defects.first()?, &setup.cage, setup.geometry.orders().cage, at)
}

/// The same of a defect and the balls of a cage of this order without slip.
pub(crate) fn next_on(defect: &RaceDefect, cage: &Cage, cage_order: f64, at: f64) -> Option<(f64, Option<f64>)> {
    let motion = cage.motion(at);
    // where the defect is, and how fast balls pass it
    let (turned, passing) = match defect.race() {
        Race::Outer => (0.0, motion.speed),
        Race::Inner => (cage.shaft().angle(at), motion.speed - motion.speed / cage_order),
    };
    let ahead = (defect.angle() + turned - motion.angle) * passing.signum();
    let half = 1.5 * defect.contact_half_angle();
    let edge = (ahead - half).rem_euclid(cage.spacing);
    let left = Some(edge + 2.0 * half - cage.spacing).filter(|left| *left > 0.0);
    (passing != 0.0).then(|| (edge / passing.abs(), left.map(|left| left / passing.abs())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::case::Case;
    use crate::app::commands::run::choice::ModelChoice;
    use crate::numerics::Unwatched;

    fn with_tolerance(example: &str, tolerance: f64, set: &[&str]) -> (f64, f64) {
        let case = Case::example(example, set);
        let run = case.for_run().unwrap();
        let asked = run.transient;
        let scene = Scene::build(run, &Unwatched).unwrap();
        let choice = ModelChoice::of_case(run, &scene).unwrap();
        let model = RunModel { method: Method::ExponentialAdams { tolerance: Some(tolerance) }, ..choice.model };
        let begin = begin(asked, &scene, asked.end - asked.start - LEAST_S);
        let task = RunTask { scene: &scene, asked, band_hz: 40e3, target: 1e-2, heaviest: None };
        let finer = finer(task, &model).unwrap();
        let measured = measured(&scene, task.stretch(true), &model, finer.unwrap());
        (measured.unwrap().error, begin)
    }

    #[test]
    fn a_rougher_tolerance_has_a_larger_error() {
        let [rough, fine] = [1e-1, 1e-5].map(|tolerance| {
            let measured = with_tolerance("scenes/impact", tolerance, &[]);
            measured.0
        });
        // found 7.1e-4 and 6.0e-4: most of both is the modes'
        assert!(rough > 1.1 * fine, "{rough} {fine}");
        assert!(fine < 1e-2, "{fine}");
    }

    #[test]
    fn the_stretch_begins_before_an_impact_at_the_highest_speed() {
        let (_, begin) = with_tolerance("tadina2011/outer-dent", 1e-3, &[]);
        let case = Case::example("tadina2011/outer-dent", &[]);
        let scene = Scene::build(case.for_run().unwrap(), &Unwatched).unwrap();
        let (cage, defect) = (scene.setup.cage.motion(begin), &scene.setup.race_defects[0]);
        let ahead = (defect.angle() - cage.angle).rem_euclid(scene.setup.cage.spacing);
        let edge = ahead / defect.contact_half_angle();
        assert!((edge - 1.5).abs() < 0.5, "{edge}");
        assert!(cage.speed > 0.9 * scene.setup.cage.motion(case.transient.as_ref().unwrap().end).speed);
    }
}
