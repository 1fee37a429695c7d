//! A sweep as a page.

use super::result::{NamedColumn, Values};
use super::{Axis, PointState, SweepResult};
use crate::report::{Abscissa, Axis as PlotAxis, Cell, Column, Curve, Fact, Plot, Report, Section, Table, Verdict};

/// Most curves of a plot: as many as can be told apart.
const MOST_CURVES: usize = 12;

/// The report of a sweep: what was varied, plots of its figures, points that are not done, the table.
///
/// `command` is the command line that computes it again.
pub(crate) fn sweep_report(title: &str, result: &SweepResult, command: &str) -> Report {
    let done = result.count(PointState::Done);
    let all = result.points.len();
    let missing = result.count(PointState::Missing);
    let mut report = Report::new(title, command, env!("CARGO_PKG_VERSION"))
        .subtitle(format!("plummer {} at {all} points", result.plan.command.name()))
        .headline("points done", format!("{done} of {all}"), Verdict::of(done == all))
        .section(varied(result));
    let plots = plots(result);
    if !plots.is_empty() {
        let section = Section::new("Figures over what was varied");
        report = report.section(plots.into_iter().fold(section, Section::plot));
    }
    if done < all {
        report = report.section(not_done(result));
    }
    if missing > 0 {
        report = report.warning(format!("{missing} of {all} points are not computed."));
    }
    report.warnings.extend(result.warnings().iter().map(|warning| warning.sentence(all)));
    report
        .assumption("Each point is computed by itself, in a process and a folder of its own: folders sweep/NUMBER beside this report hold its files.")
        .section(Section::new("All points").table(result.table()))
}

fn varied(result: &SweepResult) -> Section {
    let fact = |axis: &Axis| {
        let values = if axis.values.len() > 12 {
            let [first, last] = [&axis.values[0], &axis.values[axis.values.len() - 1]];
            format!("{first} … {last}")
        } else {
            axis.values.join(", ")
        };
        Fact::new(axis.key.clone(), values).note(format!("{} values", axis.values.len()))
    };
    Section::new("What was varied")
        .facts(result.plan.axes.iter().map(fact))
        .paragraph("Every value of each key with every value of the others.")
}

fn not_done(result: &SweepResult) -> Section {
    let columns = [
        Column::number("point", ""),
        Column::text("values"),
        Column::text("state"),
        Column::text("exit code"),
        Column::text("message"),
    ];
    let table = Table::new("Points that are not done", columns).rows(result.not_done().map(|point| {
        let axes = result.plan.axes.iter().zip(&point.point.values);
        let values: Vec<String> = axes.map(|(axis, value)| format!("{}={value}", axis.key)).collect();
        let record = point.record.as_ref();
        let code = record.map_or_else(String::new, |record| {
            record.exit_code.map_or_else(|| "ended by a signal".to_owned(), |code| code.to_string())
        });
        [
            Cell::text(point.point.number.to_string()).value(point.point.number as f64),
            Cell::text(values.join(", ")),
            Cell::text(point.state.name()),
            Cell::text(code),
            Cell::text(record.map_or("", |record| record.message.as_str())),
        ]
    }));
    Section::new("Points that are not done").table(table)
}

