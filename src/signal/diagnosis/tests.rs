//! Verdicts on synthetic signals: what is there is named, what is not there is not.

mod cage;
mod change;
mod races;
mod speed;
mod unexplained;

use std::f64::consts::{PI, TAU};

use super::*;
use crate::bearing::kinematics::{BallRow, DefectOrders};
use crate::numerics::series::TimeSeries;

pub(super) const RATE: f64 = 32e3;
const RESONANCE: f64 = 8e3;

/// 9 balls of 7.94 mm on 39.04 mm: orders 3.585 (outer), 5.415 (inner), 4.713 (ball), 0.398 (cage).
pub(super) fn bearing() -> DefectOrders {
    BallRow::new(9, 7.94e-3, 39.04e-3, 0.0).unwrap().orders()
}

/// Normal random numbers (splitmix64, Box and Muller).
pub(super) struct Noise(pub(super) u64);

impl Noise {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(super) fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.unit()).ln()).sqrt() * (TAU * self.unit()).cos()
    }
}

/// A signal of `seconds`, made of the shaft's angle in turns and noise.
pub(super) fn signal(seconds: f64, turns: impl Fn(f64) -> f64, mut value: impl FnMut(f64, f64) -> f64) -> TimeSeries {
    let samples = (seconds * RATE) as usize;
    let values = (0..samples).map(|k| {
        let t = k as f64 / RATE;
        value(t, turns(t))
    });
    TimeSeries::new(0.0, 1.0 / RATE, "m/s^2", values.collect()).unwrap()
}

/// Rings of the resonance, 3 % damped, struck `order` times a turn with the strength of the angle (turns).
pub(super) fn struck(
    seconds: f64,
    turns: impl Fn(f64) -> f64 + Copy,
    order: f64,
    strength: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let samples = (seconds * RATE) as usize;
    let mut values = vec![0.0; samples];
    let mut next = 0.0;
    for k in 0..samples {
        let angle = turns(k as f64 / RATE);
        if angle * order < next {
            continue;
        }
        next = (angle * order).floor() + 1.0;
        let blow = strength(angle);
        for (j, value) in values[k..].iter_mut().take(400).enumerate() {
            let since = TAU * RESONANCE * j as f64 / RATE;
            *value += blow * (-0.03 * since).exp() * since.sin();
        }
    }
    values
}

pub(super) fn with_noise(values: &[f64], level: f64, seed: u64) -> TimeSeries {
    let mut noise = Noise(seed);
    let noisy = values.iter().map(|value| value + level * noise.normal());
    TimeSeries::new(0.0, 1.0 / RATE, "m/s^2", noisy.collect()).unwrap()
}

pub(super) fn judged(series: &TimeSeries, turns: impl Fn(f64) -> f64, orders: &DefectOrders, error: f64) -> Diagnosis {
    let orders = FaultOrders::of(orders, error).unwrap();
    Diagnosis::of(series, None, series.span(), turns, &orders).unwrap()
}

pub(super) fn named(diagnosis: &Diagnosis) -> Vec<Fault> {
    diagnosis.named().map(|verdict| verdict.fault).collect()
}

pub(super) fn verdict(diagnosis: &Diagnosis, fault: Fault) -> &FaultVerdict {
    let mut faults = diagnosis.faults.iter();
    faults.find(|verdict| verdict.fault == fault).unwrap()
}

pub(super) fn steady(t: f64) -> f64 {
    25.0 * t
}

/// 20 to 40 Hz in 1.2 s.
fn run_up(t: f64) -> f64 {
    20.0 * t + 20.0 / 2.4 * t * t
}

#[test]
fn bursts_of_the_outer_race_are_named_through_a_run_up() {
    let orders = bearing();
    // 0.7 % of slip, of which the tolerance knows
    let struck_at = 0.993 * orders.outer;
    let values = struck(1.2, run_up, struck_at, |_| 1.0);
    let found = judged(&with_noise(&values, 0.3, 1), run_up, &orders, 0.01);
    assert_eq!(named(&found), [Fault::OuterRace], "{:#?}", found.faults);
    let outer = verdict(&found, Fault::OuterRace);
    // a tenth of a bin of the highest harmonic
    let bin = 1.0 / found.spectrum.turns;
    assert!((outer.order.unwrap() - struck_at).abs() < 0.1 * bin);
    assert!(outer.false_alarm.unwrap() < 1e-12);
    assert!(outer.side_lines.is_empty());
    assert!(outer.impulsiveness.unwrap() > 1.5, "{outer:#?}");
    // that of the window to the last digits, not of its whole samples
    assert!((found.speed_hz - 30.0).abs() < 1e-12);
}

