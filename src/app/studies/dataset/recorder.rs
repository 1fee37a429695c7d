//! What a sensor and a recorder make of an acceleration: resonance, high-pass, low-pass, samples, steps of the converter.
//!
//! The simulation's rows go through it while it runs, and are not kept.

use super::drawn::{Noise, Recorder};
use super::noise::{Around, add_noise};
use crate::app::commands::run::{Checkpoints, Recording, RunRequest, TakePiece};
use crate::app::error::ComputeError;
use crate::numerics::ode::Snapshot;
use crate::numerics::series::root_mean_square;
use crate::signal::{Butterworth, FilterBand, SignalError, Streaming};
use crate::system::{Column, RecordLayout, RunRecord};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Takes the one sensor of a run.
#[derive(Debug)]
pub(super) struct Channel {
    /// What goes through unchanged, and modes with their factors.
    path: (f64, Vec<(Streaming, f64)>),
    filters: Vec<Streaming>,
    /// Samples of the simulation for one of the record, and those before the first.
    every: usize,
    before: usize,
    wanted: usize,
    gain: f64,
    layout: RecordLayout,
    rows: usize,
    /// What was recorded, m/s^2.
    pub(super) samples: Vec<f64>,
}

/// Lets a run record through a channel until it is asked to stop.
#[derive(Debug)]
pub(super) struct ThroughChannel<'a> {
    pub(super) recorder: &'a Recorder,
    pub(super) stop: &'a AtomicBool,
}

/// A record as the recorder has it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Recorded {
    /// m/s^2.
    pub(super) samples: Vec<f32>,
    /// RMS before noise, m/s^2.
    pub(super) clean_rms: f64,
    /// Share of the samples that the converter cannot hold.
    pub(super) clipped: f64,
}

impl Channel {
    fn new(recorder: &Recorder, layout: RecordLayout) -> Result<Self, SignalError> {
        let step_s = 1.0 / (recorder.rate_hz * recorder.oversampling as f64);
        let butterworth = |band, order| Butterworth { band, order }.streaming(step_s);
        let resonance = recorder.resonance_hz.map(|hz| Streaming::resonance(hz, recorder.resonance_damping, step_s));
        let high_pass = recorder.high_pass_hz.map(|cut_off_hz| butterworth(FilterBand::HighPass { cut_off_hz }, 1));
        let cut_off_hz = recorder.anti_alias_hz;
        let low_pass = butterworth(FilterBand::LowPass { cut_off_hz }, recorder.anti_alias_order)?;
        let modes = recorder.path.iter().flat_map(|(_, modes)| modes);
        let modes = modes.map(|[hz, damping, factor]| (Streaming::mode(*hz, *damping, step_s), *factor)).collect();
        Ok(Self {
            path: (recorder.path.as_ref().map_or(1.0, |(direct, _)| *direct), modes),
            filters: resonance.into_iter().chain(high_pass.transpose()?).chain([low_pass]).collect(),
            every: recorder.oversampling,
            before: recorder.settling * recorder.oversampling,
            wanted: recorder.samples,
            gain: recorder.gain,
            layout,
            rows: 0,
            samples: Vec::with_capacity(recorder.samples),
        })
    }
}

impl Recording for Channel {
    fn layout(&self) -> RecordLayout {
        self.layout.clone()
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn append(&mut self, rows: &RunRecord) -> Result<(), ComputeError> {
        for value in rows.sensors.iter().take(1).flat_map(|(_, values)| values) {
            let (direct, modes) = &mut self.path;
            let moved = modes.iter_mut().fold(*direct * value, |sum, (mode, factor)| sum + *factor * mode.push(*value));
            let filtered = self.filters.iter_mut().fold(self.gain * moved, |x, filter| filter.push(x));
            let place = self.rows.checked_sub(self.before);
            if place.is_some_and(|place| place.is_multiple_of(self.every)) && self.samples.len() < self.wanted {
                self.samples.push(filtered);
            }
            self.rows += 1;
        }
        Ok(())
    }

    fn read(&self, _: Column, _: Range<usize>, _: TakePiece<'_>) -> Result<(), ComputeError> {
        Ok(())
    }
}

impl Checkpoints for ThroughChannel<'_> {
    type Record = Channel;

    fn open(&mut self, layout: RecordLayout) -> Result<(Channel, Option<Snapshot>), ComputeError> {
        Ok((Channel::new(self.recorder, layout)?, None))
    }

    fn request(&mut self) -> RunRequest {
        if self.stop.load(Ordering::Relaxed) { RunRequest::Stop } else { RunRequest::GoOn }
    }

    fn save(&mut self, _: &Channel, _: f64, _: &Snapshot) -> Result<(), ComputeError> {
        Ok(())
    }
}

