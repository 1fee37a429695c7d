//! One method under one condition: over a grid of steps, and its limits.

use super::condition::{Measurement, observe};
use crate::numerics::ode::{LinearCoordinate, Linearised, Method, Resonance, SecondOrderSystem, fastest, growth};
use crate::report::{StepState, significant};
use std::f64::consts::PI;

/// Steps of the linear system at each step length of the grid.
const LINEAR_STEPS: u32 = 1000;

/// Steps of it where a resonance is looked for: where it drives a mode it does so within some tens.
const RESONANT_STEPS: u32 = 300;

/// Halvings of the logarithm between two steps of the grid.
const HALVINGS: usize = 6;

/// Distances from `h omega = k pi` at which a resonance is looked for, relative: it may lie on one side alone.
const BESIDE: [f64; 5] = [0.0, -0.004, 0.004, -0.02, 0.02];

/// Farthest end of a resonance, relative, and halvings that find it.
const WIDEST: f64 = 0.2;
const EDGE_HALVINGS: usize = 5;

/// A step of the grid.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct StepRecord {
    /// Its length, s.
    pub step_s: f64,
    /// What the amplification of small motions says.
    pub predicted: StepState,
    /// What short runs do.
    pub measured: StepState,
}

/// Steps in which a mode is in resonance.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct Window {
    /// Shortest of them, s.
    pub from_s: f64,
    /// Longest of them, s.
    pub to_s: f64,
    /// The mode and the multiple of pi.
    #[serde(flatten)]
    pub resonance: Resonance,
    /// Logarithmic growth a step where it was found.
    pub growth_per_step: f64,
}

/// How long a method's steps can be under a condition; as `stability.json` has it.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct MethodStability {
    /// The method.
    #[serde(serialize_with = "serialize_name")]
    #[schemars(with = "&str")]
    pub method: Method,
    /// Whether it chooses its steps by a tolerance.
    pub by_tolerance: bool,
    /// By the amplification of small motions, resonances left out, s; none if nothing grows. Of a method that chooses its steps the
    /// longest in which none does.
    pub predicted_limit_s: Option<f64>,
    /// By short runs, to half a percent, s; none if all steps of the grid are stable, or none is.
    pub measured_limit_s: Option<f64>,
    /// Mean length of a step that the method chose, s.
    pub chosen_step_s: Option<f64>,
    /// Resonances in steps in which contacts alone are stable: of the lowest multiples of pi, and of these the longest steps.
    pub resonances: Vec<Window>,
    /// How many phases were looked at for them.
    pub phases_looked_at: usize,
    /// How many there are.
    pub phases_at_multiples_of_pi: usize,
    /// The grid, in ascending order.
    pub steps: Vec<StepRecord>,
    /// What is to be said beside.
    pub note: Option<String>,
}

fn serialize_name<S: serde::Serializer>(method: &Method, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(method.name())
}

/// A method that chooses its steps: what it chose.
pub(super) fn by_tolerance(
    measurement: &Measurement,
    linearised: &mut Linearised,
    method: Method,
    [sample, samples]: [f64; 2],
) -> MethodStability {
    let seen = observe(measurement.variant, method, sample, samples as u32, |_, _| true);
    let predicted_limit_s = method.limit_of(linearised).map(|limit| limit.step_s);
    let note = match predicted_limit_s {
        Some(_) => "in longer steps small motions grow up to the tolerance",
        None => "steps follow from the tolerance, which is the limit",
    };
    MethodStability {
        method,
        by_tolerance: method.chooses_its_steps(),
        predicted_limit_s,
        measured_limit_s: None,
        chosen_step_s: seen.as_ref().ok().copied(),
        resonances: Vec::new(),
        phases_looked_at: 0,
        phases_at_multiples_of_pi: 0,
        steps: Vec::new(),
        note: Some(seen.err().map_or_else(|| note.to_owned(), |failure| failure.to_string())),
    }
}

