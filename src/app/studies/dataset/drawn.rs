//! What is drawn for a signal.

use super::hierarchy::Specimen;
use crate::numerics::random::Stream;
use serde_json::Value;
use std::collections::BTreeMap;

/// Sensor and recorder of a specimen.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Recorder {
    pub(super) rate_hz: f64,
    /// Samples of the simulation for one of the record.
    pub(super) oversampling: usize,
    /// Samples of the record, and of what settles before.
    pub(super) samples: usize,
    pub(super) settling: usize,
    pub(super) anti_alias_hz: f64,
    pub(super) anti_alias_order: usize,
    pub(super) high_pass_hz: Option<f64>,
    pub(super) resonance_hz: Option<f64>,
    pub(super) resonance_damping: f64,
    /// What goes through unchanged, and modes by frequency (Hz), damping ratio and factor.
    pub(super) path: Option<(f64, Vec<[f64; 3]>)>,
    pub(super) gain: f64,
    /// Step and largest value of the converter.
    pub(super) converter: Option<[f64; 2]>,
}

/// How loud something is: beside the signal's RMS, or by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Loudness {
    /// So many dB below it.
    Below(f64),
    /// RMS of a noise (m/s^2), or the factor of a background.
    Itself(f64),
}

/// Noise of a signal.
#[derive(Debug, Clone)]
pub(super) struct Noise {
    /// How loud, the exponent of its spectrum, and its random numbers.
    pub(super) coloured: Option<(Loudness, f64, Stream)>,
    /// Share by which it swells with the orders of the shaft from 1 on, and their phases, rad.
    pub(super) modulation: [[f64; 2]; 3],
    /// How loud, and where it begins between the first and the last place of its part's stretch, 0 to 1.
    pub(super) background: Option<(Loudness, f64)>,
    pub(super) tones: Vec<Tone>,
}

/// A tone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tone {
    /// Hz, or periods a turn of the shaft.
    pub(super) pitch: Pitch,
    pub(super) loudness: Loudness,
    /// rad.
    pub(super) phase: f64,
}

/// What a tone keeps time with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Pitch {
    /// Hz.
    Clock(f64),
    /// Periods a turn.
    Shaft(f64),
}

/// One signal: all that was drawn for it.
#[derive(Debug, Clone)]
pub(super) struct Signal {
    /// From 0.
    pub(super) number: usize,
    pub(super) specimen_number: usize,
    pub(super) specimen: Specimen,
    /// Place of its machine's kind in `[[machines]]`.
    pub(super) entry: usize,
    /// `KEY=VALUE` arguments of its case.
    pub(super) set: Vec<String>,
    /// Damage, as `bearing.defects` has it.
    pub(super) faults: Vec<Value>,
    /// What was drawn, by its key.
    pub(super) drawn: BTreeMap<String, Value>,
    pub(super) recorder: Recorder,
    pub(super) noise: Noise,
}
