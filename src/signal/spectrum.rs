//! Amplitude spectrum of a stretch of signal, windowed and interpolated by zero-padding.
//!
//! Levels in third-octave bands, and up to a frequency.
//!
//! Peaks of a spectrum, located between the bins.

use super::fourier::{Forward, MOST_POINTS, fast_length, forward};
use super::{SignalError, WindowFunction};
use crate::numerics::Brief;
use crate::numerics::series::{TimeSeries, TimeWindow};
use serde::Serialize;

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
            "bin width must be positive and at least {} Hz for this sampling rate, found {} Hz",
            Brief(finest_hz),
            Brief(widest_bin_hz)
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

/// Bands a decade (IEC 61260-1, base ten).
const BANDS_A_DECADE: f64 = 10.0;

/// Centre of the band with the number zero, Hz.
const CENTRE_HZ: f64 = 1000.0;

/// Least number of natural bins (1 / duration) in a band.
const LEAST_BINS: f64 = 1.0;

/// Mean square of a signal in a third-octave band.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BandLevel {
    /// Centre, Hz.
    pub centre_hz: f64,
    /// Root mean square of what lies in the band, in the signal's unit.
    pub rms: f64,
}

/// Root mean squares of a series in the third-octave bands that lie between `from_hz` and `to_hz` whole and are at least as
/// wide as what the duration T can separate, 1 / T. Centres `1000 * 10^(k / 10)` Hz, edges at `10^(-1/20)` and `10^(1/20)` of
/// it (IEC 61260-1). From the spectrum without a taper: a line leaks into the next bands as
/// [`amplitude_spectrum`] says; the mean is removed.
///
/// # Errors
/// As [`amplitude_spectrum`].
pub fn third_octaves(series: &TimeSeries, from_hz: f64, to_hz: f64) -> Result<Vec<BandLevel>, SignalError> {
    let natural_hz = 1.0 / series.duration_s();
    let spectrum = amplitude_spectrum(series, WindowFunction::Boxcar, natural_hz)?;
    let half = 10_f64.powf(0.5 / BANDS_A_DECADE);
    // the least frequency at which a band is wide enough
    let narrowest = LEAST_BINS * natural_hz / (half - 1.0 / half);
    let number = |hz: f64| BANDS_A_DECADE * (hz / CENTRE_HZ).log10();
    let first = number(narrowest.max(from_hz * half)).ceil();
    let last = number((to_hz / half).min(0.5 * series.rate_hz() / half)).floor();
    let count = if last >= first { (last - first) as usize + 1 } else { 0 };
    let bands = (0..count).map(|place| {
        let centre_hz = CENTRE_HZ * 10_f64.powf((first + place as f64) / BANDS_A_DECADE);
        let (low, high) = (centre_hz / half, centre_hz * half);
        let bins = spectrum.frequency_hz.iter().zip(&spectrum.amplitude);
        // Parseval: each bin has half its squared amplitude, and `zero_padding` bins stand for one
        let squares: f64 =
            bins.filter(|(hz, _)| (low..high).contains(*hz)).map(|(_, amplitude)| 0.5 * amplitude * amplitude).sum();
        BandLevel { centre_hz, rms: (squares / spectrum.zero_padding).sqrt() }
    });
    Ok(bands.collect())
}

/// Root mean square of what a series has from zero up to `to_hz`, by its spectrum without a taper; the mean counts. A line
/// leaks as [`amplitude_spectrum`] says.
///
/// # Errors
/// [`SignalError`] of the transform.
pub(crate) fn rms_up_to(series: &TimeSeries, to_hz: f64) -> Result<f64, SignalError> {
    let samples = series.values().len();
    let bins = forward(series.values(), samples)?;
    let bin_hz = 1.0 / (samples as f64 * series.step_s());
    let within = bins.iter().enumerate().take_while(|(m, _)| *m as f64 * bin_hz <= to_hz);
    // Parseval: all bins but those at zero and at half the rate stand for two
    let squares: f64 = within.map(|(m, bin)| if m == 0 || 2 * m == samples { 1.0 } else { 2.0 } * bin.norm_sqr()).sum();
    Ok(squares.sqrt() / samples as f64)
}

