//! The elements of a housing.

use crate::fe::material::ElasticMaterial;
use crate::fe::mesh::ElementKind;

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
    pub(super) first: usize,
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
