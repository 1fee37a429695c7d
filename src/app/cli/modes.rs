//! `plummer modes`: eigenfrequencies and their verification.

use super::mode_checks::{check_lines, failures};
use super::report_files::ReportFiles;
use super::results::{Job, warnings, write_modes};
use super::{CliError, Outcome};
use crate::app::commands::modes::{ModesResult, Reading, compute_modes, modes_report};

/// Computes the modes of a case and writes `report.html`, its tables, `modes.npz` and, last, `modes.json`.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or a file cannot be written.
pub(super) fn modes(job: &Job<'_>) -> Result<Outcome, CliError> {
    let result = compute_modes(job.case, job.progress)?;
    job.progress.stage("write");
    let report = modes_report(job.case, &result, &job.command_line())?;
    let files = ReportFiles::write(&job.folder, "modes", job.case, report, job.progress)?;
    let shapes = write_modes(&job.folder, &result)?;
    let (path, json) = job.write_result(&files, std::slice::from_ref(&shapes), result.summary())?;
    Ok(Outcome {
        summary: summary(&result),
        result: json,
        written: [vec![path, shapes], files.paths].concat(),
        verdict: if result.passes() {
            Ok(())
        } else {
            Err(CliError::failed(failures(&result).join("; "))
                .with_help("the table names each; modes.expected and modes.compare in the case file hold the limits"))
        },
    })
}

fn summary(result: &ModesResult) -> String {
    let survey = &result.survey;
    let check = survey.basis.count_check;
    let mut first = format!("{} degrees of freedom, {} rigid modes", survey.dof, survey.basis.rigid_modes);
    if survey.basis.rigid_modes == survey.basis.count() {
        first.push_str(" (all that were asked for)");
    }
    if let Some(mass) = &survey.mass {
        first.push_str(&format!(", {:.6e} kg", mass.mass));
    }
    let mut lines = vec![first];
    let imported = result.structure.iter().flat_map(|stage| &stage.imported);
    lines.extend(imported.flat_map(|imported| imported.notes.iter().cloned()));
    lines.extend(warnings(&result.doubts));
    lines.push(match check.above_hz {
        Some(above) => format!(
            "between {above:.2} and {:.2} Hz: {} modes counted, {} found",
            check.below_hz, check.counted, check.found
        ),
        None => format!("below {:.2} Hz: {} modes counted, {} found", check.below_hz, check.counted, check.found),
    });
    lines.extend(crate::app::commands::modes::free_motions(result));
    lines.push(format!("unloaded (Hz): {}", listed(&result.base.unloaded_hz)));
    lines.extend(reading(&result.base));
    for variant in &result.variants {
        lines.push(format!("-- {}", variant.what));
        lines.push(format!("unloaded (Hz): {}", listed(&variant.unloaded_hz)));
        lines.extend(reading(variant));
    }
    lines.extend(check_lines(result));
    lines.join("\n")
}

fn reading(reading: &Reading) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(loaded) = &reading.loaded {
        let own: Vec<f64> =
            loaded.modes.iter().filter(|mode| !mode.is_ball_mode()).map(|mode| mode.frequency_hz).take(8).collect();
        lines.push(format!("loaded (Hz), without the balls' own: {}", listed(&own)));
        if let Some(difference) = reading.condensation_difference {
            lines.push(format!(
                "  housing condensed for the load, which alone moves frequencies by up to {difference:.1e}"
            ));
        }
    }
    for expected in &reading.expected {
        let found = expected.found_hz.map_or_else(|| "none".to_owned(), |hz| format!("{hz:.1}"));
        let error = expected.relative_error.unwrap_or(f64::NAN);
        lines.push(format!(
            "  {:<32} expected {:>8.1}  found {found:>8}  {:+6.2} %  {}",
            expected.what,
            expected.hz,
            100.0 * error,
            if expected.ok { "ok" } else { "FAILS" }
        ));
    }
    lines
}

fn listed(frequencies_hz: &[f64]) -> String {
    frequencies_hz.iter().map(|hz| format!("{hz:.2}")).collect::<Vec<_>>().join(" ")
}
