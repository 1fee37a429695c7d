//! The source's dent by number, rules, continuity over positions, and δ against its normal.

use super::*;
use crate::bearing::dent::contacts::MOST_CONTACTS;
use crate::bearing::dent::contacts::{DentContact, DentFeature};
use crate::bearing::dent::shape::DEFAULT_RIM_RADIUS;
use crate::bearing::dent::shape::DentCurvature;
use crate::bearing::samples::{source_bearing, source_stiffness};
use crate::closed_form::hertz::{self, PrincipalCurvatures};
use approx::assert_relative_eq;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

pub(super) const MIDDLE: f64 = -1.3;

pub(super) fn shape(length: f64, depth: f64, rim_radius: f64) -> DentShape {
    DentShape {
        angle: MIDDLE,
        length,
        depth,
        rim_radius,
        curvature: DentCurvature::Total,
    }
}

/// The source's Figure 8b.
pub(super) fn source_shape() -> DentShape {
    shape(0.75e-3, 15e-6, DEFAULT_RIM_RADIUS)
}

pub(super) fn solved(shape: DentShape) -> OuterDent {
    OuterDent::new(&source_bearing(), shape, source_stiffness()).unwrap()
}

/// Dents of every kind: touched at the bottom; bridged, floor too tight; both at once; shallow; with a
/// contact that passes from floor to rim.
pub(super) fn kinds() -> &'static [OuterDent; 5] {
    &KINDS
}

static KINDS: LazyLock<[OuterDent; 5]> = LazyLock::new(|| {
    [
        solved(source_shape()),
        solved(shape(0.2e-3, 15e-6, 20e-6)),
        solved(shape(0.4e-3, 15e-6, 50e-6)),
        solved(shape(0.75e-3, 4e-6, 50e-6)),
        solved(shape(3e-3, 15e-6, 10e-3)),
    ]
});

pub(super) fn at(dent: &OuterDent, sunk: f64, offset: f64) -> PolarPosition {
    PolarPosition {
        radius: dent.race_radius - dent.ball_radius + sunk,
        angle: MIDDLE + offset,
    }
}

#[test]
fn kinds_are_what_they_are_said_to_be() {
    let [source, bridged, both, shallow, passing] = kinds();
    for touched in [source, both, shallow] {
        assert!(touched.reach.is_some_and(|reach| !reach.meets_rim));
    }
    assert!(bridged.reach.is_none());
    assert!(passing.reach.is_some_and(|reach| reach.meets_rim));
}

#[test]
fn ball_sinks_to_the_bottom_of_the_source_dent() {
    let dent = solved(source_shape());
    assert_relative_eq!(dent.drop(), 15e-6, max_relative = 1e-12);
    assert_relative_eq!(dent.bottom_radius(), 3.16e-3, max_relative = 2e-3);
}

/// At its drop, and only there, a ball at the middle touches without pressing.
#[test]
fn drop_is_where_the_deepest_contact_just_touches() {
    for dent in kinds() {
        let deepest = |sunk: f64| {
            let found = dent.contacts(at(dent, sunk, 0.0));
            found
                .as_slice()
                .iter()
                .map(|c| c.delta)
                .fold(f64::NEG_INFINITY, f64::max)
        };
        assert!(deepest(dent.drop()).abs() < 1e-15);
        assert!(deepest(dent.drop() - 1e-9) < 0.0 && deepest(dent.drop() + 1e-9) > 0.0);
    }
    let bridged = solved(shape(0.2e-3, 15e-6, 20e-6));
    assert!(bridged.drop() > 3e-6 && bridged.drop() < 8e-6);
}

#[test]
fn bottom_contact_has_hertz_stiffness_of_its_curvature() {
    let paper = DentShape {
        curvature: DentCurvature::Paper,
        ..source_shape()
    };
    let flat = 15e-6 / (0.375e-3 * 0.375e-3);
    for (shape, curvature) in [(source_shape(), 1.0 / 4.7565e-3 + flat), (paper, flat)] {
        let dent = solved(shape);
        let found = dent.contacts(at(&dent, 16e-6, 0.0));
        let [bottom] = found.as_slice() else {
            panic!("one contact at the middle")
        };
        assert_eq!(bottom.feature, DentFeature::Floor);
        assert_relative_eq!(bottom.delta, 1e-6, max_relative = 1e-9);
        assert_relative_eq!(bottom.normal_radial, 1.0, max_relative = 1e-14);
        let floor = PrincipalCurvatures {
            plane_1: -1.0 / 1.07e-3,
            plane_2: -curvature,
        };
        let modulus = hertz::effective_modulus([206e9; 2], [0.3; 2]).unwrap();
        let direct = hertz::stiffness(PrincipalCurvatures::sphere(1e-3), floor, modulus).unwrap();
        assert_relative_eq!(bottom.stiffness, direct.stiffness, max_relative = 1e-6);
    }
}

