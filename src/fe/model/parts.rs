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
            return Err(ModelError::Unassigned {
                path: path.to_owned(),
                count: unassigned,
                total: unassigned + found.len(),
                tag: first_tag,
            });
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
        if group.dimension != dimension {
            return Err(ModelError::GroupDimension {
                path: path.to_owned(),
                group: name.to_owned(),
                found: dimension_name(group.dimension),
                expected: dimension_name(dimension),
                purpose: "a part of this housing",
            });
        }
        for element in &group.elements {
            let slot = &mut owner[element.block][element.index];
            if let Some(first) = slot.filter(|&first| first != part) {
                return Err(ModelError::TwoParts {
                    path: path.to_owned(),
                    tag: mesh.blocks[element.block].tags[element.index],
                    first: groups[first].to_owned(),
                    second: name.to_owned(),
                });
            }
            *slot = Some(part);
        }
    }
    Ok(owner)
}

/// What elements of a dimension are called.
pub(super) fn dimension_name(dimension: usize) -> &'static str {
    ["points", "curves", "surfaces", "volumes"][dimension.min(3)]
}
