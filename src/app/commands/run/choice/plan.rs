//! The model that a scene needs: what `[accuracy]` leaves to the program, chosen with an estimate of what it costs in accuracy.
//!
//! What the case fixes stays as it is; its error is estimated all the same where there is an estimate.

use super::loaded_errors::LoadedErrors;
use super::model_choice::{CONDENSATION, ChosenPart, Measured, ModelChoice, SUPERELEMENT};
use super::modes::{ModeErrors, modes};
use super::quantities::{RunTask, USUAL_BAND, heaviest};
use super::{loaded_errors, pilot, stepping};
use crate::app::case;
use crate::app::case::RunCase;
use crate::app::error::ComputeError;
use crate::app::scene::structure::{LEFT_OUT_SHARE, MOST_NUMBERS, complete_for, left_out, wanted_hz};
use crate::app::scene::{CoupledStructure, RunModel, Scene};
use crate::numerics::ode::Method;
use crate::report::significant;
use crate::system::{BallsInertia, Equilibrium, Formulation};

/// What errors grow to where balls strike, while the solution can be predicted: the largest ratio of the error to the linear
/// estimate in scenes with play or damage (`cargo test --test program estimates`).
pub(crate) const IMPACTS_GROWTH: f64 = 6.0;

/// A model, and why its method and its step.
type Planned = (RunModel, ChosenPart, ChosenPart);

impl ModelChoice {
    /// The model of a case: what it asks for, and the program's choice where it leaves one.
    ///
    /// # Errors
    /// [`ComputeError`] for modes or a residual that do not fit the scene.
    pub fn of_case(run: RunCase<'_>, scene: &Scene) -> Result<Self, ComputeError> {
        let RunCase { case, bearing, transient: asked, .. } = run;
        let band_hz = case.band_hz().map_or(USUAL_BAND, |band| band[1]);
        let target = case.target();
        let source = asked.method == case::Method::NewmarkExplicit;
        // the source's method steps all ring displacements, and its equations need them
        let whole = source || scene.setup.formulation == Formulation::Printed;
        let heaviest = heaviest(asked, scene)?;
        let rest = heaviest.as_ref().map(|(_, rest)| rest);
        let loaded = LoadedErrors::of(scene, rest, band_hz, asked.end - asked.start)?;
        let errors = ModeErrors::of(scene, band_hz, &loaded)?;
        let task = RunTask { scene, asked, band_hz, target, heaviest: heaviest.as_ref() };
        let (modes, mut modes_part) = modes(task, &errors, whole);
        let (mut balls_inertia, mut balls_part) = loaded_errors::chosen(task, bearing.balls_inertia, &loaded);
        let growth = growth(scene, rest);
        let planned = |balls_inertia| -> Result<Planned, ComputeError> {
            let mut model =
                RunModel { modes, residual: asked.residual, balls_inertia, method: Method::Exponential, step: 0.0 };
            let (method, method_part) = stepping::method(asked, target, model.modes);
            model.method = method;
            let (step, step_part) = stepping::step(task, &model)?;
            model.step = step;
            Ok((model, method_part, step_part))
        };
        let (mut model, mut method_part, mut step_part) = planned(balls_inertia)?;
        let beside = |model: &RunModel, whole: &RunModel| -> Result<Option<Measured>, String> {
            let finer = pilot::finer(task, whole).map_err(|error| error.to_string())?;
            finer.map(|finer| pilot::measured(scene, task.stretch(growth > 1.0), model, finer)).transpose()
        };
        let mut measured = match balls_inertia {
            BallsInertia::Dynamic => beside(&model, &model),
            // beside balls with inertia
            BallsInertia::QuasiStatic => {
                let with_inertia = planned(BallsInertia::Dynamic)?;
                let found = beside(&model, &with_inertia.0);
                let error = found.as_ref().ok().and_then(|found| Some(found.as_ref()?.error));
                match error.is_some_and(|error| error <= loaded_errors::MEASURED_SHARE * target) {
                    false if bearing.balls_inertia.is_none() => {
                        (balls_inertia, balls_part) = loaded_errors::needed(error);
                        (model, method_part, step_part) = with_inertia;
                        beside(&model, &model)
                    }
                    _ => found,
                }
            }
        };
        let step = model.step;
        while let Ok(Some(found)) = measured
            && let Some(shorter) = stepping::shorter(task, &model, found.error, step)
        {
            model.step = shorter;
            step_part.chosen = format!("{} s", significant(shorter, 3));
            "by the target, from the error that longer ones made on a stretch".clone_into(&mut step_part.why);
            measured = match balls_inertia {
                BallsInertia::Dynamic => beside(&model, &model),
                BallsInertia::QuasiStatic => beside(&model, &planned(BallsInertia::Dynamic)?.0),
            };
        }
        match &measured {
            Ok(Some(found)) => {
                let of_steps = match growth * found.error > target {
                    true => pilot::of_steps(task, &model, found, growth > 1.0),
                    false => None,
                };
                if let Some(of_steps) = of_steps.filter(|of_steps| *of_steps < found.error) {
                    let of_modes = (found.error * found.error - of_steps * of_steps).sqrt();
                    modes_part.estimated_error = modes_part.estimated_error.map(|own| own.hypot(of_modes));
                    modes_part.why += "; beside four times the modes a stretch showed more than the linear estimate";
                }
                method_part.estimated_error = Some(of_steps.map_or(found.error, |of_steps| of_steps.min(found.error)));
                // beside balls with inertia: the stretch has their part
                balls_part.estimated_error.get_or_insert(0.0);
            }
            Ok(None) => {}
            Err(why) => {
                method_part.estimated_error = None;
                method_part.why += &format!("; its error could not be measured before the run: {why}");
            }
        }
        let mut parts = vec![modes_part, balls_part, method_part, step_part];
        parts.extend(vectors(case, &scene.stage, band_hz));
        let estimated_error = together(&mut parts, growth);
        Ok(Self {
            model,
            estimated_error,
            complete_for_hz: complete_for(band_hz, LEFT_OUT_SHARE * target / growth),
            growth,
            measured: measured.ok().flatten(),
            stable_s: stepping::stable_below(task, &model)?,
            target,
            parts,
        })
    }
}

