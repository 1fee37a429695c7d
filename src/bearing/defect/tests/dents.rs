//! The source's dents by number, rules, features and angles.

use super::*;
use crate::bearing::error::BearingError;
use crate::bearing::hertz::{self, PrincipalCurvatures};
use approx::assert_relative_eq;
use std::f64::consts::TAU;

const RACES: [Race; 2] = [Race::Outer, Race::Inner];

/// Place of a ball that overlaps the undamaged race by `sunk`.
fn at(dent: &Dent, sunk: f64, offset: f64) -> PolarPosition {
    let subject = Subject::race(RaceDefect::Dent(dent.clone()));
    PolarPosition { radius: subject.distance(sunk), angle: MIDDLE + offset }
}

fn groove(race: Race) -> f64 {
    match race {
        Race::Outer => 1.07e-3,
        Race::Inner => 1.04e-3,
    }
}

fn steel_stiffness(race: Race, in_plane: f64) -> f64 {
    let surface = PrincipalCurvatures { plane_1: -1.0 / groove(race), plane_2: in_plane };
    let modulus = hertz::effective_modulus([206e9; 2], [0.3; 2]).unwrap();
    let ball = PrincipalCurvatures::sphere(1e-3);
    hertz::stiffness(ball, surface, modulus).unwrap().stiffness
}

/// Radii 3.16 mm (concave) and 3.71 mm (convex), and the whole depth: the rims do not hold the ball.
#[test]
fn ball_sinks_to_the_bottom_of_the_source_dents() {
    for (race, radius) in [(Race::Outer, -3.16e-3), (Race::Inner, 3.71e-3)] {
        let dent = solved(race, source_shape(race));
        assert_relative_eq!(dent.ball_drop(), 15e-6, max_relative = 1e-12);
        assert_relative_eq!(1.0 / dent.bottom_curvature(), radius, max_relative = 2e-3);
    }
}

/// At its drop, and only there, a ball at the middle touches without pressing.
#[test]
fn drop_is_where_the_deepest_contact_just_touches() {
    for (name, subject) in &subjects()[..14] {
        let drop = match &subject.kind {
            Kind::Race(defect) => defect.ball_drop(),
            Kind::Ball(flat, race) => flat.ball_drop(*race),
        };
        let deepest = |sunk: f64| {
            let found = subject.contacts(sunk, 0.0);
            let overlaps = found.as_slice().iter().map(|c| c.delta);
            overlaps.fold(f64::NEG_INFINITY, f64::max)
        };
        assert!(deepest(drop).abs() < 1e-15, "{name}: {}", deepest(drop));
        assert!(deepest(drop - 1e-9) < 0.0 && deepest(drop + 1e-9) > 0.0);
    }
    for race in RACES {
        let bridged = solved(race, dent_shape(0.2e-3, 15e-6, 20e-6));
        assert!(bridged.ball_drop() > 3e-6 && bridged.ball_drop() < 12e-6, "{}", bridged.ball_drop());
    }
}

#[test]
fn bottom_contact_has_hertz_stiffness_of_its_curvature() {
    for race in RACES {
        let shape = source_shape(race);
        let paper = DentShape { curvature: CurvatureReading::Paper, ..shape };
        let flat = -4.0 * 15e-6 / (shape.length * shape.length);
        let race_curvature = match race {
            Race::Outer => -1.0 / 4.7565e-3,
            Race::Inner => 1.0 / 2.754e-3,
        };
        for (shape, curvature) in [(shape, race_curvature + flat), (paper, flat)] {
            let dent = solved(race, shape);
            let found = dent.contacts(at(&dent, 16e-6, 0.0));
            let [bottom] = found.as_slice() else { panic!("one contact at the middle") };
            assert_eq!(bottom.feature, Feature::Floor);
            assert_relative_eq!(bottom.delta, 1e-6, max_relative = 1e-9);
            let outward = if race == Race::Outer { 1.0 } else { -1.0 };
            assert_relative_eq!(bottom.normal_radial, outward, max_relative = 1e-14);
            let direct = steel_stiffness(race, curvature);
            assert_relative_eq!(bottom.stiffness, direct, max_relative = 1e-6);
        }
    }
}

