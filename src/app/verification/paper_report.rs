//! The first section's part of the report.

use super::paper::TABLE_ONE;
use super::paper_numbers::FormulationRow;
use super::section::signed;
use super::stiffness::Hypothesis;
use crate::report::{Cell, Column, Section, Table, significant};

/// Why k is a third, and what other equations give.
pub fn paper_report(stiffness: &[Hypothesis], rows: &[FormulationRow]) -> Section {
    let force = tangent_force(stiffness);
    let mut section = Section::new("")
        .paragraph(format!(
            "Table 1 prints a contact stiffness of {} and {} N/m^1.5, a third of what its own radii give, and softer at the inner race where the radii make it stiffer. Whatever acts on both contacts alike, such as units or moduli, keeps their ratio of 1.114; Table 1 has 0.990. The slips below were tried. None gives both of its four-digit numbers. The nearest are those that take every radius of Table 1 as positive, the concave grooves too, in the equations (21) and (22) as they are printed.",
            significant(TABLE_ONE.inner, 4),
            significant(TABLE_ONE.outer, 4)
        ))
        .table(stiffness_table(stiffness));
    if let Some([inner, outer]) = moduli(stiffness) {
        section = section.paragraph(format!(
            "Read in this way, Table 1 needs steel of {} GPa at the inner race and of {} GPa at the outer one: the same within 1 %, and a usual figure for steel, but not the same to four digits. It is a likely origin, not a proven one.",
            significant(1e-9 * inner, 4),
            significant(1e-9 * outer, 4)
        ));
    }
    if let Some(force) = force {
        section = section.paragraph(format!(
            "The unit in Table 1 is N/m. As the slope of the force over the approach its figure would belong to a load of {} N, with the stiffness that the geometry gives.",
            significant(force, 2)
        ));
    }
    section
        .paragraph("The built-in case with other equations, contact stiffness and cage angle. The consistent equations have no mode near 11.3 kHz.")
        .table(formulation_table(rows))
}

/// Force at which the inner contact's slope, 1.5 k^(2/3) F^(1/3), is Table 1's number, N.
fn tangent_force(stiffness: &[Hypothesis]) -> Option<f64> {
    let geometry = stiffness
        .iter()
        .find(|hypothesis| hypothesis.what == "geometry, 206 GPa")?;
    let k = geometry.inner?;
    Some((TABLE_ONE.inner / 1.5).powi(3) / (k * k))
}

/// Young's modulus with which every radius taken as positive gives Table 1's numbers, Pa: k goes with it.
fn moduli(stiffness: &[Hypothesis]) -> Option<[f64; 2]> {
    let literal = stiffness.iter().find(|hypothesis| {
        hypothesis.what == "every radius positive, (21) and (22) as printed, 206 GPa"
    })?;
    let [inner, outer] = literal.misfit;
    Some([206e9 / (1.0 + inner?), 206e9 / (1.0 + outer?)])
}

fn stiffness_table(stiffness: &[Hypothesis]) -> Table {
    let columns = [
        Column::text("What was done"),
        Column::number("Inner race", "10^9 N/m^1.5"),
        Column::number("Outer race", "10^9 N/m^1.5"),
        Column::number("Their ratio", ""),
        Column::number("Inner against Table 1", "%"),
        Column::number("Outer against Table 1", "%"),
    ];
    let mut table = Table::new("Where Table 1's contact stiffness may come from", columns);
    let blank = |cell: Option<Cell>| cell.unwrap_or_else(|| Cell::text("F ≥ 1"));
    for hypothesis in stiffness {
        let stiffness = |k: Option<f64>| blank(k.map(|k| Cell::number(1e-9 * k, 4)));
        let off = |misfit: Option<f64>| {
            let cell =
                misfit.map(|misfit| Cell::text(signed(100.0 * misfit)).value(100.0 * misfit));
            cell.unwrap_or_else(|| Cell::text("–"))
        };
        table = table.row([
            Cell::text(&hypothesis.what),
            stiffness(hypothesis.inner),
            stiffness(hypothesis.outer),
            hypothesis
                .ratio()
                .map_or_else(|| Cell::text("–"), |ratio| Cell::number(ratio, 4)),
            off(hypothesis.misfit[0]),
            off(hypothesis.misfit[1]),
        ]);
    }
    table.row([
        Cell::text("Table 1 itself"),
        Cell::number(1e-9 * TABLE_ONE.inner, 4),
        Cell::number(1e-9 * TABLE_ONE.outer, 4),
        Cell::number(TABLE_ONE.inner / TABLE_ONE.outer, 4),
        Cell::text("–"),
        Cell::text("–"),
    ])
}

fn formulation_table(rows: &[FormulationRow]) -> Table {
    let columns = [
        Column::text("Equations"),
        Column::text("Contact stiffness"),
        Column::text("Balls under the load"),
        Column::text("Modes below 40 kHz without the balls' own [kHz]"),
    ];
    let mut table = Table::new("What other equations and another stiffness give", columns);
    for row in rows {
        let hz: Vec<String> = row
            .frequencies_hz
            .iter()
            .map(|hz| significant(hz / 1e3, 4))
            .collect();
        table = table.row([
            Cell::text(row.equations),
            Cell::text(row.contact),
            Cell::text(row.balls),
            Cell::text(hz.join(", ")),
        ]);
    }
    table
}
