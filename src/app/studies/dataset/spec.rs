//! The specification: what machines, bearings, faults and recorders signals are drawn from.
//!
//! It is read as a case file is, with the same errors. Three levels draw their values: a machine, a bearing mounted in it (a
//! specimen, which has one fault or none), and a signal of it.

use super::distribution::{Amount, Distribution};
use super::level::Level;
use crate::app::case::{Source, file_schema};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Values of the case's keys; a key with dots is written in quotes.
pub(crate) type Keys = BTreeMap<String, Distribution>;

/// A data set's specification. What is drawn for one key has at most 100000 values.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DatasetSpec {
    /// What the data set is about.
    #[serde(default)]
    pub title: String,
    /// Every seed makes another data set.
    pub seed: u64,
    /// Number of signals, unless `--count` says another; a larger one begins with the same signals; at most 1e7.
    #[serde(default)]
    pub count: Option<usize>,
    /// Signals of one bearing with one fault.
    #[serde(default = "ten")]
    pub signals_per_specimen: usize,
    /// Signals of a file; absent: 50, and no more than 64 MB.
    #[serde(default)]
    pub signals_per_file: Option<usize>,
    /// Whether signals are written as Parquet too; the manifest is in any case.
    #[serde(default)]
    pub parquet: bool,
    /// What a specimen's signals are for.
    #[serde(default)]
    pub split: Split,
    /// Machines, each by a case.
    pub machines: Vec<MachineSpec>,
    /// Keys of the case, drawn once a machine.
    #[serde(default)]
    pub per_machine: Keys,
    /// Keys of the case, drawn once a specimen.
    #[serde(default)]
    pub per_specimen: Keys,
    /// Keys of the case, drawn once a signal.
    #[serde(default)]
    pub per_signal: Keys,
    /// Faults.
    pub fault: FaultSpec,
    /// Slip of the cage; absent: what the case says.
    #[serde(default)]
    pub slip: Option<SlipSpec>,
    /// Sensor and recorder.
    pub recorder: RecorderSpec,
    /// What becomes of signals whose waveform depends on the smallest disturbance, or whose model errs as much as they are.
    #[serde(default)]
    pub untrusted: Untrusted,
    /// Noise; absent: none.
    #[serde(default)]
    pub noise: Option<NoiseSpec>,
}

/// Shares of the specimens.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Split {
    /// To train with.
    #[serde(default)]
    pub train: f64,
    /// To choose by.
    #[serde(default)]
    pub validation: f64,
    /// To test with.
    #[serde(default)]
    pub test: f64,
    /// What is never in two parts.
    #[serde(default)]
    pub by: SplitBy,
}

impl Default for Split {
    fn default() -> Self {
        Self { train: 0.7, validation: 0.15, test: 0.15, by: SplitBy::Specimen }
    }
}

impl Split {
    pub(super) const PARTS: [&'static str; 3] = ["train", "validation", "test"];

    pub(super) fn shares(&self) -> [f64; 3] {
        [self.train, self.validation, self.test]
    }

    /// The stretch of so many background samples that a part has alone, by its share.
    pub(super) fn stretch(&self, part: usize, samples: usize) -> Range<usize> {
        let shares = self.shares();
        let total: f64 = shares.iter().sum();
        let until = |part: usize| (shares[..part].iter().sum::<f64>() / total * samples as f64).round() as usize;
        until(part)..until(part + 1)
    }
}

/// What becomes of signals that cannot be trusted; the manifest has the reason either way.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Untrusted {
    /// They have no samples.
    #[default]
    LeaveOut,
    /// They are there.
    Keep,
}

/// What is never in two parts of the split.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum SplitBy {
    /// A bearing; machines are in several parts.
    #[default]
    Specimen,
    /// A machine with all its bearings.
    Machine,
}

/// Machines that are alike but for what is drawn.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MachineSpec {
    /// Case file, relative to the specification.
    pub case: PathBuf,
    /// How many machines of this kind there are; at most 1e6 of all kinds.
    #[serde(default = "one")]
    pub count: usize,
    /// Share of the specimens beside the other kinds.
    #[serde(default = "unit")]
    pub weight: f64,
    /// The case's sensor that is recorded; absent: its first.
    #[serde(default)]
    pub sensor: Option<String>,
    /// Label of the bearing that has the faults; absent: the only one or the first.
    #[serde(default)]
    pub bearing: Option<String>,
    /// As the table of this name above, for these machines; a key here goes before.
    #[serde(default)]
    pub per_machine: Keys,
    /// As the table of this name above, for these machines.
    #[serde(default)]
    pub per_specimen: Keys,
    /// As the table of this name above, for these machines.
    #[serde(default)]
    pub per_signal: Keys,
    /// In the place of `[fault]`, for these machines.
    #[serde(default)]
    pub fault: Option<FaultSpec>,
}

