//! Which readings of Tadina & Boltezar (2011) give the three eigenfrequencies that the paper quotes.
//!
//! The paper says "around 8.2 kHz", "around 11.3 kHz" and 35 to 36 kHz, and leaves open what these rest on: the width of the
//! housing ring, how both rings hold together, where the springs act, which equations, which contact stiffness, and more. Printed
//! and written to a page are
//!
//! - where the contact stiffness of Table 1 may come from, a third of what the table's own radii give;
//! - the modes of `examples/tadina2011/beam.toml` with other equations, contact stiffness and cage angle;
//! - all 155,520 combinations of what is left open: which fit within 2 %, and what those have in common;
//! - the built-in reading with closed inner contacts, which fits with springs at the nodes.
//!
//! The folder of the results gets `report.html`, `readings.csv` (every reading), `readings-that-fit.csv` and `figures/`. It
//! takes four minutes on two cores.
//!
//! ```text
//! cargo run --release --example paper_readings [FOLDER, default out/paper-readings]
//! ```

mod charts;
mod choices;
mod closed_contacts;
mod contact_stiffness;
mod equations;
mod fits;
mod paper;
mod shapes;
mod study;
#[cfg(test)]
mod study_tests;
mod tables;

use charts::Charts;
use choices::{ContactSource, Equations, Factor, Grid, RingBond};
use fits::{Fits, moved_by_one_choice};
use paper::{Failure, beam_case};
use plummer::app::commands::modes::compute_modes;
use plummer::numerics::Unwatched;
use plummer::report::{Block, Report, Section};
use std::io::Write;
use std::path::PathBuf;
use study::Study;

fn main() -> Result<(), Failure> {
    let folder = std::env::args().nth(1);
    let folder = PathBuf::from(folder.unwrap_or_else(|| "out/paper-readings".to_owned()));
    std::fs::create_dir_all(folder.join("figures"))?;
    let mut out = std::io::stdout().lock();

    let hypotheses = contact_stiffness::hypotheses()?;
    let stiffness = contact_stiffness::section(&hypotheses);
    print(&mut out, &stiffness)?;
    let rows = equations::rows()?;
    let equations = equations::section(&rows);
    print(&mut out, &equations)?;

    let study = Study::compute(Grid::full())?;
    let fits = Fits::of(&study);
    let known = study.grid.known().ok_or("the grid lacks the built-in reading")?;
    let base = study.readings.iter().find(|r| r.levels == known);
    let moved = moved_by_one_choice(&study, &known);
    let charts = Charts::of(&study, &fits, base, &moved);
    let readings = tables::section(&study, &fits, base, &moved, &charts);
    print(&mut out, &readings)?;

    let closed = closed_contacts::rows(&study.grid)?;
    let contacts = closed_contacts::section(&study.grid, &closed);
    print(&mut out, &contacts)?;

    let page = Report::new(
        "Readings of Tadina & Boltezar (2011)",
        "cargo run --release --example paper_readings",
        env!("CARGO_PKG_VERSION"),
    )
    .section(stiffness)
    .section(equations)
    .section(readings)
    .section(contacts);
    let html = page.to_html()?;
    let fitting = fits.fits.iter().map(|fit| &fit.reading);
    let mut files = vec![
        ("report.html".to_owned(), html),
        ("readings.csv".to_owned(), tables::csv(&study, &study.readings)),
        ("readings-that-fit.csv".to_owned(), tables::csv(&study, fitting)),
        ("figures/readings-scatter.svg".to_owned(), charts.scatter.to_svg()?),
    ];
    for (name, chart) in &charts.moved {
        files.push((format!("figures/{name}.svg"), chart.to_svg()?));
    }
    for (name, text) in &files {
        std::fs::write(folder.join(name), text)?;
    }
    writeln!(out, "written: {}", folder.display())?;

    assert!(files[0].1.contains("every radius positive, (21) and (22) as printed"));
    check_equations(&rows);
    check_readings(&study, &fits);
    closed_contacts::check(&closed);
    check_against_modes(&study)
}

/// Prints a section: its paragraphs, facts and tables.
fn print(out: &mut impl Write, section: &Section) -> Result<(), Failure> {
    writeln!(out, "# {}\n", section.title)?;
    for block in &section.blocks {
        match block {
            Block::Paragraph(text) => writeln!(out, "{text}\n")?,
            Block::Facts(facts) => {
                for fact in facts {
                    writeln!(out, "{}: {}", fact.name, fact.value)?;
                }
                writeln!(out)?;
            }
            Block::Table(table) => writeln!(out, "{}\n", table.plain())?,
            _ => {}
        }
    }
    Ok(())
}

/// 11.3 kHz exists with the printed equations and the geometry's contact stiffness alone.
fn check_equations(rows: &[equations::Row]) {
    assert_eq!(rows.len(), 8);
    for row in rows {
        let near = row.frequencies_hz.iter().any(|hz| (hz / paper::BOUNCE - 1.0).abs() < 0.02);
        let expected = row.equations == "printed" && row.contact != "Table 1" && row.balls == "two";
        assert_eq!(near, expected, "{} {} {}", row.equations, row.contact, row.balls);
    }
}

/// The numbers of `docs/paper.md`.
fn check_readings(study: &Study, fits: &Fits) {
    assert_eq!((study.readings.len(), study.without_equilibrium), (155_520, 0));
    assert_eq!(fits.fits.len(), 226);
    assert!(fits.fits.iter().all(|fit| fit.all_shaped()));
    assert_eq!(fits.misnamed, 107_327);
    let place = |factor, level| (factor, level);
    let grid = &study.grid;
    let determined = [
        place(Factor::Bond, grid.bonds.iter().position(|b| *b == RingBond::CommonCentroid)),
        place(Factor::Equations, grid.equations.iter().position(|e| *e == Equations::Printed)),
    ];
    for (factor, level) in determined {
        assert!(fits.determined.contains(&(factor, level.unwrap_or(usize::MAX))), "{factor:?}");
    }
    let fitting = |contact| {
        let level = grid.contacts.iter().position(|c| *c == contact);
        let count = fits.counts.iter().find(|c| c.factor == Factor::Contact && Some(c.level) == level);
        count.map(|count| count.fits)
    };
    assert_eq!(fitting(ContactSource::Geometry), Some(115));
    assert_eq!(fitting(ContactSource::RingSteel), Some(111));
    assert_eq!(fitting(ContactSource::TableOne), Some(0));
    let known = grid.known().and_then(|known| fits.rank(&known));
    assert_eq!(known, Some(39));
}

/// The study keeps the ring's modes below 300 kHz and the static response to the balls of the others; `plummer modes` keeps all 216.
/// What is left out moves the first two frequencies by less than 1e-5. (For the ring's the case looks near 36 kHz, the study from 35
/// to 36 kHz.)
fn check_against_modes(study: &Study) -> Result<(), Failure> {
    let known = study.grid.known();
    let base = study.readings.iter().find(|r| Some(r.levels) == known);
    let base = base.ok_or("the study lacks the built-in reading")?;
    let modes = compute_modes(&beam_case(&[])?, &Unwatched)?;
    for (expected, found) in modes.base.expected.iter().zip(base.nearest_hz).take(2) {
        let error = found / expected.found_hz.unwrap_or(f64::NAN) - 1.0;
        assert!(error.abs() < 1e-5, "{}: {error:e}", expected.what);
    }
    Ok(())
}
