//! Tables, facts and charts of the modal report.

use super::compute::ModesResult;
use super::kinds::kinds;
use super::shape_view::shown_places;
use crate::fe::modal::{FrequencyCount, MassDistribution, MassProperties, ModalSurvey, Participation};
use crate::report::{Axis, Bars, Cell, Column, Fact, Table, fixed, mass_in_words, quantity, significant};

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
    let columns = [
        Column::number("Mode", ""),
        Column::number("Frequency", "Hz"),
        Column::number("Error bound", "Hz"),
        Column::number("Relative residual", ""),
        Column::text("Kind"),
    ];
    let rows = kinds(survey).into_iter().enumerate().map(|(mode, kind)| {
        [
            Cell::text((mode + 1).to_string()),
            Cell::number(basis.frequencies_hz[mode], 7),
            Cell::number(basis.error_bounds_hz[mode], 2),
            Cell::number(basis.residuals[mode], 2),
            Cell::text(kind),
        ]
    });
    Table::new("Eigenfrequencies without contact", columns)
        .rows(rows)
        .showing_modes(shown_places(survey))
        .footnote("The bound is that of the computation: how far the frequency may be from that of the same matrices in exact arithmetic. The mesh's own error is not in it.")
}

/// The frequencies between which modes were counted.
pub(crate) fn counted_range(check: &FrequencyCount) -> String {
    let below = quantity(check.below_hz, "Hz");
    match check.above_hz {
        Some(above) => format!("between {} and {below}", quantity(above, "Hz")),
        None => format!("below {below}"),
    }
}

/// The proof that no mode is missing, and how good the modes are.
pub(crate) fn proof_facts(survey: &ModalSurvey) -> Vec<Fact> {
    let basis = &survey.basis;
    let check = basis.count_check;
    let range = counted_range(&check);
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
    let vector = |values: &[f64], scale: f64| {
        // four decimals, less where that would be more than seven digits
        let largest = values.iter().fold(0.0_f64, |most, value| most.max((scale * value).abs()));
        let decimals = if largest < 1e3 {
            4
        } else if largest < 1e6 {
            1
        } else {
            0
        };
        let texts: Vec<String> = values.iter().map(|value| fixed(scale * value, decimals)).collect();
        format!("({})", texts.join(", "))
    };
    let (centroid, more) = match &mass.distribution {
        MassDistribution::Plane { centroid, polar } => {
            let moment = Fact::new("Moment of inertia", format!("{} kg m^2", significant(*polar, 5)));
            (&centroid[..], vec![moment.note("about the axis along z through the centroid")])
        }
        MassDistribution::Space { centroid, .. } => {
            let principal = mass.principal().map(|principal| {
                let moments = principal.moments.map(|moment| significant(moment, 5)).join(", ");
                let axes = principal.axes.map(|axis| vector(&axis, 1.0)).join(", ");
                let moments = Fact::new("Principal moments", format!("{moments} kg m^2")).note("about the centroid");
                vec![moments, Fact::new("Principal axes", axes)]
            });
            (&centroid[..], principal.unwrap_or_default())
        }
    };
    let centroid = Fact::new("Centroid", format!("{} mm", vector(centroid, 1e3)));
    let whole = Fact::new("Mass", mass_in_words(mass.mass, 6));
    [vec![whole, centroid], more].concat()
}

