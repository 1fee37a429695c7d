//! The tangent against central differences of the force it belongs to.

use super::super::bearing_setup::{BallsInertia, BearingSetup, FlatOnBall, Formulation, LoadProfile, Shaft};
use super::super::coupled::{CoupledSystem, ModeSelection};
use super::super::equilibrium::{Equilibrium, StaticCondition};
use super::super::error::SystemError;
use super::super::structure::Structure;
use crate::bearing::defect::{BallFlat, CurvatureReading, Dent, DentShape, FlatShape, MeasuredProfile, RaceDefect};
use crate::bearing::{
    BearingDimensions, BearingGeometry, Cage, ContactMaterial, Race, RaceContacts, SlipProfile, SpeedKnot,
    SpeedProfile, Wave,
};
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::material::{BeamSection, Bond, Material, RadiusRule, RingLayer};
use crate::fe::model::{Ring, RingSupport, SpringShare};
use crate::fe::reduction::frf::ModalDamping;
use crate::numerics::ode::{SecondOrderSystem, State, Tangent};

const GRAVITY: [f64; 2] = [0.0, -9.81];
const FIRST: f64 = 5.2;

/// A steel ring of 24 nodes on springs.
pub(in super::super) fn structure() -> Structure {
    structure_of(24)
}

/// The same of so many nodes.
pub(in super::super) fn structure_of(nodes: usize) -> Structure {
    let layer = RingLayer {
        material: Material::new(210e9, 0.3, 7850.0).unwrap(),
        area: 12e-6,
        inertia: 9e-12,
        axial_inertia: None,
        torsion: None,
        radius: 6.5e-3,
        shear_coefficient: 5.0 / 6.0,
    };
    let section = BeamSection::combine(&[layer], Bond::Slip(RadiusRule::Own)).unwrap();
    let mut ring = Ring::new(nodes, section, RingInterpolation::ExactArc).unwrap();
    ring.add_support(&RingSupport {
        from: 3.0,
        to: 6.4,
        spring: [3.6e6, 3.6e6, 0.0],
        share: SpringShare::Total,
        offset: 0.0,
    })
    .unwrap();
    Structure::ring_alone(ring, GRAVITY)
}

/// Seven balls, preloaded, turning at 30 Hz.
pub(super) fn preloaded() -> BearingSetup {
    let geometry = BearingGeometry::new(BearingDimensions {
        balls: 7,
        ball_radius: 1e-3,
        ball_mass: 3.29e-5,
        inner_race_radius: 2.754e-3,
        outer_race_radius: 4.7565e-3,
        inner_groove_radius: 1.04e-3,
        outer_groove_radius: 1.07e-3,
    })
    .unwrap()
    .with_radial_play(-1.5e-6)
    .unwrap();
    let steel = ContactMaterial { young: 206e9, poisson: 0.3 };
    let (speed, slip) = (SpeedProfile::constant(30.0), SlipProfile::constant(0.0));
    BearingSetup {
        cage: Cage::new(&geometry, speed.unwrap(), slip.unwrap(), FIRST).unwrap(),
        geometry,
        stiffness: RaceContacts::new(&geometry, steel, steel, steel).unwrap().stiffness(),
        contact_damping: 0.0,
        formulation: Formulation::Consistent,
        balls_inertia: BallsInertia::Dynamic,
        waves: Vec::new(),
        oversizes: Vec::new(),
        race_defects: Vec::new(),
        flats: Vec::new(),
        shaft: Shaft { mass: 0.15, unbalance: 2e-5, loads: Vec::new() },
        gravity: GRAVITY,
    }
}

/// A dent in a race with ball 0 `aside` (rad) of its middle, carrying load.
pub(super) fn dented(race: Race, aside: f64) -> BearingSetup {
    let sound = preloaded();
    let shape = DentShape {
        angle: FIRST + aside,
        length: 0.75e-3,
        width: None,
        depth: 0.3e-6,
        rim_radius: 0.05e-3,
        curvature: CurvatureReading::Total,
    };
    let dent = Dent::new(&sound.geometry, race, shape, sound.stiffness).unwrap();
    BearingSetup { race_defects: vec![RaceDefect::Dent(dent)], ..sound }
}

