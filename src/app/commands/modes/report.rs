//! The report of `plummer modes`: a modal verification report.

use super::checks_report::{comparison_section, convergence_section, headlines};
use super::compute::{ModesResult, Reading};
use super::shape_view::shape_view;
use super::tables;
use crate::app::case::{Case, Purpose};
use crate::app::commands::computed::Computed;
use crate::app::commands::parts::{self, ExpectedMode};
use crate::app::error::ComputeError;
use crate::app::scene::{bearing_setup, race_contacts};
use crate::fe::modal::FrequencyCount;
use crate::report::{
    Abscissa, Axis, Cell, Column, Curve, CurveStyle, Fact, ModeShapeView, Plot, Report, Section, ShapeFigures, Table,
    Verdict, signed_fixed, significant,
};
use crate::system::{LoadedPass, LoadedPoint};

/// Frequencies drawn over a ball pass.
const DRAWN: usize = 8;

/// What is to be known of loaded modes in a housing, so that nobody takes the reduction for an effect of the load.
const CONDENSED: &str = "Loaded modes are those of a model with its housing condensed, which alone raises frequencies a little: plummer condense --compare-full says how much. A smaller difference between the columns says nothing of the load.";

impl Computed for ModesResult {
    fn report(&self, case: &Case, command: &str) -> Result<Report, ComputeError> {
        modes_report(case, self, command)
    }
}

/// Composes the report; `command` is the line that made it.
///
/// # Errors
/// [`ComputeError`] if the case's bearing cannot be built.
pub(crate) fn modes_report(case: &Case, result: &ModesResult, command: &str) -> Result<Report, ComputeError> {
    let view = shape_view(result);
    let mut report = head(case, result, command);
    report = report.section(inputs(case, result)).section(purpose(result)).section(model(case, result, &view)?);
    if let Some(mass) = &result.survey.mass {
        let section = Section::new("Mass properties");
        let section = section.paragraph("From the mass matrix itself, point masses included.");
        report = report.section(section.facts(tables::mass_facts(mass)));
    }
    report = report.section(frequencies(result));
    let proof = Section::new("Completeness and accuracy")
        .paragraph("Eigenvalues below a shift are counted by a factorisation that knows nothing of the modes found. If both numbers agree, none is missing and none was invented.")
        .facts(tables::proof_facts(&result.survey));
    report = report.section(proof);
    let comparisons = result.comparisons.iter().map(|comparison| comparison_section(comparison, &result.survey));
    report.sections.extend(comparisons);
    let convergence = result.convergence.iter().map(|convergence| convergence_section(convergence, &result.survey));
    report.sections.extend(convergence);
    if result.survey.basis.count() > 0 {
        if let Some(found) = &result.survey.participation {
            let mass = Section::new("Effective mass")
                .bars(tables::effective_mass_bars(&result.survey, found))
                .table(tables::effective_mass_table(&result.survey, found));
            report = report.section(tables::energy_tables(&result.survey).into_iter().fold(mass, Section::table));
        }
        let shapes = ModeShapeView { figures: ShapeFigures::Modes, ..view };
        report = report.section(Section::new("Mode shapes").shapes(shapes));
    }
    if !result.variants.is_empty() {
        report = report.section(
            Section::new("What each choice does")
                .paragraph("The same case with one choice changed at a time, nearest mode to each expected frequency. Modes without contact are in full; those under load belong to a model with its housing condensed.")
                .table(variant_table(&result.base, &result.variants)),
        );
    }
    // the bearing in space has its own pages
    let setup = if result.statics.is_some() || case.in_the_plane().is_ok() { bearing_setup(case)? } else { None };
    if let (Some(setup), Some(contacts)) = (&setup, race_contacts(case)?) {
        let equilibria = result.statics.iter().flat_map(|statics| &statics.equilibria);
        let table = parts::bearing_table(setup, &contacts, equilibria.clone().next());
        report = report.section(Section::new("Bearing").table(table));
        report.sections.extend(result.statics.as_ref().map(|statics| parts::statics_section(setup, statics)));
        report.sections.extend(result.loaded_pass.as_ref().map(loaded_pass_section));
    }
    report.assumptions.extend(parts::assumptions(case, setup.as_ref()));
    let imported = result.bodies.iter().flat_map(|bodies| &bodies.imported);
    report.warnings.extend(imported.flat_map(|imported| imported.notes.iter().cloned()));
    report.warnings.extend(result.doubts.iter().cloned().chain(tables::free_motions(result)));
    report.warnings.extend(result.convergence.iter().flat_map(|convergence| convergence.notes.iter().cloned()));
    Ok(report)
}