#[test]
fn past_the_blend_the_rim_has_hertz_stiffness_of_its_radius() {
    let dent = solved(source_shape());
    let found = dent.contacts(at(&dent, 5e-6, dent.half_angle() - 0.03));
    let contact = found
        .as_slice()
        .iter()
        .find(|c| c.feature == DentFeature::RimAfter)
        .unwrap();
    let rim = PrincipalCurvatures {
        plane_1: -1.0 / 1.07e-3,
        plane_2: 2e4,
    };
    let modulus = hertz::effective_modulus([206e9; 2], [0.3; 2]).unwrap();
    let direct = hertz::stiffness(PrincipalCurvatures::sphere(1e-3), rim, modulus).unwrap();
    assert_relative_eq!(contact.stiffness, direct.stiffness, max_relative = 1e-6);
    assert!(
        contact.normal_tangential > 0.0,
        "the rim after the dent lies ahead of the ball"
    );
}

#[test]
fn arc_is_half_open_and_turns_do_not_matter() {
    let dent = solved(source_shape());
    let half = dent.half_angle();
    for turns in [0.0, 1.0, -7.0, 1e4] {
        let middle = MIDDLE + turns * TAU;
        assert!(dent.contains(middle));
        assert!(dent.contains(middle - half + 1e-9) && !dent.contains(middle - half - 1e-9));
        assert!(dent.contains(middle + half - 1e-9) && !dent.contains(middle + half + 1e-9));
    }
    // Half-open: the clockwise end belongs to the dent, the other does not. At angle 0 nothing rounds.
    let level = solved(DentShape {
        angle: 0.0,
        ..source_shape()
    });
    assert!(level.contains(-half) && !level.contains(half));
    // a dent across the seam of the angle
    let seam = solved(DentShape {
        angle: PI - 1e-3,
        ..source_shape()
    });
    assert!(seam.contains(-PI + 1e-3) && seam.contains(PI) && seam.contains(3.0 * PI));
    assert!(!seam.contains(0.0) && !seam.contains(f64::NAN));
    let other = solved(DentShape {
        angle: -PI + 1e-3,
        ..source_shape()
    });
    assert!(other.contains(PI - 1e-3) && other.contains(-PI) && !other.contains(0.0));
    let near = seam.contacts(PolarPosition {
        radius: 3.77e-3,
        angle: PI + 0.01,
    });
    let same = seam.contacts(PolarPosition {
        radius: 3.77e-3,
        angle: -PI + 0.01,
    });
    assert_relative_eq!(
        near.as_slice()[0].delta,
        same.as_slice()[0].delta,
        epsilon = 1e-17
    );
}

#[test]
fn every_rule_fires_and_says_what_to_change() {
    let refuse = |shape| {
        OuterDent::new(&source_bearing(), shape, source_stiffness())
            .unwrap_err()
            .to_string()
    };
    for (shape, message) in [
        (
            DentShape {
                angle: f64::NAN,
                ..source_shape()
            },
            "defect angle_deg = NaN must be finite",
        ),
        (
            shape(0.0, 1e-6, 1e-5),
            "defect length = 0 must be positive and finite",
        ),
        (
            shape(1e-3, -1e-6, 1e-5),
            "defect depth = -0.000001 must be positive and finite",
        ),
        (
            shape(1e-3, 1e-6, f64::INFINITY),
            "defect rim_radius = inf must be positive and finite",
        ),
        (
            shape(1e-4, 3e-5, 1e-5),
            "defect depth 0.00003 m is more than a quarter of its length 0.0001 m: take a shallower or a longer dent",
        ),
    ] {
        assert_eq!(refuse(shape), message);
    }
    let large = refuse(shape(60e-6, 15e-6, 50e-6));
    assert!(
        large.starts_with("defect rim_radius 0.00005 m opens a dent of length 0.00006 m to 0.000"),
        "{large}"
    );
    assert!(large.ends_with(
        "more than 1.5 times: take a smaller rim_radius, or a longer or shallower dent"
    ));
    for too_long in [
        shape(8e-3, 1e-5, 1e-5),
        shape(7.4e-3, 1e-4, 3e-3),
        shape(40e-3, 1e-5, 1e-5),
    ] {
        let error = OuterDent::new(&source_bearing(), too_long, source_stiffness()).unwrap_err();
        assert!(matches!(error, DentError::TooLong { .. }), "{error}");
    }
}

