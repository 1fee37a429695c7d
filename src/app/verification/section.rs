//! What a section of the suite hands on: checks, what is told beside them, and its part of the report.
//!
//! Cases and numbers that are part of the program: three example cases, and the bearing of Tadina & Boltezar (2011).

use crate::app::case::{Case, Source};
use crate::app::commands::result::ResultHead;
use crate::bearing::BearingDimensions;
use crate::report::{Cell, Column, Section, Table, Verdict, signed, significant};
use schemars::JsonSchema;
use serde::Serialize;
use std::path::PathBuf;

/// Why a built-in check could not be carried out: an error of what is part of the program, which no user can set right.
pub(crate) type VerificationError = Box<dyn std::error::Error + Send + Sync>;

/// A number that was computed, what it ought to be, and under which assumptions both are the same thing; as `verify.json` has it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Check {
    /// What it is.
    pub name: String,
    /// The section that it belongs to.
    pub section: String,
    /// The program's value, in `unit`.
    #[schemars(with = "Option<f64>")]
    pub computed: f64,
    /// What it is compared with, in `unit`; not zero.
    pub reference: f64,
    /// Unit of both; empty for none.
    pub unit: String,
    /// Where the reference comes from.
    pub source: String,
    /// What was assumed, in words.
    pub assumptions: String,
    /// (computed - reference) / reference.
    #[schemars(with = "Option<f64>")]
    pub relative_error: f64,
    /// Largest magnitude of the relative error that passes.
    pub limit: f64,
    /// Why this limit.
    pub limit_reason: String,
    /// Whether it passes; a value that is no number does not.
    pub ok: bool,
}

/// What all checks of a kind have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kind<'a> {
    pub(crate) unit: &'a str,
    pub(crate) source: &'a str,
    pub(crate) assumptions: &'a str,
    pub(crate) reason: &'a str,
}

impl Kind<'_> {
    /// A check of this kind; its section is told by [`SectionResult::of_checks`].
    pub(crate) fn check(&self, name: &str, computed: f64, reference: f64, limit: f64) -> Check {
        let relative_error = (computed - reference) / reference;
        Check {
            name: name.to_owned(),
            section: String::new(),
            computed,
            reference,
            unit: self.unit.to_owned(),
            source: self.source.to_owned(),
            assumptions: self.assumptions.to_owned(),
            relative_error,
            limit,
            limit_reason: self.reason.to_owned(),
            ok: relative_error.abs() <= limit,
        }
    }
}

/// A number that is told, and not judged.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Information {
    /// What it is.
    pub(crate) name: String,
    /// The section that it belongs to.
    pub(crate) section: String,
    /// The program's value, in `unit`.
    pub(crate) computed: f64,
    /// The source's value for what this resembles, in `unit`.
    pub(crate) source_value: Option<f64>,
    /// Unit of both; empty for none.
    pub(crate) unit: String,
    /// What was assumed, in words.
    pub(crate) assumptions: String,
}

impl Check {
    /// One line for a reader.
    pub(crate) fn line(&self) -> String {
        format!(
            "{}: {} {} against {} ({}), {}, limit {}",
            self.name,
            significant(self.computed, 7),
            self.unit,
            significant(self.reference, 7),
            self.source,
            signed(self.relative_error, 3),
            significant(self.limit, 2)
        )
    }
}

/// Errors of one quantity over ever finer sizes, and their orders of convergence; as `verify.json` has them.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct OrdersSummary {
    /// What it is; what stands before a comma is shared by quantities of a kind.
    pub name: String,
    /// What a size is.
    pub size: &'static str,
    /// Unit of the sizes.
    pub unit: &'static str,
    /// Sizes of elements (as a part of the body's) or of steps, falling.
    pub sizes: Vec<f64>,
    /// Relative errors, as many.
    pub relative_errors: Vec<f64>,
    /// Order from each size to the next.
    pub orders: Vec<f64>,
    /// Order that theory gives.
    pub theory: f64,
    /// Largest relative difference of the order on the last refinement from it.
    #[serde(skip)]
    pub(super) limit: f64,
}

/// The result of `plummer verify`.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct VerifyResult<'a> {
    /// What all results have.
    #[serde(flatten)]
    pub head: ResultHead,
    /// Whether orders of convergence are in it.
    pub full: bool,
    /// Numbers with a verdict.
    pub checks: Vec<&'a Check>,
    /// Numbers without.
    pub information: Vec<&'a Information>,
    /// Orders of convergence; absent without `--full`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orders: Option<&'a [OrdersSummary]>,
}

/// A section of the suite, carried out.
#[derive(Debug, Clone)]
pub(crate) struct SectionResult {
    /// Its title.
    pub(crate) title: String,
    /// Numbers with a verdict.
    pub(crate) checks: Vec<Check>,
    /// Numbers without.
    pub(crate) information: Vec<Information>,
    /// Its part of the report, after the tables of checks.
    pub(crate) report: Vec<Section>,
    /// Orders of convergence, if it is the section of these.
    pub(crate) orders: Option<Vec<OrdersSummary>>,
}