/// The case in words.
fn inputs(case: &Case, result: &ModesResult) -> Section {
    // the mass of housing and ring together has a section of its own
    let mass = result.survey.mass.as_ref().filter(|_| !case.has_rings()).map(|mass| mass.mass);
    let size = result.mesh_and_model().map(|(mesh, model)| parts::HousingSize::of(mesh, model, mass));
    Section::new("Inputs").facts(parts::inputs(case, Purpose::Modes, size.as_ref()))
}

fn head(case: &Case, result: &ModesResult, command: &str) -> Report {
    let mut report = parts::signed_report(case, command, "Modal verification report");
    for expected in &result.base.expected {
        let found = expected.found_hz.map_or_else(|| "none".to_owned(), |hz| format!("{} Hz", significant(hz, 4)));
        report = report.headline(&expected.what, found, Verdict::of(expected.ok));
    }
    let basis = &result.survey.basis;
    let (label, text, mut verdict) = completeness(basis.count_check);
    if let Some(unknown) = result.unknown() {
        report = report.headline("Eigenfrequencies", unknown, Verdict::Bad);
        if verdict == Verdict::Ok {
            // the count is of the same matrix, with the same round-off
            verdict = Verdict::None;
        }
    }
    report = headlines(report, result).headline(label, text, verdict);
    if let Some(first) = basis.frequencies_hz.get(basis.rigid_modes) {
        let first = format!("{} Hz", significant(*first, 5));
        report = report.headline("First elastic mode", first, Verdict::None);
    }
    report
}

/// Whether a mode is missed in the range that was counted, in words.
pub(crate) fn completeness(check: FrequencyCount) -> (&'static str, String, Verdict) {
    let missed = check.counted.abs_diff(check.found);
    let what = match missed {
        0 if check.counted == 0 => "nothing was proved: no mode lies".to_owned(),
        0 => "no mode missed".to_owned(),
        missed if check.found < check.counted => format!("{missed} missed"),
        surplus => format!("{surplus} too many found"),
    };
    (
        "Modes, by an independent count",
        format!("{what} {}", tables::counted_range(&check)),
        Verdict::of(missed == 0 && check.counted > 0),
    )
}

fn purpose(result: &ModesResult) -> Section {
    let survey = &result.survey;
    let what = match (&result.bodies, result.mesh_and_model()) {
        (Some(_), Some(_)) => "a housing and the ring in its bore, coupled in full (nothing condensed)",
        (Some(bodies), None) if bodies.imported.is_some() => "a ring in a housing that is a superelement from a file",
        (Some(_), None) => "a ring on its springs",
        _ => "a housing",
    };
    let mut text = format!(
        "Eigenfrequencies and mode shapes of {what}: {} modes of {} free degrees of freedom",
        survey.basis.count(),
        survey.free_dof
    );
    text.push_str(match survey.basis.rigid_modes {
        0 => ". ",
        1 => ", one of them without strain. ",
        _ => ", the first ones without strain. ",
    });
    text.push_str("Each frequency comes with a bound on the error of its computation, and the number of modes is proved by a count.");
    let section = Section::new("Purpose").paragraph(text);
    match result.base.expected.is_empty() {
        true => section,
        false => section.table(parts::expected_table(&result.base.expected)),
    }
}

fn model(case: &Case, result: &ModesResult, view: &ModeShapeView) -> Result<Section, ComputeError> {
    let mut section = Section::new("Model");
    section = section.facts([
        Fact::new("Degrees of freedom", result.survey.dof.to_string()),
        Fact::new("Free ones", result.survey.free_dof.to_string()),
    ]);
    if let Some(bodies) = &result.bodies {
        let facts = parts::model_facts(bodies, result.fixed_interface_modes);
        section = section.drawing(parts::draw(case, bodies, bearing_setup(case)?.as_ref())).facts(facts);
    }
    if result.mesh_and_model().is_some() {
        let (title, figures) = ("The model".to_owned(), ShapeFigures::Mesh);
        section = section.shapes(ModeShapeView { title, figures, modes: Vec::new(), ..view.clone() });
    }
    Ok(section)
}

fn frequencies(result: &ModesResult) -> Section {
    let section = Section::new("Eigenfrequencies").table(tables::frequency_table(&result.survey));
    let Some(loaded) = &result.base.loaded else {
        return section;
    };
    let table = parts::mode_table(&result.base.unloaded_hz, loaded);
    section.table(match result.mesh_and_model() {
        Some(_) => table.footnote(CONDENSED),
        None => table,
    })
}

