//! A sweep as a page.

use super::plots::{in_words, plots};
use super::result::{NamedColumn, Values};
use super::tables::{Scaled, short_name};
use super::{PointState, SweepResult, SweptCommand};
use crate::app::case::{Case, Source};
use crate::app::commands::analyze::report::capital;
use crate::app::commands::parts;
use crate::report::{Cell, Column, Fact, Plot, Report, Section, Table, Verdict};

/// The report of a sweep of a case: inputs, what was varied, plots of its figures, points that are not done, the table.
///
/// `command` is the command line that computes it again.
pub(crate) fn sweep_report(case: &Case, result: &SweepResult, command: &str) -> Report {
    let done = result.count(PointState::Done);
    let all = result.points.len();
    let missing = result.count(PointState::Missing);
    let what = match result.plan.command {
        SweptCommand::Run => "Simulated runs",
        SweptCommand::Modes => "Modes",
    };
    let mut report = parts::signed_report(case, command, &format!("{what} at {all} points"))
        .headline("Points done", format!("{done} of {all}"), Verdict::of(done == all))
        .section(varied(result))
        .section(
            Section::new("Inputs")
                .paragraph("All points have these, but for what was varied.")
                .facts(inputs(case, result)),
        );
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

/// What all points have, and where one differs from the next that it was varied.
fn inputs(case: &Case, result: &SweepResult) -> Vec<Fact> {
    let facts = |case: &Case| parts::inputs(case, result.plan.command.purpose(), None);
    let mut all = facts(case);
    for (column, axis) in result.axes().iter().zip(&result.plan.axes) {
        let ends = [axis.values.first(), axis.values.last()].map(|value| {
            let set = result.plan.set.iter().cloned().chain(value.map(|value| format!("{}={value}", axis.key)));
            let source = Source { path: case.source.path.clone(), text: case.source.text.clone(), set: set.collect() };
            Case::from_source(source).map(|case| facts(&case))
        });
        let ([Ok(first), Ok(last)], count) = (ends, result.points.len()) else { continue };
        let differ = first.iter().filter(|fact| !last.contains(fact)).map(|fact| &fact.name);
        let differ: Vec<&String> = differ.collect();
        for fact in all.iter_mut().filter(|fact| differ.contains(&&fact.name)) {
            let [from, to] = [0, count.saturating_sub(1)].map(|row| in_words(column, row));
            fact.note = Some(format!("otherwise as {}", fact.value));
            fact.value = format!("varied: {} from {from} to {to}", column.label);
        }
    }
    all
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
        Fact::new(capital(&column.label), text).note(format!("{count} of the key {}", axis.key))
    };
    let section = Section::new("What was varied").facts(result.axes().into_iter().zip(&result.plan.axes).map(fact));
    match result.plan.axes.len() {
        1 => section,
        _ => section.paragraph("Every value of each is combined with every value of the others."),
    }
}

fn all_points(result: &SweepResult) -> Section {
    let section = Section::new("All points").paragraph(
            "sweep.csv and sweep.json beside this report have these figures in SI units, the harmonics of the lines, and the points' wall times.",
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
    let axes = result.axes();
    let points = result.points.iter().enumerate().filter(|(_, point)| point.state != PointState::Done);
    let table = Table::new("Points that are not done", columns).rows(points.map(|(row, point)| {
        let values = axes.iter().map(|axis| format!("{} = {}", short_name(&axis.label), in_words(axis, row)));
        let values: Vec<String> = values.collect();
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
    use super::super::result::tests::{dents, four};
    use super::{Case, sweep_report};

    #[test]
    fn messages_are_text_and_points_are_told() {
        let html =
            sweep_report(&Case::example("tadina2011/beam", &[]), &four(), "plummer sweep a.toml").to_html().unwrap();
        assert!(html.contains("1 of 4"));
        assert!(html.contains("&lt;script&gt;alert(1)"));
        assert!(!html.contains("<script>alert(1)"));
        assert!(html.contains("1 of 4 points are not computed."));
        assert!(html.contains("number of nodes = 72, element = exact-arc"));
    }

    #[test]
    fn a_page_says_inputs_and_axes_in_words_and_no_wall_times() {
        let report = sweep_report(&Case::example("tadina2011/outer-dent", &[]), &dents(), "plummer sweep a.toml");
        let titles: Vec<&str> = report.sections.iter().map(|section| section.title.as_str()).collect();
        assert_eq!(titles, ["What was varied", "Inputs", "Figures over what was varied", "All points"]);
        let html = report.to_html().unwrap();
        for text in [
            "<dt>Depth of the dent</dt><dd>5 µm, 15 µm",
            "Depth of the dent [µm]",
            "varied: depth of the dent from 5 µm to 15 µm",
            "<dt>Bearing</dt>",
            "Checked by",
        ] {
            assert!(html.contains(text), "{text}");
        }
        assert!(!html.contains("wall time<") && !html.contains("stepping<"));
        assert_eq!(html.matches("bearing.defects").count(), 1, "the key stands where it is said what was varied");
    }
}
