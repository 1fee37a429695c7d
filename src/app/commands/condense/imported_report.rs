//! The report of `plummer condense` on a superelement from a file.

use super::report::check_table;
use crate::app::case::Case;
use crate::app::scene::ImportedHousing;
use crate::report::{Cell, Column, Document, Fact, Report, Section, Table, Verdict};

/// Composes the report; `command` is the line that made it.
pub(crate) fn imported_report(case: &Case, imported: &ImportedHousing, command: &str) -> Report {
    let document =
        Document::new().case(case.source.path.display().to_string()).signed_by("Prepared by").signed_by("Checked by");
    let checks = &imported.checks;
    let passed = checks.iter().filter(|check| check.ok()).count();
    let element = &imported.element;
    let mut report = Report::new(&case.title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Checks of a superelement from a file")
        .document(document)
        .headline("Checks passed", format!("{passed} of {}", checks.len()), Verdict::of(passed == checks.len()))
        .headline("Coordinates", format!("{} + {}", element.interface_dof, element.modal_dof()), Verdict::None);
    let mut modes =
        Table::new("Modes with the interface held", [Column::number("Mode", ""), Column::number("Frequency", "Hz")]);
    for (place, &hz) in imported.record.modal_hz.iter().enumerate() {
        modes = modes.row([Cell::text((place + 1).to_string()), Cell::number(hz, 7)]);
    }
    let has = |given: bool| if given { "yes" } else { "no" };
    let record = &imported.record;
    let sensors: Vec<&str> = record.sensors.iter().map(|s| s.name.as_str()).collect();
    let facts = [
        Fact::new("File", imported.path.display().to_string()),
        Fact::new("Interface coordinates", element.interface_dof.to_string()),
        Fact::new("Modes", element.modal_dof().to_string()),
        Fact::new("Weight", has(record.weight.is_some())),
        Fact::new("Viscous damping", has(record.damping.is_some())),
        Fact::new("Structural damping", has(record.structural.is_some())),
        Fact::new("Sensors", sensors.join(", ")),
    ];
    report = report
        .section(Section::new("What the file has").facts(facts).table(modes))
        .section(
            Section::new("Checks")
                .paragraph("Nothing was condensed here: these are properties that the matrices of any condensed housing have. Every limit is relative.")
                .table(check_table(checks)),
        );
    for text in &imported.notes {
        report = report.warning(text.clone());
    }
    report
}
