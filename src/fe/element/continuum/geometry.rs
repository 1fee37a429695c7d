//! From natural to real coordinates, the check that an element is one, and how well it is shaped.

use super::shape_values;
use super::table::{Table, for_kind, tables};
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;
use crate::numerics::Brief;
use schemars::JsonSchema;
use serde::Serialize;

/// Smallest Jacobian determinant accepted, as a part of the size of the element to the power of its dimension:
/// far below any useful shape (a strip or plate 1e4 times as long as thick has 1e-4, such a needle 1e-8) and
/// above the rounding of nodes on a line or plane (1e-16).
const SMALLEST_DETERMINANT: f64 = 1e-12;

/// Largest size accepted, m: its cube and all that is made from it are far from overflow.
const LARGEST_SIZE: f64 = 1e60;

/// How far a middle node may lie from the middle of its edge (face, volume) on a straight element, as a part of the size: the
/// matrices of the straight rule are then right to a few times this number.
const STRAIGHT: f64 = 1e-13;

/// An element whose coordinates are finite and as many as its kind has.
#[derive(Debug)]
pub(super) struct Placed<const N: usize> {
    /// Coordinates from the first node on, m: far from the origin nothing is lost that the input still had.
    pub(super) coords: [[f64; 3]; N],
    /// Largest distance from the first node along an axis, m.
    pub(super) size: f64,
    /// Every node behind the corners, if there are any, lies in the middle of its straight edge, or in the mean of the
    /// corners of its face or of the element: the geometry is that of the linear element.
    pub(super) straight: bool,
}

impl<const N: usize> Placed<N> {
    /// Checks the number of coordinates, that they are finite, and the size. Plane elements do not read z.
    pub(super) fn new(kind: ElementKind, coords: &[[f64; 3]]) -> Result<Self, ElementError> {
        let given: &[[f64; 3]; N] = coords.try_into().map_err(|_| wrong_node_count(kind, coords))?;
        let mut finite = true;
        let (mut size, mut distance) = (0.0_f64, 0.0_f64);
        let mut relative = [[0.0; 3]; N];
        for (to, from) in relative.iter_mut().zip(given) {
            for i in 0..kind.dimension() {
                to[i] = from[i] - given[0][i];
                finite &= from[i].is_finite();
                size = size.max(to[i].abs());
                distance = distance.max(from[i].abs());
            }
        }
        if !finite {
            return Err(not_finite(kind, coords));
        }
        if size > LARGEST_SIZE {
            return Err(ElementError(format!(
                "the {} element measures {size:e} m: expected at most {LARGEST_SIZE:e} m",
                kind.name()
            )));
        }
        // coordinates are rounded where they are, not where the element is
        let allowed = STRAIGHT * size + 2.0 * f64::EPSILON * distance;
        let corners = kind.corners();
        let mut straight = true;
        for (around, middle) in kind.beyond_corners().zip(&relative[corners..]) {
            for i in 0..3 {
                let expected = around.iter().map(|&corner| relative[corner][i]).sum::<f64>() / around.len() as f64;
                straight &= (middle[i] - expected).abs() <= allowed;
            }
        }
        Ok(Self { coords: relative, size, straight })
    }

    /// The determinants found are all well above zero.
    pub(super) fn accepts(&self, kind: ElementKind, smallest: f64) -> bool {
        smallest > SMALLEST_DETERMINANT * power(self.size, kind.dimension())
    }

    /// The smallest determinant at the nodes, m^2 or m^3. At the corners that is sufficient for straight plane
    /// elements; a strongly curved or warped one could still fold between nodes and points.
    pub(super) fn smallest_at_nodes<const D: usize>(&self, kind: ElementKind) -> f64 {
        let table = &tables(kind).nodes;
        let rows = table.derivatives::<N>().chunks_exact(D);
        rows.map(|rows| Jacobian::new::<N, D>(&self.coords, rows).determinant()).fold(f64::INFINITY, f64::min)
    }
}

/// Another number of coordinates than the kind has nodes.
pub(super) fn wrong_node_count(kind: ElementKind, coords: &[[f64; 3]]) -> ElementError {
    ElementError(format!("a {} element has {} nodes, found {}", kind.name(), kind.nodes(), coords.len()))
}

