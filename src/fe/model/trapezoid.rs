//! Bodies so thin that their Quad4 and Hex8 with incompatible modes lock in bending, because their sides are tilted.
//!
//! Only a parallelepiped of these elements bends as it should: MacNeal, Int. J. Numer. Methods Eng. 24 (1987) 1793. How far
//! another shape is off is computed. Its corners get the displacements `u = (n . x) E x - (x . E x) n / 2` of pure bending
//! across the normal n, E the strain of a unit stress along the layer, and their energy `u^T K u` stands over the exact
//! one, `R` times too high, by the worst of the three stresses of a layer.
//!
//! In a body of many elements across its thickness the bending is in their mean strains, which are right. So elements from
//! one free face to the opposite one make the body `1 + sum (R - 1) B_i / B` times too stiff, by the bending stiffness `B_i`
//! of each alone and B of all. Along the body deflections add: it is the harmonic mean that counts.

use super::stack::{Behind, Storey};
use super::support::sorted;
use super::{HousingElement, HousingModel};
use crate::fe::element::continuum::{LinearFormulation, measure, measure_matrix, stiffness_into};
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;

/// Factor on frequencies that is told. In beams it is right: 1.04 (found: 1.06), 1.33 (1.37), 2.04 (2.23) with sides tilted
/// by 5, 15 and 30 degrees. In plates of nodes at random places neighbours give way: 1.12 (1.03 to 1.10), 1.38 (1.09 to
/// 1.21), 2.9 (1.4 to 2.0). In curved rings of 36, 16 and 12 elements it is 1.1 (1.04), 1.6 (1.3) and 2.6 (2.0).
const TOO_HIGH: f64 = 1.25;

/// Elements belong to a body as thin as the one that locks up to this ratio of their thicknesses.
const AS_THIN: f64 = 2.0;

/// How far a corner may be off that of a parallelepiped, times the longest edge over the square of the shortest, for the
/// element to count as one. `R - 1` was below 32 times the square of that number, 0.08, in 4000 random elements of steel.
const STRAIGHT: f64 = 0.05;

/// Thin bodies of incompatible elements with tilted sides, of one part.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trapezoids {
    /// Index of the part.
    pub part: usize,
    /// Its elements that lock, > 0.
    pub elements: usize,
    /// Factor on the frequencies of bending, >= 1.25.
    pub factor: f64,
    /// gmsh's tag of the element that locks most.
    pub tag: u64,
    /// Mean of its corners, m.
    pub place: [f64; 3],
}

/// An element between two of its faces.
#[derive(Debug, Clone, Copy)]
struct Slab {
    /// Energy in bending over the exact one, >= 1.
    excess: f64,
    /// Distance between the faces, m.
    height: f64,
}

/// The thinnest body that an element is in, or the one that locks most.
#[derive(Debug, Clone, Copy)]
struct Layer {
    /// Its stiffness in bending over the exact one, >= 1.
    stiffness: f64,
    /// From its one free face to the other, m.
    thickness: f64,
}

impl HousingModel {
    /// The part whose thin bodies lock most; `None` if none does.
    pub(crate) fn trapezoids(&self) -> Option<Trapezoids> {
        if self.description.formulation.linear != LinearFormulation::Incompatible {
            return None;
        }
        let worst = |index: usize| self.storeys(index).iter().map(|own| self.slab(own).excess).fold(1.0, f64::max);
        // a body's stiffness is too high by no more than that of its worst element
        let limit = TOO_HIGH * TOO_HIGH;
        if !(0..self.elements.len()).into_par_iter().any(|index| worst(index) > limit) {
            return None;
        }
        let layers = self.layers();
        let parts = (0..self.properties.len()).filter_map(|part| self.of_part(part, &layers));
        parts.max_by(|a, b| a.factor.total_cmp(&b.factor))
    }

