//! The model that a scene needs: what `[accuracy]` leaves to the program, chosen with an estimate of what it costs in accuracy.
//!
//! What the case fixes stays as it is; its error is estimated all the same where there is an estimate.

use super::loaded_errors::LoadedErrors;
use super::mode_errors::{ModeErrors, undamped_ball_hz};
use super::pilot::Measured;
use super::{balls, heaviest, pilot, stepping};
use crate::app::case::{self, Case, ModesKept};
use crate::app::error::ComputeError;
use crate::app::scene::structure::left_out;
use crate::app::scene::{RunModel, Scene};
use crate::numerics::ode::Method;
use crate::report::significant;
use crate::system::{BallsInertia, Equilibrium, Formulation, ModeSelection, Sensor};
use std::f64::consts::TAU;

/// Part of the target that the modes left out may take: their estimate was found within a factor of three of the error on the
/// dented bearing of `examples/tadina2011`.
pub(crate) const MODES_SHARE: f64 = 0.2;

/// What errors grow to where balls strike, while the solution can be predicted: the largest ratio of the error to the linear
/// estimate in scenes with play or damage (`cargo test --test estimates`).
pub(crate) const IMPACTS_GROWTH: f64 = 6.0;

/// The parts that are a superelement from a file and a housing condensed for the run.
pub(crate) const SUPERELEMENT: &str = "superelement";
pub(crate) const CONDENSATION: &str = "condensation";

/// Modes closer than this belong together: one of two alone would give the ring a direction.
pub(crate) const PAIR: f64 = 1e-3;

/// Band without `[accuracy]`, Hz.
pub(crate) const USUAL_BAND: f64 = 40e3;

/// Largest ball force to prepare for, in units of the largest static one: impacts in a dent of the source's size reach five to
/// ten times.
pub(crate) const IMPACT: f64 = 10.0;

/// Sensors at most that the estimates of modes look at: each costs some milliseconds.
pub(crate) const JUDGED_SENSORS: usize = 64;

/// A model, and why its method and its step.
pub(crate) type Planned = (RunModel, ChosenPart, ChosenPart);

/// A model, and why it is this one.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelChoice {
    /// The model.
    pub model: RunModel,
    /// What was chosen or given, in the order modes, balls, method, largest step, and a superelement or a condensed housing.
    pub parts: Vec<ChosenPart>,
    /// Root of the sum of the parts' squared errors, relative, in the band; `None` if a part has no estimate.
    pub estimated_error: Option<f64>,
    /// How many times the linear estimate of modes and steps it takes, as balls strike.
    pub growth: f64,
    /// The stretch that showed the error of modes and steps; `None` where it was not measured.
    pub measured: Option<Measured>,
    /// The longest step in which small motions at rest do not grow, s, where the case gives a longer one.
    pub stable_s: Option<f64>,
    /// `accuracy.target`.
    pub target: f64,
}

/// One part of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct ChosenPart {
    /// Which part.
    pub what: &'static str,
    /// What it is.
    pub chosen: String,
    /// Why, with what was left out.
    pub why: String,
    /// Relative error in the band that it is expected to make; `None` where there is no estimate.
    pub estimated_error: Option<f64>,
}

impl ModelChoice {
    /// That the case's step is beyond the stable one, and that the model errs by more than the target, with its largest part and what helps: a sentence each.
    pub fn warnings(&self) -> Vec<String> {
        let unstable = self.stable_s.map(|stable_s| {
            format!(
                "transient.step makes steps of {} s, longer than the {} s up to which {} keeps small motions at rest from growing: what they grow to, contacts may hold without a blow-up, and the signals cannot be trusted. Shorten it, or leave it to the program.",
                significant(self.model.step, 5),
                significant(stable_s, 5),
                self.model.method.name()
            )
        });
        unstable.into_iter().chain(self.missed()).collect()
    }