#[test]
fn past_the_blend_the_rim_has_hertz_stiffness_of_its_radius() {
    for race in RACES {
        let dent = solved(race, source_shape(race));
        // the contact angle must be past the blend, and before the joint
        let found = dent.contacts(at(&dent, 5e-6, dent.half_angle() - 0.04));
        let contact = found.as_slice().iter().find(|c| c.feature == Feature::RimAfter).unwrap();
        assert_relative_eq!(contact.stiffness, steel_stiffness(race, 2e4), max_relative = 1e-6);
        assert!(contact.normal_tangential > 0.0, "the rim after the dent lies ahead of the ball");
    }
}

/// With the play changed, the inner race's effective radius is where the ball touches it, dent or not.
#[test]
fn play_moves_the_inner_dent_with_its_race() {
    let bearing = source_bearing().with_radial_play(-1.5e-6).unwrap();
    let shape = source_shape(Race::Inner);
    let dent = Dent::new(&bearing, Race::Inner, shape, source_stiffness()).unwrap();
    let touching = bearing.effective_inner_race_radius() + 1e-3;
    for (angle, drop) in [(MIDDLE + 1.0, 0.0), (MIDDLE, 15e-6)] {
        let radius = touching - drop - 2e-6;
        let found = dent.contacts(PolarPosition { radius, angle });
        assert_relative_eq!(found.as_slice()[0].delta, 2e-6, max_relative = 1e-9);
    }
}

#[test]
fn arc_is_half_open_and_turns_do_not_matter() {
    let dent = solved(Race::Outer, source_shape(Race::Outer));
    let half = dent.half_angle();
    for turns in [0.0, 1.0, -7.0, 1e4] {
        let middle = MIDDLE + turns * TAU;
        assert!(dent.contains(middle));
        assert!(dent.contains(middle - half + 1e-9) && !dent.contains(middle - half - 1e-9));
        assert!(dent.contains(middle + half - 1e-9) && !dent.contains(middle + half + 1e-9));
    }
    // Half-open: the clockwise end belongs to the dent, the other does not. At angle 0 nothing rounds.
    let turned = |angle| solved(Race::Outer, DentShape { angle, ..source_shape(Race::Outer) });
    let level = turned(0.0);
    assert!(level.contains(-half) && !level.contains(half));
    // a dent across the seam of the angle
    let seam = turned(PI - 1e-3);
    assert!(seam.contains(-PI + 1e-3) && seam.contains(PI) && seam.contains(3.0 * PI));
    assert!(!seam.contains(0.0) && !seam.contains(f64::NAN));
    let other = turned(-PI + 1e-3);
    assert!(other.contains(PI - 1e-3) && other.contains(-PI) && !other.contains(0.0));
    let [near, same] = [PI + 0.01, -PI + 0.01].map(|angle| {
        let found = seam.contacts(PolarPosition { radius: 3.77e-3, angle });
        found.as_slice()[0].delta
    });
    assert_relative_eq!(near, same, epsilon = 1e-17);
}

#[test]
fn far_rim_is_met_by_a_ball_beside_a_short_dent() {
    for race in RACES {
        let source = solved(race, source_shape(race));
        let bridged = solved(race, dent_shape(0.2e-3, 15e-6, 20e-6));
        assert_relative_eq!(source.contact_half_angle(), source.half_angle());
        assert!(bridged.contact_half_angle() > 1.2 * bridged.half_angle());
        let features = |side: f64| -> Vec<Feature> {
            // the far rim, 0.2 mm away, is met at overlaps of c²/2 (1/ρ_b ∓ 1/R): 16 um and 27 um
            let place = at(&bridged, 40e-6, side * 1.03 * bridged.half_angle());
            bridged.contacts(place).pressing().map(|c| c.feature).collect()
        };
        assert_eq!(features(1.0), [Feature::RimBefore, Feature::Plain]);
        assert_eq!(features(-1.0), [Feature::Plain, Feature::RimAfter]);
    }
}

fn refuse(race: Race, shape: DentShape) -> BearingError {
    Dent::new(&source_bearing(), race, shape, source_stiffness()).unwrap_err()
}