/// A plot a group of figures, over the first axis that has two or more numbers; a curve a figure and combination of the other
/// axes' values.
fn plots(result: &SweepResult) -> Vec<Plot> {
    let axes = result.plan.axes.iter().enumerate();
    let mut numeric = axes.filter_map(|(place, axis)| {
        let numbers = axis.numbers()?;
        (numbers.len() > 1).then_some((place, numbers))
    });
    let Some((place, numbers)) = numeric.next() else {
        return Vec::new();
    };
    let columns = result.columns();
    let mut groups: Vec<&'static str> = Vec::new();
    for group in columns.iter().filter_map(|column| column.group) {
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    let key = &result.plan.axes[place].key;
    // a range over decades shows nothing on a linear axis
    let [least, most] = [f64::min, f64::max].map(|pick| numbers.iter().copied().reduce(pick));
    let ratios = least.zip(most).is_some_and(|(least, most)| least > 0.0 && most >= 100.0 * least);
    let x = || {
        let axis = PlotAxis::new(key.clone(), "");
        if ratios { axis.log() } else { axis }
    };
    let plot = |group: &&'static str| {
        let of_group: Vec<&NamedColumn> = columns.iter().filter(|column| column.group == Some(*group)).collect();
        let unit = of_group.first().map_or("", |column| column.unit);
        let mut plot = Plot::new(*group, x(), PlotAxis::new(*group, unit));
        let curves: Vec<Curve> = of_group.iter().flat_map(|column| curves(result, place, column)).collect();
        let left_out = curves.len().saturating_sub(MOST_CURVES);
        plot.curves = curves.into_iter().take(MOST_CURVES).collect();
        if left_out > 0 {
            plot = plot.caption(format!("{left_out} further curves are in the table alone."));
        }
        plot
    };
    groups.iter().map(plot).collect()
}

/// The curves of one figure, one a combination of the other axes' values, in the order of the points.
fn curves(result: &SweepResult, place: usize, column: &NamedColumn) -> Vec<Curve> {
    let Values::Numbers(values) = &column.values else {
        return Vec::new();
    };
    let mut families: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for (point, &value) in result.points.iter().zip(values) {
        let others = result.plan.axes.iter().zip(&point.point.values).enumerate();
        let others = others.filter(|(other, (axis, _))| *other != place && axis.values.len() > 1);
        let mut name = column.name.clone();
        for (_, (axis, value)) in others {
            name.push_str(&format!(", {}={value}", axis.key));
        }
        let Ok(at) = point.point.values[place].parse() else {
            continue;
        };
        match families.iter_mut().find(|(other, _)| *other == name) {
            Some((_, points)) => points.push((at, value)),
            None => families.push((name, vec![(at, value)])),
        }
    }
    let curve = |(name, mut points): (String, Vec<(f64, f64)>)| {
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let labels = points.iter().map(|(at, value)| format!("{at}: {value}"));
        let labels = labels.collect();
        let (x, y) = points.into_iter().unzip();
        Curve::new(name, Abscissa::Points(x), y).labels(labels)
    };
    let shown = families.into_iter().filter(|(_, points)| points.iter().any(|(_, value)| value.is_finite()));
    shown.map(curve).collect()
}

#[cfg(test)]
mod tests {
    use super::super::result::tests::four;
    use super::{Abscissa, plots, sweep_report};

    #[test]
    fn messages_are_text_and_points_are_told() {
        let html = sweep_report("Ring", &four(), "plummer sweep a.toml").to_html().unwrap();
        assert!(html.contains("1 of 4"));
        assert!(html.contains("&lt;script&gt;alert(1)"));
        assert!(!html.contains("<script>alert(1)"));
        assert!(html.contains("1 of 4 points are not computed."));
    }

    #[test]
    fn a_curve_a_figure_and_combination() {
        let plots = plots(&four());
        assert_eq!(plots.len(), 1);
        let names: Vec<&str> = plots[0].curves.iter().map(|curve| curve.name.as_str()).collect();
        assert_eq!(
            names,
            [
                "frequency.1, ring.element=exact-arc",
                "frequency.1, ring.element=raveendranath",
                "frequency.2, ring.element=exact-arc",
                "frequency.2, ring.element=raveendranath",
                // the first element has no third frequency anywhere
                "frequency.3, ring.element=raveendranath",
            ]
        );
        assert_eq!(plots[0].curves[0].x, Abscissa::Points(vec![36.0, 72.0]));
        assert!((plots[0].curves[0].y[0] - 8200.5).abs() < 1e-9);
        assert!(plots[0].curves[0].y[1].is_nan(), "the point failed");
    }
}
