//! What a data set's files say of its signals.

use super::drawn::Signal;
use super::hierarchy::Label;
use super::identity::DatasetIdentity;
use super::plan::DatasetPlan;
use crate::app::commands::run::choice::ModelChoice;
use crate::app::error::ComputeError;
use crate::files::FileDigest;
use crate::formats::{ParquetColumn, ParquetValues};
use crate::report::significant;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// One signal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SignalRecord {
    /// Its number, from 0.
    pub signal: usize,
    /// The file with its samples; null of one that could not be computed.
    pub file: Option<String>,
    /// Its row there, from 0.
    pub row: Option<usize>,
    /// Why it could not be computed or cannot be trusted; null of others.
    pub reason: Option<String>,
    /// "none", "outer", "inner", "ball" or "several".
    pub label: String,
    /// Whether the samples are there and can be trusted; if not, `reason` says why.
    pub trusted: bool,
    /// "train", "validation" or "test".
    pub split: String,
    /// Number of its machine, from 0.
    pub machine: usize,
    /// The machine's case, as the specification names it.
    pub case: String,
    /// Number of its bearing, from 0.
    pub specimen: usize,
    /// Mean speed of the shaft in the record, Hz.
    pub speed_hz: Option<f64>,
    /// How far the speed changes in the record, Hz.
    pub speed_spread_hz: Option<f64>,
    /// Balls that pass a point of the outer race (BPFO), Hz: the mean with the cage's slip.
    pub bpfo_hz: Option<f64>,
    /// Balls that pass a point of the inner race (BPFI), Hz: the mean with the cage's slip.
    pub bpfi_hz: Option<f64>,
    /// Spin of a ball (BSF), Hz; damage of a ball strikes twice as often.
    pub bsf_hz: Option<f64>,
    /// Turns of the cage (FTF), Hz: the mean with its slip.
    pub ftf_hz: Option<f64>,
    /// RMS of the samples, m/s^2.
    pub rms: Option<f64>,
    /// RMS before noise and background, m/s^2.
    pub clean_rms: Option<f64>,
    /// Share of the samples that the converter could not hold.
    pub clipped: Option<f64>,
    /// Modes of the model.
    pub modes: Option<usize>,
    /// Its method.
    pub method: Option<String>,
    /// Its largest step, s.
    pub step_s: Option<f64>,
    /// Its estimated error relative to the RMS, in the band up to half of the sampling rate, while nearby solutions stay together.
    pub estimated_error: Option<f64>,
    /// SHA-256 of the samples, little-endian.
    pub sha256: Option<String>,
    /// Damage, as `bearing.defects` of a case has it.
    pub faults: Vec<Value>,
    /// What was drawn, by its key.
    pub drawn: BTreeMap<String, Value>,
}

/// A file of signals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct ShardRecord {
    /// Its name and the SHA-256 of its bytes; that of the same as Parquet too, if it was asked for.
    pub(crate) files: Vec<FileDigest>,
    /// SHA-256 of the records below.
    pub(crate) signals_sha256: String,
    /// The signals that belong to it, those that could not be computed too.
    pub(crate) signals: Vec<SignalRecord>,
}

/// `manifest.json`.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Manifest<'a> {
    /// Version of the program.
    pub plummer: &'a str,
    /// The command.
    pub command: &'static str,
    /// What the data set is about.
    pub title: &'a str,
    /// SHA-256 of the specification.
    pub spec_sha256: &'a str,
    /// `KEY=VALUE` arguments.
    pub set: &'a [String],
    /// Cases, meshes and the background by their SHA-256.
    pub inputs: &'a [FileDigest],
    /// The seed.
    pub seed: u64,
    /// Number of signals.
    pub count: usize,
    /// Sampling rate, Hz.
    pub rate_hz: f64,
    /// Samples of a signal.
    pub samples: usize,
    /// Unit of the samples.
    pub unit: &'static str,
    /// Words of the labels; arrays have their places here.
    pub labels: Vec<&'static str>,
    /// Files of signals by their SHA-256.
    pub files: Vec<FileDigest>,
    /// All signals in order.
    pub signals: Vec<SignalRecord>,
}

