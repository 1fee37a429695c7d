//! What `stability.json` says.

use super::{ConditionStability, MethodStability, Stability, StepRecord, Window};
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
    pub methods: Option<Vec<MethodSummary<'a>>>,
    /// Why it cannot.
    pub reason: Option<&'a str>,
}

/// How long a method's steps can be under a condition.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct MethodSummary<'a> {
    /// The method.
    pub method: &'static str,
    /// Whether it chooses its steps by a tolerance.
    pub by_tolerance: bool,
    /// Longest step by the amplification of small motions, resonances left out, s; `None` if nothing grows.
    pub predicted_limit_s: Option<f64>,
    /// Longest step by short runs, s; `None` if all steps of the grid are stable, or none is.
    pub measured_limit_s: Option<f64>,
    /// Mean length of a step that the method chose, s.
    pub chosen_step_s: Option<f64>,
    /// Resonances in steps in which contacts alone are stable.
    pub resonances: &'a [Window],
    /// How many phases were looked at for them.
    pub phases_looked_at: usize,
    /// How many there are.
    pub phases_at_multiples_of_pi: usize,
    /// The grid.
    pub steps: &'a [StepRecord],
    /// What is to be said beside.
    pub note: Option<&'a str>,
}

impl Stability {
    /// What `stability.json` says of it.
    #[must_use]
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
        let (value, methods) = (of.condition.value(), of.methods.as_ref());
        Self {
            condition: of.condition.axis(),
            value: value.map(|(value, _)| value),
            unit: value.map(|(_, unit)| unit),
            label: of.condition.label(),
            methods: methods.ok().map(|all| all.iter().map(MethodSummary::of).collect()),
            reason: methods.err().map(String::as_str),
        }
    }
}

impl<'a> MethodSummary<'a> {
    fn of(of: &'a MethodStability) -> Self {
        let [phases_looked_at, phases_at_multiples_of_pi] = of.phases;
        Self {
            method: of.method.name(),
            by_tolerance: of.method.chooses_its_steps(),
            predicted_limit_s: of.predicted_limit_s,
            measured_limit_s: of.measured_limit_s,
            chosen_step_s: of.chosen_step_s,
            resonances: &of.windows,
            phases_looked_at,
            phases_at_multiples_of_pi,
            steps: &of.steps,
            note: of.note.as_deref(),
        }
    }
}
