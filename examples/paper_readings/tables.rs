//! The study as tables, as a section of the report, and as files of all readings.

use crate::charts::Charts;
use crate::choices::{Factor, Levels};
use crate::fits::{Fit, FitGroup, Fits, Moved};
use crate::study::{ReadingResult, Study};
use plummer::report::{Cell, Column, Fact, Section, Table, Verdict, fixed, significant};
use std::fmt::Write as _;

/// Rows of the tables of single readings and of groups.
const SHOWN: [usize; 2] = [25, 30];

/// The three frequencies, as heads of columns and names of charts have them.
pub const NAMES: [&str; 3] = ["8.2 kHz", "11.3 kHz", "35 to 36 kHz"];

/// A number of per cent with its sign, two significant digits.
pub fn signed(value: f64) -> String {
    if value > 0.0 { format!("+{}", significant(value, 2)) } else { significant(value, 2) }
}

/// The study as a section of the report; `base` is the built-in reading and `moved` what one choice does to it.
pub fn section(study: &Study, fits: &Fits, base: Option<&ReadingResult>, moved: &[Moved], charts: &Charts) -> Section {
    let total = study.readings.len();
    let shaped = fits.fits.iter().filter(|fit| fit.all_shaped()).count();
    let mut facts = vec![
        Fact::new("Readings", total.to_string()),
        Fact::new("Without an equilibrium", study.without_equilibrium.to_string()),
        Fact::new("Give all three", format!("{} ({} %)", fits.fits.len(), percent(fits.fits.len(), total))),
        Fact::new("By shape too", shaped.to_string()),
        Fact::new(
            "Nearest modes of another shape, in at least one of three",
            format!("{} ({} %)", fits.misnamed, percent(fits.misnamed, total)),
        ),
        Fact::new("The same in all that fit", determined(study, fits)),
    ];
    if let Some(known) = study.grid.known() {
        let rank = fits
            .rank(&known)
            .map_or_else(|| "it does not fit".to_owned(), |rank| format!("{rank} of {}", fits.fits.len()));
        facts.push(Fact::new("Place of the built-in case among them", rank));
    }
    let mut section = Section::new("How unique the reading is")
        .paragraph("The paper does not report everything that its three eigenfrequencies rest on. Every combination of the choices below was computed: ring on its springs, balls, shaft, linearised at the static equilibrium. A reading gives a frequency if the mode nearest to it (the balls' own left out) is within 2 %; the third may lie anywhere between 35 and 36 kHz. \"By shape\": the nearest mode is also the one that the paper speaks of: the ring across the load and turning (the higher of two such modes), the ring along the load on the contacts, the ring in two waves.")
        .facts(facts);
    if let Some(base) = base {
        section = section.table(shape_table(base));
    }
    section = section.table(count_table(study, fits));
    for (_, chart) in &charts.moved {
        section = section.spans(chart.clone());
    }
    section
        .table(moved_table(study, moved))
        .plot(charts.scatter.clone())
        .table(group_table(study, fits))
        .table(fit_table(study, fits))
}

/// What the three modes of the built-in reading are, as shares of their kinetic energy.
fn shape_table(base: &ReadingResult) -> Table {
    let mut columns = vec![Column::text("Paper"), Column::number("Mode", "kHz")];
    for name in ["Ring across the load", "Ring along the load", "Ring turning", "Ring in two waves", "Shaft", "Balls"] {
        columns.push(Column::number(name, "%"));
    }
    let mut table = Table::new("The three modes of the built-in reading: shares of their kinetic energy", columns);
    for (k, shares) in base.shapes.iter().enumerate() {
        let parts = [shares.across, shares.along, shares.turning, shares.two_waves, shares.shaft, shares.balls];
        let mut cells = vec![Cell::text(NAMES[k]), Cell::number(base.nearest_hz[k] / 1e3, 4)];
        cells.extend(parts.map(|part| Cell::text(fixed(100.0 * part, 1)).value(100.0 * part)));
        table = table.row(cells);
    }
    table
}

fn percent(part: usize, whole: usize) -> String {
    significant(100.0 * part as f64 / whole.max(1) as f64, 2)
}

/// What all readings that fit have in common, in words.
fn determined(study: &Study, fits: &Fits) -> String {
    if fits.determined.is_empty() {
        return "nothing".to_owned();
    }
    let words = fits.determined.iter().map(|(factor, level)| {
        let label = study.grid.label(*factor, *level);
        format!("{}: {label}", factor.name().to_lowercase())
    });
    words.collect::<Vec<_>>().join("; ")
}

fn count_table(study: &Study, fits: &Fits) -> Table {
    let columns = [
        Column::text("Choice"),
        Column::text("Value"),
        Column::number("Readings", ""),
        Column::number("Give all three", ""),
        Column::number("By shape too", ""),
        Column::number("Part of the readings", "%"),
    ];
    let mut table = Table::new("Readings that give all three frequencies, by choice", columns);
    for count in &fits.counts {
        let part = 100.0 * count.fits as f64 / count.readings.max(1) as f64;
        table = table.row([
            Cell::text(count.factor.name()),
            Cell::text(study.grid.label(count.factor, count.level)),
            whole(count.readings),
            whole(count.fits),
            whole(count.shaped_fits),
            Cell::number(part, 2),
        ]);
    }
    table
}

fn whole(number: usize) -> Cell {
    Cell::text(number.to_string()).value(number as f64)
}

