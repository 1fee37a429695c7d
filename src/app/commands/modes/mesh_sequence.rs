//! The other meshes of a case: what they are, and the modes on each.

use crate::app::case::{Case, HousingSource};
use crate::app::commands::inspect::{elements_of, size};
use crate::app::error::ComputeError;
use crate::app::scene::free_system::Bodies;
use crate::fe::mesh::{ElementKind, Mesh};
use crate::fe::modal::{FullModes, MeshLevels, ModeRange, ModeSet};
use crate::numerics::Unwatched;
use crate::report::significant;
use std::path::PathBuf;

/// Relative difference of area or volume up to which two meshes are of one body: a circle of twelve straight edges lacks
/// 4.5 % of its area.
const SAME_BODY: f64 = 0.1;

/// The same from which on it is told: frequencies differ by as much, and the usual target is a hundredth.
const DOUBTED: f64 = 0.01;

/// A mesh of a sequence.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Level {
    /// The file.
    pub mesh: PathBuf,
    /// Elements of the mesh's dimension.
    pub elements: usize,
    /// Their kinds.
    pub kinds: Vec<ElementKind>,
    /// Its area, m^2, or volume, m^3.
    pub measure: f64,
    /// Mean size `(volume / elements)^(1/3)`, in the plane `(area / elements)^(1/2)`, m.
    pub element_size: f64,
}

/// The meshes of a case, its own first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeshSequence {
    pub levels: Vec<Level>,
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
        let mut levels = vec![Level::read(case, housing.mesh.clone())?];
        let own = levels[0].measure;
        for (index, path) in asked.meshes.iter().enumerate() {
            let other = Level::read(case, path.clone()).map_err(|error| at(index, path, error))?;
            let found = other.measure;
            // also false for a size that is no number
            let same = (found - own).abs() <= SAME_BODY * own;
            if !same {
                let what = format!(
                    "expected a mesh of the same body, of area or volume {own:.4e} (m^2, m^3), found {found:.4e}"
                );
                return Err(at(index, path, ComputeError::wrong(what)));
            }
            levels.push(other);
        }
        let kinds = levels[0].kinds.iter();
        let degree = kinds.map(|kind| kind.order()).min().unwrap_or(1);
        let found = Self { formal_order: asked.order.unwrap_or(2.0 * degree as f64), levels };
        let alike: Vec<usize> = (0..found.levels.len()).filter(|&level| found.is_alike(level)).collect();
        if alike.len() > 1 {
            found.sizes(alike).check().map_err(ComputeError::Sequence)?;
        }
        Ok(Some(found))
    }

    /// Meshes whose size differs from that of the case's own by more than most curved boundaries cut off.
    pub(crate) fn doubts(&self) -> Vec<String> {
        let own = self.levels[0].measure;
        let others = self.levels.iter().enumerate().skip(1);
        let doubted = others.filter_map(|(index, level)| {
            let more = level.measure / own - 1.0;
            (more.abs() > DOUBTED).then(|| {
                format!(
                    "The body of modes.convergence.meshes[{}] ({}) is {} % {} than the case's own. Coarse meshes cut off curved faces; if that is not the cause, the meshes are of two bodies, and the estimated errors do not hold.",
                    index - 1,
                    level.mesh.display(),
                    significant(100.0 * more.abs(), 2),
                    if more > 0.0 { "larger" } else { "smaller" }
                )
            })
        });
        doubted.collect()
    }

    /// Whether a mesh has the kinds of elements that the case's own has: unlike ones have unlike errors at one size.
    pub(crate) fn is_alike(&self, level: usize) -> bool {
        self.levels[level].kinds == self.levels[0].kinds
    }

    /// Sizes of some of the meshes, as an extrapolation takes them.
    pub(crate) fn sizes(&self, levels: impl IntoIterator<Item = usize>) -> MeshLevels {
        MeshLevels {
            sizes: levels.into_iter().map(|level| self.levels[level].element_size).collect(),
            formal_order: self.formal_order,
        }
    }
}

/// An error with the mesh that it is about.
pub(crate) fn at(index: usize, path: &std::path::Path, source: ComputeError) -> ComputeError {
    ComputeError::OtherMesh { index, path: path.to_owned(), source: Box::new(source) }
}

impl Level {
    fn read(case: &Case, path: PathBuf) -> Result<Self, ComputeError> {
        let other = on_mesh(case, path);
        // a case without a housing has no sequence
        let Some(housing) = other.meshed_housing() else {
            return Ok(Self { mesh: PathBuf::new(), elements: 0, kinds: Vec::new(), measure: 0.0, element_size: 0.0 });
        };
        let mesh = Mesh::read_gmsh(&housing.mesh, housing.length_unit)?;
        let groups: Vec<String> = mesh.groups.iter().map(|group| group.name.clone()).collect();
        other.check_groups(&groups)?;
        let dimension = mesh.blocks.iter().map(|block| block.kind.dimension()).max().unwrap_or(0);
        let all = elements_of(&mesh, dimension);
        let blocks = mesh.blocks.iter().map(|block| block.kind);
        let mut kinds: Vec<ElementKind> = blocks.filter(|kind| kind.dimension() == dimension).collect();
        kinds.sort_unstable_by_key(|kind| kind.name());
        kinds.dedup();
        let elements = all.clone().count();
        let measure = size(&mesh, all);
        Ok(Self {
            mesh: housing.mesh.clone(),
            elements,
            kinds,
            measure,
            element_size: (measure / elements as f64).powf(1.0 / dimension as f64),
        })
    }

    /// Names of the kinds.
    pub(crate) fn kind_names(&self) -> String {
        let names: Vec<&str> = self.kinds.iter().map(|kind| kind.name()).collect();
        names.join(", ")
    }
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
        let level = |measure: f64| Level {
            mesh: PathBuf::from("other.msh"),
            elements: 1,
            kinds: Vec::new(),
            measure,
            element_size: 1.0,
        };
        let sequence = |other: f64| MeshSequence { levels: vec![level(2.0), level(other)], formal_order: 2.0 };
        assert!(sequence(1.99).doubts().is_empty());
        let told = sequence(2.04).doubts().join(" ");
        let expected = "The body of modes.convergence.meshes[0] (other.msh) is 2.0 % larger";
        assert!(told.starts_with(expected), "{told}");
    }
}
