//! Reference: T. A. Harris, *Rolling Bearing Analysis*, 4th edition: table 7.4 (sums of ball loads), section 7.4 with the 218 angular
//! contact bearing; `RaceContacts` and the Hertz law of the plane model.
//! Goal: the bearing's own ball loads meet published sums, and the plane model where nothing leaves the plane.
//! Conditions: rigid rings, no speed.
//! Parameters: tolerances are those of the printed digits, or of round-off.

use super::super::*;
use super::derivatives::{bearing, moduli};
use crate::bearing::hertz::effective_modulus;
use crate::bearing::samples::{source_bearing, source_dimensions, steel};
use crate::bearing::{BearingDimensions, BearingGeometry, HertzContact, RaceContacts};
use approx::assert_relative_eq;
use std::f64::consts::TAU;

/// Harris's 218 angular contact bearing: Z 16, D 22.23 mm, d_m 125.26 mm, f 0.5232, free contact angle 40 degrees.
pub(super) fn harris_218(control: RaceControl) -> SpatialBearing {
    let (ball, pitch): (f64, f64) = (22.23e-3, 125.26e-3);
    let play = 0.0464 * ball * (1.0 - 40_f64.to_radians().cos());
    let dimensions = BearingDimensions {
        balls: 16,
        ball_radius: 0.5 * ball,
        ball_mass: 7800.0 * std::f64::consts::PI / 6.0 * ball.powi(3),
        // the play is shared, so that the pitch diameter is as printed
        inner_race_radius: 0.5 * (pitch - ball - play),
        outer_race_radius: 0.5 * (pitch + ball + play),
        inner_groove_radius: 0.5232 * ball,
        outer_groove_radius: 0.5232 * ball,
    };
    let geometry = BearingGeometry::new(dimensions).unwrap();
    let modulus = effective_modulus([207e9; 2], [0.3; 2]).unwrap();
    SpatialBearing::new(geometry, [modulus; 2], Thrust::Positive, control).unwrap()
}

pub(super) fn alone(bearing: SpatialBearing, speed: f64) -> RigidShaft {
    RigidShaft::new(vec![MountedBearing { bearing, place: 0.0, offset: 0.0, cage_angle: 0.0 }], speed).unwrap()
}

/// Thrust of 17 800 N without speed: angle 41.5 degrees, 1679 N a ball with exact Hertz constants; the handbook has 41.6 and 1676.
#[test]
fn the_218_bearing_under_thrust_has_its_angle_and_loads() {
    let shaft = alone(harris_218(RaceControl::Outer), 0.0);
    let load = ShaftLoad { force: [0.0, 0.0, 17_800.0], ..ShaftLoad::default() };
    let found = shaft.equilibrium(&load).unwrap();
    let balls = &found.bearings[0].balls;
    let angle = balls[0].contact_angle[0].unwrap().to_degrees();
    println!("218, 17800 N: {angle:.3} deg, {:.2} N, {:.5e} m", balls[0].load[0], found.displacement.translation[2]);
    assert_relative_eq!(angle, 41.5, epsilon = 0.05);
    assert_relative_eq!(balls[0].load[0], 1679.0, epsilon = 0.5);
    // under thrust alone all balls are alike to round-off
    for ball in balls {
        assert_relative_eq!(ball.load[0], balls[0].load[0], max_relative = 1e-12);
        assert_relative_eq!(ball.contact_angle[1].unwrap(), balls[0].contact_angle[1].unwrap(), max_relative = 1e-12);
    }
}

/// Harris, table 7.4: eps; F_r tan a / F_a; J_r; J_a.
const TABLE_7_4: [[f64; 4]; 6] = [
    [0.2, 0.9318, 0.1590, 0.1707],
    [0.5, 0.8225, 0.2288, 0.2782],
    [0.8, 0.6995, 0.2559, 0.3658],
    [1.0, 0.6000, 0.2546, 0.4244],
    [1.67, 0.3088, 0.1871, 0.6060],
    [5.0, 0.0831, 0.0711, 0.8558],
];

/// Loads of 200 balls, five bearings of 40 with their cages turned: J_r and J_a by the model's own ball loads. The table is of a constant
/// contact angle, which the model has in the limit of small loads.
#[test]
fn sums_of_ball_loads_meet_table_7_4() {
    let angle = 40_f64.to_radians();
    let dimensions = BearingDimensions {
        balls: 40,
        ball_radius: 0.2e-3,
        inner_groove_radius: 0.2092e-3,
        outer_groove_radius: 0.2092e-3,
        inner_race_radius: 9.8e-3,
        outer_race_radius: 10.2e-3,
        ball_mass: 1e-7,
    };
    let geometry = BearingGeometry::new(dimensions).unwrap().with_free_contact_angle(angle).unwrap();
    let bearing = SpatialBearing::new(geometry, [113e9; 2], Thrust::Positive, RaceControl::Outer).unwrap();
    for [eps, ratio, j_r, j_a] in TABLE_7_4 {
        // penetration of the ball at psi: d_a sin a + d_r cos a cos psi; eps = (1 + d_a tan a / d_r) / 2
        let most = 1e-8;
        let radial = most / (2.0 * eps * angle.cos());
        let axial = (2.0 * eps - 1.0) * radial / angle.tan();
        let displacement = RingDisplacement { translation: [radial, 0.0, axial], tilt: [0.0; 2] };
        let (mut load, mut largest) = ([0.0; 5], 0.0_f64);
        for turned in 0..5 {
            let condition = BearingCondition { cage_angle: TAU * f64::from(turned) / 200.0, shaft_speed: 0.0 };
            let state = bearing.state(&displacement, condition).unwrap();
            for (sum, part) in load.iter_mut().zip(state.load) {
                *sum += part;
            }
            largest = state.balls.iter().fold(largest, |most, ball| most.max(ball.load[0]));
        }
        let found = [
            load[0] * angle.tan() / load[2],
            load[0] / (200.0 * largest * angle.cos()),
            load[2] / (200.0 * largest * angle.sin()),
        ];
        println!("eps {eps}: {:.4} {:.4} {:.4}; table {ratio} {j_r} {j_a}", found[0], found[1], found[2]);
        for (found, printed) in found.into_iter().zip([ratio, j_r, j_a]) {
            // the change of the angle at a penetration of 5e-4 of A, and 200 balls for an integral
            assert_relative_eq!(found, printed, max_relative = 0.05);
        }
    }
}

