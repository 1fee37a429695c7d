//! Errors over ever finer sizes: their orders, and how they are judged and shown.

use crate::app::verification::section::{Check, Kind, OrdersSummary};
use crate::report::{Abscissa, Axis, Cell, Column, Curve, Plot, Table};

/// Errors of one quantity over ever finer sizes.
pub(super) struct Series {
    /// What it is; what stands before a comma is shared by series of a kind.
    pub(super) name: String,
    /// Sizes of elements (as a part of the body's) or of steps, s; falling.
    pub(super) sizes: Vec<f64>,
    /// Relative errors, as many.
    pub(super) errors: Vec<f64>,
    /// Order that theory gives.
    pub(super) theory: f64,
    /// Largest relative difference of the order on the last refinement from it.
    pub(super) limit: f64,
}

/// Series of one kind, what they rest on, and how they are shown.
pub(super) struct Family {
    /// Caption of its table and its plot.
    pub(super) title: &'static str,
    /// What a size is, and its unit.
    pub(super) size: [&'static str; 2],
    pub(super) source: &'static str,
    pub(super) assumptions: &'static str,
    pub(super) reason: &'static str,
    pub(super) series: Vec<Series>,
}

impl Series {
    fn kind(&self) -> &str {
        self.name.split(',').next().unwrap_or_default()
    }

    /// Order of convergence from each size to the next.
    fn orders(&self) -> Vec<f64> {
        let finer = self.sizes.windows(2).map(|pair| pair[0] / pair[1]);
        let better = self.errors.windows(2).map(|pair| (pair[0] / pair[1]).abs());
        let order = |(better, finer): (f64, f64)| better.ln() / finer.ln();
        better.zip(finer).map(order).collect()
    }

    /// The last of them.
    fn order(&self) -> f64 {
        self.orders().last().copied().unwrap_or(f64::NAN)
    }
}

impl Family {
    pub(super) fn checks(&self) -> Vec<Check> {
        let kind = Kind { unit: "", source: self.source, assumptions: self.assumptions, reason: self.reason };
        let check = |series: &Series| {
            let name = format!("Order: {}", series.name);
            kind.check(&name, series.order(), series.theory, series.limit)
        };
        self.series.iter().map(check).collect()
    }

    /// Errors and orders, a row for each size.
    pub(super) fn table(&self) -> Table {
        let [size, unit] = self.size;
        let columns = [
            Column::text("Of"),
            Column::number(size, unit),
            Column::number("Relative error", ""),
            Column::number("Order from the last size", ""),
        ];
        let rows = self.series.iter().flat_map(|series| {
            let orders = std::iter::once(None).chain(series.orders().into_iter().map(Some));
            series.sizes.iter().zip(&series.errors).zip(orders).map(|((&size, &error), order)| {
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
        let [size, unit] = self.size;
        let x = Axis::new(size, unit).log();
        let mut plot = Plot::new(self.title, x, Axis::new("Relative error", "").log());
        let mut kinds: Vec<&str> = Vec::new();
        for series in &self.series {
            let kind = series.kind();
            let known = kinds.iter().position(|of| *of == kind);
            let colour = known.unwrap_or(kinds.len());
            if known.is_none() {
                kinds.push(kind);
            }
            // one line of the legend a kind
            let name = if known.is_none() { kind } else { "" };
            let errors = series.errors.iter().map(|error| error.abs()).collect();
            let sizes = Abscissa::Points(series.sizes.clone());
            plot = plot.curve(Curve::new(name, sizes, errors).colour(colour));
        }
        plot.caption(self.assumptions)
    }

    pub(super) fn summary(&self) -> impl Iterator<Item = OrdersSummary> {
        self.series.iter().map(|series| OrdersSummary {
            name: series.name.clone(),
            size: self.size[0],
            unit: self.size[1],
            sizes: series.sizes.clone(),
            relative_errors: series.errors.clone(),
            orders: series.orders(),
            theory: series.theory,
        })
    }
}
