//! What a section of the suite hands on: checks, what is told beside them, and its part of the report.

use super::{Check, Information, SectionValues};
use crate::report::{Cell, Column, Section, Table, Verdict, significant};

/// A section of the suite, carried out.
#[derive(Debug, Clone)]
pub struct SectionResult {
    /// Its title.
    pub title: String,
    /// Numbers with a verdict.
    pub checks: Vec<Check>,
    /// Numbers without.
    pub information: Vec<Information>,
    /// Its part of the report, after the tables of checks.
    pub report: Vec<Section>,
    /// What the result file says of it beside the checks.
    pub values: SectionValues,
    /// Files that stand beside the report: path below the results' folder, content.
    pub files: Vec<(String, String)>,
    /// Lines for a terminal beside the table of checks.
    pub lines: Vec<String>,
}

impl SectionResult {
    /// A section of checks alone.
    pub(super) fn of_checks(title: &str, mut checks: Vec<Check>) -> Self {
        for check in &mut checks {
            title.clone_into(&mut check.section);
        }
        Self {
            title: title.to_owned(),
            checks,
            information: Vec::new(),
            report: Vec::new(),
            values: SectionValues::default(),
            files: Vec::new(),
            lines: Vec::new(),
        }
    }

    /// The checks as a table for the report and the terminal.
    #[must_use]
    pub fn check_table(&self) -> Table {
        let columns = [
            Column::text("Check"),
            Column::number("Computed", ""),
            Column::number("Reference", ""),
            Column::text("Unit"),
            Column::number("Error", "%"),
            Column::number("Limit", "%"),
            Column::text("Verdict"),
        ];
        let mut table = Table::new(format!("{}: checks", self.title), columns);
        for check in &self.checks {
            let error = 100.0 * check.relative_error();
            table = table.row([
                Cell::text(&check.name),
                Cell::number(check.computed, 6),
                Cell::number(check.reference, 6),
                Cell::text(&check.unit),
                Cell::text(signed(error)).value(error),
                Cell::number(100.0 * check.limit, 2),
                Cell::badge(Verdict::of(check.ok())),
            ]);
        }
        table
    }

    /// What stands behind each check.
    #[must_use]
    pub fn assumption_table(&self) -> Table {
        let columns = [
            Column::text("Check"),
            Column::text("Reference from"),
            Column::text("Assumptions"),
            Column::text("Why this limit"),
        ];
        let mut table = Table::new(format!("{}: assumptions", self.title), columns);
        for check in &self.checks {
            table = table.row([
                Cell::text(&check.name),
                Cell::text(&check.source),
                Cell::text(&check.assumptions),
                Cell::text(&check.reason),
            ]);
        }
        table
    }

    /// What is told and not judged; `None` if there is nothing.
    #[must_use]
    pub fn information_table(&self) -> Option<Table> {
        let columns = [
            Column::text("Quantity"),
            Column::number("Computed", ""),
            Column::number("Source", ""),
            Column::text("Unit"),
            Column::text("Assumptions"),
        ];
        let mut table = Table::new(format!("{}: for information", self.title), columns);
        for row in &self.information {
            table = table.row([
                Cell::text(&row.name),
                Cell::number(row.computed, 5),
                row.source_value
                    .map_or_else(|| Cell::text("–"), |value| Cell::number(value, 4)),
                Cell::text(&row.unit),
                Cell::text(&row.assumptions),
            ]);
        }
        (!self.information.is_empty()).then_some(table)
    }

    /// The section of the report, tables of checks first.
    #[must_use]
    pub fn sections(&self) -> Vec<Section> {
        let mut first = Section::new(&self.title);
        if !self.checks.is_empty() {
            first = first
                .table(self.check_table())
                .table(self.assumption_table());
        }
        if let Some(table) = self.information_table() {
            first = first.table(table);
        }
        let mut sections = self.report.iter().cloned();
        if let Some(own) = sections.next() {
            first.blocks.extend(own.blocks);
        }
        std::iter::once(first).chain(sections).collect()
    }
}

/// A number of per cent with its sign, two significant digits.
pub(super) fn signed(value: f64) -> String {
    if value > 0.0 {
        format!("+{}", significant(value, 2))
    } else {
        significant(value, 2)
    }
}
