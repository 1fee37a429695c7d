//! Across which directions flat elements with incompatible modes are in plates and bars with free faces.
//!
//! There the bubbles move as they do in the stiffness. In a flat layer that something holds, or in a stack of many, they do so in
//! false motions alone (see [`flat`](super::flat)), which their mass makes slower still: the body's own modes then stand among
//! false ones. By full mass the second frequency of a free bar of ten layers of flatness 10 was 42 % too low (measured).

use super::HousingModel;
use super::flat::Behind;
use super::parts::{HousingElement, ThinPlates};
use super::support::sorted;
use crate::fe::element::continuum::LinearFormulation;
use crate::fe::mesh::Mesh;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Edge over height up to which bubbles have the same mass everywhere.
const AS_LONG: f64 = 1.5;

/// Most elements across a plate.
const LAYERS: usize = 2;

/// Largest ratio of the shear moduli of the elements across a plate. A soft layer on a stiff one is held by it.
const ALIKE: f64 = 2.0;

/// Both edges of a hexahedron along a plate over its thickness from which on it is told. Bubbles bend an element along each edge;
/// bending along one that changes along the other shears it, with the square of this number. In a free steel plate of 8 x 8
/// elements, one layer, ten modes are up to 11 % too high at 6, 37 % at 12 and 98 % at 25 (measured).
const THIN: f64 = 8.0;

impl HousingModel {
    /// Marks the directions across which there is at most one more element, and then free faces.
    pub(super) fn find_plates(&mut self, mesh: &Mesh) {
        if self.description.formulation.linear != LinearFormulation::Incompatible {
            return;
        }
        let bubbles = |index: &usize| self.description.formulation.bubbles(self.elements.list[*index].kind);
        let flat: Vec<usize> = (0..self.elements.len()).filter(bubbles).filter(|&index| self.is_flat(index)).collect();
        if flat.is_empty() {
            return;
        }
        let behind = self.elements_behind_faces();
        let held = self.held_or_joined(mesh);
        let thicknesses: Vec<[Option<f64>; 3]> =
            flat.par_iter().map(|&index| self.thicknesses(index, &behind, &held)).collect();
        for (index, thicknesses) in flat.into_iter().zip(thicknesses) {
            self.elements.list[index].across_plate = thicknesses.map(|thickness| thickness.is_some());
            let thinnest = thicknesses.into_iter().flatten().fold(f64::INFINITY, f64::min);
            let slenderness = self.breadth(index) / thinnest;
            if slenderness > THIN {
                let HousingElement { tag, part, .. } = self.elements.list[index];
                let found = self.thin_plates.get_or_insert(ThinPlates { part, elements: 0, slenderness: 0.0, tag });
                found.elements += 1;
                if slenderness > found.slenderness {
                    *found = ThinPlates { part, elements: found.elements, slenderness, tag };
                }
            }
        }
    }

    /// Plates of linear hexahedra so thin beside their edges that they lock; `None` without.
    pub(crate) fn thin_plates(&self) -> Option<&ThinPlates> {
        self.thin_plates.as_ref()
    }

    /// The shorter one of the two long sides of a hexahedron, m; zero in the plane.
    fn breadth(&self, index: usize) -> f64 {
        let mut lengths = self.sides(index).map(|(.., length)| length);
        lengths.sort_by(f64::total_cmp);
        if self.dimension == 3 { lengths[1] } else { 0.0 }
    }

    /// Nodes that supports, springs, ties or what is attached hold, and those that elements of other kinds share.
    fn held_or_joined(&self, mesh: &Mesh) -> Vec<bool> {
        let mut held = self.held_nodes();
        for element in self.elements.iter().filter(|element| !self.description.formulation.bubbles(element.kind)) {
            self.elements.nodes(element).iter().for_each(|&node| held[node] = true);
        }
        let groups = self.description.attached.iter().filter_map(|name| mesh.group(name).ok());
        groups.flat_map(|group| &group.nodes).for_each(|&node| held[node] = true);
        let tags: BTreeSet<u64> = self.description.attached_nodes.iter().copied().collect();
        for (held, _) in held.iter_mut().zip(&self.node_tags).filter(|(_, tag)| tags.contains(tag)) {
            *held = true;
        }
        held
    }

    fn is_flat(&self, index: usize) -> bool {
        let lengths = self.sides(index).map(|(.., length)| length);
        let lengths = &lengths[..self.dimension];
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        lengths.iter().any(|length| AS_LONG * length < longest)
    }

    /// The opposite faces in each natural direction, with the distance of their means, m; empty ones beyond the dimension.
    fn sides(&self, index: usize) -> [(Vec<usize>, Vec<usize>, f64); 3] {
        let element = &self.elements.list[index];
        let (nodes, natural) = (self.elements.nodes(element), element.kind.natural_nodes());
        std::array::from_fn(|direction| {
            if direction >= self.dimension {
                return (Vec::new(), Vec::new(), 0.0);
            }
            let [low, high] = [-1.0, 1.0].map(|side| {
                let on = nodes.iter().zip(natural).filter(|(_, at)| at[direction] * side > 0.0);
                on.map(|(&node, _)| node).collect::<Vec<_>>()
            });
            let length = (self.mean(&low) - self.mean(&high)).norm();
            (low, high, length)
        })
    }

    /// From one free face to the opposite one in each natural direction, m; `None` where that is not a plate.
    fn thicknesses(&self, index: usize, behind: &Behind, held: &[bool]) -> [Option<f64>; 3] {
        self.sides(index).map(|(low, high, length)| {
            let (mut height, mut layers) = (length, 1);
            let free = !low.is_empty()
                && [low, high].into_iter().all(|face| self.ends(index, face, &mut height, &mut layers, behind, held));
            free.then_some(height)
        })
    }

    /// Whether the elements behind a face end at a free one, of which there may be few; adds them and their height, m.
    fn ends(
        &self,
        mut index: usize,
        mut face: Vec<usize>,
        height: &mut f64,
        layers: &mut usize,
        behind: &Behind,
        held: &[bool],
    ) -> bool {
        let modulus = self.modulus(&self.elements.list[index]);
        while *layers <= LAYERS {
            let next = behind.get(&sorted(&face)).into_iter().flatten().flatten().find(|&&next| next != index);
            let Some(&next) = next else {
                return !face.iter().all(|&node| held[node]);
            };
            let ratio = self.modulus(&self.elements.list[next]) / modulus;
            let side = self.sides(next).into_iter().find_map(|(low, high, length)| {
                if sorted(&low) == sorted(&face) {
                    Some((high, length))
                } else {
                    (sorted(&high) == sorted(&face)).then_some((low, length))
                }
            });
            let Some((opposite, length)) = side.filter(|_| ratio.max(1.0 / ratio) <= ALIKE) else {
                return false;
            };
            *height += length;
            *layers += 1;
            (index, face) = (next, opposite);
        }
        false
    }
}
