//! Results of a case as files: what all have in common; `modes.npz`, `signals.npz`.

use super::report_files::ReportFiles;
use super::{CliError, OutputFolder, Progress};
use crate::app::case::Case;
use crate::app::commands::modes::ModesResult;
use crate::app::commands::result::{CaseResult, ResultHead, VERSION};
use crate::app::commands::run::{Recording, RunResult, SensorScalogram};
use crate::app::error::ComputeError;
use crate::files::FileDigest;
use crate::formats::{NpzWriter, write_modes_npz};
use crate::system::Column;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// What a result says of its computation, `wall_s` (s) after its begin.
pub(super) fn result_head(
    command: &'static str,
    progress: &Progress,
    wall_s: f64,
    tables: Option<&[String]>,
) -> ResultHead {
    let times = progress.times().into_iter();
    ResultHead {
        plummer: VERSION,
        command,
        wall_s,
        stages_s: times.map(|stage| (stage.name, stage.seconds)).collect(),
        threads: rayon::current_num_threads(),
        tables: tables.map(<[String]>::to_vec),
    }
}

/// The result of a case with a report.
pub(super) fn case_result<'a, T>(
    command: &'static str,
    case: &'a Case,
    progress: &Progress,
    wall_s: f64,
    files: &'a ReportFiles,
    result: T,
) -> CaseResult<'a, T> {
    let head = result_head(command, progress, wall_s, Some(&files.tables));
    result_of_case(head, case, &files.meshes, result)
}

/// The result of a case that rests on these meshes.
pub(super) fn result_of_case<'a, T>(
    head: ResultHead,
    case: &'a Case,
    meshes: &'a [FileDigest],
    result: T,
) -> CaseResult<'a, T> {
    CaseResult {
        head,
        case: &case.source.path,
        set: &case.source.set,
        case_digest: case.source.digest().ok(),
        meshes,
        arrays: BTreeMap::new(),
        result,
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
pub(super) fn write_modes(folder: &OutputFolder, result: &ModesResult) -> Result<PathBuf, CliError> {
    let path = folder.path().join("modes.npz");
    write_modes_npz(&path, &result.mode_shapes()).map_err(ComputeError::from)?;
    Ok(path)
}

/// `signals.npz`.
///
/// # Errors
/// [`CliError`] if it cannot be written.
pub(super) fn write_signals<R: Recording>(folder: &OutputFolder, result: &RunResult<R>) -> Result<PathBuf, CliError> {
    let path = folder.path().join("signals.npz");
    let record = &result.simulation.record;
    let (rows, balls, sensors) = (record.rows(), record.balls(), record.sensors());
    let write = || -> Result<(), ComputeError> {
        let mut npz = NpzWriter::create(&path)?;
        for column in Column::all(sensors.len()) {
            let name = match column {
                Column::Time => "time_s",
                Column::ShaftX => "shaft_x",
                Column::ShaftY => "shaft_y",
                Column::Sensor(sensor) => &sensors[sensor],
                Column::BallRadius => "ball_radius",
                Column::OuterForce => "outer_force",
                Column::InnerForce => "inner_force",
            };
            let shape: &[usize] = match column {
                Column::BallRadius | Column::OuterForce | Column::InnerForce => &[rows, balls],
                _ => &[rows],
            };
            let mut array = npz.begin(name, shape)?;
            record.read(column, 0..rows, &mut |piece| Ok(array.extend(piece)?))?;
            array.end()?;
        }
        Ok(npz.finish()?)
    };
    write()?;
    Ok(path)
}

/// `scalogram.npz`: `time_s`, `frequency_hz` and of each sensor its amplitudes \[frequencies x instants\], m/s^2.
///
/// # Errors
/// [`CliError`] if it cannot be written.
pub(super) fn write_scalograms(
    folder: &OutputFolder,
    scalograms: &[SensorScalogram],
) -> Result<Option<PathBuf>, CliError> {
    let Some(SensorScalogram { scalogram: axes, .. }) = scalograms.first() else {
        return Ok(None);
    };
    let path = folder.path().join("scalogram.npz");
    let (rows, columns) = (axes.frequency_hz.len(), axes.time_s.len());
    let write = || -> Result<(), ComputeError> {
        let mut npz = NpzWriter::create(&path)?;
        npz.array("time_s", &axes.time_s)?;
        npz.array("frequency_hz", &axes.frequency_hz)?;
        for of_sensor in scalograms {
            npz.matrix(&of_sensor.sensor, rows, columns, &of_sensor.scalogram.amplitude)?;
        }
        Ok(npz.finish()?)
    };
    write()?;
    Ok(Some(path))
}
