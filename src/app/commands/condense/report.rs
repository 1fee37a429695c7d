//! The report of `plummer condense`: the certificate of a superelement.

use super::compute::{CondenseResult, FullComparison};
use super::{reduced_interface_report, size_chart};
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::Boundary;
use crate::app::scene::tie_price::{BeamAndSolid, TiePrice};
use crate::fe::reduction::{BasisSize, Bound, Check};
use crate::report::{Cell, Column, Document, Fact, Report, Section, Table, Verdict, significant};
use std::f64::consts::TAU;

/// Composes the report; `command` is the line that made it.
///
/// # Errors
/// None yet.
pub(crate) fn condense_report(case: &Case, result: &CondenseResult, command: &str) -> Result<Report, ComputeError> {
    let document =
        Document::new().case(case.source.path.display().to_string()).signed_by("Prepared by").signed_by("Checked by");
    let failed = result.checks.iter().filter(|check| !check.ok()).count();
    let report = Report::new(&case.title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Certificate of a condensed housing")
        .document(document)
        .headline(
            "Checks passed",
            format!("{} of {}", result.checks.len() - failed, result.checks.len()),
            Verdict::of(failed == 0),
        )
        .headline(
            "Largest estimated error of a frequency in the band",
            significant(result.estimate.largest(), 2),
            Verdict::of(result.estimate.converged && result.estimate.largest() <= case.target()),
        )
        .headline(
            "Coordinates",
            format!("{} + {}", result.superelement().interface_dof, result.stage.condensed.basis.count()),
            Verdict::None,
        );
    let mut report = report
        .section(what(result))
        .section(
            Section::new("Checks")
                .paragraph("Every limit is relative: it holds in any units and for any size. A check that fails says which property the superelement lacks.")
                .table(check_table(&result.checks)),
        )
        .section(errors(result));
    if let Some(interface) = &result.interface {
        report = report.section(reduced_interface_report::section(result, interface));
    }
    report = report.section(vectors(result));
    let interface_dof = result.stage.condensed.superelement.interface_dof;
    let full = result.full.as_ref();
    if let Some(chart) = full.and_then(|f| size_chart::section(f, interface_dof, case.target())) {
        report = report.section(chart);
    }
    if let Some(price) = &result.tie_price {
        report = report.section(tie(price));
    }
    for text in &result.doubts {
        report = report.warning(text);
    }
    Ok(report)
}

fn what(result: &CondenseResult) -> Section {
    let stage = &result.stage;
    let element = &stage.condensed.superelement;
    let interface = match &stage.boundary {
        Boundary::Ring(bodies) => format!("the {} nodes of the ring, through its tie", bodies.0.nodes()),
        Boundary::Nodes(nodes) => {
            let count = nodes.coordinates.iter().map(|at| at.0);
            let count = count.collect::<std::collections::BTreeSet<_>>().len();
            format!("{count} nodes of the mesh")
        }
    };
    let basis = &stage.condensed.basis;
    let size = match stage.choice.size {
        BasisSize::Auto(target) => format!(
            "as few as keep the estimated error below {} up to {:.0} Hz",
            significant(target, 2),
            stage.choice.band_hz
        ),
        BasisSize::Count(count) => format!("{count}, as asked"),
        BasisSize::UpTo(hz) => format!("modes up to {hz:.0} Hz, as asked"),
        BasisSize::AtMost(hz, _) => format!("modes up to {hz:.0} Hz, fewer of a large housing"),
    };
    let mut facts = vec![
        Fact::new("Interface", interface),
        Fact::new("Interface coordinates", element.interface_dof.to_string()),
        Fact::new("Interior degrees of freedom", stage.condensed.substructure.interior_dof().to_string()),
        Fact::new("Fixed-interface modes", (basis.count() - basis.residual_vectors()).to_string()).note(size),
        Fact::new("Residual vectors", basis.residual_vectors().to_string())
            .note("static response of the interior to what a mode of the coupled structure lacks"),
    ];
    if let Boundary::Nodes(nodes) = &stage.boundary
        && !nodes.held.is_empty()
    {
        facts.push(
            Fact::new("Displacements left out", nodes.held.len().to_string())
                .note("of interface nodes that a support holds or a link ties"),
        );
    }
    Section::new("What was condensed").facts(facts)
}

pub(crate) fn check_table(checks: &[Check]) -> Table {
    let mut table = Table::new(
        "Certificate",
        [
            Column::text("Check"),
            Column::text("What"),
            Column::number("Found", ""),
            Column::text("Limit"),
            Column::text("Verdict"),
        ],
    );
    for check in checks {
        let sign = match check.bound {
            Bound::AtMost => "at most",
            Bound::AtLeast => "at least",
        };
        table = table.row([
            Cell::text(check.name),
            Cell::text(&check.what),
            Cell::number(check.value, 3),
            Cell::text(format!("{sign} {}", significant(check.limit, 3))),
            Cell::badge(Verdict::of(check.ok())),
        ]);
    }
    table
}

fn errors(result: &CondenseResult) -> Section {
    let estimate = &result.estimate;
    let mut columns = vec![
        Column::number("Mode", ""),
        Column::number("Frequency, reduced", "Hz"),
        Column::number("Estimated error", ""),
    ];
    if result.full.is_some() {
        columns.push(Column::number("Frequency, full", "Hz"));
        columns.push(Column::number("Error", ""));
    }
    let mut table = Table::new("Frequencies in the band", columns);
    for (place, mode) in estimate.modes.iter().enumerate() {
        let mut cells = vec![
            Cell::text((place + 1).to_string()),
            Cell::number(mode.frequency_hz, 7),
            Cell::number(mode.relative_error, 2),
        ];
        if let Some(full) = &result.full {
            cells.push(Cell::number(full.frequencies_hz[place], 7));
            cells.push(match full.relative_errors[place] {
                Some(error) => Cell::number(error, 2),
                None => Cell::text("rigid"),
            });
        }
        table = table.row(cells);
    }
    let mut section = Section::new("Error of the reduction")
        .paragraph("The residual of each mode in the interior's equations, solved with the factor of the interior, says what the basis lacks. The modes are computed once more with these vectors; what the frequencies fall by is their error. The full model is not needed for it.");
    if estimate.out_of_band > 0 {
        section =
            section.paragraph(format!("The reduced model has {} of these modes above the band.", estimate.out_of_band));
    }
    if let Some(FullComparison { effectivity: Some([low, high]), .. }) = &result.full {
        section = section.paragraph(format!(
            "Estimated / true error: {} to {}.",
            significant(*low, 3),
            significant(*high, 3)
        ));
    }
    section.table(table)
}

fn vectors(result: &CondenseResult) -> Section {
    let basis = &result.stage.condensed.basis;
    let mut table = Table::new(
        "Vectors of the interior",
        [Column::number("Vector", ""), Column::number("Frequency with the interface held", "Hz")],
    );
    for (place, value) in basis.values().iter().enumerate() {
        table = table.row([Cell::text((place + 1).to_string()), Cell::number(value.sqrt() / TAU, 7)]);
    }
    let complete = basis.complete_below().sqrt() / TAU;
    Section::new("What the interior may do").table(table.footnote(format!(
        "Below {} Hz these are the fixed-interface modes, all of them; above, combinations with the residual vectors.",
        significant(complete, 6)
    )))
}

/// What section-rigid bores cost.
fn tie(price: &TiePrice) -> Section {
    let section = Section::new("The price of the tie").paragraph("The tie makes every point of the bore follow the rigid section of the ring at its angle. Here are the frequencies of housing and ring through the tie, and of the same housing with the ring as a solid in its bore.");
    let found = match price {
        TiePrice::NotComputed(reason) => {
            return section.paragraph(format!("Not computed: {reason}."));
        }
        TiePrice::Computed(found) => found,
    };
    let table = |caption: &str, modes: &[BeamAndSolid]| {
        let mut table = Table::new(
            caption,
            [
                Column::number("Mode", ""),
                Column::number("Beams", "Hz"),
                Column::number("Solid", "Hz"),
                Column::number("Difference", "%"),
                Column::number("MAC", ""),
            ],
        );
        let number =
            |value: Option<f64>, digits| value.map_or_else(|| Cell::text("none"), |value| Cell::number(value, digits));
        for mode in modes {
            table = table.row([
                Cell::text((mode.mode + 1).to_string()),
                Cell::number(mode.beams_hz, 6),
                number(mode.solid_hz, 6),
                number(mode.relative_difference.map(|x| 100.0 * x), 3),
                number(mode.mac, 3),
            ]);
        }
        table
    };
    let mut section = section
        .paragraph(format!(
            "The solid ring: {} elements, {:.4} mm high, {:.4} mm wide, centroid radius {:.4} mm.",
            found.elements,
            1e3 * found.height_m,
            1e3 * found.width_m,
            1e3 * found.radius_m
        ))
        .table(table("Housing and ring", &found.modes))
        .table(table("The ring alone: what the beams themselves cost", &found.ring_alone));
    for note in &found.notes {
        section = section.paragraph(note);
    }
    section
}
