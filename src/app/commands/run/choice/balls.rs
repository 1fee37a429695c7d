//! Whether the balls need their inertia.

use super::loaded_errors::LoadedErrors;
use super::model_choice::ChosenPart;
use super::quantities::{RunTask, ball_hz};
use crate::report::significant;
use crate::system::{BallsInertia, Formulation};

/// What balls with inertia are called.
const WITH_INERTIA: &str = "with inertia";

/// Part of the target that balls without inertia may take.
const SHARE: f64 = 0.2;

/// Part of the target that a model with such balls may err by on a stretch, beside balls with inertia. A start from rest shakes the balls far above the
/// band, and what of it reaches the band no loaded mode tells: estimates by these alone were up to a hundred times too low.
pub(crate) const MEASURED_SHARE: f64 = 0.5;

/// Balls with inertia, as a stretch without it showed an error; none where it could not be stepped.
pub(crate) fn needed(error: Option<f64>) -> (BallsInertia, ChosenPart) {
    let why = match error {
        Some(error) => format!("without the balls' mass a stretch errs by {}", significant(error, 2)),
        None => "a stretch without the balls' mass could not be stepped".to_owned(),
    };
    let part = ChosenPart { what: "balls", chosen: WITH_INERTIA.to_owned(), why, estimated_error: Some(0.0) };
    (BallsInertia::Dynamic, part)
}

/// As `given`, or balls with inertia unless all of them stay pressed onto both races and vibrate there far above the band: a motion of
/// frequency f then loses `(f / f_ball)^2`, and the mass that ring and shaft lack shifts their phase more and more.
pub(crate) fn chosen(
    RunTask { scene, band_hz, target, .. }: RunTask<'_>,
    given: Option<BallsInertia>,
    loaded: &LoadedErrors,
) -> (BallsInertia, ChosenPart) {
    let balls = scene.equilibrium.balls.iter();
    let pressed = balls.clone().all(|ball| ball.inner > 0.0 && ball.outer > 0.0);
    let slowest = balls.map(|ball| ball_hz(scene, ball.inner, ball.outer)).fold(f64::INFINITY, f64::min);
    let lost = pressed.then(|| (band_hz / slowest).powi(2).hypot(loaded.without_balls));
    let setup = &scene.setup;
    let damaged = !setup.race_defects.is_empty() || !setup.flats.is_empty();
    let supported = setup.contact_damping <= 0.0 && setup.formulation == Formulation::Consistent;
    let (inertia, why) = match given {
        Some(given) => (given, "given".to_owned()),
        None if !pressed => {
            (BallsInertia::Dynamic, "not all balls are held between both races: they move on their own".to_owned())
        }
        None if damaged => (BallsInertia::Dynamic, "damage throws balls off their races".to_owned()),
        None if !supported => (BallsInertia::Dynamic, "contact damping and the printed equations need it".to_owned()),
        None => {
            let enough = lost.is_some_and(|lost| lost <= SHARE * target);
            let inertia = if enough { BallsInertia::QuasiStatic } else { BallsInertia::Dynamic };
            let why = format!(
                "the slowest ball vibrates between its races at {} kHz; without the balls' mass the phases of the band's modes err by {} in the end",
                significant(slowest / 1e3, 3),
                significant(loaded.without_balls, 2)
            );
            (inertia, why)
        }
    };
    let (chosen, estimated_error) = match inertia {
        BallsInertia::Dynamic => (WITH_INERTIA, Some(0.0)),
        BallsInertia::QuasiStatic => ("without inertia", lost),
    };
    let part = ChosenPart { what: "balls", chosen: chosen.to_owned(), why, estimated_error };
    (inertia, part)
}
