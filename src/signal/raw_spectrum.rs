//! A signal's spectrum as it is, and the envelopes of bands of it in the signal's unit.

use rustfft::num_complex::Complex;

use super::fourier::{MOST_POINTS, fast_length, forward};
use super::white_spectrum::band_envelope;
use super::{BandEnvelope, SignalError};
use crate::numerics::series::TimeSeries;

/// Spectrum of a series without its mean, of which envelopes of many bands are taken.
///
/// Bands have straight edges: no bin beyond them counts. So the same band of two signals is the same whatever their sampling rates, as
/// long as both reach its upper edge.
#[derive(Debug, Clone)]
pub(crate) struct RawSpectrum {
    bins: Vec<Complex<f64>>,
    points: usize,
    start_s: f64,
    step_s: f64,
}

impl RawSpectrum {
    /// Spectrum of a series.
    ///
    /// # Errors
    /// [`SignalError::Transform`], which no valid series causes.
    pub(crate) fn of(series: &TimeSeries) -> Result<Self, SignalError> {
        let points = fast_length(series.values().len().min(MOST_POINTS));
        let mean = series.mean();
        let centred: Vec<f64> = series.values().iter().map(|value| value - mean).collect();
        // that of the analytic signal: twice that of the signal, over the number of its samples
        let scale = 2.0 / points as f64;
        let mut bins = forward(&centred, points)?;
        for bin in &mut bins {
            *bin *= scale;
        }
        Ok(Self { bins, points, start_s: series.start_s(), step_s: series.step_s() })
    }

    /// Squared envelope |x + i H x|^2 of the band between two frequencies (Hz, 0 to half the sampling rate), in the square of the series'
    /// unit, at a rate of about twice the band's width or more. Its mean is twice the mean square of what lies in the band.
    ///
    /// The series is taken as periodic: cut a window out of a longer stretch where its ends matter.
    #[must_use]
    pub(crate) fn envelope(&self, band_hz: [f64; 2]) -> BandEnvelope {
        band_envelope(&self.bins, self.points, self.start_s, self.step_s, band_hz)
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