/// The first coordinate that is not finite.
pub(super) fn not_finite(kind: ElementKind, coords: &[[f64; 3]]) -> ElementError {
    let bad = |node: &[f64; 3]| !node.iter().all(|value| value.is_finite());
    let node = coords.iter().position(bad).unwrap_or_default();
    let [x, y, z] = coords.get(node).copied().unwrap_or_default();
    ElementError(format!(
        "node {node} of the {} element has the coordinates ({x}, {y}, {z}) m: expected finite numbers",
        kind.name()
    ))
}

/// `x^dimension` for 2 and 3.
pub(super) fn power(x: f64, dimension: usize) -> f64 {
    if dimension == 2 { x * x } else { x * x * x }
}

/// `J[d][i] = dx_i / dxi_d`, m; a plane element has a unit third direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jacobian([[f64; 3]; 3]);

impl Jacobian {
    /// From the shape derivatives at a point, a row for each of the D natural directions.
    #[inline(always)]
    pub(super) fn new<const N: usize, const D: usize>(coords: &[[f64; 3]; N], rows: &[[f64; N]]) -> Self {
        let mut j = [[0.0; 3], [0.0; 3], [0.0, 0.0, 1.0]];
        for (row, j) in rows[..D].iter().zip(&mut j) {
            let mut sum = [0.0; 3];
            for (derivative, node) in row.iter().zip(coords) {
                for i in 0..D {
                    sum[i] += derivative * node[i];
                }
            }
            *j = sum;
        }
        if D == 2 {
            j[2] = [0.0, 0.0, 1.0];
        }
        Self(j)
    }

    /// Lengths of the natural element's sides, from -1 to 1, m.
    pub(super) fn lengths(&self) -> [f64; 3] {
        self.0.map(|side| 2.0 * side.map(|x| x * x).iter().sum::<f64>().sqrt())
    }

    /// Distances of the natural element's opposite sides, m.
    pub(super) fn heights(&self) -> [f64; 3] {
        let (_, inverse) = self.inverse();
        inverse.map(|row| 2.0 / row.iter().map(|x| x * x).sum::<f64>().sqrt())
    }

    /// `det J`, m^2 or m^3.
    #[inline(always)]
    pub(super) fn determinant(&self) -> f64 {
        let [a, b, c] = self.0;
        let n = cross(b, c);
        a[0] * n[0] + a[1] * n[1] + a[2] * n[2]
    }

    /// `det J` and the inverse as `[d][i] = dxi_d / dx_i`, 1/m.
    #[inline(always)]
    pub(super) fn inverse(&self) -> (f64, [[f64; 3]; 3]) {
        let [a, b, c] = self.0;
        let rows = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = a[0] * rows[0][0] + a[1] * rows[0][1] + a[2] * rows[0][2];
        let factor = 1.0 / determinant;
        (determinant, rows.map(|row| row.map(|value| value * factor)))
    }
}

#[inline(always)]
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `x = sum N_a x_a`, m.
fn position(kind: ElementKind, coords: &[[f64; 3]], natural: [f64; 3]) -> [f64; 3] {
    let mut position = [0.0; 3];
    for (node, value) in coords.iter().zip(shape_values(kind, natural)) {
        for i in 0..kind.dimension() {
            position[i] += value * node[i];
        }
    }
    position
}

/// Where the nodes of an element lie if its edges are straight.
pub(crate) fn straight_edges(kind: ElementKind, coords: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut at = coords.to_vec();
    for (node, corners) in (kind.corners()..).zip(kind.beyond_corners()) {
        let sum = |d: usize| corners.iter().map(|&corner| coords[corner][d]).sum::<f64>();
        at[node] = [0, 1, 2].map(|d| sum(d) / corners.len() as f64);
    }
    at
}

/// A determinant and the natural coordinates where it is.
type Determinant = (f64, [f64; 3]);

