//! The surface of one side of a link, and the point of it that is nearest to a given one.

use crate::fe::element::continuum::shape;
use crate::fe::mesh::{BoundingBox, ElementKind, Mesh};
use nalgebra::{Matrix3, Vector3};

/// Steps of the search for a foot; on a plane face one is enough, on a curved one each gains a factor of
/// distance over radius of curvature.
const STEPS: usize = 40;

/// How far a curved face may bulge beyond the box of its nodes, relative to the box.
const BULGE: f64 = 0.25;

/// An element of a side: a curve, a face or a point.
#[derive(Debug, Clone)]
pub(super) struct SideFace {
    pub kind: ElementKind,
    pub nodes: Vec<usize>,
    /// gmsh's tag of the element, or of the one behind it.
    pub tag: u64,
    /// Holds the face, curved or not.
    bounds: BoundingBox,
}

/// The nearest point of a surface, and how a point fixed to the surface there moves.
#[derive(Debug, Clone)]
pub(crate) struct Foot {
    /// Kind of the face.
    pub kind: ElementKind,
    /// Nodes of the face.
    pub nodes: Vec<usize>,
    /// The point's displacement is `sum_i follow_i u_i`: the face's at the foot and its rotation times the
    /// gap, exact for every rigid motion.
    pub follow: Vec<Matrix3<f64>>,
    /// The nearest point, m.
    pub place: [f64; 3],
    /// Distance from the point to the foot, m.
    pub distance: f64,
    /// Size of the face: longest side of its box, m.
    pub size: f64,
}

/// The point of some faces that is nearest to `point` (m): curves (plane housings), faces (solid ones), or as many single
/// points; `None` if there are none.
pub(super) fn nearest(mesh: &Mesh, faces: &[SideFace], point: [f64; 3]) -> Option<Foot> {
    let point = Vector3::from(point);
    let mut best: Option<(f64, &SideFace, [f64; 2])> = None;
    for face in faces {
        let limit = best.map_or(f64::INFINITY, |(distance, ..)| distance);
        if face.box_distance(&point) >= limit {
            continue;
        }
        let (natural, distance) = face.project(mesh, &point);
        if distance < limit {
            best = Some((distance, face, natural));
        }
    }
    best.map(|(distance, face, natural)| face.foot(mesh, &point, natural, distance))
}

impl SideFace {
    pub(super) fn new(mesh: &Mesh, kind: ElementKind, nodes: Vec<usize>, tag: u64) -> Self {
        let bounds = BoundingBox::of(nodes.iter().map(|&node| mesh.nodes[node]));
        Self { kind, nodes, tag, bounds: bounds.grown(BULGE * bounds.longest_side()) }
    }

    fn box_distance(&self, point: &Vector3<f64>) -> f64 {
        let [low, high] = [self.bounds.min, self.bounds.max].map(Vector3::from);
        (low - point).sup(&(point - high)).sup(&Vector3::zeros()).norm()
    }

    /// Place and tangents at natural coordinates.
    fn at(&self, mesh: &Mesh, natural: [f64; 2]) -> (Vector3<f64>, [Vector3<f64>; 2]) {
        let (mut place, mut tangents) = (Vector3::zeros(), [Vector3::zeros(); 2]);
        let (values, derivatives) = shape(self.kind, [natural[0], natural[1], 0.0]);
        for ((&node, value), derivative) in self.nodes.iter().zip(values).zip(derivatives) {
            let at = Vector3::from(mesh.nodes[node]);
            place += at * value;
            for (tangent, factor) in tangents.iter_mut().zip(derivative) {
                *tangent += at * factor;
            }
        }
        (place, tangents)
    }

    /// Natural coordinates and distance of the nearest point: inside, or else on a side.
    fn project(&self, mesh: &Mesh, point: &Vector3<f64>) -> ([f64; 2], f64) {
        let distance = |natural| (self.at(mesh, natural).0 - point).norm();
        if self.kind == ElementKind::Point {
            return ([0.0; 2], distance([0.0; 2]));
        }
        let centre = if self.kind.corners() == 3 { [1.0 / 3.0; 2] } else { [0.0; 2] };
        if let Some(inside) = self.descend(mesh, point, centre) {
            return (inside, distance(inside));
        }
        // the edges of a face, the ends of a curve
        let sides = self.kind.faces().iter();
        let ends = sides.map(|side| [side.nodes[0], side.nodes[side.kind.corners() - 1]]);
        let natural = |local: usize| [0, 1].map(|axis| self.kind.natural_nodes()[local][axis]);
        let on_sides = ends.map(|ends| self.descend_side(mesh, point, ends.map(natural)));
        let nearest = on_sides.map(|natural| (natural, distance(natural)));
        nearest.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((centre, f64::INFINITY))
    }