#[test]
fn an_inner_race_in_a_load_zone_has_lines_at_the_shafts_distance() {
    let orders = bearing();
    let load = |angle: f64| (0.2 + (TAU * angle).cos()).max(0.0);
    let values = struck(1.2, steady, orders.inner, load);
    let found = judged(&with_noise(&values, 0.15, 2), steady, &orders, 0.005);
    assert_eq!(named(&found), [Fault::InnerRace], "{:#?}", found.faults);
    let inner = verdict(&found, Fault::InnerRace);
    let sides = inner.side_lines.iter().filter(|line| line.seen && line.offset.abs() == 1);
    assert!(sides.count() >= 4, "{:?}", inner.side_lines);
}

#[test]
fn a_ball_is_named_and_the_cage_that_carries_it_is_not() {
    let orders = bearing();
    let load = |angle: f64| (0.2 + (TAU * orders.cage * angle).cos()).max(0.0);
    // the cage's floor needs 40 turns
    let values = struck(2.0, steady, orders.ball_defect, load);
    let found = judged(&with_noise(&values, 0.1, 3), steady, &orders, 0.0);
    assert_eq!(named(&found), [Fault::Ball], "{:#?}", found.faults);
    let ball = verdict(&found, Fault::Ball);
    assert!(ball.side_lines.iter().filter(|line| line.seen).count() >= 4);
    let cage = verdict(&found, Fault::Cage);
    assert_ne!(cage.conclusion, Conclusion::Named);
}

/// Lines that are certain and weak: five harmonics of a hundredth of the noise each, for ten seconds.
#[test]
fn weak_lines_are_seen_and_not_named() {
    let orders = bearing();
    let mut noise = Noise(24);
    let weak = signal(10.0, steady, |_, turns| {
        let phase = TAU * orders.outer * turns;
        let lines: f64 = (1..=5).map(|k| (f64::from(k) * phase).cos()).sum();
        (1.0 + 0.035 * lines) * noise.normal()
    });
    let found = judged(&weak, steady, &orders, 0.0);
    let outer = verdict(&found, Fault::OuterRace);
    assert!(outer.false_alarm.unwrap() < NAMED_BELOW, "{outer:#?}");
    assert_eq!(outer.conclusion, Conclusion::NotEnough, "{outer:#?}");
    assert!(outer.why.contains("That is weak"), "{}", outer.why);
}

/// An unbalance, and a knock once a turn whose many harmonics are all multiples of the shaft.
#[test]
fn what_comes_once_a_turn_names_nothing() {
    let orders = bearing();
    let mut noise = Noise(4);
    let unbalance = signal(1.2, steady, |_, turns| 10.0 * (TAU * turns).cos() + 0.3 * noise.normal());
    let found = judged(&unbalance, steady, &orders, 0.01);
    assert_eq!(named(&found), [], "{:#?}", found.faults);
    let knocks = struck(1.2, steady, 1.0, |_| 1.0);
    let found = judged(&with_noise(&knocks, 0.1, 5), steady, &orders, 0.01);
    assert_eq!(named(&found), [], "{:#?}", found.faults);
    // the same knocks with an inner race that strikes once a turn cannot be told from the shaft
    let alike = DefectOrders { inner: 1.0, ..orders };
    let found = judged(&with_noise(&knocks, 0.1, 5), steady, &alike, 0.0);
    let inner = verdict(&found, Fault::InnerRace);
    assert_eq!(inner.conclusion, Conclusion::NotEnough);
    assert_eq!(inner.harmonics[0].coincides_with.as_deref(), Some("1 x shaft"));
}

#[test]
fn a_line_of_the_cage_is_compared_with_no_other_name_of_it() {
    let orders = bearing();
    let values = struck(2.4, steady, orders.outer, |_| 1.0);
    let found = judged(&with_noise(&values, 0.3, 1), steady, &orders, 0.0);
    let cage = verdict(&found, Fault::Cage);
    let [first, second] = [0, 1].map(|k| cage.harmonics[k].coincides_with.as_deref());
    assert_eq!(first, Some("1 x entry of one ball into the load zone"), "{cage:#?}");
    assert_eq!(second, Some("2 x entry of one ball into the load zone"), "{cage:#?}");
    assert!(cage.why.contains("(1 x cage with 1 x entry of one ball into the load zone"), "{}", cage.why);
}

#[test]
fn noise_has_no_more_lines_than_chance_makes() {
    let found = judged(&with_noise(&[0.0; 30_000], 1.0, 5), steady, &bearing(), 0.0);
    assert_eq!(found.sentence(), "no fault indicated. No more lines stand out than chance makes.");
}

