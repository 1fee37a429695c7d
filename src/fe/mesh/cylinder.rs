//! The cylinder that a surface lies on, or the circle that a curve lies on.
//!
//! The axis is the direction that the faces' normals are all across: the eigenvector of the smallest eigenvalue of
//! `sum A n n^T`. From there the squared distances of the nodes are made least by Gauss and Newton's method, over two tilts of the
//! axis, two displacements across it and the radius (a plane mesh: without the tilts). Corner nodes alone make the fit, since middle
//! nodes of a straight-sided mesh lie on chords; all nodes do where the corners' cylinder is not round.

use super::ElementKind;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

/// A face of a group (a curve's element in a plane mesh).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facet {
    pub kind: ElementKind,
    /// Places of its nodes, in the mesh's unit.
    pub nodes: Vec<[f64; 3]>,
    /// Middle of the element of the housing that it bounds, if it bounds one.
    pub inside: Option<[f64; 3]>,
}

impl Facet {
    /// Corners; two for a curve.
    pub(crate) fn corners(&self) -> &[[f64; 3]] {
        &self.nodes[..self.kind.corners()]
    }

    /// Area times normal of the triangle or quadrilateral of the corners, from its diagonals or sides; length times normal
    /// of a curve's element in the plane.
    pub(crate) fn area(&self) -> Vector3<f64> {
        let at = |place: usize| Vector3::from(self.nodes[place]);
        match self.kind.corners() {
            2 => (at(1) - at(0)).cross(&Vector3::z()),
            3 => 0.5 * (at(1) - at(0)).cross(&(at(2) - at(0))),
            4 => 0.5 * (at(2) - at(0)).cross(&(at(3) - at(1))),
            _ => Vector3::zeros(),
        }
    }

    /// Unit normal at a corner: of the second order across the tangents of the parabolas that end there, of the first that
    /// of the corners. `None` without size.
    pub(crate) fn normal(&self, corner: usize) -> Option<Vector3<f64>> {
        let count = self.kind.corners();
        let at = |place: usize| Vector3::from(self.nodes[place]);
        let tangent = |end: usize, edge: usize| 4.0 * at(count + edge) - 3.0 * at(corner) - at(end);
        let before = (corner + count - 1) % count;
        let normal = match (self.kind.order(), count) {
            (2, 2) => tangent(1 - corner, 0).cross(&Vector3::z()),
            (2, _) => tangent((corner + 1) % count, corner).cross(&tangent(before, before)),
            _ => self.area(),
        };
        normal.try_normalize(f64::MIN_POSITIVE)
    }
}

/// A fitted cylinder. Lengths in the unit of the points.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cylinder {
    /// Unit vector, its largest component positive.
    pub axis: [f64; 3],
    /// Point on the axis, in the middle of the surface's extent along it.
    pub centre: [f64; 3],
    /// Radius, > 0.
    pub radius: f64,
    /// Root of the mean squared distance of the nodes from it, middle nodes included.
    pub rms: f64,
    /// Largest distance of a node.
    pub farthest: f64,
    /// Extent along the axis.
    pub length: f64,
    /// Share of the full turn that the surface covers, 0 to 1.
    pub turn: f64,
    /// Whether the housing is outside of it: a hole, not a pin. `None`: the surface bounds no element of the housing.
    pub hole: Option<bool>,
}

/// Largest distance of a node from the cylinder, relative to its radius: what the ring's tie accepts.
pub(crate) const TOLERANCE: f64 = 0.01;

/// Least share of the turn that a hole or a round outside covers: a straight side whose coordinates are rounded is an arc of some radius too.
const LEAST_TURN: f64 = 1.0 / 12.0;

impl Cylinder {
    /// Whether a bore could be so: its nodes lie on it, and it is no straight side.
    pub(crate) fn is_round(&self) -> bool {
        self.farthest <= TOLERANCE * self.radius && self.turn >= LEAST_TURN
    }
}

/// Part of the normals' squares that a cylinder may have along its axis, and must have in its second direction: an arc of 29
/// degrees has as much, a plane nothing.
const SPREAD: f64 = 0.02;

/// Widest angle between neighbouring nodes of a facet (rad): those of six round the turn are a coarse cylinder, of four a box.
const WIDEST: f64 = 1.1;

/// Steps of the fit; it converges quadratically, noise or not, from the axis that the normals give.
const STEPS: usize = 30;

