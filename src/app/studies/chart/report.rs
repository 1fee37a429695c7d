//! The report of `plummer chart`.

use super::plots::{between_methods, growth, work_precision};
use super::statistics::{BEYOND_CHANCE, ComparedFigure};
use super::{Chart, GROWTHS, Parameter, Point, model_name};
use crate::app::case::{Case, Purpose};
use crate::app::commands::parts::{HousingSize, inputs, model_facts};
use crate::report::{Cell, Column, Fact, Report, Section, Table, Verdict, fixed, significant};

/// Composes the report; `command` is the line that made it.
pub(crate) fn chart_report(case: &Case, chart: &Chart, command: &str) -> Report {
    let mut report = Report::new(&case.title, command, env!("CARGO_PKG_VERSION"))
        .subtitle("Speed against accuracy of the simulation");
    report = headlines(report, chart);
    if !chart.reference.agreed {
        report = report.warning(format!(
            "The two reference methods differ by {} over the horizon, which is not well below the target {}: nothing below that is marked.",
            significant(chart.reference.disagreement, 2),
            significant(chart.settings.target, 2)
        ));
    }
    report.warnings.extend(chart.without());
    report.warnings.extend(chart.scene.doubts().iter().cloned());
    report.warnings.extend(chart.starts.left_out.iter().map(|text| format!("Left out: {text}")));
    report.assumptions = chart.scene.assumptions(case);
    let stage = chart.scene.stage();
    let size = stage.bodies.housing.as_ref().map(HousingSize::of_housing);
    report
        .section(Section::new("Inputs").facts(inputs(case, Purpose::Chart, size.as_ref())))
        .section(
            Section::new("Speed against accuracy")
                .plot(work_precision(chart))
                .table(marked_table(chart))
                .paragraph("What a model leaves out grows as nearby solutions part, and so does its error: the marked points' over the earlier part of the horizon.")
                .table(growth_table(chart)),
        )
        .section(reference_section(chart))
        .section(statistics_section(chart))
        .section(omissions_section(chart))
        .section(Section::new("All points").table(points_table(chart)))
        .section(
            Section::new("Model")
                .facts(model_facts(&stage.bodies, Some(stage.fixed_interface_modes)))
                .table(chart.scene.bearing_table()),
        )
        .assumption("Every run begins at rest in the equilibrium of its own instant; what follows of switching on unbalance and speed is part of the comparison.")
        .assumption("Wall times are medians of short runs on one thread of this machine, which may have had other work.")
}

fn ms(seconds: f64) -> String {
    format!("{} ms", significant(1e3 * seconds, 3))
}

fn headlines(report: Report, chart: &Chart) -> Report {
    let reference = &chart.reference;
    let mut report = report
        .headline(
            "Floor: difference of the reference methods",
            significant(reference.disagreement, 2),
            Verdict::of(reference.agreed),
        )
        .headline(
            "Horizon, mean over the starts",
            format!("{} of {}", ms(reference.mean_horizon_s()), ms(chart.settings.span_s)),
            Verdict::None,
        );
    let chosen = &chart.points[chart.chosen];
    if let (Some((wall, _)), [Ok(error), _]) = (chosen.measured(), &chart.over_all_starts) {
        report = report.headline(
            "Error of the program's choice, all starts",
            significant(error.mean, 2),
            match chart.struck {
                Some(0) => Verdict::None,
                _ => Verdict::of(error.mean <= chart.settings.target),
            },
        );
        if let Some(struck) = chart.struck {
            let starts = chart.reference.starts.len();
            report = report.note(format!("A ball strikes the defect in {struck} of {starts} starts."));
        }
        if let Some((source, _)) = chart.points[chart.source].measured() {
            report =
                report.headline("Times faster than the source's method", significant(source / wall, 3), Verdict::None);
        }
    }
    report
}

/// Columns of a table of points.
fn point_table(caption: &str, first: Column) -> Table {
    Table::new(
        caption,
        [
            first,
            Column::text("Method"),
            Column::text("Model"),
            Column::number("Step", "µs"),
            Column::number("Tolerance", ""),
            Column::number("Wall time a second", "s"),
            Column::number("Error", ""),
            Column::number("Its scatter", ""),
            Column::number("Largest", ""),
        ],
    )
}

fn point_row(first: Cell, point: &Point) -> Vec<Cell> {
    let (step, tolerance) = match Parameter::of(&point.model) {
        Parameter::StepS(step) => (Some(1e6 * step), None),
        Parameter::Tolerance(tolerance) => (None, Some(tolerance)),
    };
    let error = point.error.as_ref().ok();
    vec![
        first,
        Cell::text(point.model.method.name()),
        Cell::text(model_name(&point.model)),
        Cell::number_or(step, 3, "–"),
        Cell::number_or(tolerance, 2, "–"),
        Cell::number_or(point.wall_s, 3, "–"),
        Cell::number_or(error.map(|error| error.mean), 2, "–"),
        Cell::number_or(error.map(|error| error.deviation), 2, "–"),
        Cell::number_or(error.map(|error| error.largest), 2, "–"),
    ]
}

