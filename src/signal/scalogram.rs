//! Amplitude over time and frequency: the continuous wavelet transform.
//!
//! Frequencies at which a transform over scales is taken.
//!
//! The analytic Morlet wavelet, calibrated to read amplitudes at exact frequencies.
//!
//! The ridge of a scalogram: the frequency of the strongest line over time.

use super::fourier::{MOST_POINTS, fast_length, forward};
use super::{Peak, SignalError};
use crate::numerics::Brief;
use crate::numerics::series::TimeSeries;
use rayon::prelude::*;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use serde::Serialize;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

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

/// Most frequencies offered.
const MOST: usize = 1 << 16;

/// Frequencies from the lowest to the highest, both included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrequencyAxis {
    /// Equal ratios: as a wavelet's bandwidth grows with its frequency, each is equally well resolved.
    Logarithmic {
        /// Lowest frequency, Hz.
        from_hz: f64,
        /// Highest frequency, Hz.
        to_hz: f64,
        /// Number of frequencies, at least 2.
        count: usize,
    },
    /// Equal distances.
    Linear {
        /// Lowest frequency, Hz.
        from_hz: f64,
        /// Highest frequency, Hz.
        to_hz: f64,
        /// Number of frequencies, at least 2.
        count: usize,
    },
}

impl FrequencyAxis {
    /// The frequencies, Hz, rising, between `lowest_hz` and `highest_hz` (the latter excluded).
    ///
    /// # Errors
    /// [`SignalError`] unless lowest <= from < to < highest and there are 2 to 65536.
    pub fn frequencies_hz(&self, lowest_hz: f64, highest_hz: f64) -> Result<Vec<f64>, SignalError> {
        let (Self::Logarithmic { from_hz, to_hz, count } | Self::Linear { from_hz, to_hz, count }) = *self;
        // a millionth for what is typed in decimal
        let is_inside = from_hz >= lowest_hz * (1.0 - 1e-6) && to_hz < highest_hz;
        if !(from_hz > 0.0 && from_hz < to_hz && is_inside && (2..=MOST).contains(&count)) {
            let [lowest_hz, highest_hz, from_hz, to_hz] = [lowest_hz, highest_hz, from_hz, to_hz].map(Brief);
            return Err(SignalError(format!(
                "frequencies must satisfy {lowest_hz} Hz <= from < to < {highest_hz} Hz and be 2 to {MOST}, found {count} \
                 from {from_hz} Hz to {to_hz} Hz"
            )));
        }
        let part = |k: usize| k as f64 / (count - 1) as f64;
        let frequency = |k: usize| match self {
            _ if k + 1 == count => to_hz,
            Self::Logarithmic { .. } => from_hz * (to_hz / from_hz).powf(part(k)),
            Self::Linear { .. } => from_hz + (to_hz - from_hz) * part(k),
        };
        Ok((0..count).map(frequency).collect())
    }
}

/// Distance from a Gaussian's centre, in standard deviations, beyond which it is below 1e-16: sqrt(2 ln 1e16).
pub(super) const REACH: f64 = 8.6;

/// Morlet wavelet of w0 = `cycles` with its mean removed, given by its response to a tone. With nu = f' / f the tone's
/// frequency over the wavelet's,
///
/// Psi(nu) = 2 g(w_p nu) / g(w_p),  g(w) = exp(-(w - w0)^2 / 2) - exp(-(w0^2 + w^2) / 2) for w > 0, else 0,
///
/// and w_p = w0 / (1 - exp(-w0 w_p)) where g is largest: the response is largest at the very frequency that names the
/// wavelet, and 2 there, so that A cos(2 pi f t) gives magnitude A. (With w_p = w0, as often seen, or with another scale's
/// frequency a tone is read off its place, more so the fewer the cycles.) The envelope is a Gaussian with a standard
/// deviation of w_p / (2 pi f) seconds, the response one of f w0 / w_p^2 hertz, about f / cycles.
///
/// Source: I. Daubechies, "Ten Lectures on Wavelets", SIAM, 1992, chapter 3; C. Torrence and G. P. Compo,
/// "A practical guide to wavelet analysis", Bull. Am. Meteorological Society 79 (1998) 61-78 (analytic form, cone of
/// influence).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Morlet {
    cycles: f64,
    peak: f64,
    scale: f64,
}

