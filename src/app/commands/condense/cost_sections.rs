//! What modes in the place of an interface cost, and error against size: sections of the report of `plummer condense`.

use super::compute::{CondenseResult, FullComparison, ReducedInterface};
use super::summary::hz;
use crate::fe::reduction::SizeErrors;
use crate::report::{Abscissa, Axis, Cell, Column, Curve, CurveStyle, Fact, Plot, Section, Table, significant};

/// Facts, the modes kept, and what each frequency rises by.
pub(crate) fn reduced_interface(result: &CondenseResult, interface: &ReducedInterface) -> Section {
    let reduction = &interface.reduction;
    let whole = result.stage.condensed.superelement.interface_dof;
    let next = match reduction.next {
        Some(value) => format!("the first one left out has {} Hz", significant(hz(value), 6)),
        None => "none is left out".to_owned(),
    };
    let percent = |share: f64| format!("{} %", significant(100.0 * share, 3));
    let facts = [
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
    let [mode, frequency] = [Column::number("Mode", ""), Column::number("Frequency", "Hz")];
    let rises = (1..).zip(result.estimate.modes.iter().zip(&interface.rises));
    let rises = rises.map(|(number, (mode, rise))| {
        [Cell::text(number.to_string()), Cell::number(mode.frequency_hz, 7), Cell::number(*rise, 2)]
    });
    let columns = [mode.clone(), frequency.clone(), Column::number("Relative rise", "")];
    let rises = Table::new("What the reduced interface costs", columns).rows(rises);
    let modes = (1..).zip(reduction.values());
    let modes = modes.map(|(number, value)| {
        let elastic = (*value > 0.0).then(|| hz(*value));
        [Cell::text(number.to_string()), Cell::number_or(elastic, 7, "rigid")]
    });
    Section::new("The reduced interface")
        .paragraph("The coordinates of the interface are amplitudes of its characteristic constraint modes: its softest motions with what is attached, the interior following statically. Array interface_modes of superelement.npz leads back to its displacements. Static response of the interface is no longer exact: a load on few of its coordinates meets too stiff an interface. It is therefore not among the checks.")
        .facts(facts)
        .table(rises)
        .table(Table::new("Modes of the interface", [mode, frequency]).rows(modes))
}

/// Table and plot; `None` where no sizes were tried.
pub(crate) fn error_by_size(full: &FullComparison, interface_dof: usize, target: f64) -> Option<Section> {
    let sizes = &full.sizes;
    if sizes.is_empty() {
        return None;
    }
    Some(
        Section::new("Error against size")
            .paragraph(format!(
                "The largest true error of the elastic frequencies in the band, by number of coordinates. Plain: fixed-interface modes. Enhanced: residual vectors in the place of half of them. Both have the {interface_dof} coordinates of the interface beside, which are not counted. Interface reduced: characteristic constraint modes in the place of these, counted, and plain or enhanced vectors; the best of some splits (no vectors, or as many as one of the smaller sizes). Errors below 1e-10 are those of the eigenvalues themselves."
            ))
            .plot(plot(sizes, target))
            .table(table(sizes)),
    )
}

fn plot(sizes: &[SizeErrors], target: f64) -> Plot {
    let curve = |name: &str, error: &dyn Fn(&SizeErrors) -> Option<f64>| {
        let points = sizes.iter().filter_map(|row| Some((row.size as f64, error(row)?)));
        let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
        Curve::new(name, Abscissa::Points(x), y)
    };
    let ends: Vec<f64> = sizes.iter().map(|row| row.size as f64).collect();
    let limit = vec![target; ends.len()];
    Plot::new(
        "Largest error of a frequency in the band",
        Axis::new("Coordinates counted", ""),
        Axis::new("Relative error", "").log(),
    )
    .curve(curve("plain", &|row| row.plain))
    .curve(curve("enhanced", &|row| row.enhanced))
    .curve(curve("interface reduced", &|row| {
        row.reduced.map(|reduced| reduced.error)
    }))
    .curve(Curve::new("accuracy.target", Abscissa::Points(ends), limit).style(CurveStyle::Dashed))
    .caption("Where a curve is flat, further coordinates of its kind do not touch the mode that is worst. A reduction with too few coordinates to have all the frequencies has no point.")
}

fn table(sizes: &[SizeErrors]) -> Table {
    let columns = [
        Column::number("Coordinates", ""),
        Column::number("Plain", ""),
        Column::number("Enhanced", ""),
        Column::number("Interface reduced", ""),
        Column::text("Modes of the interface + fixed-interface modes + residual vectors"),
    ];
    Table::new("Largest relative error by size", columns).rows(sizes.iter().map(|row| {
        let split = row.reduced.map(|reduced| {
            format!("{} + {} + {}", reduced.interface_modes, reduced.fixed_interface_modes, reduced.residual_vectors)
        });
        [
            Cell::text(row.size.to_string()),
            Cell::number_or(row.plain, 2, "–"),
            Cell::number_or(row.enhanced, 2, "–"),
            Cell::number_or(row.reduced.map(|reduced| reduced.error), 2, "–"),
            Cell::text(split.unwrap_or_else(|| "–".to_owned())),
        ]
    }))
}
