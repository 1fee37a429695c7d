//! The housing for CalculiX and Abaqus.

use super::{CliError, Export};
use crate::app::case::Case;
use crate::app::cli::{OutputFolder, Progress};
use crate::app::error::ComputeError;
use crate::app::scene::{description, read_mesh};
use crate::fe::modal::ModeRange;
use crate::fe::model::{Constraint, HousingModel, HousingSupport};
use crate::formats::{InpJob, write_inp};

/// Modes that are asked for where the case gives a range of frequencies.
const COUNT: usize = 20;

/// Rigid motions of a free housing, which CalculiX counts among its modes.
const RIGID: usize = 6;

/// `housing.inp`.
pub(super) fn inp(case: &Case, folder: &OutputFolder, progress: &Progress) -> Result<Export, CliError> {
    let Some(housing) = case.meshed_housing() else {
        return Err(CliError::input(
            "--to inp writes the mesh of a housing: expected [housing] with a mesh, found none",
        ));
    };
    let mesh = read_mesh(case, housing, progress).map_err(CliError::from)?;
    let description = description(case, housing)?;
    // what is wrong with parts and supports is told before anything is written
    HousingModel::new(&mesh, description.clone()).map_err(ComputeError::from)?;
    let mut comments = vec![
        format!("plummer {}, case {}", env!("CARGO_PKG_VERSION"), case.source.path.display()),
        "units: m, N, kg, s; run: ccx -i housing".to_owned(),
    ];
    comments.extend(left_out(case).into_iter().map(|sentence| format!("not in this file: {sentence}")));
    let held = |support: &HousingSupport| matches!(support.constraint, Constraint::Fixed(_));
    let modes = match case.modes.extent {
        ModeRange::Count(count) | ModeRange::AtMost(count) => count,
        ModeRange::UpToHz(_) | ModeRange::BandHz(_) => COUNT,
    };
    let job = InpJob {
        comments: &comments,
        parts: housing
            .parts
            .iter()
            .zip(&description.parts)
            .map(|(asked, part)| (part.group.as_str(), asked.material.as_str(), part.material))
            .collect(),
        plane: description.plane,
        linear: description.formulation.linear,
        held: description
            .supports
            .iter()
            .filter_map(|support| match support.constraint {
                Constraint::Fixed(axes) => Some((support.group.as_str(), axes)),
                Constraint::Spring(_) => None,
            })
            .collect(),
        modes: modes + if description.supports.iter().any(held) { 0 } else { RIGID },
    };
    progress.stage("write");
    write_inp(&folder.path.join("housing.inp"), &mesh, &job)?;
    let what = format!("mesh, sets, surfaces, materials, held nodes, {} modes; SI: ccx -i housing", job.modes);
    let summary = format!("{} nodes, {} groups: {what}", mesh.nodes.len(), mesh.groups.len());
    Ok(Export { files: vec![("housing.inp", what)], summary })
}

/// What the case has and the file has not, a sentence each.
pub(super) fn left_out(case: &Case) -> Vec<String> {
    let Some(housing) = case.meshed_housing() else { return Vec::new() };
    let springs = housing.supports.iter().any(|support| matches!(support.hold, crate::app::case::Hold::Spring(..)));
    let range = matches!(case.modes.extent, ModeRange::UpToHz(_) | ModeRange::BandHz(_));
    let found = [
        (case.has_rings(), "the ring with its bearing; its bore is free"),
        (springs, "supports by springs"),
        (!housing.masses.is_empty(), "housing.masses"),
        (!housing.links.is_empty(), "housing.links"),
        (range, "the range of frequencies of [modes]: the file asks for 20 modes"),
        (
            housing.plane.is_some(),
            "plane elements as such: CalculiX makes a layer of solids of them, whose frequencies are up to 3 % off; of first order they are far too stiff in bending",
        ),
    ];
    found.into_iter().filter(|(is, _)| *is).map(|(_, what)| what.to_owned()).collect()
}
