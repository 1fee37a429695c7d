//! Speed tables: closed form of the source's run-up, derivatives, cursor, rules.

use super::*;
use crate::bearing::RotationCursor;
use approx::assert_relative_eq;
use proptest::prelude::*;

fn knot(time: f64, frequency_hz: f64) -> SpeedKnot {
    SpeedKnot { time, frequency_hz }
}

/// Speeds up, coasts, reverses.
fn varied() -> SpeedProfile {
    SpeedProfile::new(&[knot(-0.5, 3.0), knot(0.7, 12.0), knot(1.0, 12.0), knot(2.0, -8.0), knot(2.001, 0.0)]).unwrap()
}

#[test]
fn source_run_up_is_its_closed_form() {
    let profile = SpeedProfile::new(&[knot(0.2, 0.0), knot(4.7, 45.0)]).unwrap();
    let rate = 20.0 * std::f64::consts::PI;
    for (time, hz) in [(2.2, 20.0), (2.3, 21.0), (2.5, 23.0)] {
        assert_relative_eq!(profile.speed(time), TAU * hz, max_relative = 1e-14);
        assert_relative_eq!(profile.motion(time).acceleration, rate, max_relative = 1e-14);
        let angle = 0.5 * rate * (time - 0.2) * (time - 0.2);
        assert_relative_eq!(profile.angle(time), angle, max_relative = 1e-14);
    }
    assert!(profile.angle(0.1).abs() < 1e-300 && profile.speed(0.0).abs() < 1e-300);
    let end = 0.5 * rate * 4.5 * 4.5 + TAU * 45.0 * 0.3;
    assert_relative_eq!(profile.angle(5.0), end, max_relative = 1e-14);
    assert_relative_eq!(profile.speed(9.0), TAU * 45.0, max_relative = 1e-14);
    assert!(profile.motion(9.0).acceleration.abs() < 1e-300);
}

#[test]
fn angle_is_zero_at_time_zero_whatever_the_knots() {
    assert!(varied().angle(0.0).abs() < 1e-14);
    let late = SpeedProfile::new(&[knot(2.0, 10.0), knot(3.0, 20.0)]).unwrap();
    assert!(late.angle(0.0).abs() < 1e-13);
    assert_relative_eq!(late.angle(1.0), TAU * 10.0, max_relative = 1e-14);
    assert_relative_eq!(SpeedProfile::constant(-5.0).unwrap().angle(2.0), -TAU * 10.0);
}

#[test]
fn knots_belong_to_the_interval_on_their_right() {
    let profile = varied();
    assert!(profile.motion(0.7).acceleration.abs() < 1e-300);
    assert_relative_eq!(profile.motion(1.0).acceleration, -TAU * 20.0, max_relative = 1e-12);
    assert_eq!(profile.knot_times().count(), 5);
}

#[test]
fn the_fastest_is_at_a_knot_or_an_end() {
    let profile = varied();
    // up to 12 Hz, down through zero to -8 Hz at 20 Hz/s, and back to rest within a millisecond
    for (start, end, hz) in [(-1.0, 3.0, 12.0), (1.3, 3.0, 8.0), (1.8, 1.9, 6.0), (2.5, 3.0, 0.0)] {
        let fastest = profile.fastest(start, end);
        assert_relative_eq!(fastest, TAU * hz, max_relative = 1e-12, epsilon = 1e-9);
    }
    // where it comes first
    for (start, end, first) in [(-1.0, 3.0, 0.7), (1.3, 3.0, 2.0), (1.8, 1.9, 1.9), (2.5, 3.0, 2.5)] {
        assert_relative_eq!(profile.fastest_instant(start, end), first);
    }
}

proptest! {
    /// Angle and speed are continuous, and each is the integral of the next (central differences).
    #[test]
    fn derivatives_are_consistent(time in -1.0..3.0_f64) {
        let profile = varied();
        let h = 1e-5;
        let speed = (profile.angle(time + h) - profile.angle(time - h)) / (2.0 * h);
        // Across a knot the central difference is off by h Δα / 4: 8 Hz in 1 ms here.
        let slack = 0.25 * h * TAU * (8000.0 + 20.0) + 1e-8;
        prop_assert!((speed - profile.speed(time)).abs() < slack);
        let away = profile.knot_times().all(|knot| (knot - time).abs() > 2.0 * h);
        if away {
            let tight = (profile.angle(time + h) - profile.angle(time - h)) / (2.0 * h);
            prop_assert!((tight - profile.speed(time)).abs() < 1e-8);
            let slope = (profile.speed(time + h) - profile.speed(time - h)) / (2.0 * h);
            prop_assert!((slope - profile.motion(time).acceleration).abs() < 1e-5);
        }
    }

    /// The cursor gives what the search gives, bit for bit, whatever the order of times.
    #[test]
    fn cursor_agrees_with_search(times in proptest::collection::vec(-2.0..4.0_f64, 1..40)) {
        let profile = varied();
        let mut cursor = RotationCursor::default();
        for time in times.into_iter().chain([-0.5, 0.7, 2.001, 2.0]) {
            prop_assert_eq!(profile.rotation.at_from(&mut cursor, time), profile.motion(time));
        }
    }
}

#[test]
fn cursor_of_another_profile_is_harmless() {
    let mut cursor = RotationCursor::default();
    let _ = varied().rotation.at_from(&mut cursor, 10.0);
    let short = SpeedProfile::constant(1.0).unwrap();
    assert_eq!(short.rotation.at_from(&mut cursor, 1.0), short.motion(1.0));
}

#[test]
fn every_rule_fires() {
    let message = |knots: &[SpeedKnot]| SpeedProfile::new(knots).unwrap_err().to_string();
    assert_eq!(message(&[]), "speed profile is empty: give at least one { time, hz }");
    assert_eq!(message(&[knot(0.0, 1.0), knot(1.0, f64::NAN)]), "speed profile row 1: hz = NaN must be finite");
    assert_eq!(message(&[knot(f64::INFINITY, 1.0)]), "speed profile row 0: time = inf must be finite");
    assert_eq!(
        message(&[knot(0.0, 1.0), knot(1.0, 2.0), knot(1.0, 3.0)]),
        "speed profile row 2: time 1 s must be later than 1 s in the row before"
    );
}