/// A local maximum of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Peak {
    /// Its frequency, Hz, by the parabola through the highest bin and its neighbours.
    pub frequency_hz: f64,
    /// Its amplitude on that parabola, in the spectrum's unit.
    pub amplitude: f64,
}

/// All local maxima of a spectrum on equally spaced frequencies (both slices of the same length; the longer one is
/// cut), in order of frequency. With bins a_(m-1) < a_m >= a_(m+1) the maximum lies
/// d = (a_(m-1) - a_(m+1)) / (2 (a_(m-1) - 2 a_m + a_(m+1))) bins beside bin m, and is a_m - d (a_(m-1) - a_(m+1)) / 4
/// high. The first and the last bin are no maxima.
pub(super) fn local_maxima(frequency_hz: &[f64], amplitude: &[f64]) -> Vec<Peak> {
    frequency_hz
        .windows(3)
        .zip(amplitude.windows(3))
        .filter(|(_, a)| a[0] < a[1] && a[1] >= a[2])
        .map(|(f, a)| {
            let slope = a[0] - a[2];
            let shift = 0.5 * slope / (a[0] - 2.0 * a[1] + a[2]);
            Peak { frequency_hz: f[1] + shift * 0.5 * (f[2] - f[0]), amplitude: a[1] - 0.25 * slope * shift }
        })
        .collect()
}

/// The highest local maximum with |f - `wanted_hz`| <= `within` `wanted_hz` (relative: 0.03 for 3 %), or `None` if
/// the spectrum has no maximum there: a slope towards a line outside is not a peak.
pub fn peak_near(frequency_hz: &[f64], amplitude: &[f64], wanted_hz: f64, within: f64) -> Option<Peak> {
    let reach = within * wanted_hz.abs();
    let is_near = |f: f64| (f - wanted_hz).abs() <= reach;
    // One bin more on each side, for a maximum whose highest bin lies just outside.
    let bin = frequency_hz.get(1)? - frequency_hz.first()?;
    let first = frequency_hz.partition_point(|f| *f < wanted_hz - reach - 2.0 * bin);
    let end = frequency_hz.partition_point(|f| *f <= wanted_hz + reach + 2.0 * bin);
    local_maxima(frequency_hz.get(first..end)?, amplitude.get(first..end.min(amplitude.len()))?)
        .into_iter()
        .filter(|p| is_near(p.frequency_hz))
        .max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
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
            let peaks = local_maxima(&spectrum.frequency_hz, &spectrum.amplitude);
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
            "bin width must be positive and at least 1.490116e-8 Hz for this \
             sampling rate, found 0 Hz"
        );
        assert!(message(&series, 1e-9).starts_with("bin width"));
        assert!(message(&series, f64::NAN).starts_with("bin width"));
        let one = TimeSeries::new(0.0, 0.25, "m", vec![1.0]).expect("a valid series");
        assert_eq!(message(&one, 0.25), "series has 1 samples, the filter or transform needs at least 2");
    }
}

#[cfg(test)]
mod third_octave_tests {
    use super::*;
    use std::f64::consts::TAU;

    fn tones(tones: &[(f64, f64)]) -> TimeSeries {
        let values = (0..10_000).map(|k| {
            let t = f64::from(k) * 1e-5;
            let parts = tones.iter().map(|(hz, a)| a * (TAU * hz * t + 0.3).sin());
            5.0 + parts.sum::<f64>()
        });
        TimeSeries::new(0.0, 1e-5, "m/s^2", values.collect()).expect("a valid series")
    }

