//! Tables and texts that both reports show.

use schemars::JsonSchema;
use serde::Serialize;

use super::case_words::damping_words;
use crate::app::case::{Bond, Case, Defect, DentProfile, Expected};
use crate::app::scene::RingsInHousing;
use crate::fe::element::continuum::PlaneAssumption;
use crate::fe::material::RadiusRule;
use crate::fe::model::RingSeat;
use crate::report::{Cell, Column, Document, Fact, Report, Table, Verdict, signed_fixed, significant};
use crate::system::{BallsInertia, BearingSetup, Formulation, LoadedMode, LoadedModes};

/// Loaded modes listed in a report.
const LISTED_MODES: usize = 20;

/// The linear model in facts; `fixed_interface_modes`: number of vectors of the condensed housing's interior, where something of the
/// report was computed with it.
pub(crate) fn model_facts(bodies: &RingsInHousing, fixed_interface_modes: Option<usize>) -> Vec<Fact> {
    let of_ring = |RingSeat { label, ring, .. }: &RingSeat| {
        let section = ring.section();
        let named = |what: &str| format!("{what} {label}").trim_end().to_owned();
        [
            Fact::new(named("Ring"), format!("{} nodes, {} degrees of freedom", ring.nodes(), ring.dof())),
            Fact::new(named("Node radius"), format!("{} mm", significant(section.radius * 1e3, 5))),
            Fact::new(named("Bending stiffness EI"), format!("{} N m^2", significant(section.bending, 4))),
            Fact::new(named("Mass per length"), format!("{} kg/m", significant(section.mass, 4))),
        ]
    };
    let mut facts: Vec<Fact> = bodies.rings.seats().iter().flat_map(of_ring).collect();
    if let Some(imported) = &bodies.imported {
        let (interface_dof, modes) = (imported.element.interface_dof, imported.element.modal_dof());
        facts.extend([
            Fact::new("Superelement", imported.path.display().to_string()),
            Fact::new("Its coordinates", format!("{interface_dof} ring displacements and {modes} modes")),
        ]);
    }
    if let (Some(_), Some(modes)) = (&bodies.housing, fixed_interface_modes) {
        let coordinates = format!("{} ring displacements and {modes} fixed-interface modes", bodies.rings.dof());
        facts.push(Fact::new("Condensed to", coordinates).note("Craig-Bampton"));
    }
    facts
}

/// Loaded and unloaded frequencies side by side.
pub(crate) fn mode_table(unloaded_hz: &[f64], loaded: &LoadedModes) -> Table {
    let listed = &loaded.modes;
    let damped = listed.iter().any(|mode| mode.damping_ratio.is_some());
    let whirls = listed.iter().any(|mode| mode.whirl.is_some());
    let columns = [
        Column::number("Mode", ""),
        Column::number("Without contact", "Hz"),
        Column::number("Loaded", "Hz"),
        Column::number("Ring and housing", "%"),
        Column::number("Shaft", "%"),
        Column::number("Balls", "%"),
    ];
    let more = [(damped, Column::number("Damping", "%")), (whirls, Column::text("Whirl of the shaft"))];
    let more = more.into_iter().filter(|(shown, _)| *shown).map(|(_, column)| column);
    let columns = columns.into_iter().chain(more);
    let rows = LISTED_MODES.min(unloaded_hz.len().max(listed.len()));
    let share = |value: f64| Cell::text(format!("{:.0}", 100.0 * value)).value(100.0 * value);
    let rows = (0..rows).map(|row| {
        let mode = listed.get(row);
        let shares = mode.map_or([None; 3], |mode| [mode.structure_share, mode.shaft_share, mode.ball_share].map(Some));
        let [structure, shaft, balls] = shares.map(|value| value.map_or_else(|| Cell::text(""), share));
        let unloaded = Cell::number_or(unloaded_hz.get(row).copied(), 5, "");
        let loaded = Cell::number_or(mode.map(|mode| mode.frequency_hz), 5, "");
        let damping = mode.and_then(|mode| mode.damping_ratio).map(|ratio| 100.0 * ratio);
        let more = [(damped, Cell::number_or(damping, 3, "")), (whirls, Cell::text(mode.map_or("", whirl_words)))];
        let more = more.into_iter().filter(|(shown, _)| *shown).map(|(_, cell)| cell);
        let row = [Cell::text((row + 1).to_string()), unloaded, loaded, structure, shaft, balls];
        row.into_iter().chain(more).collect::<Vec<_>>()
    });
    let mut table = Table::new("Eigenfrequencies", columns).rows(rows).footnote(
        "Shares are those of the kinetic energy. Columns are sorted by frequency: a row does not pair modes.",
    );
    if loaded.without_stiffness > 0 {
        let count = loaded.without_stiffness;
        table = table.footnote(format!("{count} motions without stiffness are left out: balls that nothing presses."));
    }
    if loaded.unstable > 0 {
        let count = loaded.unstable;
        let why = "motions have no real frequency about this equilibrium and are left out.";
        table = table.footnote(format!("{count} {why}"));
    }
    table
}