impl SignalRecord {
    pub(super) fn of(plan: &DatasetPlan, signal: &Signal) -> Self {
        Self {
            signal: signal.number,
            file: None,
            row: None,
            reason: None,
            label: signal.specimen.label.name().to_owned(),
            trusted: false,
            split: DatasetPlan::part(signal.specimen).to_owned(),
            machine: signal.specimen.machine,
            case: plan.case_name(signal.entry),
            specimen: signal.specimen_number,
            speed_hz: None,
            speed_spread_hz: None,
            bpfo_hz: None,
            bpfi_hz: None,
            bsf_hz: None,
            ftf_hz: None,
            rms: None,
            clean_rms: None,
            clipped: None,
            modes: None,
            method: None,
            step_s: None,
            estimated_error: None,
            sha256: None,
            faults: signal.faults.clone(),
            drawn: signal.drawn.clone(),
        }
    }

    pub(super) fn model_of(&mut self, choice: &ModelChoice, modes: usize) {
        self.modes = Some(modes);
        self.method = Some(choice.model.method.name().to_owned());
        self.step_s = Some(choice.model.step);
        self.estimated_error = choice.estimated_error;
    }

    /// Why signals that a model made to its end cannot be trusted, if they cannot: an estimated error as large as they are is one reason.
    pub(super) fn distrust(&self) -> Option<String> {
        let error = self.estimated_error.filter(|error| *error >= 1.0)?;
        Some(format!("its estimated error is {} of its RMS, as large as it is", significant(error, 2)))
    }
}

impl DatasetPlan {
    /// What a signal's model was to reach (`accuracy.target`).
    fn target_of(&self, signal: &SignalRecord) -> f64 {
        let drawn = signal.drawn.get("accuracy.target").and_then(Value::as_f64);
        drawn.unwrap_or_else(|| self.cases[self.hierarchy.machines[signal.machine].entry].target())
    }

    /// How many of the signals that are there cannot be trusted, if some cannot.
    pub(crate) fn untrusted(manifest: &Manifest<'_>) -> Option<String> {
        let there = || manifest.signals.iter().filter(|signal| signal.file.is_some());
        let untrusted = there().filter(|signal| !signal.trusted).count();
        (untrusted > 0).then(|| {
            format!(
                "{untrusted} of {} signals cannot be trusted: `trusted` is false of them in the manifest and 0 in the files; leave them out",
                there().count()
            )
        })
    }

    /// Why signals that are there are not as accurate as they were to be, if some are not.
    pub(crate) fn inaccurate(&self, manifest: &Manifest<'_>) -> Option<String> {
        /// Times the target that is told.
        const TOLD: f64 = 2.0;
        let there: Vec<&SignalRecord> = manifest.signals.iter().filter(|signal| signal.file.is_some()).collect();
        let errors = there.iter().filter_map(|signal| Some((signal.estimated_error?, self.target_of(signal))));
        let missed: Vec<f64> =
            errors.filter(|(error, target)| *error > TOLD * target).map(|(error, _)| error).collect();
        let worst = missed.iter().copied().reduce(f64::max)?;
        Some(format!(
            "{} of {} signals miss accuracy.target by more than twice (estimated errors up to {}): estimated_error in manifest.csv has each",
            missed.len(),
            there.len(),
            significant(worst, 2)
        ))
    }
}

impl<'a> Manifest<'a> {
    pub(super) fn of(plan: &'a DatasetPlan, shards: Vec<ShardRecord>) -> Self {
        let DatasetIdentity { plummer, spec_sha256, set, files } = &plan.identity;
        let (files_of_signals, signals): (Vec<_>, Vec<_>) =
            shards.into_iter().map(|shard| (shard.files, shard.signals)).unzip();
        Self {
            plummer,
            command: "dataset",
            title: &plan.spec.title,
            spec_sha256,
            set,
            inputs: files,
            seed: plan.spec.seed,
            count: plan.count,
            rate_hz: plan.spec.recorder.rate_hz,
            samples: plan.spec.recorder.samples()[0],
            unit: "m/s^2",
            labels: Label::ALL.map(Label::name).to_vec(),
            files: files_of_signals.concat(),
            signals: signals.concat(),
        }
    }

