//! How far the frequencies of the case's own mesh are from those of an infinitely fine one.

use super::mesh_sequence::{MeshSequence, at, modes_on_mesh};
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{
    Behaviour, ComparisonOptions, Convergence, ModalComparison, ModalSurvey, ModeRange, ModeSet, partners, richardson,
};
use crate::fe::model::HousingModel;
use crate::numerics::Watch;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::PathBuf;

/// Modes sought on another mesh beyond those of the case, least and as a part: their order may differ.
const MORE: [usize; 2] = [4, 4];

/// Farthest that an estimated frequency may be from that of the finest mesh, relative: beyond, the meshes are too coarse for an
/// extrapolation.
const FARTHEST: f64 = 0.5;

/// By how much the ends of a band are moved on another mesh.
const BAND_MARGIN: f64 = 0.1;

/// Distance of points that are compared, over the larger element size of both meshes: unlike meshes share few nodes,
/// and the nearest one tells which mode it is.
const NEAREST: f64 = 0.5;

/// A mesh of the sequence.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SequenceMesh {
    /// The file.
    pub mesh: PathBuf,
    /// Whether it is the case's own.
    pub own: bool,
    /// Whether it takes part in the extrapolation: it has elements of the kinds that the case's own mesh has.
    pub extrapolated: bool,
    /// Its elements.
    pub elements: usize,
    /// What they are.
    pub kinds: String,
    /// Degrees of freedom that the modes were computed over, the ring's included.
    pub free_dof: usize,
    /// Mean element size `(size / elements)^(1/d)`, m.
    pub element_size_m: f64,
    /// Points that its modes were recognised by.
    pub matched_points: usize,
}

/// One mode on all meshes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ModeOnMeshes {
    /// Index from 0 in the case's frequencies.
    pub mode: usize,
    /// Its frequency on each mesh, Hz; `None`: it was not recognised there.
    pub frequencies_hz: Vec<Option<f64>>,
    /// Limit and order; `None`: it was recognised on no other mesh of these elements.
    pub limit: Option<Convergence>,
    /// Error of the case's own mesh, (frequency - estimate) / estimate.
    pub mesh_error: Option<f64>,
    /// How far that may be off to either side; without an estimate the range of the values over the frequency.
    pub mesh_error_uncertainty: Option<f64>,
}

/// The elastic modes of a case on several meshes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MeshConvergence {
    /// Order of the frequencies' error that the elements promise, or that the case gives.
    pub formal_order: f64,
    /// The meshes, coarsest first.
    pub meshes: Vec<SequenceMesh>,
    /// The elastic modes.
    pub modes: Vec<ModeOnMeshes>,
    /// What the reader must know, a sentence each.
    pub notes: Vec<String>,
}

impl MeshConvergence {
    /// The mode with the largest estimated error of the case's own mesh.
    pub(crate) fn worst(&self) -> Option<&ModeOnMeshes> {
        let size = |mode: &&ModeOnMeshes| mode.mesh_error.map_or(-1.0, f64::abs);
        let known = self.modes.iter().filter(|mode| mode.mesh_error.is_some());
        // the first of equal ones
        known.rev().max_by(|a, b| size(a).total_cmp(&size(b)))
    }

    /// Modes whose frequencies do not approach a limit, or that no other mesh has.
    pub(crate) fn without_limit(&self) -> usize {
        let modes = self.modes.iter();
        modes.filter(|mode| mode.mesh_error.is_none()).count()
    }
}

/// Computes the modes on the other meshes and extrapolates.
///
/// # Errors
/// [`ComputeError::OtherMesh`] with the mesh that fails.
pub(crate) fn mesh_convergence(
    case: &Case,
    sequence: &MeshSequence,
    survey: &ModalSurvey,
    housing: Option<(&Mesh, &HousingModel)>,
    watch: &impl Watch,
) -> Result<Option<MeshConvergence>, ComputeError> {
    if housing.is_none() || survey.housing.is_none() {
        return Ok(None);
    }
    let own = survey.mode_set(housing);
    let own_modes = own.frequencies_hz.len();
    let mut found = vec![OnLevel {
        free_dof: survey.free_dof,
        matched_points: own.points.len(),
        frequencies_hz: own.frequencies_hz.iter().copied().map(Some).collect(),
    }];
    watch.stage("meshes");
    let extent = extent(case.modes.extent, own_modes);
    for (index, level) in sequence.levels.iter().enumerate().skip(1) {
        watch.fraction((index - 1) as f64 / (sequence.levels.len() - 1) as f64);
        let on_level = || -> Result<OnLevel, ComputeError> {
            let (modes, free_dof) = modes_on_mesh(case, level.mesh.clone(), extent)?;
            let larger = level.element_size.max(sequence.levels[0].element_size);
            recognised(&own, &modes, free_dof, NEAREST * larger)
        };
        found.push(on_level().map_err(|error| at(index - 1, &level.mesh, error))?);
    }
    let mut order: Vec<usize> = (0..found.len()).collect();
    let size = |level: &usize| sequence.levels[*level].element_size;
    order.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let elastic = survey.basis.rigid_modes..own_modes;
    let modes: Vec<ModeOnMeshes> =
        elastic.map(|mode| on_meshes(mode, sequence, &found, &order)).collect::<Result<_, _>>()?;
    let of_level = |&index: &usize| {
        let (level, on_level) = (&sequence.levels[index], &found[index]);
        SequenceMesh {
            mesh: level.mesh.clone(),
            own: index == 0,
            extrapolated: sequence.is_alike(index),
            elements: level.elements,
            kinds: level.kind_names(),
            free_dof: on_level.free_dof,
            element_size_m: level.element_size,
            matched_points: on_level.matched_points,
        }
    };
    Ok(Some(MeshConvergence {
        formal_order: sequence.formal_order,
        notes: notes(case, sequence, &modes),
        meshes: order.iter().map(of_level).collect(),
        modes,
    }))
}