/// Share of the kinetic energy from which on the shaft's whirl is told, and how round it has to be.
const WHIRLS: f64 = 0.01;
const ROUND: f64 = 0.1;

/// Which way the shaft goes round in a mode; nothing where it hardly moves.
fn whirl_words(mode: &LoadedMode) -> &'static str {
    match mode.whirl {
        Some(whirl) if mode.shaft_share >= WHIRLS => match whirl {
            whirl if whirl > ROUND => "forward",
            whirl if whirl < -ROUND => "backward",
            _ => "on a line",
        },
        _ => "",
    }
}

/// Expected against found.
pub(crate) fn expected_table(expected: &[ExpectedMode]) -> Table {
    let columns = [
        Column::text("What"),
        Column::number("Expected", "Hz"),
        Column::number("Found", "Hz"),
        Column::number("Difference", "%"),
        Column::number("Allowed", "%"),
        Column::text("Verdict"),
    ];
    Table::new("Expected eigenfrequencies", columns).rows(expected.iter().map(|row| {
        let verdict = Verdict::of(row.ok);
        let difference = |error: f64| Cell::text(signed_fixed(100.0 * error, 2)).value(100.0 * error);
        [
            Cell::text(&row.what),
            Cell::number(row.hz, 5),
            Cell::number_or(row.found_hz, 5, "none"),
            row.relative_error.map_or_else(|| Cell::text(""), difference).judged(verdict),
            Cell::text(format!("{:.2}", 100.0 * row.within)).value(100.0 * row.within),
            Cell::text(if row.ok { "passes" } else { "fails" }).judged(verdict),
        ]
    }))
}

