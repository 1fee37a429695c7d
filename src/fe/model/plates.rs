//! Across which directions flat elements with incompatible modes are in plates and bars with free faces.
//!
//! There the bubbles move as they do in the stiffness. In a flat layer that something holds, or in a stack of many, they do so in
//! false motions alone (see [`flat`](super::flat)), which their mass makes slower still: the body's own modes then stand among
//! false ones. By full mass the second frequency of a free bar of ten layers of flatness 10 was 42 % too low (measured).

use super::HousingModel;
use super::parts::{HousingElement, ThinPlates};
use super::stack::{Behind, Storey};
use crate::fe::element::continuum::LinearFormulation;
use crate::fe::mesh::Mesh;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Edge over height up to which bubbles have the same mass everywhere.
const AS_LONG: f64 = 1.5;

/// Most elements across a plate in which bubbles have their mass.
const LAYERS: usize = 2;

/// Largest ratio of the shear moduli of the elements across a plate. A soft layer on a stiff one is held by it.
const ALIKE: f64 = 2.0;

/// Both edges of a hexahedron along a plate over its thickness from which on it is told. Bubbles bend an element along each edge;
/// bending along one that changes along the other shears it, with the square of this number. In a free steel plate of 8 x 8
/// elements, one layer, ten modes are up to 11 % too high at 6, 37 % at 12 and 98 % at 25 (measured); four layers are as bad as
/// one. Edges that are not square have it over the square of the sine between them: with these, plates of 30, 45 and 60 degrees
/// off square are up to 14, 18 and 21 % too high at 8, 8 and 16 (measured).
const THIN: f64 = 8.0;

/// What an element is between two free faces.
struct Plate {
    /// Elements from one to the other.
    layers: usize,
    /// The shorter edge of the element along them over their distance; zero in the plane.
    slenderness: f64,
    /// Angle between its edges along them, off a right one, rad.
    skew: f64,
}

impl HousingModel {
    /// Marks the directions across which there is at most one more element, and then free faces; tells thin plates.
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
        let plates = flat.par_iter().map(|&index| (index, self.plates(index, &behind, &held)));
        for (index, plates) in plates.collect::<Vec<_>>() {
            for (direction, plate) in plates.into_iter().enumerate() {
                let Some(Plate { layers, slenderness, skew }) = plate else { continue };
                self.elements.list[index].across_plate[direction] = layers <= LAYERS;
                let HousingElement { tag, part, .. } = self.elements.list[index];
                let mut told = ThinPlates { part, elements: 1, slenderness, skew, tag };
                if told.measure() > THIN {
                    if let Some(found) = self.thin_plates.take() {
                        let elements = found.elements + 1;
                        told = ThinPlates { elements, ..if found.measure() < told.measure() { told } else { found } };
                    }
                    self.thin_plates = Some(told);
                }
            }
        }
    }

    /// Plates of linear hexahedra so thin beside their edges that they lock; `None` without.
    pub(crate) fn thin_plates(&self) -> Option<&ThinPlates> {
        self.thin_plates.as_ref()
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
        let lengths: Vec<f64> = self.storeys(index).iter().map(|storey| self.across_storey(storey).norm()).collect();
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        lengths.iter().any(|length| AS_LONG * length < longest)
    }

    /// From the mean of an element's face to that of the opposite one, m.
    fn across_storey(&self, storey: &Storey) -> Vector3<f64> {
        self.mean(&storey.top) - self.mean(&storey.bottom)
    }

    /// What an element is part of in each natural direction; `None` where that is not a plate.
    fn plates(&self, index: usize, behind: &Behind, held: &[bool]) -> Vec<Option<Plate>> {
        let storeys = self.storeys(index);
        let arms: Vec<Vector3<f64>> = storeys.iter().map(|storey| self.across_storey(storey)).collect();
        let plate = |direction: usize| {
            let along: Vec<_> = (0..arms.len()).filter(|&other| other != direction).map(|other| arms[other]).collect();
            let (breadth, skew) = match along[..] {
                [a, b] => (a.norm().min(b.norm()), (a.dot(&b).abs()).atan2(a.cross(&b).norm())),
                _ => (0.0, 0.0),
            };
            let Storey { bottom, top, .. } = &storeys[direction];
            let (mut layers, mut thickness) = (1, arms[direction].norm());
            for from in [bottom, top] {
                let mut end = if from == bottom { top.clone() } else { bottom.clone() };
                for next in self.stack(index, from.clone(), behind).skip(1) {
                    let [own, other] = [index, next.index].map(|index| self.modulus(&self.elements.list[index]));
                    (layers, thickness) = (layers + 1, thickness + self.across_storey(&next).norm());
                    let few = layers <= LAYERS || breadth > THIN * thickness * skew.cos().powi(2);
                    if own.max(other) > ALIKE * own.min(other) || !few {
                        return None;
                    }
                    end = next.top;
                }
                if end.iter().all(|&node| held[node]) {
                    return None;
                }
            }
            Some(Plate { layers, slenderness: breadth / thickness, skew })
        };
        (0..storeys.len()).map(plate).collect()
    }
}
