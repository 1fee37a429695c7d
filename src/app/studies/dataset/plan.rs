//! What a data set is to compute: a specification with its cases and machines.

use super::drawn::Signal;
use super::hierarchy::{Hierarchy, Specimen};
use super::identity::{DatasetIdentity, identity};
use super::reading::MOST_SIGNALS;
use super::spec::{DatasetSpec, Split};
use crate::app::case::{Case, CaseError, Purpose, Source};
use crate::app::error::ComputeError;
use std::path::Path;

/// Bytes of the samples of a shard, at most, unless one signal has more; and its signals.
const MOST_BYTES: usize = 64 << 20;
const MOST_OF_SHARD: usize = 50;

/// A data set to be computed.
#[derive(Debug)]
pub(crate) struct DatasetPlan {
    pub(crate) spec: DatasetSpec,
    pub(crate) source: Source,
    pub(crate) identity: DatasetIdentity,
    /// Number of signals.
    pub(crate) count: usize,
    /// Signals of a shard.
    pub(crate) per_shard: usize,
    /// A case for each entry of `[[machines]]`.
    pub(super) cases: Vec<Case>,
    pub(super) hierarchy: Hierarchy,
    background: Option<Vec<f64>>,
}

impl DatasetPlan {
    /// Reads a specification, its cases and its background; `count` goes before that of the specification.
    ///
    /// # Errors
    /// [`ComputeError::Case`] for a specification or a case that is wrong; that of a mesh or a background that cannot be read.
    pub(super) fn read(path: &Path, set: &[String], count: Option<usize>) -> Result<Self, ComputeError> {
        let (spec, source) = DatasetSpec::load(path, set)?;
        let count = count.or(spec.count).ok_or_else(|| {
            let what = format!("{}: found no number of signals", path.display());
            ComputeError::input(what, "give count in the specification, or --count N")
        })?;
        if count > MOST_SIGNALS {
            let what = format!("found --count {count}, expected at most {MOST_SIGNALS}");
            return Err(ComputeError::input(what, "make several data sets, each with a seed of its own"));
        }
        let cases = spec.cases(&source)?;
        // a file that cannot be read as a record is wrong input
        let background = spec.background(&source)?;
        let identity = identity(&spec, &source, &cases)?;
        let samples = spec.recorder.samples()[0];
        Ok(Self {
            hierarchy: Hierarchy::new(&spec, count.div_ceil(spec.signals_per_specimen)),
            per_shard: spec.signals_per_file.unwrap_or((MOST_BYTES / (4 * samples)).clamp(1, MOST_OF_SHARD)),
            spec,
            source,
            identity,
            count,
            cases,
            background,
        })
    }

    /// Number of shards.
    pub(crate) fn shards(&self) -> usize {
        self.count.div_ceil(self.per_shard)
    }

    /// The signals of a shard, from 0.
    pub(crate) fn of_shard(&self, shard: usize) -> std::ops::Range<usize> {
        let first = shard * self.per_shard;
        first..(first + self.per_shard).min(self.count)
    }

    /// Recorded samples of the background for a part of the split; `None` without one.
    pub(super) fn background_of(&self, part: usize) -> Option<&[f64]> {
        let record = self.background.as_deref()?;
        record.get(self.spec.split.stretch(part, record.len()))
    }

    /// The case of a signal, with the sensor that is recorded alone.
    ///
    /// # Errors
    /// [`CaseError`] where what was drawn makes no valid case.
    pub(super) fn case(&self, signal: &Signal) -> Result<Case, CaseError> {
        let base = &self.cases[signal.entry].source;
        let mut case = Case::from_source(Source { set: signal.set.clone(), ..base.clone() })?;
        let sensor = self.spec.machines[signal.entry].sensor.clone();
        let sensor = sensor.or_else(|| case.sensors.first().map(|sensor| sensor.name.clone()));
        case.sensors.retain(|own| Some(&own.name) == sensor.as_ref());
        case.ready_for(Purpose::Run)?;
        Ok(case)
    }

    /// Place of the bearing with the faults among those of a machine, from 0.
    pub(super) fn seat(&self, entry: usize) -> usize {
        let Some(label) = &self.spec.machines[entry].bearing else { return 0 };
        self.cases[entry].seats().iter().position(|seat| seat.label == *label).unwrap_or(0)
    }

    /// Name of a machine's case, as the specification has it.
    pub(super) fn case_name(&self, entry: usize) -> String {
        self.spec.machines[entry].case.display().to_string()
    }

    /// Name of the part of the split.
    pub(super) fn part(specimen: Specimen) -> &'static str {
        Split::PARTS[specimen.part]
    }
}
