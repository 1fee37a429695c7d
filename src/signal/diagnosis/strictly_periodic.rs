//! Impacts without slip: their lines in the signal itself are tones, which whitening takes out of its envelopes.
//!
//! The cage of a bearing slips by 0.1 to 2 %, so that high harmonics of its lines smear (R. B. Randall and J. Antoni, Rolling element
//! bearing diagnostics - a tutorial, Mechanical Systems and Signal Processing 25 (2011) 485-520). Gears, shafts and computed signals do not
//! slip. So such lines are told and indicate no fault. In a short window the lines of a bearing are tones too, since slip moves none of
//! them by as much as the window tells apart: that they stand out is said then, and not why.

use super::comb::{ByChance, factors};
use super::fault::{Fault, FaultOrders};
use super::shaft_speed::ShaftSpeed;
use super::verdict::{Conclusion, FaultVerdict};
use crate::signal::WhiteSpectrum;

/// Amplitude over the median of a tone: noise has it in one bin of 65 000, 2^-16.
const TONE: f64 = 4.0;
/// Fewest neighbouring harmonics that are both tones: a line of a coarser comb has none.
const LEAST_PAIRS: usize = 6;
/// Probability by chance below which they are said.
const SAID_BELOW: f64 = 1e-6;
/// One of so many of the control orders of a comb is tried.
const CONTROLS_APART: usize = 8;
/// Least variation of a cage's slip (Randall and Antoni): it spreads the k-th harmonic over k times as much of the line.
const LEAST_SLIP: f64 = 1e-3;
/// Bins over which slip must spread a harmonic before it is no tone any more: the one of the line and its two neighbours, see [`near_tones`].
const SPREAD_BINS: f64 = 3.0;
/// Most harmonics that are looked at.
const MOST_HARMONICS: f64 = 300.0;

/// Says of each part that is not indicated whether its harmonics within a band (Hz) are tones; the shaft's speed is in Hz.
pub(super) fn say_strictly_periodic(
    faults: &mut [FaultVerdict],
    white: &WhiteSpectrum,
    within_hz: [f64; 2],
    orders: &FaultOrders,
    speed_hz: f64,
    speed: ShaftSpeed,
) {
    // a simulation's cage is prescribed
    if orders.is_exact() {
        return;
    }
    let tones = near_tones(white);
    for verdict in faults {
        let order = verdict.expected_order;
        let reach = orders.error(verdict.fault) + speed.error;
        // multiples of the shaft's order are the shaft's
        let of_shaft = (order - order.round()).abs() < reach * order;
        // a ball's sidebands are as far apart as the cage's lines
        let excluded = of_shaft || verdict.fault == Fault::Cage;
        if excluded || verdict.conclusion == Conclusion::Named {
            continue;
        }
        let line = (order * speed_hz, reach);
        let Some(Tones { frequency_hz, harmonics, without_slip }) = comb(&tones, white, within_hz, line) else {
            continue;
        };
        let tones = format!("{harmonics} multiples of {frequency_hz:.2} Hz are tones of the signal itself:");
        let reason = if without_slip {
            format!(
                "{tones} strictly periodic, as in a computed signal without slip. A bearing usually slips; a gear, another shaft and the supply do not."
            )
        } else {
            format!(
                "{tones} this window is too short to show whether they slip, as a bearing's do, or not, as those of a gear. A longer window decides."
            )
        };
        verdict.revise(Conclusion::NotEnough, reason);
    }
}

/// Of each bin whether it or a neighbour is a tone.
fn near_tones(white: &WhiteSpectrum) -> Vec<bool> {
    let over = &white.over_median;
    let about = |bin: usize| &over[bin.saturating_sub(1)..(bin + 2).min(over.len())];
    (0..over.len()).map(|bin| about(bin).iter().any(|&over| over > TONE)).collect()
}

/// Multiples of a frequency that are tones.
struct Tones {
    frequency_hz: f64,
    /// How many.
    harmonics: usize,
    /// Whether enough of them are so high that slip would show.
    without_slip: bool,
}

