//! The cylinder that a surface lies on, or the circle that a curve lies on.
//!
//! The axis is the direction that the faces' normals are all across: the eigenvector of the smallest eigenvalue of
//! `sum A n n^T`. From there the squared distances of the nodes are made least by Gauss and Newton's method, over two tilts of the
//! axis, two displacements across it and the radius (a plane mesh: without the tilts). Corner nodes alone make the fit: middle
//! nodes of a straight-sided mesh lie on chords.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

/// A face of a group (a curve's element in a plane mesh) by its corners.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facet {
    /// Corners, in the mesh's unit; two for a curve.
    pub corners: Vec<[f64; 3]>,
    /// Middle of the element of the housing that it bounds, if it bounds one.
    pub inside: Option<[f64; 3]>,
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
    /// Root of the mean squared distance of the corners from it.
    pub rms: f64,
    /// Largest distance of a node, middle nodes included.
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

/// Widest angle of a facet (rad): the corners of six round the turn are a coarse cylinder, those of four a box.
const WIDEST: f64 = 1.1;

/// Steps of the fit; it converges quadratically, noise or not, from the axis that the normals give.
const STEPS: usize = 30;

/// Fits a cylinder along any axis to facets of surfaces, or a circle about z to those of curves; `nodes` are all nodes of the
/// group. `None`: flat, round in two directions, or too few points.
pub(crate) fn fit(facets: &[Facet], nodes: &[[f64; 3]]) -> Option<Cylinder> {
    let curves = facets.iter().all(|facet| facet.corners.len() == 2);
    let axis = if curves { Vector3::z() } else { axis_across(facets)? };
    let corners = facets.iter().flat_map(|facet| &facet.corners);
    let points: Vec<Vector3<f64>> = corners.map(|&corner| Vector3::from(corner)).collect();
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
    let squares: f64 = points.iter().map(|point| off(point).powi(2)).sum();
    let nodes = nodes.iter().map(|&node| off(&Vector3::from(node)).abs());
    Some(Cylinder {
        axis: axis.into(),
        centre: centre.into(),
        radius,
        rms: (squares / points.len() as f64).sqrt(),
        farthest: nodes.fold(0.0, f64::max),
        length: size * (high - low),
        turn,
        hole: hole(facets, &centre, &axis),
    })
}