impl Recorded {
    /// With noise and background, in the converter's steps.
    ///
    /// # Errors
    /// [`ComputeError::Failed`] for noise that cannot be coloured, and samples that 32 bits do not hold.
    pub(super) fn new(
        mut samples: Vec<f64>,
        recorder: &Recorder,
        noise: &Noise,
        around: &Around<'_>,
    ) -> Result<Self, ComputeError> {
        let clean_rms = root_mean_square(&samples);
        add_noise(&mut samples, clean_rms, noise, around)?;
        let mut clipped = 0_usize;
        if let Some([step, full]) = recorder.converter {
            for sample in &mut samples {
                let rounded = (*sample / step).round() * step;
                // two's complement: one step less above than below
                *sample = rounded.clamp(-full, full - step);
                clipped += usize::from((*sample - rounded).abs() > 0.5 * step);
            }
        }
        let clipped = clipped as f64 / samples.len().max(1) as f64;
        let held =
            |sample: f64| sample == 0.0 || (f64::from(f32::MIN_POSITIVE)..=f64::from(f32::MAX)).contains(&sample);
        let largest = samples.iter().fold(clean_rms, |largest, sample| largest.max(sample.abs()));
        if !held(largest) || samples.iter().any(|sample| !sample.is_finite()) {
            let what = format!("samples of up to {largest:e} m/s^2: 32 bits hold 1.2e-38 to 3.4e38");
            return Err(ComputeError::Failed { what, help: None });
        }
        Ok(Self { samples: samples.into_iter().map(|sample| sample as f32).collect(), clean_rms, clipped })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn recorder() -> Recorder {
        Recorder {
            rate_hz: 10e3,
            oversampling: 8,
            samples: 4000,
            settling: 500,
            anti_alias_hz: 4e3,
            anti_alias_order: 8,
            high_pass_hz: None,
            resonance_hz: None,
            resonance_damping: 0.02,
            path: None,
            gain: 1.0,
            converter: None,
        }
    }

    /// Amplitude of a tone of amplitude 1 behind the recorder.
    fn gain(recorder: &Recorder, hz: f64) -> f64 {
        let mut channel = Channel::new(recorder, RecordLayout::default()).unwrap();
        let rate = recorder.rate_hz * recorder.oversampling as f64;
        let count = (recorder.settling + recorder.samples) * recorder.oversampling + 1;
        let tone = (0..count).map(|n| (TAU * hz * n as f64 / rate).cos()).collect();
        let rows = RunRecord { sensors: vec![("P".to_owned(), tone)], ..RunRecord::default() };
        channel.append(&rows).unwrap();
        assert_eq!(channel.samples.len(), recorder.samples);
        root_mean_square(&channel.samples) * 2.0_f64.sqrt()
    }

    fn near(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() < 2e-3, "{found}, expected {expected}");
    }

    #[test]
    fn each_part_has_its_own_gain() {
        let plain = recorder();
        near(gain(&plain, 1e3), 1.0);
        near(gain(&plain, 4e3), 0.5_f64.sqrt());
        // what would fold to 3 kHz
        assert!(gain(&plain, 13e3) < 1e-3);
        near(gain(&Recorder { gain: 2.5, ..recorder() }, 1e3), 2.5);
        near(gain(&Recorder { high_pass_hz: Some(500.0), ..recorder() }, 500.0), 0.5_f64.sqrt());
        // 1 / (1 - r^2) below the resonance, as far as the bilinear transform keeps it
        let resonant = Recorder { resonance_hz: Some(6e3), ..recorder() };
        let warped = |hz: f64| (TAU * hz / 160e3).tan();
        let ratio = warped(3e3) / warped(6e3);
        near(gain(&resonant, 3e3) / gain(&plain, 3e3), 1.0 / (1.0 - ratio * ratio));
        // a mode alone, at its frequency
        let path = Some((0.0, vec![[2e3, 0.05, 0.7]]));
        near(gain(&Recorder { path, ..recorder() }, 2e3), 0.7 * gain(&plain, 2e3));
    }

    #[test]
    fn a_converter_has_steps_and_an_end() {
        let around = Around { background: None, step_s: 1e-4, shaft: &|_| 0.0 };
        let silent = Noise { coloured: None, modulation: [[0.0; 2]; 3], background: None, tones: Vec::new() };
        let recorder = Recorder { converter: Some([0.5, 2.0]), ..recorder() };
        let samples = vec![0.2, 0.3, -0.74, 1.6, 9.0, -9.0, -2.0, 1.5];
        let found = Recorded::new(samples, &recorder, &silent, &around).unwrap();
        assert_eq!(found.samples, [0.0, 0.5, -0.5, 1.5, 1.5, -2.0, -2.0, 1.5]);
        assert!((found.clipped - 2.0 / 8.0).abs() < 1e-12, "{}", found.clipped);
    }
}
