//! Noise of a given colour, and a recorded background.

use super::drawn::{Loudness, Noise, Pitch};
use crate::app::error::ComputeError;
use crate::numerics::series::root_mean_square;
use crate::report::significant;
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

impl Noise {
    /// Why samples cannot hold a tone of the shaft, if it is as fast as half of their rate (Hz) at the shaft's highest speed (Hz).
    pub(super) fn folded(&self, fastest_hz: f64, half_hz: f64) -> Option<String> {
        self.tones.iter().find_map(|tone| match tone.pitch {
            Pitch::Shaft(order) if order * fastest_hz >= half_hz => Some(format!(
                "a tone of order {order} is at {} Hz, expected below half of recorder.rate_hz ({half_hz} Hz)",
                significant(order * fastest_hz, 6)
            )),
            _ => None,
        })
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
        let modulated = noise.modulation.iter().any(|[share, _]| *share > 0.0);
        for (place, (sample, value)) in samples.iter_mut().zip(coloured).enumerate() {
            let swell = match modulated {
                true => {
                    let angle = (around.shaft)(place as f64 * around.step_s);
                    let orders = (1..).zip(&noise.modulation);
                    orders.fold(1.0, |sum, (order, [share, phase])| {
                        sum + share * (f64::from(order) * angle + phase).cos()
                    })
                }
                false => 1.0,
            };
            *sample += factor * swell * value;
        }
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

#[cfg(test)]
mod tests {
    use super::super::drawn::Tone;
    use super::*;
    use crate::numerics::random::Stream;

    const SILENT: Noise = Noise { coloured: None, modulation: [[0.0; 2]; 3], background: None, tones: Vec::new() };
    const COUNT: usize = 1 << 15;

    /// What is added to silence beside a signal of RMS 2, at 1 kHz and with a shaft of 10 Hz.
    fn added(noise: &Noise, background: Option<&[f64]>) -> Vec<f64> {
        let mut samples = vec![0.0; COUNT];
        let around = Around { background, step_s: 1e-3, shaft: &|time| TAU * 10.0 * time };
        add_noise(&mut samples, 2.0, noise, &around).unwrap();
        samples
    }

    fn stream() -> Stream {
        Stream::new(1, [2, 3, 4])
    }

    /// Power of samples between two frequencies, in cycles a sample.
    fn power(samples: &[f64], from: f64, to: f64) -> f64 {
        let mut planner = RealFftPlanner::new();
        let forward = planner.plan_fft_forward(samples.len());
        let mut spectrum = forward.make_output_vec();
        forward.process(&mut samples.to_vec(), &mut spectrum).unwrap();
        let lines = (from * samples.len() as f64) as usize..(to * samples.len() as f64) as usize;
        spectrum[lines].iter().map(|line| line.norm_sqr()).sum()
    }

    #[test]
    fn levels_and_slopes_are_those_asked_for() {
        for (exponent, ratio) in [(0.0, 2.0), (1.0, 1.0), (2.0, 0.5)] {
            let coloured = Some((Loudness::Below(20.0), exponent, stream()));
            let noise = added(&Noise { coloured, ..SILENT }, None);
            let rms = root_mean_square(&noise);
            assert!((rms - 0.2).abs() < 0.004, "{exponent}: {rms}");
            // of two octaves, one upon the other
            let found = power(&noise, 0.1, 0.2) / power(&noise, 0.05, 0.1);
            assert!((found / ratio - 1.0).abs() < 0.1, "{exponent}: {found}");
        }
        let coloured = Some((Loudness::Itself(3.0), 0.0, stream()));
        assert!((root_mean_square(&added(&Noise { coloured, ..SILENT }, None)) - 3.0).abs() < 0.05);
    }

    #[test]
    fn tones_keep_time_with_the_clock_or_the_shaft() {
        for (pitch, hz) in [(Pitch::Clock(50.0), 50.0), (Pitch::Shaft(3.0), 30.0)] {
            let tone = Tone { pitch, loudness: Loudness::Below(6.0), phase: 0.3 };
            let samples = added(&Noise { tones: vec![tone], ..SILENT }, None);
            assert!((root_mean_square(&samples) - 2.0 * 10.0_f64.powf(-0.3)).abs() < 2e-3);
            let beside = power(&samples, 0.0, 0.5) - power(&samples, 1e-3 * hz - 2e-3, 1e-3 * hz + 2e-3);
            assert!(beside < 0.01 * power(&samples, 0.0, 0.5), "{hz}");
        }
    }

    #[test]
    fn modulated_noise_swells_with_the_shaft() {
        let modulation = [[0.3, 0.0], [0.0; 2], [0.0; 2]];
        let coloured = Some((Loudness::Itself(1.0), 0.0, stream()));
        let samples = added(&Noise { coloured, modulation, ..SILENT }, None);
        // power of 1 + 0.3 cos over a tenth of a turn about its top, over that about its bottom
        let around = |phase: usize| -> f64 {
            let near = (0..COUNT).filter(|place| (place + 5 + phase) % 100 < 10);
            near.map(|place| samples[place] * samples[place]).sum()
        };
        let found = around(0) / around(50);
        assert!((found / (1.3_f64 / 0.7).powi(2) - 1.0).abs() < 0.12, "{found}");
    }

    #[test]
    fn a_background_is_a_stretch_of_its_record() {
        let record: Vec<f64> = (0..COUNT + 100).map(|n| (0.37 * n as f64).sin()).collect();
        let place = |place| Noise { background: Some((Loudness::Itself(2.0), place)), ..SILENT };
        assert_eq!(added(&place(0.0), Some(&record))[..3], [2.0 * record[0], 2.0 * record[1], 2.0 * record[2]]);
        let last = added(&place(0.9999), Some(&record));
        assert!((last[COUNT - 1] - 2.0 * record[COUNT + 99]).abs() < 1e-12);
        let below = Noise { background: Some((Loudness::Below(20.0), 0.5)), ..SILENT };
        assert!((root_mean_square(&added(&below, Some(&record))) - 0.2).abs() < 1e-9);
    }
}
