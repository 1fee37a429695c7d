//! Which elements a housing is made of, and which part each belongs to.

use super::ModelError;
use super::elements::{HousingElement, HousingElements};
use crate::fe::mesh::Mesh;

impl HousingElements {
    /// Takes the elements of the highest dimension and finds the part of each among the named groups.
    ///
    /// # Errors
    /// [`ModelError`] for a group of another dimension, an element in two parts or in none.
    pub(super) fn of_parts(mesh: &Mesh, groups: &[&str], path: &str) -> Result<Self, ModelError> {
        let dimension = highest_dimension(mesh);
        let owner = owners(mesh, groups, dimension, path)?;
        let mut found = Self::default();
        let (mut unassigned, mut first_tag) = (0, 0);
        for (block, owners) in mesh.blocks.iter().zip(&owner) {
            let kind = block.kind;
            if kind.dimension() != dimension {
                continue;
            }
            for ((nodes, &tag), owner) in block.elements().zip(&block.tags).zip(owners) {
                match owner {
                    Some(part) => {
                        let (part, first) = (*part, found.connectivity.len());
                        found.connectivity.extend_from_slice(nodes);
                        found.list.push(HousingElement { tag, kind, part, first });
                    }
                    None => {
                        first_tag = if unassigned == 0 { tag } else { first_tag };
                        unassigned += 1;
                    }
                }
            }
        }
        if unassigned > 0 {
            return Err(ModelError::Refused(format!(
                "{path}: {unassigned} of {} elements belong to no part (the first is element {first_tag}); add their group to [housing] parts",
                unassigned + found.len()
            )));
        }
        Ok(found)
    }
}

/// Highest dimension of the mesh's elements; 2 if there are neither surfaces nor volumes, so that the
/// message about missing parts speaks of surfaces.
pub(super) fn highest_dimension(mesh: &Mesh) -> usize {
    let dimensions = mesh.blocks.iter().map(|block| block.kind.dimension());
    dimensions.max().unwrap_or(0).max(2)
}

/// The part of each element of each block.
fn owners(mesh: &Mesh, groups: &[&str], dimension: usize, path: &str) -> Result<Vec<Vec<Option<usize>>>, ModelError> {
    let mut owner: Vec<Vec<Option<usize>>> = mesh.blocks.iter().map(|block| vec![None; block.len()]).collect();
    for (part, &name) in groups.iter().enumerate() {
        let group = mesh.group(name)?;
        check_dimension(path, name, group.dimension, dimension, "a part of this housing")?;
        for element in &group.elements {
            let slot = &mut owner[element.block][element.index];
            if let Some(first) = slot.filter(|&first| first != part) {
                return Err(ModelError::Refused(format!(
                    "{path}: element {} belongs to the parts \"{}\" and \"{name}\": a part of the housing has one material",
                    mesh.blocks[element.block].tags[element.index], groups[first]
                )));
            }
            *slot = Some(part);
        }
    }
    Ok(owner)
}

/// A group whose elements have the dimension that its purpose needs.
pub(super) fn check_dimension(
    path: &str,
    group: &str,
    found: usize,
    expected: usize,
    purpose: &str,
) -> Result<(), ModelError> {
    if found == expected {
        return Ok(());
    }
    let [found, expected] = [found, expected].map(|d| ["points", "curves", "surfaces", "volumes"][d.min(3)]);
    Err(ModelError::Refused(format!(
        "group \"{group}\" in {path} is made of {found}; {purpose} needs {expected}: name another group or change the physical group in gmsh"
    )))
}
