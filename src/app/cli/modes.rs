//! `plummer modes`: eigenfrequencies and their verification.
//!
//! Comparisons with other modes and the convergence of the mesh, as lines for a reader.

use super::report::ReportFiles;
use super::results::{Job, warnings, write_modes};
use super::{CliError, Outcome, typed};
use crate::app::commands::modes::{
    FileComparison, LoneMode, MeshConvergence, ModesResult, Reading, SequenceMesh, completeness, compute_modes,
    error_text, misses_text, mode_numbers, modes_report, plain,
};
use crate::report::{counted, mass_in_words, signed, signed_fixed, significant};

/// Computes the modes of a case and writes `report.html`, its tables, `modes.npz` and, last, `modes.json`.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or a file cannot be written.
pub(super) fn modes(job: &Job<'_>) -> Result<Outcome, CliError> {
    let result = compute_modes(job.case, job.progress)?;
    job.progress.stage("write");
    let report = modes_report(job.case, &result, &typed())?;
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
            let help = match result.unknown() {
                None => "the table names each; modes.expected and modes.compare in the case file hold the limits",
                Some(_) => {
                    "a part may be far thinner than wide, nearly incompressible, or on springs far softer than itself: change it, or leave it out"
                }
            };
            Err(CliError::failed(failures(&result).join("; ")).with_help(help))
        },
    })
}

fn summary(result: &ModesResult) -> String {
    let survey = &result.survey;
    let check = survey.basis.count_check;
    let mut first = format!("{} degrees of freedom, {}", survey.dof, counted(survey.basis.rigid_modes, "rigid mode"));
    if survey.basis.rigid_modes == survey.basis.count() {
        first.push_str(" (all that were asked for)");
    }
    if let Some(mass) = &survey.mass {
        first.push_str(&format!(", {}", mass_in_words(mass.mass, 5)));
    }
    let mut lines = vec![first];
    let imported = result.bodies.iter().flat_map(|bodies| &bodies.imported);
    lines.extend(imported.flat_map(|imported| imported.notes.iter().cloned()));
    lines.extend(warnings(&result.doubts));
    let (_, complete, _) = completeness(check);
    lines.push(format!("{complete}: {} counted, {} found", check.counted, check.found));
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
    }
    for expected in &reading.expected {
        let found = expected.found_hz.map_or_else(|| "none".to_owned(), |hz| format!("{hz:.1}"));
        let error = expected.relative_error.unwrap_or(f64::NAN);
        lines.push(format!(
            "  {:<32} expected {:>8.1}  found {found:>8}  {:>6} %  {}",
            expected.what,
            expected.hz,
            signed_fixed(100.0 * error, 2),
            if expected.ok { "ok" } else { "FAILS" }
        ));
    }
    lines
}

fn listed(frequencies_hz: &[f64]) -> String {
    frequencies_hz.iter().map(|hz| format!("{hz:.2}")).collect::<Vec<_>>().join(" ")
}

/// Modes listed one by one; `modes.json` has all.
const LISTED: usize = 30;

/// What does not hold, a clause each; empty: everything does.
pub(super) fn failures(result: &ModesResult) -> Vec<String> {
    let (mut found, expected) = (Vec::new(), &result.base.expected);
    found.extend(result.unknown());
    let failed = expected.iter().filter(|row| !row.ok).count();
    if failed > 0 {
        found.push(format!(
            "{failed} of {} expected eigenfrequencies were not found within their tolerance",
            expected.len()
        ));
    }
    for comparison in result.comparisons.iter().filter(|comparison| !comparison.ok) {
        let [agree, judged] = comparison.agreeing();
        let mut text =
            format!("{agree} of {judged} modes agree with {} ({})", comparison.what, comparison.file.display());
        if comparison.missing_here() > 0 {
            text.push_str(&format!(", {} of its modes were not found here", comparison.missing_here()));
        }
        found.push(text);
    }
    found
}

/// Lines of the summary.
pub(super) fn check_lines(result: &ModesResult) -> Vec<String> {
    let mut lines: Vec<String> = result.comparisons.iter().flat_map(compared).collect();
    lines.extend(result.convergence.iter().flat_map(converged));
    lines
}

