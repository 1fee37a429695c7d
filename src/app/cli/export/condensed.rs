//! The condensed housing for finite-element and multibody programs.

use super::{CliError, Export};
use crate::app::case::{Case, Interface, InterfaceModes};
use crate::app::cli::{ExportFormat, OutputFolder, Progress, word};
use crate::app::commands::condense::superelement_record;
use crate::app::error::ComputeError;
use crate::app::scene::CondensedHousing;
use crate::formats::{
    DofLabel, FormatError, MbdynReference, Op4Format, SuperelementRecord, write_dofs_csv, write_mbdyn_fem,
    write_superelement_dmig, write_superelement_op4,
};
use crate::report::mass_in_words;

/// Whether a case has a housing and something that it is condensed on, coordinates and not modes of an interface.
///
/// # Errors
/// [`CliError`] that says what the case has instead.
pub(super) fn can_condense(case: &Case, to: ExportFormat) -> Result<(), CliError> {
    let to = word(to);
    let tied = case.seats().iter().any(|seat| seat.ring.tie.is_some());
    let found = if case.superelement().is_some() {
        "a superelement, which is condensed already"
    } else if case.meshed_housing().is_none() {
        "a ring alone"
    } else if !tied && case.condense.interface == Interface::Ring {
        "a housing that nothing is attached to"
    } else if case.condense.interface_modes != InterfaceModes::None {
        return Err(CliError::input(format!(
            "--to {to} writes the displacements of an interface, by which others attach it: expected \
             condense.interface_modes = \"none\", found modes in their place"
        ))
        .with_help("--set 'condense.interface_modes=\"none\"'; superelement.npz of `plummer condense` has the modes"));
    } else {
        return Ok(());
    };
    Err(CliError::input(format!(
        "--to {to} writes a condensed housing: expected [housing] with a mesh, and ring.tie or condense.interface, found {found}"
    ))
    .with_help("--to mtx and --to npz write matrices that are not condensed"))
}

/// `superelement.op4`, `superelement_dofs.csv`.
pub(super) fn op4(case: &Case, folder: &OutputFolder, progress: &Progress) -> Result<Export, CliError> {
    let record = condensed(case, progress)?;
    write_superelement_op4(&folder.path.join("superelement.op4"), &record, Op4Format::Binary)?;
    write_dofs_csv(&folder.path.join("superelement_dofs.csv"), &record.labels())?;
    let damping = record.damping.as_ref().map(|_| "BAA");
    let structural = record.structural.as_ref().map(|_| "K4AA");
    let matrices: Vec<&str> = ["KAA", "MAA"].into_iter().chain(damping).chain(structural).collect();
    let matrices = matrices.join(", ");
    let order = record.order();
    let of_matrices =
        format!("{matrices} [{order} x {order}] of the condensed housing, interface first, SI; binary OUTPUT4");
    let of_rows = "which row is which coordinate: row from 0, mtx_row from 1".to_owned();
    Ok(Export {
        files: vec![("superelement.op4", of_matrices), ("superelement_dofs.csv", of_rows)],
        summary: format!("{}: {matrices}", counts(&record)),
    })
}

/// `superelement.bdf`.
pub(super) fn dmig(case: &Case, folder: &OutputFolder, progress: &Progress) -> Result<Export, CliError> {
    let record = condensed(case, progress)?;
    write_superelement_dmig(&folder.path.join("superelement.bdf"), &record).map_err(of_dmig)?;
    let order = record.order();
    let what = format!("grid points, scalar points and DMIG matrices [{order} x {order}] of the condensed housing, SI");
    Ok(Export { files: vec![("superelement.bdf", what.clone())], summary: format!("{}: {what}", counts(&record)) })
}

/// What Nastran's points do not hold: wrong input, unless the file failed.
fn of_dmig(error: FormatError) -> CliError {
    let is_input = !matches!(error, FormatError::File(_));
    let wrong = CliError { is_input, ..CliError::input(format!("--to dmig: {error}")) };
    if !is_input {
        return wrong;
    }
    wrong.with_help("--to op4, and superelement.npz of `plummer condense`, hold coordinates of any direction")
}

/// `superelement.fem`. A free housing's shapes are relative to the first interface node with six motions, if there is one.
pub(super) fn mbdyn(case: &Case, folder: &OutputFolder, progress: &Progress) -> Result<Export, CliError> {
    let record = condensed(case, progress)?;
    let reference = reference(&record.interface);
    let written = write_mbdyn_fem(&folder.path.join("superelement.fem"), &record, reference).map_err(of_mbdyn)?;
    let joint = match (written.mass, reference) {
        (None, _) => "held by its supports: `clamped` in MBDyn's joint".to_owned(),
        (Some(mass), MbdynReference::Node { body, node }) => format!(
            "free, {}, shapes relative to {} node {node}: `origin node` in MBDyn's joint",
            mass_in_words(mass, 5),
            body.name()
        ),
        (Some(mass), MbdynReference::Floating) => format!("free, {}, free-free shapes", mass_in_words(mass, 5)),
    };
    let what =
        format!("{} modes at {} nodes for MBDyn's modal joint, SI; {joint}", written.frequency_hz.len(), written.nodes);
    let summary = format!("{}\n{what}", counts(&record));
    Ok(Export { files: vec![("superelement.fem", what)], summary })
}

/// What cannot be written for MBDyn: wrong input, unless the file or the eigenvalue problem failed.
fn of_mbdyn(error: FormatError) -> CliError {
    let is_input = !matches!(error, FormatError::File(_) | FormatError::Eigen(_));
    let wrong = CliError { is_input, ..CliError::input(format!("--to mbdyn: {error}")) };
    match error {
        FormatError::RigidMotions { .. } => {
            wrong.with_help("MBDyn's bodies are solid: a housing that is free in space, or held by its supports")
        }
        _ => wrong,
    }
}

fn condensed(case: &Case, progress: &Progress) -> Result<SuperelementRecord, CliError> {
    // a case with nothing to condense was refused before
    let stage = CondensedHousing::build(case, progress)?.ok_or(ComputeError::NothingToCondense)?;
    progress.stage("write");
    Ok(superelement_record(case, &stage)?)
}

fn counts(record: &SuperelementRecord) -> String {
    format!("{} interface coordinates, {} modes", record.interface.len(), record.modal_hz.len())
}

/// The first node of the interface that has six coordinates.
fn reference(interface: &[DofLabel]) -> MbdynReference {
    let coordinates = |of: &DofLabel| {
        let own = |label: &&DofLabel| (label.body, label.node) == (of.body, of.node);
        interface.iter().filter(own).count()
    };
    match interface.iter().find(|label| coordinates(label) == 6) {
        Some(label) => MbdynReference::Node { body: label.body, node: label.node },
        None => MbdynReference::Floating,
    }
}
