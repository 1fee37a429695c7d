//! Two synthetic signals compared: what grew is said to, by as much as it did, and what did not is not.

use super::*;
use crate::numerics::series::TimeSeries;

/// Impacts of the outer race of a strength in noise; 25 revolutions a second.
fn impacts(seconds: f64, strength: f64, noise: f64, seed: u64) -> TimeSeries {
    let order = 0.996 * bearing().outer;
    with_noise(&struck(seconds, steady, order, |_| strength), noise, seed)
}

fn changes(now: &TimeSeries, earlier: &TimeSeries) -> Vec<LineChange> {
    let orders = FaultOrders::of(&bearing(), 0.01).unwrap();
    let found = [now, earlier].map(|signal| Diagnosis::of(signal, None, signal.span(), steady, &orders).unwrap());
    let now = ComparedSignal::new(now, now.span(), steady, orders, &found[0]);
    let earlier = ComparedSignal::new(earlier, earlier.span(), steady, orders, &found[1]);
    line_changes(&now, &earlier).unwrap()
}

fn outer(changes: &[LineChange]) -> &LineChange {
    let mut changes = changes.iter();
    changes.find(|change| change.fault == Some(Fault::OuterRace)).unwrap()
}

#[test]
fn growth_is_measured_and_other_parts_did_not_grow() {
    for (growth, expected) in [(12.0, ChangeConclusion::Grew), (0.0, ChangeConclusion::AsBefore)] {
        let strength = 10_f64.powf(growth / 20.0);
        let found = changes(&impacts(4.0, strength, 0.1, 1), &impacts(4.0, 1.0, 0.1, 2));
        let change = outer(&found);
        assert_eq!(change.conclusion, expected, "{change:#?}");
        let [low, high] = change.interval_db.map(Option::unwrap);
        assert!(low <= growth && growth <= high && high - low < 3.0, "{change:#?}");
        assert!(found[1..].iter().all(|c| c.conclusion != ChangeConclusion::Grew), "{found:#?}");
        // where it strikes, to what 40 revolutions separate at the fifth harmonic
        let order = 0.996 * bearing().outer;
        assert!((change.order_now.unwrap() - order).abs() < 1.0 / 40.0 / 5.0, "{change:#?}");
        let (now, earlier) = (change.now.unwrap(), change.earlier.unwrap());
        assert!((20.0 * (now / earlier).log10() - change.change_db.unwrap()).abs() < 1e-9);
    }
}

/// The envelope itself would show the lines of the same impacts 6 dB and more lower.
#[test]
fn noise_that_rose_hides_no_impacts_that_stayed() {
    let found = changes(&impacts(8.0, 1.0, 0.3, 3), &impacts(8.0, 1.0, 0.05, 4));
    let change = outer(&found);
    assert_eq!(change.conclusion, ChangeConclusion::AsBefore, "{change:#?}");
    assert!(change.change_db.unwrap().abs() < 1.5, "{change:#?}");
    assert!(change.band_change_db.unwrap() > 3.0, "{change:#?}");
}

/// Twice the order of the inner race is within 1 % of three times that of the outer race: an outer race that was damaged before does
/// not make a damage of the inner race an old one.
#[test]
fn damage_of_another_part_before_hides_no_new_one() {
    let load = |angle: f64| 2.0 * (0.5 + 0.5 * (std::f64::consts::TAU * angle).cos());
    let inner = with_noise(&struck(8.0, steady, 0.996 * bearing().inner, load), 0.1, 11);
    let found = changes(&inner, &impacts(8.0, 1.0, 0.1, 12));
    let of = |fault| found.iter().find(|change| change.fault == Some(fault)).unwrap();
    let inner = of(Fault::InnerRace);
    let outer = of(Fault::OuterRace);
    assert_eq!(inner.conclusion, ChangeConclusion::Grew, "{inner:#?}");
    assert_ne!(outer.conclusion, ChangeConclusion::Grew, "{outer:#?}");
}

