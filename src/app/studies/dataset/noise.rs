//! Noise of a given colour, and a recorded background.

use super::drawn::{Loudness, Noise, Pitch};
use crate::app::error::ComputeError;
use crate::numerics::series::root_mean_square;
use realfft::RealFftPlanner;
use std::f64::consts::{SQRT_2, TAU};

/// What noise needs to know.
pub(super) struct Around<'a> {
    /// The record that is mixed in.
    pub(super) background: Option<&'a [f64]>,
    /// Time of a sample from the first, s.
    pub(super) step_s: f64,
    /// Angle of the shaft then, rad.
    pub(super) shaft: &'a dyn Fn(f64) -> f64,
}

impl Loudness {
    /// The RMS that a noise is to have beside a signal.
    fn rms(self, of_signal: f64) -> f64 {
        match self {
            Self::Below(db) => of_signal * 10.0_f64.powf(-db / 20.0),
            Self::Itself(rms) => rms,
        }
    }
}

/// Adds noise and background to samples of a signal with this RMS.
pub(super) fn add_noise(samples: &mut [f64], rms: f64, noise: &Noise, around: &Around<'_>) -> Result<(), ComputeError> {
    if let (Some((loudness, place)), Some(record)) = (noise.background, around.background) {
        let places = record.len().saturating_sub(samples.len()) + 1;
        let first = ((place * places as f64) as usize).min(places - 1);
        let stretch = &record[first..first + samples.len().min(record.len())];
        let factor = match loudness {
            Loudness::Itself(factor) => factor,
            below => below.rms(rms) / root_mean_square(stretch).max(f64::MIN_POSITIVE),
        };
        samples.iter_mut().zip(stretch).for_each(|(sample, background)| *sample += factor * background);
    }
    for tone in &noise.tones {
        let peak = tone.loudness.rms(rms) * SQRT_2;
        for (place, sample) in samples.iter_mut().enumerate() {
            let time = place as f64 * around.step_s;
            let angle = match tone.pitch {
                Pitch::Clock(hz) => TAU * hz * time,
                Pitch::Shaft(order) => order * (around.shaft)(time),
            };
            *sample += peak * (angle + tone.phase).cos();
        }
    }
    if let Some((loudness, exponent, stream)) = &noise.coloured {
        let mut stream = stream.clone();
        let white: Vec<f64> = samples.iter().map(|_| stream.normal()).collect();
        let coloured = coloured(white, *exponent)?;
        let factor = loudness.rms(rms);
        samples.iter_mut().zip(coloured).for_each(|(sample, noise)| *sample += factor * noise);
    }
    Ok(())
}

/// Noise with a power spectrum `1 / f^exponent` and RMS 1 from white noise of RMS near 1, which stays as it is for 0.
fn coloured(mut white: Vec<f64>, exponent: f64) -> Result<Vec<f64>, ComputeError> {
    if exponent == 0.0 || white.is_empty() {
        return Ok(white);
    }
    let mut planner = RealFftPlanner::new();
    let (forward, back) = (planner.plan_fft_forward(white.len()), planner.plan_fft_inverse(white.len()));
    let mut spectrum = forward.make_output_vec();
    let failed = |error: realfft::FftError| ComputeError::Failed { what: format!("noise: {error}"), help: None };
    forward.process(&mut white, &mut spectrum).map_err(failed)?;
    for (line, value) in spectrum.iter_mut().enumerate() {
        // none at rest, where a falling spectrum has no end
        *value *= if line == 0 { 0.0 } else { (line as f64).powf(-0.5 * exponent) };
    }
    back.process(&mut spectrum, &mut white).map_err(failed)?;
    let rms = root_mean_square(&white).max(f64::MIN_POSITIVE);
    Ok(white.into_iter().map(|value| value / rms).collect())
}
