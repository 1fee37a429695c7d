//! Envelope of a signal: magnitude of its analytic signal.
//!
//! From a vibration signal to the spectrum of its envelope, over one window.

use super::SignalError;
use super::butterworth::{Butterworth, DEFAULT_ORDER, FilterBand};
use super::fourier::{WindowFunction, forward, inverse};
use super::spectrum::{AmplitudeSpectrum, DEFAULT_BIN_HZ, amplitude_spectrum};
use crate::numerics::series::TimeSeries;
use realfft::num_complex::Complex;
use serde::Serialize;
use std::ops::Deref;

/// Envelope e(t) = |x + i H x|, H the Hilbert transform, by Fourier transform over the whole series: the transform of
/// H x is -i sign(f) X(f). Same instants and unit as the series; e >= |x|. Equal to
/// `abs(scipy.signal.hilbert(x))`.
///
/// The series is taken as periodic: where its end does not meet its start the envelope is wrong over a few periods
/// of the signal there. Take the envelope of a longer stretch and cut the window out of it
/// ([`EnvelopeAnalysis`](super::EnvelopeAnalysis) does).
///
/// # Errors
/// [`SignalError`], which no valid series causes.
pub fn envelope(series: &TimeSeries) -> Result<TimeSeries, SignalError> {
    let x = series.values();
    let envelope = x.iter().zip(quadrature(x)?).map(|(x, h)| x.hypot(h));
    Ok(series.with_values(envelope.collect())?)
}

/// The square of an envelope, in the square of its unit.
///
/// # Errors
/// Values whose squares are not finite.
pub fn squared(envelope: &TimeSeries) -> Result<TimeSeries, SignalError> {
    let unit = match envelope.unit() {
        "" => String::new(),
        unit => format!("({unit})^2"),
    };
    let values = envelope.values().iter().map(|value| value * value);
    let (start, step) = (envelope.start_s(), envelope.step_s());
    Ok(TimeSeries::new(start, step, unit, values.collect())?)
}

/// Hilbert transform H x of values taken as periodic.
pub(super) fn quadrature(x: &[f64]) -> Result<Vec<f64>, SignalError> {
    let points = x.len();
    let mut bins = forward(x, points)?;
    for bin in &mut bins {
        *bin *= Complex::new(0.0, -1.0);
    }
    // At zero and half the rate the Hilbert transform of a real signal vanishes; `inverse` drops what is imaginary.
    inverse(bins, points)
}

/// Corner of the high-pass unless one is asked for, Hz: Tadina & Boltezar 2011, section 5.
const HIGH_PASS_HZ: f64 = 5e3;
/// The same as a part of the sampling rate, for slow recorders.
const HIGH_PASS_PART: f64 = 0.125;

/// Corner of the high-pass before an envelope unless another is asked for, Hz: 5 kHz, or an eighth of the sampling rate (Hz) if
/// that is lower.
pub(crate) fn usual_high_pass_hz(rate_hz: f64) -> f64 {
    HIGH_PASS_HZ.min(HIGH_PASS_PART * rate_hz)
}

/// Amplitude spectrum of the mean-removed envelope of a window of signal: an envelope 1 + A cos reads A.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnvelopeSpectrum {
    /// The spectrum, in the signal's unit.
    #[serde(flatten)]
    pub spectrum: AmplitudeSpectrum,
    /// Cut-off of the high-pass before the envelope, Hz; `None`: not filtered.
    pub high_pass_hz: Option<f64>,
}

impl Deref for EnvelopeSpectrum {
    type Target = AmplitudeSpectrum;

    fn deref(&self) -> &AmplitudeSpectrum {
        &self.spectrum
    }
}

/// Spectrum of an envelope, with its mean removed, in bins of at most `widest_bin_hz`; `high_pass_hz` is only
/// written down.
///
/// # Errors
/// As [`amplitude_spectrum`].
pub fn envelope_spectrum(
    envelope: &TimeSeries,
    high_pass_hz: Option<f64>,
    window_function: WindowFunction,
    widest_bin_hz: f64,
) -> Result<EnvelopeSpectrum, SignalError> {
    let spectrum = amplitude_spectrum(envelope, window_function, widest_bin_hz)?;
    Ok(EnvelopeSpectrum { spectrum, high_pass_hz })
}

