//! A check with its limit.

use schemars::JsonSchema;
use serde::Serialize;

/// Which side of its limit a value should be on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub enum Bound {
    /// Good up to the limit.
    #[serde(rename = "at most")]
    AtMost,
    /// Good from the limit on.
    #[serde(rename = "at least")]
    AtLeast,
}

/// A check and its verdict.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Check {
    /// Short name.
    pub name: &'static str,
    /// What the value is.
    pub what: String,
    /// What was found, relative to what `what` says.
    #[schemars(with = "Option<f64>")]
    pub value: f64,
    /// What passes.
    pub limit: f64,
    /// On which side of the limit.
    pub bound: Bound,
}

impl Check {
    /// A value that is good up to its limit.
    pub(crate) fn at_most(name: &'static str, what: impl Into<String>, value: f64, limit: f64) -> Self {
        Self { name, what: what.into(), value, limit, bound: Bound::AtMost }
    }

    /// A value that is good from its limit on.
    pub(crate) fn at_least(name: &'static str, what: impl Into<String>, value: f64, limit: f64) -> Self {
        Self { bound: Bound::AtLeast, ..Self::at_most(name, what, value, limit) }
    }

    /// Whether it passes; a value that is no number does not.
    pub fn ok(&self) -> bool {
        match self.bound {
            Bound::AtMost => self.value <= self.limit,
            Bound::AtLeast => self.value >= self.limit,
        }
    }
}
