//! How far the frequencies of the case's own mesh are from those of an infinitely fine one.
//!
//! The other meshes of a case: what they are, and the modes on each.

use crate::app::case::{Case, Housing, HousingSource};
use crate::app::commands::inspect::size;
use crate::app::error::ComputeError;
use crate::app::scene::read_mesh;
use crate::app::scene::structure::Bodies;
use crate::fe::mesh::{ElementKind, Mesh};
use crate::fe::modal::{
    Behaviour, ComparisonOptions, Convergence, FullModes, MeshLevels, ModalComparison, ModalSurvey, ModeRange, ModeSet,
    partners, richardson,
};
use crate::fe::model::HousingModel;
use crate::numerics::{Brief, Unwatched, Watch};
use crate::report::significant;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

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
    if case.has_rings() {
        notes.push("The ring keeps its nodes on all meshes: its own discretisation is not in the error.".to_owned());
    }
    notes
}

/// Relative difference of area or volume up to which two meshes are of one body: a circle of twelve straight edges lacks
/// 4.5 % of its area.
const SAME_BODY: f64 = 0.1;

/// The same from which on it is told: frequencies differ by as much, and the usual target is a hundredth.
const DOUBTED: f64 = 0.01;

/// A mesh of the sequence.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct SequenceMesh {
    /// The file.
    pub mesh: PathBuf,
    /// Whether it is the case's own.
    pub own: bool,
    /// Whether it takes part in the extrapolation: it has elements of the kinds that the case's own mesh has. Unlike ones have unlike errors
    /// at one size.
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
    /// Its area, m^2, or volume, m^3.
    #[serde(skip)]
    pub measure: f64,
    /// Frequency of each of the case's modes, Hz; `None`: it was not recognised.
    #[serde(skip)]
    pub frequencies_hz: Vec<Option<f64>>,
}

/// The meshes of a case, its own first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeshSequence {
    pub meshes: Vec<SequenceMesh>,
    /// Order of the frequencies' error.
    pub formal_order: f64,
}

impl MeshSequence {
    /// Looks at every mesh of the case, before anything is computed; `None` if the case has but its own.
    ///
    /// # Errors
    /// [`ComputeError::OtherMesh`] for one that cannot be read, lacks a group or is of another body;
    /// [`ComputeError::Sequence`] for sizes that are too near to each other.
    pub(crate) fn read(case: &Case) -> Result<Option<Self>, ComputeError> {
        let (Some(asked), Some(housing)) = (&case.modes.convergence, case.meshed_housing()) else {
            return Ok(None);
        };
        let (own, degree) = read(case, housing, &housing.mesh)?;
        let mut meshes = vec![SequenceMesh { own: true, extrapolated: true, ..own }];
        for (index, path) in asked.meshes.iter().enumerate() {
            let (other, _) = read(case, housing, path).map_err(|error| at(index, path, error))?;
            let (own, found) = (meshes[0].measure, other.measure);
            // also false for a size that is no number
            let same = (found - own).abs() <= SAME_BODY * own;
            if !same {
                let what = format!(
                    "expected a mesh of the same body, of area or volume {} (m^2, m^3), found {}",
                    Brief::rounded(own, 5),
                    Brief::rounded(found, 5)
                );
                return Err(at(index, path, ComputeError::wrong(what)));
            }
            meshes.push(SequenceMesh { extrapolated: other.kinds == meshes[0].kinds, ..other });
        }
        let found = Self { formal_order: asked.order.unwrap_or(2.0 * degree as f64), meshes };
        let alike: Vec<f64> = found.alike().map(|mesh| mesh.element_size_m).collect();
        if alike.len() > 1 {
            found.levels(alike).check().map_err(ComputeError::Sequence)?;
        }
        Ok(Some(found))
    }