/// How many specimens have which fault, and what their damage is.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FaultSpec {
    /// Share of sound bearings.
    #[serde(default)]
    pub none: f64,
    /// Share of bearings with damage of two of the parts below.
    #[serde(default)]
    pub several: f64,
    /// Damage of the outer race.
    #[serde(default)]
    pub outer: Option<DamageSpec>,
    /// Damage of the inner race.
    #[serde(default)]
    pub inner: Option<DamageSpec>,
    /// Damage of a ball.
    #[serde(default)]
    pub ball: Option<DamageSpec>,
}

/// Damage of one part: keys of `[[bearing.defects]]`, and the share of bearings that have it.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DamageSpec {
    /// Share of bearings with this damage alone.
    pub share: f64,
    /// Degrees.
    #[serde(default)]
    pub angle_deg: Option<Distribution>,
    /// m, along the rolling direction.
    #[serde(default)]
    pub length: Option<Distribution>,
    /// m, across it.
    #[serde(default)]
    pub width: Option<Distribution>,
    /// m.
    #[serde(default)]
    pub depth: Option<Distribution>,
    /// m, place across the groove.
    #[serde(default)]
    pub across: Option<Distribution>,
    /// m.
    #[serde(default)]
    pub rim_radius: Option<Distribution>,
    /// `"in-plane"`, `"surface"` or a file.
    #[serde(default)]
    pub profile: Option<Distribution>,
    /// `"profile"` or `"paper"`.
    #[serde(default)]
    pub curvature: Option<Distribution>,
    /// Of a flat: the ball from 0; absent: any.
    #[serde(default)]
    pub ball: Option<Distribution>,
    /// m, of a flat.
    #[serde(default)]
    pub flat_radius: Option<Distribution>,
}

/// Slip of the cage, which wanders about a mean that is drawn once a specimen.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SlipSpec {
    /// Share of the cage's rolling speed that is lost, 0 to 1.
    pub mean: Amount,
    /// Standard deviation of the slip about its mean; absent: none.
    #[serde(default)]
    pub jitter: Option<Amount>,
    /// Time between the values that it wanders over by straight lines, s.
    #[serde(default = "tenth")]
    pub every_s: f64,
    /// Time over which they keep to one another, s; absent: not at all.
    #[serde(default)]
    pub correlation_s: f64,
}

/// Sensor and recorder; what is drawn of them is drawn once a specimen.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RecorderSpec {
    /// Sampling rate, Hz.
    pub rate_hz: f64,
    /// Length of a signal, s.
    pub duration_s: f64,
    /// What is simulated before, s: a run begins in its equilibrium, and settles.
    #[serde(default = "tenth")]
    pub settle_s: f64,
    /// Corner of the Butterworth low-pass before the samples are taken, Hz; absent: 0.4 of the rate.
    #[serde(default)]
    pub anti_alias_hz: Option<Amount>,
    /// Its order, 1 to 12.
    #[serde(default = "eight")]
    pub anti_alias_order: usize,
    /// Corner of the sensor's high-pass of first order, Hz; absent: none.
    #[serde(default)]
    pub high_pass_hz: Option<Amount>,
    /// Resonance of the sensor on its mount, Hz; absent: far above.
    #[serde(default)]
    pub resonance_hz: Option<Amount>,
    /// Damping ratio of the resonance.
    #[serde(default = "fiftieth")]
    pub resonance_damping: f64,
    /// A way from the case's sensor to the place of this one, by modes drawn at random; absent: none.
    #[serde(default)]
    pub path: Option<PathSpec>,
    /// What a signal is multiplied by; absent: 1.
    #[serde(default)]
    pub gain: Option<Amount>,
    /// Bits of the converter, with `full_scale`; absent: no steps.
    #[serde(default)]
    pub bits: Option<u32>,
    /// Largest value of the converter either way, m/s^2.
    #[serde(default)]
    pub full_scale: Option<f64>,
}

/// A way to another place: `direct` times the signal and modes of gain 1, each by a normal factor.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PathSpec {
    /// Number of modes.
    pub modes: Amount,
    /// Frequency of each, Hz.
    pub hz: Amount,
    /// Damping ratio of each.
    pub damping: Amount,
    /// What goes through unchanged; absent: 1.
    #[serde(default)]
    pub direct: Option<Amount>,
}

