//! Reference: displacements and rating lives of another program for a ball bearing (Z 7, D 11.5 mm, d_m 43.5 mm, grooves 0.52 D and 0.53 D, 210 GPa), as
//! recorded in `Test_BallBearing.py` of the public repository minzhun/ISO16281.
//! Goal: radial and axial displacement, tilt and rating life under radial load, thrust and moment, with and without clearance.
//! Conditions: ISO/TS 16281: rigid rings, Hertz constants at the nominal contact angle 0 for every load; here given as such.
//! Parameters: the first ball is under the radial load.

use super::super::*;
use super::published::alone;
use crate::bearing::hertz::effective_modulus;
use crate::bearing::life::LoadRating;
use crate::bearing::{BearingDimensions, BearingGeometry, ContactMaterial, RaceContacts};
use approx::assert_relative_eq;

fn shaft(clearance: f64) -> RigidShaft {
    let (ball, pitch) = (11.5e-3, 43.5e-3);
    let dimensions = BearingDimensions {
        balls: 7,
        ball_radius: 0.5 * ball,
        ball_mass: 6.2e-3,
        inner_race_radius: 0.5 * (pitch - ball),
        outer_race_radius: 0.5 * (pitch + ball),
        inner_groove_radius: 0.52 * ball,
        outer_groove_radius: 0.53 * ball,
    };
    let geometry = BearingGeometry::new(dimensions).unwrap().with_radial_play(0.5 * clearance).unwrap();
    let steel = ContactMaterial { young: 210e9, poisson: 0.3 };
    let stiffness = RaceContacts::new(&geometry, steel, steel, steel).unwrap().stiffness();
    let modulus = effective_modulus([210e9; 2], [0.3; 2]).unwrap();
    let bearing = SpatialBearing::new(geometry, [modulus; 2], Thrust::Both, RaceControl::Outer).unwrap();
    alone(bearing.with_stiffness(stiffness), 0.0)
}

#[test]
fn displacements_are_those_of_another_program() {
    const UM: f64 = 1e-6;
    // clearance, radial and axial force, moment; displacement x, z, tilt about y; life in millions of revolutions with
    // C = 23.4 kN
    for (clearance, radial, axial, moment, expected, life) in [
        (0.0, 1000.0, 0.0, 0.0, [Some(15.1101 * UM), None, None], 13_163.019),
        (0.0, 0.0, 1000.0, 0.0, [None, Some(133.5381 * UM), None], 2222.7318),
        (10e-6, 1000.0, 0.0, 0.0, [Some(21.223 * UM), None, None], 10_795.795),
        (10e-6, 0.0, 1000.0, 0.0, [None, Some(149.1717 * UM), None], 3115.8781),
        (10e-6, 1000.0, 1000.0, 0.0, [Some(19.5923 * UM), Some(146.4603 * UM), Some(2.6872e-3)], 1630.5367),
        (0.0, 0.0, 0.0, 1.0, [None, None, Some(3.6957e-3)], 785_144.752),
        (10e-6, 1000.0, 1000.0, 1.0, [Some(19.7144 * UM), Some(146.3084 * UM), Some(2.7239e-3)], 1627.7479),
    ] {
        let load = ShaftLoad { force: [radial, 0.0, axial], moment: [moment, 0.0], ..ShaftLoad::default() };
        let shaft = shaft(clearance);
        let geometry = *shaft.bearings[0].bearing.geometry();
        let found = shaft.equilibrium(&load).unwrap();
        let [x, y, z] = found.displacement.translation;
        let [a, b] = found.displacement.tilt;
        let results = [x.hypot(y), z, a.hypot(b)];
        let loads: Vec<[f64; 2]> = found.bearings[0].balls.iter().map(|ball| ball.load).collect();
        let lasts = LoadRating::of(23_400.0, &geometry, 0.0).life(&loads, 0.0, 0.0).life_mrev.unwrap();
        println!(
            "{clearance} m, {radial} N, {axial} N, {moment} N m: {results:?}, {lasts}; recorded {expected:?}, {life}"
        );
        // printed digits for thrust alone; else as below: 4.5 times the difference of the radial displacement, half that of the tilt
        let allowed = if moment > 0.0 || (axial > 0.0 && radial > 0.0) {
            7e-3
        } else if axial > 0.0 {
            2e-5
        } else {
            2e-3
        };
        assert_relative_eq!(lasts, life, max_relative = allowed);
        assert!(found.is_stable() && found.directions_loose == 0);
        let tilted = axial > 0.0 && radial > 0.0;
        for (index, (found, expected)) in results.into_iter().zip(expected).enumerate() {
            let Some(expected) = expected else { continue };
            // printed digits for thrust alone; the shift of a circle across itself, x / (2 R) = 3e-4, for a radial load
            let allowed = match (index, tilted) {
                (1, false) => 1e-6,
                (0, false) => 5e-4,
                // the standard's levers are straight, and that of the tilt is the pitch radius: 1.1 % below that of the groove
                // centres; the force turns by the tilt of 2.7 mrad against contact angles of 0.25
                (1, true) => 5e-4,
                _ => 0.016,
            };
            assert_relative_eq!(found, expected, max_relative = allowed);
        }
    }
}

/// Which of the two is right where they differ: the standard's sums with the moment of the forces about the centre of the tilted ring, and
/// the rings' groove centres turned by exact sines, give 19.914 um, 146.443 um and 2.7179 mrad (solved by SciPy with the
/// standard's rounded constant 1.48). The recorded program's lever leaves the tilt out of the moment.
#[test]
fn with_exact_statics_the_standards_sums_are_met() {
    let load = ShaftLoad { force: [1000.0, 0.0, 1000.0], ..ShaftLoad::default() };
    let found = shaft(10e-6).equilibrium(&load).unwrap().displacement;
    for (found, expected) in
        [(found.translation[0], 19.914e-6), (found.translation[2], 146.443e-6), (found.tilt[1], 2.7179e-3)]
    {
        // those sums take each ball's groove centre at its own azimuth, whatever the tilt: 1e-3 of the displacement
        assert_relative_eq!(found, expected, max_relative = 1e-3);
    }
}
