//! Reference: the same equations with balls that have inertia.
//! Goal: a ball without inertia stands where one with inertia would not accelerate, whatever it touches; slow motions
//!   are the same with and without.
//! Sketch: the source's bearing in its ring on springs (`setup`).
//! Conditions: no contact damping, consistent equations.
//! Parameters: ten modes of 72 nodes with and without the static residual of the others; a dent in either race, a flat on
//!   a ball, waves, balls of different size, preload.

use plummer::fe::reduction::frf::ModalDamping;
use std::f64::consts::PI;

use plummer::bearing::defect::{BallFlat, CurvatureReading, Dent, DentShape, FlatShape, RaceDefect, SurfaceDent};
use plummer::bearing::{BearingDimensions, BearingGeometry, Race, Wave};
use plummer::numerics::ode::{Method, Schedule, Stepping, integrate};
use plummer::numerics::ode::{SecondOrderSystem, State};
use plummer::system::{
    BallsInertia, BearingSetup, CoupledSystem, Equilibrium, FlatOnBall, Formulation, ModeSelection, Recorder,
    RunRecord, StaticCondition, Structure, StructureModes, SystemError,
};

use crate::setup::{SYMMETRIC_DEG, paper_bearing, paper_structure, preloaded_bearing, rolling_cage};

fn system(
    (structure, modes): &(Structure, StructureModes),
    setup: &BearingSetup,
    balls_inertia: BallsInertia,
    residual: bool,
) -> CoupledSystem {
    let setup = BearingSetup { balls_inertia, ..setup.clone() };
    let kept = ModeSelection::Count(10);
    let damping = ModalDamping::Uniform(0.02);
    CoupledSystem::new(structure, modes, setup, kept, &damping, residual).unwrap()
}

fn ring() -> (Structure, StructureModes) {
    let structure = paper_structure(72, 0.0);
    let modes = structure.modes().unwrap();
    (structure, modes)
}

fn record(system: &mut CoupledSystem, state: &mut State, schedule: &Schedule) -> RunRecord {
    let wanted = schedule.intervals as usize + 1;
    let steps = schedule.steps_per_interval;
    let mut recorder = Recorder::new(system, steps, schedule.step(), wanted).unwrap();
    let method = Method::Exponential;
    let goes_on = |_, _| Stepping::Continue;
    integrate(system, method, schedule, state, &mut recorder, goes_on).unwrap();
    recorder.finish()
}

/// Ball displacements in a state.
fn displacements(system: &mut CoupledSystem, t: f64, y: &[f64]) -> Vec<f64> {
    let mut state = State { t, y: y.to_vec(), v: vec![0.0; y.len()] };
    let none = Schedule { interval: 1e-8, steps_per_interval: 1, intervals: 0 };
    let geometry = system.setup().geometry;
    let touching = geometry.outer_race_radius() - geometry.ball_radius();
    let radii = record(system, &mut state, &none).ball_radius;
    radii.iter().map(|radius| radius - touching).collect()
}

/// Bearings with everything that a ball can touch, turning at 21 Hz.
fn bearings() -> Vec<(&'static str, BearingSetup)> {
    let plain = paper_bearing(SYMMETRIC_DEG, Formulation::Consistent);
    let plain = BearingSetup { cage: rolling_cage(&plain.geometry, SYMMETRIC_DEG, 21.0), ..plain };
    let shape = |depth: f64| DentShape {
        angle: 1.5 * PI,
        length: 0.75e-3,
        width: Some(0.41e-3),
        depth,
        rim_radius: 0.05e-3,
        curvature: CurvatureReading::Total,
    };
    let (geometry, stiffness) = (plain.geometry, plain.stiffness);
    let dent = |race: Race, depth: f64| RaceDefect::Dent(Dent::new(&geometry, race, shape(depth), stiffness).unwrap());
    let surface = |race: Race, depth: f64| {
        let dent = SurfaceDent::new(&geometry, race, shape(depth), stiffness);
        RaceDefect::SurfaceDent(dent.unwrap())
    };
    let flat = FlatShape { radius: 2e-3, depth: 10e-6, rim_radius: 0.05e-3, curvature: CurvatureReading::Total };
    let flat = BallFlat::new(&geometry, flat, stiffness).unwrap();
    vec![
        (
            "dents",
            BearingSetup { race_defects: vec![dent(Race::Outer, 15e-6), dent(Race::Inner, 2e-6)], ..plain.clone() },
        ),
        (
            "dents in three dimensions",
            BearingSetup {
                race_defects: vec![surface(Race::Outer, 15e-6), surface(Race::Inner, 2e-6)],
                ..plain.clone()
            },
        ),
        (
            "flats",
            BearingSetup {
                flats: (0..7).map(|ball| FlatOnBall { ball, shape: flat.clone(), angle: 0.9 * ball as f64 }).collect(),
                ..plain.clone()
            },
        ),
        (
            "waves and balls of different size",
            BearingSetup {
                waves: [Race::Inner, Race::Outer]
                    .map(|race| Wave { race, order: 9, amplitude: 0.3e-6, phase: 0.4 })
                    .to_vec(),
                oversizes: (0..7).map(|ball| 0.1e-6 * f64::from(ball - 3)).collect(),
                ..plain.clone()
            },
        ),
        ("preload", preloaded_bearing(SYMMETRIC_DEG, 21.0)),
        ("sound", plain),
    ]
}

