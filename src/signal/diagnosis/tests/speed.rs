//! The shaft's speed: sharpened by what a signal shows, doubted where it shows nothing.

use std::f64::consts::TAU;

use super::*;
use crate::bearing::kinematics::BallRow;

/// A nominal speed 1.2 % above the true one: the shaft's own lines say so.
#[test]
fn the_shafts_lines_sharpen_the_speed() {
    let orders = bearing();
    let mut values = struck(4.4, steady, orders.outer, |_| 1.0);
    // unbalance, misalignment and what goes with them
    for (k, value) in values.iter_mut().enumerate() {
        let turn = TAU * steady(k as f64 / RATE);
        *value += (1..=8).map(|k| (f64::from(k) * turn).cos()).sum::<f64>();
    }
    let series = with_noise(&values, 0.3, 22);
    let found = judged(&series, |t| 1.012 * steady(t), &orders, 0.01);
    assert_eq!(found.speed_source, SpeedSource::Sharpened);
    assert!((found.speed_hz / 25.0 - 1.0).abs() < found.speed_error, "{found:#?}");
    // the resolution of 110 revolutions over eight lines, and as much again for lines that are a bin wide
    assert!(found.speed_error < 5e-3, "{}", found.speed_error);
    assert!((found.given_speed_hz - 25.3).abs() < 1e-9);
    // without them nothing is sharpened, and the search is wider
    let series = with_noise(&vec![0.0; series.values().len()], 1.0, 23);
    let found = judged(&series, steady, &orders, 0.01);
    assert_eq!(found.speed_source, SpeedSource::Given);
}

/// A race's lines at a speed that is 1.8 % wrong are found neither at their order nor surely beside it.
#[test]
fn a_speed_that_no_line_confirms_is_said() {
    let orders = bearing();
    let doubt = |found: &Diagnosis| {
        let short = found.spectrum.turns < 48.0;
        let said = found.sentence().contains(if short {
            " in fewer than 48 revolutions: "
        } else {
            "no line of the signal confirms the shaft speed"
        });
        assert_eq!(said, found.speed_doubt().is_some(), "{}", found.sentence());
        found.speed_doubt().unwrap_or_default()
    };
    let noise = with_noise(&vec![0.0; (4.4 * RATE) as usize], 1.0, 23);
    let hidden = "at a wrong speed, faults stay hidden";
    assert!(doubt(&judged(&noise, steady, &orders, 0.01)).ends_with(hidden));
    // a simulation's speed needs no confirmation
    assert_eq!(doubt(&judged(&noise, steady, &orders, 0.0)), "");
    // a line at a part's order does not tell at which speed it is that part's
    let outer = with_noise(&struck(1.2, steady, orders.outer, |_| 1.0), 0.1, 24);
    let found = judged(&outer, steady, &orders, 0.01);
    assert_eq!(
        (found.speed_source, named(&found)),
        (SpeedSource::Given, vec![Fault::OuterRace]),
        "{}",
        found.sentence()
    );
    assert!(doubt(&found).ends_with("at a different speed, the same lines would mean a different part"));
    let wrong = judged(&outer, |t| 1.018 * steady(t), &orders, 0.01);
    assert!(named(&wrong).is_empty() && wrong.unexplained.is_empty());
    assert!(doubt(&wrong).ends_with(hidden));
}

/// At twice the speed the outer race's second and third harmonics lie at the orders of both races, 1 % away from them.
#[test]
fn harmonics_of_one_race_are_told_from_the_lines_of_two() {
    let (outer, inner) = (bearing().outer, bearing().inner);
    let share = |outer, inner| super::super::shaft_speed::share_a_fundamental(outer, inner, 1e-3);
    assert!(share(outer, 1.5 * outer) && share(outer, 2.0 * outer + 2e-3));
    assert!(!share(outer, inner));
}

/// Multiples of a shaft's order up to the eighth, `strength` each.
fn shaft_lines(values: &mut [f64], speed_hz: f64, strength: f64) {
    for (k, value) in values.iter_mut().enumerate() {
        let turn = TAU * speed_hz * k as f64 / RATE;
        let lines = (1..=8).map(|k| (f64::from(k) * turn).cos());
        *value += strength * lines.sum::<f64>();
    }
}

/// At half the speed the shaft's lines are the even ones.
#[test]
fn half_of_the_speed_is_said() {
    let mut values = vec![0.0; (8.8 * RATE) as usize];
    shaft_lines(&mut values, 25.0, 1.0);
    let series = with_noise(&values, 1.0, 25);
    let source = |factor: f64| judged(&series, |t| factor * steady(t), &bearing(), 0.01);
    let half = source(0.5);
    assert_eq!(half.speed_source, SpeedSource::EvenOnly);
    assert!(half.sentence().contains("may turn twice as fast"));
    assert_eq!(source(1.0).speed_source, SpeedSource::Sharpened);
}

