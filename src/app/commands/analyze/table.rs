//! Many analysed windows in one table: a row a window, or a row that says why there is none.

use super::window::WindowAnalysis;
use super::window::WindowChange;
use crate::report::{Cell, Column, Table};
use crate::signal::diagnosis::{ChangeConclusion, Conclusion, Fault};

/// A row of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct AnalysisRow {
    /// File or folder, as it was named.
    pub input: String,
    /// The channel; empty where the file as a whole could not be analysed.
    pub channel: String,
    /// What was found, or why nothing was.
    pub found: Result<WindowFigures, String>,
}

/// A window in a few figures.
#[derive(Debug, Clone, PartialEq)]
pub struct WindowFigures {
    /// Start, s.
    pub from: f64,
    /// End, s.
    pub to: f64,
    /// Mean speed of the shaft, Hz, as the verdict rests on it.
    pub speed_hz: f64,
    /// Root mean square, in the unit.
    pub rms: f64,
    /// Unit of the signal, where it is known.
    pub unit: String,
    /// Kurtosis; `None` for a constant signal.
    pub kurtosis: Option<f64>,
    /// Why it is no proof of health that nothing is indicated, where the signal does not confirm the speed, or shows another.
    pub speed_doubt: Option<String>,
    /// What is said of each part whose order is known, or why nothing is.
    pub parts: Result<Vec<PartFigures>, String>,
    /// Impacts that belong to no part, in words.
    pub unexplained: Vec<String>,
    /// What changed since an earlier signal, where one was named.
    pub change: Option<ChangeFigures>,
}

/// Changes since an earlier signal in a few figures.
#[derive(Debug, Clone, PartialEq)]
pub struct ChangeFigures {
    /// The earlier signal's file or folder.
    pub baseline: String,
    /// Change of the RMS, dB, with its 95 % interval; `None` where there is none.
    pub rms_db: [Option<f64>; 3],
    /// Of each part that was judged: what is said of its change, and the change in dB with its 95 % interval.
    pub parts: Vec<(Fault, ChangeConclusion, [Option<f64>; 3])>,
    /// What grew, in words: parts, and impacts of no part.
    pub grew: Vec<String>,
}

impl ChangeFigures {
    fn of(change: &WindowChange) -> Self {
        let figures = |change_db, [low, high]: [Option<f64>; 2]| [change_db, low, high];
        let parts = change.lines.iter().filter_map(|line| {
            let figures = figures(line.change_db, line.interval_db);
            Some((line.fault?, line.conclusion, figures))
        });
        let grew = change.with(ChangeConclusion::Grew);
        let rms = change.levels.first();
        Self {
            baseline: change.baseline.clone(),
            rms_db: rms.map_or([None; 3], |rms| figures(rms.change_db, rms.interval_db)),
            parts: parts.collect(),
            grew: grew.map(|line| format!("{} {}", line.name, line.words())).collect(),
        }
    }
}

/// What is said of a part in a few figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartFigures {
    /// The part.
    pub fault: Fault,
    /// What is said of it.
    pub conclusion: Conclusion,
    /// Probability by chance; `None`: the window is too short for this part.
    pub probability: Option<f64>,
    /// Strength of its lines, dB.
    pub strength_db: Option<f64>,
}

impl AnalysisRow {
    /// Row of an analysed window.
    #[must_use]
    pub(crate) fn of(input: &str, window: &WindowAnalysis) -> Self {
        let diagnosis = window.diagnosis.as_ref();
        let parts = diagnosis.map_err(Clone::clone).map(|diagnosis| {
            let part = diagnosis.faults.iter().map(|verdict| PartFigures {
                fault: verdict.fault,
                conclusion: verdict.conclusion,
                probability: verdict.false_alarm,
                strength_db: verdict.strength_db,
            });
            part.collect()
        });
        let impacts = diagnosis.iter().flat_map(|found| &found.unexplained);
        let unexplained = impacts.map(|impacts| {
            format!(
                "{:.2} Hz (order {:.3}) with {} harmonics",
                impacts.frequency_hz, impacts.order, impacts.harmonics_seen
            )
        });
        Self {
            input: input.to_owned(),
            channel: window.sensor.clone(),
            found: Ok(WindowFigures {
                from: window.from,
                to: window.to,
                speed_doubt: diagnosis.ok().and_then(|found| found.speed_doubt().or_else(|| found.speed_change())),
                speed_hz: diagnosis.map_or(window.speed_hz, |found| found.speed_hz),
                rms: window.rms,
                unit: window.unit.clone(),
                kurtosis: window.kurtosis,
                parts,
                unexplained: unexplained.collect(),
                change: window.change.as_ref().map(ChangeFigures::of),
            }),
        }
    }

