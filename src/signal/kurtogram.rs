//! The fast kurtogram: which band of a signal is the most impulsive?

use std::f64::consts::PI;

use realfft::num_complex::Complex;
use serde::Serialize;

use super::SignalError;
use super::envelope::quadrature;
use super::spectral_kurtosis::{FEWEST_VALUES, kurtosis_limit};
use crate::numerics::series::TimeSeries;

/// Order of the filters that halve a band, and of those that cut it in three.
const ORDERS: (usize, usize) = (16, 24);

/// Cut-off of the halving filters' prototype, over half the rate; two thirds of it for three.
const CUT_OFF: f64 = 0.4;

/// Samples dropped at each end of the analytic signal, where its transform takes the end to meet the start: 1 / (64 pi) of
/// that jump is left.
const EDGE: usize = 64;

/// Fewest values in a band.
const FEWEST_IN_BAND: usize = 100;

/// Most levels of halving: 2^20 bands are more than anyone can look at.
const MOST_LEVELS: usize = 20;

/// Lags over which the values of a band are held for correlated.
const LAGS: usize = 16;

/// One band of a kurtogram.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct KurtogramBand {
    /// Number of bands on its level: 1, 2, 3, 4, 6, 8, 12, ...
    pub bands: usize,
    /// Middle of the band, Hz.
    pub centre_hz: f64,
    /// Width of the band, Hz; the filters are 6 dB down at 0.8 of that from the middle.
    pub width_hz: f64,
    /// Kurtosis of the complex envelope, mean |c|^4 / (mean |c|^2)^2 - 2: 0 for Gaussian noise, -1 for a tone.
    pub kurtosis: f64,
    /// What Gaussian noise exceeds in no band, with the confidence of the kurtogram.
    pub limit: f64,
    /// Values of the envelope.
    pub values: usize,
}

/// Kurtosis over bands of many widths.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Kurtogram {
    /// Bands, level by level, rising in frequency.
    pub bands: Vec<KurtogramBand>,
    /// Confidence of the limits, for all bands together.
    pub confidence: f64,
}

impl KurtogramBand {
    /// Lower and upper edge, Hz, to 12 digits: a rate is one over a step that was rounded, and 25 000 Hz shall be that.
    pub(crate) fn edges_hz(&self) -> [f64; 2] {
        // the middle is a half more than a whole number of widths
        let place = (self.centre_hz / self.width_hz - 0.5).round();
        [place, place + 1.0].map(|edge| {
            let edge = edge * self.width_hz;
            format!("{edge:.11e}").parse().unwrap_or(edge)
        })
    }
}

impl Kurtogram {
    /// The band with the largest kurtosis.
    pub fn largest(&self) -> Option<&KurtogramBand> {
        let bands = self.bands.iter();
        bands.max_by(|a, b| a.kurtosis.total_cmp(&b.kurtosis))
    }

    /// The band with the largest kurtosis of those beyond their limit: what to demodulate. `None`: the signal cannot be told
    /// from Gaussian noise, and no band should be preferred.
    pub(crate) fn most_impulsive(&self) -> Option<&KurtogramBand> {
        let beyond = self.bands.iter().filter(|band| band.kurtosis > band.limit);
        beyond.max_by(|a, b| a.kurtosis.total_cmp(&b.kurtosis))
    }

    /// Of these bands alone. The limits stay, which are for all: on the safe side.
    pub(crate) fn of_those(&self, wanted: impl Fn(&KurtogramBand) -> bool) -> Self {
        let bands = self.bands.iter().copied();
        Self { bands: bands.filter(wanted).collect(), confidence: self.confidence }
    }
}