/// Noise whose strength follows the balls that pass under the load, smoothly: a healthy bearing.
#[test]
fn a_smooth_modulation_at_the_ball_pass_is_seen_and_not_named() {
    let orders = bearing();
    let mut noise = Noise(6);
    let pass = signal(1.2, steady, |_, turns| {
        let phase = TAU * orders.outer * turns;
        (1.0 + 0.6 * phase.cos() + 0.1 * (2.0 * phase).cos()) * noise.normal()
    });
    let found = judged(&pass, steady, &orders, 0.0);
    let outer = verdict(&found, Fault::OuterRace);
    assert!(outer.harmonics[0].seen && outer.harmonics[0].above_floor_db > 10.0);
    assert!(outer.false_alarm.unwrap() < NAMED_BELOW);
    assert_eq!(outer.conclusion, Conclusion::NotEnough, "{outer:#?}");
    assert!(outer.why.contains("balls passing under the load"), "{}", outer.why);
}

/// Bursts that the floor of the noise hides but for three harmonics are as smooth as a modulation if those fall off fast.
#[test]
fn harmonics_that_fall_off_fast_are_no_bursts() {
    let orders = bearing();
    let mut noise = Noise(7);
    let pass = signal(2.0, steady, |_, turns| {
        let phase = TAU * orders.outer * turns;
        let smooth = (1..=4).map(|k| 0.9 * 0.25_f64.powi(k - 1) * (f64::from(k) * phase).cos());
        let carrier = (TAU * RESONANCE * turns / 25.0 + 0.2 * PI * noise.unit()).sin();
        (2.0 + smooth.sum::<f64>()) * carrier
    });
    let found = judged(&pass, steady, &orders, 0.0);
    let outer = verdict(&found, Fault::OuterRace);
    assert!(outer.harmonics[..3].iter().all(|h| h.seen), "{outer:#?}");
    // 0.16 for 1 / k^2; here 1 / 4^(k - 1)
    assert!(outer.impulsiveness.unwrap() < 0.3, "{outer:#?}");
    assert_eq!(outer.conclusion, Conclusion::NotEnough);
}

/// A steady hum of the machine above the high-pass hides bursts that ring elsewhere.
#[test]
fn a_resonance_that_hums_hides_no_bursts() {
    let orders = bearing();
    let (mut noise, mut hum) = (Noise(12), [0.0; 2]);
    let mut values = struck(4.4, steady, orders.outer, |_| 1.0);
    // noise through a resonance of 2 % at 11 kHz
    let angle = TAU * 11e3 / RATE;
    let decay = (-0.02 * angle).exp();
    for value in &mut values {
        let next = 0.5 * noise.normal() + 2.0 * decay * angle.cos() * hum[0] - decay * decay * hum[1];
        hum = [next, hum[0]];
        *value += next;
    }
    let series = with_noise(&values, 0.02, 13);
    let found = judged(&series, steady, &orders, 0.01);
    let outer = verdict(&found, Fault::OuterRace);
    assert!(outer.false_alarm.unwrap() < 1e-9, "{outer:#?}");
    assert!(outer.harmonics_seen >= 4, "{outer:#?}");
    assert!(found.envelope.contains("whitened"), "{}", found.envelope);
    assert!(found.faults.iter().all(|v| v.fault == Fault::OuterRace || v.false_alarm.is_none_or(|p| p > NAMED_BELOW)));
}

/// The ball of Tadina and Boltezar (2011), order 3.489: its even harmonics lie on multiples of the shaft, and it strikes for a third
/// of a turn of the cage. What is beside the harmonics tells it.
#[test]
fn a_ball_shows_beside_its_harmonics() {
    let orders = BallRow::new(7, 2e-3, 7.51e-3, 0.0).unwrap().orders();
    let load = |angle: f64| f64::from((TAU * orders.cage * angle).cos() > 0.5);
    let values = struck(0.6, steady, orders.ball_defect, load);
    let found = judged(&with_noise(&values, 0.35, 3), steady, &orders, 0.0);
    assert_eq!(named(&found), [Fault::Ball], "{:#?}", found.faults);
    let ball = verdict(&found, Fault::Ball);
    let coinciding = ball.harmonics.iter().filter(|h| h.coincides_with.is_some());
    assert!(coinciding.filter(|h| h.side == 0).count() >= 2, "{ball:#?}");
    assert_eq!(known::line_name(Fault::Ball, 2, -1), "2 x ball -1 x cage");
    assert!(ball.side_lines.iter().filter(|line| line.seen).count() >= 3);
}

