//! The report of `plummer run`.

use super::choice::ChosenPart;
use super::compute::RunResult;
use super::machine::Machine;
use super::recording::Recording;
use super::scalogram::SensorScalogram;
use super::simulation::RunEnd;
use crate::app::case::{Case, Purpose};
use crate::app::commands::analyze::report::{capital, verdict_headlines, window_section};
use crate::app::commands::analyze::table::{counts, verdicts};
use crate::app::commands::analyze::{AnalysisRow, SHOWN_WINDOWS};
use crate::app::commands::computed::Computed;
use crate::app::commands::parts;
use crate::app::commands::parts::ExpectedMode;
use crate::app::error::ComputeError;
use crate::report::{
    Axis, Curve, Fact, Plot, Report, SIGNAL_POINTS, Section, Table, Thinner, Verdict, given, significant,
};
use crate::system::Column;

/// Unloaded modes listed beside the loaded ones.
const LISTED_MODES: usize = 20;

impl<R: Recording> Computed for RunResult<R> {
    fn report(&self, case: &Case, command: &str) -> Result<Report, ComputeError> {
        run_report(case, self, command)
    }
}

/// Composes the report; `command` is the line that made it.
///
/// # Errors
/// [`ComputeError`] if a signal cannot be shown.
pub(crate) fn run_report<R: Recording>(
    case: &Case,
    result: &RunResult<R>,
    command: &str,
) -> Result<Report, ComputeError> {
    let mut report = parts::signed_report(
        case,
        command,
        match result.machine {
            Machine::InPlane(_) => "Simulated run of a ball bearing in its housing",
            Machine::InSpace(_) => "Simulated run of a shaft in its bearings and their housing",
        },
    );
    let few = result.windows.len() <= SHOWN_WINDOWS;
    let name = case.source.path.display().to_string();
    let of_many = result.windows.iter().filter(|_| !few);
    let rows: Vec<AnalysisRow> = of_many.map(|window| AnalysisRow::of(&name, window.clone())).collect();
    if result.machine.in_space().is_some() && !result.windows.is_empty() {
        report = report.headline("Verdict on the machine", result.verdict_on_machine(), Verdict::None);
    }
    for (label, bearing) in case.all_bearings() {
        let faults = parts::faults(bearing).join("; ");
        let faults = if faults.is_empty() { parts::NO_FAULT.to_owned() } else { faults };
        let name = match label.as_str() {
            "" => "Fault of the bearing in this case".to_owned(),
            label => format!("Fault of bearing {label} in this case"),
        };
        report = report.headline(name, faults, Verdict::None);
    }
    let truth = |window: &_| parts::not_shown(case, window);
    report = if few { verdict_headlines(report, &result.windows, truth) } else { counts(report, &rows) };
    report = headlines(report, result);
    if let RunEnd::BlewUp(error) = &result.simulation.end {
        report = report.warning(format!("{error} The signals end there."));
    }
    report.warnings.extend(result.not_analysed.iter().map(|text| format!("Not analysed: {text}")));
    report.warnings.extend_from_slice(&result.warnings);
    report = report.section(inputs(case, result));
    if few {
        report.sections.extend(result.windows.iter().map(window_section));
    } else {
        let instead = "`plummer analyze FOLDER --channel NAME` shows one sensor's.";
        report = report.section(verdicts(&rows, instead));
    }
    report = report.section(signals(result)?);
    let scalograms = result.scalograms.iter().take(SHOWN_WINDOWS);
    report.sections.extend(scalograms.map(SensorScalogram::section));
    report = report.section(frequencies(case, result));
    let (stage, in_plane) = (result.machine.stage(), result.machine.in_plane());
    let setup = in_plane.map(|machine| &machine.scene.setup);
    let facts = parts::model_facts(&stage.bodies, Some(stage.fixed_interface_modes));
    let model = Section::new("Model").drawing(parts::draw(case, &stage.bodies, setup)).facts(facts);
    let choice = Section::new("What was modelled, and why")
        .paragraph(format!("{}.", capital(&result.estimate_sentence())))
        .table(result.choice.table());
    let title = if in_plane.is_some() { "Bearing" } else { "Bearings" };
    report = report
        .section(model)
        .section(choice)
        .section(Section::new(title).table(bearing_part(&result.machine)))
        .section(match &result.machine {
            Machine::InPlane(machine) => parts::statics_section(&machine.scene.setup, &machine.statics),
            Machine::InSpace(machine) => parts::shaft_at_rest(&machine.scene.setup, &machine.equilibria),
        })
        .section(Section::new("Computation").facts(computation(result)));
    let imported = stage.bodies.imported.iter();
    report.warnings.extend(imported.flat_map(|imported| imported.notes.iter().cloned()));
    report.assumptions.extend(parts::assumptions(case, setup));
    report
        .assumptions
        .extend(result.machine.in_space().iter().flat_map(|scene| parts::assumptions_in_space(&scene.setup)));
    Ok(report.assumption(
        "Accelerations are band-limited to 0.4 of the output rate before sampling; positions and forces are instantaneous values.",
    ))
}

