//! Amplitude over time and frequency: the continuous wavelet transform.

use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;
use rustfft::{Fft, FftPlanner, num_complex::Complex};
use serde::Serialize;

use super::fourier::{MOST_POINTS, fast_length, forward};
use super::morlet::{Morlet, REACH};
use super::{FrequencyAxis, SignalError};
use crate::numerics::series::TimeSeries;

/// Fewest and most cycles of a wavelet.
const CYCLES: (f64, f64) = (2.0, 1000.0);

/// Most zeros after the signal, over its samples: a wavelet that reaches round them has all of the signal in its cone.
const MOST_PADDING: usize = 8;

/// A wavelet transform: what to take it at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveletTransform {
    /// Frequencies.
    pub frequencies: FrequencyAxis,
    /// Cycles w0 of the wavelet, 2 to 1000: its Gaussian envelope has a standard deviation of w0 / (2 pi f) seconds, its
    /// response one of f / w0 hertz. 6 is usual; more separate frequencies, fewer separate instants.
    pub cycles: f64,
    /// Samples of the signal to one of the scalogram, >= 1.
    pub decimation: usize,
}

/// Amplitude over time and frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scalogram {
    /// Instants, s.
    pub time_s: Vec<f64>,
    /// Frequencies, rising, Hz.
    pub frequency_hz: Vec<f64>,
    /// Amplitudes, a row of all instants for each frequency, in `unit`: A cos(2 pi f t) reads A at f.
    pub amplitude: Vec<f64>,
    /// Unit of the amplitudes, that of the signal.
    pub unit: String,
    /// Cone of influence for each frequency: nearer than this to either end of the signal, s, an amplitude depends on the
    /// zeros beyond. sqrt(2) standard deviations of the wavelet (Torrence and Compo), and two steps where decimated.
    pub cone_s: Vec<f64>,
    /// Cycles of the wavelet.
    pub cycles: f64,
}

impl Scalogram {
    /// Amplitudes at frequency number `index` over all instants; empty if there is no such frequency.
    pub fn row(&self, index: usize) -> &[f64] {
        let instants = self.time_s.len();
        let from = index.saturating_mul(instants);
        let to = from.saturating_add(instants);
        self.amplitude.get(from..to).unwrap_or_default()
    }

    /// The instants from `from_s` to `to_s` alone, s.
    pub fn within(mut self, from_s: f64, to_s: f64) -> Self {
        let first = self.time_s.partition_point(|t| *t < from_s);
        let end = self.time_s.partition_point(|t| *t <= to_s).max(first);
        let rows = self.amplitude.chunks(self.time_s.len().max(1));
        self.amplitude = rows.flat_map(|row| &row[first..end]).copied().collect();
        self.time_s = self.time_s[first..end].to_vec();
        self
    }
}

/// Where one wavelet lies in the transform of the signal, and the transform back of what it lets through.
struct Band {
    wavelet: Morlet,
    /// The wavelet's frequency in bins, not whole.
    centre: f64,
    bins: Range<usize>,
    /// 1 / N.
    scale: f64,
    back: Arc<dyn Fft<f64>>,
}