    /// Gauss-Newton on the squared distance; `None` if it leads out of the face.
    fn descend(&self, mesh: &Mesh, point: &Vector3<f64>, mut natural: [f64; 2]) -> Option<[f64; 2]> {
        for _ in 0..STEPS {
            let (place, [s, t]) = self.at(mesh, natural);
            let gap = point - place;
            let step = match self.kind.dimension() {
                1 => [s.dot(&gap) / s.norm_squared(), 0.0],
                _ => {
                    let (ss, st, tt) = (s.norm_squared(), s.dot(&t), t.norm_squared());
                    let determinant = ss * tt - st * st;
                    let (a, b) = (s.dot(&gap), t.dot(&gap));
                    [(tt * a - st * b) / determinant, (ss * b - st * a) / determinant]
                }
            };
            natural = [natural[0] + step[0], natural[1] + step[1]];
            // so far out that a search from there could not end inside
            if !self.holds(natural, 1.0) {
                return None;
            }
            if step[0].abs().max(step[1].abs()) < 1e-14 {
                break;
            }
        }
        // inside or on the boundary, but for round-off
        self.holds(natural, 1e-12).then_some(natural)
    }

    /// Whether natural coordinates are on the face, or beyond it by no more than a margin.
    fn holds(&self, [xi, eta]: [f64; 2], margin: f64) -> bool {
        match self.kind.corners() {
            3 => xi >= -margin && eta >= -margin && xi + eta <= 1.0 + margin,
            _ => xi.abs() <= 1.0 + margin && eta.abs() <= 1.0 + margin,
        }
    }

    /// The same along a side between two corners, kept between them.
    fn descend_side(&self, mesh: &Mesh, point: &Vector3<f64>, [a, b]: [[f64; 2]; 2]) -> [f64; 2] {
        let along = [b[0] - a[0], b[1] - a[1]];
        let natural = |s: f64| [a[0] + s * along[0], a[1] + s * along[1]];
        let mut s: f64 = 0.5;
        for _ in 0..STEPS {
            let (place, tangents) = self.at(mesh, natural(s));
            let tangent = tangents[0] * along[0] + tangents[1] * along[1];
            let squared = tangent.norm_squared();
            if squared <= 0.0 {
                break;
            }
            let next = (s + tangent.dot(&(point - place)) / squared).clamp(0.0, 1.0);
            let step = (next - s).abs();
            s = next;
            if step < 1e-14 {
                break;
            }
        }
        natural(s)
    }

    /// How a point at a gap from the face follows it: `u + omega x gap`, the rotation `omega` from the
    /// derivatives of the face's displacements along it.
    fn foot(&self, mesh: &Mesh, point: &Vector3<f64>, natural: [f64; 2], distance: f64) -> Foot {
        let (place, tangents) = self.at(mesh, natural);
        let gap = (point - place).cross_matrix();
        let turns = |[xi, eta, _]: [f64; 3]| rotation_rows(&tangents, [xi, eta]);
        let (values, derivatives) = shape(self.kind, [natural[0], natural[1], 0.0]);
        let pairs = values.into_iter().zip(derivatives).take(self.nodes.len());
        let follow = pairs.map(|(value, derivative)| Matrix3::from_diagonal_element(value) - gap * turns(derivative));
        Foot {
            kind: self.kind,
            nodes: self.nodes.clone(),
            follow: follow.collect(),
            place: place.into(),
            distance,
            size: self.bounds.longest_side() / (1.0 + 2.0 * BULGE),
        }
    }
}

