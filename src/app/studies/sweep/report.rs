//! A sweep as a page.

use super::plots::plots;
use super::result::{NamedColumn, Values};
use super::tables::Scaled;
use super::{PointState, SweepResult};
use crate::report::{Cell, Column, Fact, Plot, Report, Section, Table, Verdict};

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
    let plots: Vec<Plot> = plots(result);
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
        .section(all_points(result))
}

fn varied(result: &SweepResult) -> Section {
    let fact = |(column, axis): (NamedColumn, &super::Axis)| {
        let values: Vec<String> = match (&column.values, axis.numbers()) {
            (Values::Numbers(_), Some(numbers)) => {
                let scaled = Scaled::of(column.unit, &numbers);
                numbers.iter().map(|&number| scaled.words(number)).collect()
            }
            _ => axis.values.clone(),
        };
        let text = match values.as_slice() {
            [first, .., last] if values.len() > 12 => format!("{first} … {last}"),
            all => all.join(", "),
        };
        let count = match values.len() {
            1 => "one value".to_owned(),
            count => format!("{count} values"),
        };
        Fact::new(column.label, text).note(count)
    };
    let section = Section::new("What was varied").facts(result.axes().into_iter().zip(&result.plan.axes).map(fact));
    match result.plan.axes.len() {
        1 => section,
        _ => section.paragraph("Every value of each key with every value of the others."),
    }
}

fn all_points(result: &SweepResult) -> Section {
    let section = Section::new("All points").paragraph(
        "sweep.csv and sweep.json beside this report have these figures in SI units, and the harmonics of the lines.",
    );
    result.tables().into_iter().fold(section, Section::table)
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

#[cfg(test)]
mod tests {
    use super::super::result::tests::four;
    use super::sweep_report;

    #[test]
    fn messages_are_text_and_points_are_told() {
        let html = sweep_report("Ring", &four(), "plummer sweep a.toml").to_html().unwrap();
        assert!(html.contains("1 of 4"));
        assert!(html.contains("&lt;script&gt;alert(1)"));
        assert!(!html.contains("<script>alert(1)"));
        assert!(html.contains("1 of 4 points are not computed."));
    }
}
