//! Flat layers of incompatible elements on a face that something much stiffer holds.
//!
//! The bubbles of these elements let a layer bend: the corners of one face move to and fro, from corner to corner, and
//! its shear vanishes. Free layers do so in bending. A held layer cannot, but its bubbles do not know of what holds it.
//! Such a motion has the frequency `c / L` of the edge's length L, whatever the layer's height H, and true shear has one of
//! `c' / H`. So the layer is too soft from some `L / H` on, and from a larger one on springs. An element alone cannot tell
//! the two: without these bubbles a flat one locks in bending, by `1 / (1 + (L / H)^2 / 2)`.

use super::stack::{Behind, Storey};
use super::support::NodalSource;
use super::{HousingElement, HousingModel};
use crate::fe::element::continuum::{ContinuumProperties, LinearFormulation};
use nalgebra::Vector3;

/// Longest edge of a held face over the height of the layer above it from which on the layer is told. A plate of steel,
/// held at one face, in elements of incompatible modes: its lowest frequency is off by +7 % at 2 and 3, -6 % at 4,
/// -23 % at 5, -52 % at 8, and -77 % at 17; plain elements stay within +12 %. Two layers of the same height together are off
/// as one.
const FLAT: f64 = 3.0;

/// The same for layers of several elements held at both faces, with the height between these. The lowest frequency of
/// their inner nodes is off by +9 % at 1.5, -3 % at 2, -34 % at 3 and -60 % at 5.
const FLAT_BETWEEN: f64 = 2.0;

/// Shear modulus of what holds a face over that of the layer from which on the face is held. A layer on a block of cubes, held
/// below: at a ratio of 4 and a flatness up to 10 none of 14 frequencies is more than 5 % too low. At a ratio of 10 and a
/// flatness of 10 they are 6 % too low; at 100 it is 13 % at 5 and 29 % at 10.
const STIFFER: f64 = 10.0;

/// `(pi / 2)^2`: a layer of shear stiffness k an area that is held at one face moves as if it were a spring of that many k.
const OF_SHEAR: f64 = 2.47;

/// Layers of incompatible elements on held faces, so flat that their bubbles make them too soft.
#[derive(Debug, Clone, PartialEq)]
pub struct FlatLayer {
    /// Held faces that they stand on, > 0.
    pub faces: usize,
    /// gmsh's tag of the one on the flattest layer.
    pub tag: u64,
    /// Longest edge of its held face over the height of the layer.
    pub flatness: f64,
    /// Mean of the corners of that face, m.
    pub place: [f64; 3],
}

/// What may hold a node of a layer.
#[derive(Debug, Clone, Default)]
pub(super) struct Hold {
    /// The two stiffest materials of elements at it and of those that are tied to it, by the first part of each, with how each
    /// resists as a shear modulus, Pa.
    stiffest: [(f64, usize); 2],
    /// Springs along the axes, N/m, with the shear modulus of what is at their other end, Pa.
    springs: Vec<(Vector3<f64>, f64)>,
    /// Its share of the faces of incompatible elements that stand on springs, m^2.
    area: f64,
}

impl Hold {
    fn add(&mut self, (modulus, material): (f64, usize)) {
        let [first, second] = &mut self.stiffest;
        if modulus > first.0 {
            if material != first.1 {
                *second = *first;
            }
            *first = (modulus, material);
        } else if material != first.1 && modulus > second.0 {
            *second = (modulus, material);
        }
    }
}

/// A layer between faces, as its bubbles see it. All moduli are alike in an isotropic one.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Ply {
    /// Shear modulus across it, Pa.
    pub(super) shear: f64,
    /// Its resistance to being stretched along an edge, as the shear modulus of steel, Pa. False motions have no other.
    stretch: f64,
    /// Mean of its shear moduli, Pa.
    mean: f64,
    /// First part of its material.
    material: usize,
}

