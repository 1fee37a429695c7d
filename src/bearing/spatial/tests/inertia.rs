//! Balls with inertia: rolling, angular momentum, states of lost contact, and random scenes.

use super::super::*;
use super::derivatives::bearing;
use super::published::{alone, harris_218};
use crate::bearing::hertz::{PrincipalCurvatures, effective_modulus, stiffness};
use crate::bearing::kinematics::BallRow;
use approx::assert_relative_eq;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// The friction turns each ball's angular momentum as its orbit asks, by vectors: speeds that roll at both contacts, the rate
/// ω_c × J Ω, and the moments of both frictions about the ball's centre. The ball is in balance with them.
#[test]
fn friction_turns_the_balls_angular_momentum() {
    for control in [RaceControl::Outer, RaceControl::Shared] {
        let bearing = harris_218(control);
        let speed = TAU * 10_000.0 / 60.0;
        let found = alone(bearing.clone(), speed)
            .equilibrium(&ShaftLoad { force: [0.0, 0.0, 22_250.0], ..ShaftLoad::default() })
            .unwrap();
        let ball = found.bearings[0].balls[0];
        let law = &bearing.law;
        let [a_i, a_o] = ball.contact_angle.map(Option::unwrap);
        // axes: outwards, around, along
        let normal = |angle: f64| Vector3::new(angle.cos(), 0.0, angle.sin());
        let (n_i, n_o) = (normal(a_i), normal(a_o));
        let radius = 0.5 * law.diameter;
        let own = ball.spin_speed * Vector3::new(ball.pitch_angle.sin(), 0.0, -ball.pitch_angle.cos());
        // seen from the cage: the outer race goes backwards, the inner one forwards
        let race = |n: Vector3<f64>, turn: f64, side: f64| turn * (0.5 * law.pitch_diameter + side * radius * n.x);
        let at_outer = own.cross(&(radius * n_o)).y;
        let at_inner = own.cross(&(-radius * n_i)).y;
        // speeds follow the lines of centres, which differ by some 1e-4 rad from the directions of the forces
        assert_relative_eq!(at_outer, race(n_o, -ball.orbital_speed, 1.0), max_relative = 3e-4);
        assert_relative_eq!(at_inner, race(n_i, speed - ball.orbital_speed, -1.0), max_relative = 3e-4);
        // outer race control: the ball does not spin against the outer race about the contact's normal
        let against = own - Vector3::new(0.0, 0.0, -ball.orbital_speed);
        assert!(against.dot(&n_o).abs() < 1e-3 * against.norm());

        let inertia = 0.1 * law.mass * law.diameter.powi(2);
        let orbit = Vector3::new(0.0, 0.0, ball.orbital_speed);
        let rate = orbit.cross(&(inertia * (own + orbit)));
        assert_relative_eq!(rate.y, ball.gyroscopic_moment, max_relative = 1e-12);
        // frictions on the ball, as the balance has them
        let [share_i, share_o] = if control == RaceControl::Outer { [0.0, 2.0] } else { [1.0, 1.0] };
        let size = ball.gyroscopic_moment / law.diameter;
        let friction_o = share_o * size * Vector3::new(a_o.sin(), 0.0, -a_o.cos());
        let friction_i = share_i * size * Vector3::new(-a_i.sin(), 0.0, a_i.cos());
        let moment = (radius * n_o).cross(&friction_o) + (-radius * n_i).cross(&friction_i);
        assert!((moment - rate).norm() < 1e-12 * rate.norm());
        let centrifugal = Vector3::new(ball.centrifugal_force, 0.0, 0.0);
        let sum = ball.load[0] * n_i - ball.load[1] * n_o + centrifugal + friction_i + friction_o;
        // friction is across the line of centres, some 1e-4 rad beside the force
        assert!(sum.norm() < 3e-4 * 2.0 * size, "{sum} {size}");
        // the ring carries its share: thrust by load and friction
        let thrust = 16.0 * (ball.load[0] * n_i.z + friction_i.z);
        assert_relative_eq!(thrust, 22_250.0, epsilon = 16.0 * 3e-4 * size);
        println!(
            "218, 22250 N, 10000 rpm, {control:?}: inner {:.2} deg {:.1} N, outer {:.2} deg {:.1} N, orbit {:.4}, F_c {:.1} N, M_g {:.4} N m",
            a_i.to_degrees(),
            ball.load[0],
            a_o.to_degrees(),
            ball.load[1],
            ball.orbital_speed / speed,
            ball.centrifugal_force,
            ball.gyroscopic_moment
        );
        assert!(a_o < a_i && ball.load[1] > ball.load[0]);
    }
}

/// Speeds with equal contact angles are those of the orders at that angle.
#[test]
fn speeds_at_rest_angles_are_the_orders() {
    let shaft = alone(harris_218(RaceControl::Outer), 1e-3);
    let load = ShaftLoad { force: [0.0, 0.0, 17_800.0], ..ShaftLoad::default() };
    let ball = shaft.equilibrium(&load).unwrap().bearings[0].balls[0];
    let orders = BallRow::new(16, 22.23e-3, 125.26e-3, ball.contact_angle[0].unwrap()).unwrap().orders();
    // speeds follow the lines of centres, 1e-4 beside the directions of the forces
    assert_relative_eq!(ball.orbital_speed / 1e-3, orders.cage, max_relative = 1e-4);
    assert_relative_eq!(
        ball.spin_speed * (ball.pitch_angle - ball.contact_angle[1].unwrap()).cos() / 1e-3,
        orders.ball_spin,
        max_relative = 1e-4
    );
}