    /// Row of a file, or of a channel of it, that was not analysed.
    #[must_use]
    pub(crate) fn failed(input: &str, channel: &str, why: String) -> Self {
        Self { input: input.to_owned(), channel: channel.to_owned(), found: Err(why) }
    }

    /// What is indicated: parts, `none`, `no verdict` or `not analysed`.
    #[must_use]
    pub(crate) fn indicated(&self) -> String {
        let Ok(figures) = &self.found else {
            return "not analysed".to_owned();
        };
        let named = figures.names(Conclusion::Named);
        match (named.is_empty(), figures.is_judged()) {
            (false, _) => named.join(", "),
            (true, true) => "none".to_owned(),
            (true, false) => "no verdict".to_owned(),
        }
    }

    /// Why there is no verdict, or none to rely on; empty where there is one.
    #[must_use]
    pub(crate) fn remark(&self) -> &str {
        match &self.found {
            Ok(figures) => match &figures.parts {
                Ok(_) if figures.is_judged() => figures.speed_doubt.as_deref().unwrap_or(""),
                Ok(_) => "too short for a verdict on any part",
                Err(why) => why,
            },
            Err(why) => why,
        }
    }
}

impl WindowFigures {
    /// Whether any part was judged.
    #[must_use]
    pub(crate) fn is_judged(&self) -> bool {
        let parts = self.parts.iter().flatten();
        parts.into_iter().any(|part| part.probability.is_some())
    }

    /// Names of the parts of which this is said.
    #[must_use]
    pub(crate) fn names(&self, conclusion: Conclusion) -> Vec<&'static str> {
        let parts = self.parts.iter().flatten();
        let parts = parts.filter(|part| part.conclusion == conclusion);
        parts.map(|part| part.fault.name()).collect()
    }

    fn part(&self, fault: Fault) -> Option<&PartFigures> {
        let mut parts = self.parts.iter().flatten();
        parts.find(|part| part.fault == fault)
    }
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
        Column::text("Indicated"),
    ];
    for fault in Fault::ALL {
        let name = fault.name();
        columns.push(Column::text(format!("{name}: conclusion")));
        columns.push(Column::number(format!("{name}: probability"), ""));
        columns.push(Column::number(format!("{name}: strength"), "dB"));
    }
    columns.push(Column::text("Impacts that belong to no part"));
    columns.push(Column::text("Remark"));
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
    let change = row.found.as_ref().ok().and_then(|found| found.change.as_ref());
    let number = |value: Option<f64>| value.map_or_else(|| Cell::text(""), |value| Cell::number(value, 4));
    let mut cells = vec![Cell::text(change.map_or_else(String::new, |change| change.baseline.clone()))];
    cells.extend(change.map_or([None; 3], |change| change.rms_db).map(number));
    for fault in Fault::ALL {
        let mut parts = change.into_iter().flat_map(|change| &change.parts);
        let part = parts.find(|part| part.0 == fault);
        cells.push(Cell::text(part.map_or("", |part| part.1.words())));
        cells.extend(part.map_or([None; 3], |part| part.2).map(number));
    }
    cells
}

fn cells(row: &AnalysisRow) -> Vec<Cell> {
    let number = |value: Option<f64>, digits| value.map_or_else(|| Cell::text(""), |value| Cell::number(value, digits));
    let figures = row.found.as_ref().ok();
    let of = |value: fn(&WindowFigures) -> f64| figures.map(value);
    let mut cells = vec![
        Cell::text(row.input.clone()),
        Cell::text(row.channel.clone()),
        number(of(|figures| figures.from), 5),
        number(of(|figures| figures.to), 5),
        number(of(|figures| figures.speed_hz), 5),
        number(of(|figures| figures.rms), 4),
        Cell::text(figures.map_or("", |figures| &figures.unit)),
        number(figures.and_then(|figures| figures.kurtosis), 4),
        Cell::text(row.indicated()),
    ];
    for fault in Fault::ALL {
        let part = figures.and_then(|figures| figures.part(fault));
        let conclusion = part.map_or("", |part| part.conclusion.words());
        cells.push(Cell::text(conclusion));
        cells.push(number(part.and_then(|part| part.probability), 2));
        cells.push(number(part.and_then(|part| part.strength_db), 3));
    }
    let unexplained = figures.map(|figures| figures.unexplained.join("; "));
    cells.push(Cell::text(unexplained.unwrap_or_default()));
    cells.push(Cell::text(row.remark()));
    cells
}
