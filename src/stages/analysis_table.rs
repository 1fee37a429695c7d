//! Many analysed windows in one table: a row a window, or a row that says why there is none.

use super::WindowAnalysis;
use crate::diagnosis::{Conclusion, Fault};
use crate::report::{Cell, Column, Table};

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
    /// What is said of each part whose order is known, or why nothing is.
    pub parts: Result<Vec<PartFigures>, String>,
    /// Impacts that belong to no part, in words.
    pub unexplained: Vec<String>,
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
    pub fn of(input: &str, window: &WindowAnalysis) -> Self {
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
                speed_hz: diagnosis.map_or(window.speed_hz, |found| found.speed_hz),
                rms: window.rms,
                unit: window.unit.clone(),
                kurtosis: window.kurtosis,
                parts,
                unexplained: unexplained.collect(),
            }),
        }
    }

    /// Row of a file, or of a channel of it, that was not analysed.
    #[must_use]
    pub fn failed(input: &str, channel: &str, why: String) -> Self {
        Self {
            input: input.to_owned(),
            channel: channel.to_owned(),
            found: Err(why),
        }
    }

    /// What is indicated: parts, `none`, `no verdict` or `not analysed`.
    #[must_use]
    pub fn indicated(&self) -> String {
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

    /// Why there is no verdict; empty where there is one.
    #[must_use]
    pub fn remark(&self) -> &str {
        match &self.found {
            Ok(figures) => match &figures.parts {
                Ok(_) if figures.is_judged() => "",
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
    pub fn is_judged(&self) -> bool {
        let parts = self.parts.iter().flatten();
        parts.into_iter().any(|part| part.probability.is_some())
    }

    /// Names of the parts of which this is said.
    #[must_use]
    pub fn names(&self, conclusion: Conclusion) -> Vec<&'static str> {
        let parts = self.parts.iter().flatten();
        let parts = parts.filter(|part| part.conclusion == conclusion);
        parts.map(|part| part.fault.name()).collect()
    }

    fn part(&self, fault: Fault) -> Option<&PartFigures> {
        let mut parts = self.parts.iter().flatten();
        parts.find(|part| part.fault == fault)
    }
}

/// The table of the rows, in their order; numbers whole in files.
#[must_use]
pub fn analysis_table(rows: &[AnalysisRow]) -> Table {
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
    let table = Table::new("Verdicts", columns);
    rows.iter().fold(table, |table, row| table.row(cells(row)))
}

fn cells(row: &AnalysisRow) -> Vec<Cell> {
    let number = |value: Option<f64>, digits| {
        value.map_or_else(|| Cell::text(""), |value| Cell::number(value, digits))
    };
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
