//! Tables of where the energy of each mode is.

use super::shape_view::shown_places;
use crate::fe::modal::ModalSurvey;
use crate::report::{Cell, Column, Table};

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
    let row = |parts: &[f64], ring: Option<f64>, attached: &[f64], by_group: &[f64]| {
        let groups = groups.iter().map(|&group| by_group[group]);
        let whole = parts.iter().copied().chain(ring).chain(attached.iter().copied());
        whole.chain(groups).collect::<Vec<f64>>()
    };
    let has_ring = survey.ring.is_some();
    let names = |attached: &[String]| {
        let ring = has_ring.then(|| "the ring".to_owned());
        let whole = found.parts.iter().cloned().chain(ring).chain(attached.iter().cloned());
        let groups = groups.iter().map(|&group| format!("in {}", found.groups[group]));
        whole.chain(groups).collect::<Vec<String>>()
    };
    let strain = found.modes.iter().map(|mode| {
        let own = mode.strain.as_ref()?;
        Some(row(&own.parts, own.ring, &own.springs, &own.groups))
    });
    let kinetic = found.modes.iter().map(|mode| {
        let own = mode.kinetic.as_ref()?;
        Some(row(&own.parts, own.ring, &own.masses, &own.groups))
    });
    let looked_at_twice = !groups.is_empty();
    let strain = table("Strain energy", survey, &names(&found.springs), strain);
    let kinetic = table("Kinetic energy", survey, &names(&found.masses), kinetic);
    let noted = |table: Table| {
        if looked_at_twice {
            table.footnote("Columns named \"in\" a group show once more what part of the whole is in that group; groups may overlap. The other columns add up to 100 %.")
        } else {
            table
        }
    };
    strain.into_iter().chain(kinetic).map(noted).collect()
}

fn table(
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
    let mut table = Table::new(caption, columns);
    for (mode, shares) in modes.enumerate() {
        let mut cells = vec![Cell::text((mode + 1).to_string()), Cell::number(survey.basis.frequencies_hz[mode], 6)];
        match shares {
            Some(shares) => cells.extend(shares.into_iter().map(|share| {
                let text = if share < LISTED_SHARE { "<0.5".to_owned() } else { format!("{:.1}", 100.0 * share) };
                Cell::text(text).value(100.0 * share)
            })),
            None => cells.extend(names.iter().map(|_| Cell::text("-"))),
        }
        table = table.row(cells);
    }
    Some(table.showing_modes(shown_places(survey)))
}
