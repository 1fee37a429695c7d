//! Where the spectrum of a measured signal ends: a low-pass, or a change to a higher sampling rate, leaves nothing above but images of
//! what lies below. Whitening lifts these to the level of the rest, and they look like impacts.

use crate::numerics::series::TimeSeries;
use crate::signal::{PowerScaling, Welch, WindowFunction};

/// Samples of a segment, and fewest of a signal that is looked at.
const SEGMENT: usize = 512;
const LEAST_SEGMENTS: usize = 4;
/// Bins whose median is one level.
const BINS_A_LEVEL: usize = 4;
/// Part of half the sampling rate within which an end is sought. Below, a machine's own lines stand out of all above them; what ends
/// later is the low-pass of a recorder.
const SOUGHT: [f64; 2] = [0.2, 0.8];
/// Width of the edge over its frequency.
const EDGE: f64 = 1.15;
/// Of an octave below the edge so much lies lower than what counts as its level, and of all above it so much higher.
const OUTLIERS: f64 = 0.1;
/// Fall from one to the other at an end, dB. Of 79 measured records as they are none falls by more than 22; all fall by 25 and more if
/// they are resampled to twice the rate, and by 41 and more behind a low-pass of eighth order at a quarter of it.
const LEAST_FALL_DB: f64 = 25.0;

/// Frequency (Hz) above which a signal has nothing up to half its sampling rate; `None` where it ends nowhere, or is too short.
pub(crate) fn spectrum_end_hz(series: &TimeSeries) -> Option<f64> {
    if series.values().len() < LEAST_SEGMENTS * SEGMENT {
        return None;
    }
    let welch = Welch {
        window_function: WindowFunction::Hann,
        segment_samples: SEGMENT,
        overlap_samples: SEGMENT / 2,
        scaling: PowerScaling::Density,
    };
    let power = welch.power(series).ok()?.power;
    // without the bins of zero and of half the rate
    let levels: Vec<f64> =
        power[1..power.len() - 1].chunks_exact(BINS_A_LEVEL).map(|bins| decibel(quantile(bins, 0.5))).collect();
    let count = levels.len() as f64;
    let [first, last] = SOUGHT.map(|part| (part * count) as usize);
    let fall = |edge: usize| {
        let above = (EDGE * edge as f64) as usize;
        let below = quantile(&levels[edge / 2..edge], OUTLIERS);
        (edge, below, below - quantile(&levels[above..], 1.0 - OUTLIERS))
    };
    let (mut edge, below, fall_db) = (first..last).map(fall).max_by(|a, b| a.2.total_cmp(&b.2))?;
    if fall_db < LEAST_FALL_DB {
        return None;
    }
    while edge > first && levels[edge - 1] < below - 0.5 * fall_db {
        edge -= 1;
    }
    Some(0.5 * series.rate_hz() * edge as f64 / count)
}

fn decibel(power: f64) -> f64 {
    10.0 * power.max(f64::MIN_POSITIVE).log10()
}

/// The value below which so much of them lies; of none, 0.
fn quantile(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let place = (part * sorted.len().saturating_sub(1) as f64).round() as usize;
    sorted.get(place).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::band_limit;
    use crate::signal::samples::gaussian;

    fn series(values: Vec<f64>) -> TimeSeries {
        TimeSeries::new(0.0, 1.0 / 24e3, "g", values).unwrap()
    }

    #[test]
    fn noise_ends_where_a_low_pass_ends_it() {
        let noise = series(gaussian(48_000, 11));
        assert_eq!(spectrum_end_hz(&noise), None);
        let low = band_limit(&noise, 6e3).unwrap();
        let end = spectrum_end_hz(&low).unwrap();
        assert!((5.5e3..7.5e3).contains(&end), "{end}");
        // 25 dB have to be missing
        let mixed = |rest: f64| {
            let values = low.values().iter().zip(noise.values()).map(|(low, all)| low + rest * all);
            spectrum_end_hz(&series(values.collect()))
        };
        assert!(mixed(0.02).is_some());
        assert_eq!(mixed(0.2), None);
    }

    #[test]
    fn strong_lines_and_short_signals_end_nowhere() {
        let noise = gaussian(48_000, 12);
        let line = |k: usize| 300.0 * (0.3 * k as f64).sin();
        let values = noise.iter().enumerate().map(|(k, noise)| noise + line(k));
        assert_eq!(spectrum_end_hz(&series(values.collect())), None);
        let short = band_limit(&series(noise), 6e3).unwrap().values()[..2000].to_vec();
        assert_eq!(spectrum_end_hz(&series(short)), None);
        assert_eq!(spectrum_end_hz(&series(vec![0.0; 4096])), None);
    }
}