/// Without play the Hertz constants at no angle are those of the plane model, and so are the forces of an inner ring that stays in the
/// plane: those of two circles.
#[test]
fn in_the_plane_forces_are_those_of_the_plane_model() {
    let dimensions = BearingDimensions {
        outer_race_radius: source_dimensions().inner_race_radius + 2.0 * source_dimensions().ball_radius,
        ..source_dimensions()
    };
    let geometry = BearingGeometry::new(dimensions).unwrap();
    let contacts = RaceContacts::new(&geometry, steel(), steel(), steel()).unwrap().stiffness();
    let bearing = SpatialBearing::new(geometry, moduli(&geometry), Thrust::Both, RaceControl::Outer).unwrap();
    let shift = [2e-6, -5e-6];
    let displacement = RingDisplacement { translation: [shift[0], shift[1], 0.0], tilt: [0.0; 2] };
    let state = bearing.state(&displacement, BearingCondition { cage_angle: 0.4, shaft_speed: 0.0 }).unwrap();
    let law = |stiffness| HertzContact { stiffness, damping: 0.0 };
    let mut sum = [0.0; 2];
    let mut loaded = 0;
    for ball in &state.balls {
        let (sin, cos) = ball.azimuth.sin_cos();
        let outer = law(contacts.outer()).force(ball.penetration[1], 0.0);
        assert_relative_eq!(outer, ball.load[1], max_relative = 1e-10);
        if ball.load[0] <= 0.0 {
            continue;
        }
        loaded += 1;
        // the ball's centre, from the outer race's penetration; the inner race is a circle about the shaft
        let radius = geometry.outer_race_radius() - geometry.ball_radius() + ball.penetration[1];
        let from_shaft = [radius * cos - shift[0], radius * sin - shift[1]];
        let distance = from_shaft[0].hypot(from_shaft[1]);
        let overlap = geometry.effective_inner_race_radius() + geometry.ball_radius() - distance;
        // overlaps are differences of millimetres: 1e-10 of a micron
        let inner = law(contacts.inner()).force(overlap, 0.0);
        assert_relative_eq!(inner, ball.load[0], max_relative = 1e-8);
        for axis in 0..2 {
            sum[axis] += inner * from_shaft[axis] / distance;
        }
    }
    assert_eq!(loaded, 3);
    for (sum, load) in sum.into_iter().zip(state.load) {
        assert_relative_eq!(sum, load, max_relative = 1e-8);
    }
    // nothing leaves the plane
    for part in &state.load[2..] {
        assert!(part.abs() < 1e-12 * state.load[1].abs(), "{part}");
    }
}

/// A turned scene has turned results, at speed and with tilt.
#[test]
fn results_turn_with_the_scene() {
    for (thrust, speed) in [(Thrust::Both, 0.0), (Thrust::Negative, 4000.0)] {
        let bearing = bearing(thrust, RaceControl::Shared);
        let sign = if thrust == Thrust::Negative { -1.0 } else { 1.0 };
        let (t, tilt) = ([2e-6, -4e-6, sign * 4e-5], [2e-3, -1e-3]);
        let of = |turn: f64| {
            let (sin, cos) = turn.sin_cos();
            let turned = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
            let [x, y] = turned([t[0], t[1]]);
            let displacement = RingDisplacement { translation: [x, y, t[2]], tilt: turned(tilt) };
            let condition = BearingCondition { cage_angle: 0.3 + turn, shaft_speed: speed };
            let load = bearing.state(&displacement, condition).unwrap().load;
            let back = |[x, y]: [f64; 2]| [cos * x + sin * y, cos * y - sin * x];
            let ([x, y], [a, b]) = (back([load[0], load[1]]), back([load[3], load[4]]));
            [x, y, load[2], a, b]
        };
        let base = of(0.0);
        let pitch = source_bearing().pitch_radius();
        let most = base[2].abs().max(base[0].abs());
        assert!(most > 1.0);
        for turn in [0.5, 1.7, 4.0] {
            let turned = of(turn);
            for (row, unit) in [1.0, 1.0, 1.0, pitch, pitch].into_iter().enumerate() {
                assert!(
                    (turned[row] - base[row]).abs() < 1e-12 * most * unit,
                    "{thrust:?} {turn} {row} {base:?} {turned:?}"
                );
            }
        }
    }
}
