//! Flat layers of incompatible elements on a held face.

use super::elements::element_kind;
use super::{HousingElement, HousingModel};
use crate::element::continuum::{ContinuumKind, LinearFormulation};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Longest edge of a held face over the height of the layer above it from which on the layer is told. A plate of steel,
/// held at one face, in elements of incompatible modes: its lowest frequency is off by +11 % at 2, +8 % at 3, -4 % at 4,
/// -23 % at 5, -52 % at 8, and -77 % at 17; plain elements stay within +12 %. Two or four layers of the same height
/// together are off as one; ten layers of flatness 5, twice as high as an edge is long, by +1 %.
const FLAT: f64 = 3.0;

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

/// A face by its sorted nodes.
type Corners = Vec<usize>;

impl HousingModel {
    /// The flat layers of incompatible elements on held faces, from there to the next face without a neighbour; `None` if
    /// there are none.
    pub fn flat_layers(&self) -> Option<FlatLayer> {
        if self.formulation.linear != LinearFormulation::Incompatible {
            return None;
        }
        let mut found: Option<FlatLayer> = None;
        let mut behind: Option<BTreeMap<Corners, [Option<usize>; 2]>> = None;
        let fixed = |node: &usize| self.fixed[*node].iter().any(Option::is_some);
        for (index, element) in self.elements.iter().enumerate() {
            if !self.elements.nodes(element).iter().any(fixed) {
                continue;
            }
            for face in self.faces(element) {
                if !self.is_held(&face) || self.flatness(element, &face) <= FLAT {
                    continue;
                }
                let behind = behind.get_or_insert_with(|| self.elements_behind_faces());
                let Some(flatness) = self.layer_flatness(index, &face, behind) else {
                    continue;
                };
                let faces = found.as_ref().map_or(1, |found| found.faces + 1);
                match &mut found {
                    Some(found) if found.flatness >= flatness => found.faces = faces,
                    _ => {
                        found = Some(FlatLayer {
                            faces,
                            tag: element.tag,
                            flatness,
                            place: self.mean(&face).into(),
                        });
                    }
                }
            }
        }
        found
    }

    /// Nodes of the faces of an element with incompatible modes, none of others.
    fn faces(&self, element: &HousingElement) -> Vec<Vec<usize>> {
        if !matches!(element.kind, ContinuumKind::Quad4 | ContinuumKind::Hex8) {
            return Vec::new();
        }
        let nodes = self.elements.nodes(element);
        let faces = element_kind(element.kind).faces().iter();
        faces
            .map(|face| face.nodes.iter().map(|&local| nodes[local]).collect())
            .collect()
    }

    fn elements_behind_faces(&self) -> BTreeMap<Corners, [Option<usize>; 2]> {
        let mut behind: BTreeMap<Corners, [Option<usize>; 2]> = BTreeMap::new();
        for (index, element) in self.elements.iter().enumerate() {
            for face in self.faces(element) {
                let slots = behind.entry(sorted(&face)).or_default();
                let free = usize::from(slots[0].is_some());
                slots[free] = Some(index);
            }
        }
        behind
    }

    /// Whether a direction along the face is fixed at all its nodes.
    fn is_held(&self, face: &[usize]) -> bool {
        let normal = self.normal(face);
        (0..self.dimension).any(|axis| {
            normal[axis].abs() < 0.9 && face.iter().all(|&node| self.fixed[node][axis].is_some())
        })
    }

    /// Longest edge of a face over the height of the layer that begins there; `None` if that is not flat.
    fn layer_flatness(
        &self,
        index: usize,
        face: &[usize],
        behind: &BTreeMap<Corners, [Option<usize>; 2]>,
    ) -> Option<f64> {
        let (mut index, mut face) = (index, face.to_vec());
        let mut sum = 0.0; // of heights over the longest edge
        for _ in 0..self.elements.len() {
            let element = &self.elements.as_slice()[index];
            sum += 1.0 / self.flatness(element, &face);
            if sum * FLAT >= 1.0 || sum.is_nan() {
                return None;
            }
            let apart = |other: &Vec<usize>| other.iter().all(|node| !face.contains(node));
            let opposite = self.faces(element).into_iter().find(apart)?;
            let next = behind.get(&sorted(&opposite))?.iter().flatten();
            match next.copied().find(|&next| next != index) {
                Some(next) => (index, face) = (next, opposite),
                None => return Some(1.0 / sum),
            }
        }
        None
    }

    /// Longest edge of a face over the least height of the element above it.
    fn flatness(&self, element: &HousingElement, face: &[usize]) -> f64 {
        let (normal, mean) = (self.normal(face), self.mean(face));
        let nodes = self.elements.nodes(element).iter();
        let others = nodes.filter(|node| !face.contains(node));
        let heights = others.map(|&node| (self.at(node) - mean).dot(&normal).abs());
        let height = heights.fold(f64::INFINITY, f64::min);
        let edges = face.iter().zip(face.iter().cycle().skip(1));
        let edges = edges.map(|(&a, &b)| (self.at(a) - self.at(b)).norm());
        edges.fold(0.0, f64::max) / height
    }

    /// Unit normal of a face by its diagonals, of an edge in the plane across it; zero without size.
    fn normal(&self, face: &[usize]) -> Vector3<f64> {
        let across = match *face {
            [a, b, c, d] => (self.at(c) - self.at(a)).cross(&(self.at(d) - self.at(b))),
            [a, b] => (self.at(b) - self.at(a)).cross(&Vector3::z()),
            _ => Vector3::zeros(),
        };
        across.try_normalize(0.0).unwrap_or_default()
    }

    fn at(&self, node: usize) -> Vector3<f64> {
        Vector3::from(self.coordinates[node])
    }

    fn mean(&self, face: &[usize]) -> Vector3<f64> {
        let sum: Vector3<f64> = face.iter().map(|&node| self.at(node)).sum();
        sum / face.len() as f64
    }
}

fn sorted(face: &[usize]) -> Corners {
    let mut corners = face.to_vec();
    corners.sort_unstable();
    corners
}