/// The bearing in its plane, or all of a machine, in a table.
pub(crate) fn bearing_part(machine: &Machine) -> Table {
    match machine {
        Machine::InPlane(machine) => {
            let scene = &machine.scene;
            parts::bearing_table(&scene.setup, &scene.contacts, Some(&scene.equilibrium))
        }
        Machine::InSpace(machine) => parts::bearings_table(&machine.scene),
    }
}

/// The case in words, and the model that was chosen for it.
fn inputs<R: Recording>(case: &Case, result: &RunResult<R>) -> Section {
    let size = result.machine.stage().bodies.housing.as_ref().map(parts::HousingSize::of_housing);
    let part = |part: &ChosenPart| Fact::new(format!("Model: {}", part.what), &part.chosen).note(capital(&part.why));
    let bearing = &result.bearing_model;
    let bearing = Fact::new("Model: bearing", bearing.chosen).note(capital(&bearing.why));
    let chosen = std::iter::once(bearing).chain(result.choice.parts.iter().map(part));
    Section::new("Inputs").facts(parts::inputs(case, Purpose::Run, size.as_ref()).into_iter().chain(chosen))
}

/// Seconds of computing per simulated second.
pub(crate) fn cost(realtime_factor: f64) -> String {
    significant(1.0 / realtime_factor, 2)
}

fn headlines<R: Recording>(report: Report, result: &RunResult<R>) -> Report {
    let simulation = &result.simulation;
    let complete = matches!(simulation.end, RunEnd::Complete);
    let length = significant(simulation.simulated_s, 4);
    let mut report = report
        .headline("Simulated", format!("{length} s"), Verdict::of(complete && result.distrust().is_none()))
        .headline("Computing per simulated second", format!("{} s", cost(simulation.realtime_factor())), Verdict::None);
    if let Some(window) = result.windows.first() {
        report = report.headline(
            format!("{} peak, {} to {} s", window.sensor, given(window.from), given(window.to)),
            format!("{} m/s^2", significant(window.peak, 3)),
            Verdict::None,
        );
    }
    report
}

fn signals<R: Recording>(result: &RunResult<R>) -> Result<Section, ComputeError> {
    let mut section = Section::new("Signals");
    let simulation = &result.simulation;
    let (record, rows) = (&simulation.record, simulation.record.rows());
    if rows == 0 {
        return Ok(section.paragraph("The run ended before the first instant was complete."));
    }
    let sensors = record.layout().sensors;
    let grid = [simulation.start_s, simulation.schedule.interval];
    let shown = &sensors[..sensors.len().min(SHOWN_WINDOWS)];
    if shown.len() < sensors.len() {
        section = section.paragraph(format!(
            "The first {} of {} sensors are shown; signals.npz has all.",
            shown.len(),
            sensors.len()
        ));
    }
    for (index, name) in shown.iter().enumerate() {
        let mut thinner = Thinner::new(rows, SIGNAL_POINTS / shown.len());
        record.read(Column::Sensor(index), 0..rows, &mut |piece| {
            thinner.push(piece);
            Ok(())
        })?;
        section = section.plot(
            Plot::new(format!("Acceleration at {name}"), Axis::new("Time", "s"), Axis::new("Acceleration", "m/s^2"))
                .curve(Curve::of_thinned(name, grid, thinner))
                .caption(format!(
                    "Acceleration at {name} over the whole run, as an accelerometer with this sampling rate records it. Look for impacts that come back at equal distances."
                )),
        );
    }
    Ok(section)
}

fn frequencies<R: Recording>(case: &Case, result: &RunResult<R>) -> Section {
    let modes = &result.machine.stage().modes;
    let unloaded: Vec<f64> = (0..modes.count().min(LISTED_MODES)).map(|mode| modes.frequency_hz(mode)).collect();
    let loaded = result.machine.loaded();
    let nearest_hz = |hz| loaded.nearest(hz).map(|mode| mode.frequency_hz);
    let expected = case.modes.expected.iter().map(|expected| ExpectedMode::of(expected, nearest_hz(expected.hz)));
    let expected: Vec<ExpectedMode> = expected.collect();
    let mut section = Section::new("Eigenfrequencies");
    if !expected.is_empty() {
        section = section.table(parts::expected_table(&expected));
    }
    section.table(parts::mode_table(&unloaded, loaded))
}

