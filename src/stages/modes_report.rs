//! The report of `plummer modes`.

use super::drawing::{draw, draw_housing};
use super::tables::{
    assumptions, bearing_table, equilibrium_table, expected_table, mode_table, model_facts,
};
use super::{ModesResult, Reading, StageError, bearing_setup, contact_table};
use crate::case::Case;
use crate::report::{Cell, Column, Report, Section, Table, Verdict, significant};

/// Composes the report; `command` is the line that made it.
///
/// # Errors
/// [`StageError`] if the case's bearing cannot be built.
pub fn modes_report(
    case: &Case,
    result: &ModesResult,
    command: &str,
) -> Result<Report, StageError> {
    let setup = bearing_setup(case)?;
    let hertz = contact_table(case)?;
    let mut report = Report::new(&case.title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Eigenfrequencies and their verification");
    for expected in &result.base.expected {
        let found = expected.found_hz.map_or_else(
            || "none".to_owned(),
            |hz| format!("{} Hz", significant(hz, 4)),
        );
        report = report.headline(&expected.what, found, Verdict::of(expected.ok));
    }
    let mut frequencies = Section::new("Eigenfrequencies");
    if !result.base.expected.is_empty() {
        frequencies = frequencies.table(expected_table(&result.base.expected));
    }
    frequencies = frequencies.table(mode_table(
        &result.base.unloaded_hz,
        result.base.loaded.as_ref(),
    ));
    report = report.section(frequencies);
    if !result.variants.is_empty() {
        report = report.section(
            Section::new("What each choice does")
                .paragraph("The same case with one choice changed at a time, nearest mode to each expected frequency.")
                .table(variant_table(&result.base, &result.variants)),
        );
    }
    let mut model = Section::new("Model");
    if let Some(stage) = &result.structure {
        model = model
            .drawing(draw(case, stage, setup.as_ref()))
            .facts(model_facts(case, stage));
    }
    if let Some(housing) = &result.housing {
        model = model.drawing(draw_housing(housing));
    }
    report = report.section(model);
    if let Some(setup) = &setup {
        let mut section = Section::new("Bearing").table(bearing_table(setup, hertz.as_ref()));
        if let Some(equilibrium) = &result.base.equilibrium {
            section = section.table(equilibrium_table(equilibrium));
        }
        report = report.section(section);
    }
    for text in assumptions(case, setup.as_ref()) {
        report = report.assumption(text);
    }
    Ok(report)
}

fn variant_table(base: &Reading, variants: &[Reading]) -> Table {
    let expected = &base.expected;
    let mut columns = vec![Column::text("Reading")];
    for expected in expected {
        columns.push(Column::number(
            format!("near {} kHz", significant(expected.hz / 1e3, 3)),
            "Hz",
        ));
    }
    columns.push(Column::number(
        "Modes below 40 kHz without the balls' own",
        "kHz",
    ));
    let mut table = Table::new("Readings side by side", columns);
    for reading in std::iter::once(base).chain(variants) {
        let name = if reading.what.is_empty() {
            "this case"
        } else {
            &reading.what
        };
        let mut cells = vec![Cell::text(name)];
        for expected in &reading.expected {
            let text = match (expected.found_hz, expected.relative_error) {
                (Some(hz), Some(error)) => {
                    format!("{} ({:+.1} %)", significant(hz, 4), 100.0 * error)
                }
                _ => "none".to_owned(),
            };
            cells.push(Cell::text(text).judged(Verdict::of(expected.ok)));
        }
        cells.push(Cell::text(own_modes(reading)));
        table = table.row(cells);
    }
    table
}

fn own_modes(reading: &Reading) -> String {
    let frequencies: Vec<f64> = match &reading.loaded {
        Some(loaded) => loaded
            .modes
            .iter()
            .filter(|mode| !mode.is_ball_mode())
            .map(|mode| mode.frequency_hz)
            .collect(),
        None => reading.unloaded_hz.clone(),
    };
    frequencies
        .iter()
        .filter(|&&hz| hz < 40e3)
        .map(|hz| significant(hz / 1e3, 4))
        .collect::<Vec<_>>()
        .join(", ")
}
