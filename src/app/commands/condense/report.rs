//! The reports of `plummer condense`: the certificate of a superelement, and the checks of one from a file.
//!
//! What modes in the place of an interface cost, and error against size: sections of the report of `plummer condense`.

use super::compute::{CondenseResult, FullComparison, ReducedInterface};
use super::summary::hz;
use crate::app::case::{Case, Purpose};
use crate::app::commands::computed::Computed;
use crate::app::commands::parts::{self, HousingSize, signed_report};
use crate::app::error::ComputeError;
use crate::app::scene::tie_price::{BeamAndSolid, BorePrice, TiePrice};
use crate::app::scene::{Boundary, Centres, ImportedHousing};
use crate::fe::model::{CentreNode, CentreTie, Rings};
use crate::fe::reduction::{BasisSize, Bound, Check, SizeErrors};
use crate::report::{
    Abscissa, Axis, Block, Cell, Column, Curve, CurveStyle, Fact, Plot, Report, Section, Table, Verdict, significant,
};
use std::f64::consts::TAU;

impl Computed for CondenseResult {
    fn report(&self, case: &Case, command: &str) -> Result<Report, ComputeError> {
        Ok(condense_report(case, self, command))
    }
}

/// Composes the report; `command` is the line that made it.
pub(crate) fn condense_report(case: &Case, result: &CondenseResult, command: &str) -> Report {
    let (estimate, interface_dof) = (&result.estimate, result.superelement().interface_dof);
    let mut report = checks_passed(signed_report(case, command, "Certificate of a condensed housing"), &result.checks)
        .headline(
            "Largest estimated error of a frequency in the band",
            significant(estimate.largest(), 2),
            Verdict::of(estimate.converged && estimate.largest() <= case.target()),
        )
        .headline("Coordinates", format!("{interface_dof} + {}", result.stage.condensed.basis.count()), Verdict::None)
        .section(inputs(case, result))
        .section(what(result))
        .section(
            Section::new("Checks")
                .paragraph("Every limit is relative: it holds in any units and for any size. A check that fails says which property the superelement lacks.")
                .table(check_table(&result.checks)),
        )
        .section(errors(result));
    report.sections.extend(result.interface.as_ref().map(|interface| reduced_interface(result, interface)));
    report = report.section(vectors(result));
    let interface_dof = result.stage.condensed.superelement.interface_dof;
    let sizes = result.full.as_ref().and_then(|full| error_by_size(full, interface_dof, case.target()));
    report.sections.extend(sizes);
    report.sections.extend(result.tie_price.as_ref().map(tie));
    report.sections.extend(result.bore_price.as_deref().map(rigid_bores));
    report.warnings.extend_from_slice(&result.doubts);
    report
}

/// Composes the report on a superelement from a file; `command` is the line that made it.
pub(crate) fn imported_report(case: &Case, imported: &ImportedHousing, command: &str) -> Report {
    let (checks, element, record) = (&imported.checks, &imported.element, &imported.record);
    let columns = [Column::number("Mode", ""), Column::number("Frequency", "Hz")];
    let modes = (1..).zip(&record.modal_hz);
    let modes = modes.map(|(mode, &hz)| [Cell::text(mode.to_string()), Cell::number(hz, 7)]);
    let has = |given: bool| if given { "yes" } else { "no" };
    let sensors: Vec<&str> = record.sensors.iter().map(|s| s.name.as_str()).collect();
    let facts = [
        Fact::new("File", imported.path.display().to_string()),
        Fact::new("Interface coordinates", element.interface_dof.to_string()),
        Fact::new("Modes", element.modal_dof().to_string()),
        Fact::new("Weight", has(record.weight.is_some())),
        Fact::new("Viscous damping", has(record.damping.is_some())),
        Fact::new("Structural damping", has(record.structural.is_some())),
        Fact::new("Sensors", sensors.join(", ")),
    ];
    let mut report = checks_passed(signed_report(case, command, "Checks of a superelement from a file"), checks)
        .headline("Coordinates", format!("{} + {}", element.interface_dof, element.modal_dof()), Verdict::None)
        .section(
            Section::new("What the file has")
                .facts(facts)
                .table(Table::new("Modes with the interface held", columns).rows(modes)),
        )
        .section(
            Section::new("Checks")
                .paragraph("Nothing was condensed here: these are properties that the matrices of any condensed housing have. Every limit is relative.")
                .table(check_table(checks)),
        );
    report.warnings.extend_from_slice(&imported.notes);
    report
}

/// The case in words.
fn inputs(case: &Case, result: &CondenseResult) -> Section {
    let size = HousingSize::of_housing(&result.stage.housing);
    Section::new("Inputs").facts(parts::inputs(case, Purpose::Condense, Some(&size)))
}