/// Effective mass of every mode along every direction, in per cent of the whole.
pub(crate) fn effective_mass_table(survey: &ModalSurvey, found: &Participation) -> Table {
    let names = directions(found.totals.len());
    let mut columns = vec![Column::number("Mode", ""), Column::number("Frequency", "Hz")];
    columns.extend(names.iter().map(|name| Column::number(*name, "%")));
    let percent = |value: f64| Cell::text(format!("{:.2}", 100.0 * value)).value(100.0 * value);
    let rows = survey.basis.frequencies_hz.iter().enumerate().map(|(mode, &hz)| {
        let mut cells = vec![Cell::text((mode + 1).to_string()), Cell::number(hz, 6)];
        let shares = (0..names.len()).map(|direction| found.fraction(mode, direction));
        cells.extend(shares.map(|share| share.map_or_else(|| Cell::text(""), percent)));
        cells
    });
    let mut sums = vec![Cell::text("sum"), Cell::text("")];
    sums.extend((0..names.len()).map(|j| percent(found.sums[j] / found.totals[j])));
    Table::new("Effective mass", columns)
        .rows(rows)
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
    bars.caption = Some("Effective mass of each mode along the axes. A tall bar is a mode that a shaking foundation excites in that direction.".to_owned());
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

/// Shares below this are not listed by number.
const LISTED_SHARE: f64 = 0.005;

/// Strain and kinetic energy of every mode by part, ring, spring or point mass, then by those groups that are no parts;
/// none where all of it is in one place.
pub(crate) fn energy_tables(survey: &ModalSurvey) -> Vec<Table> {
    let Some(found) = &survey.shares else {
        return Vec::new();
    };
    let groups: Vec<usize> =
        (0..found.groups.len()).filter(|&group| !found.parts.contains(&found.groups[group])).collect();
    let row = |parts: &[f64], ring: Option<f64>, attached: &[f64], by_group: &[f64]| -> Vec<f64> {
        let groups = groups.iter().map(|&group| by_group[group]);
        parts.iter().copied().chain(ring).chain(attached.iter().copied()).chain(groups).collect()
    };
    let names = |attached: &[String]| -> Vec<String> {
        let name = if survey.rings.len() > 1 { "the rings" } else { "the ring" };
        let ring = (!survey.rings.is_empty()).then(|| name.to_owned());
        let groups = groups.iter().map(|&group| format!("in {}", found.groups[group]));
        found.parts.iter().chain(&ring).chain(attached).cloned().chain(groups).collect()
    };
    let strain = found.modes.iter().map(|mode| {
        let own = mode.strain.as_ref()?;
        Some(row(&own.parts, own.ring, &own.springs, &own.groups))
    });
    let kinetic = found.modes.iter().map(|mode| {
        let own = mode.kinetic.as_ref()?;
        Some(row(&own.parts, own.ring, &own.masses, &own.groups))
    });
    let strain = energy_table("Strain energy", survey, &names(&found.springs), strain);
    let kinetic = energy_table("Kinetic energy", survey, &names(&found.masses), kinetic);
    let noted = |table: Table| {
        match groups.as_slice() {
        [] => table,
        _ => table.footnote("Columns named \"in\" a group show once more what part of the whole is in that group; groups may overlap. The other columns add up to 100 %."),
    }
    };
    strain.into_iter().chain(kinetic).map(noted).collect()
}

fn energy_table(
    caption: &str,
    survey: &ModalSurvey,
    names: &[String],
    modes: impl Iterator<Item = Option<Vec<f64>>>,
) -> Option<Table> {
    if names.len() < 2 {
        return None;
    }
    let mut columns = vec![Column::number("Mode", ""), Column::number("Frequency", "Hz")];
    columns.extend(names.iter().map(|name| Column::number(name.clone(), "%")));
    let rows = modes.enumerate().map(|(mode, shares)| {
        let mut cells = vec![Cell::text((mode + 1).to_string()), Cell::number(survey.basis.frequencies_hz[mode], 6)];
        match shares {
            Some(shares) => cells.extend(shares.into_iter().map(|share| {
                let text = if share < LISTED_SHARE { "<0.5".to_owned() } else { format!("{:.1}", 100.0 * share) };
                Cell::text(text).value(100.0 * share)
            })),
            None => cells.extend(names.iter().map(|_| Cell::text("-"))),
        }
        cells
    });
    Some(Table::new(caption, columns).rows(rows).showing_modes(shown_places(survey)))
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
