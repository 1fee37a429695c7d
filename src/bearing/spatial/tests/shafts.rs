//! Shafts at rest: pairs, preload, prescribed displacements, and several equilibria.

use super::super::*;
use super::derivatives::bearing;
use super::published::{alone, harris_218};
use crate::bearing::samples::source_bearing;
use approx::assert_relative_eq;

fn pair(thrusts: [Thrust; 2]) -> RigidShaft {
    let mounted = |thrust, place| MountedBearing {
        bearing: bearing(thrust, RaceControl::Outer),
        place,
        offset: 0.0,
        cage_angle: 0.1,
    };
    RigidShaft::new(vec![mounted(thrusts[0], -3e-3), mounted(thrusts[1], 3e-3)], 0.0).unwrap()
}

/// Back to back the contact lines meet the axis outside the pair, face to face between the bearings: the lever, and the stiffness
/// against tilt, is larger back to back. The radial and the axial stiffness are the same.
#[test]
fn back_to_back_is_stiffer_against_tilt() {
    let [o, x] = [Thrust::BACK_TO_BACK, Thrust::FACE_TO_FACE].map(|thrusts| {
        let shaft = pair(thrusts).preloaded(20.0).unwrap();
        shaft.equilibrium(&ShaftLoad::default()).unwrap()
    });
    for found in [&o, &x] {
        // the pair carries the preload, each in its own direction, and the shaft stays where it is
        let [first, second] = [found.bearings[0].load[2], found.bearings[1].load[2]];
        assert_relative_eq!(first.abs(), 20.0, max_relative = 1e-9);
        assert_relative_eq!(first, -second, max_relative = 1e-9);
        assert!(found.displacement.vector().amax() < 1e-15, "{:?}", found.displacement);
        assert!(found.is_stable());
    }
    assert!(o.bearings[0].load[2] > 0.0 && x.bearings[0].load[2] < 0.0);
    println!("tilting stiffness: back to back {:.4}, face to face {:.4} N m/rad", o.stiffness[3][3], x.stiffness[3][3]);
    assert!(o.stiffness[3][3] > 3.0 * x.stiffness[3][3]);
    for axis in 0..3 {
        assert_relative_eq!(o.stiffness[axis][axis], x.stiffness[axis][axis], max_relative = 1e-6);
    }
    // k_tilt = 2 k_r (a + b)^2, springs along the contact lines as they meet the axis: R tan a0 = 1.81 mm beside 3 mm
    let ratio = (3e-3_f64 + 3.755e-3 * 0.46_f64.tan()) / (3e-3 - 3.755e-3 * 0.46_f64.tan());
    assert_relative_eq!(o.stiffness[3][3] / x.stiffness[3][3], ratio * ratio, max_relative = 0.25);
}

/// The shaft's stiffness is the change of the load that holds it, displacements prescribed: lever arms and turned loads included.
#[test]
fn the_shafts_stiffness_is_the_derivative_of_what_holds_it() {
    let mut shaft = pair(Thrust::BACK_TO_BACK).preloaded(20.0).unwrap();
    shaft.speed = 3000.0;
    let load = ShaftLoad { force: [2.0, -5.0, 3.0], moment: [0.01, -0.02], place: 8e-3 };
    let at = [1e-6, -2e-6, 1e-6, 2e-4, 1e-4];
    let holding = |q: [f64; 5]| {
        let shaft = RigidShaft { held: q.map(Some), ..shaft.clone() };
        shaft.equilibrium(&load).unwrap()
    };
    let found = holding(at);
    let scale = [1.0, 1.0, 1.0, 3e-3, 3e-3];
    for axis in 0..5 {
        let step = 1e-9 / scale[axis];
        let [mut low, mut high] = [at; 2];
        low[axis] -= step;
        high[axis] += step;
        let [before, after] = [holding(low), holding(high)].map(|found| found.holding_load);
        for row in 0..5 {
            let rate = (after[row] - before[row]) / (2.0 * step);
            // differences over a nanometre: 1e-7 of the curvature of the force law; 1e-6 of the radial stiffness
            let unit = scale[row] * scale[axis];
            let error = (rate - found.stiffness[row][axis]).abs() / unit;
            assert!(error < 1e-6 * found.stiffness[0][0], "{row} {axis}: {rate} {}", found.stiffness[row][axis]);
        }
    }
}

/// Loads come back from the bearings; a moment about one place is that about another with the force's lever.
#[test]
fn loads_are_carried_and_levers_count() {
    let shaft = pair(Thrust::BACK_TO_BACK).preloaded(20.0).unwrap();
    let at = |place: f64, moment: [f64; 2]| {
        shaft.equilibrium(&ShaftLoad { force: [1.0, -6.0, 4.0], moment, place }).unwrap()
    };
    let found = at(8e-3, [0.0; 2]);
    for (axis, force) in [1.0, -6.0, 4.0].into_iter().enumerate() {
        let sum: f64 = found.bearings.iter().map(|state| state.load[axis]).sum();
        assert_relative_eq!(sum, force, max_relative = 1e-9);
    }
    // moment of a force at z about the origin: M_x = -z F_y, M_y = z F_x; exact but for tilts of 1e-3
    let other = at(0.0, [8e-3 * 6.0, 8e-3]);
    let [a, b] = [&found, &other].map(|found| found.displacement.vector());
    assert!((a - b).amax() < 1e-4 * a.amax(), "{a} {b}");
    assert!(a[3] > 1e-6);
}