impl Morlet {
    /// Wavelet of so many cycles w0 >= 2.
    pub(super) fn new(cycles: f64) -> Self {
        // contracts by w0^2 exp(-w0^2), 0.07 at two cycles
        let peak = (0..20).fold(cycles, |w, _| cycles / (1.0 - (-cycles * w).exp()));
        let mut wavelet = Self { cycles, peak, scale: 1.0 };
        wavelet.scale = 2.0 / wavelet.shape(peak);
        wavelet
    }

    fn shape(&self, w: f64) -> f64 {
        let from_centre = w - self.cycles;
        (-0.5 * from_centre * from_centre).exp() * -(-self.cycles * w).exp_m1()
    }

    /// Psi at a tone's frequency over the wavelet's, > 0.
    pub(super) fn response(&self, ratio: f64) -> f64 {
        self.scale * self.shape(self.peak * ratio)
    }

    /// Ratios between which the response is above 1e-16 of its peak.
    pub(super) fn band(&self) -> (f64, f64) {
        let edge = |deviations: f64| (self.cycles + deviations) / self.peak;
        (edge(-REACH).max(0.0), edge(REACH))
    }

    /// Standard deviation of the envelope at a frequency, s.
    pub(super) fn deviation_s(&self, frequency_hz: f64) -> f64 {
        self.peak / (2.0 * PI * frequency_hz)
    }
}

impl Scalogram {
    /// For each instant the highest local maximum over frequency with its neighbours within `from_hz` to `to_hz`, or `None`
    /// where there is none (the amplitude rises towards one of the limits). Between the frequencies of the axis by the
    /// parabola of log amplitude over 1 / f, which is exact for a tone but for the wavelet's small mean correction.
    pub fn ridge(&self, from_hz: f64, to_hz: f64) -> Vec<Option<Peak>> {
        let first = self.frequency_hz.partition_point(|f| *f < from_hz);
        let end = self.frequency_hz.partition_point(|f| *f <= to_hz);
        let rows: Vec<&[f64]> = (first..end).map(|index| self.row(index)).collect();
        let hz = self.frequency_hz.get(first..end).unwrap_or_default();
        let at = |instant: usize| {
            let is_top = |k: &usize| {
                let middle = rows[*k][instant];
                rows[k - 1][instant] < middle && middle >= rows[k + 1][instant]
            };
            let last = rows.len().saturating_sub(1);
            let highest = (1..last).filter(is_top).max_by(|a, b| rows[*a][instant].total_cmp(&rows[*b][instant]))?;
            let around = |k: usize| (1.0 / hz[k], rows[k][instant]);
            Some(top(around(highest - 1), around(highest), around(highest + 1)))
        };
        (0..self.time_s.len()).map(at).collect()
    }
}

/// Vertex of the parabola through ln a at three places u = 1 / f; the middle point where an amplitude is zero.
fn top(left: (f64, f64), middle: (f64, f64), right: (f64, f64)) -> Peak {
    let rise = |a: (f64, f64), b: (f64, f64)| (b.1 / a.1).ln() / (b.0 - a.0);
    let (before, after) = (rise(left, middle), rise(middle, right));
    let curvature = (after - before) / (right.0 - left.0);
    // slope at u is before + curvature (2 u - u_left - u_middle)
    let shift = 0.5 * (left.0 + middle.0 - before / curvature) - middle.0;
    if !shift.is_finite() {
        return Peak { frequency_hz: 1.0 / middle.0, amplitude: middle.1 };
    }
    Peak { frequency_hz: 1.0 / (middle.0 + shift), amplitude: middle.1 * (-curvature * shift * shift).exp() }
}

#[cfg(test)]
#[path = "scalogram_tests.rs"]
mod tests;

#[cfg(test)]
mod frequency_axis_tests {
    use super::*;

