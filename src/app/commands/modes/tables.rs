//! Tables, facts and charts of the modal report.

use super::compute::ModesResult;
use super::shape_view::shown_places;
use crate::app::case::{Case, Material};
use crate::fe::modal::ModalSurvey;
use crate::fe::modal::{MassDistribution, MassProperties, Participation};
use crate::report::{Axis, Bars, Cell, Column, Fact, Table, Verdict, fixed, significant};

/// Direction of a column of a participation, by the number of columns.
fn directions(columns: usize) -> &'static [&'static str] {
    match columns {
        3 => &["x", "y", "about z"],
        _ => &["x", "y", "z", "about x", "about y", "about z"],
    }
}

/// Every mode with its error bound, its residual and what it is.
pub(crate) fn frequency_table(survey: &ModalSurvey) -> Table {
    let basis = &survey.basis;
    let mut table = Table::new(
        "Eigenfrequencies without contact",
        [
            Column::number("Mode", ""),
            Column::number("Frequency", "Hz"),
            Column::number("Error bound", "Hz"),
            Column::number("Relative residual", ""),
            Column::text("Kind"),
        ],
    );
    for mode in 0..basis.count() {
        let rigid = mode < basis.rigid_modes;
        table = table.row([
            Cell::text((mode + 1).to_string()),
            Cell::number(basis.frequencies_hz[mode], 7),
            Cell::number(basis.error_bounds_hz[mode], 2),
            Cell::number(basis.residuals[mode], 2),
            Cell::text(if rigid { "rigid" } else { "elastic" }),
        ]);
    }
    table
        .showing_modes(shown_places(survey))
        .footnote("The bound is that of the computation: how far the frequency may be from that of the same matrices in exact arithmetic. The mesh's own error is not in it.")
}

/// The proof that no mode is missing, and how good the modes are.
pub(crate) fn proof_facts(survey: &ModalSurvey) -> Vec<Fact> {
    let basis = &survey.basis;
    let check = basis.count_check;
    let range = match check.above_hz {
        Some(above) => format!("between {} and {} Hz", significant(above, 7), significant(check.below_hz, 7)),
        None => format!("below {} Hz", significant(check.below_hz, 7)),
    };
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    vec![
        Fact::new(format!("Modes {range}, counted"), check.counted.to_string())
            .note("negative pivots of a factorisation of K - (2 pi f)^2 M: Sylvester's law of inertia"),
        Fact::new(format!("Modes {range}, found"), check.found.to_string()),
        Fact::new("Largest relative residual", significant(largest(&basis.residuals), 2))
            .note("|K phi - lambda M phi| over its terms"),
        Fact::new("Orthogonality", significant(basis.orthogonality, 2)).note("largest entry of Phi^T M Phi - 1"),
        Fact::new("Modes without strain, of those computed", basis.rigid_modes.to_string())
            .note("strain energy, summed element by element, zero within its error bound"),
    ]
}

/// Mass, centroid, inertia.
pub(crate) fn mass_facts(mass: &MassProperties) -> Vec<Fact> {
    let millimetres = |values: &[f64]| {
        let texts: Vec<String> = values.iter().map(|value| fixed(1e3 * value, 4)).collect();
        format!("({}) mm", texts.join(", "))
    };
    let mut facts = vec![Fact::new("Mass", format!("{} kg", significant(mass.mass, 6)))];
    match &mass.distribution {
        MassDistribution::Plane { centroid, polar } => {
            facts.push(Fact::new("Centroid", millimetres(centroid)));
            facts.push(
                Fact::new("Moment of inertia", format!("{} kg m^2", significant(*polar, 5)))
                    .note("about the axis along z through the centroid"),
            );
        }
        MassDistribution::Space { centroid, .. } => {
            facts.push(Fact::new("Centroid", millimetres(centroid)));
            if let Some(principal) = mass.principal() {
                let moments: Vec<String> = principal.moments.iter().map(|m| significant(*m, 5)).collect();
                facts.push(
                    Fact::new("Principal moments", format!("{} kg m^2", moments.join(", "))).note("about the centroid"),
                );
                let axes: Vec<String> =
                    principal.axes.iter().map(|a| format!("({})", a.map(|part| fixed(part, 4)).join(", "))).collect();
                facts.push(Fact::new("Principal axes", axes.join(", ")));
            }
        }
    }
    facts
}

