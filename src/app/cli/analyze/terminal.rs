//! The table of many windows on a terminal: a line a row.

use crate::app::commands::analyze::{AnalysisRow, WindowAnalysis, unexplained};
use crate::report::significant;
use crate::signal::diagnosis::{ChangeConclusion, Conclusion};

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
    let grew = change.with(ChangeConclusion::Grew).map(|line| format!("{} {}", line.name, line.words()));
    let grew: Vec<String> = grew.collect();
    (!grew.is_empty()).then(|| {
        let text = format!("{} {}: grew since {}: {}", row.input, row.channel, change.baseline, grew.join(", "));
        one_line(&text)
    })
}

fn cells(row: &AnalysisRow) -> [String; 8] {
    let [input, channel] = [&row.input, &row.channel].map(|text| one_line(text));
    let window = match &row.found {
        Ok(window) => window,
        Err(why) => {
            let none = String::new;
            let said = format!("not analysed: {}", one_line(why));
            return [input, channel, said, none(), none(), none(), none(), none()];
        }
    };
    let not_enough = if window.is_judged() { unclear(window, &row.remark()) } else { one_line(&row.remark()) };
    let speed_hz = window.diagnosis.as_ref().map_or(window.speed_hz, |found| found.speed_hz);
    [
        input,
        channel,
        format!("{}-{}", short(window.from), short(window.to)),
        significant(speed_hz, 4),
        significant(window.rms, 3),
        window.kurtosis.map_or_else(String::new, |value| significant(value, 3)),
        indicated(row, window),
        not_enough,
    ]
}

/// A time to the millisecond, without zeros that say nothing.
fn short(time: f64) -> f64 {
    (1e3 * time).round() / 1e3
}

/// Parts that are indicated, with the strength of their lines.
fn indicated(row: &AnalysisRow, window: &WindowAnalysis) -> String {
    let named = window.parts(Conclusion::Named).map(|verdict| {
        let strength = verdict.strength_db.map(|db| format!(" {db:.0} dB"));
        format!("{}{}", verdict.fault.name(), strength.unwrap_or_default())
    });
    let named: Vec<String> = named.collect();
    if named.is_empty() { row.indicated() } else { named.join(", ") }
}

/// What is between, impacts that belong to no part, and a speed that nothing confirms.
fn unclear(window: &WindowAnalysis, remark: &str) -> String {
    let parts = window.parts(Conclusion::NotEnough).map(|verdict| verdict.fault.name().to_owned());
    let impacts = unexplained(window).map(|text| format!("of no part: {text}"));
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
    use crate::app::commands::analyze::UsedBand;
    use crate::numerics::series::TimeWindow;
    use crate::report::{Abscissa, Curve};
    use crate::signal::diagnosis::{
        Diagnosis, EnvelopeOrderSpectrum, Fault, FaultVerdict, SpeedSource, UnexplainedImpacts,
    };
    use crate::signal::{AmplitudeSpectrum, EnvelopeSpectrum, WindowFunction};

    fn diagnosis(faults: Vec<FaultVerdict>) -> Diagnosis {
        let impacts = UnexplainedImpacts {
            order: 2.945,
            frequency_hz: 88.2,
            false_alarm: 1e-9,
            harmonics_seen: 4,
            strength_db: None,
            band_hz: [0.0, 1e3],
        };
        let unit = String::new();
        let spectrum =
            EnvelopeOrderSpectrum { order: vec![], amplitude: vec![], unit, turns: 300.0, mean: 0.0, highest: 0.0 };
        Diagnosis {
            envelope: String::new(),
            envelopes: 1,
            spectrum,
            speed_hz: 29.953,
            given_speed_hz: 29.953,
            speed_error: 0.0,
            speed_source: SpeedSource::Exact,
            faults,
            unexplained: vec![impacts],
            by_signal_alone: Vec::new(),
        }
    }

    fn window(diagnosis: Result<Diagnosis, String>) -> WindowAnalysis {
        let spectrum = AmplitudeSpectrum {
            frequency_hz: Vec::new(),
            amplitude: Vec::new(),
            unit: "g".to_owned(),
            window: TimeWindow { from: 0.0, to: 10.0 },
            window_function: WindowFunction::Hann,
            zero_padding: 4.0,
            bin_hz: 0.1,
            resolution_hz: 0.4,
        };
        WindowAnalysis {
            sensor: "P1".to_owned(),
            unit: "g".to_owned(),
            whitened: false,
            from: 0.0,
            to: 10.0,
            speed_hz: 29.953,
            rms: 0.123_45,
            peak: 1.0,
            kurtosis: Some(3.0),
            band: UsedBand::default(),
            outer: Vec::new(),
            smeared_above: None,
            peaks: Vec::new(),
            diagnosis,
            change: None,
            shown: ["P1", "envelope"].map(|name| Curve::new(name, Abscissa::Points(Vec::new()), Vec::new())),
            spectrum: EnvelopeSpectrum { spectrum, high_pass_hz: None },
            lines: Vec::new(),
        }
    }

    #[test]
    fn columns_are_aligned_and_a_row_is_a_line() {
        let part = |fault, conclusion, false_alarm: Option<f64>| FaultVerdict {
            conclusion,
            false_alarm,
            strength_db: false_alarm.map(|_| 21.6),
            expected_order: 3.0,
            fault,
            ..FaultVerdict::default()
        };
        let row = |input: &str, parts: Result<Vec<FaultVerdict>, String>| {
            AnalysisRow::of(input, window(parts.map(diagnosis)))
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
            AnalysisRow {
                input: "d\u{1b}.csv".to_owned(),
                channel: String::new(),
                found: Err("no such file".to_owned()),
            },
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