/// The frequency near `line` (Hz, relative reach) of which most multiples within a band (Hz) are tones, if chance makes that hardly ever: by
/// the same search at other lines.
fn comb(
    tones: &[bool],
    white: &WhiteSpectrum,
    [from_hz, to_hz]: [f64; 2],
    (line_hz, reach): (f64, f64),
) -> Option<Tones> {
    let tone = |frequency_hz: f64, k: u32| {
        let bin = white.bin(f64::from(k) * frequency_hz).round() as usize;
        tones.get(bin).copied().unwrap_or(false)
    };
    // the most pairs of neighbouring multiples that are both tones, of which frequency, and how many of its multiples are tones
    let search = |line_hz: f64| {
        let first = (from_hz / line_hz).ceil().max(1.0);
        let last = (to_hz / (line_hz * (1.0 + reach))).min(first + MOST_HARMONICS);
        // so that the highest harmonic moves by a bin
        let steps = (reach * white.bin(last * line_hz)).ceil();
        let (first, last) = (first as u32, last as u32);
        let pairs = |from: u32, frequency_hz: f64| {
            let both = |k: &u32| tone(frequency_hz, *k) && tone(frequency_hz, k + 1);
            (from..last).filter(both).count()
        };
        let places = (-(steps as i32)..=steps as i32).map(|step| {
            let frequency_hz = line_hz * (1.0 + reach * f64::from(step) / steps);
            (pairs(first, frequency_hz), frequency_hz)
        });
        let (most, frequency_hz) = places.max_by_key(|place| place.0)?;
        let harmonics = (first..=last).filter(|k| tone(frequency_hz, *k)).count();
        // the first harmonic that slip would spread
        let spread = (SPREAD_BINS / (LEAST_SLIP * white.bin(frequency_hz))).ceil() as u32;
        let without_slip = pairs(first.max(spread), frequency_hz) >= LEAST_PAIRS;
        Some((most, Tones { frequency_hz, harmonics, without_slip }))
    };
    let (pairs, tones) = search(line_hz)?;
    if pairs < LEAST_PAIRS {
        return None;
    }
    let controls = factors(reach).step_by(CONTROLS_APART);
    let scores = controls.filter_map(|factor| Some(search(line_hz * factor)?.0 as f64));
    let chance = ByChance::of(scores.collect())?.probability(pairs as f64, 1.0);
    (chance < SAID_BELOW).then_some(tones)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::diagnosis::Diagnosis;
    use crate::signal::diagnosis::tests::{Noise, RATE, bearing, judged, named, steady, verdict, with_noise};
    use std::f64::consts::TAU;

    /// Bursts of 3.5 kHz at exact instants, `frequency_hz` times a second for 4 s, and noise of a level.
    fn bursts(frequency_hz: f64, level: f64) -> Diagnosis {
        let value = |k: usize| {
            let t = k as f64 / RATE;
            let since = TAU * 3500.0 * (t - (t * frequency_hz).floor() / frequency_hz);
            (-0.03 * since).exp() * since.sin()
        };
        let values: Vec<f64> = (0..4 * RATE as usize).map(value).collect();
        judged(&with_noise(&values, level, 71), steady, &bearing(), 0.01)
    }

    fn says(found: &Diagnosis, fault: Fault) -> bool {
        verdict(found, fault).why.contains("strictly periodic")
    }

    #[test]
    fn strictly_periodic_bursts_are_told_and_no_fault() {
        let orders = bearing();
        // the RMS of the bursts is 0.2: none, 20 dB, 0 dB and -10 dB
        for level in [0.0, 0.02, 0.2, 0.63] {
            let found = bursts(25.0 * orders.outer, level);
            let outer = verdict(&found, Fault::OuterRace);
            let told = says(&found, Fault::OuterRace) && outer.conclusion == Conclusion::NotEnough;
            assert!(told || named(&found) == [Fault::OuterRace], "{level}: {outer:#?}");
            assert!(!says(&found, Fault::InnerRace), "{level}");
        }
    }

    /// Bursts that slip by 0.5 % at random, each interval for itself, and such as do not: three revolutions show no difference.
    #[test]
    fn three_revolutions_do_not_show_that_nothing_slips() {
        let orders = bearing();
        let mut random = Noise(17);
        let mut place = 0.0;
        let mut angles = Vec::new();
        while place < 110.0 {
            angles.push(place / orders.outer);
            place += 1.0 + 5e-3 * random.normal();
        }
        let ringing = |t: f64| {
            let since = angles.partition_point(|angle| angle / 25.0 <= t).checked_sub(1);
            let since = since.map_or(0.0, |burst| TAU * 3500.0 * (t - angles[burst] / 25.0));
            (-0.03 * since).exp() * since.sin()
        };
        let exact = |t: f64| {
            let since = TAU * 3500.0 * (t - (t * 25.0 * orders.outer).floor() / (25.0 * orders.outer));
            (-0.03 * since).exp() * since.sin()
        };
        let mut said = 0;
        for revolutions in [3.0, 4.0, 6.0, 12.0, 24.0] {
            let samples = (revolutions / 25.0 * RATE) as usize;
            for (slips, signal) in [(true, &ringing as &dyn Fn(f64) -> f64), (false, &exact)] {
                let values: Vec<f64> = (0..samples).map(|k| signal(k as f64 / RATE)).collect();
                let found = judged(&with_noise(&values, 0.02, 71), steady, &bearing(), 0.01);
                let outer = verdict(&found, Fault::OuterRace);
                // slip of 0.1 % spreads the harmonics below 16 kHz over three bins from 0.19 s on
                assert!(
                    !says(&found, Fault::OuterRace) || (!slips && revolutions > 4.0),
                    "{revolutions} {slips}: {outer:#?}"
                );
                said += usize::from(outer.why.contains("too short to show whether they slip"));
            }
        }
        // both signals of three revolutions
        assert!(said >= 2, "{said}");
    }

    #[test]
    fn tones_of_something_else_are_not_told() {
        // another order; every second and every third half of the line; the shaft's multiples
        for order in [3.2, 2.0 * 3.585, 1.5 * 3.585, 1.0] {
            let found = bursts(25.0 * order, 0.02);
            assert!(!says(&found, Fault::OuterRace), "{order}: {:#?}", found.faults);
        }
    }
}
