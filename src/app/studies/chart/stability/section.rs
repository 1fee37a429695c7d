//! The map in a report.
//!
//! The map as a picture, and a resonance by itself.

use super::{ConditionSummary, MethodStability, Stability, StabilityModel};
use crate::app::case::Case;
use crate::numerics::ode::{LinearCoordinate, Linearised, Method, SecondOrderSystem, State, Tangent, growth};
use crate::report::{
    Abscissa, Axis, Block, Cell, Column, Curve, Plot, Report, Section, StepMap, StepPanel, Table, significant,
};
use std::f64::consts::PI;

/// A report of the map alone; `command` is the line that made it.
pub(crate) fn stability_report(case: &Case, stability: &Stability, command: &str) -> Report {
    Report::new(&case.title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Stability of the integration methods")
        .section(stability_section(stability))
}

/// Picture, resonance and tables.
pub(crate) fn stability_section(stability: &Stability) -> Section {
    let StabilityModel { modes: kept, of_modes: all, .. } = stability.model;
    let section = Section::new("Stability map")
        .paragraph(format!(
            "Which steps a method can take, on the program's own model ({kept} of {all} modes) and, in the last rows, on all of them. The predicted limit is that of small motions about the equilibrium: the method itself steps the linearised system, and the limit is the step from which a motion grows by more than 0.05 % a step. The measured one is that of two short runs of the whole model side by side: beyond it they end with an error, run ten times as fast as finer ones, or are a hundred times as far apart as these. Where balls strike, the contacts are stiffer than in equilibrium and the measured limit is the lower one; impacts also part nearby runs by chance, and a single dark cell below the limit may be that. A growth too slow for short runs is not seen, and a limit says nothing of accuracy, which is lost much earlier."
        ));
    let section = match stability_map(stability) {
        None => section.paragraph("The budget ended before the first condition was computed."),
        Some(map) => section.block(Block::StepMap(map)),
    };
    section.table(limits(stability)).table(chosen(stability)).plot(resonance_plot()).table(resonances(stability))
}

/// All methods that were computed under all conditions.
fn cells(stability: &Stability) -> impl Iterator<Item = (&ConditionSummary, &MethodStability)> {
    let conditions = stability.conditions.iter();
    conditions.flat_map(|of| of.methods.iter().flatten().map(move |method| (of, method)))
}

/// Names of a condition and a method in the first columns of the tables.
fn names(of: &ConditionSummary, method: &MethodStability) -> [Cell; 2] {
    [Cell::text(&of.label), Cell::text(method.method.name())]
}

/// A time in microseconds, or a dash.
fn microseconds(seconds: Option<f64>) -> Cell {
    Cell::number_or(seconds.map(|seconds| 1e6 * seconds), 3, "–")
}

/// What stands where nothing was computed or found.
fn dashes<const N: usize>() -> [Cell; N] {
    std::array::from_fn(|_| Cell::text("–"))
}

fn limits(stability: &Stability) -> Table {
    let columns = [
        Column::text("Condition"),
        Column::text("Method"),
        Column::number("Predicted", "µs"),
        Column::number("Measured", "µs"),
        Column::number("Measured over predicted", ""),
        Column::text("Remark"),
    ];
    let computed = cells(stability).filter(|(_, of)| !of.steps.is_empty()).map(|(of, method)| {
        let limits = method.predicted_limit_s.zip(method.measured_limit_s);
        let values = [
            microseconds(method.predicted_limit_s),
            microseconds(method.measured_limit_s),
            Cell::number_or(limits.map(|(predicted, measured)| measured / predicted), 3, "–"),
            Cell::text(method.note.as_deref().unwrap_or("")),
        ];
        names(of, method).into_iter().chain(values).collect::<Vec<_>>()
    });
    let refused = stability.conditions.iter().filter_map(|of| {
        let reason = of.reason.as_ref()?;
        let label = [Cell::text(&of.label)];
        Some(label.into_iter().chain(dashes::<4>()).chain([Cell::text(reason)]).collect())
    });
    Table::new("Limits", columns).rows(computed.chain(refused))
}

fn chosen(stability: &Stability) -> Table {
    Table::new(
        "Steps of the methods that choose them",
        [Column::text("Condition"), Column::text("Method"), Column::number("Mean step", "µs"), Column::text("Remark")],
    )
    .rows(cells(stability).filter(|(_, of)| of.steps.is_empty()).map(|(of, method)| {
        let note = Cell::text(method.note.as_deref().unwrap_or(""));
        names(of, method).into_iter().chain([microseconds(method.chosen_step_s), note])
    }))
}

fn resonances(stability: &Stability) -> Table {
    let table = Table::new(
        "Resonances of the step with a mode",
        [
            Column::text("Condition"),
            Column::text("Method"),
            Column::number("From", "µs"),
            Column::number("To", "µs"),
            Column::number("Mode", "kHz"),
            Column::text("Phase"),
            Column::number("Growth a step", ""),
        ],
    );
    let windows = cells(stability).flat_map(|(of, method)| method.resonances.iter().map(move |at| (of, method, at)));
    let table = table.rows(windows.map(|(of, method, window)| {
        let values = [
            Cell::number(1e6 * window.from_s, 4),
            Cell::number(1e6 * window.to_s, 4),
            Cell::number(1e-3 * window.resonance.mode_hz, 4),
            Cell::text(match window.resonance.multiple {
                1 => "π".to_owned(),
                more => format!("{more} π"),
            }),
            Cell::number(window.growth_per_step, 2),
        ];
        names(of, method).into_iter().chain(values)
    }));
    if table.rows.is_empty() {
        let looked: usize = cells(stability).map(|(_, of)| of.phases_looked_at).sum();
        let what = format!("none in {} phases", significant(looked as f64, 6));
        return table.row([Cell::text(what)].into_iter().chain(dashes::<6>()));
    }
    table
}

/// Stiffness of the contact on the oscillator, in units of its own.
const CONTACT: f64 = 0.05;

/// Phases shown, in units of pi, and how many.
const PHASES: [f64; 2] = [0.1, 3.2];
const POINTS: usize = 250;

/// Steps from which each growth is taken.
const STEPS: u32 = 400;

/// States of all steps, conditions and methods, as they were measured; `None` where time ran out before the first condition.
pub(crate) fn stability_map(stability: &Stability) -> Option<StepMap> {
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
                    // where time ran out, the other steps have no state
                    let mut states = none();
                    let measured = of.into_iter().flat_map(|of| &of.steps);
                    states.iter_mut().zip(measured).for_each(|(state, step)| *state = Some(step.measured));
                    states
                })
                .collect(),
            limits: of()
                .map(|of| of.map_or([None; 2], |of| [of.predicted_limit_s, of.measured_limit_s]))
                .map(|limits| limits.map(|limit| limit.map(|limit| 1e6 * limit)))
                .collect(),
        }
    });
    let panels: Vec<StepPanel> = panels.collect();
    (!panels.is_empty()).then(|| StepMap {
        title: "Stability of the methods".to_owned(),
        caption: Some("State of short runs in each step; one thing is varied at a time. Black line: the limit that the amplification of small motions about the equilibrium predicts; circle: the one that runs have.".to_owned()),
        axis: "Step".to_owned(),
        unit: "µs".to_owned(),
        steps: stability.steps_s.iter().map(|step| 1e6 * step).collect(),
        rows: conditions().map(|(label, _)| label.clone()).collect(),
        panels,
    })
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
