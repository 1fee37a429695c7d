//! Measured profiles: samples met, an ellipse told by samples, bridging, lips, rules.

use super::*;
use approx::assert_relative_eq;

const RACES: [Race; 2] = [Race::Outer, Race::Inner];

fn subject(race: Race, samples: &[(f64, f64)]) -> Subject {
    Subject::race(RaceDefect::Measured(profile(race, samples)))
}

/// The middle of the samples lies at the angle given, arc length grows counter-clockwise, depth goes into the race.
#[test]
fn the_profile_passes_through_its_samples() {
    let samples = scratched(60);
    for (race, radius, into) in [(Race::Outer, 4.7565e-3, 1.0), (Race::Inner, 2.754e-3, -1.0)] {
        let measured = profile(race, &samples);
        assert_eq!(measured.race(), race);
        assert_relative_eq!(measured.half_angle(), 0.5e-3 / radius, max_relative = 1e-12);
        for (s, depth) in &samples {
            let angle = MIDDLE + (s - 0.5e-3) / radius + 4.0 * PI;
            let expected = radius + into * depth;
            assert!((measured.profile_radius(angle) - expected).abs() < 1e-16);
        }
        let beside = MIDDLE + 1.01 * measured.half_angle();
        assert_relative_eq!(measured.profile_radius(beside), radius);
    }
}

/// Lips beside a scratch rise above the race; a profile without them does not.
#[test]
fn the_rise_is_that_of_the_highest_lip() {
    let depths = [0.0, 0.0, -0.8e-6, 2e-6, -1.3e-6, 0.0, 0.0];
    let samples: Vec<(f64, f64)> = (0..7).map(|i| 50e-6 * f64::from(i)).zip(depths).collect();
    for race in RACES {
        let measured = profile(race, &samples);
        let into = if race == Race::Outer { 1.0 } else { -1.0 };
        let race_radius = measured.profile_radius(MIDDLE + PI);
        let highest = (0..=20_000)
            .map(|i| (f64::from(i) / 10_000.0 - 1.0) * measured.half_angle())
            .map(|offset| into * (race_radius - measured.profile_radius(MIDDLE + offset)))
            .fold(0.0, f64::max);
        assert!(highest > 1.3e-6);
        let rise = measured.rise();
        assert!(highest <= rise && rise < 1.02 * highest, "{rise:e} {highest:e}");
        let sunk: Vec<(f64, f64)> = samples.iter().map(|&(s, depth)| (s, depth.abs())).collect();
        // what a spline overshoots
        assert!(profile(race, &sunk).rise() < 0.5e-6);
    }
}

/// The floor of the source's dent told by samples gives the contacts of the dent: overlap to the spline's error
/// (fourth power of the spacing, 20 um: below 1e-11 m), k to that of its curvature (second power).
#[test]
fn samples_of_a_dent_give_its_contacts() {
    for race in RACES {
        let dent = solved(race, source_shape(race));
        let radius = if race == Race::Outer { 4.7565e-3 } else { 2.754e-3 };
        let into = if race == Race::Outer { 1.0 } else { -1.0 };
        // unevenly, fine at the rims; beyond them the depth is zero
        let reach = 1.05 * dent.half_angle() * radius;
        let count = 400;
        let samples: Vec<(f64, f64)> = (0..=count)
            .map(|i| {
                let s = -reach * (PI * f64::from(i) / f64::from(count)).cos();
                (s, into * (dent.profile_radius(MIDDLE + s / radius) - radius))
            })
            .collect();
        let (told, given) = (subject(race, &samples), Subject::race(RaceDefect::Dent(dent.clone())));
        for i in -5..=5 {
            let offset = 0.1 * f64::from(i) * dent.half_angle();
            let floor = |subject: &Subject| {
                let found = subject.contacts(16e-6, offset);
                let flattest = |a: DefectContact, b: DefectContact| {
                    if b.normal_tangential.abs() < a.normal_tangential.abs() { b } else { a }
                };
                found.pressing().copied().reduce(flattest).unwrap()
            };
            let (a, b) = (floor(&told), floor(&given));
            assert_eq!((a.feature, b.feature), (Feature::Measured, Feature::Floor));
            assert!((a.delta - b.delta).abs() < 1e-11, "{race} {i}: {} {}", a.delta, b.delta);
            assert!((a.normal_tangential - b.normal_tangential).abs() < 1e-5, "{race} {i}");
            assert_relative_eq!(a.stiffness, b.stiffness, max_relative = 5e-3);
        }
        assert_relative_eq!(told_drop(&told), 15e-6, max_relative = 1e-4);
    }
}

fn told_drop(subject: &Subject) -> f64 {
    match &subject.kind {
        Kind::Race(defect) => defect.ball_drop(),
        Kind::Ball(flat, race) => flat.ball_drop(*race),
    }
}

