//! Dents in three dimensions: drops, limits and rules.

use super::super::surface::Outline;
use super::*;
use crate::bearing::hertz::{self, PrincipalCurvatures};
use approx::assert_relative_eq;

pub const RACES: [Race; 2] = [Race::Outer, Race::Inner];

/// The source's dent with its width.
pub fn source_surface(race: Race) -> DentShape {
    wide(
        source_shape(race),
        match race {
            Race::Outer => 0.41e-3,
            Race::Inner => 0.2e-3,
        },
    )
}

fn wide(shape: DentShape, width: f64) -> DentShape {
    DentShape { width: Some(width), ..shape }
}

pub fn surface_dent(race: Race, shape: DentShape) -> SurfaceDent {
    SurfaceDent::new(&source_bearing(), race, shape, source_stiffness()).unwrap()
}

pub fn source_outline(race: Race) -> Outline {
    surface_dent(race, source_surface(race)).outline
}

fn groove(race: Race) -> f64 {
    match race {
        Race::Outer => 1.07e-3,
        Race::Inner => 1.04e-3,
    }
}

/// κ_t and κ_l, 1/m.
fn relative_curvatures(race: Race) -> [f64; 2] {
    let along = match race {
        Race::Outer => 1e3 - 1.0 / 4.7565e-3,
        Race::Inner => 1e3 + 1.0 / 2.754e-3,
    };
    [1e3 - 1.0 / groove(race), along]
}

/// Length, width (m) and more of dents by `κ_t c² / (κ_l a²)`.
pub fn conforming(race: Race, length: f64, ratio: f64, depth: f64, rim_radius: f64) -> DentShape {
    let [across, along] = relative_curvatures(race);
    let width = length * (ratio * along / across).sqrt();
    wide(dent_shape(length, depth, rim_radius), width)
}

/// Dents in three dimensions in either race: the source's; long and narrow; so shallow and wide that the floor holds the
/// ball; floor and side edges together; short and wide, held by both vertices; with an outline as curved as the ball; and
/// nearly as wide as the ball, with up to two pairs.
pub fn subjects() -> &'static [(&'static str, Subject)] {
    &SUBJECTS
}

static SUBJECTS: LazyLock<Vec<(&'static str, Subject)>> = LazyLock::new(|| {
    let mut all = Vec::new();
    for race in RACES {
        for (name, shape) in [
            ("source's dent in space", source_surface(race)),
            ("groove in space", wide(dent_shape(2e-3, 10e-6, 50e-6), 0.1e-3)),
            ("shallow dent in space", wide(dent_shape(0.75e-3, 3e-6, 50e-6), 0.9e-3)),
            ("even dent in space", wide(dent_shape(0.75e-3, 3e-6, 20e-6), 0.62e-3)),
            ("short dent in space", conforming(race, 0.12e-3, 1.8, 8e-6, 20e-6)),
            ("conforming dent in space", conforming(race, 0.16e-3, 1.0, 15e-6, 20e-6)),
            ("widest dent in space", wide(dent_shape(0.5e-3, 40e-6, 50e-6), 1.8e-3)),
        ] {
            let dent = surface_dent(race, shape);
            all.push((name, Subject::race(RaceDefect::SurfaceDent(dent))));
        }
    }
    all
});

/// Place of a ball that overlaps the undamaged race by `sunk`.
pub fn at(dent: &SurfaceDent, sunk: f64, offset: f64) -> PolarPosition {
    let subject = Subject::race(RaceDefect::SurfaceDent(dent.clone()));
    PolarPosition { radius: subject.distance(sunk), angle: MIDDLE + offset }
}