/// What a reader must know to judge the numbers.
pub(crate) fn assumptions(case: &Case, setup: Option<&BearingSetup>) -> Vec<String> {
    let mut list = Vec::new();
    if let Some(setup) = setup {
        list.push(match setup.formulation {
            Formulation::Consistent => "Formulation `consistent`: ball positions are measured from the fixed bearing centre; symmetric, energy-conserving.".to_owned(),
            Formulation::Printed => "Formulation `printed`: the source's equations (3)-(16) with their misprints put right; rigid ring motion is counted twice in the outer contact. For reproduction only.".to_owned(),
        });
        let damping = (setup.contact_damping > 0.0)
            .then(|| format!("Contact damping (Hunt-Crossley) {} s/m.", significant(setup.contact_damping, 4)));
        let is_surface = |defect: &Defect| matches!(defect, Defect::Dent(dent) if dent.profile == DentProfile::Surface);
        let mut defects = case.bearing.iter().flat_map(|bearing| &bearing.defects);
        let surface = defects.clone().any(is_surface);
        let in_plane = defects.any(|defect| !is_surface(defect));
        for (holds, text) in [
            (
                true,
                "Balls follow a prescribed cage and move radially; the shaft is rigid with two displacements; everything stays in the bearing's plane.",
            ),
            (
                setup.balls_inertia == BallsInertia::QuasiStatic,
                "Balls without inertia in the transient: each stands where its contacts, weight and centrifugal load balance; loaded frequencies keep their mass.",
            ),
            (damping.is_some(), damping.as_deref().unwrap_or_default()),
            (
                in_plane,
                "Defects in the plane of the bearing: length and depth enter, the groove radius across the rolling direction stays the race's, and a ball's radius its own.",
            ),
            (
                surface,
                "Dents in the surface of a race: length, width and depth enter; a ball drops as far as it does on the rigid surface, and bears on the dent with one contact.",
            ),
            (
                !setup.waves.is_empty(),
                "Waves of the races are long beside the patch of a contact: one contact a ball, with the stiffness of the undamaged race.",
            ),
            (
                !setup.oversizes.is_empty(),
                "Balls of different size have the mass and the contact stiffness of the nominal ball.",
            ),
            (
                !setup.flats.is_empty(),
                "A ball turns about its own axis as by pure rolling, whatever the cage's slip; where a race is damaged the ball's flat is not felt.",
            ),
        ] {
            list.extend(holds.then(|| text.to_owned()));
        }
    }
    if let Some(damping) = &case.damping {
        list.push(format!("Damping of ring and housing: {}.", damping_words(damping)));
    }
    for seat in case.seats() {
        let ring = seat.ring;
        if ring.sections.len() > 1 {
            let what = if seat.label.is_empty() { String::new() } else { format!(" of bearing {}", seat.label) };
            list.push(format!(
                "Rings in one section{what}: {}, {}.",
                match ring.bond {
                    Bond::Slip => "in radial contact, free to slide",
                    Bond::Composite => "one body",
                },
                match ring.radius_rule {
                    RadiusRule::Own => "each bends on its own radius",
                    RadiusRule::CommonCentroid => "all bend on their common centroid",
                }
            ));
        }
        if ring.tie.is_some() && seat.is_first() {
            list.push("The bore follows the ring's own interpolation: a section-rigid bore, somewhat stiffer than a bore with the ring meshed into it.".to_owned());
        }
    }
    if let Some(plane) = case.meshed_housing().and_then(|housing| housing.plane) {
        list.push(format!(
            "Housing in plane {}, {} mm thick.",
            match plane.assumption {
                PlaneAssumption::Stress => "stress",
                PlaneAssumption::Strain => "strain",
            },
            significant(plane.thickness * 1e3, 4)
        ));
    }
    list
}

/// An expected frequency and what was found.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ExpectedMode {
    /// Expected, Hz.
    pub hz: f64,
    /// What it is expected to be.
    pub what: String,
    /// Nearest mode that is not the balls' own, Hz; `None`: there is none.
    pub found_hz: Option<f64>,
    /// (found - expected) / expected.
    pub relative_error: Option<f64>,
    /// Largest magnitude of it that passes.
    pub within: f64,
    /// Whether it passes.
    pub ok: bool,
}

impl ExpectedMode {
    /// An expected frequency beside the nearest one that was found, Hz.
    pub(crate) fn of(expected: &Expected, found_hz: Option<f64>) -> Self {
        let relative_error = found_hz.map(|found| found / expected.hz - 1.0);
        Self {
            hz: expected.hz,
            what: expected.what.clone(),
            found_hz,
            relative_error,
            within: expected.within,
            ok: relative_error.is_some_and(|error| error.abs() <= expected.within),
        }
    }
}

/// A report of a case with lines that are signed on paper; `command` is the line that made it.
pub(crate) fn signed_report(case: &Case, command: &str, subtitle: &str) -> Report {
    let path = case.source.path.display().to_string();
    let document = Document::new().case(path).signed_by("Prepared by").signed_by("Checked by");
    Report::new(&case.title, command, env!("CARGO_PKG_VERSION")).subtitle(subtitle).document(document)
}
