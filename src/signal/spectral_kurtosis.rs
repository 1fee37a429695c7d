//! Kurtosis of a signal at each frequency.
//!
//! What Gaussian noise reaches in kurtosis.

use super::fourier::Forward;
use super::{SignalError, WindowFunction};
use crate::numerics::series::TimeSeries;
use serde::Serialize;

/// Kurtosis over frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpectralKurtosis {
    /// Bin frequencies between zero and half the rate, both left out, Hz.
    pub frequency_hz: Vec<f64>,
    /// Kurtosis there: 0 for Gaussian noise, -1 for a steady tone, large for repeated impacts.
    pub kurtosis: Vec<f64>,
    /// What Gaussian noise exceeds nowhere, with the confidence asked for.
    pub limit: f64,
    /// Confidence of the limit, for all frequencies together.
    pub confidence: f64,
    /// Segments.
    pub segments: usize,
    /// Segments that as many independent ones would be worth.
    pub independent_segments: f64,
    /// What is separated: main lobe of the window function over the length of a segment, Hz.
    pub resolution_hz: f64,
}

/// Spectral kurtosis of a series from short transforms X_j(f) of `segment_samples` n, windowed, `overlap_samples` shared,
///
/// K(f) = mean |X_j|^4 / (mean |X_j|^2)^2 - 2,
///
/// with the limit that Gaussian noise keeps below with `confidence` at all frequencies together. Segments must be longer
/// than a burst's ringing and shorter than the time between bursts. M overlapping segments count as
/// M / sum_i |rho(i hop)|^4, rho the window's correlation with itself moved by i hops.
///
/// Source: J. Antoni, "The spectral kurtosis: a useful tool for characterising non-stationary signals", Mechanical Systems
/// and Signal Processing 20 (2006) 282-307, with a limit for few segments
/// (Nita and Gary 2010) instead of the normal law.
///
/// # Errors
/// [`SignalError`] for segments that do not fit, below 8 independent segments, and for the confidence.
pub fn spectral_kurtosis(
    series: &TimeSeries,
    window_function: WindowFunction,
    segment_samples: usize,
    overlap_samples: usize,
    confidence: f64,
) -> Result<SpectralKurtosis, SignalError> {
    let n = segment_samples;
    let samples = series.values().len();
    if n < 4 || n > samples || overlap_samples >= n {
        return Err(SignalError::segments(n, overlap_samples, samples));
    }
    let hop = n - overlap_samples;
    let window = window_function.samples(n);
    let segments = (samples - n) / hop + 1;
    let worth = segment_worth(&window, hop);
    if segments as f64 * worth < FEWEST_VALUES {
        let needed = n + hop * ((FEWEST_VALUES / worth).ceil() as usize - 1);
        return Err(SignalError::too_short(samples, needed));
    }
    let plan = Forward::new(n);
    let inner = (n - 1) / 2;
    let (mut second, mut fourth) = (vec![0.0; inner], vec![0.0; inner]);
    let mean = series.mean();
    for first in (0..=samples - n).step_by(hop) {
        let segment = series.values()[first..first + n].iter().zip(&window);
        let bins = plan.transform(segment.map(|(x, w)| (x - mean) * w))?;
        for ((second, fourth), bin) in second.iter_mut().zip(&mut fourth).zip(&bins[1..]) {
            let power = bin.norm_sqr();
            *second += power;
            *fourth += power * power;
        }
    }
    let kurtosis = second
        .iter()
        .zip(&fourth)
        .map(|(second, fourth)| if *second > 0.0 { segments as f64 * fourth / (second * second) - 2.0 } else { 0.0 });
    let bin_hz = 1.0 / (n as f64 * series.step_s());
    let independent_segments = segments as f64 * worth;
    Ok(SpectralKurtosis {
        frequency_hz: (1..=inner).map(|m| m as f64 * bin_hz).collect(),
        kurtosis: kurtosis.collect(),
        limit: kurtosis_limit(independent_segments, inner, confidence)?,
        confidence,
        segments,
        independent_segments,
        resolution_hz: window_function.main_lobe_bins() * bin_hz,
    })
}

/// 1 / sum_i |rho(i hop)|^4.
fn segment_worth(window: &[f64], hop: usize) -> f64 {
    let correlation = |shift: usize| -> f64 { window[shift..].iter().zip(window).map(|(a, b)| a * b).sum() };
    let whole = correlation(0);
    let shifts = (hop..window.len()).step_by(hop);
    let sum: f64 = shifts.map(|shift| (correlation(shift) / whole).powi(4)).sum();
    1.0 / (1.0 + 2.0 * sum)
}

