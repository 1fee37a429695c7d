//! The elements of a housing, and which element computes the matrices of which mesh element.

use crate::fe::element::continuum::{ContinuumKind, SurfaceKind};
use crate::fe::mesh::ElementKind;

/// One element of a housing; its nodes are in [`HousingElements`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HousingElement {
    /// gmsh's tag, for messages.
    pub tag: u64,
    /// Its kind.
    pub kind: ContinuumKind,
    /// Index into the model's parts.
    pub part: usize,
    pub(super) first: usize,
}

/// The elements of a housing, in the order of the mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HousingElements {
    pub(super) list: Vec<HousingElement>,
    pub(super) connectivity: Vec<usize>,
}

impl HousingElements {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The elements one by one.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &HousingElement> {
        self.list.iter()
    }

    /// All elements.
    pub(crate) fn as_slice(&self) -> &[HousingElement] {
        &self.list
    }

    /// Node indices of an element, gmsh's order.
    pub fn nodes(&self, element: &HousingElement) -> &[usize] {
        &self.connectivity[element.first..element.first + element.kind.nodes()]
    }
}

/// The element that computes the matrices of a mesh element, if it is a surface or a volume.
pub(crate) fn continuum_kind(kind: ElementKind) -> Option<ContinuumKind> {
    let mut all = ContinuumKind::ALL.into_iter();
    all.find(|&own| element_kind(own) == kind)
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

/// The curve or surface element of a mesh element; `None` for points and volumes.
pub(crate) fn surface_kind(kind: ElementKind) -> Option<SurfaceKind> {
    match kind {
        ElementKind::Line2 => Some(SurfaceKind::Line2),
        ElementKind::Line3 => Some(SurfaceKind::Line3),
        ElementKind::Tri3 => Some(SurfaceKind::Tri3),
        ElementKind::Tri6 => Some(SurfaceKind::Tri6),
        ElementKind::Quad4 => Some(SurfaceKind::Quad4),
        ElementKind::Quad8 => Some(SurfaceKind::Quad8),
        _ => None,
    }
}
