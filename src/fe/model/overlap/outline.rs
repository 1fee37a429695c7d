//! What an element fills, by the planes of its faces.

use super::bodies::{Bodies, Solid};
use crate::fe::element::continuum::shape_values;
use crate::fe::mesh::{ElementKind, Face};
use nalgebra::Vector3;

/// How far behind the plane of each face a point must be, relative to the element's own centre, to be within it.
/// Neighbours in a valid mesh have the plane of their common face between their centres, that is at a ratio below 0.
const DEPTH: f64 = 0.01;

/// Centre of an element, where its natural coordinates have the mean of the corners: also of curved elements it lies
/// within.
pub(super) fn centre(bodies: &Bodies, solid: &Solid) -> Vector3<f64> {
    blended(bodies, solid.kind, solid.nodes)
}

/// The point of an element or a face where its natural coordinates have the mean of the corners.
fn blended(bodies: &Bodies, kind: ElementKind, nodes: &[usize]) -> Vector3<f64> {
    let corners = &kind.natural_nodes()[..kind.corners()];
    let natural = [0, 1, 2].map(|axis| {
        let sum: f64 = corners.iter().map(|corner| corner[axis]).sum();
        sum / corners.len() as f64
    });
    let terms = nodes.iter().zip(shape_values(kind, natural));
    terms.fold(Vector3::zeros(), |sum, (&node, value)| sum + Vector3::from(bodies.points[node]) * value)
}

/// Normal of a face by its corners, as long as twice its area; of an edge in the plane, as long as the edge. Its sign is
/// that of the nodes' order.
pub(in crate::fe::model) fn normal(corners: &[Vector3<f64>]) -> Vector3<f64> {
    match corners {
        [a, b] => Vector3::new(b.y - a.y, a.x - b.x, 0.0),
        [a, b, c] => (b - a).cross(&(c - a)),
        [a, b, c, d] => (c - a).cross(&(d - b)),
        _ => Vector3::zeros(),
    }
}

/// Whether a point lies within an element: behind the planes of all its faces as seen from its centre `own`.
///
/// Each plane has the normal of the face's corners. It passes through their mean and, of a curved face, through the
/// face's own middle too: between chord and curve a point counts as outside.
pub(super) fn holds(bodies: &Bodies, solid: &Solid, own: &Vector3<f64>, point: &Vector3<f64>) -> bool {
    let behind = |normal: &Vector3<f64>, anchor: &Vector3<f64>| {
        let [depth, limit] = [point, own].map(|place| normal.dot(&(place - anchor)));
        depth * limit > DEPTH * limit * limit
    };
    let faces = solid.kind.faces();
    let flat = faces.iter().all(|face| {
        let (normal, mean) = plane(bodies, solid, face);
        behind(&normal, &mean)
    });
    let is_curved = solid.nodes.len() > solid.kind.corners();
    flat && (!is_curved
        || faces.iter().all(|face| {
            let (normal, _) = plane(bodies, solid, face);
            behind(&normal, &bodies.middle(solid, face))
        }))
}

/// Corners of a face of an element.
pub(super) fn corners_of(solid: &Solid, face: &Face) -> Vec<usize> {
    face.nodes[..face.kind.corners()].iter().map(|&local| solid.nodes[local]).collect()
}

/// Normal and mean of the corners of a face.
fn plane(bodies: &Bodies, solid: &Solid, face: &Face) -> (Vector3<f64>, Vector3<f64>) {
    let count = face.kind.corners();
    let mut places = [Vector3::zeros(); 4];
    for (place, &local) in places.iter_mut().zip(&face.nodes[..count]) {
        *place = Vector3::from(bodies.points[solid.nodes[local]]);
    }
    let places = &places[..count];
    let sum = places.iter().fold(Vector3::zeros(), |sum, place| sum + place);
    (normal(places), sum / count as f64)
}

impl Bodies<'_> {
    /// The middle of a face of an element on the face's own curve.
    pub(super) fn middle(&self, solid: &Solid, face: &Face) -> Vector3<f64> {
        let nodes: Vec<usize> = face.nodes.iter().map(|&local| solid.nodes[local]).collect();
        blended(self, face.kind, &nodes)
    }
}
