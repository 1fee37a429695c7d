//! Many analysed windows in a report: counts, one table, and the windows themselves where they are few.

use super::report::window_section;
use super::table::{AnalysisRow, analysis_table};
use super::window::WindowAnalysis;
use crate::report::{Report, Section, Verdict};
use crate::signal::diagnosis::Conclusion;

/// Most windows or sensors that a report shows with their plots.
pub const SHOWN_WINDOWS: usize = 12;

/// A window's section in a report of many files.
pub(crate) fn survey_section(input: &str, window: &WindowAnalysis) -> Section {
    let mut section = window_section(window);
    section.title = format!("{input}: {}", section.title);
    section
}

/// Composes the report of `inputs` files: the table of their rows, then the sections of the windows, if they are at most
/// [`SHOWN_WINDOWS`]; `command` is the line that made it.
pub(crate) fn survey_report(
    inputs: usize,
    rows: &[AnalysisRow],
    sections: Vec<Section>,
    assumptions: &[String],
    command: &str,
) -> Report {
    let failed = rows.len() - windows(rows);
    let title = format!("{inputs} files and folders");
    let mut report = Report::new(title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Diagnosis of ball bearings by their vibration signals");
    report = counts(report, rows).section(verdicts(rows, "Analyse a file alone to see its spectra."));
    if failed > 0 {
        report = report.warning(format!("{failed} rows have no window: their last column says why."));
    }
    if windows(rows) <= SHOWN_WINDOWS {
        report.sections.extend(sections);
    }
    report.assumptions.extend_from_slice(assumptions);
    report
}

fn windows(rows: &[AnalysisRow]) -> usize {
    rows.iter().filter(|row| row.found.is_ok()).count()
}

/// How many windows there are, and what is said of how many, on top of a report.
pub(crate) fn counts(report: Report, rows: &[AnalysisRow]) -> Report {
    let count = |wanted: &dyn Fn(&WindowAnalysis) -> bool| {
        let windows = rows.iter().filter_map(|row| row.found.as_ref().ok());
        windows.filter(|window| wanted(window)).count().to_string()
    };
    let indicated = |window: &WindowAnalysis| window.parts(Conclusion::Named).next().is_some();
    report
        .headline("Windows analysed", count(&|_| true), Verdict::None)
        .headline("Windows with a fault indicated", count(&indicated), Verdict::None)
        .headline("Windows without a verdict", count(&|window| !window.is_judged()), Verdict::None)
}

/// All windows in one table; `instead` says how to see one of them where they are too many to be shown.
pub(crate) fn verdicts(rows: &[AnalysisRow], instead: &str) -> Section {
    let section = Section::new("Verdicts").table(analysis_table(rows));
    match windows(rows) {
        ..=SHOWN_WINDOWS => section,
        windows => section.paragraph(format!(
            "This report has no plots of windows: there are {windows}, and it shows at most {SHOWN_WINDOWS}. {instead}"
        )),
    }
}
