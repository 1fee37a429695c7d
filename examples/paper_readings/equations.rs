//! Loaded frequencies of the built-in case with other equations, contact stiffness and cage angle.

use crate::paper::{Failure, beam_case};
use plummer::app::commands::modes::{ModesResult, compute_modes};
use plummer::numerics::Unwatched;
use plummer::report::{Cell, Column, Section, Table, significant};

/// Modes that the table shows lie below, Hz.
const BELOW_HZ: f64 = 40e3;

/// Frequencies of the built-in case with some choices changed.
pub struct Row {
    /// "printed" or "consistent".
    pub equations: &'static str,
    /// Where k comes from.
    pub contact: &'static str,
    /// Balls under the load.
    pub balls: &'static str,
    /// Frequencies below [`BELOW_HZ`] that are not the balls' own, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Whether the equilibrium that they belong to is stable.
    pub stable: bool,
}

/// All combinations of two kinds of equations, two sources of k and two cage angles.
///
/// # Errors
/// What the computation of modes reports.
pub fn rows() -> Result<Vec<Row>, Failure> {
    let mut rows = Vec::new();
    for equations in ["printed", "consistent"] {
        for (contact, stiffness) in [
            ("geometry, 206 GPa", "bearing.stiffness=hertz"),
            ("Table 1", "bearing.stiffness={ inner = 3.828e9, outer = 3.867e9 }"),
        ] {
            for (balls, angle) in [("two", "bearing.first_ball_deg=295.714"), ("one", "bearing.first_ball_deg=270")] {
                let formulation = format!("bearing.formulation={equations}");
                let case = beam_case(&[&formulation, stiffness, angle])?;
                let result = compute_modes(&case, &Unwatched)?;
                rows.push(Row {
                    equations,
                    contact,
                    balls,
                    frequencies_hz: frequencies_hz(&result),
                    stable: is_stable(&result),
                });
            }
        }
    }
    Ok(rows)
}

fn frequencies_hz(result: &ModesResult) -> Vec<f64> {
    let loaded = result.base.loaded.iter();
    let modes = loaded.flat_map(|loaded| &loaded.modes);
    let own = modes.filter(|mode| !mode.is_ball_mode() && mode.frequency_hz < BELOW_HZ);
    own.map(|mode| mode.frequency_hz).collect()
}

fn is_stable(result: &ModesResult) -> bool {
    let statics = result.statics.iter();
    let mut equilibria = statics.flat_map(|statics| statics.equilibria.iter().take(1));
    equilibria.all(|rest| rest.is_stable())
}

/// The rows as a section of the report.
pub fn section(rows: &[Row]) -> Section {
    Section::new("What the equations give")
        .paragraph("The built-in case with other equations, contact stiffness and cage angle. The consistent equations have no mode near 11.3 kHz.")
        .table(table(rows))
}

/// One row for each choice.
fn table(rows: &[Row]) -> Table {
    let columns = [
        Column::text("Equations"),
        Column::text("Contact stiffness"),
        Column::text("Balls under the load"),
        Column::text("Modes below 40 kHz without the balls' own [kHz]"),
    ];
    let mut table = Table::new("What other equations and another stiffness give", columns);
    for row in rows {
        let hz: Vec<String> = row.frequencies_hz.iter().map(|hz| significant(hz / 1e3, 4)).collect();
        table = table.row([
            Cell::text(row.equations),
            Cell::text(row.contact),
            Cell::text(row.balls),
            Cell::text(hz.join(", ") + if row.stable { "" } else { " (not stable)" }),
        ]);
    }
    table
}
