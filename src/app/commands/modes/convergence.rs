//! How far the frequencies of the case's own mesh are from those of an infinitely fine one.

use super::mesh_sequence::{MeshSequence, SequenceMesh, at, modes_on_mesh};
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
    mut sequence: MeshSequence,
    survey: &ModalSurvey,
    housing: Option<(&Mesh, &HousingModel)>,
    watch: &impl Watch,
) -> Result<Option<MeshConvergence>, ComputeError> {
    if housing.is_none() || survey.housing.is_none() {
        return Ok(None);
    }
    let own = survey.mode_set(housing);
    let own_modes = own.frequencies_hz.len();
    watch.stage("meshes");
    let extent = extent(case.modes.extent, own_modes);
    let Some((own_mesh, others)) = sequence.meshes.split_first_mut() else {
        return Ok(None);
    };
    own_mesh.free_dof = survey.free_dof;
    own_mesh.matched_points = own.points.len();
    own_mesh.frequencies_hz = own.frequencies_hz.iter().copied().map(Some).collect();
    let count = others.len();
    for (index, mesh) in others.iter_mut().enumerate() {
        watch.fraction(index as f64 / count as f64);
        let distance = NEAREST * mesh.element_size_m.max(own_mesh.element_size_m);
        recognise(case, &own, mesh, extent, distance).map_err(|error| at(index, &mesh.mesh, error))?;
    }
    let mut order: Vec<&SequenceMesh> = sequence.meshes.iter().collect();
    order.sort_by(|a, b| b.element_size_m.total_cmp(&a.element_size_m));
    let elastic = survey.basis.rigid_modes..own_modes;
    let modes: Vec<ModeOnMeshes> = elastic.map(|mode| on_meshes(mode, &sequence, &order)).collect::<Result<_, _>>()?;
    Ok(Some(MeshConvergence {
        formal_order: sequence.formal_order,
        notes: notes(case, &sequence, &modes),
        meshes: order.into_iter().cloned().collect(),
        modes,
    }))
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
fn recognise(
    case: &Case,
    own: &ModeSet,
    mesh: &mut SequenceMesh,
    extent: ModeRange,
    distance: f64,
) -> Result<(), ComputeError> {
    let (other, free_dof) = modes_on_mesh(case, mesh.mesh.clone(), extent)?;
    let options =
        ComparisonOptions { point_tolerance: (distance / own.diagonal()).min(1.0), ..ComparisonOptions::default() };
    let found = ModalComparison::new(own, &other, options)?;
    let partners = partners(own, &other, &found).into_iter();
    mesh.free_dof = free_dof;
    mesh.matched_points = found.points.pairs.len();
    mesh.frequencies_hz = partners.map(|partner| partner.map(|partner| partner.hz)).collect();
    Ok(())
}

fn on_meshes(mode: usize, sequence: &MeshSequence, order: &[&SequenceMesh]) -> Result<ModeOnMeshes, ComputeError> {
    let alike = order.iter().filter(|mesh| mesh.extrapolated);
    let (sizes, values): (Vec<f64>, Vec<f64>) =
        alike.filter_map(|mesh| Some((mesh.element_size_m, mesh.frequencies_hz[mode]?))).unzip();
    let mut limit = match sizes.len() {
        0 | 1 => None,
        _ => Some(richardson(&sequence.levels(sizes), &values).map_err(ComputeError::Sequence)?),
    };
    if let Some(limit) = &mut limit {
        let far = |estimate: &f64| (limit.finest - estimate).abs() > FARTHEST * limit.finest;
        limit.estimate = limit.estimate.filter(|estimate| !far(estimate));
    }
    let own = sequence.meshes[0].frequencies_hz[mode];
    let estimate = limit.as_ref().and_then(|limit| limit.estimate);
    let error = own.zip(estimate).map(|(own, estimate)| (own - estimate) / estimate);
    let uncertainty = limit.as_ref().map(|limit| match limit.estimate {
        // what the interval leaves beyond the estimate: it holds for the estimate, not for the finest value
        Some(estimate) => (limit.uncertainty - (limit.finest - estimate).abs()).max(0.0) / estimate,
        None => limit.uncertainty / limit.finest,
    });
    Ok(ModeOnMeshes {
        mode,
        frequencies_hz: order.iter().map(|mesh| mesh.frequencies_hz[mode]).collect(),
        limit,
        mesh_error: error,
        mesh_error_uncertainty: uncertainty,
    })
}

fn notes(case: &Case, sequence: &MeshSequence, modes: &[ModeOnMeshes]) -> Vec<String> {
    let mut notes = Vec::new();
    let alike = sequence.alike().count();
    if alike == 2 {
        notes.push(format!(
            "Two meshes: the order of convergence is not observed but assumed to be {}; three meshes or more would show it.",
            sequence.formal_order
        ));
    }
    let own = &sequence.meshes[0];
    for other in sequence.meshes.iter().filter(|mesh| !mesh.extrapolated) {
        notes.push(format!(
            "{} has {} where this case's mesh has {}: it is shown and not extrapolated with, since unlike elements have unlike errors.",
            other.mesh.display(),
            other.kinds,
            own.kinds
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