/// A wavy measured profile in a race, its middle `aside` (rad) of ball 0, which carries load.
pub(super) fn measured(race: Race, aside: f64) -> BearingSetup {
    let sound = preloaded();
    let samples = [0.0, 0.1, 0.3, 0.15, 0.35, 0.2, 0.0].into_iter().enumerate();
    let samples: Vec<(f64, f64)> = samples.map(|(place, depth)| (place as f64 * 0.15e-3, depth * 1e-6)).collect();
    let (geometry, stiffness) = (&sound.geometry, sound.stiffness);
    let profile = MeasuredProfile::new(geometry, race, FIRST + aside, &samples, stiffness);
    BearingSetup { race_defects: vec![RaceDefect::Measured(profile.unwrap())], ..sound }
}

/// A flat on ball 0, which carries load, at this angle (rad) from its radius vector.
pub(super) fn flat(angle: f64) -> BearingSetup {
    let sound = preloaded();
    let shape = FlatShape { radius: 1.2e-3, depth: 0.3e-6, rim_radius: 0.05e-3, curvature: CurvatureReading::Total };
    let flat = FlatOnBall { ball: 0, shape: BallFlat::new(&sound.geometry, shape, sound.stiffness).unwrap(), angle };
    BearingSetup { flats: vec![flat], ..sound }
}

/// Waves round both races.
pub(super) fn wavy(setup: BearingSetup) -> BearingSetup {
    let waves = [Race::Inner, Race::Outer].map(|race| Wave { race, order: 14, amplitude: 0.2e-6, phase: 0.3 });
    BearingSetup { waves: waves.to_vec(), ..setup }
}

/// What is asked of the tangent.
pub(super) struct Asked {
    pub setup: BearingSetup,
    pub modes: ModeSelection,
    pub residual: bool,
    /// How far the shaft is pushed, m.
    pub pushed: f64,
}

impl Asked {
    pub fn of(setup: BearingSetup) -> Self {
        Self { setup, modes: ModeSelection::Count(10), residual: false, pushed: 2e-7 }
    }

    /// The system, and a state near its equilibrium that moves.
    pub fn moving(self) -> (CoupledSystem, State) {
        let structure = structure();
        let modes = structure.modes().unwrap();
        let setup = self.setup;
        let at = StaticCondition::at(&setup, 0.0);
        let rest = Equilibrium::find(&structure, &setup, at).unwrap();
        let damping = ModalDamping::Uniform(0.03);
        let (kept, residual) = (self.modes, self.residual);
        let system = CoupledSystem::new(&structure, &modes, setup, kept, &damping, residual).unwrap();
        let State { t, mut y, mut v } = system.state_at(0.0, &rest, &modes);
        for i in 0..y.len() {
            let sign = f64::sin((i * i + 1) as f64);
            y[i] += 3e-8 * sign / moves(&system, i);
            v[i] += 0.05 * sign / moves(&system, i);
        }
        y[system.modes() + 1] += self.pushed;
        (system, State { t, y, v })
    }
}

/// How far (m) a unit of a coordinate moves a contact.
fn moves(system: &CoupledSystem, i: usize) -> f64 {
    if i < system.modes() { system.balls.mode_bounds.as_flattened()[i] } else { 1.0 }
}

/// Largest errors of the change of force on modes, shaft and balls by any coordinate and any velocity, in units of the largest
/// change of these; and the number of terms.
fn errors(asked: Asked) -> (Vec<f64>, usize) {
    let (mut system, State { t, y, v }) = asked.moving();
    let (n, dof) = (system.modes(), y.len());
    let mut tangent = Tangent::new(dof);
    system.tangent_into(t, &y, &v, &mut tangent);
    let (mut errors, mut largest) = ([0.0_f64; 3], [0.0_f64; 3]);
    let (mut more, mut less) = (vec![0.0; dof], vec![0.0; dof]);
    for i in 0..2 * dof {
        // 1e-4 of an overlap; what a rate does is linear
        let step = if i < dof { 1e-10 } else { 1e-3 } / moves(&system, i % dof);
        let (mut dy, mut dv) = (vec![0.0; dof], vec![0.0; dof]);
        if i < dof {
            dy[i] = step;
        } else {
            dv[i - dof] = step;
        }
        let moved =
            |a: &[f64], b: &[f64], sign: f64| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a + sign * b).collect() };
        for (sign, g) in [(1.0, &mut more), (-1.0, &mut less)] {
            system.force_into(t, &moved(&y, &dy, sign), &moved(&v, &dv, sign), g);
        }
        let mut told = vec![0.0; dof];
        tangent.apply(&dy, &dv, &mut told);
        for row in 0..dof {
            let block = if row < n { 0 } else { 1 + usize::from(row >= n + 2) };
            let change = 0.5 * (more[row] - less[row]);
            errors[block] = errors[block].max((change - told[row]).abs());
            // by positions: velocities of damped contacts change it as much or less
            if i < dof {
                largest[block] = largest[block].max(change.abs());
            }
        }
    }
    let blocks = if dof > n + 2 { 3 } else { 2 };
    let relative = (0..blocks).map(|block| errors[block] / largest[block]);
    (relative.collect(), tangent.terms)
}