fn compared(comparison: &FileComparison) -> Vec<String> {
    let points = &comparison.points;
    let mut lines = vec![
        format!(
            "against {} ({}): {} points in common (here {}, there {}), MAC >= {}, within {} %",
            comparison.what,
            comparison.file.display(),
            points.matched,
            points.here,
            points.there,
            comparison.mac_limit,
            plain(100.0 * comparison.within),
        ),
        format!(
            "  {:<12} {:>12}  {:<12} {:>12}  {:>12}  {:>7}",
            "mode here", "Hz", "mode there", "Hz", "difference", "MAC"
        ),
    ];
    // what fails is always listed
    for (row, pair) in comparison.pairs.iter().enumerate() {
        if row >= LISTED && pair.misses.is_empty() {
            continue;
        }
        let difference = pair.relative_difference.map(|difference| format!("{} %", signed(100.0 * difference, 3)));
        let fails = if pair.misses.is_empty() { "" } else { "FAILS: " };
        lines.push(format!(
            "  {:<12} {:>12.3}  {:<12} {:>12.3}  {:>12}  {:>7.4}  {}",
            mode_numbers(&pair.here),
            pair.here_hz,
            mode_numbers(&pair.there),
            pair.there_hz,
            difference.as_deref().unwrap_or("no stiffness"),
            pair.mac,
            format_args!("{fails}{}", misses_text(&pair.misses)),
        ));
    }
    if comparison.pairs.len() > LISTED {
        lines.push("  all pairs are in modes.json".to_owned());
    }
    if comparison.pairs.is_empty() {
        lines.push("  FAILS: no two modes are alike".to_owned());
    }
    lines.extend(lone("here", &comparison.lone_here));
    lines.extend(lone("there", &comparison.lone_there));
    lines
}

/// Modes without a partner: those that are missing one by one, of the others their number.
fn lone(side: &str, modes: &[LoneMode]) -> Vec<String> {
    let missing = modes.iter().filter(|mode| mode.missing);
    let mut lines: Vec<String> =
        missing.map(|mode| format!("  mode {} {side}, {:.3} Hz: FAILS: no partner", mode.mode + 1, mode.hz)).collect();
    let rest = modes.iter().filter(|mode| !mode.missing).count();
    if rest > 0 {
        lines.push(format!("  modes {side} beyond the other side's range, not judged: {rest}"));
    }
    lines
}

fn converged(found: &MeshConvergence) -> Vec<String> {
    let size = |mesh: &SequenceMesh| {
        let own = if mesh.own { " (this case)" } else { "" };
        format!("{} mm{own}", significant(1e3 * mesh.element_size_m, 3))
    };
    let sizes: Vec<String> = found.meshes.iter().map(size).collect();
    let mut lines = vec![
        format!(
            "convergence over {} meshes, h = {}; order promised: {}",
            found.meshes.len(),
            sizes.join(", "),
            plain(found.formal_order)
        ),
        format!(
            "  {:<6} {:>12}  {:>12}  {:>6}  {}",
            "mode", "this mesh Hz", "estimate Hz", "order", "error of this mesh"
        ),
    ];
    for (row, mode) in found.modes.iter().enumerate() {
        if row >= LISTED && mode.mesh_error.is_some() {
            continue;
        }
        let limit = mode.limit.as_ref();
        let own = found.meshes.iter().zip(&mode.frequencies_hz);
        let own = own.filter(|(mesh, _)| mesh.own).find_map(|(_, hz)| *hz);
        let number = |value: Option<f64>, decimals: usize| {
            value.map_or_else(|| "-".to_owned(), |value| format!("{value:.decimals$}"))
        };
        lines.push(format!(
            "  {:<6} {:>12}  {:>12}  {:>6}  {}, {}",
            mode.mode + 1,
            number(own, 3),
            number(limit.and_then(|limit| limit.estimate), 3),
            number(limit.and_then(|limit| limit.order), 2),
            error_text(mode),
            limit.map_or("on no other mesh of its kind", |limit| limit.behaviour.describe()),
        ));
    }
    if found.modes.len() > LISTED {
        lines.push("  all modes are in modes.json".to_owned());
    }
    lines.extend(found.notes.iter().map(|note| format!("  {note}")));
    lines
}