/// A deep groove bearing with play carries thrust along either side, at the free contact angle and beyond.
#[test]
fn a_deep_groove_bearing_carries_thrust_both_ways() {
    let shaft = alone(bearing(Thrust::Both, RaceControl::Outer), 0.0);
    let along =
        |force: f64| shaft.equilibrium(&ShaftLoad { force: [0.0, 0.0, force], ..ShaftLoad::default() }).unwrap();
    let (up, down) = (along(5.0), along(-5.0));
    assert_relative_eq!(up.displacement.translation[2], -down.displacement.translation[2], max_relative = 1e-9);
    let free = source_bearing().with_radial_play(5e-6).unwrap().free_contact_angle().unwrap();
    let angle = up.bearings[0].balls[3].contact_angle[0].unwrap();
    assert!(angle > free && angle < free + 0.1, "{angle} {free}");
    let found = bearing(Thrust::Both, RaceControl::Outer).axial_displacement(5.0).unwrap();
    assert_relative_eq!(found, up.displacement.translation[2], max_relative = 1e-9);
    assert_relative_eq!(
        bearing(Thrust::Negative, RaceControl::Outer).axial_displacement(0.0).unwrap(),
        0.0,
        epsilon = 1e-12
    );
}

/// In play, a load straight on a ball has two equilibria, mirror images: the shaft leans to either side of the ball. The way
/// down from the undisplaced place leaves the saddle between them.
#[test]
fn a_load_on_a_ball_in_play_has_two_equilibria() {
    let mut shaft = alone(bearing(Thrust::Both, RaceControl::Outer), 0.0);
    shaft.bearings[0].cage_angle = -0.5 * std::f64::consts::PI;
    shaft.held = [None, None, None, Some(0.0), Some(0.0)];
    let load = ShaftLoad { force: [0.0, -2.0, 0.0], ..ShaftLoad::default() };
    let all = shaft.find_all(&load).unwrap();
    assert_eq!(all.len(), 3);
    for found in &all[..2] {
        assert!(found.is_stable() && found.directions_loose == 0 && found.least_stiffness.unwrap() > 1e3);
        // round-off of the forces
        assert!(found.residual_n < 1e-9, "{}", found.residual_n);
        assert_relative_eq!(found.bearings[0].load[1], -2.0, max_relative = 1e-8);
    }
    let [a, b] = [&all[0], &all[1]].map(|found| found.displacement.translation);
    assert!(a[0].abs() > 1e-7);
    assert_relative_eq!(a[0], -b[0], max_relative = 1e-6);
    assert_relative_eq!(a[1], b[1], max_relative = 1e-6);
    // the saddle stands straight on the ball, one direction falls
    let saddle = &all[2];
    assert_eq!(saddle.directions_down, 1);
    assert!(!saddle.is_stable() && saddle.displacement.translation[0].abs() < 1e-12, "{:?}", saddle.displacement);
    assert_relative_eq!(saddle.bearings[0].balls[0].load[0], 2.0, max_relative = 1e-6);
    // a direction that nothing holds is counted: without a load the shaft floats in its play
    let floating = shaft.equilibrium(&ShaftLoad::default()).unwrap();
    assert_eq!(floating.directions_loose, 3);
    assert!(floating.least_stiffness.is_none());
}

#[test]
fn what_cannot_be_carried_is_an_error() {
    let push = |thrust, force| {
        let shaft = alone(bearing(thrust, RaceControl::Outer), 0.0);
        shaft.equilibrium(&ShaftLoad { force, ..ShaftLoad::default() }).map_err(|error| error.to_string())
    };
    let error = push(Thrust::Positive, [0.0, 0.0, -5.0]).unwrap_err();
    assert!(error.contains("no equilibrium") || error.contains("apart"), "{error}");
    let error = push(Thrust::Negative, [0.0, -5.0, 0.0]).unwrap_err();
    assert!(error.contains("apart: it holds thrust along -z only"), "{error}");
    let error = push(Thrust::Both, [0.0, f64::NAN, 0.0]).unwrap_err();
    assert_eq!(error, "load = NaN must be finite");
    let error = pair([Thrust::Positive; 2]).preloaded(1.0).unwrap_err().to_string();
    assert!(error.contains("as many bearings that thrust along +z as along -z"), "{error}");
    let error = RigidShaft::new(Vec::new(), 0.0).unwrap_err().to_string();
    assert_eq!(error, "a shaft needs at least one bearing");
    let error = harris_218(RaceControl::Outer).axial_displacement(1e12).unwrap_err().to_string();
    assert!(error.contains("presses the balls through the grooves"), "{error}");
}