/// A method with equal steps, on a grid; at most `most` phases are looked at for resonances.
pub(super) fn on_grid(
    measurement: &Measurement,
    linearised: &mut Linearised,
    method: Method,
    grid: &[f64],
    most: usize,
) -> MethodStability {
    let scale = fastest(linearised).unwrap_or(1.0);
    let predict = |linearised: &mut Linearised, h: f64| {
        let found = growth(linearised, method, h, scale, LINEAR_STEPS);
        match Resonance::of(&found, linearised, h) {
            Some(_) => StepState::Resonant,
            None if found.is_unstable() => StepState::Unstable,
            None => StepState::Stable,
        }
    };
    let mut failure = None;
    let mut steps = Vec::with_capacity(grid.len());
    for &step_s in grid {
        // what is cut short is left out as a whole
        if measurement.variant.until.is_over() {
            break;
        }
        let predicted = predict(linearised, step_s);
        let (unstable, why) = measurement.unstable(method, step_s);
        // a run tells that something grows, the prediction whether it is a mode in resonance
        let measured = match predicted {
            _ if !unstable => StepState::Stable,
            StepState::Resonant => StepState::Resonant,
            _ => StepState::Unstable,
        };
        if measured == StepState::Unstable && failure.is_none() {
            failure = why;
        }
        steps.push(StepRecord { step_s, predicted, measured });
    }
    let predicted_limit_s = method.limit_of(linearised).map(|limit| limit.step_s);
    let first = steps.iter().position(|step| step.measured == StepState::Unstable);
    let measured_limit_s = first.filter(|&place| place > 0).map(|place| {
        let (mut stable, mut grows) = (steps[place - 1].step_s, steps[place].step_s);
        for _ in 0..HALVINGS {
            let middle = (stable * grows).sqrt();
            let (unstable, _) = measurement.unstable(method, middle);
            if unstable && predict(linearised, middle) != StepState::Resonant {
                grows = middle;
            } else {
                stable = middle;
            }
        }
        stable
    });
    let longest = grid.last().copied().unwrap_or(0.0);
    let note = match first {
        None => Some(format!("none found up to a step of {} µs", significant(1e6 * longest, 3))),
        Some(0) => Some("grows in the shortest step of the grid".to_owned()),
        Some(_) => failure.filter(|_| method.is_implicit()).map(|failure| failure.to_string()),
    };
    // beyond it the contacts alone are unstable, whatever the modes do
    let reach = (2.0 / scale).min(longest);
    let phases = if method.is_implicit() { Vec::new() } else { phases(linearised.linear(), reach) };
    let in_time = |_: &&f64| !measurement.variant.until.is_over();
    MethodStability {
        method,
        by_tolerance: method.chooses_its_steps(),
        predicted_limit_s,
        measured_limit_s,
        chosen_step_s: None,
        resonances: windows(linearised, method, scale, phases.iter().take(most).take_while(in_time)),
        phases_looked_at: phases.len().min(most),
        phases_at_multiples_of_pi: phases.len(),
        steps,
        note,
    }
}

/// Resonances in steps near those (s) in which the phase of a mode is a multiple of pi; `scale` (1/s) is the fastest motion.
fn windows<'a>(
    linearised: &mut Linearised,
    method: Method,
    scale: f64,
    phases: impl Iterator<Item = &'a f64>,
) -> Vec<Window> {
    let mut windows: Vec<Window> = Vec::new();
    for &centre in phases {
        let at = |linearised: &mut Linearised, h: f64| {
            let found = growth(linearised, method, h, scale, RESONANT_STEPS);
            Resonance::of(&found, linearised, h).map(|of| (of, found.per_step))
        };
        let mut found = BESIDE.iter().filter_map(|beside| {
            let h = centre * (1.0 + beside);
            at(linearised, h).map(|found| (h, found))
        });
        let Some((peak, (resonance, growth_per_step))) = found.next() else {
            continue;
        };
        drop(found);
        if windows.iter().any(|window| (window.from_s..=window.to_s).contains(&peak)) {
            continue;
        }
        let mut edge = |side: f64| {
            let (mut inside, mut outside) = (0.0, WIDEST);
            for _ in 0..EDGE_HALVINGS {
                let middle = 0.5 * (inside + outside);
                if at(linearised, peak * (1.0 + side * middle)).is_some() {
                    inside = middle;
                } else {
                    outside = middle;
                }
            }
            peak * (1.0 + side * inside)
        };
        windows.push(Window { from_s: edge(-1.0), to_s: edge(1.0), resonance, growth_per_step });
    }
    windows
}

/// Steps up to `reach` (s) in which the phase of a mode is a multiple of pi: the lowest multiples first, of each the longest steps.
fn phases(linear: &[LinearCoordinate], reach: f64) -> Vec<f64> {
    let mut phases = Vec::new();
    for held in linear {
        let half = PI / held.squared_frequency.sqrt();
        let count = (reach / half).floor();
        if count >= 1.0 && count.is_finite() {
            phases.extend((1..=count as usize).map(|multiple| (multiple, multiple as f64 * half)));
        }
    }
    phases.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    phases.into_iter().map(|(_, step)| step).collect()
}