/// The front, the program's choice and the source's method, by wall time, and what each of them is.
fn marked(chart: &Chart) -> Vec<(&Point, String)> {
    let mut places: Vec<usize> = chart.front.clone();
    for place in [chart.chosen, chart.source] {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let wall = |place: &usize| chart.points[*place].wall_s.unwrap_or(f64::INFINITY);
    places.sort_by(|a, b| wall(a).total_cmp(&wall(b)));
    let named = places.into_iter().map(|place| {
        let mut what = Vec::new();
        if chart.front.contains(&place) {
            what.push("front");
        }
        if place == chart.chosen {
            what.push("program's choice");
        }
        if place == chart.source {
            what.push("source's method");
        }
        (&chart.points[place], what.join(", "))
    });
    named.collect()
}

fn marked_table(chart: &Chart) -> Table {
    let mut table = point_table("Points that none beats, and those to compare with", Column::text("What"))
        .rows(marked(chart).into_iter().map(|(point, what)| point_row(Cell::text(what), point)));
    if chart.settings.point_stride() > 1 {
        let [chosen, source] = &chart.over_all_starts;
        for (what, place, error) in [
            ("program's choice, all starts", chart.chosen, chosen),
            ("source's method, all starts", chart.source, source),
        ] {
            let point = Point { error: error.clone(), ..chart.points[place].clone() };
            table = table.row(point_row(Cell::text(what), &point));
        }
    }
    table
}

/// Errors of the same points while nearby solutions have parted by less than over the horizon.
fn growth_table(chart: &Chart) -> Table {
    let mut columns = vec![Column::text("What"), Column::text("Method"), Column::text("Model")];
    let chosen = chart.points[chart.chosen].error.as_ref().ok();
    for (place, growth) in GROWTHS.into_iter().enumerate() {
        let span = chosen
            .map_or_else(String::new, |error| format!(" ({} ms)", significant(1e3 * error.by_growth[place].span_s, 2)));
        let name = format!("Growth {}{span}", significant(growth, 2));
        columns.push(Column::number(name, ""));
    }
    columns.push(Column::number("Over the horizon", ""));
    let rows = marked(chart).into_iter().filter_map(|(point, what)| {
        let error = point.error.as_ref().ok()?;
        let means = error.by_growth.iter().map(|part| part.mean).chain([error.mean]);
        let texts = [Cell::text(what), Cell::text(point.model.method.name()), Cell::text(model_name(&point.model))];
        Some(texts.into_iter().chain(means.map(|mean| Cell::number(mean, 2))).collect::<Vec<_>>())
    });
    Table::new("Error while nearby solutions part", columns).rows(rows)
}

fn reference_section(chart: &Chart) -> Section {
    let reference = &chart.reference;
    let [by, beside] = &reference.models;
    let of = |model| match Parameter::of(model) {
        Parameter::StepS(step) => format!("{}, step {} s", model.method.name(), significant(step, 3)),
        Parameter::Tolerance(part) => format!("{}, tolerance {}", model.method.name(), significant(part, 2)),
    };
    let factor = 1.0 / chart.settings.target;
    let starts = Table::new(
        "Starts",
        [
            Column::number("At", "s"),
            Column::number("Horizon", "ms"),
            Column::number("Growth", "1/ms"),
            Column::number("Difference of the methods", ""),
            Column::number("Refinements", ""),
        ],
    )
    .rows(reference.starts.iter().map(|start| {
        [
            Cell::text(fixed(start.start.time_s, 5)).value(start.start.time_s),
            Cell::number(1e3 * start.horizon_s, 3),
            Cell::number_or(start.growth.rate_per_s().map(|rate| 1e-3 * rate), 2, "–"),
            Cell::number(start.disagreement, 2),
            Cell::text(start.refinements.to_string()),
        ]
    }));
    let rate = reference.growth_rate_per_s();
    let rate = rate.map(|rate| format!("{} times a millisecond", significant((1e-3 * rate).exp(), 3)));
    Section::new("Reference and horizon")
        .paragraph(format!(
            "Two methods of different kind integrate the fullest model: all {} modes, balls with inertia. They are refined, start by start, until their signals differ by less than a hundredth of the target over the horizon. The horizon is the time in which the distance of a solution from one that began a little beside it grows to {} times what it was at the start: an error made there has then become one of the signal's size if it was as large as the target. Signals are compared point by point inside it alone.",
            chart.scene.stage().modes.count(),
            significant(factor, 3),
        ))
        .facts([
            Fact::new("Measured by", of(by)),
            Fact::new("Beside it", of(beside)),
            Fact::new("Their difference", significant(reference.disagreement, 2))
                .note("mean over the starts, each over its horizon: the floor"),
            Fact::new("Starts", format!("{} over {}", reference.starts.len(), ms(chart.starts.spread_s))).note(format!(
                "over a ball pass, or what the case simulates, from {} s on; a run-up has them at its end",
                significant(chart.starts.first_s(), 4)
            )),
            Fact::new("Horizon", ms(reference.mean_horizon_s())).note(format!(
                "mean; least {}; the span is {}",
                ms(reference.least_horizon_s()),
                ms(chart.settings.span_s)
            )),
            Fact::new("Growth", rate.unwrap_or_else(|| "none".to_owned()))
                .note("mean over the starts of a straight line through the logarithm"),
        ])
        .plot(growth(chart))
        .plot(between_methods(chart))
        .table(starts)
}

fn statistics_section(chart: &Chart) -> Section {
    let mut section = Section::new("Statistics beyond the horizon").paragraph(format!(
        "Runs of {} from every start, perturbed; figures of the first sensor, mean and standard error over the runs. The difference is taken start by start, so that what the starts have in common does not count; it is marked where it is beyond {BEYOND_CHANCE} of its standard errors and beyond the target too ({} %; levels {} dB).",
        ms(chart.settings.statistics_s),
        significant(100.0 * chart.settings.target, 2),
        significant(20.0 * (1.0 + chart.settings.target).log10(), 2)
    ));
    for of in &chart.statistics {
        section = match &of.figures {
            Some(figures) => section.table(figures_table(named(chart, of.point), figures)),
            None => {
                let reason = of.reason.as_deref().unwrap_or_default();
                section.paragraph(format!("{}: no statistics: {reason}", named(chart, of.point)))
            }
        };
    }
    section
}

fn named(chart: &Chart, place: usize) -> &'static str {
    if place == chart.chosen { "The program's choice" } else { "The source's method" }
}