    #[test]
    fn a_tone_is_in_its_band_and_all_bands_together_are_the_signal() {
        let series = tones(&[(1000.0, 4.0), (5000.0, 2.0)]);
        let bands = third_octaves(&series, 0.0, 40e3).expect("bands");
        let at = |hz: f64| {
            let found = bands.iter().find(|band| (band.centre_hz / hz - 1.0).abs() < 0.01);
            found.expect("a band").rms
        };
        // leakage of a line of 100 periods: 1 / (pi 11) of it beyond a band's edge 11 bins away, 1e-2 in the mean square
        assert!((at(1000.0) / (4.0 / 2_f64.sqrt()) - 1.0).abs() < 0.01);
        assert!((at(5011.9) / (2.0 / 2_f64.sqrt()) - 1.0).abs() < 0.01);
        let whole: f64 = bands.iter().map(|band| band.rms * band.rms).sum();
        assert!((whole / (8.0 + 2.0) - 1.0).abs() < 0.01, "{whole}");
    }

    #[test]
    fn bands_lie_inside_the_limits_and_are_as_wide_as_the_signal_is_long() {
        // 0.1 s: bins of 10 Hz, so the first band is wider than 10 Hz: 43 Hz and above
        let series = tones(&[(1000.0, 1.0)]);
        let centres = |from, to| -> Vec<f64> {
            let bands = third_octaves(&series, from, to).expect("bands");
            bands.iter().map(|band| band.centre_hz.round()).collect()
        };
        assert_eq!(centres(0.0, 120.0), [50.0, 63.0, 79.0, 100.0]);
        assert_eq!(centres(900.0, 2300.0), [1259.0, 1585.0, 1995.0]);
        assert!(centres(900.0, 1000.0).is_empty());
        // half the sampling rate is 50 kHz
        assert_eq!(centres(30e3, 1e6), [39811.0]);
    }
}

#[cfg(test)]
mod peaks_tests {
    use super::*;

    fn axis() -> Vec<f64> {
        (0..400).map(|m| f64::from(m) * 0.25).collect()
    }

    /// Two parabolic humps, at 20.1 (height 3) and 55.06 Hz (height 5), zero elsewhere.
    fn humps() -> Vec<f64> {
        let hump = |f: f64, at: f64, height: f64| (height - (f - at).powi(2)).max(0.0);
        axis().iter().map(|f| hump(*f, 20.1, 3.0) + hump(*f, 55.06, 5.0)).collect()
    }

    #[test]
    fn parabola_is_found_exactly() {
        let peaks = local_maxima(&axis(), &humps());
        assert_eq!(peaks.len(), 2);
        for (peak, (f, a)) in peaks.iter().zip([(20.1, 3.0), (55.06, 5.0)]) {
            assert!((peak.frequency_hz - f).abs() < 1e-12);
            assert!((peak.amplitude - a).abs() < 1e-12);
        }
    }

    #[test]
    fn search_stays_inside_and_ignores_slopes() {
        let near = |f, within| peak_near(&axis(), &humps(), f, within).map(|p| p.frequency_hz);
        let close = |found: Option<f64>, f: f64| found.is_some_and(|x| (x - f).abs() < 1e-9);
        assert!(close(near(55.0, 0.03), 55.06));
        assert!(close(near(40.0, 0.6), 55.06));
        assert!(close(near(20.1, 1e-6), 20.1));
        // 54 Hz +- 1.5 % ends at 54.8 Hz, on the slope below the maximum.
        assert_eq!(near(54.0, 0.015), None);
        assert_eq!(near(80.0, 0.1), None);
        assert_eq!(near(1000.0, 0.1), None);
        assert_eq!(peak_near(&[], &[], 10.0, 0.1), None);
    }

    #[test]
    fn a_flat_top_is_one_peak() {
        let f: Vec<f64> = (0..5).map(f64::from).collect();
        let peaks = local_maxima(&f, &[0.0, 1.0, 1.0, 0.0, 0.0]);
        assert_eq!(peaks.len(), 1);
        assert!((peaks[0].frequency_hz - 1.5).abs() < 1e-12);
    }
}
