//! Whether a signal has noise to judge lines against, or nothing beside its tones but the rounding of its numbers.
//!
//! The rounding of a smooth signal repeats with it, so that it makes lines of its own. Noise that is as strong as the rounding takes
//! these apart: J. Vanderkooy and S. P. Lipshitz, Resolution below the least significant bit in digital systems with dither, Journal
//! of the Audio Engineering Society 32 (1984) 106-113.

use std::f64::consts::{LN_2, PI};

use super::DiagnosisError;
use crate::numerics::series::TimeSeries;
use crate::signal::{Forward, fast_length};

/// Power of the floor over that of the rounding from which there is noise: as much noise as rounding.
const LEAST_FLOOR: f64 = 2.0;
/// Finest step of a recorded signal over its largest deviation, 22 bits: no converter's noise is lower.
const FINEST_STEP: f64 = 1.0 / (1 << 22) as f64;

/// Refuses a signal whose floor within a band (Hz) is that of its rounding.
///
/// # Errors
/// [`DiagnosisError::NoNoise`].
pub(super) fn check_noise(signal: &TimeSeries, [from_hz, to_hz]: [f64; 2]) -> Result<(), DiagnosisError> {
    let mean = signal.mean();
    let centred: Vec<f64> = signal.values().iter().map(|value| value - mean).collect();
    let step = step(&centred);
    let count = centred.len() as f64;
    // tones, a drift and the ends leak 30 dB less with each octave of the distance
    let weight = |k: usize| (PI * (k as f64 + 0.5) / count).sin().powi(4);
    let points = fast_length(centred.len());
    let weighted = centred.iter().enumerate().map(|(k, x)| x * weight(k));
    let spectrum = Forward::new(points).transform(weighted)?;
    let bin_of = |hz: f64| (hz * signal.step_s() * points as f64).round() as usize;
    let end = bin_of(to_hz).clamp(1, spectrum.len());
    let bins = &spectrum[bin_of(from_hz).min(end - 1)..end];
    let mut power: Vec<f64> = bins.iter().map(|bin| bin.norm_sqr()).collect();
    let middle = power.len() / 2;
    let median = *power.select_nth_unstable_by(middle, f64::total_cmp).1;
    // mean of sin^8 is 35 / 128; the median of a bin's power is ln 2 of its mean
    let floor = median / (LN_2 * count * 35.0 / 128.0);
    if floor < LEAST_FLOOR * step * step / 12.0 {
        return Err(DiagnosisError::NoNoise { noise: floor.sqrt(), step });
    }
    Ok(())
}

/// The smallest difference of two values, at least the finest step of a recorded signal.
fn step(centred: &[f64]) -> f64 {
    let mut sorted = centred.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let largest = centred.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let finest = FINEST_STEP * largest;
    let gaps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let least = gaps.filter(|gap| *gap > finest).min_by(f64::total_cmp);
    least.unwrap_or(finest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::diagnosis::tests::{RATE, bearing, judged, steady, with_noise};
    use crate::signal::diagnosis::{Diagnosis, FaultOrders};
    use std::f64::consts::TAU;

    fn series(value: impl Fn(f64) -> f64, stored: impl Fn(f64) -> f64) -> TimeSeries {
        let values = (0..4 * RATE as usize).map(|k| stored(value(k as f64 / RATE)));
        TimeSeries::new(0.0, 1.0 / RATE, "g", values.collect()).unwrap()
    }

    #[test]
    fn what_has_no_noise_is_refused() {
        let orders = FaultOrders::of(&bearing(), 0.01).unwrap();
        let sine = |t: f64| (TAU * 107.3 * t).sin();
        let sines = |t: f64| [25.0, 89.6, 1234.5, 2222.2].map(|f| (TAU * f * t).sin()).iter().sum();
        let chirp = |t: f64| (TAU * (100.0 + 100.0 * t) * t).sin();
        let square = |t: f64| (TAU * 50.0 * t + 0.1).sin().signum();
        let whole = |x: f64| x;
        let single = |x: f64| f64::from(x as f32);
        let short = |x: f64| (8000.0 * x).round();
        let offset = |x: f64| f64::from((1e6 + x) as f32);
        let signals: [&dyn Fn(f64) -> f64; 5] = [&sine, &sines, &chirp, &square, &|t| t];
        let stored: [&dyn Fn(f64) -> f64; 4] = [&whole, &single, &short, &offset];
        for (which, signal) in signals.iter().enumerate() {
            for (how, stored) in stored.iter().enumerate() {
                let series = series(signal, stored);
                let found = Diagnosis::of(&series, None, series.span(), steady, &orders);
                assert!(matches!(found, Err(DiagnosisError::NoNoise { .. })), "{which} {how}: {found:?}");
            }
        }
    }

    /// The noise of a recorder of 16 bits is half of its step at least.
    #[test]
    fn noise_of_half_a_step_is_enough() {
        let tones: Vec<f64> = (0..4 * RATE as usize).map(|k| 2e4 * (TAU * 107.3 * k as f64 / RATE).sin()).collect();
        let noisy = with_noise(&tones, 0.5, 61);
        let rounded = noisy.values().iter().map(|value| value.round() / 32768.0);
        let series = TimeSeries::new(0.0, 1.0 / RATE, "g", rounded.collect()).unwrap();
        let found = judged(&series, steady, &bearing(), 0.01);
        assert!(found.is_judged() && found.unexplained.is_empty());
        // an offset that double precision holds takes nothing away
        let offset = noisy.values().iter().map(|value| 1e9 + value);
        let series = TimeSeries::new(0.0, 1.0 / RATE, "g", offset.collect()).unwrap();
        assert!(judged(&series, steady, &bearing(), 0.01).is_judged());
    }
}