/// The root of the sum of the parts' squared errors, each of which grows so many times where balls strike; `None` if one has none.
pub(crate) fn together(parts: &mut [ChosenPart], growth: f64) -> Option<f64> {
    for part in parts.iter_mut() {
        if let Some(error) = part.estimated_error.filter(|error| growth * error > *error) {
            part.estimated_error = Some(growth * error);
            part.why += &format!("; {} times the linear estimate, as balls strike", significant(growth, 2));
        }
    }
    root_of_squares(parts)
}

/// The parts' errors together; `None` if one has none.
pub(crate) fn root_of_squares(parts: &[ChosenPart]) -> Option<f64> {
    let squares = parts.iter().map(|part| part.estimated_error.map(|e| e * e));
    let sum: Option<f64> = squares.sum();
    sum.map(f64::sqrt)
}

/// What errors grow to in a run that begins at rest and meets a heavier load.
fn growth(scene: &Scene, heaviest: Option<&Equilibrium>) -> f64 {
    let setup = &scene.setup;
    let rests = heaviest.into_iter().chain([&scene.equilibrium]);
    let mut balls = rests.flat_map(|rest| &rest.balls);
    let pressed = balls.all(|ball| ball.inner > 0.0 && ball.outer > 0.0);
    if pressed && setup.race_defects.is_empty() && setup.flats.is_empty() { 1.0 } else { IMPACTS_GROWTH }
}

/// What a superelement from a file or the condensed housing lacks, by [`left_out`].
pub(crate) fn vectors(case: &case::Case, stage: &CoupledStructure, band_hz: f64) -> Option<ChosenPart> {
    let khz = |digits| significant(stage.complete_hz / 1e3, digits);
    let (what, count, why) = match (&stage.bodies.imported, &stage.bodies.housing) {
        (Some(imported), _) => (
            SUPERELEMENT,
            imported.record.modal_hz.len(),
            match stage.complete_hz > 0.0 {
                true => format!("given; vectors above {} kHz were left out when it was condensed", khz(4)),
                false => "given; its file does not tell which vectors were left out when it was condensed".to_owned(),
            },
        ),
        (None, Some(_)) => {
            (CONDENSATION, stage.fixed_interface_modes, condensed_words(stage.complete_hz, wanted_hz(case)))
        }
        (None, None) => return None,
    };
    let known = stage.complete_hz > 0.0;
    let estimated_error = known.then(|| left_out(band_hz, stage.complete_hz));
    Some(ChosenPart { what, chosen: format!("{count} vectors"), why, estimated_error })
}

/// What of a condensed housing is left out, and that the program stopped before `wanted_hz` if it did, both Hz.
fn condensed_words(complete_hz: f64, wanted_hz: Option<f64>) -> String {
    let khz = |hz: f64| significant(hz / 1e3, 3);
    let left_out = format!("of the housing's interior; those above {} kHz are left out", khz(complete_hz));
    match wanted_hz.filter(|wanted_hz| *wanted_hz > complete_hz) {
        None => left_out,
        Some(wanted_hz) => format!(
            "{left_out}, where the target asks for those up to {} kHz: the program takes at most {} million numbers, fixed-interface modes times degrees of freedom",
            khz(wanted_hz),
            MOST_NUMBERS / 1_000_000
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::condensed_words;

    #[test]
    fn a_choice_of_vectors_that_the_limit_stops_names_it() {
        let all = "of the housing's interior; those above 175 kHz are left out";
        assert_eq!(condensed_words(175e3, Some(172e3)), all);
        assert_eq!(condensed_words(175e3, None), all);
        assert_eq!(
            condensed_words(114e3, Some(172e3)),
            "of the housing's interior; those above 114 kHz are left out, where the target asks for those up to 172 kHz: the program takes at most 4 million numbers, fixed-interface modes times degrees of freedom"
        );
    }
}