/// Numbers from -1 to 1, the same in every run (Knuth's constants).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

#[test]
fn every_ball_stands_where_it_would_not_accelerate() {
    let ring = ring();
    let mut numbers = Numbers(3);
    for (what, setup) in bearings() {
        for residual in [false, true] {
            let mut standing = system(&ring, &setup, BallsInertia::QuasiStatic, residual);
            let mut moving = system(&ring, &setup, BallsInertia::Dynamic, residual);
            let (modes, mass) = (standing.modes(), setup.geometry.ball_mass());
            let mut largest: f64 = 0.0;
            for _ in 0..300 {
                let t = 0.1 * numbers.next();
                // ring and shaft moved by up to some micrometres, beyond the play of 2.5 um
                let mut y: Vec<f64> = (0..modes).map(|mode| 3e-8 * numbers.next() / (1.0 + mode as f64)).collect();
                y.extend([4e-6 * numbers.next(), 4e-6 * numbers.next()]);
                let balls = displacements(&mut standing, t, &y);
                let mut reduced = vec![0.0; y.len()];
                let v = vec![0.0; y.len()];
                standing.force_into(t, &y, &v, &mut reduced);
                y.extend(&balls);
                let (mut g, v) = (vec![0.0; y.len()], vec![0.0; y.len()]);
                moving.force_into(t, &y, &v, &mut g);
                // the displacement from the recorded radius is good to 1e-18 m, a contact to 3e7 N/m, its force to 3e-11 N
                let size = g[modes..modes + 2].iter().map(|g| 0.15 * g.abs()).sum::<f64>();
                // with residual flexibility forces of balls that move are continued over 1e-6 of a displacement, without how a
                // profile turns the normals there
                let digits = if residual { 1e-7 } else { 1e-9 };
                let tolerance = digits * size.max(0.1);
                for (ball, g) in g[modes + 2..].iter().enumerate() {
                    let left = mass * g;
                    assert!(
                        left.abs() < tolerance,
                        "{what}, residual {residual}, ball {ball}: {left:e} N of {size:e} N"
                    );
                }
                for (coordinate, (found, expected)) in reduced.iter().zip(&g).enumerate() {
                    let difference = found - expected;
                    // in units of kg^1/2 the modes' rows are below 100
                    let limit = 100.0 * tolerance;
                    assert!(
                        difference.abs() < limit,
                        "{what}, residual {residual}, coordinate {coordinate}: {difference:e}"
                    );
                }
                largest = largest.max(size);
            }
            println!("{what}, residual {residual}: contact forces up to {largest:.1} N");
            assert!(largest > 1.0);
        }
    }
}

/// In the equilibrium every coordinate that is left stays where it is.
#[test]
fn the_equilibrium_is_one_without_inertia_too() {
    let ring = ring();
    let setup = paper_bearing(SYMMETRIC_DEG, Formulation::Consistent);
    let rest = Equilibrium::find(&ring.0, &setup, StaticCondition::at(&setup, 0.0)).unwrap();
    let setup = BearingSetup { balls_inertia: BallsInertia::QuasiStatic, ..setup };
    let (all, damping) = (ModeSelection::All, ModalDamping::Uniform(0.02));
    let mut system = CoupledSystem::new(&ring.0, &ring.1, setup, all, &damping, false).unwrap();
    let state = system.state_at(0.0, &rest, &ring.1);
    let mut g = vec![0.0; state.y.len()];
    system.force_into(0.0, &state.y, &state.v, &mut g);
    let modes = system.modes();
    for (i, g) in g.iter().enumerate() {
        let pull = system.linear()[i].squared_frequency * state.y[i];
        let scale = if i < modes { 100.0 } else { 9.81 };
        assert!((g - pull).abs() < 1e-7 * scale, "{i}: {g} {pull}");
    }
}