fn checks_passed(report: Report, checks: &[Check]) -> Report {
    let passed = checks.iter().filter(|check| check.ok()).count();
    let text = format!("{passed} of {}", checks.len());
    report.headline("Checks passed", text, Verdict::of(passed == checks.len()))
}

fn of_rings(rings: &Rings) -> String {
    match rings.seats() {
        [only] => format!("the {} nodes of the ring, through its tie", only.ring.nodes()),
        several => {
            let nodes = several.iter().map(|seat| format!("{} of {}", seat.ring.nodes(), seat.label));
            format!("the nodes of the rings, through their ties: {}", nodes.collect::<Vec<_>>().join(", "))
        }
    }
}

fn of_centres(centres: &Centres) -> String {
    let node = |(group, node): &(String, CentreNode)| match node.tie {
        CentreTie::Rigid => format!("of \"{group}\", rigid"),
        CentreTie::Mean => format!("of \"{group}\", in the mean"),
    };
    let nodes: Vec<String> = centres.nodes.iter().map(node).collect();
    format!("centre nodes {}", nodes.join("; "))
}

fn what(result: &CondenseResult) -> Section {
    let stage = &result.stage;
    let element = &stage.condensed.superelement;
    let interface = match &stage.boundary {
        Boundary::Rings(bodies) => of_rings(&bodies.0),
        Boundary::Centres(centres) => of_centres(centres),
        Boundary::Both(both) => format!("{}; then {}", of_rings(&both.rings), of_centres(&both.centres)),
        Boundary::Nodes(nodes) => {
            let count = nodes.coordinates.iter().map(|at| at.0);
            let count = count.collect::<std::collections::BTreeSet<_>>().len();
            format!("{count} nodes of the mesh")
        }
    };
    let basis = &stage.condensed.basis;
    let size = match stage.choice.size {
        BasisSize::Auto(target) => format!(
            "as few as keep the estimated error below {} up to {:.0} Hz",
            significant(target, 2),
            stage.choice.band_hz
        ),
        BasisSize::Count(count) => format!("{count}, as asked"),
        BasisSize::UpTo(hz) => format!("modes up to {hz:.0} Hz, as asked"),
        BasisSize::AtMost(hz, _) => format!("modes up to {hz:.0} Hz, fewer of a large housing"),
    };
    let mut facts = vec![
        Fact::new("Interface", interface),
        Fact::new("Interface coordinates", element.interface_dof.to_string()),
        Fact::new("Interior degrees of freedom", stage.condensed.substructure.interior_dof().to_string()),
        Fact::new("Fixed-interface modes", (basis.count() - basis.residual_vectors).to_string()).note(size),
        Fact::new("Residual vectors", basis.residual_vectors.to_string())
            .note("static response of the interior to what a mode of the coupled structure lacks"),
    ];
    if let Boundary::Nodes(nodes) = &stage.boundary
        && !nodes.held.is_empty()
    {
        facts.push(
            Fact::new("Displacements left out", nodes.held.len().to_string())
                .note("of interface nodes that a support holds or a link ties"),
        );
    }
    Section::new("What was condensed").facts(facts)
}

fn check_table(checks: &[Check]) -> Table {
    let columns = [
        Column::text("Check"),
        Column::text("What"),
        Column::number("Found", ""),
        Column::text("Limit"),
        Column::text("Verdict"),
    ];
    Table::new("Certificate", columns).rows(checks.iter().map(|check| {
        let sign = match check.bound {
            Bound::AtMost => "at most",
            Bound::AtLeast => "at least",
        };
        [
            Cell::text(check.name),
            Cell::text(&check.what),
            Cell::number(check.value, 3),
            Cell::text(format!("{sign} {}", significant(check.limit, 3))),
            Cell::badge(Verdict::of(check.ok())),
        ]
    }))
}

fn errors(result: &CondenseResult) -> Section {
    let estimate = &result.estimate;
    let mut columns = vec![
        Column::number("Mode", ""),
        Column::number("Frequency, reduced", "Hz"),
        Column::number("Estimated error", ""),
    ];
    if result.full.is_some() {
        columns.extend([Column::number("Frequency, full", "Hz"), Column::number("Error", "")]);
    }
    let rows = estimate.modes.iter().enumerate().map(|(place, mode)| {
        let mut cells = vec![
            Cell::text((place + 1).to_string()),
            Cell::number(mode.frequency_hz, 7),
            Cell::number(mode.relative_error, 2),
        ];
        if let Some(full) = &result.full {
            cells.push(Cell::number(full.frequencies_hz[place], 7));
            cells.push(Cell::number_or(full.relative_errors[place], 2, "rigid"));
        }
        cells
    });
    let table = Table::new("Frequencies in the band", columns).rows(rows);
    let mut section = Section::new("Error of the reduction")
        .paragraph("The residual of each mode in the interior's equations, solved with the factor of the interior, says what the basis lacks. The modes are computed once more with these vectors; what the frequencies fall by is their error. The full model is not needed for it.");
    if estimate.out_of_band > 0 {
        section =
            section.paragraph(format!("The reduced model has {} of these modes above the band.", estimate.out_of_band));
    }
    if let Some(FullComparison { effectivity: Some([low, high]), .. }) = &result.full {
        let [low, high] = [low, high].map(|factor| significant(*factor, 3));
        section = section.paragraph(format!("Estimated / true error: {low} to {high}."));
    }
    section.table(table)
}

