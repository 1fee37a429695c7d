//! The files of a data set: shards of signals, each with a record of what is in it, and the manifest of all.
//!
//! A shard is there when its record is, written last, and it and its file have the digests that it names. So a data set goes on after its process
//! was killed at any time, and ends with the same bytes.

use super::compute::{Computed, Structures, Work};
use super::hierarchy::Label;
use super::manifest::{Manifest, ShardRecord, SignalRecord};
use super::plan::DatasetPlan;
use super::spec::Split;
use crate::app::error::ComputeError;
use crate::files::{self, FileDigest, FileError, write_atomic};
use crate::formats::{FormatError, NpzWriter, ParquetColumn, ParquetValues, write_parquet};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Folder of plan and records, in that of the data set.
pub(crate) const RECORDS: &str = "dataset";

impl DatasetPlan {
    /// Name of a shard's file.
    pub(crate) fn file_name(shard: usize) -> String {
        format!("signals-{shard:05}.npz")
    }

    /// Names of all its files.
    fn file_names(&self, shard: usize) -> Vec<String> {
        let name = Self::file_name(shard);
        let parquet = self.spec.parquet.then(|| name.replace(".npz", ".parquet"));
        std::iter::once(name).chain(parquet).collect()
    }

    fn digests(&self, folder: &Path, shard: usize) -> std::io::Result<Vec<FileDigest>> {
        let digest = |name: String| {
            let FileDigest { sha256, .. } = FileDigest::of_file(&folder.join(&name))?;
            Ok(FileDigest { path: name.into(), sha256 })
        };
        self.file_names(shard).into_iter().map(digest).collect()
    }

    fn record_path(folder: &Path, shard: usize) -> PathBuf {
        folder.join(RECORDS).join(format!("{shard:05}.json"))
    }

    /// The record of a shard that is whole.
    pub(crate) fn shard(&self, folder: &Path, shard: usize) -> Option<ShardRecord> {
        let record = files::read(&Self::record_path(folder, shard)).ok()?;
        let record: ShardRecord = serde_json::from_slice(&record).ok()?;
        let numbers = record.signals.iter().map(|signal| signal.signal);
        let is_whole = numbers.eq(self.of_shard(shard))
            && digest_of(&record.signals).ok()? == record.signals_sha256
            && self.digests(folder, shard).ok()? == record.files;
        is_whole.then_some(record)
    }

    /// Computes a shard and writes it into a folder, which has the one of the records.
    ///
    /// # Errors
    /// [`ComputeError::Interrupted`], and for a file that cannot be written.
    pub(crate) fn write_shard(
        &self,
        folder: &Path,
        shard: usize,
        structures: &mut Structures,
        work: Work<'_>,
    ) -> Result<(), ComputeError> {
        let mut computed = self.compute(shard, structures, work)?;
        let name = Self::file_name(shard);
        let rows = computed.iter_mut().filter(|signal| signal.samples.is_some());
        for (row, signal) in rows.enumerate() {
            (signal.record.file, signal.record.row) = (Some(name.clone()), Some(row));
        }
        let path = folder.join(&name);
        self.write_arrays(&path, &computed)?;
        if let [_, parquet] = &self.file_names(shard)[..] {
            write_parquet(&folder.join(parquet), &columns(&mut computed))?;
        }
        let files = self.digests(folder, shard).map_err(FileError::read(&path))?;
        let signals: Vec<SignalRecord> = computed.into_iter().map(|signal| signal.record).collect();
        let path = Self::record_path(folder, shard);
        let failed = |error| ComputeError::wrong(format!("{}: {error}", path.display()));
        // numbers as they are read again
        let again: Result<Vec<SignalRecord>, _> =
            serde_json::to_vec(&signals).and_then(|text| serde_json::from_slice(&text));
        let signals_sha256 = again.and_then(|signals| digest_of(&signals)).map_err(failed)?;
        let record = ShardRecord { files, signals_sha256, signals };
        let text = serde_json::to_string_pretty(&record).map_err(failed)?;
        Ok(write_atomic(&path, |file| writeln!(file, "{text}"))?)
    }

