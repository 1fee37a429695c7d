//! Power spectra by averaging over segments.

use serde::Serialize;

use super::fourier::Forward;
use super::{SignalError, WindowFunction};
use crate::numerics::series::{TimeSeries, TimeWindow};

/// What the values of a power spectrum mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PowerScaling {
    /// Unit squared per hertz: noise reads its density, whatever the segments; the integral is the mean square.
    Density,
    /// Unit squared: a sinusoid of amplitude A reads A^2 / 2, whatever the segments.
    Spectrum,
}

/// Settings of Welch's method. Source: P. D. Welch, "The use of fast Fourier transform for the estimation of power
/// spectra", IEEE Trans. Audio Electroacoustics 15 (1967) 70-73.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Welch {
    /// Window of each segment.
    pub window_function: WindowFunction,
    /// Samples of a segment, n >= 2.
    pub segment_samples: usize,
    /// Samples that a segment shares with the one before, below n; half is usual for Hann and Hamming.
    pub overlap_samples: usize,
    /// Scaling of the result.
    pub scaling: PowerScaling,
}

/// One-sided power spectrum, averaged over segments.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PowerSpectrum {
    /// Bin frequencies m / (n step), m = 0 ..= n/2, Hz.
    pub frequency_hz: Vec<f64>,
    /// Power, same length, in `unit`.
    pub power: Vec<f64>,
    /// Unit of the power: "(u)^2/Hz" for a density, "(u)^2" for a spectrum of a signal in u.
    pub unit: String,
    /// What the values mean.
    pub scaling: PowerScaling,
    /// Window of each segment.
    pub window_function: WindowFunction,
    /// Stretch of time that the segments cover; what does not fill a last segment is left out.
    pub span: TimeWindow,
    /// Segments averaged. For noise and no overlap the relative scatter of a value is 1 / sqrt(segments).
    pub segments: usize,
    /// Distance of the bins, 1 / (n step), Hz.
    pub bin_hz: f64,
    /// Equivalent noise bandwidth sum w^2 / (step (sum w)^2), Hz: density times this is the spectrum.
    pub noise_bandwidth_hz: f64,
    /// What the estimate separates: main lobe of the window over the length of a segment, Hz.
    pub resolution_hz: f64,
}

