//! The map as a picture, and a resonance by itself.

use super::Stability;
use crate::numerics::ode::{LinearCoordinate, SecondOrderSystem, State, Tangent};
use crate::numerics::ode::{Linearised, Method, growth};
use crate::report::{Abscissa, Axis, Curve, Plot, StepMap, StepPanel, significant};
use std::f64::consts::PI;

/// Stiffness of the contact on the oscillator, in units of its own.
const CONTACT: f64 = 0.05;

/// Phases shown, in units of pi, and how many.
const PHASES: [f64; 2] = [0.1, 3.2];
const POINTS: usize = 250;

/// Steps from which each growth is taken.
const STEPS: u32 = 400;

/// States of all steps, conditions and methods, as they were measured.
pub(crate) fn stability_map(stability: &Stability) -> StepMap {
    let conditions = || {
        let good = stability.conditions.iter();
        good.filter_map(|of| Some((&of.label, of.methods.as_ref()?)))
    };
    let mut methods: Vec<Method> = Vec::new();
    for of in conditions().flat_map(|(_, methods)| methods) {
        if !of.steps.is_empty() && !methods.contains(&of.method) {
            methods.push(of.method);
        }
    }
    let panels = methods.into_iter().map(|method| {
        let of = || conditions().map(|(_, all)| all.iter().find(|of| of.method == method));
        let none = || vec![None; stability.steps_s.len()];
        StepPanel {
            name: method.name().to_owned(),
            cells: of()
                .map(|of| {
                    let states = of.map(|of| of.steps.iter().map(|step| Some(step.measured)));
                    states.map_or_else(none, Iterator::collect)
                })
                .collect(),
            limits: of()
                .map(|of| of.map_or([None; 2], |of| [of.predicted_limit_s, of.measured_limit_s]))
                .map(|limits| limits.map(|limit| limit.map(|limit| 1e6 * limit)))
                .collect(),
        }
    });
    StepMap {
        title: "Stability of the methods".to_owned(),
        caption: Some("State of short runs in each step; one thing is varied at a time. Black line: the limit that the amplification of small motions about the equilibrium predicts; circle: the one that runs have.".to_owned()),
        axis: "Step".to_owned(),
        unit: "µs".to_owned(),
        steps: stability.steps_s.iter().map(|step| 1e6 * step).collect(),
        rows: conditions().map(|(label, _)| label.clone()).collect(),
        panels: panels.collect(),
    }
}

/// Growth of an oscillator with a contact on it, over the phase that it makes in a step.
pub(crate) fn resonance_plot() -> Plot {
    let [first, last] = PHASES;
    let phases: Vec<f64> = (0..POINTS).map(|k| first + (last - first) * k as f64 / (POINTS - 1) as f64).collect();
    let curve = |method: Method, colour: usize| {
        let grown = phases.iter().map(|phase| {
            let mut oscillator = OnContact::linearised();
            let found = growth(&mut oscillator, method, phase * PI, 1.0, STEPS);
            found.per_step.max(0.0)
        });
        Curve::new(method.name(), Abscissa::Points(phases.clone()), grown.collect()).colour(colour)
    };
    Plot::new(
        "Resonance of the step with a mode",
        Axis::new("Phase of the mode in a step, in units of π", ""),
        Axis::new("Growth a step, natural logarithm", "").range(0.0, 0.5),
    )
    .caption(format!(
        "An undamped oscillator, stepped exactly, with a contact {} times as stiff on it: near odd multiples of π (exponential) and just below every one (splitting) the contact drives it, whatever its damping takes out.",
        significant(CONTACT, 1)
    ))
    .curve(curve(Method::Exponential, 0))
    .curve(curve(Method::Splitting, 5))
    .curve(curve(Method::ExponentialAdams { tolerance: None }, 1))
}

/// `y'' + y = -CONTACT y`, the right-hand side as a force.
struct OnContact([LinearCoordinate; 1]);

impl OnContact {
    fn linearised() -> Linearised {
        let held = LinearCoordinate { squared_frequency: 1.0, damping: 0.0 };
        let rest = State { t: 0.0, y: vec![0.0], v: vec![0.0] };
        Linearised::new(&mut Self([held]), &rest)
    }
}

impl SecondOrderSystem for OnContact {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.0
    }

    fn force_into(&mut self, _t: f64, y: &[f64], _v: &[f64], g: &mut [f64]) {
        g[0] = -CONTACT * y[0];
    }

    fn tangent_into(&mut self, _t: f64, _y: &[f64], _v: &[f64], tangent: &mut Tangent) {
        let term = tangent.add();
        (term.left[0], term.position[0]) = (1.0, -CONTACT);
    }
}
