//! The source's flat on a ball by number, features, rules, and what the spin does.

use super::*;
use crate::bearing::hertz::{self, PrincipalCurvatures};
use approx::assert_relative_eq;

const RACES: [Race; 2] = [Race::Outer, Race::Inner];

/// Spin angle at which the flat faces a race.
fn facing(race: Race) -> f64 {
    match race {
        Race::Outer => 0.0,
        Race::Inner => PI,
    }
}

fn touching(race: Race) -> f64 {
    match race {
        Race::Outer => 3.7565e-3,
        Race::Inner => 3.754e-3,
    }
}

/// The included angle by depth and R_2 is 22.9 degrees, half of the source's 46; the ball moves by the depth.
#[test]
fn the_source_flat() {
    let flat = flat(source_flat());
    assert_relative_eq!(flat.included_angle().to_degrees(), 22.9, epsilon = 0.05);
    assert!(flat.half_angle() > 0.5 * flat.included_angle());
    assert_relative_eq!(flat.contour_radius(0.0), 0.99e-3, max_relative = 1e-13);
    assert_relative_eq!(flat.contour_radius(7.0), 1e-3);
    for race in RACES {
        assert_relative_eq!(flat.ball_drop(race), 10e-6, max_relative = 1e-10);
    }
}

/// A plane is flatter than the outer race and rests on its rims there; the convex inner race touches it.
#[test]
fn a_plane_is_bridged_by_the_outer_race() {
    let plane = flat(FlatShape { radius: 0.1, ..source_flat() });
    assert_relative_eq!(plane.ball_drop(Race::Inner), 10e-6, max_relative = 1e-6);
    // chord of the rims' contacts under the race's sagitta: c²/2 (1/ρ_b − 1/R_0) with c near the flat's half length
    let half = 1e-3 * (0.5 * plane.included_angle()).sin();
    let sagitta = 0.5 * half * half / 4.7565e-3;
    assert_relative_eq!(plane.ball_drop(Race::Outer), 10e-6 - sagitta, max_relative = 0.1);
    let found = plane.contacts(Race::Outer, 0.0, touching(Race::Outer) + 10e-6);
    let features: Vec<_> = found.pressing().map(|c| c.feature).collect();
    assert_eq!(features, [Feature::RimBefore, Feature::RimAfter]);
}

#[test]
fn stiffness_on_the_flat_is_hertz_of_its_radius_or_the_ball_s() {
    let modulus = hertz::effective_modulus([206e9; 2], [0.3; 2]).unwrap();
    for (race, groove, along) in [(Race::Outer, 1.07e-3, -1.0 / 4.7565e-3), (Race::Inner, 1.04e-3, 1.0 / 2.754e-3)] {
        for (curvature, rolling) in [(CurvatureReading::Total, 500.0), (CurvatureReading::Paper, 1000.0)] {
            let flat = flat(FlatShape { curvature, ..source_flat() });
            let outward = if race == Race::Outer { 1.0 } else { -1.0 };
            let radius = touching(race) + outward * 12e-6;
            let found = flat.contacts(race, facing(race) + 0.01, radius);
            let [contact] = found.as_slice() else { panic!("one contact on the flat") };
            assert_eq!(contact.feature, Feature::Floor);
            assert_relative_eq!(contact.normal_radial, outward, epsilon = 1e-3);
            let ball = PrincipalCurvatures { plane_1: 1000.0, plane_2: rolling };
            let surface = PrincipalCurvatures { plane_1: -1.0 / groove, plane_2: along };
            let direct = hertz::stiffness(ball, surface, modulus).unwrap().stiffness;
            assert_relative_eq!(contact.stiffness, direct, max_relative = 1e-6);
        }
    }
}

/// Each race once a spin, over the flat's own arc, whatever the turn.
#[test]
fn each_race_meets_the_flat_once_a_spin() {
    let flat = flat(source_flat());
    for race in RACES {
        let half = flat.contact_half_angle(race);
        assert_relative_eq!(half, flat.half_angle());
        for turns in [0.0, 3.0, -1e4] {
            let middle = facing(race) + turns * 2.0 * PI;
            assert!(flat.contains(race, middle));
            for side in [-1.0, 1.0] {
                assert!(flat.contains(race, middle + side * (half - 1e-9)));
                assert!(!flat.contains(race, middle + side * (half + 1e-9)));
            }
            assert!(!flat.contains(race, middle + PI));
        }
        assert!(!flat.contains(race, f64::NAN));
    }
}

/// A flat turned counter-clockwise past the contact presses with its clockwise rim, ahead on the ball's way:
/// seen from the contact the contour rises behind it.
#[test]
fn rims_are_named_by_the_ball_s_own_angle() {
    let flat = flat(source_flat());
    for race in RACES {
        let outward = if race == Race::Outer { 1.0 } else { -1.0 };
        let radius = touching(race) + outward * 8e-6;
        let turn = 0.9 * flat.half_angle();
        for (turned, feature) in [(turn, Feature::RimBefore), (-turn, Feature::RimAfter)] {
            let found = flat.contacts(race, facing(race) + turned, radius);
            let pressing: Vec<_> = found.pressing().collect();
            assert_eq!(pressing.len(), 1);
            assert_eq!(pressing[0].feature, feature);
        }
    }
}

/// `∂δ/∂spin_angle = −ρ n_t` at fixed position.
#[test]
fn overlap_changes_with_the_spin_by_the_tangential_normal() {
    let flat = flat(source_flat());
    for race in RACES {
        let outward = if race == Race::Outer { 1.0 } else { -1.0 };
        let radius = touching(race) + outward * 14e-6;
        for i in -9..10 {
            let spin = facing(race) + 0.1 * f64::from(i) * flat.half_angle();
            let delta = |spin: f64| flat.contacts(race, spin, radius).pressing().next().unwrap().delta;
            let h = 1e-6;
            let slope = (delta(spin + h) - delta(spin - h)) / (2.0 * h);
            let found = flat.contacts(race, spin, radius);
            let contact = found.pressing().next().unwrap();
            assert!((slope + radius * contact.normal_tangential).abs() < 1e-8, "{race} {i}");
            let rate = contact.rate(0.0, -radius);
            assert!((slope - rate).abs() < 1e-8);
        }
    }
}

#[test]
fn every_rule_fires() {
    let refuse = |shape| BallFlat::new(&source_bearing(), shape, source_stiffness()).unwrap_err().to_string();
    let source = source_flat();
    for (shape, message) in [
        (FlatShape { radius: 1e-3, ..source }, "defect flat_radius = 0.001 must be greater than ball_radius"),
        (
            FlatShape { radius: 1.1, ..source },
            "defect flat_radius = 1.1 must be at most 1000 times ball_radius, which is flat",
        ),
        (FlatShape { radius: f64::NAN, ..source }, "defect flat_radius = NaN must be positive and finite"),
        (FlatShape { depth: 0.0, ..source }, "defect depth = 0 must be positive and finite"),
        (FlatShape { rim_radius: -1e-6, ..source }, "defect rim_radius = -0.000001 must be positive and finite"),
        (
            FlatShape { rim_radius: 0.6e-3, ..source },
            "defect rim_radius = 0.0006 must be at most half the radius of the race or ball that it rounds",
        ),
    ] {
        assert_eq!(refuse(shape), message);
    }
    let long = BallFlat::new(&source_bearing(), FlatShape { radius: 0.1, depth: 0.4e-3, ..source }, source_stiffness());
    let long = long.unwrap_err().to_string();
    assert!(long.contains("is more than a quarter of the race"), "{long}");
}
