//! What `stability.json` says.

use super::{ConditionStability, MethodStability, Stability};
use schemars::JsonSchema;
use serde::Serialize;

/// Which steps methods can take, under which conditions.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct StabilitySummary<'a> {
    /// What of the case was modelled.
    pub model: StabilityModel,
    /// Steps of the grid, s, ascending.
    pub steps_s: &'a [f64],
    /// The conditions, the case itself first.
    pub conditions: Vec<ConditionSummary<'a>>,
}

/// What of the case was modelled.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct StabilityModel {
    /// Kept modes of ring and housing.
    pub modes: usize,
    /// Of how many.
    pub of_modes: usize,
    /// Whether the static residual of the others was in use.
    pub residual: bool,
}

/// All methods under a condition.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ConditionSummary<'a> {
    /// What is other than in the case.
    pub condition: &'static str,
    /// Its value, in `unit`; `None` for a condition without.
    pub value: Option<f64>,
    /// Unit of the value, "x" for a factor.
    pub unit: Option<&'static str>,
    /// Both in words.
    pub label: String,
    /// The methods; `None` where the bearing cannot be in the condition.
    pub methods: Option<&'a [MethodStability]>,
    /// Why it cannot.
    pub reason: Option<&'a str>,
}

impl Stability {
    /// What `stability.json` says of it.
    pub(crate) fn summary(&self) -> StabilitySummary<'_> {
        let [modes, of_modes] = self.modes;
        StabilitySummary {
            model: StabilityModel { modes, of_modes, residual: self.model.residual },
            steps_s: &self.steps_s,
            conditions: self.conditions.iter().map(ConditionSummary::of).collect(),
        }
    }
}

impl<'a> ConditionSummary<'a> {
    fn of(of: &'a ConditionStability) -> Self {
        let ((condition, value), methods) = (of.condition.axis_and_value(), of.methods.as_ref());
        Self {
            condition,
            value: value.map(|(value, _)| value),
            unit: value.map(|(_, unit)| unit),
            label: of.condition.label(),
            methods: methods.ok().map(Vec::as_slice),
            reason: methods.err().map(String::as_str),
        }
    }
}
