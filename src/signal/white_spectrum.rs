//! A signal's spectrum made flat and freed of its tones, and the envelopes of bands of it.
//!
//! A signal's spectrum as it is, and the envelopes of bands of it in the signal's unit.

use super::SignalError;
use super::fourier::{MOST_POINTS, fast_length, forward};
use super::whitening::impulsive_gains;
use crate::numerics::series::TimeSeries;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// Width over which the median amplitude is taken, Hz: narrower than a resonance of a machine, wider than many lines.
const MEDIAN_HZ: f64 = 50.0;
/// Fewest bins of that median: its own scatter is 1 / sqrt(25) of it then.
const FEWEST_BINS: usize = 25;
/// Largest amplitude of a bin over the median about it. Noise (Rayleigh) exceeds it in 0.2 % of its bins, 2^-9; a tone would
/// stand many times higher.
const LIMIT: f64 = 3.0;

/// Spectrum of a signal whose bins have a magnitude of about one each, and of three at most.
///
/// `Y_m = X_m / |X_m| min(|X_m| / median, 3)`, the median amplitude that of the bins within 25 Hz on each side.
///
/// Resonances count as much as what lies between them. Tones (gear meshes, the supply's frequency, slots) are cut down to the level of
/// the noise about them, so that two of them make no beat in an envelope. In the limit of a bound of one this is the cepstrum
/// prewhitening of P. Borghesani, P. Pennacchi, R. B. Randall, N. Sawalhi and R. Ricci, Application of cepstrum
/// pre-whitening for the diagnosis of bearing faults under variable speed conditions, Mechanical Systems and Signal Processing 36 (2013)
/// 370-384, which loses the strength of a resonance's bins with their phase kept; the bound of three keeps more of weak impacts.
#[derive(Debug, Clone)]
pub(crate) struct WhiteSpectrum {
    /// The spectrum itself: envelopes of its bands have about four times the band's width as their rate.
    pub whitened: RawSpectrum,
    /// Amplitude of each bin over the median about it, before it is bounded; [`bin`](Self::bin) is that of a frequency.
    pub over_median: Vec<f64>,
}

impl WhiteSpectrum {
    /// Whitens a series.
    ///
    /// # Errors
    /// [`SignalError`], which no valid series causes.
    pub(crate) fn of(series: &TimeSeries) -> Result<Self, SignalError> {
        let mut whitened = RawSpectrum::unscaled(series)?;
        let RawSpectrum { bins, points, .. } = &mut whitened;
        let amplitudes: Vec<f64> = bins.iter().map(|bin| bin.norm()).collect();
        let reach = (0.5 * MEDIAN_HZ * series.step_s() * *points as f64) as usize;
        let medians = running_median(&amplitudes, reach.max(FEWEST_BINS / 2));
        // bins of nothing but rounding stay as small as they are
        let least = 1e-12 * amplitudes.iter().fold(0.0_f64, |most, &a| most.max(a));
        let pairs = amplitudes.iter().zip(&medians);
        let over_median: Vec<f64> =
            pairs.map(|(amplitude, median)| amplitude / median.max(least).max(f64::MIN_POSITIVE)).collect();
        for ((bin, amplitude), over_median) in bins.iter_mut().zip(&amplitudes).zip(&over_median) {
            let wanted = over_median.min(LIMIT);
            *bin = if *amplitude > 0.0 { *bin * (wanted / amplitude) } else { Complex::new(0.0, 0.0) };
        }
        Ok(Self { whitened, over_median })
    }

    /// The same with the impulsive frequencies of the series emphasised, by the root of their spectral kurtosis.
    ///
    /// # Errors
    /// A series that is too short for a kurtosis.
    pub(crate) fn impulsive(&self, series: &TimeSeries) -> Result<RawSpectrum, SignalError> {
        let (hz, gains) = impulsive_gains(series)?;
        let mut whitened = self.whitened.clone();
        let bin_hz = 1.0 / (whitened.step_s * whitened.points as f64);
        let last = gains.len() - 1;
        let gain = |bin: usize| gains[((bin as f64 * bin_hz / hz).round() as usize).min(last)];
        for (bin, value) in whitened.bins.iter_mut().enumerate() {
            *value *= gain(bin);
        }
        Ok(whitened)
    }

    /// Place of a frequency (Hz) among the bins, not rounded.
    pub(crate) fn bin(&self, hz: f64) -> f64 {
        hz * self.whitened.step_s * self.whitened.points as f64
    }
}

