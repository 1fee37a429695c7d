//! Physical groups and how to find one by name.

use super::{ElementId, Mesh, MeshError};

/// A named part of a mesh: gmsh's physical group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PhysicalGroup {
    /// Its name; the tag in digits if gmsh gave it none.
    pub name: String,
    /// 0 points, 1 curves, 2 surfaces, 3 volumes.
    pub dimension: usize,
    /// gmsh's tag, unique within its dimension, > 0.
    pub tag: i32,
    /// Indices of its nodes, sorted, each once.
    pub nodes: Vec<usize>,
    /// Its elements, in the order of the mesh.
    pub elements: Vec<ElementId>,
}

impl Mesh {
    /// The physical group of this name; case matters.
    ///
    /// # Errors
    /// [`MeshError::UnknownGroup`] with the nearest name and all names, [`MeshError::AmbiguousGroup`] if
    /// several groups share the name, [`MeshError::EmptyGroup`] if it has no elements.
    pub fn group(&self, name: &str) -> Result<&PhysicalGroup, MeshError> {
        let found: Vec<&PhysicalGroup> = self.groups.iter().filter(|g| g.name == name).collect();
        let (path, name) = (self.source.clone(), name.to_owned());
        match found.as_slice() {
            [] => Err(MeshError::UnknownGroup {
                nearest: self.nearest_group_name(&name),
                known: self.groups.iter().map(|group| group.name.clone()).collect(),
                path,
                name,
            }),
            [group] if group.elements.is_empty() => Err(MeshError::EmptyGroup { path, name }),
            [group] => Ok(group),
            several => Err(MeshError::AmbiguousGroup {
                path,
                name,
                groups: several.iter().map(|group| [group.dimension as i32, group.tag]).collect(),
            }),
        }
    }

    /// The name with the fewest edits (Damerau-Levenshtein, case ignored) from the one given.
    fn nearest_group_name(&self, name: &str) -> Option<String> {
        let wanted = name.to_lowercase();
        self.groups
            .iter()
            .map(|group| &group.name)
            .min_by_key(|known| strsim::damerau_levenshtein(&known.to_lowercase(), &wanted))
            .cloned()
    }
}
