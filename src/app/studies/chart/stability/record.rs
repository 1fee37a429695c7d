//! The map as `stability.json`.

use super::{ConditionStability, MethodStability, Stability};
use serde_json::{Value, json};

/// What `stability.json` says beside what every result carries.
#[must_use]
pub fn stability_record(stability: &Stability) -> Value {
    let [kept, all] = stability.modes;
    json!({
        "model": { "modes": kept, "of_modes": all, "residual": stability.model.residual },
        "steps_s": stability.steps_s,
        "conditions": stability.conditions.iter().map(of_condition).collect::<Vec<_>>(),
    })
}

fn of_condition(of: &ConditionStability) -> Value {
    let value = of.condition.value();
    json!({
        "condition": of.condition.axis(),
        "value": value.map(|(value, _)| value),
        "unit": value.map(|(_, unit)| unit),
        "label": of.condition.label(),
        "methods": of.methods.as_ref().ok().map(|all| all.iter().map(of_method).collect::<Vec<_>>()),
        "reason": of.methods.as_ref().err(),
    })
}

fn of_method(of: &MethodStability) -> Value {
    json!({
        "method": of.method.name(),
        "by_tolerance": of.method.chooses_its_steps(),
        "predicted_limit_s": of.predicted_limit_s,
        "measured_limit_s": of.measured_limit_s,
        "chosen_step_s": of.chosen_step_s,
        "resonances": of.windows,
        "phases_looked_at": of.phases[0],
        "phases_at_multiples_of_pi": of.phases[1],
        "steps": of.steps,
        "note": of.note,
    })
}
