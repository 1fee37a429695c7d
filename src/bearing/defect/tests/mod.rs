//! Every kind of defect behind one face, for tests that ask the same of all of them.

mod continuity;
mod dents;
mod energy;
mod flats;
mod measured;
mod search;
mod surface;
mod surface_search;

pub(super) use surface::source_outline;

use super::circles::Circles;
use super::curve::Vector;
use super::*;
use crate::bearing::Race;
use crate::bearing::samples::{source_bearing, source_stiffness};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Where the middle of every race defect lies.
const MIDDLE: f64 = -1.3;

/// A defect.
#[derive(Debug, Clone)]
enum Kind {
    Race(Box<RaceDefect>),
    Ball(Box<BallFlat>, Race),
}

/// A defect and the circle that rolls over it.
#[derive(Debug, Clone)]
struct Subject {
    kind: Kind,
    circles: Circles,
}

impl Subject {
    fn race(defect: RaceDefect) -> Self {
        let (bearing, stiffness) = (source_bearing(), source_stiffness());
        Self { circles: Circles::race(&bearing, defect.race(), stiffness), kind: Kind::Race(Box::new(defect)) }
    }

    fn ball(flat: BallFlat, race: Race) -> Self {
        let (bearing, stiffness) = (source_bearing(), source_stiffness());
        Self { circles: Circles::ball(&bearing, race, stiffness), kind: Kind::Ball(Box::new(flat), race) }
    }

    fn half_angle(&self) -> f64 {
        match &self.kind {
            Kind::Race(defect) => defect.half_angle(),
            Kind::Ball(flat, _) => flat.half_angle(),
        }
    }

    fn contact_half_angle(&self) -> f64 {
        match &self.kind {
            Kind::Race(defect) => defect.contact_half_angle(),
            Kind::Ball(flat, race) => flat.contact_half_angle(*race),
        }
    }

    /// Distance from the carrier's centre to the profile at `offset` from the middle.
    fn polar_radius(&self, offset: f64) -> f64 {
        match &self.kind {
            Kind::Race(defect) => defect.profile_radius(MIDDLE + offset),
            Kind::Ball(flat, _) => flat.contour_radius(offset),
        }
    }

    /// Distance of the two centres when the undamaged pair overlaps by `sunk`.
    fn distance(&self, sunk: f64) -> f64 {
        let Circles { carrier, side, roller, .. } = self.circles;
        (side * carrier - roller + sunk) / (side * roller.signum())
    }

    /// Contacts at a distance of the centres and an angle from the middle to where the undamaged carrier
    /// would be touched.
    fn contacts_at(&self, distance: f64, offset: f64) -> DefectContacts {
        match &self.kind {
            Kind::Race(defect) => defect.contacts(PolarPosition { radius: distance, angle: MIDDLE + offset }),
            Kind::Ball(flat, race) => {
                let spin_angle = match race {
                    Race::Inner => PI - offset,
                    Race::Outer => -offset,
                };
                flat.contacts(*race, spin_angle, distance)
            }
        }
    }

    fn contacts(&self, sunk: f64, offset: f64) -> DefectContacts {
        self.contacts_at(self.distance(sunk), offset)
    }

    /// Centre of the rolling circle in the carrier's frame, and the ball's radius vector's direction there.
    fn place(&self, distance: f64, offset: f64) -> (Vector, Vector) {
        match &self.kind {
            Kind::Race(_) => {
                let out = Vector::radial(offset);
                (out.scaled(distance), out)
            }
            // the race's centre, seen from the ball: behind it on the outer race
            Kind::Ball(_, Race::Inner) => {
                let towards = Vector::radial(offset);
                (towards.scaled(distance), towards.scaled(-1.0))
            }
            Kind::Ball(_, Race::Outer) => {
                let away = Vector::radial(offset);
                (away.scaled(-distance), away)
            }
        }
    }
}

fn dent_shape(length: f64, depth: f64, rim_radius: f64) -> DentShape {
    DentShape { angle: MIDDLE, length, width: None, depth, rim_radius, curvature: CurvatureReading::Total }
}

/// The source's Figure 8.
fn source_shape(race: Race) -> DentShape {
    let length = match race {
        Race::Outer => 0.75e-3,
        Race::Inner => 0.8e-3,
    };
    dent_shape(length, 15e-6, DEFAULT_RIM_RADIUS)
}

fn source_flat() -> FlatShape {
    FlatShape { radius: 2e-3, depth: 10e-6, rim_radius: DEFAULT_RIM_RADIUS, curvature: CurvatureReading::Total }
}

fn solved(race: Race, shape: DentShape) -> Dent {
    Dent::new(&source_bearing(), race, shape, source_stiffness()).unwrap()
}

fn flat(shape: FlatShape) -> BallFlat {
    BallFlat::new(&source_bearing(), shape, source_stiffness()).unwrap()
}

