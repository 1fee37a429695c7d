//! Across which directions flat elements with incompatible modes are in plates and bars with free faces.
//!
//! There the bubbles move as they do in the stiffness. In a flat layer that something holds, or in a stack of many, they do so in
//! false motions alone (see [`flat`](super::flat)), which their mass makes slower still: the body's own modes then stand among
//! false ones. By full mass the second frequency of a free bar of ten layers of flatness 10 was 42 % too low (measured).

use super::HousingModel;
use super::parts::{HousingElement, ThinPlates};
use super::stack::{Behind, Storey};
use super::support::sorted;
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

/// Geometric mean of a hexahedron's edges along a plate over the thickness of the plate from which on it is told. Bubbles bend an
/// element along each edge; bending along one that changes along the other shears it, with the square of this number. Ten modes of
/// steel plates were measured, of 8 x 8 elements from 4 x 4 to 12 x 3 thicknesses. At 4, 5 and 6 free ones are up to 10, 7 and 13 %
/// too high, and held ones up to 20, 22 and 30 %, where coarse meshes err too. Free squares are 37 % too high at 12 and 98 % at
/// 25. Just below the limit, at 5.7, a held plate is 32 % too high. Four layers are as bad as one. Edges that are not square have it
/// over the square of the sine between them: plates of 30, 45 and 60 degrees are then up to 14, 18 and 21 % too high at 8, 8
/// and 16.
const THIN: f64 = 6.0;

/// Shorter edge over the thickness below which an element is one of a bar.
const BAR: f64 = 2.0;

/// A hexahedron's edges along a plate.
struct Breadth {
    /// Geometric mean of their lengths, m.
    mean: f64,
    /// Length of the shorter one, m.
    shorter: f64,
    /// Their angle off a right one, rad.
    skew: f64,
}

impl Breadth {
    /// Of the edges across one direction; `None` in the plane.
    fn of(arms: &[Vector3<f64>], direction: usize) -> Option<Self> {
        let [a, b] = match (arms, direction) {
            ([_, a, b], 0) | ([a, _, b], 1) | ([a, b, _], 2) => [a, b],
            _ => return None,
        };
        let [mean, shorter] = [(a.norm() * b.norm()).sqrt(), a.norm().min(b.norm())];
        Some(Self { mean, shorter, skew: a.dot(b).abs().atan2(a.cross(b).norm()) })
    }

    /// The largest thickness of a plate that is thin beside it, m.
    fn told_at(&self) -> f64 {
        self.mean / (THIN * self.skew.cos().powi(2))
    }
}

/// Elements on one another from one free face to another, with the direction in each across which they stand.
type Wall = Vec<(usize, usize)>;

impl HousingModel {
    /// Marks the directions across which there is at most one more element, and then free faces; tells thin plates.
    pub(super) fn find_plates(&mut self, mesh: &Mesh) {
        if self.description.formulation.linear != LinearFormulation::Incompatible {
            return;
        }
        let bubbles = |index: &usize| self.description.formulation.bubbles(self.elements.list[*index].kind);
        if !(0..self.elements.len()).filter(bubbles).any(|index| self.is_flat(index)) {
            return;
        }
        // no thicker plate is thin beside any element
        let breadths = (0..self.elements.len()).into_par_iter().flat_map_iter(|index| {
            let arms = self.arms(index);
            (0..arms.len()).filter_map(move |direction| Breadth::of(&arms, direction))
        });
        let thickest = breadths.map(|breadth| breadth.told_at()).reduce(|| 0.0, f64::max);
        let behind = self.elements_behind_faces();
        let held = self.held_or_joined(mesh);
        let fixed: Vec<bool> = self.fixed.iter().map(|axes| axes.iter().any(Option::is_some)).collect();
        let outer = behind.values().filter_map(|[first, second]| first.filter(|_| second.is_none()));
        let outer: BTreeSet<usize> = outer.collect();
        let walls: Vec<(Wall, [bool; 2])> = outer
            .into_par_iter()
            .flat_map_iter(|index| self.walls(index, &behind, thickest))
            .map(|(wall, ends)| {
                let is_free = |nodes: &[bool]| ends.iter().all(|end| !end.iter().all(|&node| nodes[node]));
                (wall, [is_free(&held), is_free(&fixed)])
            })
            .collect();
        for (wall, [is_free, may_bend]) in walls {
            let arms = wall.iter().map(|&(index, direction)| self.arms(index)[direction]);
            let thickness: f64 = arms.map(|arm| arm.norm()).sum();
            let moduli = wall.iter().map(|&(index, _)| self.modulus(&self.elements.list[index]));
            let [least, most] = moduli.fold([f64::INFINITY, 0.0], |[a, b], own| [a.min(own), b.max(own)]);
            let is_plate = is_free && wall.len() <= LAYERS && most <= ALIKE * least;
            for (index, direction) in wall {
                self.elements.list[index].across_plate[direction] = is_plate && self.is_flat(index);
                self.tell_thin(index, direction, thickness, may_bend);
            }
        }
    }

    /// Counts an element of a plate if that is thin beside its edges.
    fn tell_thin(&mut self, index: usize, direction: usize, thickness: f64, may_bend: bool) {
        let Some(Breadth { mean, shorter, skew }) = Breadth::of(&self.arms(index), direction).filter(|_| may_bend)
        else {
            return;
        };
        let HousingElement { tag, part, .. } = self.elements.list[index];
        let mut told = ThinPlates { part, elements: 1, slenderness: mean / thickness, skew, tag };
        if told.measure() < THIN || shorter < BAR * thickness {
            return;
        }
        if let Some(found) = self.thin_plates.take() {
            let elements = found.elements + 1;
            told = ThinPlates { elements, ..if found.measure() < told.measure() { told } else { found } };
        }
        self.thin_plates = Some(told);
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
        let lengths: Vec<f64> = self.arms(index).iter().map(|arm| arm.norm()).collect();
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        lengths.iter().any(|length| AS_LONG * length < longest)
    }

    /// From the mean of each face of an element to that of the opposite one, in each natural direction, m.
    fn arms(&self, index: usize) -> Vec<Vector3<f64>> {
        self.storeys(index).iter().map(|storey| self.mean(&storey.top) - self.mean(&storey.bottom)).collect()
    }

    /// The walls that end at a free face of an element, each with the nodes of both free faces; of the two ends of a wall the one
    /// of the smaller sorted nodes gives it. None are more than a few layers and thicker than `thickest`, m.
    fn walls(&self, index: usize, behind: &Behind, thickest: f64) -> Vec<(Wall, [Vec<usize>; 2])> {
        let is_free = |face: &Vec<usize>| behind.get(&sorted(face)).is_some_and(|[_, other]| other.is_none());
        let starts = self.storeys(index).into_iter().flat_map(|own| [own.bottom, own.top]).filter(|face| is_free(face));
        let mut found = Vec::new();
        for start in starts {
            let mut wall = Wall::new();
            let (mut end, mut thickness) = (start.clone(), 0.0);
            for Storey { index, bottom, top } in self.stack(index, start.clone(), behind) {
                let sides = |own: &Storey| [&own.bottom, &own.top].contains(&&bottom);
                wall.extend(self.storeys(index).iter().position(sides).map(|direction| (index, direction)));
                thickness += (self.mean(&top) - self.mean(&bottom)).norm();
                if wall.len() > LAYERS && thickness > thickest {
                    break;
                }
                end = top;
            }
            if is_free(&end) && sorted(&start) < sorted(&end) {
                found.push((wall, [start, end]));
            }
        }
        found
    }
}
