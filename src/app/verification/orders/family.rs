//! Errors over ever finer sizes: their orders, and how they are judged and shown.

use crate::app::verification::section::{Check, Kind, OrdersSummary};
use crate::report::{Abscissa, Axis, Cell, Column, Curve, Plot, Table};

/// Series of one kind, what they rest on, and how they are shown.
pub(super) struct Family {
    /// Caption of its table and its plot.
    pub(super) title: &'static str,
    pub(super) source: &'static str,
    pub(super) assumptions: &'static str,
    pub(super) reason: &'static str,
    pub(super) series: Vec<OrdersSummary>,
}

/// Relative errors of one quantity over falling sizes, with the order from each size to the next, the order that theory gives, and
/// the limit of the last order's relative difference from that.
pub(super) fn series(
    name: String,
    [size, unit]: [&'static str; 2],
    sizes: Vec<f64>,
    relative_errors: Vec<f64>,
    [theory, limit]: [f64; 2],
) -> OrdersSummary {
    let finer = sizes.windows(2).map(|pair| pair[0] / pair[1]);
    let better = relative_errors.windows(2).map(|pair| (pair[0] / pair[1]).abs());
    let orders = better.zip(finer).map(|(better, finer)| better.ln() / finer.ln()).collect();
    OrdersSummary { name, size, unit, sizes, relative_errors, orders, theory, limit }
}

impl Family {
    pub(super) fn checks(&self) -> Vec<Check> {
        let kind = Kind { unit: "", source: self.source, assumptions: self.assumptions, reason: self.reason };
        let check = |series: &OrdersSummary| {
            let last = series.orders.last().copied().unwrap_or(f64::NAN);
            kind.check(&format!("Order: {}", series.name), last, series.theory, series.limit)
        };
        self.series.iter().map(check).collect()
    }

    /// What a size is, and its unit.
    fn size(&self) -> [&'static str; 2] {
        self.series.first().map_or(["", ""], |series| [series.size, series.unit])
    }

    /// Errors and orders, a row for each size.
    pub(super) fn table(&self) -> Table {
        let [size, unit] = self.size();
        let columns = [
            Column::text("Of"),
            Column::number(size, unit),
            Column::number("Relative error", ""),
            Column::number("Order from the last size", ""),
        ];
        let rows = self.series.iter().flat_map(|series| {
            let orders = std::iter::once(None).chain(series.orders.iter().copied().map(Some));
            series.sizes.iter().zip(&series.relative_errors).zip(orders).map(|((&size, &error), order)| {
                [
                    Cell::text(&series.name),
                    Cell::number(size, 4),
                    Cell::number(error, 3),
                    Cell::number_or(order, 4, "–"),
                ]
            })
        });
        Table::new(self.title, columns).rows(rows)
    }

    pub(super) fn plot(&self) -> Plot {
        let [size, unit] = self.size();
        let x = Axis::new(size, unit).log();
        let mut plot = Plot::new(self.title, x, Axis::new("Relative error", "").log());
        let mut kinds: Vec<&str> = Vec::new();
        for series in &self.series {
            let kind = series.name.split(',').next().unwrap_or_default();
            let known = kinds.iter().position(|of| *of == kind);
            let colour = known.unwrap_or(kinds.len());
            if known.is_none() {
                kinds.push(kind);
            }
            // one line of the legend a kind
            let name = if known.is_none() { kind } else { "" };
            let errors = series.relative_errors.iter().map(|error| error.abs()).collect();
            let sizes = Abscissa::Points(series.sizes.clone());
            plot = plot.curve(Curve::new(name, sizes, errors).colour(colour));
        }
        plot.caption(self.assumptions)
    }
}