/// The comb of the weaker part stays at its own order, beside lines of the stronger one that lie within the order's error.
#[test]
fn two_faults_that_stay_are_as_before() {
    let load = |angle: f64| 0.7 * (0.5 + 0.5 * (std::f64::consts::TAU * angle).cos());
    let both = |seed| {
        let outer = struck(8.0, steady, 0.996 * bearing().outer, |_| 1.5);
        let inner = struck(8.0, steady, 0.999 * bearing().inner, load);
        let sum: Vec<f64> = outer.iter().zip(&inner).map(|(a, b)| a + b).collect();
        with_noise(&sum, 0.3, seed)
    };
    for run in 0..6 {
        for change in changes(&both(300 + 2 * run), &both(301 + 2 * run)) {
            let wrong = [ChangeConclusion::Grew, ChangeConclusion::Fell];
            assert!(!wrong.contains(&change.conclusion), "{run}: {change:#?}");
        }
    }
}

#[test]
fn what_was_not_there_has_a_lower_bound() {
    let found = changes(&impacts(4.0, 1.0, 0.1, 5), &impacts(4.0, 0.0, 0.1, 6));
    let change = outer(&found);
    assert_eq!(change.conclusion, ChangeConclusion::Grew, "{change:#?}");
    assert_eq!((change.change_db, change.earlier), (None, None));
    assert!(change.interval_db[0].unwrap() > 6.0 && change.interval_db[1].is_none());
    assert!(change.words().starts_with("at least +"), "{}", change.words());
    assert!(change.why.contains("lower bound"), "{}", change.why);
}

#[test]
fn a_band_beyond_the_earlier_signal_cannot_be_compared() {
    // the resonance at 8 kHz; the earlier signal ends at 5.3 kHz
    let earlier = impacts(4.0, 1.0, 0.1, 7);
    let slow: Vec<f64> = earlier.values().iter().step_by(3).copied().collect();
    let slow = TimeSeries::new(0.0, 3.0 * earlier.step_s(), "m/s^2", slow).unwrap();
    let found = changes(&impacts(4.0, 2.0, 0.1, 8), &slow);
    let change = outer(&found);
    assert_eq!(change.conclusion, ChangeConclusion::NotCompared, "{change:#?}");
    assert!(change.why.contains("ends at 5333 Hz"), "{}", change.why);
}

/// Nothing grows from one stretch of the same machine to the next: not once in 40 windows of 40 revolutions.
#[test]
fn what_stays_is_rarely_said_to_grow() {
    let mut held = 0;
    for run in 0..40 {
        let pair = [2 * run + 100, 2 * run + 101].map(|seed| impacts(1.6, 1.0, 0.5, seed));
        let found = changes(&pair[0], &pair[1]);
        let wrong = |change: &&LineChange| matches!(change.conclusion, ChangeConclusion::Grew | ChangeConclusion::Fell);
        assert!(!found.iter().any(|change| wrong(&change)), "{run}: {found:#?}");
        let [low, high] = outer(&found).interval_db;
        held += u32::from(low.is_none_or(|low| low <= 0.0) && high.is_none_or(|high| high >= 0.0));
    }
    assert!(held >= 36, "{held}");
}

#[test]
fn conclusions_follow_the_interval() {
    use ChangeConclusion::{AsBefore, Fell, Grew, NotCertain};
    for (interval, expected) in [
        ([Some(3.1), Some(20.0)], Grew),
        ([Some(14.0), None], Grew),
        ([Some(2.9), Some(20.0)], NotCertain),
        ([Some(2.9), Some(5.0)], AsBefore),
        ([Some(-5.9), Some(5.9)], AsBefore),
        ([None, Some(-3.1)], Fell),
        ([None, None], NotCertain),
    ] {
        assert_eq!(ChangeConclusion::of(interval), expected, "{interval:?}");
    }
    let words = change_words(Some(12.34), [Some(11.0), Some(13.6)]);
    assert_eq!(words, "+12.3 dB (11.0 to 13.6)");
    assert_eq!(change_words(None, [None, Some(-8.0)]), "at most -8.0 dB");
}