fn computation<R: Recording>(result: &RunResult<R>) -> Vec<Fact> {
    let simulation = &result.simulation;
    let steps = simulation.statistics.steps;
    let energy = simulation.energy.map(|energy| {
        let [input, taken, stored, error] =
            [energy.input_j(), energy.dissipated_j(), energy.stored_j, energy.error().abs()]
                .map(|value| significant(value, 2));
        Fact::new("Energy that does not add up", error).note(format!(
            "of all that was exchanged: {input} J came in, {taken} J were damped, {stored} J more are stored"
        ))
    });
    let others = if simulation.residual { "the others by their static residual" } else { "without static residual" };
    let mut facts = vec![
        Fact::new("Method", simulation.method.name()),
        Fact::new("Step", format!("{} s", significant(simulation.step_s(), 4))),
        Fact::new("Steps", steps.to_string()),
        Fact::new("Kept modes", format!("{} of {}", simulation.modes, result.machine.stage().structure.dof()))
            .note(others),
        Fact::new("Wall time of the stepping", format!("{} s", significant(simulation.stepping_s, 3))),
        Fact::new("Computing per simulated second", format!("{} s", cost(simulation.realtime_factor())))
            .note("wall time of the stepping over simulated time"),
        Fact::new(
            "Time per step",
            format!("{} \u{b5}s", significant(1e6 * simulation.stepping_s / steps.max(1) as f64, 3)),
        ),
    ];
    facts.extend(energy);
    facts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::commands::run::compute_run;
    use crate::numerics::Unwatched;
    use crate::report::Block;

    /// Twelve sensors are drawn, and of more than twelve windows there is one table.
    #[test]
    fn a_report_of_many_sensors_shows_some_and_says_so() {
        let sections = |sensors: usize| {
            let sensor = |at| format!("{{name='P{at}',ring_deg={at},direction=[0,1,0]}}");
            let all: Vec<String> = (0..sensors).map(sensor).collect();
            let all = format!("sensors=[{}]", all.join(","));
            let window = "analysis.envelope=[{from=0.2e-3,to=0.8e-3}]";
            let set = [&*all, window, "transient.end=1e-3", "transient.modes=3"];
            let case = Case::example("scenes/smooth", &set);
            let result = compute_run(&case, &Unwatched).unwrap();
            assert_eq!(result.windows.len(), sensors, "{:?}", result.not_analysed);
            run_report(&case, &result, "").unwrap().sections
        };
        let plots = |sections: &[Section]| {
            let blocks = sections.iter().flat_map(|section| &section.blocks);
            blocks.filter(|block| matches!(block, Block::Plot(_))).count()
        };
        let titled = |sections: &[Section], title: &str| sections.iter().any(|section| section.title == title);
        let (few, many) = (sections(SHOWN_WINDOWS), sections(SHOWN_WINDOWS + 1));
        assert!(!titled(&few, "Verdicts") && titled(&many, "Verdicts"));
        assert!(plots(&few) > 2 * SHOWN_WINDOWS && plots(&many) < plots(&few));
        let said = many.iter().flat_map(|section| &section.blocks);
        let said = said
            .filter(|block| matches!(block, Block::Paragraph(text) if text.starts_with("The first 12 of 13 sensors")));
        assert_eq!(said.count(), 1);
    }

    /// The first section says the case, and what is known of the bearing stands beside the verdicts.
    #[test]
    fn a_report_begins_with_the_case_in_words() {
        let case = Case::example("scenes/smooth", &["transient.end=1e-3", "transient.modes=3"]);
        let report = run_report(&case, &compute_run(&case, &Unwatched).unwrap(), "").unwrap();
        let headline = |label: &str| report.headlines.iter().find(|found| found.label == label).unwrap();
        assert_eq!(headline("Fault of the bearing in this case").value, "none, a sound bearing");
        assert!(headline("Computing per simulated second").value.ends_with(" s"));
        let [Block::Facts(facts)] = report.sections[0].blocks.as_slice() else { panic!("{:?}", report.sections[0]) };
        for name in ["Outer ring", "Bearing", "Shaft", "Speed of the shaft", "Sensors", "Model: modes", "Model: method"]
        {
            assert!(facts.iter().any(|fact| fact.name == name), "{name}");
        }
        let damping = facts.iter().find(|fact| fact.name == "Damping of ring and housing").unwrap();
        assert_eq!(damping.value, "3 % of critical in every mode");
    }

    /// A run to its end in steps that are too long is no good one.
    #[test]
    fn a_run_that_cannot_be_trusted_has_no_good_headline() {
        let set = ["transient.end=1e-3", "transient.modes=3"];
        let case = Case::example("scenes/smooth", &set);
        let mut result = compute_run(&case, &Unwatched).unwrap();
        let verdict = |result: &RunResult| {
            let headlines = run_report(&case, result, "").unwrap().headlines;
            let simulated = headlines.iter().find(|found| found.label == "Simulated");
            simulated.unwrap().verdict
        };
        assert!(matches!(result.simulation.end, RunEnd::Complete));
        assert_eq!(verdict(&result), Verdict::Ok);
        result.choice.stable_s = Some(1e-9);
        assert!(result.distrust().is_some());
        assert_eq!(verdict(&result), Verdict::Bad);
    }
}