/// Scratches finer than the ball can follow hold it at their crests: it sinks less than their depth, is never
/// touched at their bottoms, and rests on two crests at once between them.
#[test]
fn a_ball_bridges_what_it_cannot_follow() {
    let samples = sampled(1e-3, 200, |x| 2e-6 * (PI * 10.0 * x).sin().powi(2));
    for race in RACES {
        let subject = subject(race, &samples);
        let drop = told_drop(&subject);
        assert!(drop > 0.1e-6 && drop < 1.9e-6, "{race}: {drop}");
        let half = subject.half_angle();
        for i in -40..=40 {
            let offset = 0.02 * f64::from(i) * half;
            let deepest = |sunk: f64| {
                let found = subject.contacts(sunk, offset);
                found.pressing().map(|c| c.delta).fold(0.0, f64::max)
            };
            assert!(deepest(drop + 1e-9) > 0.0, "{race}: free at {offset} below the drop");
            // crests at the race's level are at most 50 um away: 1.6 um of sagitta under a ball, and 1 um of slack
            assert!(deepest(drop + 2.5e-6) > 0.5e-6);
        }
        // half way between two crests, 0.1 mm apart
        let between = 0.05e-3 / subject.circles.carrier;
        let found = subject.contacts(drop + 1e-7, between);
        let sides: Vec<f64> = found.pressing().map(|c| c.normal_tangential.signum()).collect();
        assert_eq!(sides, [-1.0, 1.0], "{race}");
    }
}

/// The drop is the deepest place of all: nanometres higher there is an angle at which nothing presses (tried every
/// 25 nm, on flanks as steep as 0.1), a nanometre deeper there is none.
#[test]
fn the_drop_is_that_of_the_deepest_angle() {
    for race in RACES {
        let subject = subject(race, &scratched(60));
        let drop = told_drop(&subject);
        let free = |sunk: f64| {
            (-20_000..20_000).any(|i| {
                let offset = subject.half_angle() * f64::from(i) / 20_000.0;
                subject.contacts(sunk, offset).pressing().count() == 0
            })
        };
        assert!(free(drop - 4e-9), "{race}");
        assert!(!free(drop + 1e-9), "{race}");
    }
}

/// A raised lip is met by a ball beside the profile, before it is over the first sample.
#[test]
fn a_lip_is_met_from_beside() {
    // 6 um high, 40 um from the ends
    let samples = sampled(0.4e-3, 40, |x| {
        let sine = (PI * x).sin();
        12e-6 * sine.powi(6) - 240e-6 * sine * sine * (2.0 * x - 1.0).powi(6)
    });
    for race in RACES {
        let subject = subject(race, &samples);
        assert!(subject.contact_half_angle() > 1.1 * subject.half_angle(), "{race}");
        let beside = 1.05 * subject.half_angle();
        let features = |sunk: f64, offset: f64| -> Vec<Feature> {
            subject.contacts(sunk, offset).pressing().map(|c| c.feature).collect()
        };
        // not pressed into the race yet, and pressed into it
        assert_eq!(features(-0.1e-6, beside), [Feature::Measured], "{race}");
        assert_eq!(features(1e-6, -beside), [Feature::Plain, Feature::Measured]);
        assert_eq!(features(1e-6, beside), [Feature::Measured, Feature::Plain]);
    }
}

/// Nine crests under one ball: the eight with the largest overlaps are kept, in order of angle.
#[test]
fn of_many_contacts_the_strongest_are_kept() {
    let samples = sampled(0.3e-3, 300, |x| 0.05e-6 * (1.0 - (60.0 * PI * x).cos()));
    let subject = subject(Race::Outer, &samples);
    let found = subject.contacts(20e-6, 0.0);
    let all: Vec<&DefectContact> = found.pressing().collect();
    assert_eq!(all.len(), MOST_CONTACTS);
    assert!(all.windows(2).all(|pair| pair[0].normal_tangential < pair[1].normal_tangential));
    // the nearest crests are deepest: 5 um apart, within 50 um of the middle all are kept that are nearest
    assert!(all.iter().all(|c| c.normal_tangential.abs() < 0.055));
}

#[test]
fn steep_profiles_name_their_samples() {
    let mut samples = scratched(60);
    samples[30].1 += 60e-6;
    let (bearing, stiffness) = (source_bearing(), source_stiffness());
    let refused = |angle, samples: &[(f64, f64)]| {
        MeasuredProfile::new(&bearing, Race::Inner, angle, samples, stiffness).unwrap_err()
    };
    let message = refused(0.0, &samples).to_string();
    assert!(
        message.starts_with("defect profile is as steep as ")
            && message.contains("between samples 31 and 32, at most 1 is possible"),
        "{message}"
    );
    samples[30].1 = f64::NAN;
    assert_eq!(refused(0.0, &samples).to_string(), "defect profile, sample 31: depth NaN m must be finite");
    assert_eq!(refused(f64::INFINITY, &samples).to_string(), "defect angle_deg = inf must be finite");
    // differences that vanish against the square of a spacing are refused, not divided by
    let tiny = [(0.0, 0.0), (1e-200, 1e-210), (1e-3, 1e-6), (2e-3, 0.0)];
    assert!(refused(0.0, &tiny).to_string().starts_with("defect profile is as steep as "));
}
