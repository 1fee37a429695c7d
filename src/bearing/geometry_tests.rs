//! The source bearing's derived numbers, and every rule firing with its message.

use super::*;
use crate::bearing::samples::{source_bearing, source_dimensions};
use approx::assert_relative_eq;

#[test]
fn derived_numbers_of_the_source_bearing() {
    let bearing = source_bearing();
    assert_relative_eq!(bearing.radial_play(), 2.5e-6, max_relative = 1e-9);
    assert_relative_eq!(bearing.diametral_clearance(), 5e-6, max_relative = 1e-9);
    assert_relative_eq!(bearing.pitch_radius(), 3.755_25e-3, max_relative = 1e-12);
    assert_relative_eq!(bearing.inner_conformity(), 0.52, max_relative = 1e-12);
    assert_relative_eq!(bearing.outer_conformity(), 0.535, max_relative = 1e-12);
    assert_relative_eq!(bearing.effective_inner_race_radius(), 2.754e-3, max_relative = 1e-12);
    assert_relative_eq!(bearing.orders().outer, 2.568, epsilon = 5e-4);
    assert_relative_eq!(bearing.orders().ball_defect, 3.489, epsilon = 5e-4);
}

/// A = (0.52 + 0.535 - 1) 2 mm = 0.11 mm between the groove centres, 2.5 um of play: cos a = 1 - 2.5 / 110.
#[test]
fn an_axial_load_sets_the_free_contact_angle() {
    let angle = source_bearing().free_contact_angle().unwrap();
    assert_relative_eq!(angle.to_degrees(), 12.2388, epsilon = 1e-4);
    let tight = source_bearing().with_radial_play(-1e-6).unwrap();
    assert!(tight.free_contact_angle().is_none());
}

#[test]
fn given_play_moves_the_inner_race_alone() {
    let nominal = source_bearing();
    let tight = nominal.with_radial_play(-1.5e-6).unwrap();
    assert_relative_eq!(tight.radial_play(), -1.5e-6);
    // 4 um less play: the inner race is 4 um larger
    let grown = tight.effective_inner_race_radius() - nominal.effective_inner_race_radius();
    assert_relative_eq!(grown, 4e-6, max_relative = 1e-9);
    assert_eq!(tight.orders(), nominal.orders());
    assert_eq!(tight.inner_curvatures(), nominal.inner_curvatures());
    assert_relative_eq!(tight.outer_race_radius(), 4.7565e-3);
}

#[test]
fn interference_from_the_radii_is_preload() {
    let dimensions = BearingDimensions { inner_race_radius: 2.758e-3, ..source_dimensions() };
    let bearing = BearingGeometry::new(dimensions).unwrap();
    assert_relative_eq!(bearing.radial_play(), -1.5e-6, max_relative = 1e-9);
}

#[test]
fn every_rule_fires_with_key_value_and_rule() {
    let good = source_dimensions();
    for (dimensions, message) in [
        (BearingDimensions { balls: 2, ..good }, "balls = 2 must be 3 to 40"),
        (BearingDimensions { balls: 41, ..good }, "balls = 41 must be 3 to 40"),
        (BearingDimensions { ball_radius: -1.0, ..good }, "ball_radius = -1 must be positive and finite"),
        (BearingDimensions { ball_mass: f64::NAN, ..good }, "ball_mass = NaN must be positive and finite"),
        (BearingDimensions { inner_race_radius: 0.0, ..good }, "inner_race_radius = 0 must be positive and finite"),
        (
            BearingDimensions { outer_race_radius: f64::INFINITY, ..good },
            "outer_race_radius = inf must be positive and finite",
        ),
        (
            BearingDimensions { inner_groove_radius: 1e-3, ..good },
            "inner_groove_radius = 0.001 must be greater than ball_radius",
        ),
        (
            BearingDimensions { outer_groove_radius: 0.5e-3, ..good },
            "outer_groove_radius = 0.0005 must be greater than ball_radius",
        ),
        (
            BearingDimensions { balls: 12, ..good },
            "balls = 12 of radius 0.001 m do not fit on a pitch radius of 0.00375525 m: at most 11",
        ),
    ] {
        assert_eq!(BearingGeometry::new(dimensions).unwrap_err().to_string(), message);
    }
    let loose = BearingDimensions { inner_race_radius: 2.5e-3, ..good };
    let error = BearingGeometry::new(loose).unwrap_err().to_string();
    let play = error.strip_prefix("radial_play = ").and_then(|rest| rest.split(' ').next()?.parse::<f64>().ok());
    assert!(play.is_some_and(|play| play > 2e-4), "{error}");
    assert_eq!(
        source_bearing().with_radial_play(2.5e-3).unwrap_err().to_string(),
        "radial_play = 0.0025 m (outer_race_radius - inner_race_radius - 2 ball_radius unless given) \
         must be within +-0.0001 m, a tenth of the ball radius"
    );
    assert!(source_bearing().with_radial_play(f64::NAN).is_err());
}
