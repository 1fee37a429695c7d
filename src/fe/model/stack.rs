//! Quad4 and Hex8 that stand on one another, through faces opposite each other.

use super::support::sorted;
use super::{HousingElement, HousingModel, overlap};
use crate::fe::mesh::ElementKind;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Indices of the one or two elements with a face, by its sorted nodes.
pub(super) type Behind = BTreeMap<Vec<usize>, [Option<usize>; 2]>;

/// An element of a stack, with two opposite faces.
pub(super) struct Storey {
    /// Index of the element.
    pub(super) index: usize,
    /// Nodes of the face through which the stack comes, in the element's order.
    pub(super) bottom: Vec<usize>,
    /// Nodes of the face through which it goes on.
    pub(super) top: Vec<usize>,
}

impl HousingModel {
    /// Nodes of the faces of an element with incompatible modes, none of others.
    pub(super) fn faces(&self, element: &HousingElement) -> Vec<Vec<usize>> {
        if !matches!(element.kind, ElementKind::Quad4 | ElementKind::Hex8) {
            return Vec::new();
        }
        let nodes = self.elements.nodes(element);
        let faces = element.kind.faces().iter();
        faces.map(|face| face.nodes.iter().map(|&local| nodes[local]).collect()).collect()
    }

    pub(super) fn elements_behind_faces(&self) -> Behind {
        let mut behind = Behind::new();
        for (index, element) in self.elements.iter().enumerate() {
            for face in self.faces(element) {
                let slots = behind.entry(sorted(&face)).or_default();
                let free = usize::from(slots[0].is_some());
                slots[free] = Some(index);
            }
        }
        behind
    }

    /// An element between its opposite faces in each natural direction; empty of other kinds.
    pub(super) fn storeys(&self, index: usize) -> Vec<Storey> {
        let element = &self.elements.list[index];
        let (faces, nodes, natural) = (self.faces(element), self.elements.nodes(element), element.kind.natural_nodes());
        let on = |direction: usize, side: f64| {
            let at =
                |node: &usize| nodes.iter().position(|own| own == node).map_or(0.0, |local| natural[local][direction]);
            faces.iter().find(|face| face.iter().all(|node| at(node) * side > 0.0)).cloned()
        };
        let storey = |direction| Some(Storey { index, bottom: on(direction, -1.0)?, top: on(direction, 1.0)? });
        (0..self.dimension).filter_map(storey).collect()
    }

    /// Elements on one another from one of them and its face on, until no element is behind a face.
    pub(super) fn stack<'a>(
        &'a self,
        index: usize,
        face: Vec<usize>,
        behind: &'a Behind,
    ) -> impl Iterator<Item = Storey> + 'a {
        let mut next = Some((index, face));
        // a closed ring has no end
        let stack = std::iter::from_fn(move || {
            let (index, face) = next.take()?;
            let faces = self.faces(&self.elements.list[index]);
            let key = sorted(&face);
            let bottom = faces.iter().find(|own| sorted(own) == key)?.clone();
            let top = faces.into_iter().find(|other| other.iter().all(|node| !bottom.contains(node)))?;
            let others = behind.get(&sorted(&top)).into_iter().flatten().flatten();
            next = others.copied().find(|&other| other != index).map(|other| (other, top.clone()));
            Some(Storey { index, bottom, top })
        });
        stack.take(self.elements.len())
    }

    /// Unit normal of a face by its diagonals, of an edge in the plane across it; zero without size.
    pub(super) fn normal(&self, face: &[usize]) -> Vector3<f64> {
        self.across(face).try_normalize(0.0).unwrap_or_default()
    }

    /// Twice the area of a face along its normal, m^2; of an edge in the plane its length, m.
    fn across(&self, face: &[usize]) -> Vector3<f64> {
        let corners: Vec<_> = face.iter().map(|&node| self.at(node)).collect();
        overlap::normal(&corners)
    }

    /// Area of a face, m^2.
    pub(super) fn area(&self, face: &[usize], element: &HousingElement) -> f64 {
        let thickness = if self.dimension == 2 { self.properties[element.part].thickness } else { 1.0 };
        self.size(face) * thickness
    }

    /// Area of a face, m^2; in the plane its length, m.
    pub(super) fn size(&self, face: &[usize]) -> f64 {
        let across = self.across(face).norm();
        if self.dimension == 2 { across } else { 0.5 * across }
    }

    pub(super) fn at(&self, node: usize) -> Vector3<f64> {
        Vector3::from(self.coordinates[node])
    }

    pub(super) fn mean(&self, face: &[usize]) -> Vector3<f64> {
        let sum: Vector3<f64> = face.iter().map(|&node| self.at(node)).sum();
        sum / face.len() as f64
    }
}
