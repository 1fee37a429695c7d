//! The model of a shaft in several bearings, or in one that carries axial load: its modes by comparison.
//!
//! The linear estimates of the bearing in its plane know radial contacts alone. Here a stretch is stepped with some modes and with four times
//! as many, and with static vectors that lack a sixteenth as much, until both agree within the target.

use super::model_choice::{ChosenPart, ModelChoice};
use super::perturbation::perturb;
use super::pilot::{self, Stepped};
use super::plan::{IMPACTS_GROWTH, together, vectors};
use super::quantities::{Asked, IMPACT, USUAL_BAND, tangent};
use super::stepping::{self, step_or};
use crate::app::case::{self, Case, ModesKept, StepLength};
use crate::app::commands::run::{InMemory, Simulation, Span};
use crate::app::error::ComputeError;
use crate::app::scene::structure::{LEFT_OUT_SHARE, complete_for};
use crate::app::scene::{MachineScene, RunModel};
use crate::bearing::Race;
use crate::bearing::kinematics::DefectOrders;
use crate::bearing::spatial::SpatialBearing;
use crate::numerics::ode::Method;
use crate::report::significant;
use crate::signal::relative_difference;
use crate::system::{BallsInertia, BearingInPlace, ModeSelection};
use std::f64::consts::TAU;

/// The modes that are tried first: up to so many times the band, and at least so many.
const BEGIN: f64 = 1.5;
const FEWEST: usize = 12;

/// Part of the target that modes and steps may take, as the stretch shows them.
const SHARE: f64 = 0.8;

/// Phase of a ball between both races in the largest step, rad.
const BALL_PHASE: f64 = 0.5;

impl Stepped for MachineScene {
    fn stepped_from_rest(
        &self,
        model: &RunModel,
        span: Span,
        [begin, perturbation]: [f64; 2],
    ) -> Result<Simulation, ComputeError> {
        let (system, mut state) = self.at_rest(model, begin)?;
        perturb(&mut state, perturbation, 1, 0);
        Simulation::kept(system, state, model, span, false, &mut InMemory, |_| ())
    }

    fn before_a_strike(&self, asked: &case::Transient, spare: f64) -> f64 {
        let shaft = self.setup.bearings[0].cage.shaft();
        let fastest = shaft.fastest_instant(asked.start, asked.start + spare);
        let bearings = self.setup.bearings.iter().zip(&self.orders);
        let strikes = bearings.filter_map(|(own, orders)| {
            let defect = own.bearing.defects().first()?;
            pilot::next_on(defect.profile(), &own.cage, orders.cage, fastest)
        });
        let until = strikes.map(|(until, _)| until).fold(f64::INFINITY, f64::min);
        if until <= spare - (fastest - asked.start) { fastest + until } else { fastest }
    }