fn figures_table(what: &str, figures: &[ComparedFigure]) -> Table {
    let rows = figures.iter().map(|figure| {
        let with_error = |estimate: &super::Estimate| {
            let text = format!("{} ± {}", significant(estimate.mean, 4), significant(estimate.standard_error, 2));
            Cell::text(text).value(estimate.mean)
        };
        let errors = Cell::number(figure.standard_errors, 2);
        [
            Cell::text(&figure.name),
            Cell::text(crate::report::pretty_unit(figure.unit)),
            with_error(&figure.own),
            with_error(&figure.reference),
            with_error(&figure.difference),
            if figure.differs { errors.judged(Verdict::Bad) } else { errors },
        ]
    });
    Table::new(
        format!("{what} against the reference"),
        [
            Column::text("Figure"),
            Column::text("Unit"),
            Column::number("Its own", ""),
            Column::number("Reference", ""),
            Column::number("Difference", ""),
            Column::number("In standard errors", ""),
        ],
    )
    .rows(rows)
}

fn omissions_section(chart: &Chart) -> Section {
    let section = Section::new("Omissions");
    let untried = Table::new("What there was no time to refine", [Column::text("Method, model and what they lack")])
        .rows(chart.unrefined.iter().map(|text| [Cell::text(text)]));
    let section = if untried.rows.is_empty() { section } else { section.table(untried) };
    if chart.omissions().next().is_none() {
        return section.paragraph("Every candidate that was tried has a point.");
    }
    let table = Table::new(
        "Omissions",
        [
            Column::text("Method"),
            Column::text("Model"),
            Column::text("Step or tolerance"),
            Column::text("What"),
            Column::text("Why"),
        ],
    )
    .rows(chart.omissions().map(|(place, failure)| {
        let point = &chart.points[place];
        let parameter = match Parameter::of(&point.model) {
            Parameter::StepS(step) => Cell::text(format!("{} µs", significant(1e6 * step, 3))).value(step),
            Parameter::Tolerance(tolerance) => Cell::number(tolerance, 2),
        };
        [
            Cell::text(point.model.method.name()),
            Cell::text(model_name(&point.model)),
            parameter,
            Cell::text(failure.kind.name()),
            Cell::text(&failure.reason),
        ]
    }));
    section
        .paragraph("What was tried and has no point in the chart. Within a method and a model steps are refined from the longest on, until that brings nothing more.")
        .table(table)
}

fn points_table(chart: &Chart) -> Table {
    point_table("Points", Column::text("Omitted")).rows(chart.points.iter().map(|point| {
        let omitted = match &point.error {
            Ok(_) if chart.below_floor(point) => "below what the reference can tell",
            Ok(_) => "",
            Err(failure) => failure.kind.name(),
        };
        point_row(Cell::text(omitted), point)
    }))
}
