//! `plummer bearing`: the bearing in space, at rest.

use super::analyze::warn;
use super::report::ReportFiles;
use super::results::Job;
use super::{CliError, Outcome, typed};
use crate::app::commands::bearing::compute::{shown_degrees, shown_displacement};
use crate::app::commands::bearing::{BearingResult, bearing_report, compute_bearing};
use crate::app::commands::parts::without_round_off;
use crate::bearing::spatial::BearingState;
use crate::report::significant;
use std::f64::consts::TAU;

/// Finds where the shaft rests and writes the report, its tables and, last, `bearing.json`.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails or a file cannot be written.
pub(super) fn bearing(job: &Job<'_>, rpm: Option<f64>, holds_tilt: bool) -> Result<Outcome, CliError> {
    let Job { case, progress, .. } = *job;
    let result = compute_bearing(case, rpm, holds_tilt, progress)?;
    progress.stage("write");
    let report = bearing_report(case, &result, &typed());
    let files = ReportFiles::write(&job.folder, "bearing", case, report, progress)?;
    let (path, json) = job.write_result(&files, &[], result.summary())?;
    progress.finish();
    warn(&result.doubts, job.options);
    Ok(Outcome {
        summary: summary(&result),
        result: json,
        written: [vec![path], files.paths].concat(),
        verdict: Ok(()),
    })
}

/// Equilibrium, balls, stiffness and orders as lines of text.
fn summary(result: &BearingResult) -> String {
    let digits = |value: f64| significant(value, 5);
    let [fx, fy, fz] = result.load.force.map(digits);
    let [mx, my] = result.load.moment.map(digits);
    let mut lines = vec![format!(
        "rigid rings; force ({fx}, {fy}, {fz}) N, moment ({mx}, {my}) N m, {} rpm",
        digits(result.speed_rpm)
    )];
    let Some(taken) = result.equilibria.first() else { return lines.join("\n") };
    let [x, y, z, a, b] = shown_displacement(&taken.displacement).map(digits);
    lines.push(format!("at rest: ({x}, {y}, {z}) \u{b5}m, tilt ({a}, {b}) mrad"));
    let holding = result.holding_load(taken);
    if holding.iter().any(|load| load.abs() > 0.0) {
        let [hx, hy, hz, ha, hb] = holding.map(digits);
        lines.push(format!("held by: ({hx}, {hy}, {hz}) N, ({ha}, {hb}) N m"));
    }
    for (own, state) in result.bearings.iter().zip(&taken.bearings) {
        lines.extend(own.named().map(|name| format!("{name}, {} mm along the axis:", digits(1e3 * own.place))));
        lines.extend(balls(state));
    }
    lines.push("stiffness over x, y, z (m), tilt about x, y (rad):".to_owned());
    let rows: Vec<Vec<String>> = taken
        .stiffness
        .iter()
        .map(|row| without_round_off(*row).iter().map(|&value| digits(value)).collect())
        .collect();
    lines.extend(aligned(&rows));
    for own in &result.bearings {
        let name = own.named().map_or_else(String::new, |name| format!("{name}: "));
        if let Some(life) = &own.life {
            let mut line = format!("{name}rating: C {} N", digits(life.load_rating_n));
            for (value, before, unit) in [(life.life_mrev, "L10r ", "million revolutions"), (life.life_h, "", "h")] {
                line += &value.map(|value| format!(", {before}{} {unit}", significant(value, 4))).unwrap_or_default();
            }
            lines.push(line);
        }
        let orders = own.orders;
        lines.push(format!(
            "{name}orders at the mean contact angle of {}\u{b0}: BPFO {}, BPFI {}, BSF {}, FTF {}",
            significant(shown_degrees(own.contact_angle), 4),
            digits(orders.outer),
            digits(orders.inner),
            digits(orders.ball_spin),
            digits(orders.cage)
        ));
    }
    lines.join("\n")
}

/// A bearing's balls under each other.
fn balls(state: &BearingState) -> Vec<String> {
    let digits = |value: f64| significant(value, 5);
    let columns = ["azimuth", "load i", "load o", "angle i", "angle o", "MPa i", "MPa o", "spin", "orbit"];
    let units = ["deg", "N", "N", "deg", "deg", "", "", "rpm", "rpm"];
    let mut rows = vec![columns.map(str::to_owned).to_vec(), units.map(str::to_owned).to_vec()];
    for ball in &state.balls {
        let angle =
            |angle: Option<f64>| angle.map_or_else(|| "-".to_owned(), |angle| significant(shown_degrees(angle), 4));
        let rpm = |speed: f64| significant(speed * 60.0 / TAU, 5);
        rows.push(vec![
            significant(ball.azimuth.to_degrees().rem_euclid(360.0), 4),
            digits(ball.load[0]),
            digits(ball.load[1]),
            angle(ball.contact_angle[0]),
            angle(ball.contact_angle[1]),
            significant(1e-6 * ball.patch[0].peak_pressure, 4),
            significant(1e-6 * ball.patch[1].peak_pressure, 4),
            rpm(ball.spin_speed),
            rpm(ball.orbital_speed),
        ]);
    }
    aligned(&rows)
}

/// Rows with their cells under each other, on the right.
fn aligned(rows: &[Vec<String>]) -> Vec<String> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:>width$}"));
        format!("  {}", cells.collect::<Vec<_>>().join("  "))
    };
    rows.iter().map(line).collect()
}
