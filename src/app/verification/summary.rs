//! What `verify.json` says.

use super::check::CheckSummary;
use super::orders::OrdersSummary;
use super::readings::ReadingsSummary;
use super::{FormulationRow, Hypothesis, Information};
use crate::app::commands::result::ResultHead;
use schemars::JsonSchema;
use serde::Serialize;

/// The result of `plummer verify`.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct VerifyResult<'a> {
    /// What all results have.
    #[serde(flatten)]
    pub head: ResultHead,
    /// Whether orders of convergence and the study of readings are in it.
    pub full: bool,
    /// Numbers with a verdict.
    pub checks: Vec<CheckSummary<'a>>,
    /// Numbers without.
    pub information: Vec<&'a Information>,
    /// What sections say beside.
    #[serde(flatten)]
    pub values: SectionValues,
}

/// What sections say beside their checks; absent of those that were not carried out.
#[derive(Debug, Clone, Default, Serialize, JsonSchema)]
pub struct SectionValues {
    /// Ways to arrive at the source's stiffness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table_1_stiffness: Option<Vec<Hypothesis>>,
    /// Loaded frequencies of the built-in case with other choices.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formulations: Option<Vec<FormulationRow>>,
    /// Orders of convergence.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orders: Option<Vec<OrdersSummary>>,
    /// How unique the reading of the source is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub readings: Option<ReadingsSummary>,
}

impl SectionValues {
    /// These, and those of another section.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            table_1_stiffness: self.table_1_stiffness.or(other.table_1_stiffness),
            formulations: self.formulations.or(other.formulations),
            orders: self.orders.or(other.orders),
            readings: self.readings.or(other.readings),
        }
    }
}
