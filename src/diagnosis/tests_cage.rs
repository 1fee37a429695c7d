//! A ball that shows by the cage's lines alone, and a comb that stands beside a stronger one.

use std::f64::consts::TAU;

use super::tests::{Noise, bearing, judged, named, steady, struck, verdict, with_noise};
use super::*;
use crate::closed_form::race::DefectOrders;
use crate::series::TimeSeries;

const RATE: f64 = 32e3;

/// Noise that is louder in each of the cage's revolutions for as long as one ball is under the load.
fn one_ball_differs(seconds: f64, cage: f64, depth: f64, seed: u64) -> TimeSeries {
    let mut noise = Noise(seed);
    let samples = (seconds * RATE) as usize;
    let values = (0..samples).map(|k| {
        let angle = cage * steady(k as f64 / RATE);
        let under = (TAU * angle).cos().max(0.0).powi(2);
        (1.0 + depth * under) * noise.normal()
    });
    TimeSeries::new(0.0, 1.0 / RATE, "m/s^2", values.collect()).unwrap()
}

#[test]
fn a_ball_whose_own_lines_are_smeared_shows_by_the_cages() {
    let orders = bearing();
    let signal = one_ball_differs(6.0, 1.002 * orders.cage, 0.15, 31);
    let found = judged(&signal, steady, &orders, 0.01);
    assert_eq!(named(&found), [Fault::Ball], "{:#?}", found.faults);
    let lines = verdict(&found, Fault::Ball).cage_lines.as_ref().unwrap();
    // half of the resolution of 150 revolutions at the second harmonic: the third and fourth are weak
    assert!(
        (lines.order - 1.002 * orders.cage).abs() < 0.5 / 150.0 / 2.0,
        "{lines:?}"
    );
    assert!(lines.strength_db > LEAST_CAGE_LINES_DB);
    assert!(
        verdict(&found, Fault::Cage)
            .why
            .contains("A ball that differs")
    );
}

#[test]
fn noise_alone_and_a_race_that_is_indicated_name_no_ball() {
    let orders = bearing();
    let quiet = judged(
        &one_ball_differs(6.0, orders.cage, 0.0, 32),
        steady,
        &orders,
        0.01,
    );
    assert_eq!(named(&quiet), [], "{:#?}", quiet.faults);
    // the dent is struck harder by one ball
    let load = |angle: f64| 1.0 + 0.5 * (TAU * orders.cage * angle).cos();
    let values = struck(6.0, steady, orders.outer, load);
    let found = judged(&with_noise(&values, 0.3, 33), steady, &orders, 0.01);
    assert_eq!(named(&found), [Fault::OuterRace], "{:#?}", found.faults);
}

/// In a 6203 the sidebands of an inner race at the shaft's distance lie where a ball's lines may be.
#[test]
fn a_comb_beside_a_stronger_one_is_of_that() {
    let orders = DefectOrders {
        cage: 0.3817,
        outer: 3.053,
        inner: 4.9469,
        ball_defect: 3.9874,
        ..bearing()
    };
    let load = |angle: f64| (0.2 + (TAU * angle).cos()).max(0.0);
    let values = struck(1.4, steady, orders.inner, load);
    let found = judged(&with_noise(&values, 0.15, 34), steady, &orders, 0.01);
    assert_eq!(named(&found), [Fault::InnerRace], "{:#?}", found.faults);
    assert_ne!(verdict(&found, Fault::Ball).conclusion, Conclusion::Named);
}
