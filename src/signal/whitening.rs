//! A signal made flat over frequency: what is weak in it counts as much as what resonates.

use super::fourier::{fast_length, forward, inverse};
use super::{PowerScaling, SignalError, Welch, WindowFunction, spectral_kurtosis};
use crate::numerics::series::TimeSeries;

/// Length of the segments that spectrum and kurtosis are estimated from, s: longer than a burst rings, shorter than the time
/// between bursts. Features narrower than 2 / 2.56 ms = 0.8 kHz are left as they are.
const SEGMENT_S: f64 = 2.56e-3;
/// Fewest samples of a segment.
const FEWEST_SAMPLES: usize = 16;
/// Bins to each side over which the kurtosis is averaged: that of one bin scatters.
const SMOOTHED_BINS: usize = 2;
/// Kurtosis of a bin that has none: a hundredth in amplitude of one with a kurtosis of 1e5.
const LEAST_KURTOSIS: f64 = 1e-3;

/// What a whitened signal emphasises.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Emphasis {
    /// Nothing: every frequency with the same power. Best where bursts fill the band.
    Even,
    /// Impulsive frequencies: power in proportion to the root of the spectral kurtosis K, which for bursts in noise with a
    /// signal-to-noise ratio r is r / (1 + r) but for a factor, Wiener's filter. Best where noise hides most of the band.
    Impulsive,
}

/// Divides a series by the root of its power spectrum, so that its density is the same at all frequencies, and emphasises some
/// of them:
///
/// `Y(f) = X(f) K(f)^(1/4) / sqrt(P(f) rate / 2)`, `K = 1` for [`Emphasis::Even`], whose result has a variance of 1.
///
/// Zero phase; a number without unit at the same instants. P by [`Welch`], K by [`spectral_kurtosis()`]
/// averaged over five bins, both from segments of 2.56 ms, three quarters shared, linear in between.
///
/// Sources: N. Sawalhi and R. B. Randall, Signal pre-whitening using cepstrum editing (liftering) to enhance fault detection in
/// rolling element bearings, COMADEM 2011, for the whitening before an envelope; J. Antoni and R. B. Randall, The spectral
/// kurtosis: application to the vibratory surveillance and diagnostics of rotating machines, Mechanical Systems and Signal
/// Processing 20 (2006) 308-331, for the filter.
///
/// # Errors
/// [`SignalError`] for less than 8 segments' worth.
pub fn whiten(series: &TimeSeries, emphasis: Emphasis) -> Result<TimeSeries, SignalError> {
    let segment_samples = segment_samples(series);
    let overlap_samples = overlap(segment_samples);
    let window_function = WindowFunction::Hann;
    let welch = Welch { window_function, segment_samples, overlap_samples, scaling: PowerScaling::Density };
    let spectrum = welch.power(series)?;
    let half_rate = 0.5 * series.rate_hz();
    let mut gains: Vec<f64> = spectrum
        .power
        .iter()
        .map(|power| match power * half_rate {
            scaled if scaled > 0.0 => 1.0 / scaled.sqrt(),
            _ => 0.0,
        })
        .collect();
    // the ends of a one-sided density are half as high, and the mean was taken out
    let last = gains.len() - 1;
    (gains[0], gains[last]) = (gains[1], gains[last - 1]);
    if emphasis == Emphasis::Impulsive {
        let (_, impulsive) = impulsive_gains(series)?;
        for (bin, gain) in gains.iter_mut().enumerate() {
            *gain *= impulsive[bin.min(impulsive.len() - 1)];
        }
    }
    let points = fast_length(series.values().len());
    let mean = series.mean();
    let centred: Vec<f64> = series.values().iter().map(|value| value - mean).collect();
    let mut bins = forward(&centred, points)?;
    // bins of a segment in one of the whole
    let scale = segment_samples as f64 / points as f64;
    for (bin, value) in bins.iter_mut().enumerate() {
        let place = bin as f64 * scale;
        let below = (place as usize).min(last - 1);
        let part = place - below as f64;
        *value *= gains[below] + part * (gains[below + 1] - gains[below]);
    }
    let mut values = inverse(bins, points)?;
    values.truncate(series.values().len());
    let (start, step) = (series.start_s(), series.step_s());
    Ok(TimeSeries::new(start, step, "", values)?)
}

/// Gains at frequencies that are `hz` apart, from zero to half the rate, that emphasise impulsive ones: see [`Emphasis::Impulsive`]. The
/// kurtosis is averaged over five bins, and a thousandth at least.
///
/// # Errors
/// As [`whiten`].
pub(super) fn impulsive_gains(series: &TimeSeries) -> Result<(f64, Vec<f64>), SignalError> {
    let segment = segment_samples(series);
    let found = spectral_kurtosis(series, WindowFunction::Hann, segment, overlap(segment), 0.99)?;
    // without the bins at zero and at half the rate
    let kurtosis = found.kurtosis;
    let gain = |bin: usize| {
        let middle = bin.clamp(1, kurtosis.len()) - 1;
        let first = middle.saturating_sub(SMOOTHED_BINS);
        let end = (middle + SMOOTHED_BINS + 1).min(kurtosis.len());
        let mean = kurtosis[first..end].iter().sum::<f64>() / (end - first) as f64;
        mean.max(LEAST_KURTOSIS).powf(0.25)
    };
    let hz = series.rate_hz() / segment as f64;
    Ok((hz, (0..=kurtosis.len() + 1).map(gain).collect()))
}