/// Settings of an envelope analysis: high-pass, envelope, window, spectrum. Filter and envelope run over the whole
/// series and the window is cut from the envelope, so that no edge effect lies inside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnvelopeAnalysis {
    /// Cut-off of the high-pass, Hz; `None`: the signal as it is.
    pub high_pass_hz: Option<f64>,
    /// Order of the high-pass, 1 to 12.
    pub order: usize,
    /// Window function of the spectrum.
    pub window_function: WindowFunction,
    /// Largest bin width of the spectrum, Hz; zero padding makes the bins that fine, the resolution stays.
    pub widest_bin_hz: f64,
}

impl Default for EnvelopeAnalysis {
    /// 5 kHz, as in Tadina & Boltezar 2011, section 5; fourth order; boxcar; bins of 0.25 Hz.
    fn default() -> Self {
        Self {
            high_pass_hz: Some(HIGH_PASS_HZ),
            order: DEFAULT_ORDER,
            window_function: WindowFunction::Boxcar,
            widest_bin_hz: DEFAULT_BIN_HZ,
        }
    }
}

impl EnvelopeAnalysis {
    /// Envelope of the high-passed series, over all of it.
    ///
    /// # Errors
    /// As [`Butterworth::zero_phase`] and [`envelope`].
    pub fn envelope(&self, series: &TimeSeries) -> Result<TimeSeries, SignalError> {
        match self.high_pass_hz {
            Some(cut_off_hz) => {
                let filter = Butterworth { band: FilterBand::HighPass { cut_off_hz }, order: self.order };
                envelope(&filter.zero_phase(series)?)
            }
            None => envelope(series),
        }
    }

    /// Spectrum of `from_s` <= t < `to_s` of an envelope that [`envelope`](Self::envelope) gave: for several windows of
    /// one series.
    ///
    /// # Errors
    /// As [`TimeSeries::window`] and [`amplitude_spectrum`].
    pub fn window_of(&self, envelope: &TimeSeries, from_s: f64, to_s: f64) -> Result<EnvelopeSpectrum, SignalError> {
        let window = envelope.window(from_s, to_s)?;
        envelope_spectrum(&window, self.high_pass_hz, self.window_function, self.widest_bin_hz)
    }

