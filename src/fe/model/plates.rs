//! Which flat elements with incompatible modes are in plates and bars with free faces.
//!
//! There the bubbles move as they do in the stiffness. In a flat layer that something holds they do so in false motions alone
//! (see [`flat`](super::flat)), which their mass makes slower still: the body's own modes then stand among false ones.
//! On a block of 4 times the shear modulus a layer of flatness 10 had frequencies up to 42 % too low, by full mass (measured).

use super::HousingModel;
use super::flat::Behind;
use super::support::sorted;
use crate::fe::element::continuum::LinearFormulation;
use crate::fe::mesh::Mesh;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Ratio of the sides of an element up to which its bubbles have the same mass everywhere.
const AS_LONG: f64 = 1.5;

/// Largest ratio of the shear moduli of the elements across a plate. A soft layer on a stiff one is held by it.
const ALIKE: f64 = 2.0;

/// Part of the longest side by which elements may be higher together: coordinates come with seven digits and more.
const ROUNDING: f64 = 1e-6;

impl HousingModel {
    /// Marks the elements across which there are few others and then free faces, in all directions in which they are flat.
    pub(super) fn find_plates(&mut self, mesh: &Mesh) {
        if self.description.formulation.linear != LinearFormulation::Incompatible {
            return;
        }
        let bubbles = |index: &usize| self.description.formulation.bubbles(self.elements.list[*index].kind);
        let sides = |index: usize| Some((index, self.longest_side(index)?));
        let flat: Vec<(usize, f64)> = (0..self.elements.len()).filter(bubbles).filter_map(sides).collect();
        if flat.is_empty() {
            return;
        }
        let behind = self.elements_behind_faces();
        let held = self.held_or_joined(mesh);
        let in_plate = flat.par_iter().map(|&(index, longest)| self.in_plate(index, longest, &behind, &held));
        let in_plate: Vec<bool> = in_plate.collect();
        for ((index, _), in_plate) in flat.into_iter().zip(in_plate) {
            self.elements.list[index].in_plate = in_plate;
        }
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

    /// The longest side of an element that is flat; `None` for others.
    fn longest_side(&self, index: usize) -> Option<f64> {
        let sides = self.sides(index);
        let lengths = || sides.iter().map(|(.., length)| *length);
        let longest = lengths().fold(0.0, f64::max);
        lengths().any(|length| AS_LONG * length < longest).then_some(longest)
    }

    /// Pairs of opposite faces, with the distance of their means, m.
    fn sides(&self, index: usize) -> Vec<(Vec<usize>, Vec<usize>, f64)> {
        let mut faces = self.faces(&self.elements.list[index]);
        let mut pairs = Vec::with_capacity(3);
        while let Some(face) = faces.pop() {
            let opposite = faces.iter().position(|other| other.iter().all(|node| !face.contains(node)));
            if let Some(opposite) = opposite {
                let other = faces.swap_remove(opposite);
                let length = (self.mean(&face) - self.mean(&other)).norm();
                pairs.push((face, other, length));
            }
        }
        pairs
    }

    fn in_plate(&self, index: usize, longest: f64, behind: &Behind, held: &[bool]) -> bool {
        self.sides(index).into_iter().filter(|(.., length)| AS_LONG * length < longest).all(|(face, other, length)| {
            let mut left = (1.0 + ROUNDING) * longest - length;
            [face, other].into_iter().all(|face| self.ends(index, face, &mut left, behind, held))
        })
    }

    /// Whether the elements behind a face end at a free one before they are higher than `left`, m, of which they take their share.
    fn ends(&self, mut index: usize, mut face: Vec<usize>, left: &mut f64, behind: &Behind, held: &[bool]) -> bool {
        let modulus = self.modulus(&self.elements.list[index]);
        while *left >= 0.0 {
            let next = behind.get(&sorted(&face)).into_iter().flatten().flatten().find(|&&next| next != index);
            let Some(&next) = next else {
                return !face.iter().all(|&node| held[node]);
            };
            let ratio = self.modulus(&self.elements.list[next]) / modulus;
            let side = self.sides(next).into_iter().find_map(|(a, b, length)| {
                let is_face = |other: &Vec<usize>| sorted(other) == sorted(&face);
                if is_face(&a) { Some((b, length)) } else { is_face(&b).then_some((a, length)) }
            });
            let Some((opposite, length)) = side.filter(|_| ratio.max(1.0 / ratio) <= ALIKE) else {
                return false;
            };
            *left -= length;
            (index, face) = (next, opposite);
        }
        false
    }
}
