//! Both races of one bearing, whose lines lie among each other's sidebands.

use std::f64::consts::TAU;

use super::*;
use crate::bearing::kinematics::{BallRow, DefectOrders};
use crate::numerics::series::TimeSeries;

/// 7 balls of 2.770 mm on 10.514 mm: BPFI is within 0.01 orders of twice BPFO less twice the cage.
fn bearing() -> DefectOrders {
    BallRow::new(7, 2.770e-3, 10.514e-3, 0.0).unwrap().orders()
}

/// Marks on both races in 50 revolutions of an outer ring that is squeezed: the inner race is loaded twice a revolution.
fn both_races(outer: f64, inner: f64, seed: u64) -> TimeSeries {
    let orders = bearing();
    let outer = struck(2.0, steady, orders.outer, |_| outer);
    let twice = |angle: f64| inner * (0.5 + 0.5 * (2.0 * TAU * angle).cos()).powi(2);
    let inner = struck(2.0, steady, orders.inner, twice);
    let both: Vec<f64> = outer.iter().zip(&inner).map(|(a, b)| a + b).collect();
    with_noise(&both, 0.1, seed)
}

#[test]
fn sidebands_count_for_the_inner_race_alone() {
    let found = judged(&both_races(1.0, 3.0, 42), steady, &bearing(), 0.01);
    for (fault, counts) in [(Fault::InnerRace, true), (Fault::OuterRace, false)] {
        let verdict = verdict(&found, fault);
        let free = verdict.harmonics.iter().filter(|h| h.coincides_with.is_none());
        let levels: Vec<f64> = free.map(|h| h.above_floor_db.clamp(0.0, 26.0)).collect();
        let mean = levels.iter().sum::<f64>() / levels.len() as f64 + 10.0 * 1.28_f64.log10();
        // levels are those at a resolution of 1 / 64, the window has 1 / 50
        let strength = verdict.strength_db.unwrap();
        assert_eq!(strength > mean + 0.5, counts, "{fault:?}: {strength} dB, harmonics {mean} dB");
    }
}

/// An outer race that slips by 0.31 %, as in CWRU 130: looked for 0.1 % beside, its sixth harmonic seems to be the fourth of the inner race.
#[test]
fn lines_of_a_strong_race_are_known_where_they_are() {
    let orders = super::bearing();
    let outer = 1.0031 * orders.outer;
    // strong, so that its first harmonics all reach the limit of what counts
    let signal = with_noise(&struck(9.0, steady, outer, |_| 3.0), 0.1, 44);
    let found = judged(&signal, steady, &orders, 0.01);
    assert_eq!(named(&found), [Fault::OuterRace], "{:#?}", found.faults);
    let measured = verdict(&found, Fault::OuterRace).order.unwrap();
    // a quarter of the spectrum's step, half of the resolution of 64 revolutions, at the second harmonic; the search alone is 3 times as far off
    assert!((measured - outer).abs() < 0.25 * 0.5 / 64.0 / 2.0, "{measured}, {outer}");
    // beside its place the eighth is 11 dB lower
    let race = verdict(&found, Fault::OuterRace);
    assert!(race.harmonics.iter().all(|line| line.above_floor_db > 12.0), "{race:#?}");
}

#[test]
fn both_races_sharpen_the_speed() {
    let signal = both_races(1.0, 1.6, 43);
    let orders = bearing();
    // the shaft is slower by 0.7 % than it is said to be, and has no lines
    let found = judged(&signal, |t| 1.007 * steady(t), &orders, 0.01);
    assert_eq!(found.speed_source, SpeedSource::Races, "{:#?}", found.faults);
    assert!((found.speed_hz / 25.0 - 1.0).abs() < 2.0 * found.speed_error, "{}", found.speed_hz);
    // the resolution of 50 revolutions over eight harmonics, of two races, over seven balls
    assert!((found.speed_error / (2.0_f64.sqrt() / 50.0 / 8.0 / 7.0) - 1.0).abs() < 0.02);
    // orders that belong to no whole number of balls say nothing
    let odd = [Some(1.006 * orders.outer), Some(1.006 * orders.inner), None, None];
    let odd = FaultOrders::new(odd, 0.01).unwrap();
    let found = Diagnosis::of(&signal, None, signal.span(), steady, &odd).unwrap();
    assert_eq!(named(&found), [Fault::OuterRace, Fault::InnerRace]);
    assert_eq!(found.speed_source, SpeedSource::Given);
}
