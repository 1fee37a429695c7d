//! What an element fills, by the planes of its faces and its own map.
//!
//! Boxes in a tree: which of many hold a point.

use super::bodies::{Bodies, Solid};
use crate::fe::element::continuum::{shape, shape_values};
use crate::fe::mesh::{BoundingBox, ElementKind, Face};
use nalgebra::{Matrix3, Vector3};

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
    let terms = nodes.iter().zip(shape_values(kind, natural_centre(kind).into()));
    terms.fold(Vector3::zeros(), |sum, (&node, value)| sum + Vector3::from(bodies.points[node]) * value)
}

fn natural_centre(kind: ElementKind) -> Vector3<f64> {
    let corners = &kind.natural_nodes()[..kind.corners()];
    corners.iter().map(|&corner| Vector3::from(corner)).sum::<Vector3<f64>>() / corners.len() as f64
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

/// Whether a point lies within an element: behind the planes of all its faces as seen from its centre `own`. Each plane has
/// the normal of the face's corners and passes through their mean.
///
/// A curved element holds what is behind these planes in its natural coordinates. They are sought where the point is
/// behind each face's plane, or behind that through the face's own middle.
pub(super) fn holds(bodies: &Bodies, solid: &Solid, own: &Vector3<f64>, point: &Vector3<f64>) -> bool {
    let place = |local: usize| Vector3::from(bodies.points[solid.nodes[local]]);
    solid.kind.faces().iter().all(|face| {
        let (normal, mean) = plane(face, place);
        is_behind(&normal, &mean, own, point)
            || solid.curved && is_behind(&normal, &bodies.middle(solid, face), own, point)
    }) && (!solid.curved || maps_to(solid.kind, place, point))
}

/// Whether a point is on the side of a plane on which an element's centre `own` is, and deep enough.
fn is_behind(normal: &Vector3<f64>, anchor: &Vector3<f64>, own: &Vector3<f64>, point: &Vector3<f64>) -> bool {
    let [depth, limit] = [point, own].map(|place| normal.dot(&(place - anchor)));
    depth * limit > DEPTH * limit * limit
}

/// Steps of Newton's method, and the longest of them in natural coordinates.
const STEPS: usize = 30;
const LONGEST: f64 = 0.5;

/// Whether an element of nodes at these places has the point within it, by Newton's method from its centre and from the
/// middles between that and the corners: of what an element maps to a point, some may be outside of it.
fn maps_to(kind: ElementKind, place: impl Fn(usize) -> Vector3<f64>, point: &Vector3<f64>) -> bool {
    let corner = |local: usize| Vector3::from(kind.natural_nodes()[local]);
    let centre = natural_centre(kind);
    let is_inside = |natural: &Vector3<f64>| {
        kind.faces().iter().all(|face| {
            let (normal, mean) = plane(face, corner);
            is_behind(&normal, &mean, &centre, natural)
        })
    };
    let starts = std::iter::once(centre).chain((0..kind.corners()).map(|local| 0.5 * (centre + corner(local))));
    starts.into_iter().any(|mut natural| {
        for _ in 0..STEPS {
            let (values, derivatives) = shape(kind, natural.into());
            let mut gap = *point;
            let mut jacobian = Matrix3::zeros();
            for local in 0..kind.nodes() {
                gap -= place(local) * values[local];
                jacobian += place(local) * Vector3::from(derivatives[local]).transpose();
            }
            if kind.dimension() == 2 {
                jacobian[(2, 2)] = 1.0;
            }
            let Some(step) = jacobian.try_inverse().map(|inverse| inverse * gap) else { break };
            natural += step * (LONGEST / step.norm()).min(1.0);
            if step.norm() < 1e-9 {
                return is_inside(&natural);
            }
        }
        false
    })
}

/// Corners of a face of an element.
pub(super) fn corners_of(solid: &Solid, face: &Face) -> Vec<usize> {
    face.nodes[..face.kind.corners()].iter().map(|&local| solid.nodes[local]).collect()
}

/// Normal and mean of the corners of a face of an element whose nodes are at these places.
fn plane(face: &Face, place: impl Fn(usize) -> Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let count = face.kind.corners();
    let mut places = [Vector3::zeros(); 4];
    for (own, &local) in places.iter_mut().zip(&face.nodes[..count]) {
        *own = place(local);
    }
    let places = &places[..count];
    (normal(places), places.iter().sum::<Vector3<f64>>() / count as f64)
}

impl Bodies<'_> {
    /// The middle of a face of an element on the face's own curve.
    pub(super) fn middle(&self, solid: &Solid, face: &Face) -> Vector3<f64> {
        let nodes: Vec<usize> = face.nodes.iter().map(|&local| solid.nodes[local]).collect();
        blended(self, face.kind, &nodes)
    }
}

