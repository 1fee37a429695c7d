//! Amplitude spectrum of a stretch of signal, windowed and interpolated by zero-padding.

use serde::Serialize;

use super::fourier::{Forward, MOST_POINTS, fast_length};
use super::peaks::{Peak, peak_near};
use super::{SignalError, WindowFunction};
use crate::numerics::series::{TimeSeries, TimeWindow};

/// Bin width unless another is asked for, Hz: 1 % of a 25 Hz line before interpolation.
pub const DEFAULT_BIN_HZ: f64 = 0.25;

/// Least ratio of transform to signal length: with four points a natural bin the parabola through the three highest
/// finds a line to 1 % of a natural bin.
const LEAST_PADDING: usize = 4;

/// One-sided amplitude spectrum of a stretch of signal.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AmplitudeSpectrum {
    /// Bin frequencies m / (N step), m = 0 ..= N/2, Hz.
    pub frequency_hz: Vec<f64>,
    /// Amplitudes, same length, in `unit`: a sinusoid of amplitude A reads A.
    pub amplitude: Vec<f64>,
    /// Unit of the amplitudes.
    pub unit: String,
    /// Stretch of time that was transformed.
    pub window: TimeWindow,
    /// Window function over that stretch.
    pub window_function: WindowFunction,
    /// Transform length over signal length, N / n >= 4. It makes the bins finer, not the resolution.
    pub zero_padding: f64,
    /// Distance of the bins, 1 / (N step), Hz.
    pub bin_hz: f64,
    /// What the spectrum separates: main lobe of the window function over the length of the stretch, Hz.
    pub resolution_hz: f64,
}

/// Amplitude spectrum of the series with its mean removed,
///
/// A_m = (2 / sum w) |sum_k w_k (x_k - mean) exp(-2 pi i m k / N)|, half of that at zero and at half the rate,
///
/// padded with zeros to N >= 4 n points such that the bins are at most `widest_bin_hz` apart
/// ([`DEFAULT_BIN_HZ`]). Two lines closer than [`resolution_hz`](AmplitudeSpectrum::resolution_hz) are not separated, and
/// a line leaks [`WindowFunction::leakage`] of its amplitude to the others.
///
/// # Errors
/// [`SignalError`] if the bin width is not positive or asks for more than 2^28 points, and below two samples.
pub fn amplitude_spectrum(
    series: &TimeSeries,
    window_function: WindowFunction,
    widest_bin_hz: f64,
) -> Result<AmplitudeSpectrum, SignalError> {
    let samples = series.values().len();
    if samples < 2 {
        return Err(SignalError::too_short(samples, 2));
    }
    let wanted = (1.0 / (series.step_s() * widest_bin_hz)).ceil();
    if !(widest_bin_hz > 0.0 && wanted <= MOST_POINTS as f64) {
        let finest_hz = 1.0 / (series.step_s() * MOST_POINTS as f64);
        return Err(SignalError(format!(
            "bin width must be positive and at least {finest_hz} Hz for this sampling rate, found {widest_bin_hz} Hz"
        )));
    }
    let points = fast_length((wanted as usize).max(LEAST_PADDING * samples));
    let bin_hz = 1.0 / (points as f64 * series.step_s());
    let window = window_function.samples(samples);
    let sum: f64 = window.iter().sum();
    let mean = series.mean();
    let tapered = series.values().iter().zip(&window).map(|(v, w)| (v - mean) * w);
    let bins = Forward::new(points).transform(tapered)?;
    let last = bins.len() - 1;
    let amplitude = bins.iter().enumerate().map(|(m, bin)| {
        let sides = if m == 0 || m == last { 1.0 } else { 2.0 };
        sides * bin.norm() / sum
    });
    Ok(AmplitudeSpectrum {
        amplitude: amplitude.collect(),
        frequency_hz: (0..=points / 2).map(|m| m as f64 * bin_hz).collect(),
        unit: series.unit().to_owned(),
        window: series.span(),
        window_function,
        zero_padding: points as f64 / samples as f64,
        bin_hz,
        resolution_hz: window_function.main_lobe_bins() / series.duration_s(),
    })
}