    fn fastest_change(&self, asked: &case::Transient) -> Option<[f64; 2]> {
        let loads = &self.setup.shaft.loads;
        let mut instants: Vec<f64> = loads
            .iter()
            .flat_map(|load| {
                let first = load.profile.next_knot(asked.start);
                std::iter::successors(Some(first), |t| Some(load.profile.next_knot(*t))).take_while(|t| *t < asked.end)
            })
            .chain([asked.start, asked.end])
            .collect();
        instants.sort_by(f64::total_cmp);
        let rate = |ends: &[f64]| {
            let changes = loads.iter().map(|load| {
                let [a, b] = [ends[0], ends[1]].map(|t| load.profile.at(t));
                (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt()
            });
            changes.sum::<f64>() / (ends[1] - ends[0])
        };
        let pairs = instants.windows(2).filter(|ends| ends[1] > ends[0]);
        let fastest = pairs.map(|ends| ([ends[0], ends[1]], rate(ends))).max_by(|(_, a), (_, b)| a.total_cmp(b))?;
        (fastest.1 > 0.0).then_some(fastest.0)
    }
}

/// Ball passes of the slowest bearing in a stretch that is compared with a sound one, and the longest such stretch, s.
const PASSES: f64 = 1.5;
const LONGEST_PASS: f64 = 0.1;

impl MachineScene {
    /// Of each bearing what its damage adds to a stretch of the signals in the band, over the RMS without it, the largest sensor's: zero of
    /// a sound one. `None` where a stretch cannot be stepped, or is too short for a ball to come to the damage.
    pub(crate) fn damage_shown(&self, case: &Case, asked: &case::Transient, model: &RunModel) -> Vec<Option<f64>> {
        let band_hz = case.band_hz().map_or(USUAL_BAND, |band| band[1]);
        let run_s = asked.end - asked.start;
        let pass = |(own, orders): (&BearingInPlace, &DefectOrders)| {
            let shaft = own.cage.shaft().fastest(asked.start, asked.end) / TAU;
            1.0 / (shaft * orders.outer.min(orders.inner))
        };
        let needed = PASSES * self.setup.bearings.iter().zip(&self.orders).map(pass).fold(0.0, f64::max);
        let length = needed.max(pilot::stretch_s(asked, band_hz)).min(run_s);
        let begin = self.before_a_strike(asked, run_s - length);
        let span = Span { duration: length, output_hz: asked.output_hz };
        let signals = |scene: &Self| pilot::stretch(scene, model, span, [begin, 0.0], band_hz).ok();
        let is_long = needed <= LONGEST_PASS && needed <= run_s;
        let with = (self.setup.has_defects() && is_long).then(|| signals(self)).flatten();
        let share = |bearing: usize| {
            let without = signals(&self.without_damage(bearing))?;
            let pairs = with.as_ref()?.iter().zip(&without);
            pairs.filter_map(|(with, without)| relative_difference(with, without).ok()).reduce(f64::max)
        };
        let bearings = self.setup.bearings.iter().enumerate();
        let of_bearing = |(index, own): (usize, &BearingInPlace)| {
            if own.bearing.defects().is_empty() { Some(0.0) } else { share(index) }
        };
        bearings.map(of_bearing).collect()
    }
}

impl ModelChoice {
    /// The model of a case in space: what it asks for, and the program's choice where it leaves one.
    ///
    /// # Errors
    /// [`ComputeError`] for a model that does not fit the scene.
    pub(crate) fn in_space(case: &Case, asked: &case::Transient, scene: &MachineScene) -> Result<Self, ComputeError> {
        let band_hz = case.band_hz().map_or(USUAL_BAND, |band| band[1]);
        let target = case.target();
        let growth = growth(scene);
        let stretch = Asked { transient: asked, band_hz, strikes: growth > 1.0 };
        let known = scene.stage.modes.count();
        let mut kept = match asked.modes {
            ModesKept::All => known,
            // the source integrates all displacements
            ModesKept::Auto if asked.method == case::Method::NewmarkExplicit => known,
            ModesKept::Count(count) => count.min(known),
            ModesKept::Auto => {
                let modes = &scene.stage.modes;
                (0..known).filter(|mode| modes.frequency_hz(*mode) <= BEGIN * band_hz).count().max(FEWEST).min(known)
            }
        };
        let planned = |kept: usize| -> Result<(RunModel, ChosenPart, ChosenPart), ComputeError> {
            let modes = if asked.modes == ModesKept::All { ModeSelection::All } else { ModeSelection::Count(kept) };
            let (method, method_part) = stepping::method(asked, target, modes);
            let mut model =
                RunModel { modes, residual: asked.residual, balls_inertia: BallsInertia::Dynamic, method, step: 0.0 };
            let (step, step_part) = step_or(asked, || Ok(own_step(asked, scene, &model)))?;
            model.step = step;
            Ok((model, method_part, step_part))
        };
        let measured = |model: &RunModel| pilot::measured(scene, stretch, model, finer(asked, scene, model, target));
        let (mut model, mut method_part, step_part) = planned(kept)?;
        let mut found = measured(&model);
        while asked.modes == ModesKept::Auto
            && kept < known
            && found.as_ref().is_ok_and(|found| found.error > SHARE * target)
        {
            kept = (2 * kept).min(known);
            model = planned(kept)?.0;
            found = measured(&model);
        }
        match &found {
            Ok(found) => method_part.estimated_error = Some(found.error),
            Err(why) => {
                method_part.estimated_error = None;
                method_part.why += &format!("; its error could not be measured before the run: {why}");
            }
        }
        let mut parts = vec![modes_part(asked, scene, &model, band_hz), method_part, step_part];
        parts.extend(vectors(case, &scene.stage, band_hz));
        let estimated_error = together(&mut parts, growth);
        let given = asked.step != StepLength::Auto;
        let stable_s = given.then(|| step_limit(scene, &model)).flatten().filter(|stable| model.step > *stable);
        Ok(Self {
            model,
            estimated_error,
            complete_for_hz: complete_for(band_hz, LEFT_OUT_SHARE * target / growth),
            growth,
            measured: found.ok(),
            stable_s,
            target,
            parts,
        })
    }
}

fn modes_part(asked: &case::Transient, scene: &MachineScene, model: &RunModel, band_hz: f64) -> ChosenPart {
    let (all, modes) = (scene.stage.structure.dof(), &scene.stage.modes);
    let kept = model.modes.count(modes);
    let highest = modes.frequency_hz(kept.saturating_sub(1));
    let vectors = scene.basis(model).map_or(0, |basis| basis.count() - kept);
    let others = match vectors {
        0 => String::new(),
        vectors => format!(", and {vectors} vectors of the others' static response under the balls"),
    };
    let why = match asked.modes {
        ModesKept::Auto if asked.method == case::Method::NewmarkExplicit => {
            "the source's method steps all displacements".to_owned()
        }
        ModesKept::Auto => format!(
            "as many as a stretch with four times their number needs to agree within {} of the target, in the band up to {} kHz; the error of the method has their part",
            significant(SHARE, 2),
            significant(band_hz / 1e3, 4)
        ),
        ModesKept::All | ModesKept::Count(_) => "given; the error of the method has their part".to_owned(),
    };
    ChosenPart {
        what: "modes",
        chosen: format!("{kept} of {all}, up to {} kHz{others}", significant(highest / 1e3, 4)),
        why,
        // the stretch that measures the method has it
        estimated_error: Some(0.0),
    }
}

/// The model that another is measured by: four times the modes, a tenth of the tolerance, half the step.
fn finer(asked: &case::Transient, scene: &MachineScene, model: &RunModel, target: f64) -> RunModel {
    let known = scene.stage.modes.count();
    let modes = match model.modes {
        ModeSelection::Count(modes) => ModeSelection::Count((pilot::MORE * modes).min(known)),
        all => all,
    };
    let method = match model.method {
        Method::ExponentialAdams { tolerance: Some(tolerance) } => stepping::adams(pilot::FINER * tolerance),
        Method::Exponential => Method::Exponential,
        _ => stepping::adams(pilot::FINER * stepping::tolerance(target)),
    };
    let finer = RunModel { modes, method, ..*model };
    let own = RunModel { step: own_step(asked, scene, &finer).0, ..finer };
    RunModel { step: pilot::SHORTER * own.step.min(model.step), ..own }
}

/// The program's own largest step, and why.
fn own_step(asked: &case::Transient, scene: &MachineScene, model: &RunModel) -> (f64, &'static str) {
    let interval = 1.0 / asked.output_hz;
    let basis = scene.basis(model);
    let highest = basis.map_or(0.0, |basis| TAU * basis.frequency_hz(basis.count().saturating_sub(1)));
    let balls = scene.setup.bearings.iter().zip(&scene.equilibrium.bearings);
    let balls = balls.map(|(own, balls)| {
        let largest = balls.iter().fold(0.0_f64, |most, ball| most.max(ball.load[0].max(ball.load[1])));
        fastest_ball(&own.bearing, largest)
    });
    let ball = BALL_PHASE / balls.fold(f64::MIN_POSITIVE, f64::max);
    let mut limits = match model.method {
        Method::Dop853 { .. } => vec![(interval / 16.0, "sixteen samples an output interval")],
        Method::ExponentialAdams { .. } => vec![
            (
                interval / stepping::LEAST_SAMPLES,
                "four samples an output interval; halved where the tolerance asks for it",
            ),
            (
                stepping::MODE_PHASE / highest.max(f64::MIN_POSITIVE),
                "2 rad of the highest mode; halved where the tolerance asks for it",
            ),
            (ball, "half a radian of a ball between its races at ten times the largest load at rest"),
        ],
        Method::NewmarkExplicit => vec![(
            stepping::NEWMARK_STEP.min(1.0 / highest.max(f64::MIN_POSITIVE)),
            "half the stability limit in all modes, at most the source's 1.5e-8 s",
        )],
        _ => vec![
            (interval / stepping::LEAST_SAMPLES, "four samples an output interval"),
            (0.2 * ball, "a tenth of a radian of a ball between its races at ten times the largest load at rest"),
        ],
    };
    limits.extend(shortest_pass(asked, scene).map(|pass| {
        let why =
            "eight while a ball passes the shortest defect at the highest speed; halved where a tolerance asks for it";
        (pass / stepping::STEPS_PER_PASS, why)
    }));
    limits.extend(stable_step(scene, model).map(|step| {
        (step, "in longer ones the contacts' small vibrations at rest grow up to the tolerance; halved where the tolerance asks for it")
    }));
    let shortest = limits.into_iter().min_by(|(a, _), (b, _)| a.total_cmp(b));
    shortest.unwrap_or((interval, "an output interval"))
}

/// Coordinates up to which the stable step is looked for: it takes the cube of their number.
const MOST_COORDINATES: usize = 400;

/// The longest step of exponential-adams with a tolerance in which small motions at rest do not grow, s.
fn stable_step(scene: &MachineScene, model: &RunModel) -> Option<f64> {
    let by_tolerance = matches!(model.method, Method::ExponentialAdams { tolerance: Some(_) });
    by_tolerance.then(|| step_limit(scene, model)).flatten().map(|limit| stepping::STABLE * limit)
}

/// The longest step of a method in which small motions at rest do not grow, s; `None` where it has no limit, or it is not looked for.
fn step_limit(scene: &MachineScene, model: &RunModel) -> Option<f64> {
    let (mut system, state) = scene.at_rest(model, scene.start).ok()?;
    if state.y.len() > MOST_COORDINATES {
        return None;
    }
    model.method.step_limit(&mut system, &state).map(|limit| limit.step_s)
}

/// The shortest time in which a ball passes a defect from end to end, s; `None` without one, or where nothing turns.
fn shortest_pass(asked: &case::Transient, scene: &MachineScene) -> Option<f64> {
    let passes = scene.setup.bearings.iter().zip(&scene.orders).flat_map(|(own, orders)| {
        let shaft = own.cage.shaft().fastest(asked.start, asked.end);
        let [least, most] = own.cage.slip.range();
        own.bearing.defects().iter().map(move |defect| {
            let along = match defect.race() {
                Race::Outer => shaft * orders.cage * (1.0 - least),
                Race::Inner => shaft * (1.0 - orders.cage * (1.0 - most)),
            };
            2.0 * defect.profile().contact_half_angle() / along
        })
    });
    let shortest = passes.fold(f64::INFINITY, f64::min);
    (shortest > 0.0 && shortest.is_finite()).then_some(shortest)
}

/// Angular frequency of a ball between its races at ten times a load (N), rad/s.
fn fastest_ball(bearing: &SpatialBearing, load: f64) -> f64 {
    let law = bearing.law();
    let stiffness = [&law.inner, &law.outer].map(|contact| tangent(contact.stiffness.at(1.0)[0], IMPACT * load));
    (stiffness.iter().sum::<f64>() / law.mass).sqrt()
}

/// What errors grow to: as in the plane, where a ball is free at rest, balls strike.
fn growth(scene: &MachineScene) -> f64 {
    let mut balls = scene.equilibrium.bearings.iter().flatten();
    let pressed = balls.all(|ball| ball.load.iter().all(|load| *load > 0.0));
    if pressed && !scene.setup.has_defects() { 1.0 } else { IMPACTS_GROWTH }
}