/// Fits a cylinder along any axis to facets of surfaces, or a circle about z to those of curves; `nodes` are all nodes of the
/// group. `None`: flat, round in two directions, or too few points.
pub(crate) fn fit(facets: &[Facet], nodes: &[[f64; 3]]) -> Option<Cylinder> {
    let curves = facets.iter().all(|facet| facet.kind.dimension() == 1);
    let axis = if curves { Vector3::z() } else { axis_across(facets)? };
    let by_corners = fit_to(facets.iter().flat_map(Facet::corners), axis, curves, facets, nodes);
    if by_corners.as_ref().is_some_and(Cylinder::is_round) || facets.iter().all(|facet| facet.kind.order() == 1) {
        return by_corners;
    }
    fit_to(facets.iter().flat_map(|facet| &facet.nodes), axis, curves, facets, nodes)
}

fn fit_to<'f>(
    points: impl Iterator<Item = &'f [f64; 3]>,
    axis: Vector3<f64>,
    curves: bool,
    facets: &[Facet],
    nodes: &[[f64; 3]],
) -> Option<Cylinder> {
    let points: Vec<Vector3<f64>> = points.map(|&point| Vector3::from(point)).collect();
    if points.len() < 6 {
        return None;
    }
    let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let size = points.iter().map(|point| (point - mean).norm()).fold(0.0, f64::max);
    if !(size.is_finite() && size > 0.0) {
        return None;
    }
    // of size 1 about the origin, so that every number below has its full digits
    let scaled: Vec<Vector3<f64>> = points.iter().map(|p| (p - mean) / size).collect();
    let frame = across(axis);
    let best = refine(&scaled, circle(&scaled, &frame)?, !curves)?;
    // with its largest component positive
    let axis = if best.axis[best.axis.iamax()] < 0.0 { -best.axis } else { best.axis };
    let along = |point: &Vector3<f64>| axis.dot(&(point - best.centre));
    let low = scaled.iter().map(along).fold(f64::INFINITY, f64::min);
    let high = scaled.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
    let middle = best.centre + axis * (0.5 * (low + high));
    let centre = mean + size * middle;
    let radius = size * best.radius;
    let off = |point: &Vector3<f64>| distance(point, &centre, &axis) - radius;
    let turn = covered(facets, &centre, &axis)?;
    let off = nodes.iter().map(|&node| off(&Vector3::from(node)).abs());
    Some(Cylinder {
        axis: axis.into(),
        centre: centre.into(),
        radius,
        rms: (off.clone().map(|off| off * off).sum::<f64>() / nodes.len().max(1) as f64).sqrt(),
        farthest: off.fold(0.0, f64::max),
        length: size * (high - low),
        turn,
        hole: hole(facets, &centre, &axis),
    })
}

/// The direction that the normals are across, if there is one and no more.
fn axis_across(facets: &[Facet]) -> Option<Vector3<f64>> {
    let mut squares = Matrix3::zeros();
    for facet in facets {
        let weight = facet.area().norm() / facet.corners().len() as f64;
        for normal in (0..facet.corners().len()).filter_map(|node| facet.normal(node)) {
            squares += weight * normal * normal.transpose();
        }
    }
    let trace = squares.trace();
    if !(trace.is_finite() && trace > 0.0) {
        return None;
    }
    let eigen = (squares / trace).symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let [least, second] = [order[0], order[1]].map(|place| eigen.eigenvalues[place]);
    (least < SPREAD && second > SPREAD).then(|| eigen.eigenvectors.column(order[0]).into_owned())
}

/// Two directions across an axis, and the axis, of length 1.
fn across(axis: Vector3<f64>) -> [Vector3<f64>; 3] {
    let axis = axis.normalize();
    let least = axis.iamin();
    let mut other = Vector3::zeros();
    other[least] = 1.0;
    let first = axis.cross(&other).normalize();
    [first, axis.cross(&first), axis]
}

struct Best {
    axis: Vector3<f64>,
    centre: Vector3<f64>,
    radius: f64,
}

/// Kasa's circle through the points seen along the axis: linear in its unknowns, near enough to start from.
fn circle(points: &[Vector3<f64>], frame: &[Vector3<f64>; 3]) -> Option<Best> {
    let rows = points.len();
    let seen: Vec<[f64; 2]> = points.iter().map(|point| [frame[0].dot(point), frame[1].dot(point)]).collect();
    let matrix = DMatrix::from_fn(rows, 3, |row, column| match column {
        2 => 1.0,
        axis => 2.0 * seen[row][axis],
    });
    let right = DVector::from_fn(rows, |row, _| seen[row][0].powi(2) + seen[row][1].powi(2));
    let found = matrix.svd(true, true).solve(&right, 1e-12).ok()?;
    let square = found[2] + found[0].powi(2) + found[1].powi(2);
    let centre = frame[0] * found[0] + frame[1] * found[1];
    (square.is_finite() && square > 0.0).then(|| Best { axis: frame[2], centre, radius: square.sqrt() })
}