    fn missed(&self) -> Vec<String> {
        let target = self.target;
        let parts = self.parts.iter();
        let parts = parts.filter_map(|part| Some((part, part.estimated_error?)));
        let largest = parts.max_by(|(_, a), (_, b)| a.total_cmp(b));
        let Some(together) = self.estimated_error else {
            let unknown = self
                .parts
                .iter()
                .find(|part| part.estimated_error.is_none());
            return unknown.into_iter().map(|part| self.unknown(part)).collect();
        };
        let Some((part, error)) = largest else {
            return Vec::new();
        };
        if together <= target {
            return Vec::new();
        }
        let given = |what: &str| {
            let mut parts = self.parts.iter().filter(|part| part.what == what);
            parts.any(|part| part.why.starts_with("given"))
        };
        // what the program chooses keeps the linear estimate below the target
        let grown = self.growth > 1.0 && together <= self.growth * target;
        let help = match part.what {
            SUPERELEMENT | CONDENSATION => {
                "condense with more vectors by condense.fixed_interface_modes: the error falls with the cube of their highest frequency"
            }
            "method" if given("largest step") => "leave transient.step to the program",
            "method" if given("method") && !self.model.method.chooses_its_steps() => {
                "leave transient.method to the program: its own method takes steps by the target"
            }
            "method" if !self.model.residual && self.model.modes != ModeSelection::All => {
                "transient.residual = true lets the modes that are left out act statically"
            }
            _ if grown && !given(part.what) => &format!(
                "errors grow up to {} times as balls strike, and the model is chosen without that; accuracy.target = {} takes that in",
                significant(self.growth, 2),
                significant(target / self.growth, 2)
            ),
            "modes" => "raise transient.modes",
            "balls" => "set bearing.balls_inertia = \"dynamic\"",
            _ => {
                "a smaller accuracy.target shortens the steps; an error near 1 says that such a motion cannot be predicted for so long"
            }
        };
        vec![format!(
            "the estimated error is {} where accuracy.target is {}, most of it of the {} ({}; {}): {help}",
            significant(together, 2),
            significant(target, 2),
            part.what,
            part.chosen,
            significant(error, 2),
        )]
    }

    /// That the error of a part is not known.
    fn unknown(&self, part: &ChosenPart) -> String {
        format!(
            "the error of the signals is not estimated: that of the {} ({}; {}) is not known",
            part.what, part.chosen, part.why
        )
    }

