//! Balls that start in damage: the equilibrium is that of a ball that rests in it, and the shaft turns from the first instant.

use crate::bearing::Race;
use crate::bearing::defect::reduced;
use crate::system::BearingSetup;
use std::f64::consts::PI;

/// What damage the balls start in under load while the cage turns, a sentence each; nothing of a bearing that starts at rest, for
/// there the ball does rest in it.
pub(super) fn starts_in_damage(setup: &BearingSetup, start: f64) -> Vec<String> {
    let cage = setup.cage.motion(start);
    if cage.speed == 0.0 {
        return Vec::new();
    }
    let shaft_angle = setup.cage.shaft().angle(start);
    let [x, y] = setup.shaft_load(start);
    // a ball on the other side of the shaft carries nothing
    let is_loaded = |angle: f64| x * angle.cos() + y * angle.sin() > 0.0;
    let balls: Vec<f64> = (0..setup.geometry.balls()).map(|ball| setup.cage.ball_angle(cage.angle, ball)).collect();
    let mut found = Vec::new();
    for defect in &setup.race_defects {
        let turned = match defect.race() {
            Race::Inner => shaft_angle,
            Race::Outer => 0.0,
        };
        let inside = balls.iter().find(|angle| defect.contains(**angle - turned) && is_loaded(**angle));
        if let Some(angle) = inside {
            let beside = 0.5 * setup.cage.spacing - defect.offset(angle - turned);
            let first = setup.cage.motion(0.0).angle + beside;
            found.push(told(
                &format!("in the damage of the {} race", defect.race()),
                &format!(
                    "bearing.first_ball_deg = {:.3} begins between two balls",
                    reduced(first).to_degrees().rem_euclid(360.0)
                ),
            ));
        }
    }
    for flat in &setup.flats {
        let spin = setup.spin(flat.ball, shaft_angle).map_or(0.0, |(_, spin)| spin);
        let faces = |race| flat.shape.contains(race, spin);
        if balls.get(flat.ball).is_some_and(|angle| is_loaded(*angle)) && (faces(Race::Inner) || faces(Race::Outer)) {
            let beside = reduced(flat.angle - reduced(spin) + 0.5 * PI);
            found.push(told(
                "on its flat",
                &format!("angle_deg = {:.1} of the flat begins a quarter of its turn away", beside.to_degrees()),
            ));
        }
    }
    found
}

fn told(place: &str, help: &str) -> String {
    format!(
        "a ball starts {place} while the shaft turns: the first samples ring, and the equilibrium is that of a ball that rests there; {help}"
    )
}

#[cfg(test)]
mod tests {
    use crate::app::case::Case;
    use crate::app::scene::bearing_setup;

    fn told(example: &str, set: &[&str], start: f64) -> Vec<String> {
        let case = Case::example(example, set);
        super::starts_in_damage(&bearing_setup(&case).unwrap().unwrap(), start)
    }

    #[test]
    fn a_ball_that_starts_in_a_dent_is_told_and_helped() {
        let under = ["bearing.first_ball_deg=270"];
        let found = told("housings/ring", &under, 0.0);
        let text = "a ball starts in the damage of the outer race while the shaft turns: the first samples ring, and the equilibrium is that of a ball that rests there; bearing.first_ball_deg = 295.714 begins between two balls";
        assert_eq!(found, [text]);
        assert_eq!(told("housings/ring", &["bearing.first_ball_deg=295.714"], 0.0).len(), 0);
        // another ball, and the middle of the dent a little aside
        let aside = ["bearing.first_ball_deg=170", "bearing.defects.0.angle_deg=272"];
        let found = told("housings/ring", &aside, 0.0);
        assert!(found[0].contains("bearing.first_ball_deg = 194.857"), "{found:?}");
        assert_eq!(told("housings/ring", &["bearing.first_ball_deg=194.857", aside[1]], 0.0).len(), 0);
        // where nothing presses, nothing rings
        let above = ["bearing.first_ball_deg=90", "bearing.defects.0.angle_deg=90"];
        assert_eq!(told("housings/ring", &above, 0.0).len(), 0);
    }

    #[test]
    fn in_a_bearing_at_rest_a_ball_rests_in_its_dent() {
        assert_eq!(told("tadina2011/outer-dent", &[], 0.0).len(), 0);
        assert_eq!(told("tadina2011/outer-dent", &["speed.profile=[{time=0, hz=20}]"], 0.0).len(), 1);
    }

    #[test]
    fn inner_races_and_balls_have_their_own_angles() {
        let turning = "speed.profile=[{time=0, hz=20}]";
        assert_eq!(told("tadina2011/inner-dent", &[turning], 0.0).len(), 0);
        assert_eq!(told("tadina2011/inner-dent", &[turning, "bearing.defects.0.angle_deg=270"], 0.0).len(), 1);
        let found = told("tadina2011/ball-flat", &[turning], 0.0);
        assert!(found[0].starts_with("a ball starts on its flat while the shaft turns"), "{found:?}");
        assert!(found[0].ends_with("angle_deg = 90.0 of the flat begins a quarter of its turn away"), "{found:?}");
        assert_eq!(told("tadina2011/ball-flat", &[turning, "bearing.defects.0.angle_deg=90"], 0.0).len(), 0);
    }

    /// Of the shipped examples one starts in its damage: the scene that is to strike at once.
    #[test]
    fn examples_start_beside_their_damage_or_are_told() {
        let housings = ["housings/ring", "housings/pillow_block", "housings/end_shield"];
        let others = ["scenes/pedestal", "tadina2011/outer-dent", "tadina2011/inner-dent", "tadina2011/ball-flat"];
        for name in housings.into_iter().chain(others) {
            assert_eq!(told(name, &[], 0.0).len(), 0, "{name}");
        }
        assert_eq!(told("scenes/impact", &[], 0.0).len(), 1);
    }
}