/// Force on the race (radial, tangential; N) and the stiffnesses of all contacts (N for 1e-8 m^1.5). A contact's
/// stiffness counts in proportion to its overlap below 0.2 um: it is continuous up to where it begins.
fn response(dent: &OuterDent, ball: PolarPosition) -> [f64; 3] {
    let found = dent.contacts(ball);
    let mut sum = [0.0; 3];
    for c in found.pressing() {
        let force = c.stiffness * c.delta * c.delta.sqrt();
        sum[0] += force * c.normal_radial;
        sum[1] += force * c.normal_tangential;
        sum[2] += c.stiffness * 1e-8 * (c.delta / 0.2e-6).min(1.0);
    }
    sum
}

/// Largest change over an interval of the line, after following the larger change into ever smaller ones.
fn remaining_jump(
    place: &impl Fn(f64) -> [f64; 3],
    mut low: f64,
    mut high: f64,
    entry: usize,
) -> f64 {
    let mut largest = 0.0;
    for _ in 0..9 {
        let width = (high - low) / 8.0;
        let values: Vec<f64> = (0..=8)
            .map(|i| place(low + width * f64::from(i))[entry])
            .collect();
        let mut at = 0;
        largest = 0.0;
        for (i, pair) in values.windows(2).enumerate() {
            let jump = (pair[1] - pair[0]).abs();
            if jump > largest {
                (largest, at) = (jump, i);
            }
        }
        low += width * at as f64;
        high = low + width;
    }
    largest
}

