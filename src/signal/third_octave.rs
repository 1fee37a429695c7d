//! Levels in third-octave bands.

use serde::Serialize;

use super::{SignalError, WindowFunction, amplitude_spectrum};
use crate::numerics::series::TimeSeries;

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

#[cfg(test)]
mod tests {
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