fn profile(race: Race, samples: &[(f64, f64)]) -> MeasuredProfile {
    let (bearing, stiffness) = (source_bearing(), source_stiffness());
    MeasuredProfile::new(&bearing, race, MIDDLE, samples, stiffness).unwrap()
}

/// Samples of `depth` (m) of x in 0..1 over `length` (m).
fn sampled(length: f64, count: u32, depth: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    (0..=count)
        .map(|i| {
            let x = f64::from(i) / f64::from(count);
            let inside = i > 0 && i < count;
            (length * x, if inside { depth(x) } else { 0.0 })
        })
        .collect()
}

/// A pit with a raised lip, scratches that the ball bridges, and unequal sides.
fn scratched(count: u32) -> Vec<(f64, f64)> {
    sampled(1e-3, count, |x| {
        let pit = 12e-6 * (PI * x).sin().powi(3) - 2e-6 * (3.0 * PI * x).sin().powi(2) * x;
        pit + 4e-6 * (80.0 * x).sin() * (1.0 - x) * x
    })
}

/// Defects of every kind; the first five are dents in the outer race: touched at the bottom; bridged, floor too
/// tight; both at once; shallow; with a contact that passes from floor to rim. The next five are the same in the
/// inner race. Then flats (the source's, and one flatter than the outer race) on either race, and measured
/// profiles.
fn subjects() -> &'static [(&'static str, Subject)] {
    &SUBJECTS
}

static SUBJECTS: LazyLock<Vec<(&'static str, Subject)>> = LazyLock::new(|| {
    let mut all = Vec::new();
    for race in [Race::Outer, Race::Inner] {
        for (name, shape) in [
            ("source's dent", source_shape(race)),
            ("bridged dent", dent_shape(0.2e-3, 15e-6, 20e-6)),
            ("half bridged dent", dent_shape(0.4e-3, 15e-6, 50e-6)),
            ("shallow dent", dent_shape(0.75e-3, 4e-6, 50e-6)),
            ("smooth dent", smooth_shape(race)),
        ] {
            all.push((name, Subject::race(RaceDefect::Dent(solved(race, shape)))));
        }
    }
    let plane = FlatShape { radius: 0.1, depth: 4e-6, ..source_flat() };
    for race in [Race::Outer, Race::Inner] {
        all.push(("source's flat", Subject::ball(flat(source_flat()), race)));
        all.push(("plane flat", Subject::ball(flat(plane), race)));
    }
    for race in [Race::Outer, Race::Inner] {
        for (name, samples) in [
            ("scratched pit", scratched(60)),
            ("smooth pit", sampled(1.2e-3, 24, |x| 15e-6 * (PI * x).sin().powi(2))),
            ("narrow pit", sampled(0.16e-3, 16, |x| 15e-6 * (PI * x).sin().powi(2))),
        ] {
            let subject = Subject::race(RaceDefect::Measured(profile(race, &samples)));
            all.push((name, subject));
        }
    }
    all
});

/// Those and dents in three dimensions.
fn every_subject<'a>() -> impl Iterator<Item = &'a (&'static str, Subject)> {
    subjects().iter().chain(surface::subjects())
}

/// A dent whose floor is nowhere as tight as the ball: the rim takes the ends of the ellipse.
fn smooth_shape(race: Race) -> DentShape {
    match race {
        Race::Outer => dent_shape(3e-3, 15e-6, 10e-3),
        Race::Inner => dent_shape(2e-3, 30e-6, 1.3e-3),
    }
}

/// Deterministic numbers in 0..1 (a 64-bit linear congruential generator, Knuth's constants).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Between two positive ends, evenly in the logarithm.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

#[test]
fn subjects_are_what_they_are_said_to_be() {
    for (place, (name, subject)) in subjects()[..10].iter().enumerate() {
        let dent = match &subject.kind {
            Kind::Race(defect) => match &**defect {
                RaceDefect::Dent(dent) => dent,
                other => panic!("{name} is {other:?}"),
            },
            other => panic!("{name} is {other:?}"),
        };
        let reach = dent.profile.reach;
        match place % 5 {
            1 => assert!(reach.is_none(), "{name} {place}"),
            4 => assert!(reach.unwrap().meets_rim, "{name} {place}"),
            _ => assert!(!reach.unwrap().meets_rim, "{name} {place}"),
        }
    }
}

#[test]
fn race_defects_answer_for_what_they_hold() {
    for (name, subject) in subjects() {
        let Kind::Race(defect) = &subject.kind else {
            continue;
        };
        assert!((defect.angle() - MIDDLE).abs() < 1e-15, "{name}");
        assert!(defect.contains(MIDDLE) && !defect.contains(MIDDLE + 1.0), "{name}");
    }
}
