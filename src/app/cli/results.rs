//! Results of a case as files: what all have in common; `modes.npz`, `signals.npz`.

use super::earlier_results::digests;
use super::report::ReportFiles;
use super::{CliError, Options, OutputFolder, Progress};
use crate::app::case::Case;
use crate::app::commands::modes::ModesResult;
use crate::app::commands::result::{CaseResult, ResultHead, VERSION};
use crate::app::commands::run::{Recording, RunResult, SensorScalogram};
use crate::app::error::ComputeError;
use crate::files::FileDigest;
use crate::formats::{NpzWriter, column_name, write_modes_npz};
use crate::system::Column;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::time::Instant;

/// What a result says of its computation, `wall_s` (s) after its begin.
pub(super) fn result_head(
    command: &'static str,
    progress: &Progress,
    wall_s: f64,
    tables: Option<&[String]>,
) -> ResultHead {
    let mut stages_s = BTreeMap::new();
    for (stage, took) in progress.times() {
        *stages_s.entry(stage).or_insert(0.0) += took;
    }
    ResultHead {
        plummer: VERSION,
        command,
        wall_s,
        stages_s,
        threads: rayon::current_num_threads(),
        reused: progress.reused(),
        tables: tables.map(<[String]>::to_vec),
    }
}

/// A case that a command computes, and where its results go.
pub(super) struct Job<'a> {
    pub(super) command: &'static str,
    pub(super) case: &'a Case,
    pub(super) options: &'a Options,
    pub(super) progress: &'a Progress,
    pub(super) folder: OutputFolder,
    pub(super) started: Instant,
}

impl<'a> Job<'a> {
    /// A job that begins now, with the folder that the options or the case name.
    pub(super) fn new(command: &'static str, case: &'a Case, options: &'a Options, progress: &'a Progress) -> Self {
        let folder = OutputFolder::of(case, options);
        Self { command, case, options, progress, folder, started: Instant::now() }
    }

    /// What was found, as the result of the case; it rests on these meshes and has these tables, if it has a report.
    pub(super) fn record<'r, T>(
        &'r self,
        meshes: &'r [FileDigest],
        tables: Option<&[String]>,
        result: T,
    ) -> CaseResult<'r, T> {
        CaseResult {
            head: result_head(self.command, self.progress, self.started.elapsed().as_secs_f64(), tables),
            case: &self.case.source.path,
            set: &self.case.source.set,
            case_digest: self.case.digest(self.command),
            meshes,
            arrays: BTreeMap::new(),
            result,
        }
    }

    /// Writes `COMMAND.json` with the digests of the files that hold its arrays; gives its path, and what it says.
    ///
    /// # Errors
    /// [`CliError`] if a file is gone or cannot be written.
    pub(super) fn write_result(
        &self,
        files: &ReportFiles,
        arrays: &[PathBuf],
        result: impl Serialize,
    ) -> Result<(PathBuf, Value), CliError> {
        let mut record = self.record(&files.meshes, Some(&files.tables), result);
        record.arrays = digests(arrays)?;
        self.folder.write_json(&format!("{}.json", self.command), &record)
    }
}

/// Doubts as lines of a summary.
pub(super) fn warnings(doubts: &[String]) -> impl Iterator<Item = String> {
    doubts.iter().map(|text| format!("warning: {text}"))
}

/// `modes.npz`: frequencies, nodes and shapes, ring nodes after those of the mesh.
///
/// # Errors
/// [`CliError`] if it cannot be written.
pub(super) fn write_modes(folder: &OutputFolder, result: &ModesResult) -> Result<PathBuf, ComputeError> {
    let path = folder.path.join("modes.npz");
    write_modes_npz(&path, &result.mode_shapes())?;
    Ok(path)
}

/// `signals.npz`: the columns of the record, then the shaft's speed and its angle since t = 0, which goes on over the turns.
///
/// # Errors
/// [`CliError`] if it cannot be written.
pub(super) fn write_signals<R: Recording>(
    folder: &OutputFolder,
    result: &RunResult<R>,
) -> Result<PathBuf, ComputeError> {
    let path = folder.path.join("signals.npz");
    let record = &result.simulation.record;
    let (rows, layout) = (record.rows(), record.layout());
    let mut npz = NpzWriter::create(&path)?;
    for column in layout.columns() {
        let name = column_name(column).unwrap_or_else(|sensor| &layout.sensors[sensor]);
        let shape = [rows, layout.balls];
        let mut array = npz.begin(name, if column.is_of_balls() { &shape } else { &shape[..1] })?;
        record.read(column, 0..rows, &mut |piece| Ok(array.extend(piece)?))?;
        array.end()?;
    }
    // what the case prescribes, at the instants of the signals
    let shaft = result.machine.shaft_speed();
    let at: [(&str, &dyn Fn(f64) -> f64); 2] =
        [("shaft_speed_hz", &|time| shaft.speed(time) / TAU), ("shaft_angle_rad", &|time| shaft.angle(time))];
    for (name, value) in at {
        let mut array = npz.begin(name, &[rows])?;
        record.read(Column::Time, 0..rows, &mut |times| {
            let values: Vec<f64> = times.iter().map(|&time| value(time)).collect();
            Ok(array.extend(&values)?)
        })?;
        array.end()?;
    }
    npz.finish()?;
    Ok(path)
}

/// `scalogram.npz`: `time_s`, `frequency_hz` and of each sensor its amplitudes \[frequencies x instants\], m/s^2.
///
/// # Errors
/// [`CliError`] if it cannot be written.
pub(super) fn write_scalograms(
    folder: &OutputFolder,
    scalograms: &[SensorScalogram],
) -> Result<Option<PathBuf>, ComputeError> {
    let Some(SensorScalogram { scalogram: axes, .. }) = scalograms.first() else {
        return Ok(None);
    };
    let path = folder.path.join("scalogram.npz");
    let (rows, columns) = (axes.frequency_hz.len(), axes.time_s.len());
    let mut npz = NpzWriter::create(&path)?;
    npz.array("time_s", &axes.time_s)?;
    npz.array("frequency_hz", &axes.frequency_hz)?;
    for of_sensor in scalograms {
        npz.matrix(&of_sensor.sensor, rows, columns, &of_sensor.scalogram.amplitude)?;
    }
    npz.finish()?;
    Ok(Some(path))
}
