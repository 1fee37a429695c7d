//! One number against its reference.

use schemars::JsonSchema;
use serde::Serialize;

/// A number that was computed, what it ought to be, and under which assumptions both are the same thing.
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
    #[schemars(with = "Option<f64>")]
    pub reference: f64,
    /// Unit of both; empty for none.
    pub unit: String,
    /// Where the reference comes from.
    pub source: String,
    /// What was assumed, in words.
    pub assumptions: String,
    /// Largest magnitude of the relative error that passes.
    pub limit: f64,
    /// Why this limit.
    #[serde(rename = "limit_reason")]
    pub reason: String,
}

/// A check with its verdict.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct CheckSummary<'a> {
    /// The check.
    #[serde(flatten)]
    pub check: &'a Check,
    /// (computed - reference) / reference.
    #[schemars(with = "Option<f64>")]
    pub relative_error: f64,
    /// Whether it passes.
    pub ok: bool,
}

/// What all checks of a kind have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kind<'a> {
    pub(super) unit: &'a str,
    pub(super) source: &'a str,
    pub(super) assumptions: &'a str,
    pub(super) reason: &'a str,
}

impl Kind<'_> {
    /// A check of this kind; its section is told by [`SectionResult::of_checks`](super::SectionResult).
    pub(super) fn check(&self, name: &str, computed: f64, reference: f64, limit: f64) -> Check {
        Check {
            name: name.to_owned(),
            section: String::new(),
            computed,
            reference,
            unit: self.unit.to_owned(),
            source: self.source.to_owned(),
            assumptions: self.assumptions.to_owned(),
            limit,
            reason: self.reason.to_owned(),
        }
    }
}

/// A number that is told, and not judged.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Information {
    /// What it is.
    pub name: String,
    /// The section that it belongs to.
    pub section: String,
    /// The program's value, in `unit`.
    pub computed: f64,
    /// The source's value for what this resembles, in `unit`.
    pub source_value: Option<f64>,
    /// Unit of both; empty for none.
    pub unit: String,
    /// What was assumed, in words.
    pub assumptions: String,
}

impl Check {
    /// (computed - reference) / reference.
    #[must_use]
    pub fn relative_error(&self) -> f64 {
        (self.computed - self.reference) / self.reference
    }

    /// Whether it passes; a value that is no number does not.
    #[must_use]
    pub fn ok(&self) -> bool {
        self.relative_error().abs() <= self.limit
    }

    /// What `verify.json` says of it.
    #[must_use]
    pub fn summary(&self) -> CheckSummary<'_> {
        CheckSummary {
            check: self,
            relative_error: self.relative_error(),
            ok: self.ok(),
        }
    }

    /// One line for a reader.
    #[must_use]
    pub fn line(&self) -> String {
        format!(
            "{}: {:.6e} {} against {:.6e} ({}), {:+.2e}, limit {:.1e}",
            self.name,
            self.computed,
            self.unit,
            self.reference,
            self.source,
            self.relative_error(),
            self.limit
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_decides_and_what_is_no_number_fails() {
        let check = |computed, limit| Check {
            name: "n".to_owned(),
            section: "s".to_owned(),
            computed,
            reference: -2.0,
            unit: "N".to_owned(),
            source: "hand".to_owned(),
            assumptions: String::new(),
            limit,
            reason: String::new(),
        };
        assert!(check(-2.25, 0.125).ok() && check(-1.75, 0.125).ok());
        assert!(!check(-2.25, 0.12).ok() && !check(2.0, 0.5).ok());
        assert!(!check(f64::NAN, 1.0).ok());
        let json = serde_json::to_value(check(-2.25, 0.1).summary()).unwrap();
        assert_eq!(json["relative_error"], 0.125);
        assert_eq!(json["ok"], false);
    }
}