/// Median of the values within `reach` of each place, exact at every half of the reach and linear between.
pub(crate) fn running_median(values: &[f64], reach: usize) -> Vec<f64> {
    let last = values.len().saturating_sub(1);
    let stride = (reach / 2).max(1);
    let mut work = Vec::with_capacity(2 * reach + 1);
    let mut at = |place: usize| {
        work.clear();
        work.extend_from_slice(&values[place.saturating_sub(reach)..(place + reach).min(last) + 1]);
        let middle = work.len() / 2;
        *work.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    let mut medians = Vec::with_capacity(values.len());
    let mut place = 0;
    let mut here = at(0);
    while medians.len() < values.len() {
        let next_place = (place + stride).min(last);
        let next = at(next_place);
        let count = (next_place - place).max(1);
        for step in 0..count {
            medians.push(here + (next - here) * step as f64 / count as f64);
        }
        (place, here) = (next_place, next);
        if place == last {
            medians.push(here);
        }
    }
    medians.truncate(values.len());
    medians
}

/// Spectrum of a series without its mean, of which envelopes of many bands are taken.
///
/// Bands have straight edges: no bin beyond them counts. So the same band of two signals is the same whatever their sampling rates, as
/// long as both reach its upper edge.
#[derive(Debug, Clone)]
pub(crate) struct RawSpectrum {
    pub(super) bins: Vec<Complex<f64>>,
    pub(super) points: usize,
    start_s: f64,
    pub(super) step_s: f64,
}

/// Squared envelope of a band at equal steps.
#[derive(Debug, Clone)]
pub(crate) struct BandEnvelope {
    /// Instant of the first value, s.
    pub start_s: f64,
    /// Step, s.
    pub step_s: f64,
    /// Squared magnitude of the band's analytic signal.
    pub squared: Vec<f64>,
}

impl BandEnvelope {
    /// Magnitude of the band's analytic signal.
    pub(crate) fn magnitude(&self) -> Vec<f64> {
        self.squared.iter().map(|power| power.sqrt()).collect()
    }
}

impl RawSpectrum {
    /// Spectrum of a series.
    ///
    /// # Errors
    /// [`SignalError`], which no valid series causes.
    pub(crate) fn of(series: &TimeSeries) -> Result<Self, SignalError> {
        let mut spectrum = Self::unscaled(series)?;
        // that of the analytic signal: twice that of the signal, over the number of its samples
        let scale = 2.0 / spectrum.points as f64;
        for bin in &mut spectrum.bins {
            *bin *= scale;
        }
        Ok(spectrum)
    }

    /// The transform itself of the series without its mean.
    pub(super) fn unscaled(series: &TimeSeries) -> Result<Self, SignalError> {
        let points = fast_length(series.values().len().min(MOST_POINTS));
        let mean = series.mean();
        let centred: Vec<f64> = series.values().iter().map(|value| value - mean).collect();
        let bins = forward(&centred, points)?;
        Ok(Self { bins, points, start_s: series.start_s(), step_s: series.step_s() })
    }

    /// Squared envelope |x + i H x|^2 of the band between two frequencies (Hz, 0 to half the sampling rate), in the square of the series'
    /// unit, at a rate of about twice the band's width or more. Its mean is twice the mean square of what lies in the band.
    ///
    /// The series is taken as periodic: cut a window out of a longer stretch where its ends matter.
    pub(crate) fn envelope(&self, [from_hz, to_hz]: [f64; 2]) -> BandEnvelope {
        let bin_of = |hz: f64| (hz * self.step_s * self.points as f64).round() as usize;
        let first = bin_of(from_hz).max(1).min(self.bins.len() - 1);
        let end = bin_of(to_hz).clamp(first + 1, self.bins.len());
        let length = fast_length(2 * (end - first));
        let mut band = vec![Complex::new(0.0, 0.0); length];
        band[..end - first].copy_from_slice(&self.bins[first..end]);
        FftPlanner::new().plan_fft_inverse(length).process(&mut band);
        BandEnvelope {
            start_s: self.start_s,
            step_s: self.step_s * self.points as f64 / length as f64,
            squared: band.iter().map(Complex::norm_sqr).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::gaussian;
    use std::f64::consts::TAU;

    #[test]
    fn medians_are_exact_where_they_are_taken() {
        let values: Vec<f64> = (0..1000).map(|k| f64::from((k * 7919) % 1009)).collect();
        let found = running_median(&values, 40);
        assert_eq!(found.len(), values.len());
        for place in [0_usize, 20, 500, 980, 999] {
            let mut about = values[place.saturating_sub(40)..(place + 41).min(1000)].to_vec();
            about.sort_by(f64::total_cmp);
            assert!((found[place] - about[about.len() / 2]).abs() < 1e-12, "{place}");
        }
        assert_eq!(running_median(&[3.0], 12), [3.0]);
    }

    /// Two tones a thousand times above the noise, 37 Hz apart, would be all of the envelope; here they are as any other bins.
    #[test]
    fn tones_make_no_beat() {
        let rate = 8e3;
        let noise = gaussian(80_000, 3);
        let values = noise.iter().enumerate().map(|(k, noise)| {
            let t = k as f64 / rate;
            noise + 1e3 * ((TAU * 1000.0 * t).sin() + (TAU * 1037.0 * t).sin())
        });
        let series = TimeSeries::new(0.0, 1.0 / rate, "g", values.collect()).unwrap();
        let beat = |squared: &[f64], step_s: f64| {
            let mean = squared.iter().sum::<f64>() / squared.len() as f64;
            let sum: Complex<f64> = squared
                .iter()
                .enumerate()
                .map(|(k, e)| Complex::from_polar(e / mean, -TAU * 37.0 * k as f64 * step_s))
                .sum();
            2.0 * sum.norm() / squared.len() as f64
        };
        let white = WhiteSpectrum::of(&series).unwrap();
        let found = white.whitened.envelope([500.0, 1500.0]);
        // scatter of a line of noise: 2 / sqrt(10 s 1000 Hz)
        assert!(beat(&found.squared, found.step_s) < 0.06);
        // the series itself: all of it
        let own = crate::signal::squared(&crate::signal::envelope(&series).unwrap()).unwrap();
        assert!(beat(own.values(), own.step_s()) > 0.9);
    }

    /// A carrier in the band whose amplitude changes: the envelope is the change.
    #[test]
    fn a_band_has_the_modulation_of_what_is_in_it() {
        let rate = 16e3;
        let noise = gaussian(160_000, 5);
        let values =
            noise.iter().enumerate().map(|(k, noise)| noise * (1.0 + 0.8 * (TAU * 40.0 * k as f64 / rate).cos()));
        let series = TimeSeries::new(2.0, 1.0 / rate, "g", values.collect()).unwrap();
        let white = WhiteSpectrum::of(&series).unwrap();
        let found = white.whitened.envelope([2e3, 6e3]);
        assert!((found.start_s - 2.0).abs() < 1e-12);
        assert!((found.step_s * found.squared.len() as f64 - 10.0).abs() < 1e-9);
        let mean = found.squared.iter().sum::<f64>() / found.squared.len() as f64;
        let sum: Complex<f64> = found
            .squared
            .iter()
            .enumerate()
            .map(|(k, e)| Complex::from_polar(e / mean, -TAU * 40.0 * k as f64 * found.step_s))
            .sum();
        // (1 + m cos)^2: 2 m / (1 + m^2 / 2) = 1.21, less what the limit takes
        let depth = 2.0 * sum.norm() / found.squared.len() as f64;
        assert!((1.0..1.25).contains(&depth), "{depth}");
    }
}

#[cfg(test)]
mod raw_spectrum_tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_tone_has_the_square_of_its_amplitude_and_another_band_has_none() {
        // whole periods: 0.7 at 300 Hz and 5 at 100 Hz of 1000 samples in 1 s
        let values = (0..1000).map(|k| {
            let t = f64::from(k) / 1000.0;
            2.0 + 0.7 * (TAU * 300.0 * t).sin() + 5.0 * (TAU * 100.0 * t).cos()
        });
        let series = TimeSeries::new(0.0, 1e-3, "g", values.collect()).unwrap();
        let spectrum = RawSpectrum::of(&series).unwrap();
        for (band, expected) in [([250.0, 350.0], 0.49), ([50.0, 150.0], 25.0), ([400.0, 500.0], 0.0)] {
            let envelope = spectrum.envelope(band);
            for squared in envelope.squared {
                assert!((squared - expected).abs() < 1e-9, "{band:?}: {squared}");
            }
        }
    }

    #[test]
    fn an_envelope_is_that_of_the_hilbert_transform() {
        let values: Vec<f64> = (0..1024_i32)
            .map(|k| {
                let t = f64::from(k) / 1024.0;
                (1.0 + 0.6 * (TAU * 4.0 * t).cos()) * (TAU * 200.0 * t).sin()
            })
            .collect();
        let series = TimeSeries::new(0.0, 1.0 / 1024.0, "g", values).unwrap();
        let whole = crate::signal::envelope(&series).unwrap();
        let band = RawSpectrum::of(&series).unwrap().envelope([0.0, 512.0]);
        for (k, squared) in band.squared.iter().enumerate() {
            let place = k as f64 * band.step_s * 1024.0;
            let expected = (1.0 + 0.6 * (TAU * 4.0 * place / 1024.0).cos()).powi(2);
            assert!((squared - expected).abs() < 1e-9);
            if place.fract() == 0.0 {
                assert!((whole.values()[place as usize].powi(2) - squared).abs() < 1e-9);
            }
        }
    }
}
