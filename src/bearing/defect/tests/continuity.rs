//! Force vector and k over paths of ball positions: what remains of the largest change in ever smaller steps.

use super::*;

/// Force on the race (radial, tangential; N) and the stiffnesses of all contacts (N for 1e-8 m^1.5). A contact's
/// stiffness counts in proportion to its overlap below 0.2 um: it is continuous up to where it begins.
fn response(subject: &Subject, sunk: f64, offset: f64) -> [f64; 3] {
    let found = subject.contacts(sunk, offset);
    let mut sum = [0.0; 3];
    for c in found.pressing() {
        let force = c.stiffness * c.delta * c.delta.sqrt();
        sum[0] += force * c.normal_radial;
        sum[1] += force * c.normal_tangential;
        sum[2] += c.stiffness * 1e-8 * (c.delta / 0.2e-6).min(1.0);
    }
    sum
}

/// Halvings of a step, 0.8 um of a ball's way, until the fastest fades (nanometres, on the scratched pit) are
/// resolved, and then those over which the change must fall.
const RESOLVING: i32 = 13;
const HALVINGS: i32 = 14;

/// Steps of a path, and how many of the least smooth ones are followed.
const STEPS: usize = 2000;
const FOLLOWED: usize = 60;

/// Largest change left after following the larger half [`RESOLVING`] times, and [`HALVINGS`] times more.
fn remaining_jump(place: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> [f64; 2] {
    let (mut at_low, mut at_high) = (place(low), place(high));
    let mut resolved = 0.0;
    for halving in 0..RESOLVING + HALVINGS {
        if halving == RESOLVING {
            resolved = (at_high - at_low).abs();
        }
        let middle = 0.5 * (low + high);
        let value = place(middle);
        if (value - at_low).abs() > (at_high - value).abs() {
            (high, at_high) = (middle, value);
        } else {
            (low, at_low) = (middle, value);
        }
    }
    [resolved, (at_high - at_low).abs()]
}

/// Sweeps at fixed overlap, from none to one that presses rims and floor together, and slanted ones that
/// press far in where contacts fade. On each the steps that differ most from their neighbours are followed: the
/// change must fall by 1.7 or more for every halving of the step, down to rounding (1e-6 N: 1e-18 m on a
/// length at 1e10 N/m, the steepest fade, a hundred times over). A jump would stay.
#[test]
fn force_and_stiffness_are_continuous_in_position() {
    for (name, subject) in every_subject() {
        let wide = 1.2 * subject.contact_half_angle();
        let level = [-1e-6, 0.5e-6, 2e-6, 5e-6, 15e-6, 25e-6].map(|sunk| ([sunk, -wide], [sunk, wide]));
        let slanted = [
            ([30e-6, -wide], [0.0, wide]),
            ([2e-6, 0.9 * wide], [40e-6, -0.3 * wide]),
            ([-5e-6, 0.1 * wide], [60e-6, 0.2 * wide]),
        ];
        for (from, to) in level.into_iter().chain(slanted) {
            let place = |x: f64| {
                let mix = |i: usize| from[i] + x * (to[i] - from[i]);
                response(subject, mix(0), mix(1))
            };
            let values: Vec<_> = (0..=STEPS).map(|i| place(i as f64 / STEPS as f64)).collect();
            for entry in [0, 1, 2] {
                let change = |i: usize| values[i + 1][entry] - values[i][entry];
                let roughness = |i: usize| (change(i) - 0.5 * (change(i - 1) + change(i + 1))).abs();
                let mut worst: Vec<usize> = (1..STEPS - 1).collect();
                worst.sort_by(|&a, &b| roughness(b).total_cmp(&roughness(a)));
                for &i in &worst[..FOLLOWED] {
                    let [low, high] = [i, i + 1].map(|i| i as f64 / STEPS as f64);
                    let [before, left] = remaining_jump(&|x| place(x)[entry], low, high);
                    let allowed = before * 1.7_f64.powi(-HALVINGS) + 1e-6;
                    assert!(
                        left <= allowed,
                        "{name}, entry {entry}: {left} N of {before} N left at {low} of {from:?} to {to:?}"
                    );
                }
            }
        }
    }
}

/// Where a contact comes, goes or passes from feature to feature: the border is found to the last digit by halving,
/// and both sides of it agree to 1e-6 N (as above), for every such change on many straight paths.
#[test]
fn nothing_jumps_where_contacts_change() {
    let mut numbers = Numbers(23);
    let mut borders = 0;
    for (name, subject) in every_subject() {
        borders += borders_of(name, subject, &mut numbers);
    }
    assert!(borders > 1000, "only {borders}");
}

/// The same over dents in three dimensions of any proportions, many of them about as curved along their outline as the ball.
#[test]
fn nothing_jumps_on_random_dents_in_space() {
    let mut numbers = Numbers(31);
    let mut borders = 0;
    for i in 0..120 {
        let race = [Race::Outer, Race::Inner][i % 2];
        let length = numbers.between(0.1e-3, 0.6e-3);
        let depth = numbers.between(1e-6, 0.05 * length);
        let ratio = numbers.between(0.3, 3.0);
        let rim = numbers.between(10e-6, 0.2 * length);
        let shape = surface::conforming(race, length, ratio, depth, rim);
        let (bearing, stiffness) = (source_bearing(), source_stiffness());
        let Ok(dent) = SurfaceDent::new(&bearing, race, shape, stiffness) else {
            continue;
        };
        let subject = Subject::race(RaceDefect::SurfaceDent(dent));
        borders += borders_of("random dent in space", &subject, &mut numbers);
    }
    assert!(borders > 1000, "only {borders}");
}

/// Checks the borders on random paths over a subject, and counts them.
fn borders_of(name: &str, subject: &Subject, numbers: &mut Numbers) -> u32 {
    const STEPS: u32 = 400;
    let mut borders = 0;
    let wide = 1.1 * subject.contact_half_angle();
    for _ in 0..24 {
        let end = |numbers: &mut Numbers| [-2e-6 + 30e-6 * numbers.next(), wide * (2.0 * numbers.next() - 1.0)];
        let (from, to) = (end(numbers), end(numbers));
        let mix = |x: f64, i: usize| from[i] + x * (to[i] - from[i]);
        let features = |x: f64| {
            let found = subject.contacts(mix(x, 0), mix(x, 1));
            let place = |sum: u32, c: &DefectContact| 8 * sum + 1 + c.feature as u32;
            found.pressing().fold(0, place)
        };
        let mut before = features(0.0);
        for i in 0..STEPS {
            let [mut low, mut high] = [i, i + 1].map(|i| f64::from(i) / f64::from(STEPS));
            let after = features(high);
            if after == before {
                continue;
            }
            for _ in 0..48 {
                let middle = 0.5 * (low + high);
                if features(middle) == before {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let [left, right] = [low, high].map(|x| response(subject, mix(x, 0), mix(x, 1)));
            for (a, b) in left.iter().zip(right) {
                assert!((a - b).abs() < 1e-6, "{name}: {left:?} {right:?} at {low} of {from:?} to {to:?}");
            }
            borders += 1;
            before = after;
        }
    }
    borders
}

/// At the last digits about a profile's ends there is one contact: on the race or on the profile, never on neither.
#[test]
fn a_profile_and_its_race_leave_no_gap() {
    let mut numbers = Numbers(29);
    for i in 0..400 {
        let race = [Race::Outer, Race::Inner][i % 2];
        let samples = sampled(numbers.between(0.5e-3, 2e-3), 8, |x| 5e-6 * (PI * x).sin());
        let subject = Subject::race(RaceDefect::Measured(profile(race, &samples)));
        let edge = subject.half_angle();
        for ulps in -20..=20 {
            let offset = edge * (1.0 + f64::from(ulps) * f64::EPSILON);
            for offset in [offset, -offset] {
                let found = subject.contacts(1e-6 * (1.0 + numbers.next()), offset);
                assert_eq!(found.pressing().count(), 1, "{race} {edge} {ulps}");
            }
        }
    }
}

/// Beside its arc every defect is the plain race, and at the arc's ends it passes into it.
#[test]
fn the_race_begins_where_the_arc_ends() {
    for (name, subject) in every_subject() {
        let (circles, edge) = (subject.circles, subject.half_angle());
        let outward = subject.contacts(3e-6, 1.5 * subject.contact_half_angle());
        let [plain] = outward.as_slice() else { panic!("{name}: one contact beside the arc") };
        assert_eq!(plain.feature, Feature::Plain);
        assert!((plain.delta - 3e-6).abs() < 2e-18, "{name}");
        assert!((plain.stiffness - circles.stiffness).abs() <= 0.0);
        for side in [-1.0, 1.0] {
            let deepest = |offset: f64| {
                let found = subject.contacts(3e-6, side * offset);
                let deeper = |a: DefectContact, b: DefectContact| if b.delta > a.delta { b } else { a };
                found.pressing().copied().reduce(deeper).unwrap()
            };
            let (outside, inside) = (deepest(edge * (1.0 + 1e-9)), deepest(edge * (1.0 - 1e-9)));
            assert_eq!(outside.feature, Feature::Plain, "{name}");
            assert_ne!(inside.feature, Feature::Plain, "{name}");
            assert!((outside.delta - inside.delta).abs() < 1e-15, "{name}");
            assert!((outside.stiffness / inside.stiffness - 1.0).abs() < 1e-6, "{name}");
            assert!((outside.normal_radial - inside.normal_radial).abs() < 1e-12);
            assert!(inside.normal_tangential.abs() < 1e-6, "{name}");
        }
    }
}

/// Dents, flats and even profiles are their own mirror image; an uneven profile is that of its mirrored samples.
#[test]
fn mirror_image() {
    let mut numbers = Numbers(8);
    let samples = scratched(60);
    let length = samples[60].0;
    let turned: Vec<_> = samples.iter().rev().map(|&(s, d)| (length - s, d)).collect();
    for (name, subject) in every_subject() {
        let image = match &subject.kind {
            Kind::Race(pit) if *name == "scratched pit" => {
                Subject::race(RaceDefect::Measured(profile(pit.race(), &turned)))
            }
            _ => subject.clone(),
        };
        for _ in 0..300 {
            let offset = 1.1 * subject.contact_half_angle() * numbers.next();
            let sunk = 25e-6 * numbers.next();
            let (right, left) = (response(subject, sunk, offset), response(&image, sunk, -offset));
            // a contact at the edge of fading may be counted on one side alone by rounding
            let scale = 1e-8 * (1.0 + right[0].abs() + right[2].abs());
            assert!((right[0] - left[0]).abs() < scale, "{name} {right:?} {left:?}");
            assert!((right[1] + left[1]).abs() < scale, "{name} {right:?} {left:?}");
            assert!((right[2] - left[2]).abs() < scale, "{name} {right:?} {left:?}");
        }
    }
}

/// Finite input gives finite contacts, and a NaN is passed on.
#[test]
fn no_nan_for_finite_positions() {
    let lengths = [0.0, 1e-300, -1e-3, 1e-3, 2.754e-3, 4.7565e-3, 4.8065e-3, 1e6, -1e150, 1e300];
    // a rim that rounding takes away
    let nothing = [Race::Outer, Race::Inner].map(|race| {
        let dent = solved(race, dent_shape(1e-3, 1e-300, 5e-5));
        ("vanishing dent", Subject::race(RaceDefect::Dent(dent)))
    });
    for (name, subject) in every_subject().chain(&nothing) {
        let middles = [0.0, 0.3, 0.999, 1.0, -1.0].map(|x| x * subject.half_angle());
        for offset in middles.into_iter().chain([0.5, PI, -1e9, 1e300]) {
            for distance in lengths {
                for c in subject.contacts_at(distance, offset).pressing() {
                    let numbers = [c.delta, c.normal_radial, c.normal_tangential, c.stiffness];
                    assert!(numbers.iter().all(|value| !value.is_nan()), "{name} at {distance}, {offset}: {c:?}");
                }
            }
            let lost = subject.contacts_at(f64::NAN, offset);
            assert!(lost.pressing().any(|c| c.delta.is_nan()), "{name}: NaN is lost");
        }
    }
}