    #[test]
    fn frequencies_go_from_end_to_end() {
        let (from_hz, to_hz, count) = (10.0, 1000.0, 5);
        let log = FrequencyAxis::Logarithmic { from_hz, to_hz, count };
        let linear = FrequencyAxis::Linear { from_hz, to_hz, count };
        let close = |axis: FrequencyAxis, expected: [f64; 5]| {
            let found = axis.frequencies_hz(10.0, 1001.0).expect("a valid axis");
            found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-14)
        };
        assert!(close(log, [10.0, 1e3_f64.sqrt(), 100.0, 1e5_f64.sqrt(), 1000.0]));
        assert!(close(linear, [10.0, 257.5, 505.0, 752.5, 1000.0]));
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |from_hz, to_hz, count| {
            let axis = FrequencyAxis::Linear { from_hz, to_hz, count };
            axis.frequencies_hz(2.0, 50.0).expect_err("must fail").to_string()
        };
        let begin = "frequencies must satisfy 2 Hz <= from < to < 50 Hz and be 2 to 65536, found";
        assert_eq!(message(1.0, 10.0, 3), format!("{begin} 3 from 1 Hz to 10 Hz"));
        assert_eq!(message(3.0, 50.0, 3), format!("{begin} 3 from 3 Hz to 50 Hz"));
        assert_eq!(message(3.0, 3.0, 3), format!("{begin} 3 from 3 Hz to 3 Hz"));
        assert_eq!(message(3.0, 4.0, 1), format!("{begin} 1 from 3 Hz to 4 Hz"));
        assert!(message(3.0, 4.0, 65_537).contains("found 65537"));
        assert_eq!(message(f64::NAN, 4.0, 2), format!("{begin} 2 from NaN Hz to 4 Hz"));
    }
}

#[cfg(test)]
mod morlet_tests {
    use super::*;

    #[test]
    fn the_response_is_two_and_largest_at_its_own_frequency() {
        for cycles in [2.0, 3.0, 5.0, 6.0, 20.0, 200.0] {
            let wavelet = Morlet::new(cycles);
            assert!((wavelet.response(1.0) - 2.0).abs() < 1e-14);
            // curvature is cycles^2: 1e-4 beside the peak it is lower by (1e-4 cycles)^2, the same to both sides
            let (below, above) = (wavelet.response(1.0 - 1e-4), wavelet.response(1.0 + 1e-4));
            assert!(below < 2.0 && above < 2.0, "{cycles}");
            let asymmetry = (below - above).abs() / (4.0 - below - above);
            assert!(asymmetry < 1e-3, "{cycles}: {asymmetry}");
        }
    }

    #[test]
    fn the_response_vanishes_at_zero_and_outside_its_band() {
        for cycles in [2.0, 6.0, 40.0] {
            let wavelet = Morlet::new(cycles);
            let (low, high) = wavelet.band();
            assert!(wavelet.response(high) < 2.0 * 1.1e-16, "{cycles}");
            assert!(wavelet.response(low) < 2.0 * 1.1e-16, "{cycles}");
            assert!(wavelet.response(high * (1.0 - 0.3 / (cycles + 8.6))) > 2e-16);
        }
    }
}

#[cfg(test)]
mod ridge_tests {
    use super::*;

    #[test]
    fn a_gaussian_over_period_is_found_exactly() {
        let frequency_hz = vec![90.0, 96.0, 101.0, 107.0, 120.0, 140.0];
        let value = |f: &f64| 3.0 * (-40.0 * (100.0 / f - 1.0_f64).powi(2)).exp();
        let scalogram = Scalogram {
            time_s: vec![0.0],
            amplitude: frequency_hz.iter().map(value).collect(),
            cone_s: vec![0.0; 6],
            frequency_hz,
            unit: "m".into(),
            cycles: 6.0,
        };
        let found = scalogram.ridge(80.0, 150.0)[0].expect("a maximum");
        assert!((found.frequency_hz - 100.0).abs() < 1e-9, "{found:?}");
        assert!((found.amplitude - 3.0).abs() < 1e-12, "{found:?}");
        assert!(scalogram.ridge(95.0, 110.0)[0].is_some());
        // rises to the edge, or too few frequencies
        assert_eq!(scalogram.ridge(105.0, 150.0), [None]);
        assert_eq!(scalogram.ridge(99.0, 108.0), [None]);
        assert_eq!(scalogram.ridge(200.0, 100.0), [None]);
    }

    #[test]
    fn zeros_do_no_harm() {
        let peak = top((3.0, 0.0), (2.0, 1.0), (1.0, 0.0));
        assert!((peak.frequency_hz - 0.5).abs() < 1e-15 && (peak.amplitude - 1.0).abs() < 1e-15);
    }
}
