//! How far the surfaces under a ball may move in a step: what a step jumps over no control of its error can see.

use crate::app::case;
use crate::app::scene::Scene;
use crate::bearing::Race;
use std::f64::consts::TAU;

/// Steps in which a ball passes a defect from end to end, or a wave from crest to crest.
const STEPS: f64 = 8.0;

/// The longest step (s) that takes no ball over too much of a defect, flat or wave, at the highest speed of the run; `None` if
/// there is none or nothing turns.
pub(crate) fn longest_step(asked: &case::Transient, scene: &Scene) -> Option<f64> {
    let setup = &scene.setup;
    let orders = setup.geometry.orders();
    let shaft = setup.cage.shaft().fastest(asked.start, asked.end);
    let [least_slip, most_slip] = setup.cage.slip().range();
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
    (shortest > 0.0 && shortest.is_finite()).then_some(shortest / STEPS)
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
