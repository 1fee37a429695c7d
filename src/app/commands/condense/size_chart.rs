//! Error of a reduction against its size, as a section of the report of `plummer condense`.

use super::compute::FullComparison;
use crate::fe::reduction::SizeErrors;
use crate::report::{Abscissa, Axis, Cell, Column, Curve, CurveStyle, Plot, Section, Table};

/// Table and plot; `None` where no sizes were tried.
pub(crate) fn section(full: &FullComparison, interface_dof: usize, target: f64) -> Option<Section> {
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
    let mut table = Table::new(
        "Largest relative error by size",
        [
            Column::number("Coordinates", ""),
            Column::number("Plain", ""),
            Column::number("Enhanced", ""),
            Column::number("Interface reduced", ""),
            Column::text("Modes of the interface + fixed-interface modes + residual vectors"),
        ],
    );
    let number = |error: Option<f64>| error.map_or_else(|| Cell::text("–"), |error| Cell::number(error, 2));
    for row in sizes {
        table = table.row([
            Cell::text(row.size.to_string()),
            number(row.plain),
            number(row.enhanced),
            number(row.reduced.map(|reduced| reduced.error)),
            Cell::text(row.reduced.map_or_else(
                || "–".to_owned(),
                |reduced| {
                    format!(
                        "{} + {} + {}",
                        reduced.interface_modes, reduced.fixed_interface_modes, reduced.residual_vectors
                    )
                },
            )),
        ]);
    }
    table
}