impl Ply {
    /// How many times as flat an isotropic layer is that its bubbles make as soft.
    fn flatter(self) -> f64 {
        (self.shear / self.stretch).sqrt()
    }
}

impl HousingModel {
    /// The flat layers of incompatible elements on held faces, from there to the next face without a neighbour or to the
    /// next held one; `None` if there are none.
    pub(crate) fn flat_layers(&self) -> Option<FlatLayer> {
        if self.description.formulation.linear != LinearFormulation::Incompatible {
            return None;
        }
        let holds = self.holds();
        let (mut faces, mut found): (_, Option<FlatLayer>) = (0, None);
        let mut behind: Option<Behind> = None;
        for (index, element) in self.elements.iter().enumerate() {
            for face in self.faces(element) {
                let [edge, height] = self.shape(element, &face);
                let ply = self.ply(element, &face);
                if self.held(&face, ply, &holds) <= 0.0 || ply.flatter() * edge <= FLAT_BETWEEN * height {
                    continue;
                }
                let behind = behind.get_or_insert_with(|| self.elements_behind_faces());
                let Some(flatness) = self.layer_flatness(index, &face, behind, &holds) else {
                    continue;
                };
                faces += 1;
                if found.as_ref().is_none_or(|found| found.flatness < flatness) {
                    found = Some(FlatLayer { faces, tag: element.tag, flatness, place: self.mean(&face).into() });
                }
            }
        }
        found.map(|found| FlatLayer { faces, ..found })
    }

    pub(super) fn modulus(&self, element: &HousingElement) -> f64 {
        self.properties[element.part].shear_modulus()
    }

    /// The first part of the same material.
    fn material(&self, part: usize) -> usize {
        let same = |other: &ContinuumProperties| *other == self.properties[part];
        self.properties.iter().position(same).unwrap_or(part)
    }

    /// An element as a layer on a face, in the direction in which its bubbles make it softest.
    pub(super) fn ply(&self, element: &HousingElement, face: &[usize]) -> Ply {
        let (normal, properties) = (self.normal(face), &self.properties[element.part]);
        let edges = face.iter().zip(face.iter().cycle().skip(1));
        let plies = edges.take(2).map(|(&from, &to)| {
            let edge = self.at(to) - self.at(from);
            let along = (edge - normal * normal.dot(&edge)).try_normalize(0.0).unwrap_or_default();
            let [shear, stretch] = properties.layer_moduli(normal, along);
            Ply { shear, stretch, mean: properties.shear_modulus(), material: self.material(element.part) }
        });
        plies.max_by(|a, b| (a.shear * b.stretch).total_cmp(&(b.shear * a.stretch))).unwrap_or_default()
    }

    pub(super) fn holds(&self) -> Vec<Hold> {
        let mut holds = vec![Hold::default(); self.coordinates.len()];
        let moduli: Vec<f64> = self.properties.iter().map(ContinuumProperties::holding_modulus).collect();
        for element in self.elements.iter() {
            let own = (moduli[element.part], self.material(element.part));
            self.elements.nodes(element).iter().for_each(|&node| holds[node].add(own));
        }
        let own: Vec<_> = holds.iter().map(|hold| hold.stiffest).collect();
        for (&node, tied) in &self.tied {
            for &other in &tied.foot.nodes {
                own[other].into_iter().for_each(|own| holds[node].add(own));
                own[node].into_iter().for_each(|own| holds[other].add(own));
            }
        }
        let d = self.dimension;
        for spring in &self.springs {
            let modulus = match spring.source {
                NodalSource::Link(_) => spring.nodes.iter().map(|&node| own[node][0].0).fold(0.0, f64::max),
                _ => f64::INFINITY,
            };
            for (row, &node) in spring.nodes.iter().enumerate() {
                let along = Vector3::from_fn(|axis, _| match axis < d {
                    true => spring.matrix[(d * row + axis, d * row + axis)],
                    false => 0.0,
                });
                holds[node].springs.push((along, modulus));
            }
        }
        for element in self.elements.iter() {
            for face in self.faces(element) {
                if face.iter().all(|&node| !holds[node].springs.is_empty()) {
                    let share = self.area(&face, element) / face.len() as f64;
                    face.iter().for_each(|&node| holds[node].area += share);
                }
            }
        }
        holds
    }

