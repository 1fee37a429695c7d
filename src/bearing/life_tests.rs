//! Reference: the table of f_c in ISO 281:2007 (single row radial contact groove); NSK's load ratings are in `catalogue`. Lives recorded in
//! `Test_BallBearing.py` of the public repository minzhun/ISO16281.
//! Goal: load rating and life are those of the standards to the digits that are printed.
//! Conditions: loads by the bearing's own equilibrium, with C as that program has it.

use super::*;
use crate::bearing::{BearingDimensions, BearingGeometry};
use approx::assert_relative_eq;

/// f_c of ISO 281:2007, table 2, for γ of 0.01, 0.02, ... 0.40.
const F_C: [f64; 40] = [
    29.1, 35.8, 40.3, 43.8, 46.7, 49.1, 51.1, 52.8, 54.3, 55.5, 56.6, 57.5, 58.2, 58.8, 59.3, 59.6, 59.8, 59.9, 60.0,
    59.9, 59.8, 59.6, 59.3, 59.0, 58.6, 58.2, 57.7, 57.1, 56.6, 56.0, 55.3, 54.6, 53.9, 53.2, 52.4, 51.7, 50.9, 50.0,
    49.2, 48.4,
];

#[test]
fn every_f_c_of_the_standard_is_met() {
    for (row, printed) in (1..).zip(F_C) {
        let pitch = 100e-3 / f64::from(row);
        // one ball of 1 mm
        let f_c = basic_load_rating(1.0, [1e-3, pitch], 0.0, WIDEST) / 1.3;
        // half a digit of the table
        assert!((f_c - printed).abs() < 0.05, "{row}: {f_c}, {printed}");
    }
}

/// Z 7, D 11.5 mm, d_m 43.5 mm: 6305.
fn geometry() -> BearingGeometry {
    let dimensions = BearingDimensions {
        balls: 7,
        ball_radius: 5.75e-3,
        ball_mass: 6.2e-3,
        inner_race_radius: 16e-3,
        outer_race_radius: 27.5e-3,
        inner_groove_radius: 0.52 * 11.5e-3,
        outer_groove_radius: 0.53 * 11.5e-3,
    };
    BearingGeometry::new(dimensions).unwrap()
}

const MODULI: [f64; 2] = [115e9; 2];

/// All balls alike carry the load rating of the bearing's own definition: a radial C whose balls share it lasts a million revolutions.
/// Of one loaded ball the race that turns feels Q/Z^(1/3), the one at rest Q/Z^0.3.
#[test]
fn the_turning_race_feels_the_mean_and_the_other_each_ball() {
    let rating = LoadRating::of(23_400.0, &geometry(), 0.0);
    let [inner, outer] = rating.of_ball;
    let alone = |race: usize, load: f64| {
        // a bearing whose inner race carries nothing has no life
        let mut loads = [[1e-9; 2]; 7];
        loads[3][race] = load;
        rating.life(&loads, 0.0, 0.0).life_mrev.unwrap()
    };
    assert_relative_eq!(alone(0, 2.0 * inner * 7_f64.cbrt()), 0.125, max_relative = 1e-12);
    assert_relative_eq!(alone(1, 2.0 * outer * 7_f64.powf(0.3)), 0.125, max_relative = 1e-12);
    // both races of all balls: lives as the powers 10/9
    let both = rating.life(&[rating.of_ball; 7], 0.0, 100.0 * TAU / 60.0);
    assert_relative_eq!(both.life_mrev.unwrap(), 2_f64.powf(-0.9), max_relative = 1e-12);
    assert_relative_eq!(both.life_h.unwrap(), 2_f64.powf(-0.9) * 1e6 / 6000.0, max_relative = 1e-12);
    assert_relative_eq!(both.reference_load_n.unwrap(), 23_400.0 * 2_f64.powf(0.3), max_relative = 1e-12);
}

/// A life is not given at rest, without load, or where races are dented for good.
#[test]
fn no_life_without_load_or_with_dented_races() {
    let rating = LoadRating::of(23_400.0, &geometry(), 0.0);
    let at_rest = rating.life(&[[100.0; 2]; 7], 4e9, 0.0);
    assert!(at_rest.life_mrev.is_some() && at_rest.life_h.is_none());
    for (load, pressure) in [(0.0, 0.0), (100.0, 4.3e9)] {
        let none = rating.life(&[[load; 2]; 7], pressure, 100.0);
        assert_eq!((none.life_mrev, none.life_h, none.reference_load_n), (None, None, None));
        assert_relative_eq!(none.load_rating_n, 23_400.0);
    }
}

#[test]
fn what_the_standard_does_not_hold_for_is_named() {
    let refused = |angle: f64, moduli| LoadRating::new(&geometry(), angle, moduli).unwrap_err().to_string();
    let hybrid = refused(0.0, [115e9, 136e9]);
    assert!(
        hybrid.starts_with("effective modulus of the outer contact in GPa = 136 must be that of steel"),
        "{hybrid}"
    );
    assert!(refused(60_f64.to_radians(), MODULI).contains("must be at most 45: above is a thrust bearing"));
    assert!(LoadRating::new(&geometry(), 45_f64.to_radians(), MODULI).is_ok());
    let thin = BearingDimensions {
        ball_radius: 0.2e-3,
        inner_race_radius: 49.8e-3,
        outer_race_radius: 50.2e-3,
        inner_groove_radius: 0.208e-3,
        outer_groove_radius: 0.212e-3,
        ..*geometry().dimensions()
    };
    let thin = LoadRating::new(&BearingGeometry::new(thin).unwrap(), 0.0, MODULI).unwrap_err().to_string();
    assert!(thin.ends_with("must be within 0.01 and 0.40"), "{thin}");
}

/// Wider grooves carry less and narrower ones no more.
#[test]
fn wide_grooves_have_a_lower_rating() {
    let rating = |conformities| basic_load_rating(7.0, [11.5e-3, 43.5e-3], 0.0, conformities);
    let full = rating(WIDEST);
    assert_relative_eq!(rating([0.505, 0.51]), full, max_relative = 1e-15);
    assert!(rating([0.5202, 0.53]) < full && rating([0.52, 0.535]) < full);
}

/// Half a ring of balls under a radial load C, the largest load by Stribeck's sum at that angle, lasts a million revolutions.
#[test]
fn the_load_rating_lasts_a_million_revolutions_at_every_angle() {
    // sums over 40 balls are the integrals J_r 0.2288 and J_1 0.5625 of point contact, which 0.407 has in three digits
    let geometry = BearingGeometry::new(BearingDimensions {
        balls: 40,
        ball_radius: 1e-3,
        inner_race_radius: 20.75e-3,
        outer_race_radius: 22.75e-3,
        inner_groove_radius: 1.04e-3,
        outer_groove_radius: 1.06e-3,
        ..*geometry().dimensions()
    });
    let geometry = geometry.unwrap();
    for degrees in [0.0_f64, 15.0, 40.0] {
        let angle = degrees.to_radians();
        let rating = LoadRating::of(1000.0, &geometry, angle);
        let largest = 1000.0 / (40.0 * 0.2288 * angle.cos());
        let load = |ball: i32| largest * (TAU * f64::from(ball) / 40.0).cos().max(0.0).powf(1.5);
        let loads: Vec<[f64; 2]> = (0..40).map(|ball| [load(ball); 2]).collect();
        assert_relative_eq!(rating.life(&loads, 0.0, 0.0).life_mrev.unwrap(), 1.0, max_relative = 5e-3);
    }
}