    /// The model of a case: what it asks for, and the program's choice where it leaves one.
    ///
    /// # Errors
    /// [`ComputeError`] for modes or a residual that do not fit the scene.
    pub fn of_case(
        case: &Case,
        asked: &case::Transient,
        scene: &Scene,
    ) -> Result<Self, ComputeError> {
        let band_hz = case.band_hz().map_or(USUAL_BAND, |band| band[1]);
        let target = case.target();
        let source = asked.method == case::Method::NewmarkExplicit;
        // the source's method steps all ring displacements, and its equations need them
        let whole = source || scene.setup.formulation == Formulation::Printed;
        let heaviest = heaviest::heaviest(asked, scene)?;
        let rest = heaviest.as_ref().map(|(_, rest)| rest);
        let loaded = LoadedErrors::of(scene, rest, band_hz, asked.end - asked.start)?;
        let errors = ModeErrors::of(scene, band_hz, &loaded);
        let (modes, modes_part) = modes(asked, scene, band_hz, target, &errors, whole);
        let (mut balls_inertia, mut balls_part) =
            balls::chosen(case, scene, band_hz, target, &loaded);
        let growth = growth(scene, rest);
        let planned = |balls_inertia| -> Result<Planned, ComputeError> {
            let mut model = RunModel {
                modes,
                residual: asked.residual,
                balls_inertia,
                method: Method::Exponential,
                step: 0.0,
            };
            let (method, method_part) = stepping::method(asked, &model, target);
            model.method = method;
            let (step, step_part) = stepping::step(asked, &model, scene, heaviest.as_ref())?;
            model.step = step;
            Ok((model, method_part, step_part))
        };
        let (mut model, mut method_part, mut step_part) = planned(balls_inertia)?;
        let beside = |model: &RunModel, whole: &RunModel| -> Result<Option<Measured>, String> {
            let finer = pilot::finer(asked, whole, scene, target, heaviest.as_ref());
            let Some(finer) = finer.map_err(|error| error.to_string())? else {
                return Ok(None);
            };
            pilot::measured(asked, model, finer, scene, band_hz, growth > 1.0).map(Some)
        };
        let mut measured = match balls_inertia {
            BallsInertia::Dynamic => beside(&model, &model),
            // beside balls with inertia
            BallsInertia::QuasiStatic => {
                let with_inertia = planned(BallsInertia::Dynamic)?;
                let found = beside(&model, &with_inertia.0);
                let error = found
                    .as_ref()
                    .ok()
                    .and_then(|found| Some(found.as_ref()?.error));
                match error.is_some_and(|error| error <= balls::MEASURED_SHARE * target) {
                    false if balls::is_free(case) => {
                        (balls_inertia, balls_part) = balls::needed(error);
                        (model, method_part, step_part) = with_inertia;
                        beside(&model, &model)
                    }
                    _ => found,
                }
            }
        };
        let step = model.step;
        while let Ok(Some(found)) = measured
            && let Some(shorter) = stepping::shorter(asked, &model, found.error, target, step)
        {
            model.step = shorter;
            step_part.chosen = format!("{} s", significant(shorter, 3));
            "by the target, from the error that longer ones made on a stretch"
                .clone_into(&mut step_part.why);
            measured = match balls_inertia {
                BallsInertia::Dynamic => beside(&model, &model),
                BallsInertia::QuasiStatic => beside(&model, &planned(BallsInertia::Dynamic)?.0),
            };
        }
        match &measured {
            Ok(Some(found)) => {
                method_part.estimated_error = Some(found.error);
                // beside balls with inertia: the stretch has their part
                balls_part.estimated_error.get_or_insert(0.0);
            }
            Ok(None) => {}
            Err(why) => {
                method_part.estimated_error = None;
                method_part.why +=
                    &format!("; its error could not be measured before the run: {why}");
            }
        }
        let mut parts = vec![modes_part, balls_part, method_part, step_part];
        parts.extend(superelement(scene, band_hz));
        parts.extend(condensed(scene, band_hz));
        for part in &mut parts {
            if let Some(error) = part.estimated_error.filter(|error| growth * error > *error) {
                part.estimated_error = Some(growth * error);
                part.why += &format!(
                    "; {} times the linear estimate, as balls strike",
                    significant(growth, 2)
                );
            }
        }
        let squares = parts.iter().map(|part| part.estimated_error.map(|e| e * e));
        let sum: Option<f64> = squares.sum();
        Ok(Self {
            model,
            estimated_error: sum.map(f64::sqrt),
            growth,
            measured: measured.ok().flatten(),
            stable_s: stepping::stable_below(asked, &model, scene)?,
            target,
            parts,
        })
    }
}

/// What errors grow to in a run that begins at rest and meets a heavier load.
pub(crate) fn growth(scene: &Scene, heaviest: Option<&Equilibrium>) -> f64 {
    let setup = &scene.setup;
    let rests = heaviest.into_iter().chain([&scene.equilibrium]);
    let mut balls = rests.flat_map(|rest| &rest.balls);
    let pressed = balls.all(|ball| ball.inner > 0.0 && ball.outer > 0.0);
    match pressed && setup.race_defects.is_empty() && setup.flats.is_empty() {
        true => 1.0,
        false => IMPACTS_GROWTH,
    }
}

/// What a superelement from a file lacks, by [`left_out`].
pub(crate) fn superelement(scene: &Scene, band_hz: f64) -> Option<ChosenPart> {
    let imported = scene.stage.imported.as_ref()?;
    let highest = scene.stage.complete_hz;
    Some(ChosenPart {
        what: SUPERELEMENT,
        chosen: format!("{} vectors", imported.record.modal_hz.len()),
        why: format!(
            "given; vectors above {} kHz were left out when it was condensed",
            significant(highest / 1e3, 4)
        ),
        estimated_error: Some(left_out(band_hz, highest)),
    })
}

/// What the condensed housing lacks, by [`left_out`].
pub(crate) fn condensed(scene: &Scene, band_hz: f64) -> Option<ChosenPart> {
    scene.stage.housing.as_ref()?;
    Some(ChosenPart {
        what: CONDENSATION,
        chosen: format!("{} vectors", scene.stage.fixed_interface_modes),
        why: format!(
            "of the housing's interior; those above {} kHz are left out",
            significant(scene.stage.complete_hz / 1e3, 3)
        ),
        estimated_error: Some(left_out(band_hz, scene.stage.complete_hz)),
    })
}