fn check(what: &str, asked: Asked, bound: f64) -> usize {
    let (errors, terms) = errors(asked);
    println!("{what}: {errors:?}, {terms} terms");
    assert!(errors.iter().all(|error| *error < bound), "{what}: {errors:?}");
    terms
}

pub(super) fn damped(setup: BearingSetup) -> BearingSetup {
    BearingSetup { contact_damping: 2.0, ..setup }
}

#[test]
fn on_circles_it_is_the_derivative() {
    // differences of 1e-4 of an overlap err by 1e-9, round-off of overlaps is 1e-10 of these, the centrifugal force is left out
    let bound = 1e-7;
    let all = check("at rest", Asked::of(preloaded()), bound);
    // seven balls: three terms each
    assert_eq!(all, 21);
    check("damped", Asked::of(damped(preloaded())), bound);
    let lifted = |setup| Asked { pushed: 4e-6, ..Asked::of(setup) };
    let some = check("some lifted off", lifted(preloaded()), bound);
    assert!(some < all && some > 6, "{some} terms");
    check("damped, some lifted off", lifted(damped(preloaded())), bound);
    let oversizes = (0..7).map(|ball| 1e-7 * f64::from(ball)).collect();
    let sizes = BearingSetup { oversizes, ..preloaded() };
    check("balls of different size", Asked::of(sizes), bound);
    let printed = |setup| Asked {
        modes: ModeSelection::All,
        ..Asked::of(BearingSetup { formulation: Formulation::Printed, ..setup })
    };
    check("printed", printed(preloaded()), bound);
    check("printed, damped", printed(damped(preloaded())), bound);
}

#[test]
fn off_circles_it_is_near_the_derivative() {
    // normals turn by displacements over radii: on the floor, and on the rim of 0.05e-3 m where the ball touches both; without the
    // velocity along the race in the tangent damping makes 8e-4 on the outer race's floor
    for (place, asides, bound) in [("floor", [0.01, 0.02], 1e-6), ("rim", [0.075, 0.13], 0.02)] {
        for (race, aside) in [Race::Outer, Race::Inner].into_iter().zip(asides) {
            let what = format!("{place}, {race:?}");
            check(&what, Asked::of(dented(race, aside)), bound);
            let asked = Asked::of(damped(dented(race, aside)));
            check(&format!("{what}, damped"), asked, bound);
        }
    }
    for race in [Race::Outer, Race::Inner] {
        let what = format!("measured, {race:?}");
        check(&what, Asked::of(measured(race, 0.02)), 1e-4);
        let asked = Asked::of(damped(measured(race, 0.02)));
        check(&format!("{what}, damped"), asked, 1e-4);
    }
    check("flat", Asked::of(flat(0.03)), 1e-5);
    check("flat, damped", Asked::of(damped(flat(0.03))), 3e-5);
    let inside = flat(0.03 + std::f64::consts::PI);
    check("flat inside", Asked::of(inside.clone()), 1e-5);
    check("flat inside, damped", Asked::of(damped(inside)), 3e-5);
    // the waves' bend is in it
    check("waves", Asked::of(wavy(preloaded())), 1e-6);
    check("waves, damped", Asked::of(damped(wavy(preloaded()))), 3e-6);
    let printed = |setup| Asked {
        modes: ModeSelection::All,
        ..Asked::of(BearingSetup { formulation: Formulation::Printed, ..setup })
    };
    let floor = dented(Race::Outer, 0.01);
    check("floor, printed", printed(floor.clone()), 1e-4);
    check("floor, printed, damped", printed(damped(floor)), 1e-4);
}