impl SectionResult {
    /// A section of checks alone.
    pub(crate) fn of_checks(title: &str, mut checks: Vec<Check>) -> Self {
        for check in &mut checks {
            title.clone_into(&mut check.section);
        }
        Self { title: title.to_owned(), checks, information: Vec::new(), report: Vec::new(), orders: None }
    }

    /// The checks as a table for the report and the terminal.
    pub(crate) fn check_table(&self) -> Table {
        let columns = [
            Column::text("Check"),
            Column::number("Computed", ""),
            Column::number("Reference", ""),
            Column::text("Unit"),
            Column::number("Error", "%"),
            Column::number("Limit", "%"),
            Column::text("Verdict"),
        ];
        Table::new(format!("{}: checks", self.title), columns).rows(self.checks.iter().map(|check| {
            let error = 100.0 * check.relative_error;
            [
                Cell::text(&check.name),
                Cell::number(check.computed, 6),
                Cell::number(check.reference, 6),
                Cell::text(&check.unit),
                Cell::text(signed(error, 2)).value(error),
                Cell::number(100.0 * check.limit, 2),
                Cell::badge(Verdict::of(check.ok)),
            ]
        }))
    }

    /// What stands behind each check.
    fn assumption_table(&self) -> Table {
        let columns = ["Check", "Reference from", "Assumptions", "Why this limit"].map(Column::text);
        let rows = self.checks.iter().map(|c| [&c.name, &c.source, &c.assumptions, &c.limit_reason].map(Cell::text));
        Table::new(format!("{}: assumptions", self.title), columns).rows(rows)
    }

    /// What is told and not judged; `None` if there is nothing.
    pub(crate) fn information_table(&self) -> Option<Table> {
        let columns = [
            Column::text("Quantity"),
            Column::number("Computed", ""),
            Column::number("Source", ""),
            Column::text("Unit"),
            Column::text("Assumptions"),
        ];
        let table = Table::new(format!("{}: for information", self.title), columns);
        let table = table.rows(self.information.iter().map(|row| {
            [
                Cell::text(&row.name),
                Cell::number(row.computed, 5),
                Cell::number_or(row.source_value, 4, "–"),
                Cell::text(&row.unit),
                Cell::text(&row.assumptions),
            ]
        }));
        (!self.information.is_empty()).then_some(table)
    }

    /// The section of the report, tables of checks first.
    pub(crate) fn sections(&self) -> Vec<Section> {
        let mut first = Section::new(&self.title);
        if !self.checks.is_empty() {
            first = first.table(self.check_table()).table(self.assumption_table());
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

/// `examples/tadina2011/beam.toml` as it was when the program was built.
pub const BEAM_CASE: &str = include_str!("../../../examples/tadina2011/beam.toml");

/// `examples/scenes/smooth.toml`, the scene without impacts.
pub(super) const SMOOTH: &str = include_str!("../../../examples/scenes/smooth.toml");

/// `examples/scenes/impact.toml`, the scene with a dent.
pub(super) const IMPACT: &str = include_str!("../../../examples/scenes/impact.toml");

/// Weight of the shaft over its mass as the paper rounds it, m/s^2.
pub(super) const GRAVITY: f64 = 9.81;

/// The bearing of the paper's Table 1.
pub const BEARING: BearingDimensions = BearingDimensions {
    balls: 7,
    ball_radius: 1e-3,
    ball_mass: 3.29e-5,
    inner_race_radius: 2.754e-3,
    outer_race_radius: 4.7565e-3,
    inner_groove_radius: 1.04e-3,
    outer_groove_radius: 1.07e-3,
};

/// A built-in case with keys set as on the command line; `name` is the file name that messages show.
///
/// # Errors
/// Those of [`Case::from_source`].
pub(super) fn built_in(name: &str, text: &str, set: &[&str]) -> Result<Case, VerificationError> {
    Ok(Case::from_source(Source {
        path: PathBuf::from(name),
        text: text.to_owned(),
        set: set.iter().map(|key| (*key).to_owned()).collect(),
    })?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_decides_and_what_is_no_number_fails() {
        let kind = Kind { unit: "N", source: "hand", assumptions: "", reason: "" };
        let check = |computed, limit| kind.check("n", computed, -2.0, limit);
        assert!(check(-2.25, 0.125).ok && check(-1.75, 0.125).ok);
        assert!(!check(-2.25, 0.12).ok && !check(2.0, 0.5).ok);
        assert!(!check(f64::NAN, 1.0).ok);
        let json = serde_json::to_value(check(-2.25, 0.1)).unwrap();
        assert_eq!(json["relative_error"], 0.125);
        assert_eq!(json["ok"], false);
    }
}

#[cfg(test)]
mod built_in_tests {
    use super::*;

    #[test]
    fn the_built_in_bearing_is_that_of_the_case() {
        let case = built_in("beam.toml", BEAM_CASE, &[]).unwrap();
        let setup = crate::app::scene::bearing_setup(&case).unwrap().unwrap();
        assert_eq!(*setup.geometry.dimensions(), BEARING);
        assert!((setup.gravity[1] + GRAVITY).abs() < 1e-12);
    }
}