/// A machine beside this one, 1.6 % slower, is three times as loud.
#[test]
fn a_changed_speed_is_said_and_own_lines_hold_the_given_one() {
    let mut values = vec![0.0; (8.8 * RATE) as usize];
    shaft_lines(&mut values, 24.6, 3.0);
    let alone = judged(&with_noise(&values, 1.0, 26), steady, &bearing(), 0.01);
    assert!((alone.speed_hz / 24.6 - 1.0).abs() < 2e-3);
    assert!(alone.sentence().contains("where 25.00 Hz (1500 rpm) were given"));
    shaft_lines(&mut values, 25.0, 1.0);
    let both = judged(&with_noise(&values, 1.0, 26), steady, &bearing(), 0.01);
    assert!((both.speed_hz / 25.0 - 1.0).abs() < 2e-3, "{}", both.speed_hz);
    assert_eq!(both.speed_change(), None);
}

/// 626 and 6202: every harmonic of the outer race, 3.045 a turn, is a multiple of a shaft that turns 1.5 % faster.
#[test]
fn lines_of_a_race_are_not_taken_for_the_shafts() {
    let orders = BallRow::new(8, 3.175e-3, 13.3e-3, 0.0).unwrap().orders();
    assert!((orders.outer - 3.0451).abs() < 1e-4, "{}", orders.outer);
    for seconds in [2.1, 4.4] {
        let outer = with_noise(&struck(seconds, steady, orders.outer, |_| 1.0), 0.1, 27);
        let found = judged(&outer, steady, &orders, 0.01);
        assert!((found.speed_hz - 25.0).abs() < 0.05, "{}", found.speed_hz);
        assert_eq!(named(&found), [Fault::OuterRace], "{}", found.sentence());
    }
    // the shaft's own lines beside them are found
    let mut values = struck(8.8, steady, orders.outer, |_| 1.0);
    shaft_lines(&mut values, 25.0, 1.0);
    let found = judged(&with_noise(&values, 0.3, 28), |t| 1.01 * steady(t), &orders, 0.01);
    assert_eq!(found.speed_source, SpeedSource::Sharpened);
    assert!((found.speed_hz / 25.0 - 1.0).abs() < 2e-3, "{}", found.speed_hz);
}

/// 6203: the shaft's own first lines beside those of the outer race hold the given speed, however strong.
#[test]
fn strong_lines_of_the_shaft_do_not_move_it_to_a_race() {
    let orders = BallRow::new(8, 6.747e-3, 28.5e-3, 0.0).unwrap().orders();
    assert!((orders.outer - 3.053).abs() < 1e-3, "{}", orders.outer);
    for (run, strength) in [(0, 0.3), (1, 0.3), (2, 2.0), (3, 2.0)] {
        let mut values = struck(4.4, steady, orders.outer, |_| 1.0);
        shaft_lines(&mut values, 25.0, strength);
        let found = judged(&with_noise(&values, 0.12, 200 + run), steady, &orders, 0.01);
        assert!((found.speed_hz - 25.0).abs() < 0.1, "{}", found.speed_hz);
        assert_eq!(named(&found), [Fault::OuterRace], "{}", found.sentence());
    }
}

/// 6202: harmonics of the inner race, 4.95 a turn, and its sidebands are nearly multiples of a shaft that turns 1 % slower.
#[test]
fn sidebands_of_an_inner_race_are_not_taken_for_the_shafts() {
    let orders = BallRow::new(8, 3.175e-3, 13.3e-3, 0.0).unwrap().orders();
    assert!((orders.inner - 4.9549).abs() < 1e-4, "{}", orders.inner);
    for (seconds, given) in [(4.4, 1.0), (4.4, 1.005), (8.8, 1.0)] {
        let in_the_load = |turn: f64| (0.2 + (TAU * turn).cos()).max(0.0);
        let inner = struck(seconds, steady, orders.inner, in_the_load);
        let series = with_noise(&inner, 0.1, 41);
        let found = judged(&series, |t| given * steady(t), &orders, 0.01);
        let off = found.speed_hz / (25.0 * given) - 1.0;
        assert!(off.abs() < 3e-3, "{seconds}: {}", found.speed_hz);
        assert_eq!(named(&found), [Fault::InnerRace], "{}", found.sentence());
    }
}

/// In twelve revolutions the first two harmonics of that race lie within what the shaft's lines take.
#[test]
fn a_part_whose_lines_the_shafts_hide_says_how_long_a_window_shows_it() {
    let orders = BallRow::new(8, 3.175e-3, 13.3e-3, 0.0).unwrap().orders();
    let found = |seconds: f64, seed: u64| {
        let values = struck(seconds, steady, orders.outer, |_| 1.0);
        judged(&with_noise(&values, 0.03, seed), steady, &orders, 0.0)
    };
    let said = (29..35).map(|seed| {
        let short = found(0.48, seed);
        let outer = super::verdict(&short, Fault::OuterRace);
        // what is left of its lines may be enough by chance
        assert_ne!(outer.conclusion, Conclusion::NotSeen, "{outer:#?}");
        outer.why.contains("A window of 23 revolutions") && outer.why.contains("this one has 12")
    });
    assert!(said.filter(|said| *said).count() >= 3);
    assert_eq!(named(&found(0.96, 29)), [Fault::OuterRace]);
}
