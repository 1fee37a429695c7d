//! Many analysed windows in one table: a row a window, or a row that says why there is none.
//!
//! Many analysed windows in a report: counts, one table, and the windows themselves where they are few.

use super::report::{capital, window_section};
use super::window::WindowAnalysis;
use crate::report::{Cell, Column, Fact, Report, Section, Table, Verdict, pretty_unit, significant};
use crate::signal::diagnosis::{ChangeConclusion, Conclusion, Fault, UnexplainedImpacts};

/// A row of the table.
#[derive(Debug, Clone)]
pub struct AnalysisRow {
    /// File or folder, as it was named.
    pub input: String,
    /// The channel; empty where the file as a whole could not be analysed.
    pub channel: String,
    /// The window without its curves, or why there is none.
    pub found: Result<WindowAnalysis, String>,
}

impl AnalysisRow {
    /// Row of an analysed window.
    pub(crate) fn of(input: &str, window: WindowAnalysis) -> Self {
        let channel = window.sensor.clone();
        Self { input: input.to_owned(), channel, found: Ok(window.without_curves()) }
    }

    /// The verdict in a few words.
    pub(crate) fn headline(&self) -> String {
        match self.found.as_ref().map(|window| &window.diagnosis) {
            Ok(Ok(diagnosis)) => diagnosis.headline(),
            Ok(Err(_)) => "no verdict".to_owned(),
            Err(_) => "not analysed".to_owned(),
        }
    }

    /// What decided it, and what makes the speed doubtful.
    pub(crate) fn reason(&self) -> String {
        match self.found.as_ref().map(|window| window.diagnosis.as_ref()) {
            Ok(Ok(found)) => {
                let doubt =
                    found.speed_doubt().or_else(|| found.speed_change()).map(|doubt| format!("{}.", capital(&doubt)));
                std::iter::once(found.reason()).chain(doubt).collect::<Vec<_>>().join(" ")
            }
            Ok(Err(why)) | Err(why) => why.clone(),
        }
    }
}

/// Impacts that belong to no part, in words.
fn unexplained(window: &WindowAnalysis) -> impl Iterator<Item = String> {
    let impacts = window.diagnosis.iter().flat_map(|found| &found.unexplained);
    impacts.map(|UnexplainedImpacts { frequency_hz, order, harmonics_seen, .. }| {
        format!("{frequency_hz:.2} Hz (order {order:.3}) with {harmonics_seen} harmonics")
    })
}

/// The rows as a page and a terminal show them: narrow.
pub(crate) fn verdicts_table(rows: &[AnalysisRow]) -> Table {
    let change = |row: &AnalysisRow| row.found.as_ref().ok().and_then(|window| window.change.clone());
    let compared = rows.iter().any(|row| change(row).is_some());
    let columns = [
        Column::text("File"),
        Column::text("Channel"),
        Column::text("Window"),
        Column::number("Speed", "Hz"),
        Column::number("RMS", ""),
        Column::number("Kurtosis", ""),
        Column::text("Verdict"),
    ];
    let grew = compared.then(|| Column::text("Grew since the baseline"));
    let columns = columns.into_iter().chain(grew).chain([Column::text("Reason")]);
    // a name or a message without what would break the line
    let plain = |text: &str| Cell::text(text.replace(char::is_control, " "));
    Table::new("Verdicts", columns).rows(rows.iter().map(|row| {
        let window = row.found.as_ref().ok();
        let diagnosis = window.and_then(|window| window.diagnosis.as_ref().ok());
        let speed_hz = diagnosis.map(|found| found.speed_hz).or(window.map(|window| window.speed_hz));
        let time = |time: f64| (1e3 * time).round() / 1e3;
        let span = |window: &WindowAnalysis| format!("{} to {} s", time(window.from), time(window.to));
        let rms = |window: &WindowAnalysis| format!("{} {}", significant(window.rms, 3), pretty_unit(&window.unit));
        let mut cells = vec![
            plain(&row.input),
            plain(&row.channel),
            Cell::text(window.map_or_else(String::new, span)),
            Cell::number_or(speed_hz, 4, ""),
            Cell::text(window.map_or_else(String::new, rms).trim_end()),
            Cell::number_or(window.and_then(|window| window.kurtosis), 3, ""),
            Cell::text(row.headline()),
        ];
        cells.extend(compared.then(|| {
            let change = change(row);
            let lines = change.iter().flat_map(|change| change.with(ChangeConclusion::Grew));
            Cell::text(lines.map(|line| format!("{} {}", line.name, line.words())).collect::<Vec<_>>().join(", "))
        }));
        cells.push(plain(&row.reason()));
        cells
    }))
}

/// The table of the rows, in their order; numbers whole in files. Where any has a change, columns of changes follow the others.
pub(crate) fn analysis_table(rows: &[AnalysisRow]) -> Table {
    let mut columns = vec![
        Column::text("File"),
        Column::text("Channel"),
        Column::number("From", "s"),
        Column::number("To", "s"),
        Column::number("Speed", "Hz"),
        Column::number("RMS", ""),
        Column::text("Unit of the RMS"),
        Column::number("Kurtosis", ""),
        Column::text("Verdict"),
    ];
    for fault in Fault::ALL {
        let name = fault.name();
        columns.push(Column::text(format!("{name}: conclusion")));
        columns.push(Column::number(format!("{name}: probability"), ""));
        columns.push(Column::number(format!("{name}: strength"), "dB"));
    }
    columns.push(Column::text("Impacts that belong to no part"));
    columns.push(Column::text("Reason"));
    let change = |row: &AnalysisRow| row.found.as_ref().is_ok_and(|found| found.change.is_some());
    let compared = rows.iter().any(change);
    if compared {
        columns.push(Column::text("Baseline"));
        for what in std::iter::once("RMS").chain(Fault::ALL.map(Fault::name)) {
            if what != "RMS" {
                columns.push(Column::text(format!("{what}: since the baseline")));
            }
            columns.push(Column::number(format!("{what}: change"), "dB"));
            columns.push(Column::number(format!("{what}: change at least"), "dB"));
            columns.push(Column::number(format!("{what}: change at most"), "dB"));
        }
    }
    let table = Table::new("Verdicts", columns);
    rows.iter().fold(table, |table, row| {
        let mut cells = cells(row);
        if compared {
            cells.extend(change_cells(row));
        }
        table.row(cells)
    })
}

