//! The spatial system against the plane one, against its own energy, against rigid rings, and against itself turned: the scenes.

use super::*;
use crate::bearing::defect::{CurvatureReading, DEFAULT_RIM_RADIUS, Dent, DentShape, RaceDefect};
use crate::bearing::hertz::effective_modulus;
use crate::bearing::spatial::{
    AcrossGroove, GrooveDefect, MountedBearing, RaceControl, RigidShaft, ShaftLoad, SpatialBearing, Thrust,
};
use crate::bearing::{
    BearingDimensions, BearingGeometry, Cage, ContactMaterial, ContactStiffness, Race, RaceContacts, SlipProfile,
    SpeedProfile,
};
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::material::{BeamSection, Bond, Material, RadiusRule, RingLayer};
use crate::fe::model::{Ring, RingFrame, RingSupport, Rings, SpringShare};
use crate::fe::reduction::frf::ModalDamping;
use crate::numerics::ode::{Instant, Method, Observer, Schedule, SecondOrderSystem, State, Stepping, integrate};
use crate::system::{
    BallsInertia, BearingSetup, CoupledSystem, EnergyMeter, Equilibrium, Formulation, LoadProfile, LoadedModes,
    ModeSelection, Shaft, StaticCondition, Structure, StructureModes,
};
use std::f64::consts::TAU;

mod energy;
mod motion;
mod plane;
mod rest;

const STEEL: ContactMaterial = ContactMaterial { young: 206e9, poisson: 0.3 };
const FIRST: f64 = 5.2;

fn moduli() -> [f64; 2] {
    [effective_modulus([STEEL.young; 2], [STEEL.poisson; 2]).unwrap(); 2]
}

fn geometry() -> BearingGeometry {
    BearingGeometry::new(BearingDimensions {
        balls: 7,
        ball_radius: 1e-3,
        ball_mass: 3.29e-5,
        inner_race_radius: 2.754e-3,
        outer_race_radius: 4.7565e-3,
        inner_groove_radius: 1.04e-3,
        outer_groove_radius: 1.07e-3,
    })
    .unwrap()
}

/// A steel ring of 24 nodes on springs all round, in space or not, `stiffer` than the usual one.
fn ring(in_space: bool, stiffer: f64) -> Ring {
    let layer = RingLayer {
        material: Material::new(210e9 * stiffer, 0.3, 7850.0).unwrap(),
        area: 12e-6,
        inertia: 9e-12,
        axial_inertia: None,
        torsion: None,
        radius: 6.5e-3,
        shear_coefficient: 5.0 / 6.0,
    };
    let section = BeamSection::combine(&[layer], Bond::Slip(RadiusRule::Own)).unwrap();
    let new = if in_space { Ring::in_space } else { Ring::new };
    let mut ring = new(24, section, RingInterpolation::ExactArc).unwrap();
    let z = if in_space { 5e6 } else { 0.0 };
    ring.add_support(&RingSupport {
        from: 0.0,
        to: TAU,
        spring: [3.6e6, 3.6e6, z].map(|k| k * stiffer),
        share: SpringShare::Total,
        offset: 0.0,
    })
    .unwrap();
    ring
}

fn cage(geometry: &BearingGeometry, first: f64, hz: f64) -> Cage {
    Cage::new(geometry, SpeedProfile::constant(hz).unwrap(), SlipProfile::constant(0.0).unwrap(), first).unwrap()
}

/// A bearing of its free contact angle (degrees) at a place, or a deep groove one that is preloaded radially.
fn bearing(thrust: Thrust, degrees: f64, place: f64, hz: f64) -> BearingInPlace {
    let geometry = match thrust {
        Thrust::Both => geometry().with_radial_play(-1.5e-6).unwrap(),
        _ => geometry().with_free_contact_angle(degrees.to_radians()).unwrap(),
    };
    BearingInPlace {
        label: "A".to_owned(),
        bearing: SpatialBearing::new(geometry, moduli(), thrust, RaceControl::Outer).unwrap(),
        cage: cage(&geometry, FIRST, hz),
        place,
        offset: 0.0,
        contact_damping: 0.0,
    }
}