/// Fast kurtogram of a series, mean removed: a tree of filters that cut a band in two halves (order 16, every second value
/// kept) and each band once in three thirds (order 24, every third), on `levels` 1 to 20 or as far as bands have 100 values.
/// Only values that a whole filter covers are used. The root is the analytic signal, so that all bands are complex and
/// obey one law. `confidence`, 0.99 say, is that of the limits for all bands together; values of a band that correlate, as
/// those of coloured noise do, count as N / sum_i |rho_i|^4 independent ones.
///
/// Source: J. Antoni, "Fast computation of the kurtogram for the detection of transient faults", Mechanical Systems and
/// Signal Processing 21 (2007) 108-124; limits: Nita and Gary (2010).
///
/// # Errors
/// [`SignalError`] below 344 samples, and for levels or a confidence out of range.
pub fn kurtogram(series: &TimeSeries, levels: usize, confidence: f64) -> Result<Kurtogram, SignalError> {
    let samples = series.values().len();
    let needed = 2 * (EDGE + FEWEST_IN_BAND) + ORDERS.0;
    if samples < needed {
        return Err(SignalError::too_short(samples, needed));
    }
    if levels == 0 || levels > MOST_LEVELS {
        return Err(SignalError(format!("levels must be 1 to {MOST_LEVELS}, found {levels}")));
    }
    let halves = [1.0, 3.0].map(|part| filter(ORDERS.0, CUT_OFF, part / 4.0));
    let thirds = [1.0, 3.0, 5.0].map(|part| filter(ORDERS.1, CUT_OFF * 2.0 / 3.0, part / 6.0));
    let mut level = vec![analytic(series)?];
    let mut rows = vec![figures(&level)];
    for depth in 1..=levels {
        let in_three = split(&level, &thirds);
        if depth > 1 && are_long(&in_three) {
            rows.push(figures(&in_three));
        }
        level = split(&level, &halves);
        if !are_long(&level) {
            break;
        }
        rows.push(figures(&level));
    }
    rows.sort_by_key(Vec::len);
    let trials = rows.iter().map(Vec::len).sum();
    let mut bands = Vec::with_capacity(trials);
    for row in rows {
        let width_hz = 0.5 * series.rate_hz() / row.len() as f64;
        for (place, figures) in row.iter().enumerate() {
            bands.push(KurtogramBand {
                bands: row.len(),
                centre_hz: (place as f64 + 0.5) * width_hz,
                width_hz,
                kurtosis: figures.kurtosis,
                limit: kurtosis_limit(figures.independent, trials, confidence)?,
                values: figures.values,
            });
        }
    }
    Ok(Kurtogram { bands, confidence })
}

/// x + i H x without its ends.
fn analytic(series: &TimeSeries) -> Result<Vec<Complex<f64>>, SignalError> {
    let mean = series.mean();
    let centred: Vec<f64> = series.values().iter().map(|v| v - mean).collect();
    let both = centred.iter().zip(quadrature(&centred)?);
    let inside = both.skip(EDGE).take(centred.len() - 2 * EDGE);
    Ok(inside.map(|(x, h)| Complex::new(*x, h)).collect())
}

/// Low-pass of an order (Hamming window, gain 1 in its middle) with its cut-off over half the rate, moved to `middle` over
/// half the rate: `firwin(order + 1, cut_off) * exp(i pi middle n)`.
fn filter(order: usize, cut_off: f64, middle: f64) -> Vec<Complex<f64>> {
    let tap = |n: usize| {
        let from_centre = n as f64 - 0.5 * order as f64;
        let angle = PI * cut_off * from_centre;
        let sinc = if n * 2 == order { 1.0 } else { angle.sin() / angle };
        sinc * (0.54 - 0.46 * (2.0 * PI * n as f64 / order as f64).cos())
    };
    let sum: f64 = (0..=order).map(tap).sum();
    (0..=order).map(|n| Complex::from_polar(tap(n) / sum, PI * middle * n as f64)).collect()
}

/// Each signal of a level through each filter, as many times slower as there are filters; the bands rise in frequency.
/// Every signal fills 0 to pi of its rate: an upper half would come to lie at pi to 2 pi and is moved by pi.
fn split(level: &[Vec<Complex<f64>>], filters: &[Vec<Complex<f64>>]) -> Vec<Vec<Complex<f64>>> {
    let ratio = filters.len();
    let one = |signal: &Vec<Complex<f64>>, place: usize| -> Vec<Complex<f64>> {
        let taps = &filters[place];
        let windows = signal.windows(taps.len()).step_by(ratio).enumerate();
        let values = windows.map(|(k, window)| {
            let products = window.iter().rev().zip(taps).map(|(x, h)| x * h);
            let sum: Complex<f64> = products.sum();
            if place % 2 == 1 && k % 2 == 1 { -sum } else { sum }
        });
        values.collect()
    };
    let pairs = level.iter().flat_map(|signal| (0..ratio).map(move |place| (signal, place)));
    pairs.map(|(signal, place)| one(signal, place)).collect()
}

fn are_long(level: &[Vec<Complex<f64>>]) -> bool {
    level.iter().all(|signal| signal.len() >= FEWEST_IN_BAND)
}

/// What is known of a band.
struct Figures {
    kurtosis: f64,
    values: usize,
    independent: f64,
}

