//! Which formulation an element uses, and which rule integrates what.

use super::QuadratureRule;
use crate::fe::mesh::ElementKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The choices that an element's stiffness leaves open; the default is [`Integration::Full`] with
/// [`LinearFormulation::Incompatible`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize)]
pub struct Formulation {
    /// Stiffness of Tet10.
    pub integration: Integration,
    /// Stiffness of Quad4 and Hex8.
    pub linear: LinearFormulation,
}

impl Formulation {
    /// Whether an element of this kind has incompatible modes.
    pub(crate) fn bubbles(self, kind: ElementKind) -> bool {
        self.linear == LinearFormulation::Incompatible && matches!(kind, ElementKind::Quad4 | ElementKind::Hex8)
    }
}

/// How the stiffness of ten-noded tetrahedra is integrated; other elements are not touched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Integration {
    /// Exact for straight edges, converged for curved ones.
    #[default]
    Full,
    /// Four points, as most programs do: exact for straight edges only. The stiffness of curved elements is wrong in the third digit, and a
    /// curved patch fails the patch test (by 4e-5 with middle nodes moved by 1 % of the patch, measured).
    #[serde(rename = "4-point")]
    FourPoint,
}

/// How four-noded quadrilaterals and eight-noded hexahedra bend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LinearFormulation {
    /// With incompatible modes: a rectangle or box bends exactly. The element is no longer conforming, so that
    /// frequencies need not converge from above.
    #[default]
    Incompatible,
    /// The plain isoparametric element, which locks in bending: much too stiff.
    Plain,
}

impl ElementKind {
    /// The rule that integrates the mass and the measure, exact for every geometry, curved ones too:
    /// `N_i N_j det J` is a polynomial of degree
    /// 2 (Tri3, Tet4), 6 (Tri6), 7 (Tet10); in each direction 3 (Quad4), 7 (Quad8, Quad9), 4 (Hex8), 9 (Hex20, Hex27), with the
    /// square of a bubble 5 (Quad4) and in a box 4 (Hex8);
    /// 3 in the triangle and 4 along zeta (Wedge6), 8 and 9 (Wedge15, Wedge18). For pyramids it is one in xi, eta and s of
    /// their shape functions: of degree 3, 3 and 2 (Pyramid5), 9, 9 and 7 (Pyramid13, Pyramid14).
    pub(crate) fn mass_rule(self) -> QuadratureRule {
        self.rules()[1][0]
    }

    /// Rules of the stiffness and of the mass: that for any edges, and that which is exact if all edges are straight with
    /// their nodes in the middle. For the stiffness the latter is of degree 2 for Tri6 and Tet10, whose Jacobian is then
    /// constant. For the mass the Jacobian has the degree of the linear element's, which leaves 6 in each direction
    /// (Hex20, Hex27), 5 in the triangle and 6 along zeta (Wedge15, Wedge18), 5, 5 and 4 (Pyramid13, Pyramid14).
    ///
    /// The rule of the stiffness is exact for straight-edged triangles and tetrahedra, and for parallelograms, parallelepipeds, straight
    /// prisms and pyramids on parallelograms. Gradients in a Pyramid5 do not depend on s: one point along it is exact for any
    /// shape. In a Pyramid13 or Pyramid14 their products have the degrees 4, 4 and 2. `int dN/dx dV`, on which the patch test
    /// rests, has 5, 5 and 3 on any curved pyramid and is exact. Other curved and distorted elements have rational integrands, for which no rule is exact.
    /// Straight Tri6 and Tet10 take a cheaper one.
    ///
    /// Tri6 takes six points although three are exact for straight sides: on an annulus of 576 curved Tri6 the
    /// first 17 elastic frequencies agree with those of 64 points to 1e-9, three points are 4.5e-6 off
    /// (measured).
    ///
    /// Tet10 takes 24 points although four are exact for straight edges. Error of the stiffness of an element
    /// with three corners on a bore, its radial edge as long as the arc (norms, against 12^3 points of a
    /// conical product; measured):
    ///
    /// | points (degree) | 5 degrees an element | 10 degrees | 20 degrees |
    /// |---|---|---|---|
    /// | 4 (2) | 1.4e-3 | 2.8e-3 | 5.9e-3 |
    /// | 14 (5) | 5.3e-9 | 1.2e-7 | 3.6e-6 |
    /// | 24 (6) | 4.9e-11 | 2.3e-9 | 1.7e-7 |
    ///
    /// 27 points of a conical product (degree 5) are no better than 14. An element with a radial edge of 0.3 of
    /// the arc has 9.1e-7 at 10 degrees and 1.2e-4 at 20 with 24 points. Of the others, at 10 degrees: Tri6
    /// 3.1e-6, Quad8 2.9e-4, Quad9 9.1e-4, Hex20 2.6e-4, Hex27 9.5e-4, Wedge15 9.4e-5, Wedge18 4.1e-4, Pyramid13 1.3e-4, Pyramid14
    /// 4.7e-4.
    pub(super) fn rules(self) -> [[QuadratureRule; 2]; 2] {
        use QuadratureRule as Rule;
        match self {
            Self::Point | Self::Line2 | Self::Line3 => [[Rule::Line4; 2]; 2],
            Self::Tri3 => [[Rule::Triangle1; 2], [Rule::Triangle3; 2]],
            Self::Tri6 => [[Rule::Triangle6, Rule::Triangle3], [Rule::Triangle12; 2]],
            Self::Quad4 => [[Rule::Square2; 2], [Rule::Square3; 2]],
            Self::Quad8 | Self::Quad9 => [[Rule::Square3; 2], [Rule::Square4; 2]],
            Self::Tet4 => [[Rule::Tetrahedron1; 2], [Rule::Tetrahedron4; 2]],
            Self::Tet10 => [[Rule::Tetrahedron24, Rule::Tetrahedron4], [Rule::Tetrahedron64; 2]],
            Self::Hex8 => [[Rule::Cube2; 2], [Rule::Cube3; 2]],
            Self::Hex20 | Self::Hex27 => [[Rule::Cube3; 2], [Rule::Cube5, Rule::Cube4]],
            Self::Wedge6 => [[Rule::Wedge3x2; 2], [Rule::Wedge6x3; 2]],
            Self::Wedge15 | Self::Wedge18 => [[Rule::Wedge6x3; 2], [Rule::Wedge25x5, Rule::Wedge12x4]],
            Self::Pyramid5 => [[Rule::Pyramid2x1; 2], [Rule::Pyramid2x2; 2]],
            Self::Pyramid13 | Self::Pyramid14 => [[Rule::Pyramid3x2; 2], [Rule::Pyramid5x4, Rule::Pyramid3x3]],
        }
    }
}
