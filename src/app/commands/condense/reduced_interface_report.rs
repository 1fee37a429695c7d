//! What modes in the place of an interface cost, as a section of the report of `plummer condense`.

use super::compute::CondenseResult;
use crate::app::scene::ReducedInterface;
use crate::report::{Cell, Column, Fact, Section, Table, significant};
use std::f64::consts::TAU;

/// Facts, the modes kept, and what each frequency rises by.
pub(crate) fn section(result: &CondenseResult, interface: &ReducedInterface) -> Section {
    let reduction = &interface.reduction;
    let whole = result.stage.condensed.superelement.interface_dof;
    let hz = |value: f64| significant(value.max(0.0).sqrt() / TAU, 6);
    let next = match reduction.next() {
        Some(value) => format!("the first one left out has {} Hz", hz(value)),
        None => "none is left out".to_owned(),
    };
    let percent = |share: f64| format!("{} %", significant(100.0 * share, 3));
    let facts = vec![
        Fact::new("Modes of the interface", reduction.kept().to_string())
            .note(format!("of {whole} coordinates; {next}")),
        Fact::new("Coordinates of the superelement", result.superelement().order().to_string())
            .note("modes of the interface first, then vectors of the interior"),
        Fact::new("Largest rise of a frequency in the band", significant(interface.largest_rise(), 2))
            .note("exact: both models are at hand; the estimated errors below have it in them"),
        Fact::new("Static flexibility of the interface lost", percent(interface.lost.mean)).note(format!(
            "mean over unit loads on single coordinates, largest {}; for information, no check",
            percent(interface.lost.largest)
        )),
    ];
    let mut modes =
        Table::new("Modes of the interface", [Column::number("Mode", ""), Column::number("Frequency", "Hz")]);
    for (place, value) in reduction.values().iter().enumerate() {
        modes = modes.row([
            Cell::text((place + 1).to_string()),
            match *value > 0.0 {
                true => Cell::number(value.sqrt() / TAU, 7),
                false => Cell::text("rigid"),
            },
        ]);
    }
    let mut rises = Table::new(
        "What the reduced interface costs",
        [Column::number("Mode", ""), Column::number("Frequency", "Hz"), Column::number("Relative rise", "")],
    );
    let both = result.estimate.modes.iter().zip(&interface.rises);
    for (place, (mode, rise)) in both.enumerate() {
        rises = rises.row([
            Cell::text((place + 1).to_string()),
            Cell::number(mode.frequency_hz, 7),
            Cell::number(*rise, 2),
        ]);
    }
    Section::new("The reduced interface")
        .paragraph("The coordinates of the interface are amplitudes of its characteristic constraint modes: its softest motions with what is attached, the interior following statically. Array interface_modes of superelement.npz leads back to its displacements. Static response of the interface is no longer exact: a load on few of its coordinates meets too stiff an interface. It is therefore not among the checks.")
        .facts(facts)
        .table(rises)
        .table(modes)
}