/// A jump would remain in however small an interval; a slope does not: 1e-4 N in 5e-15 m would be several
/// times the stiffest fade. Sweeps at fixed radius, and slanted ones that press a ball far into rim and
/// floor together, where contacts fade. Any change above 0.01 N is followed.
#[test]
fn force_and_stiffness_are_continuous_in_position() {
    for (kind, dent) in kinds().iter().enumerate() {
        let wide = 1.2 * dent.contact_half_angle();
        let level =
            [0.5e-6, 2e-6, 5e-6, 10e-6, 15e-6, 25e-6].map(|sunk| ([sunk, -wide], [sunk, wide]));
        let slanted = [
            ([30e-6, -wide], [0.0, wide]),
            ([2e-6, 0.9 * wide], [40e-6, -0.3 * wide]),
            ([-5e-6, 0.1 * wide], [60e-6, 0.2 * wide]),
        ];
        for (from, to) in level.into_iter().chain(slanted) {
            let place = |x: f64| {
                let mix = |i: usize| from[i] + x * (to[i] - from[i]);
                response(dent, at(dent, mix(0), mix(1)))
            };
            let values: Vec<_> = (0..=1000).map(|i| place(f64::from(i) * 1e-3)).collect();
            for (i, pair) in values.windows(2).enumerate() {
                for (entry, value) in pair[1].iter().enumerate() {
                    if (value - pair[0][entry]).abs() > 0.01 {
                        let low = i as f64 * 1e-3;
                        let jump = remaining_jump(&place, low, low + 1e-3, entry);
                        assert!(
                            jump < 1e-4,
                            "kind {kind}, entry {entry}: {jump} N at {low} of {from:?} to {to:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn far_rim_is_met_by_a_ball_beside_a_short_dent() {
    let [source, bridged, ..] = kinds();
    assert_relative_eq!(source.contact_half_angle(), source.half_angle());
    assert!(bridged.contact_half_angle() > 2.0 * bridged.half_angle());
    let beside = bridged.contacts(at(bridged, 20e-6, 1.03 * bridged.half_angle()));
    let features: Vec<_> = beside.pressing().map(|c| c.feature).collect();
    assert_eq!(features, [DentFeature::RimBefore, DentFeature::Race]);
    let other = bridged.contacts(at(bridged, 20e-6, -1.03 * bridged.half_angle()));
    let features: Vec<_> = other.pressing().map(|c| c.feature).collect();
    assert_eq!(features, [DentFeature::Race, DentFeature::RimAfter]);
}

#[test]
fn ball_on_the_race_at_the_arc_has_the_race_contact() {
    for dent in kinds() {
        for side in [-1.0, 1.0] {
            let edge = side * dent.half_angle();
            let outside = dent.contacts(at(dent, 3e-6, edge * (1.0 + 1e-9)));
            let inside = dent.contacts(at(dent, 3e-6, edge * (1.0 - 1e-9)));
            let (race, rim) = (deepest(outside.as_slice()), deepest(inside.as_slice()));
            assert_eq!(race.feature, DentFeature::Race);
            assert_relative_eq!(race.delta, 3e-6, max_relative = 1e-9);
            assert_relative_eq!(race.delta, rim.delta, epsilon = 1e-15);
            assert_relative_eq!(race.stiffness, rim.stiffness, max_relative = 1e-6);
            assert_relative_eq!(rim.normal_radial, 1.0, max_relative = 1e-12);
        }
    }
}

fn deepest(found: &[DentContact]) -> DentContact {
    found
        .iter()
        .copied()
        .reduce(|a, b| if b.delta > a.delta { b } else { a })
        .unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Envelope theorem: with k held, `−dV/dρ` and `−dV/(ρ dθ)` are the force's components, because
    /// δ's gradient is the unit normal.
    #[test]
    fn gradient_of_overlap_is_the_normal(kind in 0..5_usize, x in -1.1..1.1_f64, sunk in -2e-6..25e-6_f64) {
        let dent = &kinds()[kind];
        let ball = at(dent, sunk, x * dent.half_angle());
        let h = 1e-9;
        let find = |feature, dr: f64, dt: f64| {
            let moved = PolarPosition { radius: ball.radius + dr, angle: ball.angle + dt / ball.radius };
            let found = dent.contacts(moved);
            found.as_slice().iter().find(|c| c.feature == feature).map(|c| c.delta)
        };
        let found = dent.contacts(ball);
        prop_assert!(found.as_slice().len() <= MOST_CONTACTS);
        for c in found.pressing() {
            let norm = c.normal_radial.hypot(c.normal_tangential);
            prop_assert!((norm - 1.0).abs() < 1e-14);
            let ends = [find(c.feature, h, 0.0), find(c.feature, -h, 0.0), find(c.feature, 0.0, h), find(c.feature, 0.0, -h)];
            let [Some(out), Some(back), Some(ahead), Some(behind)] = ends else { continue };
            let energy = |delta: f64| 0.4 * c.stiffness * delta.max(0.0).powf(2.5);
            let force = c.stiffness * c.delta.powf(1.5);
            prop_assert!(((out - back) / (2.0 * h) - c.normal_radial).abs() < 2e-6);
            prop_assert!(((ahead - behind) / (2.0 * h) - c.normal_tangential).abs() < 2e-6);
            if c.delta > 0.5e-6 {
                let radial = (energy(out) - energy(back)) / (2.0 * h);
                let tangential = (energy(ahead) - energy(behind)) / (2.0 * h);
                prop_assert!((radial - force * c.normal_radial).abs() < 1e-4 * force);
                prop_assert!((tangential - force * c.normal_tangential).abs() < 1e-4 * force);
            }
        }
    }

    /// The dent is its own mirror image.
    #[test]
    fn mirror_image(kind in 0..5_usize, x in 0.0..0.999_f64, sunk in 0.0..25e-6_f64) {
        let dent = &kinds()[kind];
        let sum = |offset: f64| response(dent, at(dent, sunk, offset));
        let (right, left) = (sum(x * dent.half_angle()), sum(-x * dent.half_angle()));
        let scale = 1e-9 * (1.0 + right[0].abs() + right[2].abs());
        prop_assert!((right[0] - left[0]).abs() < scale);
        prop_assert!((right[1] + left[1]).abs() < scale);
        prop_assert!((right[2] - left[2]).abs() < scale);
    }
}
