//! A ball that shows by the cage's lines alone.

use std::f64::consts::TAU;

use super::*;
use crate::numerics::series::TimeSeries;

const RATE: f64 = 32e3;

/// Noise that is louder in each of the cage's revolutions for as long as one ball is under the load.
pub(super) fn one_ball_differs(seconds: f64, cage: f64, depth: f64, seed: u64) -> TimeSeries {
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
    assert!((lines.order - 1.002 * orders.cage).abs() < 0.5 / 150.0 / 2.0, "{lines:?}");
    assert!(lines.strength_db > LEAST_CAGE_LINES_DB);
    assert!(verdict(&found, Fault::Cage).why.contains("A ball that differs"));
}

#[test]
fn the_cages_lines_of_a_clipped_signal_indicate_nothing() {
    let orders = bearing();
    let signal = one_ball_differs(6.0, 1.002 * orders.cage, 0.3, 31);
    let clipped_at = |most: f64| {
        let values = signal.values().iter().map(|value| value.clamp(-most, most)).collect();
        judged(&signal.with_values(values).unwrap(), steady, &orders, 0.01)
    };
    // 3 and 30 in 1000 samples
    assert_eq!(named(&clipped_at(3.4)), [Fault::Ball]);
    let found = clipped_at(2.4);
    assert_eq!(named(&found), [], "{:#?}", found.faults);
    assert!(verdict(&found, Fault::Ball).why.contains("% of the samples are clipped"));
}

#[test]
fn noise_alone_and_a_race_that_is_indicated_name_no_ball() {
    let orders = bearing();
    let quiet = judged(&one_ball_differs(6.0, orders.cage, 0.0, 32), steady, &orders, 0.01);
    assert_eq!(named(&quiet), [], "{:#?}", quiet.faults);
    // a dent, and one ball that differs
    let ball = one_ball_differs(6.0, orders.cage, 0.4, 31);
    let values = struck(6.0, steady, orders.outer, |_| 5.0);
    let both = values.iter().zip(ball.values()).map(|(dent, ball)| dent + ball);
    let series = TimeSeries::new(0.0, 1.0 / RATE, "m/s^2", both.collect()).unwrap();
    let found = judged(&series, steady, &orders, 0.01);
    assert_eq!(named(&found), [Fault::OuterRace], "{:#?}", found.faults);
}
