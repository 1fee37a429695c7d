//! Orders of convergence: how fast errors fall with the size of elements and steps, against theory. An element or a method that
//! is wrong in a term of its own often still looks right on one mesh; its order does not.

mod rings;
mod solids;
mod steps;

use super::section::{Check, Kind, OrdersSummary, SectionResult, VerificationError};
use crate::report::{Abscissa, Axis, Cell, Column, Curve, Plot, Section, Table};

/// Title of the section.
const TITLE: &str = "Orders of convergence";

/// Errors of one quantity over ever finer sizes.
struct Series {
    /// What it is; what stands before a comma is shared by series of a kind.
    name: String,
    /// Sizes of elements (as a part of the body's) or of steps, s; falling.
    sizes: Vec<f64>,
    /// Relative errors, as many.
    errors: Vec<f64>,
    /// Order that theory gives.
    theory: f64,
    /// Largest relative difference of the order on the last refinement from it.
    limit: f64,
}

/// Series of one kind, what they rest on, and how they are shown.
struct Family {
    /// Caption of its table and its plot.
    title: &'static str,
    /// What a size is, and its unit.
    size: [&'static str; 2],
    source: &'static str,
    assumptions: &'static str,
    reason: &'static str,
    series: Vec<Series>,
}

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a model cannot be built or computed.
pub(super) fn orders() -> Result<SectionResult, VerificationError> {
    let families = [solids::solids()?, rings::rings()?, steps::steps()?];
    let checks = families.iter().flat_map(Family::checks).collect();
    let mut report = Section::new(TITLE).paragraph(
        "The order is the slope of the error over the size on logarithmic axes, from one size to the next; the check judges the last.",
    );
    for family in &families {
        report = report.table(family.table()).plot(family.plot());
    }
    let orders = families.iter().flat_map(Family::summary).collect();
    let mut section = SectionResult::of_checks(TITLE, checks);
    section.report = vec![report];
    section.orders = Some(orders);
    Ok(section)
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
    fn checks(&self) -> Vec<Check> {
        let kind = Kind { unit: "", source: self.source, assumptions: self.assumptions, reason: self.reason };
        let check = |series: &Series| {
            let name = format!("Order: {}", series.name);
            kind.check(&name, series.order(), series.theory, series.limit)
        };
        self.series.iter().map(check).collect()
    }

    /// Errors and orders, a row for each size.
    fn table(&self) -> Table {
        let [size, unit] = self.size;
        let columns = [
            Column::text("Of"),
            Column::number(size, unit),
            Column::number("Relative error", ""),
            Column::number("Order from the last size", ""),
        ];
        let mut table = Table::new(self.title, columns);
        for series in &self.series {
            let orders = std::iter::once(None).chain(series.orders().into_iter().map(Some));
            for ((&size, &error), order) in series.sizes.iter().zip(&series.errors).zip(orders) {
                table = table.row([
                    Cell::text(&series.name),
                    Cell::number(size, 4),
                    Cell::number(error, 3),
                    order.map_or_else(|| Cell::text("–"), |order| Cell::number(order, 4)),
                ]);
            }
        }
        table
    }

    fn plot(&self) -> Plot {
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

    fn summary(&self) -> impl Iterator<Item = OrdersSummary> {
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

#[cfg(test)]
mod tests {
    use super::orders;

    #[test]
    fn every_order_is_that_of_theory() {
        let section = orders().unwrap();
        for check in &section.checks {
            println!("{}", check.line());
            assert!(check.ok(), "{}", check.line());
        }
        assert_eq!(section.checks.len(), 4 * 4 + 3 + 5);
        // conforming elements are too stiff, and on boxes the incompatible one is too
        let series = section.orders.unwrap();
        for series in series.iter().filter(|series| series.unit == "m") {
            let above = series.relative_errors.iter().all(|&error| error > 0.0);
            assert!(above, "{series:?}");
        }
    }
}