/// A ball at the middle of a dent that it bridges rests on a sphere of the rim's radius on either side: in the plane
/// across the race its centre lies `(r_g + r) sin ψ` beside and `(r_g + r) cos ψ` from the groove's own, `sin ψ = c/r_g`.
/// To second order that is `κ_t c²/2`: 1.37 and 0.19 um, where the same dents are 15 um deep in the plane.
#[test]
fn drops_of_the_source_dents() {
    for (race, second_order) in [(Race::Outer, 1.374e-6), (Race::Inner, 0.1923e-6)] {
        let shape = source_surface(race);
        let dent = surface_dent(race, shape);
        let (r_g, r, ball) = (groove(race), shape.rim_radius, 1e-3);
        let sine = 0.5 * shape.width.unwrap() / r_g;
        let beside = (r_g + r) * sine;
        let down = (r_g + r) * (1.0 - sine * sine).sqrt();
        let height = ((ball + r) * (ball + r) - beside * beside).sqrt();
        let drop = down - height - (r_g - ball);
        // rounding of lengths of 5 mm
        assert!((dent.ball_drop() - drop).abs() < 1e-17, "{} {drop}", dent.ball_drop());
        // the next order: c²/4 (1/ρ_b² + 1/(ρ_b r_g) + 1/r_g²) and the drop itself, 3 %
        assert_relative_eq!(dent.ball_drop(), second_order, max_relative = 0.035);
        assert_relative_eq!(solved(race, shape).ball_drop(), 15e-6, max_relative = 1e-12);
    }
}

/// At its drop, and only there, a ball at the middle touches without pressing; the widest shapes rest on both vertices,
/// the shallow ones on the floor.
#[test]
fn drop_is_where_the_deepest_contact_just_touches_in_space() {
    for (name, subject) in subjects() {
        let Kind::Race(defect) = &subject.kind else { panic!("{name}") };
        let drop = defect.ball_drop();
        let deepest =
            |sunk: f64| {
                let found = subject.contacts(sunk, 0.0);
                let first = found.as_slice().iter();
                first.fold((f64::NEG_INFINITY, Feature::Plain), |best, c| {
                    if c.delta > best.0 { (c.delta, c.feature) } else { best }
                })
            };
        let (delta, feature) = deepest(drop);
        assert!(delta.abs() < 1e-15, "{name}: {delta}");
        assert!(deepest(drop - 1e-9).0 < 0.0 && deepest(drop + 1e-9).0 > 0.0);
        let expected = match *name {
            "short dent in space" => &[Feature::RimBefore, Feature::RimAfter][..],
            "shallow dent in space" => &[Feature::Floor],
            "even dent in space" => &[Feature::Floor, Feature::SideEdges],
            "source's dent in space" | "groove in space" => &[Feature::SideEdges],
            _ => continue,
        };
        assert!(expected.contains(&feature), "{name}: {feature:?}");
    }
}

fn steel_stiffness(curvatures: [f64; 2]) -> f64 {
    let modulus = hertz::effective_modulus([206e9; 2], [0.3; 2]).unwrap();
    let bodies = PrincipalCurvatures { plane_1: curvatures[0], plane_2: curvatures[1] };
    let flat = PrincipalCurvatures::flat();
    hertz::stiffness(bodies, flat, modulus).unwrap().stiffness
}

/// At the side of a wide dent, past the blend and apart, a pair is two contacts of the rim's radius across and the race's
/// relative curvature along; its normals lean by `sin ψ e / d`.
#[test]
fn side_edges_are_two_contacts_of_their_own_curvatures() {
    for race in RACES {
        let [_, along] = relative_curvatures(race);
        // a groove near conformity needs more width for the same slope
        let width = match race {
            Race::Outer => 1.8e-3,
            Race::Inner => 1.99e-3,
        };
        let shape = wide(dent_shape(2e-3, 100e-6, 30e-6), width);
        let dent = surface_dent(race, shape);
        let found = dent.contacts(at(&dent, dent.ball_drop() + 12e-6, 0.0));
        let [pair] = found.as_slice() else { panic!("one pair at the middle: {found:?}") };
        assert_eq!(pair.feature, Feature::SideEdges);
        assert!(pair.normal_radial.abs() < 1.0 && pair.normal_tangential.abs() < 1e-12);
        let both = 2.0 * steel_stiffness([1e3 + 1.0 / 30e-6, along]);
        assert_relative_eq!(pair.stiffness, both, max_relative = 1e-6);
    }
}

