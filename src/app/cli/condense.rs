//! `plummer condense`: a superelement and its certificate.

use super::report::ReportFiles;
use super::results::{Job, warnings};
use super::{CliError, Outcome, typed};
use crate::app::commands::condense::{Comparison, CondenseResult, compute_condense, condense_report, imported_report};
use crate::app::error::ComputeError;
use crate::app::scene::{Boundary, ImportedHousing, contrast};
use crate::fe::reduction::{Bound, Check};
use crate::formats::write_superelement_npz;
use crate::report::{significant, trimmed};

/// Condenses the housing of a case and writes `report.html`, its tables, `superelement.npz` and, last, `condense.json`.
/// A superelement from a file is checked instead.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or a file cannot be written.
pub(super) fn condense(job: &Job<'_>, compare_full: bool) -> Result<Outcome, CliError> {
    let Job { case, progress, .. } = *job;
    let comparison = if compare_full { Comparison::Full } else { Comparison::None };
    if let Some(path) = case.superelement() {
        progress.stage("check");
        let (imported, _) = ImportedHousing::read(case, path)?;
        return check_imported(job, &imported);
    }
    let result = compute_condense(case, comparison, progress)?;
    progress.stage("write");
    let report = condense_report(case, &result, &typed());
    let files = ReportFiles::write(&job.folder, "condense", case, report, progress)?;
    let element = job.folder.path.join("superelement.npz");
    write_superelement_npz(&element, &result.record(case)?).map_err(ComputeError::from)?;
    let (path, json) = job.write_result(&files, &[], result.summary())?;
    Ok(Outcome {
        summary: summary(&result),
        result: json,
        written: [vec![path, element], files.paths].concat(),
        verdict: verdict(
            &result.checks,
            &[Some(format!(
                "{} or a narrower band (accuracy.band_hz) mend errors in the band; other checks fail where a part is loose or held very softly, or elements are nearly flat: see the report",
                match result.interface {
                    None => "more vectors (condense.fixed_interface_modes)",
                    Some(_) => "more coordinates (condense.interface_modes, condense.fixed_interface_modes)",
                }
            )), contrast(case)].into_iter().flatten().collect::<Vec<_>>().join("\n"),
        ),
    })
}

/// What is condensed already is checked, no more: `report.html` and, last, `condense.json`.
fn check_imported(job: &Job<'_>, imported: &ImportedHousing) -> Result<Outcome, CliError> {
    job.progress.stage("write");
    let report = imported_report(job.case, imported, &typed());
    let files = ReportFiles::write(&job.folder, "condense", job.case, report, job.progress)?;
    let (path, json) = job.write_result(&files, &[], imported.summary())?;
    let mut lines = imported.notes.clone();
    lines.extend(check_lines(&imported.checks));
    Ok(Outcome {
        summary: lines.join("\n"),
        result: json,
        written: [vec![path], files.paths].concat(),
        verdict: verdict(&imported.checks, "`modes` and `run` refuse these matrices"),
    })
}

fn verdict(checks: &[Check], help: &str) -> Result<(), CliError> {
    let failed: Vec<String> = checks
        .iter()
        .filter(|check| !check.ok())
        .map(|check| {
            let bound = match check.bound {
                Bound::AtMost => "at most",
                Bound::AtLeast => "at least",
            };
            let [value, limit] = [check.value, check.limit].map(|value| trimmed(value, 4));
            format!("{}: found {value}, expected {bound} {limit} ({})", check.name, check.what)
        })
        .collect();
    if failed.is_empty() { Ok(()) } else { Err(CliError::failed(failed.join("; ")).with_help(help)) }
}

fn summary(result: &CondenseResult) -> String {
    let (element, basis) = (&result.stage.condensed.superelement, &result.stage.condensed.basis);
    let of_modes = result.interface.as_ref().map(|interface| {
        format!(
            "{} modes of the interface in place of its coordinates: frequencies up to {} higher, on average {:.0} % of \
             the interface's static flexibility lost",
            interface.reduction.kept(),
            significant(interface.largest_rise(), 2),
            100.0 * interface.lost.mean
        )
    });
    let mut lines = vec![
        format!(
            "{} interface coordinates, {} fixed-interface modes, {} residual vectors, for {} interior degrees of freedom",
            element.interface_dof,
            basis.count() - basis.residual_vectors,
            basis.residual_vectors,
            result.stage.condensed.substructure.interior_dof()
        ),
        format!(
            "estimated error of the {} frequencies up to {:.0} Hz: {}",
            result.estimate.modes.len(),
            result.estimate.band_hz,
            significant(result.estimate.largest(), 2)
        ),
    ];
    lines.splice(1..1, of_modes);
    lines.extend(warnings(&result.doubts));
    if let Boundary::Nodes(nodes) = &result.stage.boundary
        && !nodes.held.is_empty()
    {
        lines.push(format!(
            "{} displacements of the interface's nodes are no coordinates: held by {}",
            nodes.held.len(),
            nodes.holders(&result.stage.housing.model)
        ));
    }
    if let Some(full) = &result.full {
        let errors = full.relative_errors.iter().flatten();
        let largest = errors.fold(0.0_f64, |largest, error| largest.max(error.abs()));
        lines.push(format!("error against the full model: {}", significant(largest, 2)));
    }
    lines.extend(check_lines(&result.checks));
    lines.join("\n")
}

/// How many checks pass, and which do not.
fn check_lines(checks: &[Check]) -> Vec<String> {
    let failed = || checks.iter().filter(|check| !check.ok());
    let passed = checks.len() - failed().count();
    let mut lines = vec![format!("checks passed: {passed} of {}", checks.len())];
    lines.extend(failed().map(|check| format!("  {} FAILS: {}: {}", check.name, check.what, trimmed(check.value, 4))));
    lines
}
