//! `plummer frf`: transfer paths.

use super::analyze::warn;
use super::report::ReportFiles;
use super::results::Job;
use super::{CliError, Outcome, typed};
use crate::app::commands::frf::{FrfResult, TransferPath, compute_frf, frf_report};
use crate::report::{counted, significant};

/// Computes the transfer paths of a case and writes the report, its tables, `frf.uff` and, last, `frf.json`.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or a file cannot be written.
pub(super) fn frf(job: &Job<'_>) -> Result<Outcome, CliError> {
    let Job { case, progress, .. } = *job;
    let result = compute_frf(case, progress)?;
    progress.stage("write");
    let report = frf_report(case, &result, &typed())?;
    let files = ReportFiles::write(&job.folder, "frf", case, report, progress)?;
    let uff = job.folder.path.join("frf.uff");
    result.write_uff(&uff, case)?;
    let (path, json) = job.write_result(&files, &[], result.summary())?;
    progress.finish();
    warn(&result.doubts, job.options);
    Ok(Outcome {
        summary: summary(&result),
        result: json,
        written: [vec![path, uff], files.paths].concat(),
        verdict: verdict(&result),
    })
}

fn verdict(result: &FrfResult) -> Result<(), CliError> {
    if result.passes() {
        return Ok(());
    }
    let found = |(how, at): (&str, Option<(f64, f64)>)| {
        let (hz, error) = at.filter(|&(_, error)| error > result.target)?;
        Some(format!("{how} {} at {hz:.0} Hz", significant(error, 2)))
    };
    let errors = [
        ("estimated error", result.largest_estimate()),
        ("difference from the full model", result.largest_difference()),
    ];
    let misses: Vec<String> = errors.into_iter().filter_map(found).collect();
    Err(CliError::failed(format!(
        "the reduced responses miss the target {}: {}",
        significant(result.target, 2),
        misses.join(", ")
    ))
    .with_help(
        "close to zeros of a response, and on paths that carry little, small differences are large: ask for the other paths alone, narrow frf.band_hz, or raise condense.fixed_interface_modes",
    ))
}

fn summary(result: &FrfResult) -> String {
    let element = result.housing.element();
    let mut lines = vec![format!(
        "{} at {} from {:.0} to {:.0} Hz; {} interface coordinates, {}",
        counted(result.paths.len(), "path"),
        counted(result.response.frequencies_hz().len(), "frequency"),
        result.band_hz[0],
        result.band_hz[1],
        element.interface_dof,
        counted(element.modal_dof(), "vector")
    )];
    for path in &result.paths {
        if path.is_closed() {
            lines.push(format!("{} to {}: {}", path.from, path.to, TransferPath::CLOSED));
            continue;
        }
        let shares = path.shares.modes.iter().take(3);
        // a negative share below half a percent is zero, not "-0"
        let modes =
            shares.map(|share| format!("{:.0} Hz ({:.0} %)", share.frequency_hz, (100.0 * share.share).round() + 0.0));
        let modes: Vec<String> = modes.collect();
        lines.push(format!("{} to {}: largest modal contributions: {}", path.from, path.to, modes.join(", ")));
    }
    if let Some((hz, error)) = result.largest_estimate() {
        lines.push(format!("estimated error of the responses: up to {}, at {hz:.0} Hz", significant(error, 2)));
    }
    if let Some((hz, difference)) = result.largest_difference() {
        lines.push(format!(
            "against the full model at {}: up to {}, at {hz:.0} Hz",
            counted(result.compared.len(), "frequency"),
            significant(difference, 2)
        ));
    }
    for ranked in &result.ranking {
        let path = &result.paths[ranked.path];
        if let Some(quietest) = ranked.variants.first() {
            lines.push(format!("{} to {}: least transmitted by \"{}\"", path.from, path.to, quietest.name));
        }
    }
    lines.join("\n")
}