/// The vertex is the rim of a dent in the plane that its own rim opens to the same arc.
#[test]
fn a_vertex_is_the_rim_in_the_plane() {
    for race in RACES {
        let shape = wide(dent_shape(0.75e-3, 15e-6, 50e-6), 1.2e-3);
        let dent = surface_dent(race, shape);
        let (mut low, mut high) = (0.6e-3, 0.75e-3);
        for _ in 0..60 {
            let length = 0.5 * (low + high);
            if solved(race, dent_shape(length, 15e-6, 50e-6)).half_angle() < dent.half_angle() {
                low = length;
            } else {
                high = length;
            }
        }
        let in_plane = solved(race, dent_shape(low, 15e-6, 50e-6));
        let mut compared = 0;
        for i in 0..100 {
            let offset = dent.half_angle() * f64::from(i) / 100.0;
            for side in [-1.0, 1.0] {
                let place = at(&dent, 20e-6, side * offset);
                let feature = [Feature::RimBefore, Feature::RimAfter][usize::from(side > 0.0)];
                let of = |found: DefectContacts| found.pressing().find(|c| c.feature == feature).copied();
                let Some(vertex) = of(dent.contacts(place)) else {
                    continue;
                };
                let rim = of(in_plane.contacts(place)).unwrap();
                assert!((vertex.delta - rim.delta).abs() < 1e-15);
                assert!((vertex.normal_tangential - rim.normal_tangential).abs() < 1e-11);
                assert_relative_eq!(vertex.stiffness, rim.stiffness, max_relative = 1e-6);
                compared += 1;
            }
        }
        assert!(compared >= 20, "only {compared}");
    }
}

/// Nearly as wide as the ball and shallow, the floor is that of the dent in the plane, and holds the ball.
#[test]
fn a_wide_shallow_dent_is_the_one_in_the_plane() {
    for race in RACES {
        let shape = wide(dent_shape(0.75e-3, 1.5e-6, 50e-6), 1.95e-3);
        let (dent, in_plane) = (surface_dent(race, shape), solved(race, shape));
        assert_relative_eq!(dent.ball_drop(), 1.5e-6, max_relative = 1e-9);
        for i in -10..=10 {
            let place = at(&dent, 3e-6, 0.05 * f64::from(i) * dent.half_angle());
            let [found, expected] = [dent.contacts(place), in_plane.contacts(place)].map(|found| {
                let pressing: Vec<_> = found.pressing().copied().collect();
                assert_eq!(pressing.len(), 1, "{pressing:?}");
                pressing[0]
            });
            assert_eq!(found.feature, Feature::Floor);
            assert!((found.delta - expected.delta).abs() < 1e-17);
            assert!((found.normal_tangential - expected.normal_tangential).abs() < 1e-14);
            // across, the floor is more concave than the groove by b/c²: 1.6/m of 38/m on the inner race
            assert_relative_eq!(found.stiffness, expected.stiffness, max_relative = 0.02);
        }
    }
}

/// A dent of 2 um width is not felt.
#[test]
fn a_scratch_is_the_healthy_race() {
    for race in RACES {
        let dent = surface_dent(race, wide(dent_shape(0.75e-3, 0.4e-6, 50e-6), 2e-6));
        let plain = source_stiffness().at(race) * 3e-6_f64.powf(1.5);
        for i in -30..=30 {
            let found = dent.contacts(at(&dent, 3e-6, 0.05 * f64::from(i) * dent.half_angle()));
            let [mut radial, mut tangential] = [0.0; 2];
            for c in found.pressing() {
                let force = c.stiffness * c.delta.powf(1.5);
                radial += force * c.normal_radial;
                tangential += force * c.normal_tangential;
            }
            // the rim begins: 4e-5 of its blend
            assert_relative_eq!(radial.abs(), plain, max_relative = 1e-3);
            assert!(tangential.abs() < 1e-5 * plain);
        }
    }
}

