//! The other meshes of a case: what they are, and the modes on each.

use crate::app::case::{Case, Housing, HousingSource};
use crate::app::commands::inspect::size;
use crate::app::error::ComputeError;
use crate::app::scene::free_system::Bodies;
use crate::fe::mesh::{ElementKind, Mesh};
use crate::fe::modal::{FullModes, MeshLevels, ModeRange, ModeSet};
use crate::numerics::Unwatched;
use crate::report::significant;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

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
                    "expected a mesh of the same body, of area or volume {own:.4e} (m^2, m^3), found {found:.4e}"
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
    let mesh = Mesh::read_gmsh(path, housing.length_unit)?;
    let groups: Vec<String> = mesh.groups.iter().map(|group| group.name.clone()).collect();
    on_mesh(case, path.to_owned()).check_groups(&groups)?;
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
mod tests {
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