fn segment_samples(series: &TimeSeries) -> usize {
    let wanted = (SEGMENT_S * series.rate_hz()).round() as usize;
    fast_length(wanted.max(FEWEST_SAMPLES))
}

fn overlap(segment_samples: usize) -> usize {
    segment_samples * 3 / 4
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::gaussian;
    use std::f64::consts::TAU;

    const RATE: f64 = 100e3;

    fn series(values: Vec<f64>) -> TimeSeries {
        TimeSeries::new(0.3, 1.0 / RATE, "m/s^2", values).expect("a valid series")
    }

    /// Power in equal bands of the spectrum.
    fn bands(series: &TimeSeries, count: usize) -> Vec<f64> {
        let welch = Welch {
            window_function: WindowFunction::Hann,
            segment_samples: 256,
            overlap_samples: 128,
            scaling: PowerScaling::Density,
        };
        let power = welch.power(series).expect("a spectrum").power;
        let inner = &power[2..power.len() - 2];
        let size = inner.len() / count;
        inner.chunks_exact(size).map(|band| band.iter().sum::<f64>() / size as f64).collect()
    }

    /// Noise through a resonance of 3 % damping at 20 kHz, on a floor of white noise, about a mean of 7.
    fn coloured() -> TimeSeries {
        let (white, floor) = (gaussian(60_000, 3), gaussian(60_000, 4));
        let angle = TAU * 20e3 / RATE;
        let decay = (-0.03 * angle).exp();
        let (mut y1, mut y2) = (0.0, 0.0);
        let values = white.iter().zip(&floor).map(|(x, n)| {
            let y = x + 2.0 * decay * angle.cos() * y1 - decay * decay * y2;
            (y2, y1) = (y1, y);
            7.0 + y + 0.1 * n
        });
        series(values.collect())
    }

    #[test]
    fn a_coloured_noise_becomes_white_with_a_variance_of_one() {
        let signal = coloured();
        let levels = |of: &TimeSeries| {
            let bands = bands(of, 12);
            let most = bands.iter().copied().fold(0.0, f64::max);
            most / bands.iter().copied().fold(f64::INFINITY, f64::min)
        };
        assert!(levels(&signal) > 100.0);
        let white = whiten(&signal, Emphasis::Even).expect("whitened");
        // 468 segments of 10 bins each: a scatter of 1.5 % of a band; the rest is the peak's curvature over a bin
        assert!(levels(&white) < 1.2, "{}", levels(&white));
        assert!((white.rms() - 1.0).abs() < 0.03, "{}", white.rms());
        assert!(white.mean().abs() < 1e-3 && white.unit().is_empty());
        assert_eq!(white.values().len(), signal.values().len());
        assert!((white.start_s() - 0.3).abs() < 1e-12);
        // whatever the unit
        let scaled = signal.with_values(signal.values().iter().map(|v| 1e3 * v).collect());
        let scaled = whiten(&scaled.expect("values"), Emphasis::Even).expect("whitened");
        let parted = scaled.values().iter().zip(white.values());
        assert!(parted.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) < 1e-9);
    }

    #[test]
    fn an_impulse_stays_where_it_is() {
        let mut values = coloured().values().to_vec();
        for (k, value) in values[30_000..30_400].iter_mut().enumerate() {
            let since = TAU * 20e3 / RATE * k as f64;
            *value += 100.0 * (-0.03 * since).exp() * since.sin();
        }
        let white = whiten(&series(values), Emphasis::Even).expect("whitened");
        let magnitude = |k: &usize| white.values()[*k].abs();
        let top = (0..60_000).max_by(|a, b| magnitude(a).total_cmp(&magnitude(b)));
        let off = top.expect("samples") as f64 - 30_000.0;
        // half a period of 20 kHz
        assert!(off.abs() <= 3.0, "{off}");
    }

    #[test]
    fn the_band_of_bursts_is_emphasised_where_noise_hides_the_rest() {
        // rings of 8 kHz, 200 a second, in noise of ten times their power
        let mut values = gaussian(60_000, 9);
        for (k, value) in values.iter_mut().enumerate() {
            let since = TAU * 8e3 / RATE * (k % 500) as f64;
            *value += 2.0 * (-0.03 * since).exp() * since.sin();
        }
        let signal = series(values);
        let share = |emphasis| {
            let bands = bands(&whiten(&signal, emphasis).expect("whitened"), 6);
            // 0.8 to 8.9 and 8.9 to 50 kHz
            bands[0] / bands[1..].iter().sum::<f64>()
        };
        assert!((share(Emphasis::Even) - 0.2).abs() < 0.02);
        assert!(share(Emphasis::Impulsive) > 0.5, "{}", share(Emphasis::Impulsive));
    }

    #[test]
    fn silence_and_short_signals() {
        let silent = whiten(&series(vec![2.0; 5000]), Emphasis::Impulsive).expect("zeros");
        assert!(silent.values().iter().all(|value| value.abs() < 1e-12));
        let short = whiten(&series(vec![1.0; 100]), Emphasis::Even).expect_err("too short");
        assert!(short.to_string().starts_with("segments must have"), "{short}");
    }
}