/// Modes of ring and housing, and what leaving the others out costs.
pub(crate) fn modes(
    asked: &case::Transient,
    scene: &Scene,
    band_hz: f64,
    target: f64,
    errors: &ModeErrors,
    whole: bool,
) -> (ModeSelection, ChosenPart) {
    let (all, known) = (scene.stage.structure.dof(), scene.stage.modes.count());
    let (selection, why) = match asked.modes {
        ModesKept::All => (ModeSelection::All, "given".to_owned()),
        ModesKept::Count(count) if count > known => (
            ModeSelection::Count(known),
            format!("given: {count}, of which there are {known}"),
        ),
        ModesKept::Count(count) => (ModeSelection::Count(count), "given".to_owned()),
        ModesKept::Auto if whole => (
            ModeSelection::All,
            "the equations or the method need all displacements of the ring".to_owned(),
        ),
        ModesKept::Auto => {
            let share = MODES_SHARE * target;
            let fewest = with_pairs(scene, errors.fewest(share, asked.residual));
            let mut why = format!(
                "the fewest with a linear estimate of at most {} of the target in the band up to {} kHz",
                significant(MODES_SHARE, 2),
                significant(band_hz / 1e3, 4)
            );
            if let Some(ball_hz) = undamped_ball_hz(scene) {
                why += &format!(
                    ", and at contacts that nothing damps up to {} kHz, where balls vibrate",
                    significant(ball_hz / 1e3, 3)
                );
            }
            (ModeSelection::Count(fewest), why)
        }
    };
    let kept = match selection {
        ModeSelection::Count(count) => count,
        _ => known,
    };
    let highest = scene.stage.modes.frequency_hz(kept.saturating_sub(1));
    let left = match (kept < all, asked.residual) {
        (false, _) => "nothing left out".to_owned(),
        (true, true) => "of the others only their inertia is left out".to_owned(),
        (true, false) => "the others are left out".to_owned(),
    };
    let (looked_at, sensors) = (judged(scene).count(), scene.stage.structure.sensors().len());
    let left = match looked_at < sensors {
        true => format!("{left}; estimated at {looked_at} of the {sensors} sensors"),
        false => left,
    };
    let part = ChosenPart {
        what: "modes",
        chosen: format!(
            "{kept} of {all}, up to {} kHz{}",
            significant(highest / 1e3, 4),
            if kept < all && asked.residual {
                ", static residual of the others"
            } else {
                ""
            }
        ),
        why: format!("{why}; {left}"),
        estimated_error: Some(errors.with(kept, asked.residual)),
    };
    (selection, part)
}

/// The sensors that the estimates of modes look at: all, or every so many of them.
pub(crate) fn judged(scene: &Scene) -> impl Iterator<Item = &Sensor> {
    let sensors = scene.stage.structure.sensors();
    let apart = sensors.len().div_ceil(JUDGED_SENSORS).max(1);
    sensors.iter().step_by(apart)
}

/// So many modes, and those that belong to the last one.
pub(crate) fn with_pairs(scene: &Scene, count: usize) -> usize {
    let modes = &scene.stage.modes;
    let mut kept = count.clamp(1, modes.count());
    while kept < modes.count()
        && modes.frequency_hz(kept) <= (1.0 + PAIR) * modes.frequency_hz(kept - 1)
    {
        kept += 1;
    }
    kept
}

/// Angular frequency of a ball with these forces between its contacts, rad/s.
pub(crate) fn ball_frequency(scene: &Scene, inner: f64, outer: f64) -> f64 {
    let stiffness = &scene.setup.stiffness;
    let tangent = |stiffness: f64, force: f64| 1.5 * stiffness.cbrt().powi(2) * force.cbrt();
    let sum = tangent(stiffness.inner(), inner) + tangent(stiffness.outer(), outer);
    (sum / scene.setup.geometry.ball_mass()).sqrt()
}

/// Hz.
pub(crate) fn hertz(angular: f64) -> f64 {
    angular / TAU
}

/// Whether a bearing's balls are stepped with their mass.
pub(crate) fn dynamic(model: &RunModel) -> bool {
    model.balls_inertia == BallsInertia::Dynamic
}