fn shaft(loads: Vec<SpatialLoad>) -> SpatialShaft {
    SpatialShaft {
        mass: 0.15,
        transverse_inertia: 4e-5,
        polar_inertia: 1e-6,
        unbalances: vec![Unbalance { moment: 2e-5, angle: 0.3, place: 0.004 }],
        loads,
    }
}

/// Back to back, 25 mm apart, preloaded by 2 um each, with thrust, radial load and moment.
fn pair(hz: f64) -> (Structure, SpatialSetup) {
    let [a, b] = Thrust::BACK_TO_BACK;
    let mut bearings = vec![bearing(a, 15.0, -0.0125, hz), bearing(b, 15.0, 0.0125, hz)];
    bearings[0].offset = -2e-6;
    bearings[1].offset = 2e-6;
    let load = LoadProfile::constant([1.0, -6.0, 12.0, 0.01, 0.02]);
    let setup = SpatialSetup {
        shaft: shaft(vec![SpatialLoad { place: 0.02, profile: load }]),
        bearings,
        gravity: [0.0, -9.81, 0.0],
    };
    let at = |z: f64| RingFrame::new([0.0, 0.0, z], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).unwrap();
    let rings = ["A", "B"].into_iter().zip([-0.0125, 0.0125]);
    let rings = rings.map(|(label, z)| (label.to_owned(), ring(true, 1.0), at(z))).collect();
    (Structure::ring_alone(Rings::new(rings).unwrap(), [0.0, -9.81]), setup)
}

fn system(structure: &Structure, modes: &StructureModes, setup: &SpatialSetup) -> SpatialSystem {
    let damping = ModalDamping::Uniform(0.01);
    SpatialSystem::new(structure, modes, setup.clone(), ModeSelection::All, &damping).unwrap()
}

/// A dent 0.4 mm long and 2 um deep at an angle of a race, rad.
fn dent((race, angle): (Race, f64), geometry: &BearingGeometry, stiffness: ContactStiffness) -> RaceDefect {
    let (rim_radius, curvature) = (DEFAULT_RIM_RADIUS, CurvatureReading::Total);
    let shape = DentShape { angle, length: 0.4e-3, width: None, depth: 2e-6, rim_radius, curvature };
    RaceDefect::Dent(Dent::new(geometry, race, shape, stiffness).unwrap())
}

/// A bearing with such dents, which lie across the groove or go over all of it.
fn dented(bearing: &SpatialBearing, dents: &[(Race, f64)], across: Option<AcrossGroove>) -> SpatialBearing {
    let geometry = bearing.geometry();
    let stiffness = RaceContacts::new(geometry, STEEL, STEEL, STEEL).unwrap().stiffness();
    let defect = |&place| GrooveDefect { profile: dent(place, geometry, stiffness), across };
    bearing.clone().with_defects(dents.iter().map(defect).collect()).unwrap()
}

/// Steps a system from a state; gives the states at so many equal times, the start included.
fn states<S: SecondOrderSystem + Clone>(
    system: &mut S,
    state: State,
    method: Method,
    step: f64,
    intervals: u64,
    per: u32,
) -> Vec<State> {
    struct Nothing;
    impl<S> Observer<S> for Nothing {
        fn observe(&mut self, _: &S, _: Instant<'_>) {}
    }
    let mut found = vec![state.clone()];
    let mut state = state;
    for interval in 0..intervals {
        let schedule = Schedule { interval: f64::from(per) * step, steps_per_interval: per, intervals: 1 };
        integrate(system, method, &schedule, &mut state, &mut Nothing, |_, _| Stepping::Continue)
            .unwrap_or_else(|error| panic!("{interval}: {error}"));
        found.push(state.clone());
    }
    found
}