/// The shaft of a preloaded bearing is pushed; the lighter the balls, the nearer is its motion to that on balls without
/// inertia: their mass enters once.
#[test]
fn slow_motions_are_those_of_light_balls() {
    let ring = ring();
    let shaft_path = |mass: f64, inertia: BallsInertia| -> Vec<f64> {
        let preloaded = preloaded_bearing(SYMMETRIC_DEG, 5.0);
        let geometry = BearingGeometry::new(BearingDimensions { ball_mass: mass, ..*preloaded.geometry.dimensions() });
        let play = preloaded.geometry.radial_play();
        let geometry = geometry.unwrap().with_radial_play(play).unwrap();
        let setup = BearingSetup { cage: rolling_cage(&geometry, SYMMETRIC_DEG, 5.0), geometry, ..preloaded };
        let condition = StaticCondition::at(&setup, 0.0);
        let rest = Equilibrium::find(&ring.0, &setup, condition).unwrap();
        let mut system = system(&ring, &setup, inertia, true);
        let mut state = system.state_at(0.0, &rest, &ring.1);
        state.v[system.modes() + 1] = 1e-4;
        let schedule = Schedule { interval: 1e-5, steps_per_interval: 1000, intervals: 40 };
        let path = record(&mut system, &mut state, &schedule).shaft_y;
        path.iter().map(|y| y - path[0]).collect()
    };
    let difference = |mass: f64| -> f64 {
        let heavy = shaft_path(mass, BallsInertia::Dynamic);
        let without = shaft_path(mass, BallsInertia::QuasiStatic);
        let most = without.iter().fold(0.0_f64, |most, y| most.max(y.abs()));
        let pairs = heavy.iter().zip(&without);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / most
    };
    let [heavy, light] = [3.29e-5, 3.29e-6].map(difference);
    println!("shaft's path: {heavy:.2e} with the source's balls, {light:.2e} with a tenth of their mass");
    assert!(heavy < 0.05, "{heavy}");
    assert!((heavy / light - 10.0).abs() < 2.0, "{heavy} {light}");
}

/// Of a shaft that floats between the balls: those above stand on the inner race, those below on the outer one.
#[test]
fn a_ball_that_nothing_squeezes_lies_where_its_weight_puts_it() {
    let ring = ring();
    let mut setup = paper_bearing(90.0, Formulation::Consistent);
    let weight = setup.geometry.ball_mass() * 9.81;
    let play = setup.geometry.radial_play();
    let mut with = |gravity: [f64; 2]| {
        setup.gravity = gravity;
        let mut system = system(&ring, &setup, BallsInertia::QuasiStatic, false);
        let y = vec![0.0; system.modes() + 2];
        displacements(&mut system, 0.0, &y)
    };
    let overlap = |force: f64, stiffness: f64| (force / stiffness).powf(2.0 / 3.0);
    let hung = with([0.0, -9.81]);
    // ball 0 is at the top
    let [inner, outer] = [setup_stiffness(Race::Inner), setup_stiffness(Race::Outer)];
    assert!((hung[0] + play + overlap(weight, inner)).abs() < 1e-15);
    let below = 2.0 * PI * 3.0 / 7.0;
    let pressed = overlap(-weight * below.cos(), outer);
    assert!((hung[3] - pressed).abs() < 1e-15, "{} {pressed}", hung[3]);
    // without any load it touches the outer race: the rule
    for s in with([0.0, 0.0]) {
        assert!(s.abs() < 1e-17, "{s}");
    }
}

fn setup_stiffness(race: Race) -> f64 {
    let setup = paper_bearing(90.0, Formulation::Consistent);
    setup.stiffness.at(race)
}

#[test]
fn what_needs_the_speed_of_balls_is_refused() {
    let ring = ring();
    for (contact_damping, formulation) in [(1.0, Formulation::Consistent), (0.0, Formulation::Printed)] {
        let setup = BearingSetup {
            contact_damping,
            balls_inertia: BallsInertia::QuasiStatic,
            ..paper_bearing(270.0, formulation)
        };
        let (all, damping) = (ModeSelection::All, ModalDamping::Uniform(0.02));
        let refused = CoupledSystem::new(&ring.0, &ring.1, setup, all, &damping, false);
        let refused = refused.expect_err("refused");
        assert!(
            matches!(refused, SystemError::Refused(what) if what.starts_with("balls_inertia = \"quasi-static\" leaves"))
        );
    }
}
