//! The second section: how unique the reading is that gives the source's frequencies, as tables and charts.

use super::paper::{PaperFrequencies, beam_case};
use super::readings::{
    Equations, Factor, Fit, FitGroup, Fits, Grid, Levels, Moved, ReadingResult, Study, WITHIN,
    moved_by_one_choice,
};
use super::section::{SectionResult, signed};
use super::{Check, SectionValues, VerificationError};
use crate::app::commands::modes::compute_modes;
use crate::app::scene::{Unwatched, Watch};
use crate::report::{
    Abscissa, Axis, Cell, Column, Curve, CurveStyle, Fact, Marker, Plot, Section, SpanPoint,
    SpanRow, Spans, Table, Verdict, fixed, significant,
};
use std::fmt::Write as _;

/// Title of the section.
const TITLE: &str = "How unique the reading is";

/// Rows of the tables of single readings and of groups.
const SHOWN: [usize; 2] = [25, 30];

/// Most points of a curve in the scatter plot.
const MOST_POINTS: usize = 1500;

/// The three frequencies, as heads of columns and names of charts have them.
const NAMES: [&str; 3] = ["8.2 kHz", "11.3 kHz", "35 to 36 kHz"];

/// Computes all readings of a grid and says which give the source's three frequencies.
///
/// # Errors
/// [`VerificationError`] if a structure or the built-in case cannot be computed.
pub fn reading_study(
    grid: Grid,
    watch: &(impl Watch + Sync),
) -> Result<SectionResult, VerificationError> {
    watch.stage("readings");
    let case = beam_case(&["modes.variants=[]".to_owned()])?;
    let paper = PaperFrequencies::default();
    let study = Study::compute(&case, paper, grid, watch)?;
    let fits = Fits::of(&study);
    let known = study.grid.known();
    let moved = known.map_or_else(Vec::new, |known| moved_by_one_choice(&study, &known));
    let base = known.and_then(|known| study.readings.iter().find(|r| r.levels == known));
    let mut checks = Vec::new();
    if let Some(base) = base {
        let modes = compute_modes(&case, &Unwatched)?;
        let expected = modes.base.expected.iter();
        // the case looks for the ring's mode near 36 kHz, the study for the one nearest to 35 to 36 kHz
        for (expected, found) in expected.zip(base.nearest_hz).take(2) {
            checks.push(Check {
                name: format!("Study against `plummer modes`: {}", expected.what),
                section: TITLE.to_owned(),
                computed: found,
                reference: expected.found_hz.unwrap_or(f64::NAN),
                unit: "Hz".to_owned(),
                source: "the built-in case with all 216 modes of the ring".to_owned(),
                assumptions: "The study keeps the ring's modes below 300 kHz and the static response to the balls of the others.".to_owned(),
                limit: 1e-5,
                reason: "What is left out of the modes above 300 kHz moves these frequencies by less than 1e-5.".to_owned(),
            });
        }
    }
    let charts = Charts::of(&study, &fits, base, &moved);
    Ok(SectionResult {
        title: TITLE.to_owned(),
        checks,
        information: Vec::new(),
        report: vec![report(&study, &fits, base, &moved, &charts)],
        values: SectionValues {
            readings: Some(study.summary(&fits, base, &moved)),
            ..SectionValues::default()
        },
        files: files(&study, &fits, &charts)?,
        lines: lines(&study, &fits, base, &moved),
    })
}