    /// Stiffness an area against motions along a face of a layer, Pa/m: infinite where supports or something much stiffer
    /// hold all its nodes, that of their springs, zero without either.
    pub(super) fn held(&self, face: &[usize], ply: Ply, holds: &[Hold]) -> f64 {
        let normal = self.normal(face);
        let of_node = |node: usize, axis: usize| {
            let hold = &holds[node];
            let is_stiff = |&(modulus, other): &(f64, usize)| other != ply.material && modulus >= STIFFER * ply.stretch;
            if self.fixed[node][axis].is_some() || hold.stiffest.iter().any(is_stiff) {
                return f64::INFINITY;
            }
            let springs = hold.springs.iter();
            let springs = springs.filter(|(_, other)| *other >= STIFFER * ply.stretch);
            let sum: f64 = springs.map(|(along, _)| along[axis]).sum();
            if sum > 0.0 { sum / hold.area } else { 0.0 }
        };
        let along = (0..self.dimension).filter(|&axis| normal[axis].abs() < 0.9);
        let least = |axis| {
            let nodes = face.iter().map(|&node| of_node(node, axis));
            nodes.fold(f64::INFINITY, f64::min)
        };
        along.map(least).fold(0.0, f64::max)
    }

    /// Longest edge of a face over the height of the layer that begins there; `None` if that is not flat.
    fn layer_flatness(&self, index: usize, face: &[usize], behind: &Behind, holds: &[Hold]) -> Option<f64> {
        let ply = self.ply(&self.elements.list[index], face);
        let held = self.held(face, ply, holds);
        // of heights over the longest edge, as isotropic layers and as they are, and of heights
        let (mut sum, mut flat, mut whole) = (0.0, 0.0, 0.0);
        let told = |limit: f64, [sum, flat, whole]: [f64; 3]| {
            let limit = limit * (1.0 + OF_SHEAR * ply.shear / (whole * held)).sqrt();
            (sum * limit < 1.0).then_some(1.0 / flat)
        };
        let goes_on = |storey: &Storey| STIFFER * self.modulus(&self.elements.list[storey.index]) > ply.mean;
        for (below, storey) in self.stack(index, face.to_vec(), behind).take_while(goes_on).enumerate() {
            let element = &self.elements.list[storey.index];
            let [edge, height] = self.shape(element, &storey.bottom);
            let more = self.ply(element, &storey.bottom).flatter();
            (sum, flat, whole) = (sum + height / (more * edge), flat + height / edge, whole + height);
            if sum * FLAT_BETWEEN >= 1.0 || sum.is_nan() {
                return None;
            }
            if self.held(&storey.top, ply, holds) >= ply.shear / whole {
                return told(FLAT_BETWEEN, [sum, flat, whole]).filter(|_| below > 0);
            }
        }
        told(FLAT, [sum, flat, whole])
    }

    /// Longest edge of a face and the least height of the element above it, m.
    fn shape(&self, element: &HousingElement, face: &[usize]) -> [f64; 2] {
        let (normal, mean) = (self.normal(face), self.mean(face));
        let nodes = self.elements.nodes(element).iter();
        let others = nodes.filter(|node| !face.contains(node));
        let heights = others.map(|&node| (self.at(node) - mean).dot(&normal).abs());
        let height = heights.fold(f64::INFINITY, f64::min);
        let edges = face.iter().zip(face.iter().cycle().skip(1));
        let edges = edges.map(|(&a, &b)| (self.at(a) - self.at(b)).norm());
        [edges.fold(0.0, f64::max), height]
    }
}