#[test]
fn with_what_is_left_out_it_is_near_the_derivative() {
    // the residual of 62 modes moves others' contacts by half a percent of their own overlap; its part of the rates, from ball to ball
    // and by turning, is left out
    let residual = |setup| Asked { residual: true, modes: ModeSelection::Count(10), ..Asked::of(setup) };
    check("residual", residual(preloaded()), 0.02);
    check("residual, damped", residual(damped(preloaded())), 0.15);
    let rim = || residual(dented(Race::Outer, 0.075));
    check("rim, residual", rim(), 0.02);
    let rim = Asked { setup: damped(rim().setup), ..rim() };
    check("rim, residual, damped", rim, 0.15);
    let light = |setup| BearingSetup { balls_inertia: BallsInertia::QuasiStatic, ..setup };
    // normals of both contacts differ by displacements over radii, 1e-3
    check("without inertia", Asked::of(light(preloaded())), 1e-3);
    check("without inertia, residual", residual(light(preloaded())), 0.02);
}

#[test]
fn a_state_that_is_no_number_gives_a_force_that_is_none() {
    let structure = structure();
    let modes = structure.modes().unwrap();
    let (kept, damping) = (ModeSelection::Count(10), ModalDamping::Uniform(0.03));
    let light = BearingSetup { balls_inertia: BallsInertia::QuasiStatic, ..preloaded() };
    for setup in [damped(preloaded()), light] {
        let mut system = CoupledSystem::new(&structure, &modes, setup, kept, &damping, true).unwrap();
        let none = vec![f64::NAN; system.linear().len()];
        let mut force = vec![0.0; none.len()];
        system.force_into(0.0, &none, &none, &mut force);
        assert!(force.iter().any(|force| force.is_nan()));
    }
}

#[test]
fn what_is_prescribed_changes_at_the_knots_of_speed_slip_and_loads() {
    let mut setup = preloaded();
    let knots = [(0.2, 10.0), (0.7, 30.0)].map(|(time, frequency_hz)| SpeedKnot { time, frequency_hz });
    let slip = SlipProfile::over_time(&[(0.0, 0.0), (0.5, 0.02)]);
    let speed = SpeedProfile::new(&knots);
    setup.cage = Cage::new(&setup.geometry, speed.unwrap(), slip.unwrap(), FIRST).unwrap();
    setup.shaft.loads =
        vec![LoadProfile::constant([1.0, 0.0]), LoadProfile::through(&[(0.3, [0.0; 2]), (0.9, [2.0, 0.0])])];
    let structure = structure();
    let modes = structure.modes().unwrap();
    let (kept, damping) = (ModeSelection::Count(10), ModalDamping::Uniform(0.03));
    let system = CoupledSystem::new(&structure, &modes, setup, kept, &damping, true).unwrap();
    let mut found = Vec::new();
    let mut time = 0.05_f64;
    while found.len() < 9 && time.is_finite() {
        time = system.next_change(time);
        found.push(time);
    }
    let expected = [0.2, 0.3, 0.5, 0.7, 0.9, f64::INFINITY];
    assert_eq!(format!("{found:?}"), format!("{expected:?}"));
}

#[test]
fn each_mode_has_its_own_damping() {
    let structure = structure();
    let modes = structure.modes().unwrap();
    let system = |damping: &ModalDamping| {
        CoupledSystem::new(&structure, &modes, preloaded(), ModeSelection::Count(10), damping, false)
    };
    let ratios: Vec<f64> = (0..modes.count()).map(|mode| 0.01 + 0.001 * mode as f64).collect();
    let damped = system(&ModalDamping::Each(ratios.clone())).unwrap();
    for (coordinate, ratio) in damped.linear[..10].iter().zip(ratios) {
        let expected = 2.0 * ratio * coordinate.squared_frequency.sqrt();
        assert_eq!(coordinate.damping.to_bits(), expected.to_bits());
    }
    for wrong in [ModalDamping::Each(vec![0.01]), ModalDamping::Uniform(f64::NAN), ModalDamping::Uniform(1.0)] {
        assert!(matches!(system(&wrong), Err(SystemError::Damping(_))), "{wrong:?}");
    }
}