#[test]
fn every_rule_fires_and_says_what_to_change() {
    for (shape, message) in [
        (DentShape { angle: f64::NAN, ..source_shape(Race::Outer) }, "defect angle_deg = NaN must be finite"),
        (dent_shape(0.0, 1e-6, 1e-5), "defect length = 0 must be positive and finite"),
        (dent_shape(1e-3, -1e-6, 1e-5), "defect depth = -0.000001 must be positive and finite"),
        (dent_shape(1e-3, 1e-6, f64::INFINITY), "defect rim_radius = inf must be positive and finite"),
        (
            dent_shape(1e-4, 3e-5, 1e-5),
            "defect depth 0.00003 m is more than a quarter of its length 0.0001 m: take a shallower or a longer dent",
        ),
    ] {
        for race in RACES {
            assert_eq!(refuse(race, shape).to_string(), message);
        }
    }
    let large = refuse(Race::Outer, dent_shape(60e-6, 15e-6, 50e-6)).to_string();
    assert!(large.starts_with("defect rim_radius 0.00005 m opens a dent of length 0.00006 m to 0.000"), "{large}");
    assert!(large.ends_with("more than 1.5 times: take a smaller rim_radius, or a longer or shallower dent"));
    for (race, too_long) in [
        (Race::Outer, dent_shape(8e-3, 1e-5, 1e-5)),
        (Race::Outer, dent_shape(7.4e-3, 1e-4, 3e-3)),
        (Race::Outer, dent_shape(40e-3, 1e-5, 1e-5)),
        (Race::Inner, dent_shape(4.4e-3, 1e-5, 1e-5)),
    ] {
        let error = refuse(race, too_long);
        assert!(error.to_string().contains("is more than a quarter of the race"), "{error}");
    }
    let sharp = refuse(Race::Outer, dent_shape(1e-3, 1e-5, 4.7e-9)).to_string();
    assert_eq!(
        sharp,
        "defect rim_radius = 0.0000000047 must be at least a millionth of the radius of the race or ball that it rounds"
    );
    let thick = refuse(Race::Inner, dent_shape(1e-3, 1e-5, 1.5e-3)).to_string();
    assert_eq!(thick, "defect rim_radius = 0.0015 must be at most half the radius of the race or ball that it rounds");
}

/// On the inner race the source's reading leaves out the race's own convexity: an ellipse as tight as the ball
/// is then conforming for Hertz theory although the ball does reach the bottom.
#[test]
fn a_conforming_reading_of_the_inner_race_is_refused() {
    let deep = DentShape { curvature: CurvatureReading::Paper, ..dent_shape(0.2e-3, 11e-6, 5e-6) };
    let total = DentShape { curvature: CurvatureReading::Total, ..deep };
    assert!(solved(Race::Inner, total).profile.reach.is_some());
    let error = refuse(Race::Inner, deep);
    let hertz = error.to_string().starts_with("contact on the defect: curvature ");
    assert!(hertz, "{error}");
}

/// In that reading the contact has faded where the ellipse alone is as tight as the ball, though the ball goes on
/// touching the floor there.
#[test]
fn the_reading_that_conforms_first_is_what_fades() {
    let dent = solved(Race::Inner, DentShape { curvature: CurvatureReading::Paper, ..source_shape(Race::Inner) });
    let (profile, steps) = (&dent.profile, 4000);
    let limit = profile.reach.unwrap().parameter;
    let mut conforming = 0;
    for i in 0..steps {
        // a ball pressed in by 10 um at each foot in turn
        let t = limit * f64::from(i) / f64::from(steps);
        let foot = profile.floor.at(t);
        let centre = foot.point.minus(foot.inward(-1.0).scaled(0.99e-3));
        let angle = MIDDLE + centre.along.atan2(centre.outward);
        let found = dent.contacts(PolarPosition { radius: centre.length(), angle });
        let Some(floor) = found.pressing().find(|c| c.feature == Feature::Floor) else {
            continue;
        };
        // the curvature that is touched differs from race and ellipse together by half a percent
        let relative = profile.floor_curvature(t);
        if relative < -10.0 {
            conforming += 1;
            assert!(floor.stiffness < 1e-3, "{} at {t}", floor.stiffness);
        } else if relative > 10.0 {
            assert!(floor.stiffness > 1e3, "{} at {t}", floor.stiffness);
        }
    }
    assert!(conforming > 20, "only {conforming}");
}