/// The direction that the normals are across, if there is one and no more.
fn axis_across(facets: &[Facet]) -> Option<Vector3<f64>> {
    let mut squares = Matrix3::zeros();
    for facet in facets {
        let area = area_vector(&facet.corners);
        let size = area.norm();
        if size > 0.0 {
            squares += area * area.transpose() / size;
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

/// Area times normal of a triangle or a quadrilateral, from its diagonals or sides; length times normal of a curve's
/// element in the plane.
pub(crate) fn area_vector(corners: &[[f64; 3]]) -> Vector3<f64> {
    let at = |place: usize| Vector3::from(corners[place]);
    match corners.len() {
        2 => (at(1) - at(0)).cross(&Vector3::z()),
        3 => 0.5 * (at(1) - at(0)).cross(&(at(2) - at(0))),
        4 => 0.5 * (at(2) - at(0)).cross(&(at(3) - at(1))),
        _ => Vector3::zeros(),
    }
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

/// Share of the turn in which there is a facet: each covers the angles between its corners. `None` if one is too wide.
fn covered(facets: &[Facet], centre: &Vector3<f64>, axis: &Vector3<f64>) -> Option<f64> {
    use std::f64::consts::{PI, TAU};
    let frame = across(*axis);
    let mut spans: Vec<(f64, f64)> = Vec::with_capacity(facets.len());
    for facet in facets {
        let angles = facet.corners.iter().map(|&corner| {
            let arm = Vector3::from(corner) - centre;
            frame[1].dot(&arm).atan2(frame[0].dot(&arm))
        });
        let angles: Vec<f64> = angles.collect();
        let Some(&first) = angles.first() else {
            continue;
        };
        // around the first corner, so that a facet across the cut at half a turn stays in one piece
        let turned = angles.iter().map(|angle| (angle - first + PI).rem_euclid(TAU) - PI);
        let (low, high) = turned.fold((0.0_f64, 0.0_f64), |(low, high), angle| (low.min(angle), high.max(angle)));
        if high - low > WIDEST {
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

/// Whether the elements lie farther from the axis than the faces that they have there.
fn hole(facets: &[Facet], centre: &Vector3<f64>, axis: &Vector3<f64>) -> Option<bool> {
    let outwards = facets.iter().filter_map(|facet| {
        let inside = Vector3::from(facet.inside?);
        let corners = facet.corners.iter().map(|&corner| Vector3::from(corner));
        let middle = corners.sum::<Vector3<f64>>() / facet.corners.len() as f64;
        Some(distance(&inside, centre, axis) - distance(&middle, centre, axis))
    });
    outwards.reduce(|sum, next| sum + next).map(|sum| sum > 0.0)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use nalgebra::{Rotation3, Unit, Vector3};

    use super::{Cylinder, Facet, fit};

    struct Made {
        centre: Vector3<f64>,
        turn: Rotation3<f64>,
        radius: f64,
        length: f64,
        arc: f64,
        noise: f64,
    }

    impl Made {
        fn about_z() -> Self {
            Self {
                centre: Vector3::zeros(),
                turn: Rotation3::identity(),
                radius: 6.0,
                length: 10.0,
                arc: TAU,
                noise: 0.0,
            }
        }

        fn fit(&self) -> Option<Cylinder> {
            let (round, rows) = (24, 5);
            let mut state = 12345_u32;
            let mut random = move || {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                2.0 * f64::from(state) / f64::from(u32::MAX) - 1.0
            };
            let mut nodes = vec![[0.0; 3]; (round + 1) * (rows + 1)];
            let full = self.arc > TAU - 1e-9;
            for row in 0..=rows {
                for step in 0..=round {
                    let angle = self.arc * step as f64 / round as f64;
                    let radius = self.radius + self.noise * random();
                    let along = self.length * (row as f64 / rows as f64 - 0.5);
                    let point = Vector3::new(radius * angle.cos(), radius * angle.sin(), along);
                    let place = row * (round + 1) + step;
                    nodes[place] = (self.turn * point + self.centre).into();
                    if full && step == round {
                        nodes[place] = nodes[row * (round + 1)];
                    }
                }
            }
            let mut facets = Vec::new();
            for row in 0..rows {
                for step in 0..round {
                    let place = row * (round + 1) + step;
                    let corners = [place, place + 1, place + round + 2, place + round + 1];
                    let corners: Vec<[f64; 3]> = corners.iter().map(|&n| nodes[n]).collect();
                    let middle = corners.iter().map(|&c| Vector3::from(c)).sum::<Vector3<f64>>() / 4.0;
                    let axis = self.turn * Vector3::z();
                    let arm = middle - self.centre;
                    let out = arm - axis * axis.dot(&arm);
                    let inside = Some((middle + 0.1 * out).into());
                    facets.push(Facet { corners, inside });
                }
            }
            fit(&facets, &nodes)
        }
    }

    fn near(found: [f64; 3], expected: Vector3<f64>, within: f64) {
        let found = Vector3::from(found);
        assert!((found - expected).norm() < within, "{found} {expected}");
    }

    #[test]
    fn a_whole_cylinder_is_found_to_round_off() {
        let made = Made::about_z();
        let found = made.fit().unwrap();
        near(found.axis, Vector3::z(), 1e-12);
        near(found.centre, Vector3::zeros(), 1e-11);
        assert!((found.radius / 6.0 - 1.0).abs() < 1e-12);
        assert!((found.length / 10.0 - 1.0).abs() < 1e-12);
        assert!(found.rms < 1e-11 && found.farthest < 1e-11);
        assert!((found.turn - 1.0).abs() < 1e-9, "{}", found.turn);
        assert_eq!(found.hole, Some(true));
    }

    #[test]
    fn any_axis_and_any_place() {
        let made = Made {
            centre: Vector3::new(300.0, -20.0, 1000.0),
            turn: Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::new(1.0, 2.0, 0.3)), 1.1),
            ..Made::about_z()
        };
        let found = made.fit().unwrap();
        let axis = made.turn * Vector3::z();
        near(found.axis, if axis[axis.iamax()] < 0.0 { -axis } else { axis }, 1e-11);
        near(found.centre, made.centre, 1e-9);
        assert!((found.radius / 6.0 - 1.0).abs() < 1e-11);
    }

    #[test]
    fn half_a_noisy_bore() {
        let made = Made {
            arc: 0.5 * TAU,
            noise: 0.006,
            centre: Vector3::new(5.0, 40.0, 0.0),
            turn: Rotation3::from_axis_angle(&Vector3::x_axis(), 0.5 * std::f64::consts::PI),
            ..Made::about_z()
        };
        let found = made.fit().unwrap();
        // 150 nodes with a deviation of 0.006 / sqrt(3) each: a tenth of it is three standard errors of a centre by half a circle
        near(found.axis, -(made.turn * Vector3::z()), 3e-3);
        near(found.centre, made.centre, 4e-3);
        assert!((found.radius - 6.0).abs() < 4e-3, "{}", found.radius);
        assert!((found.turn - 0.5).abs() < 1e-2, "{}", found.turn);
        assert!((0.002..0.0046).contains(&found.rms), "{}", found.rms);
        assert!((0.005..0.0075).contains(&found.farthest), "{}", found.farthest);
    }

    #[test]
    fn planes_spheres_and_boxes_are_none() {
        let flat = |corners: [[f64; 3]; 4]| Facet { corners: corners.to_vec(), inside: None };
        let plane: Vec<Facet> = (0..9)
            .map(|n| {
                let (x, y) = (f64::from(n % 3), f64::from(n / 3));
                flat([[x, y, 0.0], [x + 1.0, y, 0.0], [x + 1.0, y + 1.0, 0.0], [x, y + 1.0, 0.0]])
            })
            .collect();
        assert_eq!(fit(&plane, &[]), None);
        assert_eq!(fit(&[], &[]), None);
        let cube = [
            [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
            [[0., 0., 1.], [1., 0., 1.], [1., 1., 1.], [0., 1., 1.]],
            [[0., 0., 0.], [1., 0., 0.], [1., 0., 1.], [0., 0., 1.]],
            [[0., 1., 0.], [1., 1., 0.], [1., 1., 1.], [0., 1., 1.]],
            [[0., 0., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.]],
            [[1., 0., 0.], [1., 1., 0.], [1., 1., 1.], [1., 0., 1.]],
        ];
        let cube: Vec<Facet> = cube.into_iter().map(flat).collect();
        assert_eq!(fit(&cube, &[]), None);
        // four sides of a box: the normals are those of a cylinder, and the corners lie on one
        assert_eq!(fit(&cube[2..], &[[0.5, 0.0, 0.5]]), None);
    }

    #[test]
    fn a_circle_in_a_plane_mesh() {
        let at = |step: usize| {
            let angle = TAU * step as f64 / 12.0;
            [3.0 + 2.0 * angle.cos(), 1.0 + 2.0 * angle.sin(), 0.0]
        };
        let facets: Vec<Facet> =
            (0..9).map(|step| Facet { corners: vec![at(step), at(step + 1)], inside: Some([3.0, 1.0, 0.0]) }).collect();
        let nodes: Vec<[f64; 3]> = (0..10).map(at).collect();
        let found = fit(&facets, &nodes).unwrap();
        near(found.axis, Vector3::z(), 1e-15);
        near(found.centre, Vector3::new(3.0, 1.0, 0.0), 1e-12);
        assert!((found.radius - 2.0).abs() < 1e-12);
        assert!((found.turn - 0.75).abs() < 1e-9, "{}", found.turn);
        assert_eq!(found.hole, Some(false));
    }
}