fn vectors(result: &CondenseResult) -> Section {
    let basis = &result.stage.condensed.basis;
    let columns = [Column::number("Vector", ""), Column::number("Frequency with the interface held", "Hz")];
    let vectors = (1..).zip(basis.values());
    let rows = vectors.map(|(vector, value)| [Cell::text(vector.to_string()), Cell::number(value.sqrt() / TAU, 7)]);
    let section = Section::new("What the interior may do");
    if basis.values().is_empty() {
        return section.paragraph("Nothing but what follows the interface: there are no vectors of the interior.");
    }
    section.table(Table::new("Vectors of the interior", columns).rows(rows).footnote(format!(
        "Below {} Hz these are the fixed-interface modes, all of them; above, combinations with the residual vectors.",
        significant(basis.complete_below.sqrt() / TAU, 6)
    )))
}

/// What section-rigid bores cost.
fn tie(price: &TiePrice) -> Section {
    let section = Section::new("The price of the tie").paragraph("The tie makes every point of the bore follow the rigid section of the ring at its angle. Here are the frequencies of housing and ring through the tie, and of the same housing with the ring as a solid in its bore.");
    let found = match price {
        TiePrice::NotComputed(reason) => {
            return section.paragraph(format!("Not computed: {reason}."));
        }
        TiePrice::Computed(found) => found,
    };
    let columns = [
        Column::number("Mode", ""),
        Column::number("Beams", "Hz"),
        Column::number("Solid", "Hz"),
        Column::number("Difference", "%"),
        Column::number("MAC", ""),
    ];
    let row = |mode: &BeamAndSolid| {
        [
            Cell::text((mode.mode + 1).to_string()),
            Cell::number(mode.beams_hz, 6),
            Cell::number_or(mode.solid_hz, 6, "none"),
            Cell::number_or(mode.relative_difference.map(|x| 100.0 * x), 3, "none"),
            Cell::number_or(mode.mac, 3, "none"),
        ]
    };
    let table =
        |caption: &str, modes: &[BeamAndSolid]| Table::new(caption, columns.clone()).rows(modes.iter().map(row));
    let mut section = section
        .paragraph(format!(
            "The solid ring: {} elements, {:.4} mm high, {:.4} mm wide, centroid radius {:.4} mm.",
            found.elements,
            1e3 * found.height_m,
            1e3 * found.width_m,
            1e3 * found.radius_m
        ))
        .table(table("Housing and ring", &found.modes))
        .table(table("The ring alone: what the beams themselves cost", &found.ring_alone));
    section.blocks.extend(found.notes.iter().cloned().map(Block::Paragraph));
    section
}

/// What rigid bores cost.
fn rigid_bores(price: &[BorePrice]) -> Section {
    let columns = [
        Column::number("Mode", ""),
        Column::number("Rigid bores", "Hz"),
        Column::number("Bores as they are", "Hz"),
        Column::number("Difference", "%"),
        Column::number("MAC", ""),
    ];
    let rows = price.iter().map(|mode| {
        [
            Cell::text((mode.mode + 1).to_string()),
            Cell::number(mode.rigid_hz, 6),
            Cell::number_or(mode.free_hz, 6, "none"),
            Cell::number_or(mode.relative_difference.map(|x| 100.0 * x), 3, "none"),
            Cell::number_or(mode.mac, 3, "none"),
        ]
    });
    Section::new("The price of rigid bores")
        .paragraph("A rigid centre node keeps the form of its bore. Here are the frequencies of the housing with its centre nodes, nothing on them and nothing condensed, and of the same housing without them.")
        .table(Table::new("Housing with rigid bores", columns).rows(rows))
}

