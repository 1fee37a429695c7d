//! The plane elements and what is known of each without coordinates.

use super::QuadratureRule;

/// Most nodes that a plane element has.
pub const MAX_NODES: usize = 8;

/// A plane element with two displacements a node.
///
/// Natural coordinates (xi, eta): triangles on (0,0), (1,0), (0,1); quadrilaterals on [-1, 1]^2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PlaneKind {
    /// Three nodes, linear.
    Tri3,
    /// Six nodes, quadratic; edges may be curved.
    Tri6,
    /// Four nodes, bilinear, plain (no incompatible modes).
    Quad4,
    /// Eight nodes, serendipity; edges may be curved.
    Quad8,
}

const TRIANGLE: [[f64; 2]; 6] = [
    [0.0, 0.0],
    [1.0, 0.0],
    [0.0, 1.0],
    [0.5, 0.0],
    [0.5, 0.5],
    [0.0, 0.5],
];
const QUADRILATERAL: [[f64; 2]; 8] = [
    [-1.0, -1.0],
    [1.0, -1.0],
    [1.0, 1.0],
    [-1.0, 1.0],
    [0.0, -1.0],
    [1.0, 0.0],
    [0.0, 1.0],
    [-1.0, 0.0],
];

impl PlaneKind {
    /// Every plane element.
    pub const ALL: [Self; 4] = [Self::Tri3, Self::Tri6, Self::Quad4, Self::Quad8];

    /// Name as in reports and errors.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tri3 => "Tri3",
            Self::Tri6 => "Tri6",
            Self::Quad4 => "Quad4",
            Self::Quad8 => "Quad8",
        }
    }

    /// Natural coordinates of the nodes, in gmsh's order.
    pub fn natural_nodes(self) -> &'static [[f64; 2]] {
        match self {
            Self::Tri3 => &TRIANGLE[..3],
            Self::Tri6 => &TRIANGLE,
            Self::Quad4 => &QUADRILATERAL[..4],
            Self::Quad8 => &QUADRILATERAL,
        }
    }

    /// Number of nodes.
    pub fn nodes(self) -> usize {
        self.natural_nodes().len()
    }

    /// Number of degrees of freedom, two a node.
    pub fn dof(self) -> usize {
        2 * self.nodes()
    }

    /// The rule that integrates the stiffness.
    ///
    /// Exact for straight-sided triangles and for parallelograms; curved Tri6 and distorted
    /// quadrilaterals have rational integrands, for which no rule is exact. Tri6 takes six points although
    /// three are exact for straight sides: on an annulus of 576 curved Tri6 the first 17 elastic
    /// frequencies agree with those of 64 points to 1e-9, three points are 4.5e-6 off (measured).
    pub fn stiffness_rule(self) -> QuadratureRule {
        match self {
            Self::Tri3 => QuadratureRule::TRIANGLE_1,
            Self::Tri6 => QuadratureRule::TRIANGLE_6,
            Self::Quad4 => QuadratureRule::GAUSS_2X2,
            Self::Quad8 => QuadratureRule::GAUSS_3X3,
        }
    }

    /// The rule that integrates the mass and the area, exact for every geometry, curved ones too:
    /// `N_i N_j det J` is a polynomial of degree 2 (Tri3), 6 (Tri6), 3 in each direction (Quad4) and
    /// 7 in each direction (Quad8).
    pub fn mass_rule(self) -> QuadratureRule {
        match self {
            Self::Tri3 => QuadratureRule::TRIANGLE_3,
            Self::Tri6 => QuadratureRule::TRIANGLE_12,
            Self::Quad4 => QuadratureRule::GAUSS_2X2,
            Self::Quad8 => QuadratureRule::GAUSS_4X4,
        }
    }
}