/// Fewest independent values for which the limit is offered; below 32 it is on the safe side.
pub(super) const FEWEST_VALUES: f64 = 8.0;

/// Kurtosis M S_2 / S_1^2 - 2 (S_1 = sum |x|^2, S_2 = sum |x|^4) of M independent complex Gaussian values is 0 on average
/// but for -2 / (M + 1), and exceeds this limit in one of `trials` trials with probability 1 - `confidence`.
///
/// (M + 1) / (M - 1) (M S_2 / S_1^2 - 1) has mean 1 and the moments of G. M. Nita and D. E. Gary, "Statistics of the
/// spectral kurtosis estimator", Publ. Astronomical Society of the Pacific 122 (2010) 595-607; its quantile by the
/// Cornish-Fisher expansion to the fourth moment. By simulation of 2e5 to 6e6 trials each, M = 32 to 1024, the rate of
/// excess is 0.4 to 1.2 of the wanted one down to 1e-4, at most 2 at 1e-5. The normal law, 2 u / sqrt(M), is exceeded
/// several times more often.
///
/// # Errors
/// [`SignalError`] unless 0 < confidence < 1.
pub(super) fn kurtosis_limit(values: f64, trials: usize, confidence: f64) -> Result<f64, SignalError> {
    if !(confidence > 0.0 && confidence < 1.0) {
        return Err(SignalError(format!("confidence must lie between 0 and 1, found {confidence}")));
    }
    let m = values;
    let variance = 4.0 * m * m / ((m - 1.0) * (m + 2.0) * (m + 3.0));
    let skewness_squared =
        4.0 * (m + 2.0) * (m + 3.0) * (5.0 * m - 7.0).powi(2) / ((m - 1.0) * (m + 4.0).powi(2) * (m + 5.0).powi(2));
    let fourth = 3.0 * (m + 2.0) * (m + 3.0) * (m.powi(3) + 98.0 * m * m - 185.0 * m + 78.0)
        / ((m - 1.0) * (m + 4.0) * (m + 5.0) * (m + 6.0) * (m + 7.0));
    let (skewness, excess) = (skewness_squared.sqrt(), fourth - 3.0);
    let z = normal_excess((1.0 - confidence) / trials as f64);
    let quantile = z + (z * z - 1.0) * skewness / 6.0 + (z.powi(3) - 3.0 * z) * excess / 24.0
        - (2.0 * z.powi(3) - 5.0 * z) * skewness_squared / 36.0;
    Ok((m - 1.0) / (m + 1.0) * (1.0 + variance.sqrt() * quantile) - 1.0)
}

