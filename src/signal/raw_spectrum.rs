//! A signal's spectrum as it is, and the envelopes of bands of it in the signal's unit.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::SignalError;
use super::fourier::{MOST_POINTS, fast_length, forward};
use crate::numerics::series::TimeSeries;

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