/// Rotation of a face for a unit displacement of a node with these shape derivatives: with the tangents
/// `t_a`, their reciprocals `t^a` and the normal n,
/// `omega = -n x sum_a t^a (n . u_,a) + n/2 sum_a n . (t^a x u_,a)`; on a curve about the directions across it.
fn rotation_rows([s, t]: &[Vector3<f64>; 2], derivative: [f64; 2]) -> Matrix3<f64> {
    let normal = s.cross(t);
    let area = normal.norm();
    if area <= f64::MIN_POSITIVE {
        let squared = s.norm_squared().max(f64::MIN_POSITIVE);
        return (s / squared).cross_matrix() * derivative[0];
    }
    let normal = normal / area;
    let reciprocal = [t.cross(&normal) / area, normal.cross(s) / area];
    let mut rows = Matrix3::zeros();
    for (direction, factor) in reciprocal.iter().zip(derivative) {
        let across = normal.cross(direction);
        rows += (normal * across.transpose() * 0.5 - across * normal.transpose()) * factor;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fe::mesh::{MeshNotes, MshFormat, MshVersion};
    use std::path::PathBuf;

    fn mesh(nodes: &[[f64; 3]]) -> Mesh {
        Mesh {
            nodes: nodes.to_vec(),
            node_tags: (1..=nodes.len() as u64).collect(),
            blocks: Vec::new(),
            groups: Vec::new(),
            format: MshFormat { version: MshVersion::V41, binary: false },
            notes: MeshNotes::default(),
            source: PathBuf::from("face"),
        }
    }

    fn face(mesh: &Mesh, kind: ElementKind) -> [SideFace; 1] {
        [SideFace::new(mesh, kind, (0..kind.nodes()).collect(), 1)]
    }

    /// A warped quadrilateral, a curved triangle, an edge in the plane.
    const FACES: [(ElementKind, &[[f64; 3]]); 3] = [
        (ElementKind::Quad4, &[[0.0, 0.0, 0.0], [2.0, 0.1, 0.2], [2.2, 1.9, 0.0], [-0.1, 2.0, 0.3]]),
        (
            ElementKind::Tri6,
            &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.2], [1.0, 1.0, 0.25], [0.0, 1.0, 0.15]],
        ),
        (ElementKind::Line3, &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.3, 0.0]]),
    ];

    #[test]
    fn a_point_beside_a_face_follows_every_rigid_motion() {
        for (kind, nodes) in FACES {
            let mesh = mesh(nodes);
            let faces = face(&mesh, kind);
            let plane = kind.dimension() == 1;
            for point in [[0.7, 0.6, 0.5], [0.4, 0.9, -0.3], [3.0, -1.0, 0.4]] {
                let point = if plane { [point[0], point[1], 0.0] } else { point };
                let foot = nearest(&mesh, &faces, point).expect("one face");
                for motion in 0..6 {
                    let unit = |k: usize| f64::from(u8::from(motion == k));
                    let along = Vector3::new(unit(0), unit(1), unit(2));
                    let about = Vector3::new(unit(3), unit(4), unit(5));
                    if plane && (motion == 2 || motion == 3 || motion == 4) {
                        continue; // out of the plane
                    }
                    let moves = |x: [f64; 3]| along + about.cross(&Vector3::from(x));
                    let found: Vector3<f64> = foot
                        .nodes
                        .iter()
                        .zip(&foot.follow)
                        .map(|(&node, follow)| follow * moves(mesh.nodes[node]))
                        .sum();
                    let error = (found - moves(point)).norm();
                    assert!(error < 1e-12, "{kind:?} {point:?} {motion}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn the_foot_is_the_nearest_of_many_points() {
        for (kind, nodes) in FACES {
            let mesh = mesh(nodes);
            let faces = face(&mesh, kind);
            for point in [[0.7, 0.6, 0.5], [0.4, 0.9, -0.3], [3.0, -1.0, 0.4], [-1.0, 0.5, 0.0]] {
                let at = Vector3::from(point);
                let found = nearest(&mesh, &faces, point).expect("one face").distance;
                let mut sampled = f64::INFINITY;
                for i in 0..=200 {
                    for j in 0..=200 {
                        let (a, b) = (f64::from(i) / 200.0, f64::from(j) / 200.0);
                        let natural = match kind {
                            ElementKind::Tri6 => [a, b * (1.0 - a)],
                            _ => [2.0 * a - 1.0, 2.0 * b - 1.0],
                        };
                        let place = faces[0].at(&mesh, natural).0;
                        sampled = sampled.min((place - at).norm());
                    }
                }
                assert!(found <= sampled + 1e-12, "{kind:?} {point:?}: {found} {sampled}");
                assert!(found > sampled - 2e-2, "{kind:?} {point:?}: {found} {sampled}");
            }
        }
    }
}