/// In the plane the surface is the floor, near its ends the rim, and goes over into the race.
#[test]
fn profile_in_the_plane() {
    for race in RACES {
        let dent = surface_dent(race, source_surface(race));
        let Outline { circles, half_length, .. } = dent.outline;
        let depth = |x: f64| {
            let radius = dent.profile_radius(MIDDLE + x * dent.half_angle());
            circles.side * (radius - circles.carrier)
        };
        for x in [0.0_f64, 0.5, -0.7] {
            assert_relative_eq!(depth(x), 15e-6 * (1.0 - x * x).sqrt(), max_relative = 1e-9);
        }
        // 10 um inside the end: the rim's circle, and 4 % for the race's own curve
        let rim = 50e-6 * (1.0 - (1.0_f64 - 0.04).sqrt());
        assert_relative_eq!(depth(1.0 - 10e-6 / half_length), rim, max_relative = 0.04);
        assert!(depth(1.0 + 1e-9).abs() < 1e-18 && depth(-3.0).abs() < 1e-18);
    }
    // a rim wider than the dent fills it
    let groove = surface_dent(Race::Outer, wide(dent_shape(1e-3, 10e-6, 60e-6), 0.05e-3));
    let filled = groove.profile_radius(MIDDLE) - 4.7565e-3;
    assert_relative_eq!(filled, 60e-6 - (60e-6_f64.powi(2) - 25e-6_f64.powi(2)).sqrt(), max_relative = 0.07);
}

#[test]
fn every_rule_fires_and_says_what_to_change_in_space() {
    let (bearing, stiffness) = (source_bearing(), source_stiffness());
    let source = source_surface(Race::Outer);
    let given = |width| DentShape { width, ..source };
    for (shape, message) in [
        (
            given(None),
            "defect profile = \"surface\" needs width, the dent's extent across the race: give it, or use profile = \"in-plane\"",
        ),
        (given(Some(0.0)), "defect width = 0 must be positive and finite"),
        (given(Some(f64::NAN)), "defect width = NaN must be positive and finite"),
        (given(Some(2e-3)), "defect width = 0.002 must be less than the ball's diameter"),
        (
            given(Some(40e-6)),
            "defect depth 0.000015 m is more than a quarter of its width 0.00004 m: take a shallower or a wider dent, or \
             profile = \"in-plane\"",
        ),
        (DentShape { length: 0.0, ..source }, "defect length = 0 must be positive and finite"),
        (
            DentShape { rim_radius: 2e-9, ..source },
            "defect rim_radius = 0.000000002 must be at least a millionth of the radius of the race or ball that it rounds",
        ),
    ] {
        for race in RACES {
            let error = SurfaceDent::new(&bearing, race, shape, stiffness).unwrap_err();
            assert_eq!(error.to_string(), message);
        }
    }
    let long = DentShape { length: 8e-3, ..source };
    let error = SurfaceDent::new(&bearing, Race::Outer, long, stiffness).unwrap_err();
    assert!(error.to_string().contains("is more than a quarter of the race"), "{error}");
    // the ellipse as tight as the ball, shallow enough for the ball to reach the bottom across
    let tight = DentShape { curvature: CurvatureReading::Paper, ..wide(dent_shape(0.2e-3, 11e-6, 5e-6), 1.9e-3) };
    let error = SurfaceDent::new(&bearing, Race::Inner, tight, stiffness).unwrap_err();
    assert!(error.to_string().starts_with("contact on the defect: "), "{error}");
}
