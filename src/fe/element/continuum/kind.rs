//! The continuum elements and what is known of each without coordinates.

/// Most nodes that a continuum element has.
pub const MAX_NODES: usize = 20;

/// A plane element with two displacements a node, or a solid one with three.
///
/// Natural coordinates (xi, eta, zeta): triangles and tetrahedra on the corner (0, 0, 0), (1, 0, 0), (0, 1, 0),
/// (0, 0, 1); quadrilaterals and hexahedra on [-1, 1] in each direction; wedges on the triangle in
/// (xi, eta) and [-1, 1] in zeta. Plane elements have zeta = 0.
///
/// Nodes are in gmsh's order (gmsh reference manual, "Node ordering"): corners, then the middle nodes in the
/// order of [`ContinuumKind::edges`]. Beware when reading other programs' meshes: their Tet10 swaps the last
/// two nodes, their Hex20 and Wedge15 order the edges layer by layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ContinuumKind {
    /// Plane triangle, three nodes, linear.
    Tri3,
    /// Plane triangle, six nodes, quadratic; edges may be curved.
    Tri6,
    /// Plane quadrilateral, four nodes, bilinear.
    Quad4,
    /// Plane quadrilateral, eight nodes, serendipity; edges may be curved.
    Quad8,
    /// Tetrahedron, four nodes, linear.
    Tet4,
    /// Tetrahedron, ten nodes, quadratic; edges may be curved.
    Tet10,
    /// Hexahedron, eight nodes, trilinear.
    Hex8,
    /// Hexahedron, twenty nodes, serendipity; edges may be curved.
    Hex20,
    /// Wedge (triangular prism), six nodes.
    Wedge6,
    /// Wedge, fifteen nodes, serendipity; edges may be curved.
    Wedge15,
}

type Edge = [usize; 2];

const TRIANGLE_EDGES: [Edge; 3] = [[0, 1], [1, 2], [2, 0]];
const QUADRILATERAL_EDGES: [Edge; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];
const TETRAHEDRON_EDGES: [Edge; 6] = [[0, 1], [1, 2], [2, 0], [3, 0], [3, 2], [3, 1]];
const HEXAHEDRON_EDGES: [Edge; 12] =
    [[0, 1], [0, 3], [0, 4], [1, 2], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 7], [5, 6], [6, 7]];
const WEDGE_EDGES: [Edge; 9] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [3, 5], [4, 5]];

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
const fn nodes<const CORNERS: usize, const N: usize>(corners: &[[f64; 3]], edges: &[Edge]) -> [[f64; 3]; N] {
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

static TRIANGLE: [[f64; 3]; 6] = nodes::<3, 6>(&TETRAHEDRON_CORNERS, &TRIANGLE_EDGES);
static QUADRILATERAL: [[f64; 3]; 8] = nodes::<4, 8>(&QUADRILATERAL_CORNERS, &QUADRILATERAL_EDGES);
static TETRAHEDRON: [[f64; 3]; 10] = nodes::<4, 10>(&TETRAHEDRON_CORNERS, &TETRAHEDRON_EDGES);
static HEXAHEDRON: [[f64; 3]; 20] = nodes::<8, 20>(&HEXAHEDRON_CORNERS, &HEXAHEDRON_EDGES);
static WEDGE: [[f64; 3]; 15] = nodes::<6, 15>(&WEDGE_CORNERS, &WEDGE_EDGES);

impl ContinuumKind {
    /// Every continuum element.
    pub const ALL: [Self; 10] = [
        Self::Tri3,
        Self::Tri6,
        Self::Quad4,
        Self::Quad8,
        Self::Tet4,
        Self::Tet10,
        Self::Hex8,
        Self::Hex20,
        Self::Wedge6,
        Self::Wedge15,
    ];

    /// Name as in reports and errors.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tri3 => "Tri3",
            Self::Tri6 => "Tri6",
            Self::Quad4 => "Quad4",
            Self::Quad8 => "Quad8",
            Self::Tet4 => "Tet4",
            Self::Tet10 => "Tet10",
            Self::Hex8 => "Hex8",
            Self::Hex20 => "Hex20",
            Self::Wedge6 => "Wedge6",
            Self::Wedge15 => "Wedge15",
        }
    }

    /// Displacements a node: 2 for plane elements, 3 for solids.
    pub fn dimension(self) -> usize {
        match self {
            Self::Tri3 | Self::Tri6 | Self::Quad4 | Self::Quad8 => 2,
            _ => 3,
        }
    }

    /// Natural coordinates of the nodes, in gmsh's order; the third is 0 for plane elements.
    pub fn natural_nodes(self) -> &'static [[f64; 3]] {
        match self {
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

    /// The edges with a middle node, as their two corners; edge i carries node `corners() + i`.
    /// Empty for the linear elements.
    pub fn edges(self) -> &'static [[usize; 2]] {
        match self {
            Self::Tri6 => &TRIANGLE_EDGES,
            Self::Quad8 => &QUADRILATERAL_EDGES,
            Self::Tet10 => &TETRAHEDRON_EDGES,
            Self::Hex20 => &HEXAHEDRON_EDGES,
            Self::Wedge15 => &WEDGE_EDGES,
            _ => &[],
        }
    }

    /// Number of nodes.
    pub fn nodes(self) -> usize {
        self.natural_nodes().len()
    }

    /// Number of corner nodes, the first in the order.
    pub fn corners(self) -> usize {
        self.nodes() - self.edges().len()
    }

    /// Number of degrees of freedom: [`ContinuumKind::dimension`] a node.
    pub(crate) fn dof(self) -> usize {
        self.dimension() * self.nodes()
    }

    /// Triangle or tetrahedron: with straight edges its Jacobian is constant.
    pub(super) fn is_simplex(self) -> bool {
        matches!(self, Self::Tri3 | Self::Tri6 | Self::Tet4 | Self::Tet10)
    }
}
