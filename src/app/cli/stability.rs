//! The stability map of `plummer chart`: its files and its lines.

use super::output::json;
use super::report_files::ReportFiles;
use super::results::Job;
use super::{CliError, Outcome, OutputFolder};
use crate::app::commands::result::CaseResult;
use crate::app::error::ComputeError;
use crate::app::scene::Scene;
use crate::app::studies::chart::{
    Condition, Effort, Stability, compute_stability, resonance_plot, stability_map, stability_report,
};
use crate::report::significant;
use std::path::PathBuf;

/// Computes the map alone and writes `stability.svg`, `resonance.svg`, the report, its tables and, last, `stability.json`.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or a file cannot be written.
pub(super) fn alone(job: &Job<'_>, effort: Effort, command: &str) -> Result<Outcome, CliError> {
    let Job { case, progress, ref folder, .. } = *job;
    let run = case.for_chart().map_err(ComputeError::from)?;
    let scene = Scene::with_all_modes(run, progress)?;
    let conditions = Condition::all(case, effort);
    let stability = compute_stability(run, &scene, conditions, effort, progress)?;
    progress.stage("write");
    let report = stability_report(case, &stability, command);
    let files = ReportFiles::write(folder, "stability", case, report, progress)?;
    let record = job.record(&files.meshes, Some(&files.tables), &stability);
    let written = write_stability(folder, &stability, &record)?;
    Ok(Outcome {
        summary: stability_lines(&stability),
        result: json(&record)?,
        written: [written, files.paths].concat(),
        verdict: Ok(()),
    })
}

/// Writes the pictures and `stability.json`; gives the files.
///
/// # Errors
/// [`CliError`] when a file cannot be written.
pub(super) fn write_stability(
    folder: &OutputFolder,
    stability: &Stability,
    record: &CaseResult<'_, &Stability>,
) -> Result<Vec<PathBuf>, CliError> {
    let map = stability_map(stability).to_svg().map_err(ComputeError::from)?;
    let map = folder.write("stability.svg", map.as_bytes())?;
    let resonance = resonance_plot().to_svg().map_err(ComputeError::from)?;
    let resonance = folder.write("resonance.svg", resonance.as_bytes())?;
    let (path, _) = folder.write_json("stability.json", record)?;
    Ok(vec![path, map, resonance])
}

/// The limits of the case as it is, and the range of the measured ones over all conditions.
pub(super) fn stability_lines(stability: &Stability) -> String {
    let mut lines = vec![format!("largest stable steps as given, and over {} conditions:", stability.conditions.len())];
    let micro =
        |step: Option<f64>| step.map_or_else(|| "–".to_owned(), |step| format!("{} µs", significant(1e6 * step, 3)));
    let given = stability.conditions.first();
    let methods = given.and_then(|of| of.methods.as_ref());
    for of in methods.into_iter().flatten().filter(|of| !of.steps.is_empty()) {
        let conditions = stability.conditions.iter();
        let measured = conditions.filter_map(|condition| {
            let all = condition.methods.as_ref()?;
            all.iter().find(|other| other.method == of.method)?.measured_limit_s
        });
        let (low, high) =
            measured.fold((f64::INFINITY, 0.0_f64), |(low, high), limit| (low.min(limit), high.max(limit)));
        let range = if high > 0.0 {
            format!("{} to {}", micro(Some(low)), micro(Some(high)))
        } else {
            of.note.clone().unwrap_or_default()
        };
        lines.push(format!(
            "  {}: predicted {}, measured {}; {range}",
            of.method.name(),
            micro(of.predicted_limit_s),
            micro(of.measured_limit_s)
        ));
    }
    lines.join("\n")
}

#[cfg(test)]
#[path = "stability_tests.rs"]
mod tests;