    /// Envelope spectrum of `from_s` <= t < `to_s` of a signal.
    ///
    /// # Errors
    /// As [`envelope`](Self::envelope) and [`window_of`](Self::window_of).
    pub fn spectrum(&self, series: &TimeSeries, from_s: f64, to_s: f64) -> Result<EnvelopeSpectrum, SignalError> {
        self.window_of(&self.envelope(series)?, from_s, to_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::{items, load, numbers, worst};
    use std::f64::consts::PI;

    fn series(values: Vec<f64>) -> TimeSeries {
        TimeSeries::new(0.0, 1e-5, "m/s^2", values).expect("a valid series")
    }

    #[test]
    fn envelope_of_a_modulated_carrier_is_the_modulation() {
        // Periodic in the window: exact.
        let modulation = |k: f64| 1.0 + 0.6 * (2.0 * PI * 5.0 * k / 2000.0).cos();
        let x = series(
            (0..2000).map(|k| modulation(f64::from(k)) * (2.0 * PI * 300.0 * f64::from(k) / 2000.0).sin()).collect(),
        );
        for (k, e) in envelope(&x).expect("envelope").values().iter().enumerate() {
            assert!((e - modulation(k as f64)).abs() < 1e-12, "sample {k}");
        }
    }

    #[test]
    fn agrees_with_scipy_for_even_and_odd_lengths() {
        for case in items(&load("envelope")["cases"]) {
            let found = envelope(&series(numbers(&case["x"]))).expect("envelope");
            // rounding of two transforms of 240 points
            assert!(worst(found.values(), &numbers(&case["envelope"])) < 1e-13);
        }
    }
}

#[cfg(test)]
mod envelope_analysis_tests {
    use super::*;
    use crate::signal::{NamedLine, PeakSearch, envelope_peaks};
    use std::f64::consts::PI;

    /// A ring of 8.2 kHz struck 55 times a second (1 % damping) over a strong 300 Hz vibration, 0.6 s at 100 kHz.
    fn dented() -> TimeSeries {
        let decay = 0.01 * 2.0 * PI * 8200.0;
        let values = (0..60_000).map(|k| {
            let t = f64::from(k) * 1e-5;
            let since = t - (t * 55.0).floor() / 55.0;
            30.0 * (2.0 * PI * 300.0 * t).sin() + 100.0 * (-decay * since).exp() * (2.0 * PI * 8200.0 * since).sin()
        });
        TimeSeries::new(2.0, 1e-5, "m/s^2", values.collect()).expect("a valid series")
    }

    #[test]
    fn bursts_at_55_hz_are_diagnosed() {
        let analysis = EnvelopeAnalysis::default();
        let spectrum = analysis.spectrum(&dented(), 2.2, 2.4).expect("spectrum");
        assert_eq!(spectrum.high_pass_hz, Some(5e3));
        assert!(spectrum.frequency_hz[1] <= 0.25);
        assert!((spectrum.window.from - 2.2).abs() < 1e-9);
        let lines = [("shaft", 21.0, 3), ("outer", 55.0, 5), ("inner", 95.0, 3)]
            .map(|(name, f, n)| NamedLine::new(name, f, n).expect("a valid line"));
        let search = PeakSearch { count: 3, ..PeakSearch::default() };
        let peaks = envelope_peaks(&spectrum, &lines, &search);
        for (k, peak) in peaks.iter().enumerate() {
            let line = peak.line.as_ref().expect("lines were given");
            assert_eq!((line.nearest.as_str(), line.harmonic), ("outer", k as u32 + 1));
            // Eleven periods: leakage of the neighbours and of the images shifts a peak a little.
            assert!(line.deviation.abs() < 5e-3, "{peak:?}");
        }
        assert!(spectrum.peak_near(55.0, 0.03).is_some());
    }

    #[test]
    fn json_states_bins_and_resolution() {
        let analysis = EnvelopeAnalysis { window_function: WindowFunction::FlatTop, ..EnvelopeAnalysis::default() };
        let spectrum = analysis.spectrum(&dented(), 2.2, 2.4).expect("spectrum");
        let json = serde_json::to_value(&spectrum).expect("serialises");
        assert_eq!(json["window_function"], "flat-top");
        let number = |key: &str| json[key].as_f64().expect("a number");
        // five bins of 1 / 0.2 s, whatever the padding
        assert!((number("resolution_hz") - 25.0).abs() < 1e-9);
        assert!((number("bin_hz") * number("zero_padding") - 5.0).abs() < 1e-9);
        assert!(number("bin_hz") <= 0.25);
    }

    #[test]
    fn without_the_high_pass_the_slow_vibration_rules() {
        // Mean envelope: 30 of the slow vibration without the filter; 100 x 55 / (0.01 x 2 pi x 8200) = 10.7 with it.
        let mean = |high_pass_hz| {
            let analysis = EnvelopeAnalysis { high_pass_hz, ..EnvelopeAnalysis::default() };
            analysis.envelope(&dented()).expect("envelope").mean()
        };
        assert!(mean(None) > 29.0);
        assert!((mean(Some(5e3)) - 10.7).abs() < 1.0, "{}", mean(Some(5e3)));
    }

    #[test]
    fn one_envelope_serves_many_windows() {
        let analysis = EnvelopeAnalysis::default();
        let envelope = analysis.envelope(&dented()).expect("envelope");
        let first = analysis.window_of(&envelope, 2.1, 2.2).expect("spectrum");
        assert_eq!(first, analysis.spectrum(&dented(), 2.1, 2.2).expect("spectrum"));
        let outside = analysis.window_of(&envelope, 2.5, 2.9).expect_err("beyond the end");
        assert_eq!(outside.to_string(), "window 2.5 s to 2.9 s is not inside the series, which covers 2 s to 2.6 s");
    }
}