/// What a mesh gave: the frequency of each of the case's modes.
struct OnLevel {
    free_dof: usize,
    matched_points: usize,
    frequencies_hz: Vec<Option<f64>>,
}

fn extent(asked: ModeRange, own_modes: usize) -> ModeRange {
    match asked {
        ModeRange::BandHz([low, high]) => ModeRange::BandHz([(1.0 - BAND_MARGIN) * low, (1.0 + BAND_MARGIN) * high]),
        // a limit in Hz would cut off modes that a coarse mesh has above it
        ModeRange::Count(_) | ModeRange::AtMost(_) | ModeRange::UpToHz(_) => {
            let [least, part] = MORE;
            ModeRange::Count(own_modes + least.max(own_modes / part))
        }
    }
}

/// Which mode of another mesh is which of the case's: by shape, and repeated ones in their order within their group.
fn recognised(own: &ModeSet, other: &ModeSet, free_dof: usize, distance: f64) -> Result<OnLevel, ComputeError> {
    let options =
        ComparisonOptions { point_tolerance: (distance / own.diagonal()).min(1.0), ..ComparisonOptions::default() };
    let found = ModalComparison::new(own, other, options)?;
    let partners = partners(own, other, &found).into_iter();
    Ok(OnLevel {
        free_dof,
        matched_points: found.points.pairs.len(),
        frequencies_hz: partners.map(|partner| partner.map(|partner| partner.hz)).collect(),
    })
}

fn on_meshes(
    mode: usize,
    sequence: &MeshSequence,
    found: &[OnLevel],
    order: &[usize],
) -> Result<ModeOnMeshes, ComputeError> {
    let on = |level: &usize| Some((*level, found[*level].frequencies_hz[mode]?));
    let alike = order.iter().filter(|level| sequence.is_alike(**level));
    let (levels, values): (Vec<usize>, Vec<f64>) = alike.filter_map(on).unzip();
    let mut limit = match levels.len() {
        0 | 1 => None,
        _ => Some(richardson(&sequence.sizes(levels), &values).map_err(ComputeError::Sequence)?),
    };
    if let Some(limit) = &mut limit {
        let far = |estimate: &f64| (limit.finest - estimate).abs() > FARTHEST * limit.finest;
        limit.estimate = limit.estimate.filter(|estimate| !far(estimate));
    }
    let own = found[0].frequencies_hz[mode];
    let estimate = limit.as_ref().and_then(|limit| limit.estimate);
    let error = own.zip(estimate).map(|(own, estimate)| (own - estimate) / estimate);
    let uncertainty = limit.as_ref().map(|limit| match limit.estimate {
        // what the interval leaves beyond the estimate: it holds for the estimate, not for the finest value
        Some(estimate) => (limit.uncertainty - (limit.finest - estimate).abs()).max(0.0) / estimate,
        None => limit.uncertainty / limit.finest,
    });
    Ok(ModeOnMeshes {
        mode,
        frequencies_hz: order.iter().map(|&level| found[level].frequencies_hz[mode]).collect(),
        limit,
        mesh_error: error,
        mesh_error_uncertainty: uncertainty,
    })
}

fn notes(case: &Case, sequence: &MeshSequence, modes: &[ModeOnMeshes]) -> Vec<String> {
    let mut notes = Vec::new();
    let alike = (0..sequence.levels.len()).filter(|&level| sequence.is_alike(level)).count();
    if alike == 2 {
        notes.push(format!(
            "Two meshes: the order of convergence is not observed but assumed to be {}; three meshes or more would show it.",
            sequence.formal_order
        ));
    }
    let own = &sequence.levels[0];
    for other in sequence.levels.iter().filter(|level| level.kinds != own.kinds) {
        notes.push(format!(
            "{} has {} where this case's mesh has {}: it is shown and not extrapolated with, since unlike elements have unlike errors.",
            other.mesh.display(),
            other.kind_names(),
            own.kind_names()
        ));
    }
    if alike == 1 {
        notes.push("No other mesh has the elements of this case's own: its error is not known.".to_owned());
    }
    let named = |of: &dyn Fn(&ModeOnMeshes) -> bool| -> Option<String> {
        let chosen = modes.iter().filter(|mode| of(mode));
        let names: Vec<String> = chosen.map(|mode| (mode.mode + 1).to_string()).collect();
        (!names.is_empty()).then(|| names.join(", "))
    };
    let behaviour_of = |mode: &ModeOnMeshes| mode.limit.as_ref().map(|limit| limit.behaviour);
    for (behaviour, what) in [
        (Behaviour::Oscillating, "go to and fro from mesh to mesh"),
        (Behaviour::Diverging, "change by steps that do not shrink"),
    ] {
        if let Some(names) = named(&|mode| behaviour_of(mode) == Some(behaviour)) {
            notes
                .push(format!("Frequencies that {what} are not extrapolated, their error is not known: mode {names}."));
        }
    }
    if let Some(names) = named(&|mode| mode.frequencies_hz.iter().any(Option::is_none)) {
        notes.push(format!("Not recognised by its shape on every mesh: mode {names}."));
    }
    if case.ring.is_some() {
        notes.push("The ring keeps its nodes on all meshes: its own discretisation is not in the error.".to_owned());
    }
    notes
}

#[cfg(test)]
mod tests;
