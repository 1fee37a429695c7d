//! One file or folder, analysed.

use std::path::Path;

use super::baseline::{Baseline, analyse};
use super::source::{Source, Unnamed};
use super::{AnalyzeArguments, claim, warn, write_results};
use crate::app::cli::{CliError, Options, Outcome, OutputFolder, Progress, typed};
use crate::app::commands::analyze::{
    AnalysisResult, AnalysisRow, InputSummary, WindowAnalysis, WindowChange, analysis_report, verdict_lines,
};
use crate::app::commands::parts::{not_shown, with_details, with_entries};
use crate::signal::diagnosis::{ChangeConclusion, change_words};

/// Analyses an input into a folder.
///
/// # Errors
/// As [`analyze`](super::analyze).
pub(super) fn single(
    input: &Path,
    asked: &AnalyzeArguments,
    options: &Options,
    folder: &OutputFolder,
) -> Result<Outcome, CliError> {
    let started = std::time::Instant::now();
    let progress = Progress::new(options.shows_progress());
    progress.stage("read");
    let source = Source::open(asked, input, Unnamed::Only, options)?;
    let baseline = Baseline::open(asked, options)?;
    let mut doubts = source.doubts.clone();
    doubts.extend(baseline.iter().flat_map(Baseline::doubts));
    warn(&doubts, options);
    let asked_digest = claim(folder, asked, options)?;
    progress.stage("analyse");
    let mut windows = Vec::new();
    for signal in &source.signals {
        windows.extend(analyse(baseline.as_ref(), input, &source, signal)?);
    }
    progress.stage("write");
    let name = input.display().to_string();
    let truth = |window: &_| source.simulated().and_then(|case| not_shown(case, window));
    let report = analysis_report(&title(input, asked, &source), source.inputs(), &windows, truth, &typed());
    let mut report = match &source.case {
        Some(case) => with_details(report, case),
        None => with_entries(report, source.details()),
    };
    report.assumptions.extend_from_slice(&source.assumptions);
    report.warnings.extend(asked.doubts());
    report.warnings.extend(doubts);
    let orders = source.defect_orders(input, windows.first())?;
    let rows: Vec<AnalysisRow> = windows.into_iter().map(|window| AnalysisRow::of(&name, window)).collect();
    let windows: Vec<&WindowAnalysis> = rows.iter().filter_map(|row| row.found.as_ref().ok()).collect();
    let (result, written) = write_results(folder, &progress, started, report, &rows, |head| AnalysisResult {
        head,
        input: InputSummary {
            defect_orders: Some(orders),
            case: source.case.as_ref().map(|case| case.source.path.display().to_string()),
            input: name,
        },
        asked_digest,
        windows: windows.clone(),
    })?;
    Ok(Outcome { summary: summary(&windows, truth), result, written, verdict: verdict(&windows) })
}

/// What was judged, in which file.
fn title(input: &Path, asked: &AnalyzeArguments, source: &Source) -> String {
    let file = input.canonicalize().unwrap_or_else(|_| input.to_owned());
    let file = file.file_name().unwrap_or(input.as_os_str()).to_string_lossy();
    let named = asked.bearing.as_ref().map_or("Bearing".to_owned(), |name| format!("Bearing {}", name.display()));
    let judged = source.case.as_ref().map_or(named, |case| case.title.clone());
    match source.signals.as_slice() {
        [one] => format!("{judged}: {file}, channel {}", one.name),
        all => format!("{judged}: {file}, {} channels", all.len()),
    }
}

fn verdict(windows: &[&WindowAnalysis]) -> Result<(), CliError> {
    if windows.iter().any(|window| window.is_judged()) {
        return Ok(());
    }
    let reason = windows.iter().find_map(|window| match &window.diagnosis {
        Ok(diagnosis) => Some(diagnosis.faults.first()?.why.clone()),
        Err(reason) => Some(reason.clone()),
    });
    Err(no_part_judged(reason.as_deref().unwrap_or("no orders")))
}

/// No verdict at all.
pub(super) fn no_part_judged(reason: &str) -> CliError {
    CliError::failed(format!("no part could be judged in any window: {reason}")).with_help(
        "where the window is too short, take a longer --window; where lines coincide, check --bearing or --orders, and --speed",
    )
}

/// What grew, and the RMS.
fn change_lines(change: &WindowChange) -> Vec<String> {
    let mut lines: Vec<String> = change.warnings.iter().map(|text| format!("  warning: {text}")).collect();
    let mut grew = change.with(ChangeConclusion::Grew).peekable();
    if grew.peek().is_none() {
        let compared = change.lines.iter().any(|line| line.change_db.is_some());
        let what = if compared { "nothing grew since" } else { "the lines of no part can be compared with" };
        lines.push(format!("  {what} {}", change.baseline));
    }
    lines.extend(grew.map(|line| format!("  {} grew since {}: {}", line.name, change.baseline, line.words())));
    if let Some(rms) = change.levels.first() {
        let words = change_words(rms.change_db, rms.interval_db);
        lines.push(format!("  RMS {}: {words}", rms.conclusion.words()));
    }
    lines
}

fn summary(windows: &[&WindowAnalysis], truth: impl Fn(&WindowAnalysis) -> Option<String>) -> String {
    let mut lines = Vec::new();
    for window in windows {
        lines.extend(verdict_lines(window, &truth));
        lines.extend(window.change.iter().flat_map(change_lines));
    }
    lines.join("\n")
}