fn change_cells(row: &AnalysisRow) -> Vec<Cell> {
    let change = row.found.as_ref().ok().and_then(|window| window.change.as_ref());
    let figures = |found: Option<(Option<f64>, [Option<f64>; 2])>| {
        let (change_db, [low, high]) = found.unwrap_or_default();
        [change_db, low, high].map(|value| Cell::number_or(value, 4, ""))
    };
    let mut cells = vec![Cell::text(change.map_or("", |change| &change.baseline))];
    let rms = change.and_then(|change| change.levels.first());
    cells.extend(figures(rms.map(|rms| (rms.change_db, rms.interval_db))));
    for fault in Fault::ALL {
        let mut lines = change.into_iter().flat_map(|change| &change.lines);
        let line = lines.find(|line| line.fault == Some(fault));
        cells.push(Cell::text(line.map_or("", |line| line.conclusion.words())));
        cells.extend(figures(line.map(|line| (line.change_db, line.interval_db))));
    }
    cells
}

fn cells(row: &AnalysisRow) -> Vec<Cell> {
    let window = row.found.as_ref().ok();
    let diagnosis = window.and_then(|window| window.diagnosis.as_ref().ok());
    let speed_hz = diagnosis.map(|found| found.speed_hz).or(window.map(|window| window.speed_hz));
    let mut cells = vec![
        Cell::text(&row.input),
        Cell::text(&row.channel),
        Cell::number_or(window.map(|window| window.from), 5, ""),
        Cell::number_or(window.map(|window| window.to), 5, ""),
        Cell::number_or(speed_hz, 5, ""),
        Cell::number_or(window.map(|window| window.rms), 4, ""),
        Cell::text(window.map_or("", |window| &window.unit)),
        Cell::number_or(window.and_then(|window| window.kurtosis), 4, ""),
        Cell::text(row.headline()),
    ];
    for fault in Fault::ALL {
        let mut verdicts = diagnosis.into_iter().flat_map(|found| &found.faults);
        let verdict = verdicts.find(|verdict| verdict.fault == fault);
        cells.push(Cell::text(verdict.map_or("", |verdict| verdict.conclusion.words())));
        cells.push(Cell::number_or(verdict.and_then(|verdict| verdict.false_alarm), 2, ""));
        cells.push(Cell::number_or(verdict.and_then(|verdict| verdict.strength_db), 3, ""));
    }
    let unexplained = window.into_iter().flat_map(unexplained);
    cells.push(Cell::text(unexplained.collect::<Vec<_>>().join("; ")));
    cells.push(Cell::text(row.reason()));
    cells
}

/// Most windows or sensors that a report shows with their plots.
pub const SHOWN_WINDOWS: usize = 12;

/// A window's section in a report of many files.
pub(crate) fn survey_section(input: &str, window: &WindowAnalysis) -> Section {
    let mut section = window_section(window);
    section.title = format!("{input}: {}", section.title);
    section
}

/// What was analysed: a row for each signal (file, channel, length, rate, unit, mean speed), and what is said of all machines.
pub(crate) fn input_section(rows: impl IntoIterator<Item = [Cell; 6]>, machine: Option<&Vec<Fact>>) -> Section {
    let columns = [
        Column::text("File"),
        Column::text("Channel"),
        Column::number("Length", "s"),
        Column::number("Sampling rate", "Hz"),
        Column::text("Unit"),
        Column::number("Mean shaft speed, as given", "Hz"),
    ];
    let section = Section::new("Inputs").table(Table::new("Inputs", columns).rows(rows));
    match machine {
        Some(facts) if !facts.is_empty() => section.facts(facts.iter().cloned()),
        _ => section,
    }
}

/// Composes the report of `inputs` files: the table of their rows, then the sections of the windows, if they are at most
/// [`SHOWN_WINDOWS`]; `command` is the line that made it.
pub(crate) fn survey_report(
    inputs: usize,
    rows: &[AnalysisRow],
    input_section: Section,
    sections: Vec<Section>,
    assumptions: &[String],
    command: &str,
) -> Report {
    let failed = rows.len() - windows(rows);
    let title = format!("{inputs} files and folders");
    let mut report = Report::new(title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Diagnosis of ball bearings by their vibration signals");
    let verdicts = verdicts(rows, "Analyse a file alone to see its spectra.");
    report = counts(report, rows).section(input_section).section(verdicts);
    if failed > 0 {
        report = report.warning(format!("Windows that are missing: {failed}. The table of verdicts says why."));
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
    let section = Section::new("Verdicts").table(verdicts_table(rows));
    match windows(rows) {
        ..=SHOWN_WINDOWS => section,
        windows => section.paragraph(format!(
            "This report has no plots of windows: there are {windows}, and it shows at most {SHOWN_WINDOWS}. {instead}"
        )),
    }
}
