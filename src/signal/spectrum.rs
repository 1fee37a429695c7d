//! Amplitude spectrum of a stretch of signal, interpolated by zero-padding.

use serde::Serialize;

use super::SignalError;
use super::fourier::{MOST_POINTS, fast_length, forward};
use super::peaks::{Peak, peak_near};
use crate::series::{TimeSeries, TimeWindow};

/// Bin width unless another is asked for, Hz: 1 % of a 25 Hz line before interpolation.
pub const DEFAULT_RESOLUTION_HZ: f64 = 0.25;

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
    /// Transform length over signal length, N / n >= 4. The bins are that much finer than what the window can
    /// separate, 1 / (to - from).
    pub zero_padding: f64,
}

/// Amplitude spectrum of the series with its mean removed,
///
/// A_m = (2 / n) |sum_k (x_k - mean) exp(-2 pi i m k / N)|, half of that at zero and at half the rate,
///
/// padded with zeros to N >= 4 n points such that the bins are at most `resolution_hz` apart
/// ([`DEFAULT_RESOLUTION_HZ`]). No taper: two lines closer than 1 / duration are not separated, and a line leaks
/// sin(pi d T) / (pi d T) of its amplitude to distance d.
///
/// # Errors
/// [`SignalError::Resolution`] if it is not positive or asks for more than 2^28 points, [`SignalError::TooShort`]
/// below two samples.
pub fn amplitude_spectrum(
    series: &TimeSeries,
    resolution_hz: f64,
) -> Result<AmplitudeSpectrum, SignalError> {
    let samples = series.values().len();
    if samples < 2 {
        return Err(SignalError::TooShort { samples, needed: 2 });
    }
    let wanted = (1.0 / (series.step_s() * resolution_hz)).ceil();
    if !(resolution_hz > 0.0 && wanted <= MOST_POINTS as f64) {
        return Err(SignalError::Resolution {
            resolution_hz,
            finest_hz: 1.0 / (series.step_s() * MOST_POINTS as f64),
        });
    }
    let points = fast_length((wanted as usize).max(LEAST_PADDING * samples));
    let mean = series.mean();
    let centred: Vec<f64> = series.values().iter().map(|v| v - mean).collect();
    let bins = forward(&centred, points)?;
    let last = bins.len() - 1;
    let amplitude = bins.iter().enumerate().map(|(m, bin)| {
        let sides = if m == 0 || m == last { 1.0 } else { 2.0 };
        sides * bin.norm() / samples as f64
    });
    let bin_hz = 1.0 / (points as f64 * series.step_s());
    Ok(AmplitudeSpectrum {
        amplitude: amplitude.collect(),
        frequency_hz: (0..=last).map(|m| m as f64 * bin_hz).collect(),
        unit: series.unit().to_owned(),
        window: series.span(),
        zero_padding: points as f64 / samples as f64,
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
        let values = (0..samples)
            .map(|k| 40.0 + amplitude * (2.0 * PI * f * k as f64 * 1e-4 + 0.4).cos())
            .collect();
        TimeSeries::new(1.0, 1e-4, "m/s^2", values).expect("a valid series")
    }

    #[test]
    fn a_sinusoid_of_amplitude_a_reads_a() {
        // 1 s, lines on and between natural bins. The image at -f leaks 1 / (2 pi f T) at most: 1e-3 at 150 Hz.
        for f in [150.0, 333.3, 1234.56] {
            let spectrum = amplitude_spectrum(&tone(7.0, f, 10_000), 0.25).expect("spectrum");
            let peak = spectrum.peak_near(f, 0.01).expect("a peak");
            assert!(
                (peak.amplitude / 7.0 - 1.0).abs() < 1.1e-3,
                "{f}: {}",
                peak.amplitude
            );
            assert!(
                (peak.frequency_hz - f).abs() < 0.01,
                "{f}: {}",
                peak.frequency_hz
            );
        }
    }

    #[test]
    fn bins_are_as_fine_as_asked_and_the_mean_is_gone() {
        let short = amplitude_spectrum(&tone(1.0, 100.0, 1000), 0.25).expect("spectrum");
        assert!(short.frequency_hz[1] <= 0.25);
        assert!(short.zero_padding >= 40.0);
        let long = amplitude_spectrum(&tone(1.0, 100.0, 200_000), 0.25).expect("spectrum");
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
        let values = (0..12)
            .map(|k| (0.9 * f64::from(k)).sin() + 0.02 * f64::from(k * k))
            .collect();
        let series = TimeSeries::new(0.0, 1.0, "m", values).expect("a valid series");
        let spectrum = amplitude_spectrum(&series, 1.0 / 64.0).expect("spectrum");
        for (bin, expected) in [
            (1, 0.46074397057919403),
            (9, 0.9148740075462658),
            (32, 0.0931662867193388),
        ] {
            assert!(
                (spectrum.amplitude[bin] - expected).abs() < 1e-14,
                "bin {bin}"
            );
        }
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |series: &TimeSeries, resolution| {
            amplitude_spectrum(series, resolution)
                .expect_err("must fail")
                .to_string()
        };
        let series = TimeSeries::new(0.0, 0.25, "m", vec![1.0; 4]).expect("a valid series");
        assert_eq!(
            message(&series, 0.0),
            "frequency resolution must be positive and at least 0.000000014901161193847656 Hz for this \
             sampling rate, found 0 Hz"
        );
        assert!(message(&series, 1e-9).starts_with("frequency resolution"));
        assert!(message(&series, f64::NAN).starts_with("frequency resolution"));
        let one = TimeSeries::new(0.0, 0.25, "m", vec![1.0]).expect("a valid series");
        assert_eq!(
            message(&one, 0.25),
            "series has 1 samples, the filter or transform needs at least 2"
        );
    }
}