/// z that a standard normal variable exceeds with probability 0 < p < 1, to 4.5e-4: Abramowitz and Stegun, "Handbook of
/// Mathematical Functions", 26.2.23.
fn normal_excess(p: f64) -> f64 {
    let t = (-2.0 * p.min(1.0 - p).ln()).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let z = t - above / below;
    if p <= 0.5 { z } else { -z }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::gaussian;
    use std::f64::consts::PI;

    fn kurtosis(values: Vec<f64>, confidence: f64) -> SpectralKurtosis {
        let series = TimeSeries::new(0.0, 1e-4, "m/s^2", values).expect("a valid series");
        spectral_kurtosis(&series, WindowFunction::Hann, 64, 32, confidence).expect("kurtosis")
    }

    #[test]
    fn gaussian_noise_stays_below_the_limit() {
        // 40 noises at 90 %: 4 exceed it on average, with a scatter of 2
        let exceeding = (0..40).filter(|seed| {
            let found = kurtosis(gaussian(8000, *seed), 0.9);
            found.kurtosis.iter().any(|k| *k > found.limit)
        });
        let count = exceeding.count();
        assert!((1..=10).contains(&count), "{count}");
    }

    #[test]
    fn bursts_stand_out_at_their_frequency_and_a_tone_falls_to_minus_one() {
        // rings of 2 kHz every 40 ms, a tone of 4 kHz, noise
        let mut values = gaussian(8000, 7);
        for (k, v) in values.iter_mut().enumerate() {
            let since = (k % 400) as f64;
            *v += 20.0 * (-since / 20.0).exp() * (0.4 * PI * since).sin();
            *v += 10.0 * (0.8 * PI * k as f64).cos();
        }
        let found = kurtosis(values, 0.99);
        let top = (0..found.kurtosis.len()).max_by(|a, b| found.kurtosis[*a].total_cmp(&found.kurtosis[*b]));
        let top_hz = found.frequency_hz[top.expect("bins")];
        assert!((top_hz - 2000.0).abs() <= found.resolution_hz, "{top_hz}");
        assert!(found.kurtosis[top.expect("bins")] > 5.0 * found.limit);
        let at_4000 = found.frequency_hz.iter().position(|f| (f - 4000.0).abs() < 80.0);
        assert!((found.kurtosis[at_4000.expect("a bin")] + 1.0).abs() < 0.05);
        assert!((found.resolution_hz - 312.5).abs() < 1e-9);
    }

    #[test]
    fn overlap_adds_no_more_than_it_is_worth() {
        let series = TimeSeries::new(0.0, 1.0, "N", gaussian(8000, 1)).expect("a valid series");
        let of = |window, overlap| {
            let found = spectral_kurtosis(&series, window, 64, overlap, 0.99);
            found.expect("kurtosis").independent_segments
        };
        assert!((of(WindowFunction::Boxcar, 0) - 125.0).abs() < 1e-9);
        // Hann: rho(half) = 1/6
        let half = 249.0 / (1.0 + 2.0 / 6_f64.powi(4));
        assert!((of(WindowFunction::Hann, 32) - half).abs() < 1e-3 * half);
        // one sample apart: nearly as many times less worth as there are more
        assert!(of(WindowFunction::Hann, 63) < 2.0 * half);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let series = TimeSeries::new(0.0, 1.0, "N", vec![1.0; 300]).expect("a valid series");
        let message = |segment, overlap, confidence| {
            let boxcar = WindowFunction::Boxcar;
            let found = spectral_kurtosis(&series, boxcar, segment, overlap, confidence);
            found.expect_err("must fail").to_string()
        };
        assert!(message(3, 0, 0.9).starts_with("segments must have 2 to 300 samples"));
        assert!(message(8, 8, 0.9).starts_with("segments must have"));
        assert!(message(301, 8, 0.9).starts_with("segments must have"));
        assert_eq!(message(40, 0, 0.9), "series has 300 samples, the filter or transform needs at least 320");
        assert_eq!(message(4, 0, 1.0), "confidence must lie between 0 and 1, found 1");
        let silent = spectral_kurtosis(&series, WindowFunction::Hann, 4, 2, 0.9).expect("zeros");
        assert!(silent.kurtosis.iter().all(|k| k.abs() <= 0.0));
    }
}

#[cfg(test)]
mod kurtosis_limit_tests {
    use super::*;

    #[test]
    fn normal_quantiles_are_those_of_tables() {
        for (p, z) in [(0.5, 0.0), (0.05, 1.644_854), (0.99, -2.326_348), (1e-6, 4.753_424)] {
            assert!((normal_excess(p) - z).abs() < 4.5e-4, "{p}");
        }
    }

    #[test]
    fn one_noise_in_a_hundred_exceeds_the_limit() {
        // |x|^2 of complex Gaussian noise is exponential
        let mut state = 5_u64;
        let mut exponential = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            -(((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64).ln()
        };
        for (values, limit_at) in [(64, 0.01), (500, 0.01)] {
            let limit = kurtosis_limit(f64::from(values), 1, 1.0 - limit_at).expect("a limit");
            let trials = 4000;
            let exceeding = (0..trials).filter(|_| {
                let (mut first, mut second) = (0.0, 0.0);
                for _ in 0..values {
                    let power = exponential();
                    first += power;
                    second += power * power;
                }
                f64::from(values) * second / (first * first) - 2.0 > limit
            });
            // 40 expected, 28 with 64 values; scatter 6
            let count = exceeding.count();
            assert!((15..60).contains(&count), "{values}: {count}");
        }
    }

    #[test]
    fn confidence_outside_zero_to_one_is_refused() {
        let message = |c| kurtosis_limit(100.0, 1, c).expect_err("must fail").to_string();
        assert_eq!(message(1.0), "confidence must lie between 0 and 1, found 1");
        assert!(message(f64::NAN).ends_with("found NaN"));
    }
}
