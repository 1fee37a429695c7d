//! Elements of second order in curved walls so thin that they lock.
//!
//! Bending of a curved wall leaves its middle surface as long as it was. The displacements of a curved element cannot do so: what
//! they stretch is the sagitta of its edges over the wall's thickness. Free steel tubes of radius 73 mm show it, with one element
//! over the wall. The lowest frequencies of Hex20 are 10 % too high at 0.19, 19 % at 0.29 and 59 % at 0.58. Those of gmsh's Tet10 are
//! 41 % too high at 0.46 and 307 % at 1.9 (the largest of a mesh); below 0.2 up to 13 % (measured).

use super::HousingModel;
use super::parts::HousingElement;
use crate::fe::mesh::sorted_faces;
use rayon::prelude::*;

/// Sagitta over thickness from which on a wall is told.
const CURVED: f64 = 0.2;

/// Longest edge over height from which on an element is one of a wall, and not of a fillet or a small hole.
const SLENDER: f64 = 5.0;

/// Distance of the middle of a straight edge from that of its ends, over the longest edge.
const ROUND_OFF: f64 = 1e-9;

/// Share of a part's volume that is told. In seven parts from CAD with small holes and fillets slender curved elements are up to 8 %.
const SHARE: f64 = 0.1;

/// Curved elements of second order alone across thin walls, of one part.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CurvedWalls {
    /// Index of the part.
    pub part: usize,
    /// How many there are, > 0.
    pub elements: usize,
    /// Sagitta of an edge over the thickness, of the worst one.
    pub sagitta: f64,
    /// gmsh's tag of the worst one.
    pub tag: u64,
}

impl HousingModel {
    /// The part of which most is in curved walls that lock; `None` without.
    pub(crate) fn curved_walls(&self) -> Option<CurvedWalls> {
        let list = &self.elements.list;
        let sagittas: Vec<f64> = list.par_iter().map(|element| self.sagitta(element)).collect();
        if !sagittas.iter().any(|&sagitta| sagitta > CURVED) {
            return None;
        }
        let faces = sorted_faces(list.par_iter().map(|element| (element.kind, self.elements.nodes(element))));
        let mut outer = vec![false; self.coordinates.len()];
        for same in faces.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1) {
            let element = &list[same[0].1 as usize];
            let nodes = self.elements.nodes(element);
            element.kind.faces()[usize::from(same[0].2)].nodes.iter().for_each(|&local| outer[nodes[local]] = true);
        }
        let is_wall = |element: &HousingElement| {
            self.elements.nodes(element)[..element.kind.corners()].iter().all(|&node| outer[node])
        };
        let mut parts = vec![(0.0, 0.0, None::<CurvedWalls>); self.properties.len()];
        for (element, &sagitta) in list.iter().zip(&sagittas) {
            let (whole, walls, found) = &mut parts[element.part];
            let volume = self.volume(element);
            *whole += volume;
            if sagitta > CURVED && is_wall(element) {
                *walls += volume;
                let HousingElement { part, tag, .. } = *element;
                let found = found.get_or_insert(CurvedWalls { part, elements: 0, sagitta, tag });
                found.elements += 1;
                if sagitta > found.sagitta {
                    *found = CurvedWalls { sagitta, tag, ..*found };
                }
            }
        }
        let shares = parts.into_iter().map(|(whole, walls, found)| (walls / whole, found));
        let most = shares.filter(|(share, _)| *share > SHARE).max_by(|a, b| a.0.total_cmp(&b.0));
        most.and_then(|(_, found)| found)
    }

    /// How far the middle of an edge is from that of its ends, over the least height of a slender element; zero of others.
    fn sagitta(&self, element: &HousingElement) -> f64 {
        let (kind, nodes) = (element.kind, self.elements.nodes(element));
        let edges = kind.middle_edges().iter().zip(&nodes[kind.corners()..]);
        let [offset, longest] = edges.fold([0.0_f64; 2], |[offset, longest], (&[a, b], &middle)| {
            let [a, b, middle] = [nodes[a], nodes[b], middle].map(|node| self.at(node));
            [offset.max((middle - 0.5 * (a + b)).norm()), longest.max((b - a).norm())]
        });
        // no element that is accepted is as flat as round-off
        if offset <= ROUND_OFF * longest {
            return 0.0;
        }
        let areas = kind.faces().iter().map(|face| {
            let corners: Vec<usize> = face.nodes[..face.kind.corners()].iter().map(|&local| nodes[local]).collect();
            self.size(&corners)
        });
        // three corners in the plane, four in space: the volume is the height times a part of the base
        let of_base = match (kind.corners(), kind.dimension()) {
            (3, 2) => 2.0,
            (4 | 5, 3) => 3.0,
            _ => 1.0,
        };
        let height = of_base * self.volume(element) / areas.fold(0.0, f64::max);
        if longest > SLENDER * height { offset / height } else { 0.0 }
    }
}