    /// The signals as a table: a column for each key, those of damage as `fault.0.depth`.
    ///
    /// # Errors
    /// [`ComputeError::Input`] for what has no text.
    pub(crate) fn table(&self) -> Result<ManifestTable, ComputeError> {
        let rows: Result<Vec<BTreeMap<String, Value>>, _> = self.signals.iter().map(flat).collect();
        let rows = rows.map_err(|error| ComputeError::wrong(format!("manifest: {error}")))?;
        let others: BTreeSet<&String> = rows.iter().flat_map(BTreeMap::keys).collect();
        let others = others.into_iter().map(String::as_str).filter(|key| !FIXED.contains(key));
        let names = FIXED.into_iter().chain(others);
        let column = |name: &str| {
            let values = rows.iter().map(|row| row.get(name).cloned().unwrap_or_default());
            (name.to_owned(), values.collect())
        };
        Ok(ManifestTable(names.map(column).collect()))
    }
}

/// The signals by columns: a name, and a value each, null where a signal has none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ManifestTable(Vec<(String, Vec<Value>)>);

impl ManifestTable {
    /// A line for each signal below one of names.
    ///
    /// # Errors
    /// [`ComputeError::Input`] for what has no text.
    pub(crate) fn to_csv(&self) -> Result<String, ComputeError> {
        let failed = |error: &dyn std::fmt::Display| ComputeError::wrong(format!("manifest.csv: {error}"));
        let mut csv = csv::Writer::from_writer(Vec::new());
        csv.write_record(self.0.iter().map(|(name, _)| name)).map_err(|error| failed(&error))?;
        for row in 0..self.0.first().map_or(0, |(_, values)| values.len()) {
            let cells = self.0.iter().map(|(_, values)| text(&values[row]).unwrap_or_default());
            csv.write_record(cells).map_err(|error| failed(&error))?;
        }
        let bytes = csv.into_inner().map_err(|error| failed(&error))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// Columns of whole numbers, of numbers, or of texts, by what all signals have there.
    pub(crate) fn to_parquet(&self) -> Vec<ParquetColumn> {
        let column = |(name, values): &(String, Vec<Value>)| {
            let mut there = values.iter().filter(|value| !value.is_null()).peekable();
            let values = match there.peek().is_some() {
                true if there.clone().all(Value::is_i64) => {
                    ParquetValues::Whole(values.iter().map(Value::as_i64).collect())
                }
                true if there.all(Value::is_number) => {
                    ParquetValues::Numbers(values.iter().map(Value::as_f64).collect())
                }
                _ => ParquetValues::Texts(values.iter().map(text).collect()),
            };
            ParquetColumn { name: name.clone(), values }
        };
        self.0.iter().map(column).collect()
    }
}

/// A value in a cell: a text as it is, others as JSON has them; `None` of none.
fn text(value: &Value) -> Option<String> {
    match value {
        Value::Null => None,
        Value::String(text) => Some(text.clone()),
        other => Some(other.to_string()),
    }
}

/// The first columns of the table.
const FIXED: [&str; 24] = [
    "signal",
    "file",
    "row",
    "label",
    "trusted",
    "split",
    "machine",
    "case",
    "specimen",
    "reason",
    "speed_hz",
    "speed_spread_hz",
    "bpfo_hz",
    "bpfi_hz",
    "bsf_hz",
    "ftf_hz",
    "rms",
    "clean_rms",
    "clipped",
    "modes",
    "method",
    "step_s",
    "estimated_error",
    "sha256",
];

/// A signal's values under one name each.
fn flat(signal: &SignalRecord) -> Result<BTreeMap<String, Value>, serde_json::Error> {
    let Value::Object(mut values) = serde_json::to_value(signal)? else { return Ok(BTreeMap::new()) };
    let mut row = BTreeMap::new();
    if let Some(Value::Object(drawn)) = values.remove("drawn") {
        row.extend(drawn);
    }
    if let Some(Value::Array(faults)) = values.remove("faults") {
        for (place, fault) in faults.into_iter().enumerate() {
            let Value::Object(fault) = fault else { continue };
            row.extend(fault.into_iter().map(|(key, value)| (format!("fault.{place}.{key}"), value)));
        }
    }
    row.extend(values);
    Ok(row)
}
