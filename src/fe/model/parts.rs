//! Which elements a housing is made of, and which part each belongs to.
//!
//! The elements of a housing.

use super::ModelError;
use crate::fe::material::ElasticMaterial;
use crate::fe::mesh::{ElementKind, Mesh};

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
                    found.list.push(HousingElement { tag, kind: block.kind, part, across_plate: [false; 3], first });
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
        let group = mesh.body(name)?;
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

/// A group of elements and what it is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct HousingPart {
    /// The group.
    pub group: String,
    /// Its material.
    pub material: ElasticMaterial,
}

/// One element of a housing; its nodes are in [`HousingElements`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HousingElement {
    /// gmsh's tag, for messages.
    pub tag: u64,
    /// Its kind.
    pub kind: ElementKind,
    /// Index into the model's parts.
    pub part: usize,
    /// Natural directions across which it is in a plate of few elements with incompatible modes and free faces.
    pub(crate) across_plate: [bool; 3],
    pub(super) first: usize,
}

/// Elements with incompatible modes in plates that are thin beside their edges.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ThinPlates {
    /// Index of the part of the worst one.
    pub part: usize,
    /// How many there are, > 0.
    pub elements: usize,
    /// Geometric mean of the edges along the plate over its thickness, of the worst one.
    pub slenderness: f64,
    /// Angle between its edges along the plate, off a right one, rad.
    pub skew: f64,
    /// gmsh's tag of the worst one.
    pub tag: u64,
}

impl ThinPlates {
    /// How much the worst one locks.
    pub(super) fn measure(&self) -> f64 {
        self.slenderness / self.skew.cos().powi(2)
    }
}

/// The elements of a housing, in the order of the mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HousingElements {
    pub(crate) list: Vec<HousingElement>,
    pub(super) connectivity: Vec<usize>,
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

    /// Node indices of an element, gmsh's order.
    pub fn nodes(&self, element: &HousingElement) -> &[usize] {
        &self.connectivity[element.first..element.first + element.kind.nodes()]
    }
}