/// A part that would strike three times as often as the damaged outer race: its harmonics are the race's third, sixth, ninth, twelfth, ...
#[test]
fn harmonics_beyond_the_judged_ones_explain_lines_too() {
    let outer = bearing().outer;
    let orders = FaultOrders::new([Some(outer), Some(3.0 * outer), None, None], 0.0).unwrap();
    let series = with_noise(&struck(1.2, steady, outer, |_| 1.0), 0.1, 3);
    let found = Diagnosis::of(&series, None, series.span(), steady, &orders).unwrap();
    assert_eq!(named(&found), [Fault::OuterRace]);
    let inner = verdict(&found, Fault::InnerRace);
    let fifth = inner.harmonics.iter().find(|h| h.harmonic == 5).unwrap();
    assert_eq!(fifth.coincides_with.as_deref(), Some("15 x outer race"), "{inner:#?}");
}

#[test]
fn short_windows_say_so() {
    let orders = bearing();
    let values = struck(0.16, steady, orders.outer, |_| 1.0);
    let found = judged(&with_noise(&values, 0.1, 8), steady, &orders, 0.0);
    let outer = verdict(&found, Fault::OuterRace);
    assert_eq!(outer.conclusion, Conclusion::NotEnough);
    assert_eq!(outer.false_alarm, None);
    assert_eq!(
        outer.why,
        "The window has 4.0 revolutions. At least 4.5 are needed to tell these lines from the floor about them."
    );
    assert!(
        found.sentence().starts_with("not enough evidence: outer race, inner race, ball. "),
        "{}",
        found.sentence()
    );
    // parts that could be judged and are sound say nothing of one that could not
    let mut one = found;
    for verdict in one.faults.iter_mut().filter(|verdict| verdict.fault != Fault::OuterRace) {
        (verdict.conclusion, verdict.false_alarm) = (Conclusion::NotSeen, Some(0.5));
    }
    assert_eq!(one.headline(), "not enough evidence: outer race");
    one.faults.iter_mut().for_each(|verdict| verdict.false_alarm = None);
    assert_eq!(one.headline(), "no verdict");
}

/// The stated probability against how often noise reaches it: 200 windows of noise of 12 revolutions, three faults each
/// (the cage's floor needs 40).
#[test]
fn noise_is_as_alarming_as_stated() {
    let (rate, speed) = (8e3, 25.0);
    for error in [0.0, 0.01] {
        let orders = FaultOrders::of(&bearing(), error).unwrap();
        let (mut below, mut judged, mut indicated) = ([0_u32; 3], 0, 0);
        for seed in 0..200 {
            let mut noise = Noise(seed * 7919 + 11);
            let values = (0..3840).map(|_| noise.normal()).collect();
            let series = TimeSeries::new(0.0, 1.0 / rate, "m/s^2", values).unwrap();
            let window = series.span();
            let found = Diagnosis::of(&series, None, window, |t| speed * t, &orders).unwrap();
            indicated += named(&found).len();
            let chances = found.faults.iter().filter_map(|verdict| verdict.false_alarm);
            for chance in chances {
                judged += 1;
                for (count, limit) in below.iter_mut().zip([0.01, 0.05, 0.2]) {
                    *count += u32::from(chance < limit);
                }
            }
        }
        println!("error {error}: {below:?} of {judged} below 0.01, 0.05, 0.2");
        assert!(judged > 550);
        // 600 judgements at a probability below 1e-3: 0.6, and three standard deviations
        assert!(indicated <= 2, "{indicated} of {judged}");
        for (count, limit) in below.into_iter().zip([0.01, 0.05, 0.2]) {
            // three standard deviations of a count of this size, and half as many again for a null that is itself measured
            let expected = limit * f64::from(judged);
            let most = 1.5 * expected + 3.0 * f64::sqrt(expected);
            assert!(f64::from(count) < most, "{limit}: {count}");
        }
        // and no empty statement: within a factor of two
        assert!(f64::from(below[2]) > 0.1 * f64::from(judged), "{below:?}");
    }
}

#[test]
fn orders_are_checked() {
    let message = |orders, error| FaultOrders::new(orders, error).unwrap_err().to_string();
    assert_eq!(
        message([None, Some(-1.0), None, None], 0.0),
        "order of the inner race: expected a number above 0 and at most 200, found -1"
    );
    assert_eq!(
        message([Some(f64::NAN), None, None, None], 0.0),
        "order of the outer race: expected a number above 0 and at most 200, found NaN"
    );
    assert_eq!(message([None; 4], 0.2), "relative error of the orders: expected 0 to 0.1, found 0.2");
}