/// Noise of a record; what is drawn of it is drawn once a signal.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct NoiseSpec {
    /// RMS of the signal over that of the noise, dB.
    #[serde(default)]
    pub snr_db: Option<Amount>,
    /// RMS of the noise in the place of `snr_db`, m/s^2.
    #[serde(default)]
    pub rms: Option<Amount>,
    /// Share by which the noise swells and falls with the first three orders of the shaft together; absent: not at all.
    #[serde(default)]
    pub modulation: Option<Amount>,
    /// Exponent e of the noise's power spectrum `1 / f^e`: 0 white (default), 1 pink, 2 brown.
    #[serde(default)]
    pub colour: Option<Amount>,
    /// A record that is mixed in.
    #[serde(default)]
    pub background: Option<BackgroundSpec>,
    /// Tones of the mains or of the shaft.
    #[serde(default)]
    pub tones: Vec<ToneSpec>,
}

/// A tone with any phase.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ToneSpec {
    /// Frequency, below half of the recorder's rate, Hz.
    #[serde(default)]
    pub hz: Option<Amount>,
    /// In the place of `hz`: periods a turn of the shaft; a signal in which it comes to half of the rate is left out.
    #[serde(default)]
    pub order: Option<Amount>,
    /// RMS of the signal over that of the tone, dB.
    #[serde(default)]
    pub ratio_db: Option<Amount>,
    /// RMS of the tone in the place of `ratio_db`, m/s^2.
    #[serde(default)]
    pub rms: Option<Amount>,
}

/// A recorded background, of which a stretch is drawn for each signal. Each part of the split has a piece of the record alone, by its share.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BackgroundSpec {
    /// The record (.npz, .mat, .csv, .wav, .uff), relative to the specification; at the recorder's rate. The piece of each part holds a signal at least.
    pub file: PathBuf,
    /// Its channel; absent: the only one.
    #[serde(default)]
    pub channel: Option<String>,
    /// RMS of the signal over that of the background, dB.
    #[serde(default)]
    pub ratio_db: Option<Amount>,
    /// What the background is multiplied by, in the place of `ratio_db`.
    #[serde(default)]
    pub gain: Option<Amount>,
}

fn one() -> usize {
    1
}

fn eight() -> usize {
    8
}

fn ten() -> usize {
    10
}

fn unit() -> f64 {
    1.0
}

fn tenth() -> f64 {
    0.1
}

fn fiftieth() -> f64 {
    0.02
}

impl FaultSpec {
    /// The parts of a bearing with their words.
    pub(super) fn parts(&self) -> [(&'static str, Option<&DamageSpec>); 3] {
        [("outer", self.outer.as_ref()), ("inner", self.inner.as_ref()), ("ball", self.ball.as_ref())]
    }
}

impl DamageSpec {
    /// The keys of the damage that are given.
    pub(super) fn keys(&self) -> impl Iterator<Item = (&'static str, &Distribution)> {
        [
            ("angle_deg", &self.angle_deg),
            ("length", &self.length),
            ("width", &self.width),
            ("depth", &self.depth),
            ("across", &self.across),
            ("rim_radius", &self.rim_radius),
            ("profile", &self.profile),
            ("curvature", &self.curvature),
            ("ball", &self.ball),
            ("flat_radius", &self.flat_radius),
        ]
        .into_iter()
        .filter_map(|(key, value)| Some((key, value.as_ref()?)))
    }
}

impl RecorderSpec {
    /// Samples of a signal, and of what is simulated before.
    pub(super) fn samples(&self) -> [usize; 2] {
        [(self.duration_s * self.rate_hz).round() as usize, (self.settle_s * self.rate_hz).ceil() as usize]
    }
}

impl DatasetSpec {
    /// The JSON Schema (draft 07) of a specification.
    pub(crate) fn schema() -> Value {
        file_schema::<Self>("specification of plummer dataset")
    }

    /// The values of a level for the machines of an entry, those of the entry before those of all.
    pub(super) fn keys_of(&self, entry: usize, level: Level) -> Keys {
        let machine = &self.machines[entry];
        let (all, own) = match level {
            Level::Machine => (&self.per_machine, &machine.per_machine),
            Level::Specimen => (&self.per_specimen, &machine.per_specimen),
            Level::Signal => (&self.per_signal, &machine.per_signal),
        };
        let mut keys = all.clone();
        keys.extend(own.clone());
        keys
    }

    /// The faults of the machines of an entry.
    pub(super) fn fault_of(&self, entry: usize) -> &FaultSpec {
        self.machines[entry].fault.as_ref().unwrap_or(&self.fault)
    }

    /// The folder that its paths are relative to.
    pub(super) fn folder(source: &Source) -> &Path {
        source.path.parent().unwrap_or(Path::new(""))
    }
}