/// Materials that the case's parts and sections use.
pub(crate) fn material_table(case: &Case) -> Table {
    let mut table = Table::new(
        "Materials",
        [
            Column::text("Part"),
            Column::text("Material"),
            Column::text("Elasticity"),
            Column::number("Density", "kg/m^3"),
        ],
    );
    let parts = case.meshed_housing().into_iter().flat_map(|housing| &housing.parts);
    let parts = parts.map(|part| (part.group.clone(), part.material.clone()));
    let layers = case.ring.iter().flat_map(|ring| &ring.sections);
    let layers = layers.map(|layer| ("ring".to_owned(), layer.material.clone()));
    for (part, name) in parts.chain(layers) {
        let (elasticity, density) = match case.material(&name) {
            Some(Material::Isotropic(m)) => (
                format!("E = {} GPa, nu = {}", significant(m.young * 1e-9, 4), significant(m.poisson, 3)),
                Cell::number(m.density, 5),
            ),
            Some(Material::Orthotropic(m)) => {
                let young: Vec<String> = m.young.iter().map(|e| significant(e * 1e-9, 4)).collect();
                (format!("orthotropic, E = {} GPa", young.join(", ")), Cell::number(m.density, 5))
            }
            None => (String::new(), Cell::text("")),
        };
        table = table.row([Cell::text(part), Cell::text(name), Cell::text(elasticity), density]);
    }
    table
}

/// Effective mass of every mode along every direction, in per cent of the whole.
pub(crate) fn effective_mass_table(survey: &ModalSurvey, found: &Participation) -> Table {
    let names = directions(found.totals.len());
    let mut columns = vec![Column::number("Mode", ""), Column::number("Frequency", "Hz")];
    columns.extend(names.iter().map(|name| Column::number(*name, "%")));
    let mut table = Table::new("Effective mass", columns);
    let percent = |value: f64| Cell::text(format!("{:.2}", 100.0 * value)).value(100.0 * value);
    for mode in 0..survey.basis.count() {
        let mut cells = vec![Cell::text((mode + 1).to_string()), Cell::number(survey.basis.frequencies_hz[mode], 6)];
        cells.extend(
            (0..names.len()).map(|direction| found.fraction(mode, direction).map_or_else(|| Cell::text(""), percent)),
        );
        table = table.row(cells);
    }
    let mut sums = vec![Cell::text("sum"), Cell::text("")];
    sums.extend((0..names.len()).map(|j| percent(found.sums[j] / found.totals[j])));
    table
        .row(sums)
        .showing_modes(shown_places(survey))
        .footnote("Per cent of the mass and, about the axes through the centroid, of the moments of inertia. What fixed nodes carry is in no mode; the rest of a sum is in modes above those computed.")
}

/// Effective masses of the translations as a chart.
pub(crate) fn effective_mass_bars(survey: &ModalSurvey, found: &Participation) -> Bars {
    let names = directions(found.totals.len());
    let translations = if names.len() == 3 { 2 } else { 3 };
    let count = survey.basis.count();
    let labels = (1..=count).map(|mode| mode.to_string());
    let axis = Axis::new("Effective mass", "%");
    let mut bars = Bars::new("Effective mass by mode", "Mode", labels, axis);
    for (direction, name) in names.iter().enumerate().take(translations) {
        let share = |mode| 100.0 * found.fraction(mode, direction).unwrap_or(0.0);
        bars = bars.series(*name, (0..count).map(share).collect());
    }
    bars
}

/// Why there are motions without strain, in sentences: a free housing, parts that are not connected, mechanisms.
pub(crate) fn free_motions(result: &ModesResult) -> Vec<String> {
    let survey = &result.survey;
    let Some(mechanisms) = &survey.mechanisms else {
        return Vec::new();
    };
    let mut sentences = mechanisms.sentences();
    let (expected, found) = (mechanisms.total(), survey.basis.rigid_modes);
    let all_asked = survey.basis.count() > expected;
    if found < expected && found == survey.basis.count() {
        sentences.push(format!(
            "{found} of the {expected} modes without strain were asked for and computed: `modes.count = {}` gives the first elastic one too.",
            expected + 1
        ));
    }
    if all_asked && expected != found && survey.basis.count_check.above_hz.is_none() {
        sentences.push(format!(
            "{found} modes without strain were found where the connections of the parts leave {expected} free motions: look at the mode shapes."
        ));
    }
    sentences
}

/// The verdict on completeness for the head of the report.
pub(crate) fn complete(survey: &ModalSurvey) -> Verdict {
    let check = survey.basis.count_check;
    Verdict::of(check.counted == check.found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_off_of_a_centroid_has_no_sign() {
        let mass = MassProperties {
            mass: 2.0,
            distribution: MassDistribution::Space {
                centroid: [-1e-19, 2e-3, -3e-3],
                inertia: [[1.0, -1e-17, 0.0], [-1e-17, 2.0, 0.0], [0.0, 0.0, 3.0]],
            },
        };
        let facts = mass_facts(&mass);
        let value = |name: &str| facts.iter().find(|fact| fact.name == name).unwrap();
        assert_eq!(value("Centroid").value, "(0.0000, 2.0000, −3.0000) mm");
        let axes = &value("Principal axes").value;
        assert!(!axes.contains("-0.0") && !axes.contains("−0.0000"), "{axes}");
    }
}
