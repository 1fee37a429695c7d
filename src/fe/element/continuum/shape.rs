//! Natural coordinates of the nodes, shape functions and their derivatives with respect to the natural coordinates.
//!
//! Fixed-size arrays, zero beyond the element's nodes; the assembly loop reads them from tables made
//! once a kind. Sources: Bathe, Finite Element Procedures (1996), figures 5.4, 5.5 (quadrilaterals,
//! hexahedra), 5.11 and 5.13 (triangles, tetrahedra); Zienkiewicz and Taylor, The Finite Element Method,
//! volume 1 (2000), section 8.12 (wedges); Bedrosian, Int. J. Numer. Methods Eng. 35 (1992) 95 (pyramids of 5 and 13 nodes);
//! Bergot, Cohen, Durufle, J. Sci. Comput. 42 (2010) 345 (that of 14).

use crate::fe::mesh::ElementKind;

/// Most nodes that an element has.
pub const MAX_NODES: usize = 27;

static LINE: [[f64; 3]; 3] = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3]];
const TETRAHEDRON_CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const QUADRILATERAL_CORNERS: [[f64; 3]; 4] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
const HEXAHEDRON_CORNERS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];
const WEDGE_CORNERS: [[f64; 3]; 6] =
    [[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
const PYRAMID_CORNERS: [[f64; 3]; 5] =
    [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Corners (the first of `corners`), then the middle of each edge, then the centres.
const fn nodes<const N: usize>(kind: ElementKind, corners: &[[f64; 3]]) -> [[f64; 3]; N] {
    let (edges, centres) = (kind.middle_edges(), kind.centres());
    let mut nodes = [[0.0; 3]; N];
    let mut i = 0;
    while i < N {
        let own = [i];
        let around: &[usize] = if i < kind.corners() {
            &own
        } else if i - kind.corners() < edges.len() {
            &edges[i - kind.corners()]
        } else {
            centres[i - kind.corners() - edges.len()]
        };
        let mut d = 0;
        while d < 3 {
            let (mut sum, mut k) = (0.0, 0);
            while k < around.len() {
                sum += corners[around[k]][d];
                k += 1;
            }
            nodes[i][d] = sum / around.len() as f64;
            d += 1;
        }
        i += 1;
    }
    nodes
}

static TRIANGLE: [[f64; 3]; 6] = nodes(ElementKind::Tri6, &TETRAHEDRON_CORNERS);
static QUADRILATERAL: [[f64; 3]; 9] = nodes(ElementKind::Quad9, &QUADRILATERAL_CORNERS);
static TETRAHEDRON: [[f64; 3]; 10] = nodes(ElementKind::Tet10, &TETRAHEDRON_CORNERS);
static HEXAHEDRON: [[f64; 3]; 27] = nodes(ElementKind::Hex27, &HEXAHEDRON_CORNERS);
static WEDGE: [[f64; 3]; 18] = nodes(ElementKind::Wedge18, &WEDGE_CORNERS);
static PYRAMID: [[f64; 3]; 14] = nodes(ElementKind::Pyramid14, &PYRAMID_CORNERS);

impl ElementKind {
    /// Natural coordinates (xi, eta, zeta) of the nodes, in gmsh's order; zero beyond the element's dimension.
    ///
    /// Triangles and tetrahedra stand on the corner (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1); lines, quadrilaterals and
    /// hexahedra on [-1, 1] in each direction; wedges on the triangle in (xi, eta) and [-1, 1] in zeta; pyramids on the
    /// square [-1, 1] in (xi, eta) with the apex (0, 0, 1). Beware when
    /// reading other programs' meshes: their Tet10 swaps the last two nodes, their Hex20 and Wedge15 order the edges
    /// layer by layer.
    pub fn natural_nodes(self) -> &'static [[f64; 3]] {
        let shape: &[[f64; 3]] = match (self.dimension(), self.corners()) {
            (0, _) => return &LINE[2..],
            (1, _) => &LINE,
            (2, 3) => &TRIANGLE,
            (2, _) => &QUADRILATERAL,
            (_, 4) => &TETRAHEDRON,
            (_, 5) => &PYRAMID,
            (_, 6) => &WEDGE,
            _ => &HEXAHEDRON,
        };
        &shape[..self.nodes()]
    }

    /// Number of degrees of freedom: [`ElementKind::dimension`] a node.
    pub(crate) fn dof(self) -> usize {
        self.dimension() * self.nodes()
    }

    /// Triangle or tetrahedron: with straight edges its Jacobian is constant.
    pub(super) fn is_simplex(self) -> bool {
        matches!(self, Self::Tri3 | Self::Tri6 | Self::Tet4 | Self::Tet10)
    }
}

/// `N_i` at a point; entries beyond the element's nodes are zero.
pub type ShapeValues = [f64; MAX_NODES];

/// `[dN_i/dxi, dN_i/deta, dN_i/dzeta]` at a point; entries beyond the element's nodes, and the third of plane
/// elements, are zero.
pub type ShapeDerivatives = [[f64; 3]; MAX_NODES];

/// Shape functions `N_i(xi, eta, zeta)`, dimensionless: 1 at node i, 0 at the others, sum 1.
pub fn shape_values(kind: ElementKind, natural: [f64; 3]) -> ShapeValues {
    shape(kind, natural).0
}

/// Derivatives `dN_i/dxi`, `dN_i/deta`, `dN_i/dzeta`, dimensionless; their sums over i are zero.
pub fn shape_derivatives(kind: ElementKind, natural: [f64; 3]) -> ShapeDerivatives {
    shape(kind, natural).1
}

/// [`shape_values`] and [`shape_derivatives`] together. Elements do not read natural coordinates beyond their dimension.
pub(crate) fn shape(kind: ElementKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    match (kind.dimension(), kind.corners()) {
        (0 | 1, _) => on_line(kind, natural[0]),
        (2, 3) | (3, 4) => on_simplex(kind, natural),
        (_, 5) => on_pyramid(kind, natural),
        (_, 6) => on_wedge(kind, natural),
        _ => on_tensor_product(kind, natural),
    }
}

/// Lines and the point: linear `(1 -+ xi) / 2`; quadratic `xi (xi -+ 1) / 2` at an end, `1 - xi^2` in the middle.
fn on_line(kind: ElementKind, xi: f64) -> (ShapeValues, ShapeDerivatives) {
    let (three, slopes) = match kind {
        ElementKind::Line2 => ([0.5 * (1.0 - xi), 0.5 * (1.0 + xi), 0.0], [-0.5, 0.5, 0.0]),
        ElementKind::Line3 => {
            ([0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi], [xi - 0.5, xi + 0.5, -2.0 * xi])
        }
        _ => ([1.0, 0.0, 0.0], [0.0; 3]),
    };
    let mut values = [0.0; MAX_NODES];
    let mut derivatives = [[0.0; 3]; MAX_NODES];
    for node in 0..3 {
        values[node] = three[node];
        derivatives[node][0] = slopes[node];
    }
    (values, derivatives)
}

/// Barycentric coordinates `L_0 = 1 - xi - eta - zeta, L_1 = xi, L_2 = eta, L_3 = zeta`, and their gradients.
fn barycentric([xi, eta, zeta]: [f64; 3]) -> [f64; 4] {
    [1.0 - xi - eta - zeta, xi, eta, zeta]
}

/// Gradient of `L_i` in `dimension` directions.
fn gradient(i: usize, dimension: usize) -> [f64; 3] {
    let mut gradient = [0.0; 3];
    if i == 0 {
        gradient[..dimension].fill(-1.0);
    } else {
        gradient[i - 1] = 1.0;
    }
    gradient
}

/// Triangles and tetrahedra, from barycentric coordinates. Linear: `L_i`. Quadratic: `L_i (2 L_i - 1)` at a corner, `4 L_a L_b`
/// at the middle of an edge.
fn on_simplex(kind: ElementKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    let dimension = kind.dimension();
    let l = barycentric(natural);
    let mut values = [0.0; MAX_NODES];
    let mut derivatives = [[0.0; 3]; MAX_NODES];
    let quadratic = kind.order() == 2;
    for i in 0..kind.corners() {
        let (value, slope) = if quadratic { (l[i] * (2.0 * l[i] - 1.0), 4.0 * l[i] - 1.0) } else { (l[i], 1.0) };
        values[i] = value;
        derivatives[i] = gradient(i, dimension).map(|g| slope * g);
    }
    for (&[a, b], i) in kind.middle_edges().iter().zip(kind.corners()..) {
        let (to_a, to_b) = (gradient(a, dimension), gradient(b, dimension));
        values[i] = 4.0 * l[a] * l[b];
        for d in 0..3 {
            derivatives[i][d] = 4.0 * (l[b] * to_a[d] + l[a] * to_b[d]);
        }
    }
    (values, derivatives)
}

/// Quadrilaterals and hexahedra: products of linear functions, serendipity, and products of quadratic ones. With
/// `u_d = xi_d a_d` for a node at `a`, in D directions: linear `2^-D prod (1 + u_d)`; serendipity corner
/// `2^-D prod (1 + u_d) (sum u_d - D + 1)`; middle of an edge along m
/// `2^(1-D) (1 - xi_m^2) prod_(d != m) (1 + u_d)`; Quad9 and Hex27 `prod n_d`, where `n_d` is `1 - xi_d^2` for `a_d = 0`,
/// else `u_d (1 + u_d) / 2`.
fn on_tensor_product(kind: ElementKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    let dimension = kind.dimension();
    let complete = !kind.centres().is_empty();
    let serendipity = kind.order() == 2 && !complete;
    let mut values = [0.0; MAX_NODES];
    let mut derivatives = [[0.0; 3]; MAX_NODES];
    for (i, node) in kind.natural_nodes().iter().enumerate() {
        // one factor a direction, with its derivative
        let mut factors = [1.0; 3];
        let mut slopes = [0.0; 3];
        for d in 0..dimension {
            let middle = node[d].abs() < 0.5;
            (factors[d], slopes[d]) = if middle {
                (1.0 - natural[d] * natural[d], -2.0 * natural[d])
            } else if complete {
                (0.5 * natural[d] * (natural[d] + node[d]), natural[d] + 0.5 * node[d])
            } else {
                (0.5 * (1.0 + natural[d] * node[d]), 0.5 * node[d])
            };
        }
        let product: f64 = factors.iter().product();
        let along = |d: usize| slopes[d] * factors[(d + 1) % 3] * factors[(d + 2) % 3];
        values[i] = product;
        derivatives[i] = [along(0), along(1), along(2)];
        if serendipity && i < kind.corners() {
            let u: f64 = (0..dimension).map(|d| natural[d] * node[d]).sum();
            let taper = u - dimension as f64 + 1.0;
            values[i] = product * taper;
            for d in 0..dimension {
                derivatives[i][d] = along(d) * taper + product * node[d];
            }
        }
    }
    (values, derivatives)
}

/// A function of the triangle and its gradient there.
type OnTriangle = (f64, [f64; 3]);
/// A function of zeta and its derivative.
type OnLine = (f64, f64);

/// Wedges: triangle times line. With `z = +-1` the layer of a corner: linear `L_i (1 + z zeta) / 2`; serendipity corner
/// `L_i (2 L_i - 1)(1 + z zeta) / 2 - L_i (1 - zeta^2) / 2`, middle of a triangle's edge
/// `4 L_a L_b (1 + z zeta) / 2`, middle of an upright edge `L_i (1 - zeta^2)`; Wedge18 the six functions of Tri6 times
/// `zeta (zeta + z) / 2` in a layer, and times `1 - zeta^2` between the layers.
fn on_wedge(kind: ElementKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    let [xi, eta, zeta] = natural;
    let l = barycentric([xi, eta, 0.0]);
    let corner = |i: usize| -> OnTriangle { (l[i % 3], gradient(i % 3, 2)) };
    // the function of Tri6 at a corner, or between two
    let curved = |a: usize, b: usize| -> OnTriangle {
        let ((p, to_p), (q, to_q)) = (corner(a), corner(b));
        match a % 3 == b % 3 {
            true => (p * (2.0 * p - 1.0), to_p.map(|s| s * (4.0 * p - 1.0))),
            false => (4.0 * (p * q), [0, 1, 2].map(|d| 4.0 * (p * to_q[d] + q * to_p[d]))),
        }
    };
    let complete = !kind.centres().is_empty();
    let layer = |i: usize| -> OnLine {
        let z = if i < 3 { -1.0 } else { 1.0 };
        if complete { (0.5 * zeta * (zeta + z), zeta + 0.5 * z) } else { (0.5 * (1.0 + z * zeta), 0.5 * z) }
    };
    let bubble: OnLine = (1.0 - zeta * zeta, -2.0 * zeta);
    let mut values = [0.0; MAX_NODES];
    let mut derivatives = [[0.0; 3]; MAX_NODES];
    let mut add = |i: usize, factor: f64, triangle: OnTriangle, line: OnLine| {
        values[i] += factor * triangle.0 * line.0;
        derivatives[i][0] += factor * triangle.1[0] * line.0;
        derivatives[i][1] += factor * triangle.1[1] * line.0;
        derivatives[i][2] += factor * triangle.0 * line.1;
    };
    for i in 0..6 {
        let linear = kind.order() == 1;
        add(i, 1.0, if linear { corner(i) } else { curved(i, i) }, layer(i));
        if !linear && !complete {
            add(i, -0.5, corner(i), bubble);
        }
    }
    for (around, i) in kind.beyond_corners().zip(6..) {
        match *around {
            [a, b] if b == a + 3 => add(i, 1.0, if complete { curved(a, a) } else { corner(a) }, bubble),
            [a, b] => add(i, 1.0, curved(a, b), layer(a)),
            // opposite corners of an upright face
            [a, _, b, _] => add(i, 1.0, curved(a, b), bubble),
            _ => {}
        }
    }
    (values, derivatives)
}

/// Pyramids: rational functions, quadratic on the triangular faces. With `s = 1 - z`, `xi = x / s`, `eta = y / s`, and a
/// corner of the base at (a, b):
///
/// | node | function | kinds |
/// |---|---|---|
/// | corner of the base | `P = s (1 + a xi)(1 + b eta) / 4` | 5 |
/// | apex | `z` | 5 |
/// | corner of the base | `(a x + b y - 1) P` | 13, 14 |
/// | apex | `z (2 z - 1)` | 13, 14 |
/// | middle of an edge of the base, at (0, b) | `s^2 (1 - xi^2)(1 + b eta) / 2` | 13, 14 |
/// | middle of an edge to the apex | `4 z P` | 13, 14 |
/// | centre of the base | `B = s^2 (1 - xi^2)(1 - eta^2)` | 14 |
///
/// Pyramid14 takes B off the others by their value at the centre: -1/4 at a corner, 1/2 at the middle of an edge of the base.
/// The spans are the polynomials of degree 1 and `s xi eta`; of degree 2 and `s xi eta (1, x, y)`; and
/// `s^2 xi^2 eta^2` for 14. At the apex the derivatives depend on the direction, within bounds; there, where s = 0, they are
/// those on the axis, xi = eta = 0.
fn on_pyramid(kind: ElementKind, [x, y, z]: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    let s = 1.0 - z;
    let [xi, eta] = if s == 0.0 { [0.0; 2] } else { [x / s, y / s] };
    let mut values = [0.0; MAX_NODES];
    let mut derivatives = [[0.0; 3]; MAX_NODES];
    let linear = |[a, b, _]: [f64; 3]| {
        let value = 0.25 * s * (1.0 + a * xi) * (1.0 + b * eta);
        let slopes = [a * (1.0 + b * eta), b * (1.0 + a * xi), a * b * xi * eta - 1.0];
        (value, slopes.map(|slope| 0.25 * slope))
    };
    let quadratic = kind.order() == 2;
    for (i, corner) in PYRAMID_CORNERS[..4].iter().enumerate() {
        let (p, to_p) = linear(*corner);
        if quadratic {
            let [a, b, _] = *corner;
            let taper = a * x + b * y - 1.0;
            values[i] = taper * p;
            derivatives[i] = [taper * to_p[0] + a * p, taper * to_p[1] + b * p, taper * to_p[2]];
        } else {
            (values[i], derivatives[i]) = (p, to_p);
        }
    }
    (values[4], derivatives[4][2]) = if quadratic { (z * (2.0 * z - 1.0), 4.0 * z - 1.0) } else { (z, 1.0) };
    for (&[a, b], i) in kind.middle_edges().iter().zip(5..) {
        if b == 4 {
            let (p, to_p) = linear(PYRAMID_CORNERS[a]);
            values[i] = 4.0 * z * p;
            derivatives[i] = [4.0 * z * to_p[0], 4.0 * z * to_p[1], 4.0 * (z * to_p[2] + p)];
        } else {
            // along one direction, at one end of the other
            let along = usize::from(PYRAMID[i][0].abs() > 0.5);
            let (end, [u, v]) = (PYRAMID[i][1 - along], if along == 0 { [xi, eta] } else { [eta, xi] });
            let (bubble, ramp) = (1.0 - u * u, 1.0 + end * v);
            values[i] = 0.5 * s * s * bubble * ramp;
            derivatives[i][along] = -s * u * ramp;
            derivatives[i][1 - along] = 0.5 * s * end * bubble;
            // -d/ds of (s^2 - x^2)(s + b y) / (2 s)
            derivatives[i][2] = -s * (1.0 + 0.5 * end * v * (1.0 + u * u));
        }
    }
    if kind.nodes() == 14 {
        let bubbles = [1.0 - xi * xi, 1.0 - eta * eta];
        values[13] = s * s * bubbles[0] * bubbles[1];
        derivatives[13] =
            [-2.0 * s * xi * bubbles[1], -2.0 * s * eta * bubbles[0], -2.0 * s * (1.0 - xi * xi * eta * eta)];
        for (i, at_centre) in [(0, -0.25), (1, -0.25), (2, -0.25), (3, -0.25), (5, 0.5), (6, 0.5), (8, 0.5), (10, 0.5)]
        {
            values[i] -= at_centre * values[13];
            derivatives[i] = [0, 1, 2].map(|d| derivatives[i][d] - at_centre * derivatives[13][d]);
        }
    }
    (values, derivatives)
}