    /// Meshes whose size differs from that of the case's own by more than most curved boundaries cut off.
    pub(crate) fn doubts(&self) -> Vec<String> {
        let own = self.meshes[0].measure;
        let others = self.meshes[1..].iter().enumerate();
        let doubted = others.filter_map(|(index, mesh)| {
            let more = mesh.measure / own - 1.0;
            (more.abs() > DOUBTED).then(|| {
                format!(
                    "The body of modes.convergence.meshes[{index}] ({}) is {} % {} than the case's own. Coarse meshes cut off curved faces; if that is not the cause, the meshes are of two bodies, and the estimated errors do not hold.",
                    mesh.mesh.display(),
                    significant(100.0 * more.abs(), 2),
                    if more > 0.0 { "larger" } else { "smaller" }
                )
            })
        });
        doubted.collect()
    }

    /// The meshes that the extrapolation takes.
    pub(crate) fn alike(&self) -> impl Iterator<Item = &SequenceMesh> {
        self.meshes.iter().filter(|mesh| mesh.extrapolated)
    }

    /// Element sizes, m, as an extrapolation takes them.
    pub(crate) fn levels(&self, sizes: Vec<f64>) -> MeshLevels {
        MeshLevels { sizes, formal_order: self.formal_order }
    }
}

/// An error with the mesh that it is about.
pub(crate) fn at(index: usize, path: &Path, source: ComputeError) -> ComputeError {
    ComputeError::OtherMesh { index, path: path.to_owned(), source: Box::new(source) }
}

/// A mesh in the place of a housing's, and the lowest order of its elements.
fn read(case: &Case, housing: &Housing, path: &Path) -> Result<(SequenceMesh, usize), ComputeError> {
    let other = Housing { mesh: path.to_owned(), ..housing.clone() };
    let mesh = read_mesh(&on_mesh(case, path.to_owned()), &other, &Unwatched)?;
    let dimension = mesh.blocks.iter().map(|block| block.kind.dimension()).max().unwrap_or(0);
    let kinds = || mesh.blocks.iter().map(|block| block.kind).filter(|kind| kind.dimension() == dimension);
    let names: BTreeSet<&str> = kinds().map(ElementKind::name).collect();
    let (elements, measure) = (mesh.element_ids(dimension).count(), size(&mesh, mesh.element_ids(dimension)));
    let found = SequenceMesh {
        mesh: path.to_owned(),
        elements,
        kinds: names.into_iter().collect::<Vec<_>>().join(", "),
        measure,
        element_size_m: (measure / elements as f64).powf(1.0 / dimension as f64),
        ..SequenceMesh::default()
    };
    Ok((found, kinds().map(ElementKind::order).min().unwrap_or(1)))
}

fn on_mesh(case: &Case, path: PathBuf) -> Case {
    let mut other = case.clone();
    if let Some(HousingSource::Mesh(housing)) = &mut other.housing {
        housing.mesh = path;
    }
    other
}

/// The modes of the case on `path` at the nodes, as many of them as it has, and the degrees of freedom that they were computed over;
/// nothing else is computed there.
///
/// # Errors
/// [`ComputeError`] of mesh, model and eigenvalues.
pub(crate) fn modes_on_mesh(case: &Case, path: PathBuf, extent: ModeRange) -> Result<(ModeSet, usize), ComputeError> {
    let (bodies, matrices) = Bodies::assemble(&on_mesh(case, path), &Unwatched)?;
    let extent = match extent {
        // a coarse mesh may have fewer
        ModeRange::Count(count) => ModeRange::AtMost(count),
        other => other,
    };
    let modes = FullModes::of(matrices, extent, None, &Unwatched)?;
    Ok((bodies.mode_set(&modes), modes.free_dof()))
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod mesh_sequence_tests {
    use super::*;

    /// Chords of a circle cut off 0.5 % where they are 36; a body that is 2 % longer is another one.
    #[test]
    fn bodies_of_another_size_are_told() {
        let mesh = PathBuf::from("other.msh");
        let level = |measure| SequenceMesh { mesh: mesh.clone(), elements: 1, measure, ..SequenceMesh::default() };
        let sequence = |other: f64| MeshSequence { meshes: vec![level(2.0), level(other)], formal_order: 2.0 };
        assert!(sequence(1.99).doubts().is_empty());
        let told = sequence(2.04).doubts().join(" ");
        let expected = "The body of modes.convergence.meshes[0] (other.msh) is 2.0 % larger";
        assert!(told.starts_with(expected), "{told}");
    }
}
