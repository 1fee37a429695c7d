//! The map in a report.

use super::{ConditionStability, MethodStability, Stability, resonance_plot, stability_map};
use crate::app::case::Case;
use crate::report::{Cell, Column, Report, Section, Table, significant};

/// A report of the map alone; `command` is the line that made it.
#[must_use]
pub(crate) fn stability_report(case: &Case, stability: &Stability, command: &str) -> Report {
    Report::new(&case.title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Stability of the integration methods")
        .section(stability_section(stability))
}

/// Picture, resonance and tables.
#[must_use]
pub(crate) fn stability_section(stability: &Stability) -> Section {
    let [kept, all] = stability.modes;
    Section::new("Stability map")
        .paragraph(format!(
            "Which steps a method can take, on the program's own model ({kept} of {all} modes) and, in the last rows, on all of them. The predicted limit is that of small motions about the equilibrium: the method itself steps the linearised system, and the limit is the step from which a motion grows by more than 0.05 % a step. The measured one is that of two short runs of the whole model side by side: beyond it they end with an error, run ten times as fast as finer ones, or are a hundred times as far apart as these. Where balls strike, the contacts are stiffer than in equilibrium and the measured limit is the lower one; impacts also part nearby runs by chance, and a single dark cell below the limit may be that. A growth too slow for short runs is not seen, and a limit says nothing of accuracy, which is lost much earlier."
        ))
        .step_map(stability_map(stability))
        .table(limits(stability))
        .table(chosen(stability))
        .plot(resonance_plot())
        .table(resonances(stability))
}

/// All methods that were computed under all conditions.
fn cells(stability: &Stability) -> impl Iterator<Item = (&ConditionStability, &MethodStability)> {
    let conditions = stability.conditions.iter();
    conditions.flat_map(|of| of.methods.iter().flatten().map(move |method| (of, method)))
}

fn microseconds(step: Option<f64>) -> Cell {
    step.map_or_else(|| Cell::text("–"), |step| Cell::number(1e6 * step, 3))
}

fn limits(stability: &Stability) -> Table {
    let mut table = Table::new(
        "Limits",
        [
            Column::text("Condition"),
            Column::text("Method"),
            Column::number("Predicted", "µs"),
            Column::number("Measured", "µs"),
            Column::number("Measured over predicted", ""),
            Column::text("Remark"),
        ],
    );
    for (of, method) in cells(stability).filter(|(_, of)| !of.steps.is_empty()) {
        let limits = method.predicted_limit_s.zip(method.measured_limit_s);
        table = table.row([
            Cell::text(of.condition.label()),
            Cell::text(method.method.name()),
            microseconds(method.predicted_limit_s),
            microseconds(method.measured_limit_s),
            limits.map_or_else(|| Cell::text("–"), |(predicted, measured)| Cell::number(measured / predicted, 3)),
            Cell::text(method.note.as_deref().unwrap_or("")),
        ]);
    }
    for of in &stability.conditions {
        if let Err(reason) = &of.methods {
            let none = || Cell::text("–");
            let label = Cell::text(of.condition.label());
            table = table.row([label, none(), none(), none(), none(), Cell::text(reason)]);
        }
    }
    table
}

fn chosen(stability: &Stability) -> Table {
    let mut table = Table::new(
        "Steps of the methods that choose them",
        [Column::text("Condition"), Column::text("Method"), Column::number("Mean step", "µs"), Column::text("Remark")],
    );
    for (of, method) in cells(stability).filter(|(_, of)| of.steps.is_empty()) {
        table = table.row([
            Cell::text(of.condition.label()),
            Cell::text(method.method.name()),
            microseconds(method.chosen_step_s),
            Cell::text(method.note.as_deref().unwrap_or("")),
        ]);
    }
    table
}

fn resonances(stability: &Stability) -> Table {
    let mut table = Table::new(
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
    let mut none = true;
    for (of, method) in cells(stability) {
        for window in &method.windows {
            none = false;
            let multiple = window.resonance.multiple;
            table = table.row([
                Cell::text(of.condition.label()),
                Cell::text(method.method.name()),
                Cell::number(1e6 * window.from_s, 4),
                Cell::number(1e6 * window.to_s, 4),
                Cell::number(1e-3 * window.resonance.mode_hz, 4),
                Cell::text(match multiple {
                    1 => "π".to_owned(),
                    more => format!("{more} π"),
                }),
                Cell::number(window.growth_per_step, 2),
            ]);
        }
    }
    if none {
        let text = |text: &str| Cell::text(text);
        let looked: usize = cells(stability).map(|(_, of)| of.phases[0]).sum();
        let what = format!("none in {} phases", significant(looked as f64, 6));
        table = table.row([text(&what), text("–"), text("–"), text("–"), text("–"), text("–"), text("–")]);
    }
    table
}
