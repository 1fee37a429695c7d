//! Natural coordinates of the nodes, shape functions and their derivatives with respect to the natural coordinates.
//!
//! Fixed-size arrays, zero beyond the element's nodes; the assembly loop reads them from tables made
//! once a kind. Sources: Bathe, Finite Element Procedures (1996), figures 5.4, 5.5 (quadrilaterals,
//! hexahedra), 5.11 and 5.13 (triangles, tetrahedra); Zienkiewicz and Taylor, The Finite Element Method,
//! volume 1 (2000), section 8.12 (wedges).

use crate::fe::mesh::ElementKind;

/// Most nodes that an element has.
pub const MAX_NODES: usize = 20;

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

/// Corners (the first of `corners` up to `CORNERS`), then the middle of each edge.
const fn nodes<const CORNERS: usize, const N: usize>(corners: &[[f64; 3]], edges: &[[usize; 2]]) -> [[f64; 3]; N] {
    let mut nodes = [[0.0; 3]; N];
    let mut i = 0;
    while i < N {
        let [a, b] = if i < CORNERS { [i, i] } else { edges[i - CORNERS] };
        let mut d = 0;
        while d < 3 {
            nodes[i][d] = 0.5 * (corners[a][d] + corners[b][d]);
            d += 1;
        }
        i += 1;
    }
    nodes
}

static TRIANGLE: [[f64; 3]; 6] = nodes::<3, 6>(&TETRAHEDRON_CORNERS, ElementKind::Tri6.middle_edges());
static QUADRILATERAL: [[f64; 3]; 8] = nodes::<4, 8>(&QUADRILATERAL_CORNERS, ElementKind::Quad8.middle_edges());
static TETRAHEDRON: [[f64; 3]; 10] = nodes::<4, 10>(&TETRAHEDRON_CORNERS, ElementKind::Tet10.middle_edges());
static HEXAHEDRON: [[f64; 3]; 20] = nodes::<8, 20>(&HEXAHEDRON_CORNERS, ElementKind::Hex20.middle_edges());
static WEDGE: [[f64; 3]; 15] = nodes::<6, 15>(&WEDGE_CORNERS, ElementKind::Wedge15.middle_edges());

impl ElementKind {
    /// Natural coordinates (xi, eta, zeta) of the nodes, in gmsh's order; zero beyond the element's dimension.
    ///
    /// Triangles and tetrahedra stand on the corner (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1); lines, quadrilaterals and
    /// hexahedra on [-1, 1] in each direction; wedges on the triangle in (xi, eta) and [-1, 1] in zeta. Beware when
    /// reading other programs' meshes: their Tet10 swaps the last two nodes, their Hex20 and Wedge15 order the edges
    /// layer by layer.
    pub fn natural_nodes(self) -> &'static [[f64; 3]] {
        match self {
            Self::Point => &LINE[2..],
            Self::Line2 => &LINE[..2],
            Self::Line3 => &LINE,
            Self::Tri3 => &TRIANGLE[..3],
            Self::Tri6 => &TRIANGLE,
            Self::Quad4 => &QUADRILATERAL[..4],
            Self::Quad8 => &QUADRILATERAL,
            Self::Tet4 => &TETRAHEDRON[..4],
            Self::Tet10 => &TETRAHEDRON,
            Self::Hex8 => &HEXAHEDRON[..8],
            Self::Hex20 => &HEXAHEDRON,
            Self::Wedge6 => &WEDGE[..6],
            Self::Wedge15 => &WEDGE,
        }
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
    use ElementKind::{Hex8, Hex20, Line2, Line3, Point, Quad4, Quad8, Tet4, Tet10, Tri3, Tri6, Wedge6, Wedge15};
    match kind {
        Point | Line2 | Line3 => on_line(kind, natural[0]),
        Tri3 | Tri6 | Tet4 | Tet10 => on_simplex(kind, natural),
        Quad4 | Quad8 | Hex8 | Hex20 => on_tensor_product(kind, natural),
        Wedge6 | Wedge15 => on_wedge(kind, natural),
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

/// Quadrilaterals and hexahedra: products of linear functions, and serendipity. With `u_d = xi_d a_d` for a node at `a`, in D directions:
/// linear `2^-D prod (1 + u_d)`; serendipity corner
/// `2^-D prod (1 + u_d) (sum u_d - D + 1)`; middle of an edge along m
/// `2^(1-D) (1 - xi_m^2) prod_(d != m) (1 + u_d)`.
fn on_tensor_product(kind: ElementKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    let dimension = kind.dimension();
    let quadratic = kind.order() == 2;
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
            } else {
                (0.5 * (1.0 + natural[d] * node[d]), 0.5 * node[d])
            };
        }
        let product: f64 = factors.iter().product();
        let along = |d: usize| slopes[d] * factors[(d + 1) % 3] * factors[(d + 2) % 3];
        values[i] = product;
        derivatives[i] = [along(0), along(1), along(2)];
        if quadratic && i < kind.corners() {
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
/// `4 L_a L_b (1 + z zeta) / 2`, middle of an upright edge `L_i (1 - zeta^2)`.
fn on_wedge(kind: ElementKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    let [xi, eta, zeta] = natural;
    let l = barycentric([xi, eta, 0.0]);
    let corner = |i: usize| -> OnTriangle { (l[i % 3], gradient(i % 3, 2)) };
    let layer = |i: usize| -> OnLine {
        let z = if i < 3 { -1.0 } else { 1.0 };
        (0.5 * (1.0 + z * zeta), 0.5 * z)
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
    let quadratic = kind.order() == 2;
    for i in 0..6 {
        let (value, slope) = corner(i);
        if quadratic {
            let curved = slope.map(|s| s * (4.0 * value - 1.0));
            add(i, 1.0, (value * (2.0 * value - 1.0), curved), layer(i));
            add(i, -0.5, (value, slope), bubble);
        } else {
            add(i, 1.0, (value, slope), layer(i));
        }
    }
    for (&[a, b], i) in kind.middle_edges().iter().zip(6..) {
        if b == a + 3 {
            add(i, 1.0, corner(a), bubble);
        } else {
            let ((p, to_p), (q, to_q)) = (corner(a), corner(b));
            let slope = [0, 1, 2].map(|d| p * to_q[d] + q * to_p[d]);
            add(i, 4.0, (p * q, slope), layer(a));
        }
    }
    (values, derivatives)
}