    /// What is found in one part.
    fn of_part(&self, part: usize, layers: &[Option<Layer>]) -> Option<Trapezoids> {
        let own = self.elements.iter().zip(layers).filter(|(element, _)| element.part == part);
        let own: Vec<_> = own.filter_map(|(element, layer)| layer.map(|layer| (element, layer))).collect();
        let locked = own.iter().filter(|(_, layer)| layer.stiffness > TOO_HIGH * TOO_HIGH);
        let (worst, _) = locked.clone().max_by(|a, b| a.1.stiffness.total_cmp(&b.1.stiffness))?;
        let volumes = locked.clone().map(|(element, layer)| (self.volume(element), layer.thickness));
        let (volume, sum) =
            volumes.fold((0.0, 0.0), |(all, sum), (volume, height)| (all + volume, sum + volume * height));
        let thin = own.iter().filter(|(_, layer)| layer.thickness * volume <= AS_THIN * sum);
        let compliances = thin.map(|(element, layer)| (self.volume(element), layer.stiffness));
        let [all, compliant] = compliances
            .fold([0.0; 2], |[all, compliant], (volume, stiffness)| [all + volume, compliant + volume / stiffness]);
        let factor = (all / compliant).sqrt();
        let nodes = self.elements.nodes(worst);
        let (tag, place) = (worst.tag, self.mean(nodes).into());
        (factor > TOO_HIGH).then(|| Trapezoids { part, elements: locked.count(), factor, tag, place })
    }

    /// The layer of each element that is between two free faces.
    fn layers(&self) -> Vec<Option<Layer>> {
        let behind = self.elements_behind_faces();
        let held = self.held_nodes();
        let free = |face: &[usize]| {
            let alone = behind.get(&sorted(face)).is_some_and(|[_, other]| other.is_none());
            alone && !face.iter().all(|&node| held[node])
        };
        let mut layers: Vec<Option<Layer>> = vec![None; self.elements.len()];
        for (index, element) in self.elements.iter().enumerate() {
            for face in self.faces(element).into_iter().filter(|face| free(face)) {
                let Some(chain) = self.column(index, face, &behind, free) else { continue };
                let layer = self.layer(&chain);
                for (at, _) in chain {
                    let worse = |old: &Layer| match layer.stiffness.total_cmp(&old.stiffness) {
                        std::cmp::Ordering::Equal => layer.thickness < old.thickness,
                        order => order.is_gt(),
                    };
                    if layers[at].as_ref().is_none_or(worse) {
                        layers[at] = Some(layer);
                    }
                }
            }
        }
        layers
    }

    /// The elements on each other from a face to the opposite one; `None` if that is not free.
    fn column(
        &self,
        index: usize,
        face: Vec<usize>,
        behind: &Behind,
        free: impl Fn(&[usize]) -> bool,
    ) -> Option<Vec<(usize, Slab)>> {
        let stack: Vec<_> = self.stack(index, face, behind).collect();
        let ends = stack.last().is_some_and(|last| free(&last.top));
        ends.then(|| stack.iter().map(|storey| (storey.index, self.slab(storey))).collect())
    }

    /// The chain as a laminate whose sections stay plane.
    fn layer(&self, chain: &[(usize, Slab)]) -> Layer {
        let mut thickness = 0.0;
        let mut plies = Vec::new();
        for (index, slab) in chain {
            let modulus = self.modulus(&self.elements.list[*index]);
            plies.push((modulus * slab.height, thickness + 0.5 * slab.height, slab));
            thickness += slab.height;
        }
        let area: f64 = plies.iter().map(|(area, ..)| area).sum();
        let axis = plies.iter().map(|(area, at, _)| area * at).sum::<f64>() / area;
        let [mut whole, mut more] = [0.0; 2];
        for (area, at, slab) in plies {
            let alone = area * slab.height * slab.height / 12.0;
            whole += alone + area * (at - axis) * (at - axis);
            more += (slab.excess - 1.0) * alone;
        }
        Layer { stiffness: 1.0 + more / whole, thickness }
    }

    /// Nodes that supports, springs or ties hold.
    pub(super) fn held_nodes(&self) -> Vec<bool> {
        let mut held: Vec<bool> = self.fixed.iter().map(|axes| axes.iter().any(Option::is_some)).collect();
        let tied = self.tied.iter().flat_map(|(node, tied)| std::iter::once(node).chain(&tied.foot.nodes));
        for &node in tied.chain(self.springs.iter().flat_map(|spring| &spring.nodes)) {
            held[node] = true;
        }
        held
    }