impl Welch {
    /// Power spectrum of a series: each segment's mean is removed, the segment is windowed and transformed, X_m = sum_k
    /// w_k (x_k - mean) exp(-2 pi i m k / n), and
    ///
    /// P_m = c mean |X_m|^2 (2 except at zero and at half the rate),  c = step / sum w^2 (density) or 1 / (sum w)^2
    /// (spectrum).
    ///
    /// Equal to `scipy.signal.welch(x, 1/step, window, n, overlap)`.
    ///
    /// # Errors
    /// [`SignalError`] if the segments do not fit.
    pub fn power(&self, series: &TimeSeries) -> Result<PowerSpectrum, SignalError> {
        let (n, overlap) = (self.segment_samples, self.overlap_samples);
        let samples = series.values().len();
        if n < 2 || n > samples || overlap >= n {
            return Err(SignalError::segments(n, overlap, samples));
        }
        let window = self.window_function.samples(n);
        let (sum, squares): (f64, f64) = (window.iter().sum(), window.iter().map(|w| w * w).sum());
        let plan = Forward::new(n);
        let mut power = vec![0.0; n / 2 + 1];
        let (mut segments, mut covered) = (0, 0);
        for first in (0..=samples - n).step_by(n - overlap) {
            let segment = &series.values()[first..first + n];
            let mean = segment.iter().sum::<f64>() / n as f64;
            let tapered = segment.iter().zip(&window).map(|(x, w)| (x - mean) * w);
            let bins = plan.transform(tapered)?;
            for (sum, bin) in power.iter_mut().zip(&bins) {
                *sum += bin.norm_sqr();
            }
            segments += 1;
            covered = first + n;
        }
        let step_s = series.step_s();
        let scale = match self.scaling {
            PowerScaling::Density => step_s / squares,
            PowerScaling::Spectrum => 1.0 / (sum * sum),
        } / segments as f64;
        for (m, value) in power.iter_mut().enumerate() {
            let sides = if m == 0 || 2 * m == n { 1.0 } else { 2.0 };
            *value *= sides * scale;
        }
        let bin_hz = 1.0 / (n as f64 * step_s);
        Ok(PowerSpectrum {
            frequency_hz: (0..power.len()).map(|m| m as f64 * bin_hz).collect(),
            power,
            unit: match self.scaling {
                PowerScaling::Density => format!("({})^2/Hz", series.unit()),
                PowerScaling::Spectrum => format!("({})^2", series.unit()),
            },
            scaling: self.scaling,
            window_function: self.window_function,
            span: TimeWindow { from: series.start_s(), to: series.time_s(covered) },
            segments,
            bin_hz,
            noise_bandwidth_hz: squares / (step_s * sum * sum),
            resolution_hz: self.window_function.main_lobe_bins() * bin_hz,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::{items, load, numbers, worst};

    const HANN: Welch = Welch {
        window_function: WindowFunction::Hann,
        segment_samples: 100,
        overlap_samples: 50,
        scaling: PowerScaling::Spectrum,
    };

    #[test]
    fn agrees_with_scipy() {
        let reference = load("welch");
        let series = TimeSeries::new(0.0, 1e-3, "m/s^2", numbers(&reference["x"]));
        let series = series.expect("a valid series");
        let cases = items(&reference["cases"]);
        assert_eq!(cases.len(), 20);
        for case in cases {
            let whole = |key: &str| case[key].as_u64().expect("a number") as usize;
            let welch = Welch {
                window_function: match case["window"].as_str().expect("a name") {
                    "boxcar" => WindowFunction::Boxcar,
                    "hann" => WindowFunction::Hann,
                    "hamming" => WindowFunction::Hamming,
                    "blackman" => WindowFunction::Blackman,
                    _ => WindowFunction::FlatTop,
                },
                segment_samples: whole("segment"),
                overlap_samples: whole("overlap"),
                scaling: match case["scaling"].as_str().expect("a name") {
                    "density" => PowerScaling::Density,
                    _ => PowerScaling::Spectrum,
                },
            };
            let found = welch.power(&series).expect("spectrum");
            // rounding of the transforms
            assert!(worst(&found.power, &numbers(&case["power"])) < 1e-13, "{welch:?}");
            assert!(worst(&found.frequency_hz, &numbers(&case["frequency"])) < 1e-15);
        }
    }

    #[test]
    fn a_tone_reads_half_its_square_and_the_figures_are_stated() {
        let tone = (0..1030).map(|k| 3.0 * (0.2 * std::f64::consts::PI * f64::from(k)).cos());
        let series = TimeSeries::new(1.0, 1e-3, "N", tone.collect()).expect("a valid series");
        let found = HANN.power(&series).expect("spectrum");
        assert!((found.power[10] - 4.5).abs() < 1e-12);
        assert!((found.frequency_hz[10] - 100.0).abs() < 1e-9);
        assert_eq!((found.unit.as_str(), found.segments), ("(N)^2", 19));
        assert!((found.span.to - 2.0).abs() < 1e-12);
        assert!((found.bin_hz - 10.0).abs() < 1e-12);
        assert!((found.noise_bandwidth_hz - 15.0).abs() < 1e-12);
        assert!((found.resolution_hz - 20.0).abs() < 1e-12);
        let scaling = PowerScaling::Density;
        let density = Welch { scaling, ..HANN }.power(&series).expect("spectrum");
        assert!((density.power[10] * 15.0 - 4.5).abs() < 1e-12);
        assert_eq!(density.unit, "(N)^2/Hz");
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let series = TimeSeries::new(0.0, 0.25, "m", vec![0.0; 15]).expect("a valid series");
        let message = |segment_samples, overlap_samples| {
            let welch = Welch { segment_samples, overlap_samples, ..HANN };
            welch.power(&series).expect_err("must fail").to_string()
        };
        assert_eq!(
            message(16, 0),
            "segments must have 2 to 15 samples (the series) and overlap by less, found 16 samples and 0 of overlap"
        );
        assert!(message(1, 0).ends_with("found 1 samples and 0 of overlap"));
        assert!(message(8, 8).ends_with("found 8 samples and 8 of overlap"));
    }
}