impl AmplitudeSpectrum {
    /// The highest local maximum within `within` (relative, 0.03 for 3 %) of `frequency_hz`; see [`peak_near`].
    pub fn peak_near(&self, frequency_hz: f64, within: f64) -> Option<Peak> {
        peak_near(&self.frequency_hz, &self.amplitude, frequency_hz, within)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn tone(amplitude: f64, f: f64, samples: usize) -> TimeSeries {
        let values = (0..samples).map(|k| 40.0 + amplitude * (2.0 * PI * f * k as f64 * 1e-4 + 0.4).cos()).collect();
        TimeSeries::new(1.0, 1e-4, "m/s^2", values).expect("a valid series")
    }

    #[test]
    fn a_sinusoid_of_amplitude_a_reads_a() {
        // 1 s, lines on and between natural bins. The image at -f leaks 1 / (2 pi f T) at most: 1e-3 at 150 Hz.
        for f in [150.0, 333.3, 1234.56] {
            let spectrum = amplitude_spectrum(&tone(7.0, f, 10_000), WindowFunction::Boxcar, 0.25).expect("spectrum");
            let peak = spectrum.peak_near(f, 0.01).expect("a peak");
            assert!((peak.amplitude / 7.0 - 1.0).abs() < 1.1e-3, "{f}: {}", peak.amplitude);
            assert!((peak.frequency_hz - f).abs() < 0.01, "{f}: {}", peak.frequency_hz);
        }
    }

    #[test]
    fn bins_are_as_fine_as_asked_and_the_mean_is_gone() {
        let short = amplitude_spectrum(&tone(1.0, 100.0, 1000), WindowFunction::Boxcar, 0.25).expect("spectrum");
        assert!(short.frequency_hz[1] <= 0.25);
        assert!(short.zero_padding >= 40.0);
        let long = amplitude_spectrum(&tone(1.0, 100.0, 200_000), WindowFunction::Boxcar, 0.25).expect("spectrum");
        assert!(long.frequency_hz[1] <= 0.25 / 20.0);
        assert!(long.zero_padding >= 4.0);
        assert!(long.amplitude[0] < 1e-10);
        let last = long.frequency_hz.last().copied();
        assert!((last.expect("bins") - 5000.0).abs() < 1e-6);
        assert!((long.window.to - 21.0).abs() < 1e-9);
    }

    #[test]
    fn agrees_with_numpy() {
        // x_k = sin(0.9 k) + 0.02 k^2, k = 0 .. 11, step 1 s, resolution 1/64 Hz:
        // 2/12 * abs(numpy.fft.rfft(x - x.mean(), 64))[[1, 9, 32]], the last one halved; NumPy 2.4.6
        let values = (0..12).map(|k| (0.9 * f64::from(k)).sin() + 0.02 * f64::from(k * k)).collect();
        let series = TimeSeries::new(0.0, 1.0, "m", values).expect("a valid series");
        let spectrum = amplitude_spectrum(&series, WindowFunction::Boxcar, 1.0 / 64.0).expect("spectrum");
        for (bin, expected) in [(1, 0.46074397057919403), (9, 0.9148740075462658), (32, 0.0931662867193388)] {
            assert!((spectrum.amplitude[bin] - expected).abs() < 1e-14, "bin {bin}");
        }
    }

    #[test]
    fn a_window_agrees_with_scipy_and_states_what_it_separates() {
        // x_k = sin(0.9 k) + 0.02 k^2, k = 0 .. 11, step 1 s: w = scipy.signal.get_window("hann", 12),
        // 2 / w.sum() * abs(numpy.fft.rfft((x - x.mean()) * w, 64))[[1, 9]]
        let values = (0..12).map(|k| (0.9 * f64::from(k)).sin() + 0.02 * f64::from(k * k)).collect();
        let series = TimeSeries::new(0.0, 1.0, "m", values).expect("a valid series");
        let hann = WindowFunction::Hann;
        let spectrum = amplitude_spectrum(&series, hann, 1.0 / 64.0).expect("spectrum");
        for (bin, expected) in [(1, 0.5656296276571483), (9, 1.3530887128800948)] {
            assert!((spectrum.amplitude[bin] - expected).abs() < 1e-14, "bin {bin}");
        }
        assert!((spectrum.bin_hz - 1.0 / 64.0).abs() < 1e-15);
        assert!((spectrum.resolution_hz - 2.0 / 12.0).abs() < 1e-15);
    }

    #[test]
    fn padding_adds_no_resolution() {
        // lines in quadrature, 0.8 and 1.05 of 1 / T apart: one maximum, then two, however fine the bins
        let maxima = |apart: f64, bin_hz| {
            let line = |f: f64, t: f64| 2.0 * PI * f * t;
            let values = (0..1000).map(|k| {
                let t = f64::from(k) * 1e-3 - 0.5;
                line(100.0, t).cos() + line(100.0 + apart, t).sin()
            });
            let series = TimeSeries::new(0.0, 1e-3, "m", values.collect()).expect("a valid series");
            let spectrum = amplitude_spectrum(&series, WindowFunction::Boxcar, bin_hz).expect("spectrum");
            assert!((spectrum.resolution_hz - 1.0).abs() < 1e-12);
            let peaks = crate::signal::local_maxima(&spectrum.frequency_hz, &spectrum.amplitude);
            peaks.iter().filter(|p| p.amplitude > 0.5).count()
        };
        for bin_hz in [0.25, 0.01] {
            assert_eq!((maxima(0.8, bin_hz), maxima(1.05, bin_hz)), (1, 2));
        }
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |series: &TimeSeries, bin_hz| {
            amplitude_spectrum(series, WindowFunction::Boxcar, bin_hz).expect_err("must fail").to_string()
        };
        let series = TimeSeries::new(0.0, 0.25, "m", vec![1.0; 4]).expect("a valid series");
        assert_eq!(
            message(&series, 0.0),
            "bin width must be positive and at least 0.000000014901161193847656 Hz for this \
             sampling rate, found 0 Hz"
        );
        assert!(message(&series, 1e-9).starts_with("bin width"));
        assert!(message(&series, f64::NAN).starts_with("bin width"));
        let one = TimeSeries::new(0.0, 0.25, "m", vec![1.0]).expect("a valid series");
        assert_eq!(message(&one, 0.25), "series has 1 samples, the filter or transform needs at least 2");
    }
}