fn refine(points: &[Vector3<f64>], mut best: Best, tilts: bool) -> Option<Best> {
    let unknowns = if tilts { 5 } else { 3 };
    for _ in 0..STEPS {
        let frame = across(best.axis);
        let mut matrix = DMatrix::zeros(points.len(), unknowns);
        let mut off = DVector::zeros(points.len());
        for (row, point) in points.iter().enumerate() {
            let arm = point - best.centre;
            let along = best.axis.dot(&arm);
            let out = arm - best.axis * along;
            let length = out.norm();
            if length <= f64::MIN_POSITIVE {
                return None;
            }
            let out = out / length;
            off[row] = length - best.radius;
            matrix[(row, 0)] = -frame[0].dot(&out);
            matrix[(row, 1)] = -frame[1].dot(&out);
            matrix[(row, 2)] = -1.0;
            if tilts {
                matrix[(row, 3)] = -along * frame[0].dot(&out);
                matrix[(row, 4)] = -along * frame[1].dot(&out);
            }
        }
        let step = matrix.svd(true, true).solve(&-off, 1e-9).ok()?;
        if !step.iter().all(|part| part.is_finite()) {
            return None;
        }
        best.centre += frame[0] * step[0] + frame[1] * step[1];
        best.radius += step[2];
        if tilts {
            best.axis = (best.axis + frame[0] * step[3] + frame[1] * step[4]).normalize();
        }
        // round-off of points of size 1
        if step.amax() < 1e-14 {
            break;
        }
    }
    (best.radius.is_finite() && best.radius > 0.0).then_some(best)
}

fn distance(point: &Vector3<f64>, centre: &Vector3<f64>, axis: &Vector3<f64>) -> f64 {
    let arm = point - centre;
    (arm - axis * axis.dot(&arm)).norm()
}

/// Share of the turn in which there is a facet: each covers the angles between its nodes. `None` if one is too wide.
fn covered(facets: &[Facet], centre: &Vector3<f64>, axis: &Vector3<f64>) -> Option<f64> {
    use std::f64::consts::{PI, TAU};
    let frame = across(*axis);
    let mut spans: Vec<(f64, f64)> = Vec::with_capacity(facets.len());
    for facet in facets {
        let angles = facet.nodes.iter().map(|&node| {
            let arm = Vector3::from(node) - centre;
            frame[1].dot(&arm).atan2(frame[0].dot(&arm))
        });
        let angles: Vec<f64> = angles.collect();
        let Some(&first) = angles.first() else {
            continue;
        };
        // around the first node, so that a facet across the cut at half a turn stays in one piece
        let turned = angles.iter().map(|angle| (angle - first + PI).rem_euclid(TAU) - PI);
        let (low, high) = turned.fold((0.0_f64, 0.0_f64), |(low, high), angle| (low.min(angle), high.max(angle)));
        if high - low > WIDEST * facet.kind.order() as f64 {
            return None;
        }
        let start = (first + low).rem_euclid(TAU);
        let end = start + (high - low);
        spans.push((start, end.min(TAU)));
        if end > TAU {
            spans.push((0.0, end - TAU));
        }
    }
    spans.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut total, mut reached) = (0.0, 0.0_f64);
    for (start, end) in spans {
        total += (end - start.max(reached)).max(0.0);
        reached = reached.max(end);
    }
    Some((total / TAU).min(1.0))
}

/// Whether the faces look at the axis, away from their elements.
fn hole(facets: &[Facet], centre: &Vector3<f64>, axis: &Vector3<f64>) -> Option<bool> {
    let inwards = facets.iter().filter_map(|facet| {
        let [inside, corner] = [facet.inside?, facet.nodes[0]].map(Vector3::from);
        let arm = corner - centre;
        let out = facet.area() * facet.area().dot(&(corner - inside)).signum();
        Some(-out.dot(&(arm - axis * axis.dot(&arm))))
    });
    inwards.reduce(|sum, next| sum + next).map(|sum| sum > 0.0)
}

#[cfg(test)]
#[path = "cylinder_tests.rs"]
mod tests;