    fn write_arrays(&self, path: &Path, computed: &[Computed]) -> Result<(), FormatError> {
        let rows: Vec<(&SignalRecord, &Vec<f32>)> =
            computed.iter().filter_map(|signal| Some((&signal.record, signal.samples.as_ref()?))).collect();
        let mut npz = NpzWriter::create(path)?;
        let samples = self.spec.recorder.samples()[0];
        let mut array = npz.begin("signals", &[rows.len(), samples])?;
        rows.iter().try_for_each(|(_, values)| array.extend(values))?;
        array.end()?;
        let whole = |value: &dyn Fn(&SignalRecord) -> usize| -> Vec<i64> {
            rows.iter().map(|(record, _)| i64::try_from(value(record)).unwrap_or(i64::MAX)).collect()
        };
        let number = |value: &dyn Fn(&SignalRecord) -> Option<f64>| -> Vec<f64> {
            rows.iter().map(|(record, _)| value(record).unwrap_or(f64::NAN)).collect()
        };
        let place = |word: &str, words: &[&str]| words.iter().position(|other| *other == word).unwrap_or(0);
        let labels = Label::ALL.map(Label::name);
        npz.array("label", &whole(&|record| place(&record.label, &labels)))?;
        npz.array("trusted", &whole(&|record| usize::from(record.trusted)))?;
        npz.array("split", &whole(&|record| place(&record.split, &Split::PARTS)))?;
        npz.array("signal", &whole(&|record| record.signal))?;
        npz.array("specimen", &whole(&|record| record.specimen))?;
        npz.array("machine", &whole(&|record| record.machine))?;
        npz.array("speed_hz", &number(&|record| record.speed_hz))?;
        npz.array("bpfo_hz", &number(&|record| record.bpfo_hz))?;
        npz.array("bpfi_hz", &number(&|record| record.bpfi_hz))?;
        npz.array("bsf_hz", &number(&|record| record.bsf_hz))?;
        npz.array("ftf_hz", &number(&|record| record.ftf_hz))?;
        npz.array("rate_hz", &[self.spec.recorder.rate_hz])?;
        npz.texts("label_names", &labels)?;
        npz.texts("split_names", &Split::PARTS)?;
        npz.finish()
    }

    /// The manifest, if all shards are there, or the numbers of those that are not.
    pub(crate) fn manifest(&self, folder: &Path) -> Result<Manifest<'_>, Vec<usize>> {
        let shards = (0..self.shards()).map(|shard| self.shard(folder, shard).ok_or(shard));
        let (there, missing): (Vec<_>, Vec<_>) = shards.partition(Result::is_ok);
        let missing: Vec<usize> = missing.into_iter().filter_map(Result::err).collect();
        if missing.is_empty() { Ok(Manifest::of(self, there.into_iter().flatten().collect())) } else { Err(missing) }
    }
}

/// SHA-256 of signals' records as they were read.
fn digest_of(signals: &[SignalRecord]) -> Result<String, serde_json::Error> {
    Ok(FileDigest::of_bytes(Path::new(""), &serde_json::to_vec(signals)?).sha256)
}

/// The signals that are there by columns, the samples last and taken out.
fn columns(computed: &mut [Computed]) -> Vec<ParquetColumn> {
    let taken = computed.iter_mut().filter_map(|signal| Some((&signal.record, signal.samples.take()?)));
    let (records, samples): (Vec<&SignalRecord>, Vec<Vec<f32>>) = taken.unzip();
    let whole = |value: fn(&SignalRecord) -> usize| {
        ParquetValues::Whole(records.iter().map(|record| i64::try_from(value(record)).ok()).collect())
    };
    let text = |value: fn(&SignalRecord) -> &String| {
        ParquetValues::Texts(records.iter().map(|record| Some(value(record).clone())).collect())
    };
    let number = |value: fn(&SignalRecord) -> Option<f64>| {
        ParquetValues::Numbers(records.iter().map(|record| value(record)).collect())
    };
    let named = [
        ("signal", whole(|record| record.signal)),
        ("label", text(|record| &record.label)),
        ("trusted", whole(|record| usize::from(record.trusted))),
        ("split", text(|record| &record.split)),
        ("specimen", whole(|record| record.specimen)),
        ("machine", whole(|record| record.machine)),
        ("speed_hz", number(|record| record.speed_hz)),
        ("bpfo_hz", number(|record| record.bpfo_hz)),
        ("bpfi_hz", number(|record| record.bpfi_hz)),
        ("bsf_hz", number(|record| record.bsf_hz)),
        ("ftf_hz", number(|record| record.ftf_hz)),
        ("samples", ParquetValues::Lists(samples)),
    ];
    named.map(|(name, values)| ParquetColumn { name: name.to_owned(), values }).into()
}