/// Most boxes in a leaf.
const LEAF: usize = 8;

impl BoundingBox {
    fn holds(&self, point: [f64; 3], reach: f64) -> bool {
        (0..3).all(|axis| self.min[axis] - reach <= point[axis] && point[axis] <= self.max[axis] + reach)
    }

    /// Middle between both sides along an axis, m.
    pub(super) fn middle(&self, axis: usize) -> f64 {
        0.5 * (self.min[axis] + self.max[axis])
    }
}

/// A branch, whose left part is the node behind it, or a leaf.
#[derive(Debug)]
struct Node {
    bounds: BoundingBox,
    /// Places in the order, of a leaf.
    range: std::ops::Range<u32>,
    /// Index of the right part; none of a leaf.
    right: Option<u32>,
}

/// Fewer than 2^32 boxes.
#[derive(Debug)]
pub(super) struct BoxTree {
    /// In the order, so that a leaf's lie side by side.
    boxes: Vec<BoundingBox>,
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl BoxTree {
    pub(super) fn new(boxes: Vec<BoundingBox>) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::new();
        if !boxes.is_empty() {
            split(&boxes, &mut order, 0, &mut nodes);
        }
        Self { boxes: order.iter().map(|&index| boxes[index as usize]).collect(), order, nodes }
    }

    /// Indices of the boxes, neighbours in space near each other: searches in this order find the tree in the cache.
    pub(super) fn order(&self) -> &[u32] {
        &self.order
    }

    /// Calls `visit` with the index of every box that holds the point or is nearer than `reach` (m) along each axis.
    pub(super) fn visit(&self, point: [f64; 3], reach: f64, mut visit: impl FnMut(usize)) {
        let mut open: Vec<usize> = (0..self.nodes.len().min(1)).collect();
        while let Some(number) = open.pop() {
            let node = &self.nodes[number];
            if !node.bounds.holds(point, reach) {
                continue;
            }
            match node.right {
                Some(right) => open.extend([right as usize, number + 1]),
                None => {
                    let range = node.range.start as usize..node.range.end as usize;
                    let own = self.boxes[range.clone()].iter().zip(&self.order[range]);
                    own.filter(|(bounds, _)| bounds.holds(point, reach)).for_each(|(_, &index)| visit(index as usize));
                }
            }
        }
    }
}

/// Adds the node of a part of the order that begins at `first`, and those below it.
fn split(boxes: &[BoundingBox], order: &mut [u32], first: u32, nodes: &mut Vec<Node>) {
    let ends = order.iter().flat_map(|&index| [boxes[index as usize].min, boxes[index as usize].max]);
    let bounds = BoundingBox::of(ends);
    let number = nodes.len();
    nodes.push(Node { bounds, range: first..first + order.len() as u32, right: None });
    if order.len() <= LEAF {
        return;
    }
    let side = |axis: usize| bounds.max[axis] - bounds.min[axis];
    let axis = (1..3).fold(0, |long, axis| if side(axis) > side(long) { axis } else { long });
    let half = order.len() / 2;
    order.select_nth_unstable_by(half, |&a, &b| {
        let middle = |index: u32| boxes[index as usize].middle(axis);
        middle(a).total_cmp(&middle(b)).then(a.cmp(&b))
    });
    let (left, right) = order.split_at_mut(half);
    split(boxes, left, first, nodes);
    nodes[number].right = Some(nodes.len() as u32);
    split(boxes, right, first + half as u32, nodes);
}
