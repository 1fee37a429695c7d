//! The table of many windows on a terminal: a line a row.

use crate::app::commands::analyze::{AnalysisRow, WindowFigures};
use crate::report::significant;
use crate::signal::diagnosis::Conclusion;

const HEAD: [&str; 8] =
    ["file", "channel", "window s", "speed Hz", "RMS", "kurtosis", "indicated", "not enough evidence"];
/// Columns of numbers, which end at the same place.
const NUMBERS: std::ops::Range<usize> = 3..6;
const GAP: &str = "  ";

/// The rows, aligned, under a head.
pub(super) fn table(rows: &[AnalysisRow]) -> String {
    let head = HEAD.map(str::to_owned);
    let cells: Vec<[String; 8]> = std::iter::once(head).chain(rows.iter().map(cells)).collect();
    let mut widths = [0; 8];
    // what a row without a window says is as long as it is
    let whole = cells.iter().zip(std::iter::once(true).chain(rows.iter().map(|row| row.found.is_ok())));
    for (row, whole) in whole {
        let measured = if whole { HEAD.len() } else { 2 };
        for (width, cell) in widths.iter_mut().zip(row).take(measured) {
            *width = (*width).max(cell.chars().count());
        }
    }
    let line = |row: &[String; 8]| {
        let cells = row.iter().zip(widths).enumerate().map(|(place, (cell, width))| match NUMBERS.contains(&place) {
            true => format!("{cell:>width$}"),
            false => format!("{cell:<width$}"),
        });
        cells.collect::<Vec<_>>().join(GAP).trim_end().to_owned()
    };
    let mut lines: Vec<String> = cells.iter().map(line).collect();
    lines.extend(rows.iter().filter_map(grown));
    lines.join("\n")
}

/// What grew since the baseline, in a line.
fn grown(row: &AnalysisRow) -> Option<String> {
    let change = row.found.as_ref().ok()?.change.as_ref()?;
    let grew = change.grew.join(", ");
    let text = format!("{} {}: grew since {}: {grew}", row.input, row.channel, change.baseline);
    (!change.grew.is_empty()).then(|| one_line(&text))
}

fn cells(row: &AnalysisRow) -> [String; 8] {
    let [input, channel] = [&row.input, &row.channel].map(|text| one_line(text));
    let figures = match &row.found {
        Ok(figures) => figures,
        Err(why) => {
            let none = String::new;
            let said = format!("not analysed: {}", one_line(why));
            return [input, channel, said, none(), none(), none(), none(), none()];
        }
    };
    let not_enough = match (&figures.parts, figures.is_judged()) {
        (Ok(_), true) => unclear(figures, row.remark()),
        _ => one_line(row.remark()),
    };
    [
        input,
        channel,
        format!("{}-{}", short(figures.from), short(figures.to)),
        significant(figures.speed_hz, 4),
        significant(figures.rms, 3),
        figures.kurtosis.map_or_else(String::new, |value| significant(value, 3)),
        indicated(row, figures),
        not_enough,
    ]
}

/// A time to the millisecond, without zeros that say nothing.
fn short(time: f64) -> f64 {
    (1e3 * time).round() / 1e3
}

/// Parts that are indicated, with the strength of their lines.
fn indicated(row: &AnalysisRow, figures: &WindowFigures) -> String {
    let parts = figures.parts.iter().flatten();
    let named = parts.filter(|part| part.conclusion == Conclusion::Named);
    let named: Vec<String> = named
        .map(|part| {
            let strength = part.strength_db.map(|db| format!(" {db:.0} dB"));
            format!("{}{}", part.fault.name(), strength.unwrap_or_default())
        })
        .collect();
    if named.is_empty() { row.indicated() } else { named.join(", ") }
}

/// What is between, impacts that belong to no part, and a speed that nothing confirms.
fn unclear(figures: &WindowFigures, remark: &str) -> String {
    let parts = figures.names(Conclusion::NotEnough).into_iter().map(str::to_owned);
    let impacts = figures.unexplained.iter().map(|text| format!("of no part: {text}"));
    let remark = (!remark.is_empty()).then(|| one_line(remark));
    let said = parts.chain(impacts).chain(remark);
    said.collect::<Vec<_>>().join(", ")
}

/// A name or a message without what would break the line.
fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::commands::analyze::PartFigures;
    use crate::signal::diagnosis::Fault;

    #[test]
    fn columns_are_aligned_and_a_row_is_a_line() {
        let part = |fault, conclusion, probability| PartFigures {
            fault,
            conclusion,
            probability,
            strength_db: probability.map(|_| 21.6),
        };
        let row = |input: &str, parts: Result<Vec<PartFigures>, String>| AnalysisRow {
            input: input.to_owned(),
            channel: "P1".to_owned(),
            found: Ok(WindowFigures {
                from: 0.0,
                to: 10.0,
                speed_hz: 29.953,
                speed_doubt: None,
                rms: 0.123_45,
                unit: "g".to_owned(),
                kurtosis: Some(3.0),
                parts,
                change: None,
                unexplained: vec!["88.20 Hz (order 2.945) with 4 harmonics".to_owned()],
            }),
        };
        let rows = [
            row(
                "a.csv",
                Ok(vec![
                    part(Fault::OuterRace, Conclusion::Named, Some(1e-9)),
                    part(Fault::Ball, Conclusion::NotEnough, Some(1e-2)),
                ]),
            ),
            row("longer.csv", Ok(vec![part(Fault::Cage, Conclusion::NotEnough, None)])),
            row("c.csv", Err("two\nlines".to_owned())),
            AnalysisRow::failed("d\u{1b}.csv", "", "no such file".to_owned()),
        ];
        let expected = "\
file        channel  window s  speed Hz    RMS  kurtosis  indicated         not enough evidence
a.csv       P1       0-10         29.95  0.123      3.00  outer race 22 dB  ball, of no part: 88.20 Hz (order 2.945) with 4 harmonics
longer.csv  P1       0-10         29.95  0.123      3.00  no verdict        too short for a verdict on any part
c.csv       P1       0-10         29.95  0.123      3.00  no verdict        two lines
d .csv               not analysed: no such file";
        assert_eq!(table(&rows), expected);
    }
}
