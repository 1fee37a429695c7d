//! Whether the balls need their inertia.

use super::super::Scene;
use super::{ChosenPart, ball_frequency, hertz};
use crate::case::{self, Case};
use crate::report::significant;
use crate::system::{BallsInertia, Formulation};

/// Part of the target that balls without inertia may take.
const SHARE: f64 = 0.2;

/// Balls with inertia unless all of them stay pressed onto both races and vibrate there far above the band: a motion of
/// frequency f then loses `(f / f_ball)^2`.
pub(super) fn chosen(
    case: &Case,
    scene: &Scene,
    band_hz: f64,
    target: f64,
) -> (BallsInertia, ChosenPart) {
    let given = case
        .bearing
        .as_ref()
        .and_then(|bearing| bearing.balls_inertia);
    let balls = scene.equilibrium.balls.iter();
    let pressed = balls
        .clone()
        .all(|ball| ball.inner > 0.0 && ball.outer > 0.0);
    let slowest = balls
        .map(|ball| hertz(ball_frequency(scene, ball.inner, ball.outer)))
        .fold(f64::INFINITY, f64::min);
    let lost = pressed.then(|| (band_hz / slowest).powi(2));
    let setup = &scene.setup;
    let supported = setup.contact_damping <= 0.0 && setup.formulation == Formulation::Consistent;
    let (inertia, why) = match given {
        Some(case::BallsInertia::Dynamic) => (BallsInertia::Dynamic, "given".to_owned()),
        Some(case::BallsInertia::QuasiStatic) => (BallsInertia::QuasiStatic, "given".to_owned()),
        None if !pressed => (
            BallsInertia::Dynamic,
            "not all balls are held between both races: they move on their own".to_owned(),
        ),
        None if !supported => (
            BallsInertia::Dynamic,
            "contact damping and the printed equations need it".to_owned(),
        ),
        None => {
            let enough = lost.is_some_and(|lost| lost <= SHARE * target);
            let inertia = match enough {
                true => BallsInertia::QuasiStatic,
                false => BallsInertia::Dynamic,
            };
            let why = format!(
                "the slowest ball vibrates between its races at {} kHz",
                significant(slowest / 1e3, 3)
            );
            (inertia, why)
        }
    };
    let (chosen, estimated_error) = match inertia {
        BallsInertia::Dynamic => ("with inertia", Some(0.0)),
        BallsInertia::QuasiStatic => ("without inertia", lost),
    };
    let part = ChosenPart {
        what: "balls",
        chosen: chosen.to_owned(),
        why,
        estimated_error,
    };
    (inertia, part)
}
