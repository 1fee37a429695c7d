//! Which elements a housing is made of, and which part each belongs to.

use super::ModelError;
use crate::fe::element::continuum::ContinuumKind;
use crate::fe::mesh::{ElementKind, Mesh};

/// One element of a housing; its nodes are in [`HousingElements`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HousingElement {
    /// gmsh's tag, for messages.
    pub tag: u64,
    /// Its kind.
    pub kind: ContinuumKind,
    /// Index into the model's parts.
    pub part: usize,
    first: usize,
}

/// The elements of a housing, in the order of the mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HousingElements {
    list: Vec<HousingElement>,
    connectivity: Vec<usize>,
}

impl HousingElements {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The elements one by one.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &HousingElement> {
        self.list.iter()
    }

    /// All elements.
    pub fn as_slice(&self) -> &[HousingElement] {
        &self.list
    }

    /// Node indices of an element, gmsh's order.
    pub fn nodes(&self, element: &HousingElement) -> &[usize] {
        &self.connectivity[element.first..element.first + element.kind.nodes()]
    }

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
            let Some(kind) =
                continuum_kind(block.kind).filter(|kind| kind.dimension() == dimension)
            else {
                continue;
            };
            for ((nodes, &tag), owner) in block.elements().zip(&block.tags).zip(owners) {
                match owner {
                    Some(part) => {
                        let (part, first) = (*part, found.connectivity.len());
                        found.connectivity.extend_from_slice(nodes);
                        found.list.push(HousingElement {
                            tag,
                            kind,
                            part,
                            first,
                        });
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
fn owners(
    mesh: &Mesh,
    groups: &[&str],
    dimension: usize,
    path: &str,
) -> Result<Vec<Vec<Option<usize>>>, ModelError> {
    let mut owner: Vec<Vec<Option<usize>>> = mesh
        .blocks
        .iter()
        .map(|block| vec![None; block.len()])
        .collect();
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

/// The element that computes the matrices of a mesh element, if it is a surface or a volume.
pub(crate) fn continuum_kind(kind: ElementKind) -> Option<ContinuumKind> {
    Some(match kind {
        ElementKind::Point | ElementKind::Line2 | ElementKind::Line3 => return None,
        ElementKind::Tri3 => ContinuumKind::Tri3,
        ElementKind::Tri6 => ContinuumKind::Tri6,
        ElementKind::Quad4 => ContinuumKind::Quad4,
        ElementKind::Quad8 => ContinuumKind::Quad8,
        ElementKind::Tet4 => ContinuumKind::Tet4,
        ElementKind::Tet10 => ContinuumKind::Tet10,
        ElementKind::Hex8 => ContinuumKind::Hex8,
        ElementKind::Hex20 => ContinuumKind::Hex20,
        ElementKind::Wedge6 => ContinuumKind::Wedge6,
        ElementKind::Wedge15 => ContinuumKind::Wedge15,
    })
}

/// The mesh element whose matrices an element computes.
pub(crate) fn element_kind(kind: ContinuumKind) -> ElementKind {
    match kind {
        ContinuumKind::Tri3 => ElementKind::Tri3,
        ContinuumKind::Tri6 => ElementKind::Tri6,
        ContinuumKind::Quad4 => ElementKind::Quad4,
        ContinuumKind::Quad8 => ElementKind::Quad8,
        ContinuumKind::Tet4 => ElementKind::Tet4,
        ContinuumKind::Tet10 => ElementKind::Tet10,
        ContinuumKind::Hex8 => ElementKind::Hex8,
        ContinuumKind::Hex20 => ElementKind::Hex20,
        ContinuumKind::Wedge6 => ElementKind::Wedge6,
        ContinuumKind::Wedge15 => ElementKind::Wedge15,
    }
}
