//! The map in a report.

use super::{ConditionSummary, MethodStability, Stability, StabilityModel, resonance_plot, stability_map};
use crate::app::case::Case;
use crate::report::{Block, Cell, Column, Report, Section, Table, significant};

/// A report of the map alone; `command` is the line that made it.
pub(crate) fn stability_report(case: &Case, stability: &Stability, command: &str) -> Report {
    Report::new(&case.title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Stability of the integration methods")
        .section(stability_section(stability))
}

/// Picture, resonance and tables.
pub(crate) fn stability_section(stability: &Stability) -> Section {
    let StabilityModel { modes: kept, of_modes: all, .. } = stability.model;
    Section::new("Stability map")
        .paragraph(format!(
            "Which steps a method can take, on the program's own model ({kept} of {all} modes) and, in the last rows, on all of them. The predicted limit is that of small motions about the equilibrium: the method itself steps the linearised system, and the limit is the step from which a motion grows by more than 0.05 % a step. The measured one is that of two short runs of the whole model side by side: beyond it they end with an error, run ten times as fast as finer ones, or are a hundred times as far apart as these. Where balls strike, the contacts are stiffer than in equilibrium and the measured limit is the lower one; impacts also part nearby runs by chance, and a single dark cell below the limit may be that. A growth too slow for short runs is not seen, and a limit says nothing of accuracy, which is lost much earlier."
        ))
        .block(Block::StepMap(stability_map(stability)))
        .table(limits(stability))
        .table(chosen(stability))
        .plot(resonance_plot())
        .table(resonances(stability))
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