/// Patches and pressures are those of the curvatures at the contact angle in force, by Harris's sums (2.28), (2.30).
#[test]
fn patches_belong_to_the_angle_in_force() {
    let bearing = harris_218(RaceControl::Outer);
    let load = ShaftLoad { force: [0.0, 0.0, 17_800.0], ..ShaftLoad::default() };
    let ball = alone(bearing.clone(), 0.0).equilibrium(&load).unwrap().bearings[0].balls[0];
    for (race, sign) in [(0, 1.0), (1, -1.0)] {
        let gamma = sign * 22.23 / 125.26 * ball.contact_angle[race].unwrap().cos();
        let sum = (4.0 - 1.0 / 0.5232 + 2.0 * gamma / (1.0 - gamma)) / 22.23e-3;
        let flat = (1.0 / 0.5232 + 2.0 * gamma / (1.0 - gamma)) / (sum * 22.23e-3);
        // a body of this sum and difference against a flat
        let body = PrincipalCurvatures { plane_1: 0.5 * sum * (1.0 - flat), plane_2: 0.5 * sum * (1.0 + flat) };
        let modulus = effective_modulus([207e9; 2], [0.3; 2]).unwrap();
        let patch = stiffness(body, PrincipalCurvatures::flat(), modulus).unwrap().patch(ball.load[race]);
        assert_relative_eq!(ball.patch[race].peak_pressure, patch.peak_pressure, max_relative = 1e-9);
        assert_relative_eq!(ball.patch[race].longer, patch.longer, max_relative = 1e-9);
    }
}

/// A ball that only the outer race holds carries its centrifugal force at no angle; without speed it touches nothing. Neither loads
/// the ring.
#[test]
fn balls_without_inner_contact_are_states_too() {
    let bearing = bearing(Thrust::Both, RaceControl::Shared);
    let centred = RingDisplacement::default();
    let state = bearing.state(&centred, BearingCondition { cage_angle: 0.2, shaft_speed: 3000.0 }).unwrap();
    for ball in &state.balls {
        assert!(ball.load[0] <= 0.0 && ball.contact_angle[0].is_none());
        assert_relative_eq!(ball.load[1], ball.centrifugal_force, max_relative = 1e-12);
        assert!(ball.contact_angle[1].unwrap().abs() < 1e-12);
        assert!(ball.patch[1].peak_pressure > 1e7);
    }
    let still = bearing.state(&centred, BearingCondition::default()).unwrap();
    assert!(
        still
            .balls
            .iter()
            .all(|ball| ball.load.iter().all(|load| load.abs() <= 0.0) && ball.contact_angle == [None; 2])
    );
    for state in [&state, &still] {
        assert!(state.load.iter().chain(state.stiffness.iter().flatten()).all(|value| value.abs() <= 0.0));
    }
}

/// Without speed the stiffness is symmetric to round-off, with it the friction makes it lopsided.
#[test]
fn without_speed_the_stiffness_is_symmetric() {
    let bearing = bearing(Thrust::Positive, RaceControl::Shared);
    let displacement = RingDisplacement { translation: [2e-6, -4e-6, 4e-6], tilt: [2e-3, -1e-3] };
    let lopsided = |speed: f64| {
        let state = bearing.state(&displacement, BearingCondition { cage_angle: 0.3, shaft_speed: speed }).unwrap();
        let k = state.stiffness;
        let unit = |row: usize| if row < 3 { 1.0 } else { 1.0 / bearing.geometry().pitch_radius() };
        let largest = (0..5).fold(0.0_f64, |most, row| most.max(k[row][row] * unit(row) * unit(row)));
        let pairs = (0..5).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs.fold(0.0_f64, |most, (a, b)| most.max((k[a][b] - k[b][a]).abs() * unit(a) * unit(b))) / largest
    };
    assert!(lopsided(0.0) < 1e-14, "{}", lopsided(0.0));
    assert!(lopsided(10_000.0) > 1e-6, "{}", lopsided(10_000.0));
}

/// Balls find their place in scenes of every kind: from no load to a tenth of the groove distance, at rest and at high speed.
#[test]
fn every_ball_finds_its_place() {
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    // a ball beside the inner groove's centre, which says nothing of the angle at which it rolls
    let displacement = RingDisplacement {
        translation: [2.744905190908074e-5, -2.0377076329284468e-5, 1.240533316890416e-5],
        tilt: [0.0005447775719174451, -0.004722319129233072],
    };
    let condition = BearingCondition { cage_angle: 1.9148059512307998, shaft_speed: 23_546.0 };
    bearing(Thrust::Both, RaceControl::Outer).state(&displacement, condition).unwrap();
    let mut loaded = 0;
    for thrust in [Thrust::Both, Thrust::Positive, Thrust::Negative] {
        for control in [RaceControl::Outer, RaceControl::Shared] {
            let bearing = bearing(thrust, control);
            for _ in 0..300 {
                let size = 10_f64.powf(-5.5 + 1.2 * random());
                let displacement = RingDisplacement {
                    translation: [size * random(), size * random(), 10.0 * size * random()],
                    tilt: [300.0 * size * random(), 300.0 * size * random()],
                };
                let speed = if random() > 0.5 { 0.0 } else { 10_f64.powf(3.0 + 1.5 * random()) };
                let condition = BearingCondition { cage_angle: 3.0 * random(), shaft_speed: speed };
                let state = bearing.state(&displacement, condition);
                let state = state.unwrap_or_else(|error| panic!("{thrust:?} {displacement:?} {condition:?}: {error}"));
                loaded += state.balls.iter().filter(|ball| ball.load[0] > 0.0).count();
            }
        }
    }
    assert!(loaded > 2_000, "{loaded}");
}