    /// The element between its two faces.
    fn slab(&self, storey: &Storey) -> Slab {
        let element = &self.elements.list[storey.index];
        let [below, above] = [&storey.bottom, &storey.top].map(|face| (self.mean(face), self.normal(face)));
        let normal = (below.1 - above.1).try_normalize(0.0).unwrap_or(below.1);
        let height = (above.0 - below.0).dot(&normal).abs();
        let excess = if self.is_straight(element) { None } else { self.excess(element, normal) };
        Slab { excess: excess.unwrap_or(1.0).max(1.0), height }
    }

    /// Whether the corners are nearly those of the parallelepiped at the first one.
    fn is_straight(&self, element: &HousingElement) -> bool {
        let corners: Vec<_> = self.elements.nodes(element).iter().map(|&node| self.at(node)).collect();
        let edge = |local: usize| corners.get(local).map_or_else(Vector3::zeros, |corner| corner - corners[0]);
        let [x, y, z] = [1, 3, 4].map(edge);
        let straight = [Vector3::zeros(), x, x + y, y, z, x + z, x + y + z, y + z];
        let off = corners.iter().zip(straight).map(|(corner, arm)| (corner - corners[0] - arm).norm());
        let edges = [x, y, z].map(|edge| edge.norm());
        let edges = &edges[..self.dimension];
        let [longest, shortest] =
            [edges.iter().copied().fold(0.0, f64::max), edges.iter().copied().fold(f64::INFINITY, f64::min)];
        off.fold(0.0, f64::max) * longest <= STRAIGHT * shortest * shortest
    }

    /// The energy of an element whose corners follow pure bending across a normal, over the exact one.
    fn excess(&self, element: &HousingElement, normal: Vector3<f64>) -> Option<f64> {
        let (d, kind, properties) = (self.dimension, element.kind, &self.properties[element.part]);
        let nodes = self.elements.nodes(element);
        let coordinates: Vec<[f64; 3]> = nodes.iter().map(|&node| self.coordinates[node]).collect();
        let mut stiffness = DMatrix::zeros(kind.dof(), kind.dof());
        let formulation = self.description.formulation;
        stiffness_into(kind, &coordinates, properties, formulation, stiffness.as_mut_slice()).ok()?;
        let measure = measure_matrix(kind, &coordinates).ok()?;
        let volume = measure.sum();
        let shares = measure.row_sum();
        let centre = coordinates.iter().zip(shares.iter());
        let centre = centre.map(|(&x, share)| Vector3::from(x) * *share).sum::<Vector3<f64>>() / volume;
        let arms: Vec<Vector3<f64>> = coordinates.iter().map(|&x| Vector3::from(x) - centre).collect();
        let heights = DVector::from_iterator(arms.len(), arms.iter().map(|arm| arm.dot(&normal)));
        let second_moment = properties.thickness * heights.dot(&(&measure * &heights));
        let along = if d == 2 { normal.cross(&Vector3::z()) } else { normal.cross(&arms[1]).try_normalize(0.0)? };
        let beside = normal.cross(&along);
        let stresses = [
            along * along.transpose(),
            beside * beside.transpose(),
            along * beside.transpose() + beside * along.transpose(),
        ];
        let stresses = &stresses[..if d == 2 { 1 } else { 3 }];
        let strains: Vec<_> = stresses.iter().map(|stress| properties.strain(stress)).collect::<Option<_>>()?;
        let moves = DMatrix::from_fn(kind.dof(), strains.len(), |row, load| {
            let (arm, strain) = (arms[row / d], strains[load]);
            let follows = strain * arm;
            arm.dot(&normal) * follows[row % d] - 0.5 * arm.dot(&follows) * normal[row % d]
        });
        let exact = DMatrix::from_fn(strains.len(), strains.len(), |a, b| stresses[a].dot(&strains[b]) * second_moment);
        let lower = exact.cholesky()?.l();
        let energy = moves.transpose() * stiffness * &moves;
        let half = lower.solve_lower_triangular(&energy)?;
        let relative = lower.solve_lower_triangular(&half.transpose())?;
        Some(relative.symmetric_eigenvalues().max())
    }

    /// Volume of an element, m^3; in the plane its area, m^2.
    pub(super) fn volume(&self, element: &HousingElement) -> f64 {
        let nodes = self.elements.nodes(element);
        let coordinates: Vec<[f64; 3]> = nodes.iter().map(|&node| self.coordinates[node]).collect();
        measure(element.kind, &coordinates).unwrap_or(0.0)
    }
}