/// The charts, for the report and as files.
struct Charts {
    moved: Vec<(&'static str, Spans)>,
    scatter: Plot,
}

impl Charts {
    fn of(study: &Study, fits: &Fits, base: Option<&ReadingResult>, moved: &[Moved]) -> Self {
        let files = ["readings-sway", "readings-bounce", "readings-ring"];
        let charts = files.into_iter().enumerate().filter_map(|(k, file)| {
            let base = base?.nearest_hz[k];
            (!moved.is_empty()).then(|| (file, spans(study, moved, k, base)))
        });
        Self {
            moved: charts.collect(),
            scatter: scatter(study, fits),
        }
    }
}

/// What each choice by itself does to one frequency.
fn spans(study: &Study, moved: &[Moved], k: usize, base: f64) -> Spans {
    let rows = Factor::ALL.into_iter().filter_map(|factor| {
        let points: Vec<SpanPoint> = moved
            .iter()
            .filter(|moved| moved.factor == factor)
            .map(|moved| {
                let label = study.grid.label(factor, moved.level);
                SpanPoint {
                    label: if moved.shaped[k] {
                        label
                    } else {
                        format!("{label} *")
                    },
                    at: moved.hz[k] / 1e3,
                }
            })
            .collect();
        (!points.is_empty()).then(|| SpanRow {
            name: factor.name().to_owned(),
            points,
        })
    });
    Spans {
        title: format!("What one choice does to the mode nearest to {}", NAMES[k]),
        caption: Some(format!(
            "The mode nearest to {} of the built-in reading ({} kHz, the line) with one choice changed at a time. A star: that mode has another shape than the one that the source speaks of.",
            NAMES[k],
            significant(base / 1e3, 4)
        )),
        axis: "Nearest mode [kHz]".to_owned(),
        base: base / 1e3,
        rows: rows.collect(),
    }
}

/// First against second frequency, by shape, of both kinds of equations, and the readings that fit.
fn scatter(study: &Study, fits: &Fits) -> Plot {
    let x = Axis::new("Ring across the load and turning", "Hz").range(3e3, 12e3);
    let y = Axis::new("Ring along the load", "Hz").range(4e3, 14e3);
    let mut plot = Plot::new("First and second frequency of the readings", x, y).caption(format!(
        "By mode shape, at most {MOST_POINTS} readings of each kind of equations. The source: 8.2 and 11.3 kHz. Readings with radial springs stand on the left.",
    ));
    let points = |readings: &[&ReadingResult]| -> (Vec<f64>, Vec<f64>) {
        let stride = readings.len().div_ceil(MOST_POINTS).max(1);
        readings
            .iter()
            .step_by(stride)
            .filter_map(|reading| Some((reading.by_shape.sway?, reading.by_shape.bounce?)))
            .unzip()
    };
    for (level, equations) in study.grid.equations.iter().enumerate() {
        let with: Vec<&ReadingResult> = study
            .readings
            .iter()
            .filter(|reading| reading.levels[Factor::Equations as usize] == level)
            .collect();
        let (x, y) = points(&with);
        let name = match equations {
            Equations::Printed => "printed equations",
            Equations::Consistent => "consistent equations",
        };
        plot = plot.curve(Curve::new(name, Abscissa::Points(x), y).style(CurveStyle::Points));
    }
    let fitting: Vec<&ReadingResult> = fits
        .fits
        .iter()
        .filter(|fit| fit.all_shaped())
        .map(|fit| &fit.reading)
        .collect();
    let (x, y) = points(&fitting);
    let fitting = Curve::new("all three given", Abscissa::Points(x), y);
    let line = Curve::new(
        "11.3 kHz",
        Abscissa::Points(vec![3e3, 12e3]),
        vec![study.paper.bounce; 2],
    );
    plot.curve(fitting.style(CurveStyle::Points))
        .curve(line.style(CurveStyle::Dashed))
        .marker(Marker::new(study.paper.sway, "8.2 kHz"))
}

fn report(
    study: &Study,
    fits: &Fits,
    base: Option<&ReadingResult>,
    moved: &[Moved],
    charts: &Charts,
) -> Section {
    let total = study.readings.len();
    let shaped = fits.fits.iter().filter(|fit| fit.all_shaped()).count();
    let mut facts = vec![
        Fact::new("Readings", total.to_string()),
        Fact::new(
            "Without an equilibrium",
            study.without_equilibrium.to_string(),
        ),
        Fact::new(
            "Give all three",
            format!(
                "{} ({} %)",
                fits.fits.len(),
                percent(fits.fits.len(), total)
            ),
        ),
        Fact::new("By shape too", shaped.to_string()),
        Fact::new(
            "Nearest modes of another shape, in at least one of three",
            format!("{} ({} %)", fits.misnamed, percent(fits.misnamed, total)),
        ),
        Fact::new("The same in all that fit", determined(study, fits)),
    ];
    if let Some(known) = study.grid.known() {
        let rank = fits.rank(&known).map_or_else(
            || "it does not fit".to_owned(),
            |rank| format!("{rank} of {}", fits.fits.len()),
        );
        facts.push(Fact::new("Place of the built-in case among them", rank));
    }
    let mut section = Section::new("")
        .paragraph("The source does not report everything that its three eigenfrequencies rest on. Every combination of the choices below was computed: ring on its springs, balls, shaft, linearised at the static equilibrium. A reading gives a frequency if the mode nearest to it (the balls' own left out) is within 2 %; the third may lie anywhere between 35 and 36 kHz. \"By shape\": the nearest mode is also the one that the source speaks of: the ring across the load and turning (the higher of two such modes), the ring along the load on the contacts, the ring in two waves.")
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
    let mut columns = vec![Column::text("Source"), Column::number("Mode", "kHz")];
    for name in [
        "Ring across the load",
        "Ring along the load",
        "Ring turning",
        "Ring in two waves",
        "Shaft",
        "Balls",
    ] {
        columns.push(Column::number(name, "%"));
    }
    let mut table = Table::new(
        "The three modes of the built-in reading: shares of their kinetic energy",
        columns,
    );
    for (k, shares) in base.shapes.iter().enumerate() {
        let parts = [
            shares.across,
            shares.along,
            shares.turning,
            shares.two_waves,
            shares.shaft,
            shares.balls,
        ];
        let mut cells = vec![
            Cell::text(NAMES[k]),
            Cell::number(base.nearest_hz[k] / 1e3, 4),
        ];
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
    let mut table = Table::new(
        "Readings that give all three frequencies, by choice",
        columns,
    );
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
    let mut table = Table::new(
        "The built-in reading with one choice changed at a time",
        columns,
    )
    .footnote("The nearest mode has another shape than the one that the source speaks of.");
    for moved in moved {
        let mut cells = vec![
            Cell::text(moved.factor.name()),
            Cell::text(study.grid.label(moved.factor, moved.level)),
        ];
        for k in 0..3 {
            let cell = Cell::number(moved.hz[k] / 1e3, 4);
            cells.push(if moved.shaped[k] {
                cell
            } else {
                cell.footnote(1)
            });
            let by = 100.0 * moved.by[k];
            cells.push(Cell::text(signed(by)).value(by));
        }
        table = table.row(cells);
    }
    table
}

fn group_table(study: &Study, fits: &Fits) -> Table {
    let mut columns: Vec<Column> = FitGroup::SHARED
        .iter()
        .map(|factor| Column::text(factor.name()))
        .collect();
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
            if fits.groups.len() > SHOWN[1] {
                format!(", the {} largest", SHOWN[1])
            } else {
                String::new()
            }
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
            let words = open
                .filter(|(open, _)| **open == factor)
                .flat_map(|(_, levels)| levels)
                .map(|level| {
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
    let mut table = Table::new(
        format!("The {shown} readings that come nearest to all three"),
        columns,
    );
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

fn files(
    study: &Study,
    fits: &Fits,
    charts: &Charts,
) -> Result<Vec<(String, String)>, VerificationError> {
    let mut files = vec![("readings.csv".to_owned(), csv(study))];
    let mut fitting = header();
    for fit in &fits.fits {
        row(&mut fitting, study, &fit.reading);
    }
    files.push(("readings-that-fit.csv".to_owned(), fitting));
    for (name, chart) in &charts.moved {
        files.push((format!("figures/{name}.svg"), chart.to_svg()?));
    }
    let scatter = charts.scatter.to_svg()?;
    files.push(("figures/readings-scatter.svg".to_owned(), scatter));
    Ok(files)
}

/// All readings, a line each.
fn csv(study: &Study) -> String {
    let mut text = header();
    for reading in &study.readings {
        row(&mut text, study, reading);
    }
    text
}

fn header() -> String {
    let mut text = String::new();
    for factor in Factor::ALL {
        text.push_str(&factor.name().to_lowercase().replace([' ', '\''], "_"));
        text.push(',');
    }
    text.push_str("nearest_8200_hz,nearest_11300_hz,nearest_35000_to_36000_hz,sway_hz,bounce_hz,two_waves_hz,gives_all_three\n");
    text
}

fn row(text: &mut String, study: &Study, reading: &ReadingResult) {
    for (factor, level) in Factor::ALL.into_iter().zip(reading.levels) {
        text.push_str(&study.grid.label(factor, level).replace(',', ""));
        text.push(',');
    }
    let by_shape = reading.by_shape;
    for hz in reading.nearest_hz.map(Some).into_iter().chain([
        by_shape.sway,
        by_shape.bounce,
        by_shape.two_waves,
    ]) {
        // writing to a String cannot fail
        match hz {
            Some(hz) => {
                let _ = write!(text, "{hz:.2},");
            }
            None => text.push(','),
        }
    }
    let fits = Fit::of(study, reading).is_some();
    text.push_str(if fits { "true\n" } else { "false\n" });
}

fn lines(study: &Study, fits: &Fits, base: Option<&ReadingResult>, moved: &[Moved]) -> Vec<String> {
    let total = study.readings.len();
    let shaped = fits.fits.iter().filter(|fit| fit.all_shaped()).count();
    let mut lines = vec![
        format!(
            "{total} readings, {} without an equilibrium; {} give all three frequencies within {} % ({} by mode shape too)",
            study.without_equilibrium,
            fits.fits.len(),
            100.0 * WITHIN,
            shaped
        ),
        format!(
            "nearest modes have another shape than the source speaks of in {} readings",
            fits.misnamed
        ),
        format!("the same in all that fit: {}", determined(study, fits)),
    ];
    if let Some(rank) = study.grid.known().and_then(|known| fits.rank(&known)) {
        lines.push(format!(
            "the built-in case is number {rank} of {}",
            fits.fits.len()
        ));
    }
    lines.extend(base.map(|base| shape_table(base).plain()));
    let tables = [
        count_table(study, fits),
        moved_table(study, moved),
        group_table(study, fits),
        fit_table(study, fits),
    ];
    lines.extend(tables.iter().map(Table::plain));
    lines
}
