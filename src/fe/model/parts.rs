//! Which elements a housing is made of, and which part each belongs to.

use super::elements::{HousingElement, HousingElements};
use super::{HousingPart, ModelError};
use crate::fe::mesh::Mesh;

impl HousingElements {
    /// Takes the elements of the highest dimension and finds the part of each among the named groups.
    ///
    /// # Errors
    /// [`ModelError`] for a group of another dimension, an element in two parts or in none.
    pub(super) fn of_parts(mesh: &Mesh, parts: &[HousingPart], path: &str) -> Result<Self, ModelError> {
        let dimension = mesh.dimension().max(2);
        let owner = owners(mesh, parts, dimension, path)?;
        let mut found = Self::default();
        let mut unassigned = Vec::new();
        for id in mesh.element_ids(dimension) {
            let block = &mesh.blocks[id.block];
            let (tag, first) = (block.tags[id.index], found.connectivity.len());
            match owner[id.block][id.index] {
                Some(part) => {
                    found.connectivity.extend_from_slice(block.nodes_of(id.index));
                    found.list.push(HousingElement { tag, kind: block.kind, part, first });
                }
                None => unassigned.push(tag),
            }
        }
        if let Some(first_tag) = unassigned.first() {
            return Err(ModelError::Refused(format!(
                "{path}: {} of {} elements belong to no part (the first is element {first_tag}); add their group to [housing] parts",
                unassigned.len(),
                unassigned.len() + found.len()
            )));
        }
        Ok(found)
    }
}

/// The part of each element of each block.
fn owners(
    mesh: &Mesh,
    parts: &[HousingPart],
    dimension: usize,
    path: &str,
) -> Result<Vec<Vec<Option<usize>>>, ModelError> {
    let mut owner = mesh.for_each_element(None);
    for (part, HousingPart { group: name, .. }) in parts.iter().enumerate() {
        let group = mesh.group(name)?;
        check_dimension(path, name, group.dimension, dimension, "a part of this housing")?;
        for element in &group.elements {
            let slot = &mut owner[element.block][element.index];
            if let Some(first) = slot.filter(|&first: &usize| first != part) {
                return Err(ModelError::Refused(format!(
                    "{path}: element {} belongs to the parts \"{}\" and \"{name}\": a part of the housing has one material",
                    mesh.blocks[element.block].tags[element.index], parts[first].group
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