fn variant_table(base: &Reading, variants: &[Reading]) -> Table {
    let expected = &base.expected;
    let mut columns = vec![Column::text("Reading")];
    let near = |expected: &ExpectedMode| format!("near {} kHz", significant(expected.hz / 1e3, 3));
    columns.extend(expected.iter().map(|expected| Column::number(near(expected), "Hz")));
    columns.push(Column::number("Modes below 40 kHz without the balls' own", "kHz"));
    Table::new("Readings side by side", columns).rows(std::iter::once(base).chain(variants).map(|reading| {
        let name = if reading.what.is_empty() { "this case" } else { &reading.what };
        let mut cells = vec![Cell::text(name)];
        for expected in &reading.expected {
            let cell = match (expected.found_hz, expected.relative_error) {
                (Some(hz), Some(error)) => {
                    let error = 100.0 * error;
                    Cell::text(format!("{} ({} %)", significant(hz, 4), signed_fixed(error, 1))).value(hz)
                }
                _ => Cell::text("none"),
            };
            cells.push(cell.judged(Verdict::of(expected.ok)));
        }
        cells.push(Cell::text(own_modes(reading)));
        cells
    }))
}

fn own_modes(reading: &Reading) -> String {
    let frequencies: Vec<f64> = match &reading.loaded {
        Some(loaded) => loaded.modes.iter().filter(|mode| !mode.is_ball_mode()).map(|mode| mode.frequency_hz).collect(),
        None => reading.unloaded_hz.clone(),
    };
    let below = frequencies.iter().filter(|&&hz| hz < 40e3);
    below.map(|hz| significant(hz / 1e3, 4)).collect::<Vec<_>>().join(", ")
}

/// Loaded frequencies as the balls go round.
fn loaded_pass_section(pass: &LoadedPass) -> Section {
    let angle = chart(
        "Loaded frequencies over a ball pass",
        Axis::new("Cage turned by", "deg"),
        &pass.over_angle,
        f64::to_degrees,
    );
    let load = chart(
        "Loaded frequencies over the load",
        Axis::new("Load on the shaft, in units of the case's", "").log(),
        &pass.over_load,
        |factor| factor,
    );
    Section::new("Loaded frequencies as the balls go round").plot(angle).plot(load)
}

/// The lowest frequencies of modes that are not the balls' own, by their number.
fn chart(title: &str, x: Axis, points: &[LoadedPoint], show: impl Fn(f64) -> f64) -> Plot {
    let places: Vec<f64> = points.iter().map(|point| show(point.at)).collect();
    let frequencies: Vec<Vec<f64>> = points
        .iter()
        .map(|point| {
            let modes = point.modes.iter().flat_map(|loaded| &loaded.modes);
            let held = modes.filter(|mode| !mode.is_ball_mode());
            held.map(|mode| mode.frequency_hz).take(DRAWN).collect()
        })
        .collect();
    let mut plot = Plot::new(title, x, Axis::new("Frequency", "Hz").log()).caption(
        "Each angle and load at its own equilibrium, without the modes that are the balls' own; numbered by frequency, so that two curves that come close may exchange their modes.",
    );
    for mode in 0..DRAWN {
        let values = frequencies.iter().map(|found| found.get(mode).copied().unwrap_or(f64::NAN));
        let values: Vec<f64> = values.collect();
        if values.iter().any(|value| value.is_finite()) {
            let curve = Curve::new(format!("mode {}", mode + 1), Abscissa::Points(places.clone()), values);
            plot = plot.curve(curve.style(CurveStyle::Line));
        }
    }
    plot
}

#[cfg(test)]
mod tests {
    use super::{Case, ModesResult, Verdict, modes_report};
    use crate::app::commands::modes::compute_modes;
    use crate::numerics::Unwatched;

    #[test]
    fn modes_that_are_not_known_head_the_page_with_the_largest_bound_of_theirs() {
        let case = Case::example("tadina2011/healthy", &["modes.count=8", "modes.expected=[]"]);
        let mut result = compute_modes(&case, &Unwatched).unwrap();
        let heads = |result: &ModesResult| modes_report(&case, result, "").unwrap().headlines;
        assert!(result.passes() && heads(&result).iter().all(|head| head.label != "Eigenfrequencies"));
        let basis = &mut result.survey.basis;
        let [first, known] = [basis.frequencies_hz[0], basis.frequencies_hz[3]];
        (basis.error_bounds_hz[0], basis.error_bounds_hz[3]) = (0.2 * first, 0.05 * known);
        assert!(0.05 * known > 0.2 * first);
        let expected = "1 of 8 eigenfrequencies are not known: round-off of the stiffness hides them, with error bounds up to 750 Hz";
        assert_eq!(result.unknown().as_deref(), Some(expected));
        let head = &heads(&result)[0];
        assert_eq!(
            (head.label.as_str(), head.value.as_str(), head.verdict),
            ("Eigenfrequencies", expected, Verdict::Bad)
        );
        assert!(!result.passes());
    }
}