/// The smallest and the largest determinant at the nodes and the points of a rule.
fn extremes<const N: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]; N],
    table: &Table,
) -> [Determinant; 2] {
    let (mut low, mut high) = ((f64::INFINITY, [0.0; 3]), (f64::NEG_INFINITY, [0.0; 3]));
    for table in [&tables(kind).nodes, table] {
        let rows = table.derivatives::<N>().chunks_exact(D);
        for (rows, point) in rows.zip(&table.points) {
            let determinant = Jacobian::new::<N, D>(coords, rows).determinant();
            if determinant < low.0 {
                low = (determinant, point.natural);
            }
            if determinant > high.0 {
                high = (determinant, point.natural);
            }
        }
    }
    [low, high]
}

/// What is wrong with an element that was not accepted.
#[cold]
pub(super) fn diagnose<const N: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
    placed: &Placed<N>,
    table: &Table,
) -> ElementError {
    let [(low, low_at), (high, high_at)] = extremes::<N, D>(kind, &placed.coords, table);
    let name = kind.name();
    let place = |natural: [f64; 3]| match position(kind, coords, natural) {
        [x, y, _] if D == 2 => format!("({}, {}) m", Brief(x), Brief(y)),
        [x, y, z] => format!("({}, {}, {}) m", Brief(x), Brief(y), Brief(z)),
    };
    if high < -SMALLEST_DETERMINANT * power(placed.size, D) {
        let (cause, remedy) = match D {
            2 => (
                "its nodes run clockwise",
                "turn it in gmsh (a surface of the mesh whose elements all run so is turned)",
            ),
            _ => ("its nodes are numbered inside out", "the mesh was mirrored or the node order is not gmsh's"),
        };
        return ElementError(format!(
            "the {name} element is inverted: {cause} (Jacobian determinant {} m^{D} at {}); {remedy}",
            Brief(high),
            place(high_at)
        ));
    }
    let natural = match low_at {
        [xi, eta, _] if D == 2 => format!("({xi:.3}, {eta:.3})"),
        [xi, eta, zeta] => format!("({xi:.3}, {eta:.3}, {zeta:.3})"),
    };
    let way = match (placed.straight, Placed::<N>::new(kind, &straight_edges(kind, coords))) {
        (true, _) => "",
        (false, Ok(mended)) if mended.accepts(kind, mended.smallest_at_nodes::<D>(kind)) => {
            "; housing.straighten = true mends such elements of second order"
        }
        (false, _) => "; straight edges do not mend it: mesh again",
    };
    ElementError(format!(
        "the {name} element is degenerate or folded: Jacobian determinant {} m^{D} at {}, natural coordinates {natural}; it must be positive everywhere{way}",
        Brief(low),
        place(low_at)
    ))
}

/// The Jacobian of an element, sampled at its nodes and at the points of its stiffness rule.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ShapeQuality {
    /// Jacobian ratio: smallest determinant over largest magnitude, in [-1, 1]. 1: constant (every straight
    /// triangle and tetrahedron, every parallelogram and parallelepiped, every pyramid on a parallelogram, however thin); small: strongly
    /// tapered, warped or curved; 0 or below: no valid element. An element without size has 0.
    pub scaled_jacobian: f64,
    /// Smallest determinant, m^2 (plane) or m^3 (solid); negative where the element is inverted.
    pub smallest_determinant: f64,
    /// Where the smallest determinant is, m.
    pub position: [f64; 3],
}

/// The quality of any element, also of one that [`stiffness_into`](super::stiffness_into) refuses.
///
/// `coords`: one (x, y, z) a node in gmsh's order, m; plane elements lie in xy and z is not read.
///
/// # Errors
/// [`ElementError`] for a wrong number of coordinates, coordinates that are not finite, and an element too large alone.
pub(crate) fn quality(kind: ElementKind, coords: &[[f64; 3]]) -> Result<ShapeQuality, ElementError> {
    for_kind!(kind, sample(kind, coords))
}

fn sample<const N: usize, const D: usize>(
    kind: ElementKind,
    coords: &[[f64; 3]],
) -> Result<ShapeQuality, ElementError> {
    let placed = Placed::<N>::new(kind, coords)?;
    let [(low, low_at), (high, _)] = extremes::<N, D>(kind, &placed.coords, &tables(kind).stiffness);
    let largest = high.abs().max(low.abs());
    Ok(ShapeQuality {
        smallest_determinant: low,
        scaled_jacobian: if largest > 0.0 { low / largest } else { 0.0 },
        position: position(kind, coords, low_at),
    })
}