fn figures(level: &[Vec<Complex<f64>>]) -> Vec<Figures> {
    let of = |signal: &Vec<Complex<f64>>| {
        let count = signal.len() as f64;
        let second: f64 = signal.iter().map(Complex::norm_sqr).sum();
        let fourth: f64 = signal.iter().map(|c| c.norm_sqr() * c.norm_sqr()).sum();
        if second <= 0.0 {
            return Figures { kurtosis: 0.0, values: signal.len(), independent: count };
        }
        let correlation = |lag: usize| {
            let pairs = signal[lag..].iter().zip(signal);
            let sum: Complex<f64> = pairs.map(|(a, b)| a * b.conj()).sum();
            (sum.norm() / second).powi(4)
        };
        let correlated: f64 = (1..=LAGS).map(correlation).sum();
        Figures {
            kurtosis: count * fourth / (second * second) - 2.0,
            values: signal.len(),
            independent: (count / (1.0 + 2.0 * correlated)).max(FEWEST_VALUES),
        }
    };
    level.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::{gaussian, items, load, numbers};

    fn series(values: Vec<f64>) -> TimeSeries {
        TimeSeries::new(0.0, 2e-5, "m/s^2", values).expect("a valid series")
    }

    #[test]
    fn agrees_with_the_same_tree_in_scipy() {
        let reference = load("kurtogram");
        let found = kurtogram(&series(numbers(&reference["x"])), 3, 0.99).expect("kurtogram");
        let rows = items(&reference["rows"]);
        let expected: Vec<f64> = rows.iter().flat_map(numbers).collect();
        let counts: Vec<usize> = found.bands.iter().map(|band| band.bands).collect();
        let wanted = rows.iter().flat_map(|row| vec![items(row).len(); items(row).len()]);
        assert_eq!(counts, wanted.collect::<Vec<_>>());
        for (band, expected) in found.bands.iter().zip(expected) {
            // rounding
            assert!((band.kurtosis - expected).abs() < 1e-10, "{band:?}: {expected}");
        }
    }

    #[test]
    fn edges_are_written_without_rounding_of_their_own() {
        let found = kurtogram(&series(gaussian(20_000, 1)), 4, 0.99).expect("kurtogram");
        for level in found.bands.chunk_by(|a, b| a.bands == b.bands) {
            for (place, band) in level.iter().enumerate() {
                let written = band.edges_hz().map(|edge| edge.to_string());
                // 12 digits and a point
                assert!(written.iter().all(|edge| edge.len() <= 13), "{written:?}");
                assert_eq!(written[0] == "0", place == 0);
                assert_eq!(written[1] == "25000", place + 1 == band.bands);
            }
        }
    }

    #[test]
    fn the_resonance_of_repeated_impacts_is_found() {
        // rings of 12 kHz (5 % damping) every 10 ms in noise as strong as a tenth of their peak, and a strong tone
        let mut values = gaussian(50_000, 3);
        for (k, v) in values.iter_mut().enumerate() {
            let since = (k % 500) as f64 * 2e-5;
            *v += 10.0 * (-0.05 * 2.0 * PI * 12e3 * since).exp() * (2.0 * PI * 12e3 * since).sin();
            *v += 20.0 * (2.0 * PI * 1700.0 * k as f64 * 2e-5).sin();
        }
        let found = kurtogram(&series(values), 5, 0.99).expect("kurtogram");
        let best = found.most_impulsive().expect("impacts");
        assert_eq!(Some(best), found.largest());
        assert!((best.centre_hz - 12e3).abs() <= 0.5 * best.width_hz, "{best:?}");
        assert!(best.kurtosis > 5.0 * best.limit, "{best:?}");
    }

    #[test]
    fn gaussian_noise_has_no_impulsive_band() {
        // white, and coloured by a resonance: 40 each, at 95 %
        let mut exceeding = [0, 0];
        for seed in 0..40 {
            let white = gaussian(6000, 100 + seed);
            let (mut last, mut before) = (0.0, 0.0);
            let coloured = white.iter().map(|w| {
                let next = w + 1.8 * last - 0.9 * before;
                (before, last) = (last, next);
                next
            });
            let coloured: Vec<f64> = coloured.collect();
            for (count, values) in exceeding.iter_mut().zip([white, coloured]) {
                let found = kurtogram(&series(values), 5, 0.95).expect("kurtogram");
                *count += u32::from(found.most_impulsive().is_some());
            }
        }
        // 2 expected, bands of one noise are not independent; 7 or more in one of 200 such tests
        assert!(exceeding.iter().all(|count| *count < 7), "{exceeding:?}");
    }

    #[test]
    fn the_limits_are_close() {
        // at 1 % most noises exceed some limit: it is no more than noise reaches
        let some = (0..20).filter(|seed| {
            let found = kurtogram(&series(gaussian(6000, *seed)), 5, 0.01).expect("kurtogram");
            found.most_impulsive().is_some()
        });
        let count = some.count();
        assert!(count >= 7, "{count}");
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |samples, levels, confidence| {
            let found = kurtogram(&series(vec![0.0; samples]), levels, confidence);
            found.expect_err("must fail").to_string()
        };
        assert_eq!(message(343, 1, 0.9), "series has 343 samples, the filter or transform needs at least 344");
        assert_eq!(message(344, 0, 0.9), "levels must be 1 to 20, found 0");
        assert_eq!(message(344, 21, 0.9), "levels must be 1 to 20, found 21");
        assert!(message(344, 1, 0.0).starts_with("confidence must lie"));
        let silent = kurtogram(&series(vec![1.0; 344]), 20, 0.9).expect("zeros");
        assert_eq!(silent.bands.len(), 3);
        assert_eq!(silent.most_impulsive(), None);
    }
}
