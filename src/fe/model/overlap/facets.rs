//! The faces that bound the bodies, as flat facets.

use super::bodies::Bodies;
use super::outline::{centre, corners_of, normal};
use crate::fe::mesh::{Sets, sorted_faces};
use nalgebra::Vector3;
use rayon::prelude::*;

/// Largest angle between two facets of one smooth surface, as a cosine (60 degrees); beyond it is an edge of the body.
const SMOOTH: f64 = 0.5;

/// A face of one element and of no other, by its corners; an edge in the plane.
#[derive(Debug)]
pub(super) struct Facet {
    /// Index of its element.
    pub solid: usize,
    /// Corners in order round it.
    pub corners: Vec<usize>,
    /// Mean of the corners, m.
    pub centre: Vector3<f64>,
    /// Unit normal that leads out of the body.
    pub normal: Vector3<f64>,
    /// Area (m^2), or length (m) in the plane.
    pub size: f64,
    /// Which of the bodies that hang together through whole faces it belongs to.
    pub body: usize,
    /// How far the surface that it stands for may be away from it, m: the sagitta of an arc over it, by its middle nodes
    /// or its neighbours; zero where all lie in its plane.
    pub reach: f64,
}

impl Bodies<'_> {
    /// The facets of all bodies, in the order of the elements.
    pub(super) fn facets(&self) -> Vec<Facet> {
        let (outer, body) = self.outer_faces();
        let facets = outer.into_iter().filter_map(|(solid, number)| self.facet(solid, number, body[solid]));
        let mut facets: Vec<Facet> = facets.collect();
        reach_to_neighbours(&mut facets);
        facets
    }

    /// The faces of one element and of no other, as its index and the face's number, in the order of the elements; and the body
    /// of each element: those that hang together through whole faces have one.
    pub(super) fn outer_faces(&self) -> (Vec<(usize, u8)>, Vec<usize>) {
        let faces = sorted_faces(self.solids.par_iter().map(|solid| (solid.kind, solid.nodes)));
        let mut bodies = Sets::new(self.solids.len());
        let mut once = Vec::new();
        for same in faces.chunk_by(|a, b| a.0 == b.0) {
            match same {
                [(_, solid, number)] => once.push((*solid as usize, *number)),
                _ => same.iter().for_each(|face| bodies.join(same[0].1 as usize, face.1 as usize)),
            }
        }
        once.sort_unstable();
        let roots = (0..self.solids.len()).map(|solid| bodies.root(solid));
        (once, roots.collect())
    }

    /// `None` for a face without size.
    fn facet(&self, solid: usize, number: u8, body: usize) -> Option<Facet> {
        let own = &self.solids[solid];
        let face = own.kind.faces().get(usize::from(number))?;
        let corners = corners_of(own, face);
        let middle = Vector3::from(self.mean(&corners));
        let normal = normal(&self.places(&corners));
        let length = normal.norm();
        // a chord may lie deeper in a curved element than the element's centre
        let on_curve = self.middle(own, face);
        let outwards = normal * (on_curve - centre(self, own)).dot(&normal).signum();
        (length > 0.0).then(|| Facet {
            solid,
            centre: middle,
            normal: outwards / length,
            size: if corners.len() == 2 { length } else { 0.5 * length },
            corners,
            body,
            reach: (on_curve - middle).dot(&normal).abs() / length,
        })
    }

    /// Height of a point over a facet, along the normal that leads out of the body, m, if its foot is on the facet.
    pub(super) fn height(&self, facet: &Facet, point: &Vector3<f64>) -> Option<f64> {
        let along = facet.normal.dot(&(point - facet.centre));
        let foot = point - facet.normal * along;
        let on_it = match self.places(&facet.corners).as_slice() {
            [a, b] => {
                [(b - a, a), (a - b, b)].iter().all(|(to, from)| to.dot(&(foot - *from)) >= -self.tolerance * to.norm())
            }
            corners => (0..corners.len()).all(|side| {
                let from = corners[side];
                let across = (corners[(side + 1) % corners.len()] - from).cross(&facet.normal);
                let [own, other] = [&facet.centre, &foot].map(|place| across.dot(&(place - from)));
                other * own.signum() >= -self.tolerance * across.norm()
            }),
        };
        on_it.then_some(along)
    }
}

/// Sets the reach of every facet from the angles to its neighbours across its edges (across its ends in the plane).
///
/// An arc of angle θ over a chord l has the sagitta `l/2 tan(θ/4)`. The angle between two facets is the mean of their
/// arcs'; with twice that angle the larger of two is covered. A curved surface bends across two sides of a facet: of
/// the angles the second largest counts, so that a plane beside a fillet stays a plane.
fn reach_to_neighbours(facets: &mut [Facet]) {
    let mut sides: Vec<([usize; 2], usize)> = Vec::new();
    for (index, facet) in facets.iter().enumerate() {
        let corners = &facet.corners;
        match corners.as_slice() {
            &[a, b] => sides.extend([([a, a], index), ([b, b], index)]),
            _ => sides.extend((0..corners.len()).map(|side| {
                let (a, b) = (corners[side], corners[(side + 1) % corners.len()]);
                ([a.min(b), a.max(b)], index)
            })),
        }
    }
    sides.par_sort_unstable();
    let mut angles = vec![[0.0_f64; 2]; facets.len()];
    for same in sides.chunk_by(|a, b| a.0 == b.0) {
        let &[(_, a), (_, b)] = same else { continue };
        let cosine = facets[a].normal.dot(&facets[b].normal);
        if cosine > SMOOTH && cosine < 1.0 {
            let angle = cosine.acos();
            for index in [a, b] {
                let [largest, second] = angles[index];
                angles[index] = [largest.max(angle), second.max(largest.min(angle))];
            }
        }
    }
    for (facet, [_, second]) in facets.iter_mut().zip(angles) {
        let chord = match facet.corners.len() {
            2 => facet.size,
            _ => facet.size.sqrt(),
        };
        facet.reach = facet.reach.max(0.5 * chord * (0.5 * second).tan());
    }
}
