//! What `verify.json` says.

use super::section::{CheckSummary, Information, OrdersSummary};
use crate::app::commands::result::ResultHead;
use schemars::JsonSchema;
use serde::Serialize;

/// The result of `plummer verify`.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct VerifyResult<'a> {
    /// What all results have.
    #[serde(flatten)]
    pub head: ResultHead,
    /// Whether orders of convergence are in it.
    pub full: bool,
    /// Numbers with a verdict.
    pub checks: Vec<CheckSummary<'a>>,
    /// Numbers without.
    pub information: Vec<&'a Information>,
    /// Orders of convergence; absent without `--full`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orders: Option<&'a [OrdersSummary]>,
}
