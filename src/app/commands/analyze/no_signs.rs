//! What of a simulated bearing a signal cannot show, and the case knows.

use crate::app::case::{Case, Defect, DentDefect, Load, MeasuredDefect};
use crate::bearing::Race;
use crate::report::significant;
use crate::signal::diagnosis::Fault;

/// Load over the weight of a ball from which balls of a healthy bearing with play strike as hard as those of a damaged one. The bearing
/// of `examples/tadina2011` does so from 12 000 on and bearing 627 from 8000; of 6205 it is seen at 970 already (`docs/diagnosis.md`).
const STRIKING_LOAD: f64 = 7500.0;
/// m/s^2
const STANDARD_GRAVITY: f64 = 9.80665;

/// Why lines of a part are no sign of damage in a simulated bearing: the case has no damage there, or the load is too large to tell.
pub(crate) fn no_signs(case: &Case) -> Vec<(Fault, String)> {
    let Some(bearing) = case.bearing.as_ref() else {
        return Vec::new();
    };
    let play = (bearing.play() > 0.0).then(|| format!("the play is {} um", significant(1e6 * bearing.play(), 2)));
    let damaged = bearing.defects.iter().map(|defect| match defect {
        Defect::Dent(DentDefect { on, .. }) | Defect::Measured(MeasuredDefect { on, .. }) => match on {
            Race::Outer => Fault::OuterRace,
            Race::Inner => Fault::InnerRace,
        },
        Defect::Flat(_) => Fault::Ball,
    });
    let damaged: Vec<Fault> = damaged.collect();
    let reasons = [Fault::OuterRace, Fault::InnerRace, Fault::Ball].into_iter().filter_map(|fault| {
        let play = play.as_ref().filter(|_| fault == Fault::OuterRace);
        let reason = match (damaged.contains(&fault), play) {
            (false, Some(play)) => format!("The case has no damage there, and {play}."),
            (false, None) => "The case has no damage there.".to_owned(),
            (true, play) => {
                let (play, weights) = (play?, ball_weights(case).filter(|weights| *weights >= STRIKING_LOAD)?);
                format!(
                    "This cannot be told from damage: {play}, and shaft and loads weigh up to {} times a ball. Compare with a run without the damage (--baseline).",
                    significant(weights, 2)
                )
            }
        };
        Some((fault, reason))
    });
    reasons.collect()
}

/// The largest load of the bearing over the weight of a ball.
fn ball_weights(case: &Case) -> Option<f64> {
    let shaft = case.shaft.as_ref()?;
    let size = |[x, y]: [f64; 2]| x.hypot(y);
    let largest = |load: &Load| match load {
        Load::Constant(force) => size(*force),
        Load::Profile(points) => points.iter().fold(0.0, |most, at| size(at.force).max(most)),
    };
    let load = shaft.mass * size(shaft.gravity) + shaft.loads.iter().map(largest).sum::<f64>();
    Some(load / (case.ball_mass()? * STANDARD_GRAVITY))
}
