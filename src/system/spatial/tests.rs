//! The spatial system against the plane one, against its own energy, against rigid rings, and against itself turned.

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

/// One deep groove bearing under a radial load, as the plane system and as the spatial one, each with its start at rest.
struct Twins {
    plane: (CoupledSystem, State, Equilibrium),
    spatial: (SpatialSystem, State, SpatialEquilibrium),
}

impl Twins {
    fn new(kept: ModeSelection, dents: &[(Race, f64)]) -> Self {
        let geometry = geometry().with_radial_play(-1.5e-6).unwrap();
        let stiffness: ContactStiffness = RaceContacts::new(&geometry, STEEL, STEEL, STEEL).unwrap().stiffness();
        let setup = BearingSetup {
            cage: cage(&geometry, FIRST, 30.0),
            geometry,
            stiffness,
            contact_damping: 0.5,
            formulation: Formulation::Consistent,
            balls_inertia: BallsInertia::Dynamic,
            waves: Vec::new(),
            oversizes: Vec::new(),
            race_defects: dents.iter().map(|&place| dent(place, &geometry, stiffness)).collect(),
            flats: Vec::new(),
            shaft: Shaft { mass: 0.15, unbalance: 2e-5, loads: vec![LoadProfile::constant([1.0, -6.0])] },
            gravity: [0.0, -9.81],
        };
        let damping = ModalDamping::Uniform(0.01);
        let structure = Structure::ring_alone(ring(false, 1.0), [0.0, -9.81]);
        let modes = structure.modes().unwrap();
        let rest = Equilibrium::find(&structure, &setup, StaticCondition::at(&setup, 0.0)).unwrap();
        let plane = CoupledSystem::new(&structure, &modes, setup, kept, &damping, false).unwrap();
        let start = plane.state_at(0.0, &rest, &modes);
        let plane = (plane, start, rest);

        let mut own = bearing(Thrust::Both, 0.0, 0.0, 30.0);
        own.bearing = dented(&own.bearing.with_stiffness(stiffness), dents, None);
        own.contact_damping = 0.5;
        let shaft = SpatialShaft {
            unbalances: vec![Unbalance { moment: 2e-5, angle: 0.0, place: 0.0 }],
            ..shaft(vec![SpatialLoad { place: 0.0, profile: LoadProfile::constant([1.0, -6.0, 0.0, 0.0, 0.0]) }])
        };
        let setup = SpatialSetup { shaft, bearings: vec![own], gravity: [0.0, -9.81, 0.0] };
        let structure = Structure::ring_alone(ring(true, 1.0), [0.0, -9.81]);
        let modes = structure.modes().unwrap();
        let rest = SpatialEquilibrium::find(&structure, &setup, &SpatialCondition::at(&setup, 0.0)).unwrap();
        let spatial = SpatialSystem::new(&structure, &modes, setup, kept, &damping).unwrap();
        let start = spatial.state_at(0.0, &rest, &modes);
        Self { plane, spatial: (spatial, start, rest) }
    }
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

/// A radial load in the plane: to the same motion as the plane system's.
#[test]
fn in_the_plane_it_is_the_plane_system() {
    let Twins { plane: (mut of_plane, start, rest), spatial: (mut spatial, spatial_start, found) } =
        Twins::new(ModeSelection::All, &[]);
    for (ball, expected) in found.bearings[0].iter().zip(&rest.balls) {
        // both searches end at a force out of balance of 1e-11 of the load
        assert!((ball.load[0] - expected.inner).abs() < 1e-9, "{ball:?} {expected:?}");
        assert!((ball.load[1] - expected.outer).abs() < 1e-9, "{ball:?} {expected:?}");
    }
    let method = Method::ExponentialAdams { tolerance: None };
    let expected = states(&mut of_plane, start, method, 1e-7, 10, 500);
    let found = states(&mut spatial, spatial_start, method, 1e-7, 10, 500);
    let (n, m) = (of_plane.modes(), spatial.modes);
    let geometry = of_plane.setup().geometry;
    let touching = geometry.outer_race_radius() - geometry.ball_radius() - spatial.bearings[0].base;
    for (found, expected) in found.iter().zip(&expected) {
        for k in 0..2 {
            let [a, b] = [found.y[m + k], expected.y[n + k]];
            // 1e-9 of a displacement of microns: round-off of a step, grown over five thousand
            assert!((a - b).abs() < 1e-15, "{} s: {a:e} {b:e}", found.t);
        }
        for ball in 0..7 {
            let [a, b] = [found.y[m + 5 + ball] - touching, expected.y[n + 2 + ball]];
            assert!((a - b).abs() < 1e-15, "{} s, ball {ball}: {a:e} {b:e}", found.t);
            assert!(found.y[m + 12 + ball].abs() < 1e-18);
        }
    }
}

/// Modes by differences of the force: every one of the plane system is there, and the others are across the plane.
#[test]
fn loaded_modes_in_the_plane_are_those_of_the_plane_system() {
    let Twins { plane: (of_plane, _, rest), spatial: (mut spatial, state, _) } = Twins::new(ModeSelection::All, &[]);
    let structure = Structure::ring_alone(ring(false, 1.0), [0.0, -9.81]);
    let modes = structure.modes().unwrap();
    let expected = LoadedModes::at(&structure, &modes, of_plane.setup(), &rest).unwrap();
    // the plane's are without damping
    spatial.linear.iter_mut().for_each(|linear| linear.damping = 0.0);
    spatial.setup.bearings[0].contact_damping = 0.0;
    let law = &mut spatial.bearings[0];
    (law.inner.damping, law.outer.damping) = (0.0, 0.0);
    let found = spatial.loaded_modes(&state).unwrap();
    assert_eq!((expected.unstable, found.unstable), (0, 0));
    let nearest = |hz: f64| {
        let apart = |mode: &crate::system::LoadedMode| (mode.frequency_hz / hz - 1.0).abs();
        found.modes.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap()
    };
    let mut worst = 0.0_f64;
    for mode in &expected.modes {
        let own = nearest(mode.frequency_hz);
        worst = worst.max((own.frequency_hz / mode.frequency_hz - 1.0).abs());
        assert!((own.shaft_share - mode.shaft_share).abs() < 1e-4, "{own:?} {mode:?}");
    }
    println!("{} modes of {}: {worst:e}", expected.modes.len(), found.modes.len());
    // central differences over a ten-thousandth of the overlap: 1e-8 of the stiffness, and round-off of forces over them
    assert!(worst < 1e-6, "{worst:e}");
    assert!(found.modes.len() > expected.modes.len() + 7);
}

/// Dents over the whole groove are those of the plane system: balls run into them and out again.
#[test]
fn in_the_plane_a_dent_is_that_of_the_plane_system() {
    let dents = [(Race::Outer, FIRST + 0.08), (Race::Inner, FIRST + TAU / 7.0 - 0.12)];
    let Twins { plane, spatial } = Twins::new(ModeSelection::All, &dents);
    let Twins { spatial: whole, .. } = Twins::new(ModeSelection::All, &[]);
    let (n, m) = (plane.0.modes(), spatial.0.modes);
    let method = Method::ExponentialAdams { tolerance: Some(1e-6) };
    fn run<S: SecondOrderSystem + Clone, E>((mut system, start, _): (S, State, E), method: Method) -> Vec<State> {
        states(&mut system, start, method, 1e-7, 10, 2000)
    }
    let [found, sound] = [spatial, whole].map(|of| run(of, method));
    let expected = run(plane, method);
    let (mut apart, mut moved) = (0.0_f64, 0.0_f64);
    for ((found, sound), expected) in found.iter().zip(&sound).zip(&expected) {
        for k in 0..2 {
            apart = apart.max((found.y[m + k] - expected.y[n + k]).abs());
            moved = moved.max((found.y[m + k] - sound.y[m + k]).abs());
        }
    }
    println!("{apart:e} of {moved:e}");
    // the plane takes the azimuth on the race at the ball's own radius, the force by it left out: 1e-4 of the race's displacement
    assert!(moved > 1e-8 && apart < 1e-4 * moved, "{apart:e} of {moved:e}");
}

/// In rings that hardly give way the rest is that of rigid rings.
#[test]
fn in_stiff_rings_the_rest_is_that_of_rigid_ones() {
    let (_, setup) = pair(0.0);
    let at = |z: f64| RingFrame::new([0.0, 0.0, z], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).unwrap();
    let rings = [-0.0125, 0.0125].map(|z| (format!("{z}"), ring(true, 1e6), at(z))).to_vec();
    let structure = Structure::ring_alone(Rings::new(rings).unwrap(), [0.0; 2]);
    let found = SpatialEquilibrium::find(&structure, &setup, &SpatialCondition::at(&setup, 0.0)).unwrap();
    let mounted = setup.bearings.iter().map(|own| MountedBearing {
        bearing: own.bearing.clone(),
        place: own.place,
        offset: own.offset,
        cage_angle: FIRST,
    });
    let rigid = RigidShaft::new(mounted.collect(), 0.0).unwrap();
    // the weight acts at the centre of mass, the load beside it
    let load =
        ShaftLoad { force: [1.0, -6.0 - 0.15 * 9.81, 12.0], moment: [0.01 + 0.02 * 6.0, 0.02 + 0.02], place: 0.0 };
    let expected = rigid.equilibrium(&load).unwrap();
    for (own, expected) in found.bearings.iter().zip(&expected.bearings) {
        for (ball, expected) in own.iter().zip(&expected.balls) {
            for race in 0..2 {
                // the rings give way by 1e-6 of what the contacts do; balls have their weight here, 3e-4 N
                assert!((ball.load[race] - expected.load[race]).abs() < 1.2e-3, "{ball:?} {expected:?}");
            }
        }
    }
    for i in 0..5 {
        for j in 0..5 {
            let scale = (expected.stiffness[i][i] * expected.stiffness[j][j]).sqrt();
            let [a, b] = [found.shaft_stiffness[i][j], expected.stiffness[i][j]];
            assert!((a - b).abs() < 1e-3 * scale, "{i} {j}: {a:e} {b:e}");
        }
    }
}

/// Gap of the balance over all that was exchanged.
fn energy_gap(setup: &SpatialSetup, structure: &Structure, step: f64, steps: u64) -> f64 {
    let modes = structure.modes().unwrap();
    let rest = SpatialEquilibrium::find(structure, setup, &SpatialCondition::at(setup, 0.0)).unwrap();
    let mut system = system(structure, &modes, setup);
    let mut state = system.state_at(0.0, &rest, &modes);
    let mut meter = EnergyMeter::new(&system, step).unwrap();
    let schedule = Schedule { interval: step, steps_per_interval: 1, intervals: steps };
    let method = Method::ExponentialAdams { tolerance: None };
    integrate(&mut system, method, &schedule, &mut state, &mut meter, |_, _| Stepping::Continue).unwrap();
    let balance = meter.balance(&mut system, &state).unwrap();
    assert!(balance.exchanged_j > 1e-9 && balance.contact_damping_j > 0.0, "{balance:?}");
    balance.error()
}

#[test]
fn energy_is_kept_with_axial_preload_tilt_and_every_kind_of_force() {
    let (structure, mut setup) = pair(300.0);
    for own in &mut setup.bearings {
        own.contact_damping = 1.0;
    }
    for control in [RaceControl::Outer, RaceControl::Shared] {
        let geometry = geometry().with_free_contact_angle(15_f64.to_radians()).unwrap();
        for own in &mut setup.bearings {
            let thrust = if own.place < 0.0 { Thrust::BACK_TO_BACK[0] } else { Thrust::BACK_TO_BACK[1] };
            own.bearing = SpatialBearing::new(geometry, moduli(), thrust, control).unwrap();
        }
        let gap = energy_gap(&setup, &structure, 2e-8, 10_000);
        println!("{control:?}: {gap:e}");
        // the integrator's own error; 1e-6 is what such a balance is asked for
        assert!(gap.abs() < 1e-7, "{control:?}: {gap:e}");
    }
}

/// Balls of both bearings cross a dent that their patches cover in part, on the outer race of one and on the inner race of the other.
#[test]
fn energy_is_kept_on_dents_across_the_groove() {
    let (structure, mut setup) = pair(300.0);
    let dents = [((Race::Outer, FIRST + 0.07), 2e-4), ((Race::Inner, FIRST - 0.09), 2e-4)];
    for (own, (dent, place)) in setup.bearings.iter_mut().zip(dents) {
        own.contact_damping = 1.0;
        own.offset *= 3.0;
        own.bearing = dented(&own.bearing, &[dent], Some(AcrossGroove { place, width: 2e-4 }));
    }
    let gap = energy_gap(&setup, &structure, 1e-8, 20_000);
    println!("{gap:e}");
    // what such a balance is asked for in the plane
    assert!(gap.abs() < 1e-6, "{gap:e}");
}

/// A dent beside the balls' path changes nothing, one on it does.
#[test]
fn a_ball_beside_a_dent_misses_it() {
    let run = |place: Option<f64>| {
        let (structure, mut setup) = pair(300.0);
        let modes = structure.modes().unwrap();
        let own = &mut setup.bearings[0];
        if let Some(place) = place {
            let across = Some(AcrossGroove { place, width: 2e-4 });
            own.bearing = dented(&own.bearing, &[(Race::Outer, FIRST + 0.03)], across);
        }
        let rest = SpatialEquilibrium::find(&structure, &setup, &SpatialCondition::at(&setup, 0.0)).unwrap();
        let mut system = system(&structure, &modes, &setup);
        let start = system.state_at(0.0, &rest, &modes);
        let method = Method::ExponentialAdams { tolerance: None };
        states(&mut system, start, method, 1e-7, 1, 500).swap_remove(1).y
    };
    // balls run at 15 degrees and more, 0.28 mm from the bottom towards +z
    let [whole, beside, on] = [None, Some(-2.8e-4), Some(2.8e-4)].map(run);
    let apart = |other: &[f64]| whole.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // an approach's rate that is not used may be rounded otherwise, nothing else
    assert!(apart(&beside) < 1e-20, "{:e}", apart(&beside));
    assert!(apart(&on) > 1e-8, "{:e}", apart(&on));
}

/// A load straight on a ball in play leans the shaft to either side of it, in rings that give way as in rigid ones; mirror images, with
/// a saddle between. Where two balls share the load, or the balls are preloaded, there is one equilibrium.
#[test]
fn every_equilibrium_over_one_ball_is_found() {
    let (structure, mut setup) = pair(0.0);
    setup.shaft = shaft(vec![SpatialLoad { place: 0.0, profile: LoadProfile::constant([0.0, -6.0, 0.0, 0.0, 0.0]) }]);
    let mut find_all = |play: f64, first: f64| {
        let geometry = geometry().with_radial_play(play).unwrap();
        for own in &mut setup.bearings {
            own.bearing = SpatialBearing::new(geometry, moduli(), Thrust::Both, RaceControl::Outer).unwrap();
            own.cage = cage(&geometry, first, 0.0);
            own.offset = 0.0;
        }
        let condition = SpatialCondition::at(&setup, 0.0);
        let all = SpatialEquilibrium::find_all(&structure, &setup, &condition).unwrap();
        assert_eq!(all[0], SpatialEquilibrium::find(&structure, &setup, &condition).unwrap());
        all
    };
    let all = find_all(5e-6, -TAU / 4.0);
    // both ends lean alike, or against each other
    let (stable, saddles): (Vec<_>, Vec<_>) = all.iter().partition(|rest| rest.is_stable());
    assert_eq!((stable.len(), saddles.len()), (4, 3));
    let lean = |rest: &SpatialEquilibrium| [-0.0125, 0.0125].map(|place| rest.shaft[0] + place * rest.shaft[4]);
    for (number, rest) in stable.iter().enumerate() {
        let [a, b] = lean(rest);
        // round-off of the forces over the stiffness
        assert!((a.abs() - b.abs()).abs() < 1e-12 && a.abs() > 1e-6, "{a} {b}");
        let mirrored = |other: &&&SpatialEquilibrium| (lean(other)[0] + a).abs() + (lean(other)[1] + b).abs() < 1e-12;
        assert!(stable.iter().position(|other| mirrored(&other)) != Some(number));
        assert_eq!(stable.iter().filter(mirrored).count(), 1);
    }
    assert_eq!(find_all(5e-6, -TAU / 4.0 + TAU / 14.0).len(), 1);
    assert_eq!(find_all(-1e-6, -TAU / 4.0).len(), 1);
}

/// The whole scene turned about the axis by the angle between two nodes of a ring: results turn with it.
#[test]
fn results_turn_with_the_scene() {
    let (structure, setup) = pair(300.0);
    let modes = structure.modes().unwrap();
    let turn = TAU / 24.0;
    let turned = |[x, y]: [f64; 2]| [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos()];
    let mut other = setup.clone();
    let [gx, gy] = turned([setup.gravity[0], setup.gravity[1]]);
    other.gravity = [gx, gy, 0.0];
    let [x, y] = turned([1.0, -6.0]);
    let [a, b] = turned([0.01, 0.02]);
    other.shaft.loads[0].profile = LoadProfile::constant([x, y, 12.0, a, b]);
    other.shaft.unbalances[0].angle += turn;
    for own in &mut other.bearings {
        own.cage = cage(own.bearing.geometry(), FIRST + turn, 300.0);
    }
    let gravity = [gx, gy];
    let rings = structure.rings().seats().iter().map(|seat| (seat.label.clone(), seat.ring.clone(), seat.frame));
    let other_structure = Structure::ring_alone(Rings::new(rings.collect()).unwrap(), gravity);
    let other_modes = other_structure.modes().unwrap();
    let run = |structure: &Structure, modes: &StructureModes, setup: &SpatialSetup| {
        let rest = SpatialEquilibrium::find(structure, setup, &SpatialCondition::at(setup, 0.0)).unwrap();
        let mut system = system(structure, modes, setup);
        let start = system.state_at(0.0, &rest, modes);
        let method = Method::ExponentialAdams { tolerance: None };
        let found = states(&mut system, start, method, 1e-7, 1, 2000);
        (rest, found[1].y[modes.count()..].to_vec())
    };
    let ((rest, one), (other_rest, two)) =
        (run(&structure, &modes, &setup), run(&other_structure, &other_modes, &other));
    for (own, other) in rest.bearings.iter().flatten().zip(other_rest.bearings.iter().flatten()) {
        for race in 0..2 {
            // both searches end at 1e-11 of the load
            assert!((own.load[race] - other.load[race]).abs() < 1e-10, "{own:?} {other:?}");
        }
    }
    let near = |a: f64, b: f64, scale: f64| assert!((a - b).abs() < 1e-9 * scale, "{a:e} {b:e}");
    for first in [0, 3] {
        let [x, y] = turned([one[first], one[first + 1]]);
        near(two[first], x, 1e-6);
        near(two[first + 1], y, 1e-6);
    }
    for (a, b) in one[5..].iter().zip(&two[5..]) {
        // places from the groove's centre, of the size of a play
        near(*a, *b, 1e-6);
    }
}

/// Distance between two motions over the motion about the mean: the largest over shaft and balls.
fn apart(one: &[State], other: &[State], first: usize) -> f64 {
    let coordinate = |place: usize| {
        let mean = one.iter().map(|state| state.y[place]).sum::<f64>() / one.len() as f64;
        let size: f64 = one.iter().map(|state| (state.y[place] - mean).powi(2)).sum();
        let apart: f64 = one.iter().zip(other).map(|(a, b)| (a.y[place] - b.y[place]).powi(2)).sum();
        (apart / size).sqrt()
    };
    (first..one[0].y.len()).map(coordinate).fold(0.0, f64::max)
}

/// The pair at 50 Hz on 40 modes, each outer ring set against the other by `preload` (m): the states every 0.1 ms of a run whose
/// start is `kick` (m) beside the rest.
fn run_of_pair(preload: f64, kick: f64, (method, step): (Method, f64), intervals: u64) -> Vec<State> {
    let (structure, mut setup) = pair(50.0);
    for (own, sign) in setup.bearings.iter_mut().zip([-1.0, 1.0]) {
        own.contact_damping = 1.0;
        own.offset = sign * preload;
    }
    let modes = structure.modes().unwrap();
    let rest = SpatialEquilibrium::find(&structure, &setup, &SpatialCondition::at(&setup, 0.0)).unwrap();
    let (kept, damping) = (ModeSelection::Count(KEPT), ModalDamping::Uniform(0.01));
    let mut system = SpatialSystem::new(&structure, &modes, setup, kept, &damping).unwrap();
    let mut start = system.state_at(0.0, &rest, &modes);
    for (place, value) in start.y[KEPT..].iter_mut().enumerate() {
        *value += kick * (1.0 + (0.7 * place as f64).sin());
    }
    states(&mut system, start, method, step, intervals, (1e-4 / step).round() as u32)
}

const KEPT: usize = 40;
const ADAMS: (Method, f64) = (Method::ExponentialAdams { tolerance: Some(1e-6) }, 1e-7);
const DOP853: (Method, f64) = (Method::Dop853 { tolerance: 1e-10, events: true }, 1e-5);

/// By how much a kick of 1e-14 m grows.
fn growth(preload: f64, intervals: u64) -> f64 {
    let [one, other] = [0.0, 1e-14].map(|kick| run_of_pair(preload, kick, ADAMS, intervals));
    let pairs = one[intervals as usize].y[KEPT..].iter().zip(&other[intervals as usize].y[KEPT..]);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / 1e-14
}

/// Two methods that share nothing but the force. With 6 um of preload every ball carries load, and what is 1e-14 m apart stays so:
/// the scene has no chaos.
#[test]
fn independent_integrators_agree() {
    let grown = growth(6e-6, 50);
    println!("growth {grown:.1e}");
    assert!(grown < 100.0, "{grown:e}");
    let gap = apart(&run_of_pair(6e-6, 0.0, ADAMS, 50), &run_of_pair(6e-6, 0.0, DOP853, 50), KEPT);
    println!("apart {gap:.1e}");
    // over 5 ms; 1e-4 is what is asked for
    assert!(gap < 1e-6, "{gap:e}");
}

/// With 2 um four balls of the second bearing carry nothing and rattle between the races. Their motion is chaotic: methods agree for
/// a short time alone, however small their errors.
#[test]
fn balls_that_carry_nothing_are_chaotic() {
    let grown = growth(2e-6, 50);
    println!("growth {grown:.1e}");
    assert!(grown > 1e5, "{grown:e}");
    let gap = apart(&run_of_pair(2e-6, 0.0, ADAMS, 5), &run_of_pair(2e-6, 0.0, DOP853, 5), KEPT);
    println!("apart {gap:.1e}");
    // over 0.5 ms, in which what is apart has grown by a thousand
    assert!(gap < 1e-5, "{gap:e}");
}

/// What a step costs against the plane system's: seven balls, as many modes, one thread. Both take turns, so that what else the machine
/// does meets both.
#[test]
#[ignore = "prints a measurement: run it alone and in release"]
fn price_of_a_step() {
    // short against the time that the machine gives a thread at once
    const STEPS: u32 = 400;
    /// From the first observation to the last: what an integrator needs to begin does not count.
    #[derive(Default)]
    struct Clock([Option<std::time::Instant>; 2]);
    impl<S> Observer<S> for Clock {
        fn observe(&mut self, _: &S, now: Instant<'_>) {
            self.0[usize::from(now.step > 0)] = Some(std::time::Instant::now());
        }
    }
    fn seconds<S: SecondOrderSystem>(system: &mut S, start: &State, method: Option<Method>) -> f64 {
        let (mut g, mut clock, mut state) = (vec![0.0; start.y.len()], Clock::default(), start.clone());
        let now = |step: u64| Instant { step, t: start.t, y: &start.y, v: &start.v };
        if let Some(method) = method {
            let schedule = Schedule { interval: 1e-7 * f64::from(STEPS), steps_per_interval: STEPS, intervals: 1 };
            integrate(system, method, &schedule, &mut state, &mut clock, |_, _| Stepping::Continue).unwrap();
        } else {
            clock.observe(system, now(0));
            (0..STEPS).for_each(|_| system.force_into(start.t, &start.y, &start.v, &mut g));
            clock.observe(system, now(1));
        }
        let [first, last] = clock.0.map(Option::unwrap);
        (last - first).as_secs_f64() / f64::from(STEPS)
    }
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let adams = |tolerance| Some(Method::ExponentialAdams { tolerance });
    for modes in [8, 12, 24, 40] {
        let Twins { mut plane, mut spatial } = Twins::new(ModeSelection::Count(modes), &[]);
        for (what, method) in [("evaluation", None), ("step", adams(None)), ("with a tolerance", adams(Some(1e-4)))] {
            let pairs: Vec<[f64; 2]> = (0..101)
                .map(|_| [seconds(&mut plane.0, &plane.1, method), seconds(&mut spatial.0, &spatial.1, method)])
                .collect();
            let [a, b] = [0, 1].map(|k| 1e9 * median(pairs.iter().map(|pair| pair[k]).collect()));
            let ratio = median(pairs.iter().map(|[a, b]| b / a).collect());
            println!("{modes} modes, {what}: {a:.0} ns in the plane, {b:.0} ns in space, ratio {ratio:.2}");
        }
    }
}