fn moved_table(study: &Study, moved: &[Moved]) -> Table {
    let mut columns = vec![Column::text("Choice"), Column::text("Value")];
    for name in NAMES {
        columns.push(Column::number(format!("Nearest to {name}"), "kHz"));
        columns.push(Column::number("Moved by", "%"));
    }
    let mut table = Table::new("The built-in reading with one choice changed at a time", columns)
        .footnote("The nearest mode has another shape than the one that the paper speaks of.");
    for moved in moved {
        let mut cells = vec![Cell::text(moved.factor.name()), Cell::text(study.grid.label(moved.factor, moved.level))];
        for k in 0..3 {
            let cell = Cell::number(moved.hz[k] / 1e3, 4);
            cells.push(if moved.shaped[k] { cell } else { cell.footnote(1) });
            let by = 100.0 * moved.by[k];
            cells.push(Cell::text(signed(by)).value(by));
        }
        table = table.row(cells);
    }
    table
}

fn group_table(study: &Study, fits: &Fits) -> Table {
    let mut columns: Vec<Column> = FitGroup::SHARED.iter().map(|factor| Column::text(factor.name())).collect();
    columns.push(Column::number("Give all three", ""));
    columns.push(Column::number("of", ""));
    columns.push(Column::number("By shape too", ""));
    columns.push(Column::number("Best: worst of three", "%"));
    columns.push(Column::text("Widths"));
    columns.push(Column::text("Loads"));
    let mut table = Table::new(
        format!(
            "Readings that give all three, by the choices that act most: {} groups{}",
            fits.groups.len(),
            if fits.groups.len() > SHOWN[1] { format!(", the {} largest", SHOWN[1]) } else { String::new() }
        ),
        columns,
    );
    for group in fits.groups.iter().take(SHOWN[1]) {
        let mut cells: Vec<Cell> = FitGroup::SHARED
            .iter()
            .zip(&group.shared)
            .map(|(factor, level)| Cell::text(study.grid.label(*factor, *level)))
            .collect();
        cells.push(whole(group.fits));
        cells.push(whole(group.readings));
        cells.push(whole(group.shaped_fits));
        cells.push(Cell::number(100.0 * group.best.worst(), 2));
        for factor in [Factor::Width, Factor::Load] {
            let open = FitGroup::OPEN.iter().zip(&group.open);
            let words = open.filter(|(open, _)| **open == factor).flat_map(|(_, levels)| levels).map(|level| {
                let label = study.grid.label(factor, *level);
                label.split(' ').next().unwrap_or_default().to_owned()
            });
            cells.push(Cell::text(words.collect::<Vec<_>>().join(", ")));
        }
        table = table.row(cells);
    }
    table
}

fn fit_table(study: &Study, fits: &Fits) -> Table {
    let mut columns: Vec<Column> = vec![Column::number("Place", "")];
    columns.extend(NAMES.map(|name| Column::number(name, "kHz")));
    columns.push(Column::text("By shape"));
    columns.push(Column::text("Choices"));
    let shown = fits.fits.len().min(SHOWN[0]);
    let mut table = Table::new(format!("The {shown} readings that come nearest to all three"), columns);
    for (place, fit) in fits.fits.iter().take(shown).enumerate() {
        let mut cells = vec![whole(place + 1)];
        cells.extend(fit.reading.nearest_hz.map(|hz| Cell::number(hz / 1e3, 4)));
        cells.push(Cell::badge(Verdict::of(fit.all_shaped())));
        cells.push(Cell::text(words(study, &fit.reading.levels)));
        table = table.row(cells);
    }
    table
}

/// All choices of a reading in words.
fn words(study: &Study, levels: &Levels) -> String {
    let words = Factor::ALL.into_iter().zip(levels).map(|(factor, level)| {
        let label = study.grid.label(factor, *level);
        match factor {
            Factor::Shear => format!("shear {label}"),
            Factor::RotaryInertia => format!("rotary inertia {label}"),
            Factor::Steel => format!("steel {label}"),
            Factor::Aluminium => format!("aluminium {label}"),
            Factor::SpringArc => format!("{label} springs"),
            Factor::Cage => format!("balls below: {label}"),
            Factor::Contact => format!("k of {label}"),
            _ => label,
        }
    });
    words.collect::<Vec<_>>().join("; ")
}

/// Readings as CSV, a line each.
pub fn csv<'a>(study: &Study, readings: impl IntoIterator<Item = &'a ReadingResult>) -> String {
    let mut text = String::new();
    for factor in Factor::ALL {
        text.push_str(&factor.name().to_lowercase().replace([' ', '\''], "_"));
        text.push(',');
    }
    text.push_str(
        "nearest_8200_hz,nearest_11300_hz,nearest_35000_to_36000_hz,sway_hz,bounce_hz,two_waves_hz,gives_all_three\n",
    );
    for reading in readings {
        row(&mut text, study, reading);
    }
    text
}

fn row(text: &mut String, study: &Study, reading: &ReadingResult) {
    for (factor, level) in Factor::ALL.into_iter().zip(reading.levels) {
        text.push_str(&study.grid.label(factor, level).replace(',', ""));
        text.push(',');
    }
    let by_shape = reading.by_shape;
    for hz in reading.nearest_hz.map(Some).into_iter().chain([by_shape.sway, by_shape.bounce, by_shape.two_waves]) {
        // writing to a String cannot fail
        match hz {
            Some(hz) => {
                let _ = write!(text, "{hz:.2},");
            }
            None => text.push(','),
        }
    }
    let fits = Fit::of(reading).is_some();
    text.push_str(if fits { "true\n" } else { "false\n" });
}