/// Facts, the modes kept, and what each frequency rises by.
pub(crate) fn reduced_interface(result: &CondenseResult, interface: &ReducedInterface) -> Section {
    let reduction = &interface.reduction;
    let whole = result.stage.condensed.superelement.interface_dof;
    let next = match reduction.next {
        Some(value) => format!("the first one left out has {} Hz", significant(hz(value), 6)),
        None => "none is left out".to_owned(),
    };
    let percent = |share: f64| format!("{} %", significant(100.0 * share, 3));
    let facts = [
        Fact::new("Modes of the interface", reduction.kept().to_string())
            .note(format!("of {whole} coordinates; {next}")),
        Fact::new("Coordinates of the superelement", result.superelement().order().to_string())
            .note("modes of the interface first, then vectors of the interior"),
        Fact::new("Largest rise of a frequency in the band", significant(interface.largest_rise(), 2))
            .note("exact: both models are at hand; the estimated errors below have it in them"),
        Fact::new("Static flexibility of the interface lost", percent(interface.lost.mean)).note(format!(
            "mean over unit loads on single coordinates, largest {}; for information, no check",
            percent(interface.lost.largest)
        )),
    ];
    let [mode, frequency] = [Column::number("Mode", ""), Column::number("Frequency", "Hz")];
    let rises = (1..).zip(result.estimate.modes.iter().zip(&interface.rises));
    let rises = rises.map(|(number, (mode, rise))| {
        [Cell::text(number.to_string()), Cell::number(mode.frequency_hz, 7), Cell::number(*rise, 2)]
    });
    let columns = [mode.clone(), frequency.clone(), Column::number("Relative rise", "")];
    let rises = Table::new("What the reduced interface costs", columns).rows(rises);
    let modes = (1..).zip(reduction.values());
    let modes = modes.map(|(number, value)| {
        let elastic = (*value > 0.0).then(|| hz(*value));
        [Cell::text(number.to_string()), Cell::number_or(elastic, 7, "rigid")]
    });
    Section::new("The reduced interface")
        .paragraph("The coordinates of the interface are amplitudes of its characteristic constraint modes: its softest motions with what is attached, the interior following statically. Array interface_modes of superelement.npz leads back to its displacements. Static response of the interface is no longer exact: a load on few of its coordinates meets too stiff an interface. It is therefore not among the checks.")
        .facts(facts)
        .table(rises)
        .table(Table::new("Modes of the interface", [mode, frequency]).rows(modes))
}

/// Table and plot; `None` where no sizes were tried.
pub(crate) fn error_by_size(full: &FullComparison, interface_dof: usize, target: f64) -> Option<Section> {
    let sizes = &full.sizes;
    if sizes.is_empty() {
        return None;
    }
    Some(
        Section::new("Error against size")
            .paragraph(format!(
                "The largest true error of the elastic frequencies in the band, by number of coordinates. Plain: fixed-interface modes. Enhanced: residual vectors in the place of half of them. Both have the {interface_dof} coordinates of the interface beside, which are not counted. Interface reduced: characteristic constraint modes in the place of these, counted, and plain or enhanced vectors; the best of some splits (no vectors, or as many as one of the smaller sizes). Errors below 1e-10 are those of the eigenvalues themselves."
            ))
            .plot(plot(sizes, target))
            .table(table(sizes)),
    )
}

fn plot(sizes: &[SizeErrors], target: f64) -> Plot {
    let curve = |name: &str, error: &dyn Fn(&SizeErrors) -> Option<f64>| {
        let points = sizes.iter().filter_map(|row| Some((row.size as f64, error(row)?)));
        let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
        Curve::new(name, Abscissa::Points(x), y)
    };
    let ends: Vec<f64> = sizes.iter().map(|row| row.size as f64).collect();
    let limit = vec![target; ends.len()];
    Plot::new(
        "Largest error of a frequency in the band",
        Axis::new("Coordinates counted", ""),
        Axis::new("Relative error", "").log(),
    )
    .curve(curve("plain", &|row| row.plain))
    .curve(curve("enhanced", &|row| row.enhanced))
    .curve(curve("interface reduced", &|row| {
        row.reduced.map(|reduced| reduced.error)
    }))
    .curve(Curve::new("accuracy.target", Abscissa::Points(ends), limit).style(CurveStyle::Dashed))
    .caption("Where a curve is flat, further coordinates of its kind do not touch the mode that is worst. A reduction with too few coordinates to have all the frequencies has no point.")
}

fn table(sizes: &[SizeErrors]) -> Table {
    let columns = [
        Column::number("Coordinates", ""),
        Column::number("Plain", ""),
        Column::number("Enhanced", ""),
        Column::number("Interface reduced", ""),
        Column::text("Modes of the interface + fixed-interface modes + residual vectors"),
    ];
    Table::new("Largest relative error by size", columns).rows(sizes.iter().map(|row| {
        let split = row.reduced.map(|reduced| {
            format!("{} + {} + {}", reduced.interface_modes, reduced.fixed_interface_modes, reduced.residual_vectors)
        });
        [
            Cell::text(row.size.to_string()),
            Cell::number_or(row.plain, 2, "–"),
            Cell::number_or(row.enhanced, 2, "–"),
            Cell::number_or(row.reduced.map(|reduced| reduced.error), 2, "–"),
            Cell::text(split.unwrap_or_else(|| "–".to_owned())),
        ]
    }))
}