impl WaveletTransform {
    /// Scalogram of a series, its mean removed, zeros beyond its ends: the magnitude of
    ///
    /// W(t, f) = (1 / N) sum_(k > 0) X_k Psi(f_k / f) exp(2 pi i f_k t),
    ///
    /// X the transform of the series, Psi the response of the analytic Morlet wavelet, 2 at its own frequency, cut where it
    /// is below 1e-16. Decimated by D, a value is the root of the power |W|^2 smoothed over time by a Gaussian with a
    /// standard deviation of one step (exactly: of the band-limited power), so that what folds is below 0.7 % at half
    /// the new rate and below 1e-4 from 0.7 of it on; energy is kept. In parallel over frequencies; the same result for
    /// any number of threads.
    ///
    /// # Errors
    /// [`SignalError`] for cycles out of range, frequencies not between 1 / duration and half the sampling rate, a
    /// decimation that is zero or leaves fewer than two instants, and more than 2^28 amplitudes.
    pub fn scalogram(&self, series: &TimeSeries) -> Result<Scalogram, SignalError> {
        let (fewest, most) = CYCLES;
        if !(self.cycles >= fewest && self.cycles <= most) {
            return Err(SignalError(format!("a wavelet must have {fewest} to {most} cycles, found {}", self.cycles)));
        }
        let samples = series.values().len();
        let ratio = self.decimation;
        if ratio == 0 || ratio > samples / 2 {
            return Err(SignalError(format!(
                "decimation of {samples} samples must be by 1 to half as many, found {ratio}"
            )));
        }
        let nyquist_hz = 0.5 * series.rate_hz();
        let frequency_hz = self.frequencies.frequencies_hz(1.0 / series.duration_s(), nyquist_hz)?;
        let wavelet = Morlet::new(self.cycles);
        let longest = REACH * wavelet.deviation_s(frequency_hz[0]) / series.step_s();
        let padding = (longest.ceil() as usize).min(MOST_PADDING * samples);
        let outputs = fast_length((samples + padding).div_ceil(ratio));
        let points = outputs * ratio;
        let instants = samples.div_ceil(ratio);
        let largest = points.max(instants.saturating_mul(frequency_hz.len()));
        if largest > MOST_POINTS {
            return Err(SignalError::too_long(largest, MOST_POINTS));
        }
        let mean = series.mean();
        let centred: Vec<f64> = series.values().iter().map(|v| v - mean).collect();
        let spectrum = forward(&centred, points)?;
        let mut planner = FftPlanner::new();
        let bands: Vec<Band> = frequency_hz
            .iter()
            .map(|hz| self.band(wavelet, hz * points as f64 * series.step_s(), points, &mut planner))
            .collect();
        let to_outputs = planner.plan_fft_inverse(outputs);
        let rows = bands.par_iter().map(|band| {
            let mut row: Vec<f64> = match ratio {
                1 => coefficients(band, &spectrum).iter().map(|w| w.norm_sqr().sqrt()).collect(),
                _ => decimated(band, &spectrum, to_outputs.as_ref()),
            };
            row.truncate(instants);
            row
        });
        let amplitude = rows.collect::<Vec<_>>().concat();
        let step_s = series.step_s() * ratio as f64;
        let smoothing_s = if ratio == 1 { 0.0 } else { 2.0 * step_s };
        let cone = |hz: &f64| 2_f64.sqrt() * wavelet.deviation_s(*hz) + smoothing_s;
        Ok(Scalogram {
            time_s: (0..instants).map(|k| series.time_s(k * ratio)).collect(),
            cone_s: frequency_hz.iter().map(cone).collect(),
            frequency_hz,
            amplitude,
            unit: series.unit().to_owned(),
            cycles: self.cycles,
        })
    }

    /// The wavelet at bin number `centre` (not whole) of a transform over so many points.
    fn band(&self, wavelet: Morlet, centre: f64, points: usize, planner: &mut FftPlanner<f64>) -> Band {
        let (low, high) = wavelet.band();
        let first = ((low * centre).ceil() as usize).max(1);
        let last = ((high * centre).floor() as usize).min(points / 2);
        let bins = first..(last + 1).max(first);
        let length = if self.decimation == 1 {
            points
        } else {
            // the power of K bins has 2 K - 1; lengths of few kinds, so that plans are shared
            let needed = 2 * bins.len().max(1);
            let power = needed.next_power_of_two();
            if 3 * power / 4 >= needed { 3 * power / 4 } else { power }
        };
        Band { wavelet, centre, bins, scale: 1.0 / points as f64, back: planner.plan_fft_inverse(length) }
    }
}

/// W at `back.len()` instants over the whole padded length, its carrier at the band's first bin: the magnitude is the
/// same.
fn coefficients(band: &Band, spectrum: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let mut values = vec![Complex::ZERO; band.back.len()];
    let inside = spectrum.get(band.bins.clone()).unwrap_or_default();
    for ((value, x), bin) in values.iter_mut().zip(inside).zip(band.bins.clone()) {
        *value = x * (band.scale * band.wavelet.response(bin as f64 / band.centre));
    }
    band.back.process(&mut values);
    values
}

/// Roots of the smoothed power at as many instants as `to_outputs` has points.
fn decimated(band: &Band, spectrum: &[Complex<f64>], to_outputs: &dyn Fft<f64>) -> Vec<f64> {
    let mut power = coefficients(band, spectrum);
    for w in &mut power {
        *w = Complex::new(w.norm_sqr(), 0.0);
    }
    let points = power.len();
    // forward by the plan for backward: the transform of a real signal, conjugate
    band.back.process(&mut power);
    let outputs = to_outputs.len();
    let mut smooth = vec![Complex::ZERO; outputs];
    for (bin, value) in power.iter().take(band.bins.len()).enumerate() {
        let part = bin as f64 / outputs as f64;
        let gain = (-2.0 * PI * PI * part * part).exp() / points as f64;
        let place = bin % outputs;
        smooth[place] += value.conj() * gain;
        if bin > 0 {
            smooth[(outputs - place) % outputs] += value * gain;
        }
    }
    to_outputs.process(&mut smooth);
    smooth.iter().map(|p| p.re.max(0.0).sqrt()).collect()
}

#[cfg(test)]
#[path = "scalogram_tests.rs"]
mod tests;
