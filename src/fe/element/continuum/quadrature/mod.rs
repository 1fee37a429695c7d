//! Integration rules on the natural elements.

mod line;
mod simplex;
#[cfg(test)]
mod tests;

use std::sync::OnceLock;

pub(super) use line::gauss;
#[cfg(test)]
pub(super) use simplex::{conical_tetrahedron, conical_triangle};

/// A point of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadraturePoint {
    /// Natural coordinates (xi, eta, zeta); zeros beyond the rule's dimension.
    pub natural: [f64; 3],
    /// Weight; the weights of a rule sum to the natural size: 2 (line), 1/2 (triangle), 4 (square),
    /// 1/6 (tetrahedron), 8 (cube), 1 (wedge).
    pub weight: f64,
}

/// An integration rule: `int f dxi deta dzeta ~ sum weight f(natural)`.
///
/// Triangles: Dunavant, Int. J. Numer. Methods Eng. 21 (1985) 1129, degrees 1, 2, 4 and 6. Tetrahedra:
/// Hammer and Stroud (1956), degree 2; Walkington (2000), 14 points, degree 5; Keast, Comput. Methods Appl.
/// Mech. Eng. 55 (1986) 339, 24 points, degree 6. Squares, cubes: products of Gauss-Legendre rules, n
/// points are exact to degree 2 n - 1 in each direction. Conical products (Stroud, Approximate
/// Calculation of Multiple Integrals (1971), section 2.5) of Gauss-Jacobi rules: n points a direction are
/// exact to degree 2 n - 1. Wedges: triangle times line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct QuadratureRule(Rule);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rule {
    Line4,
    Triangle1,
    Triangle3,
    Triangle6,
    Triangle12,
    Square2,
    Square3,
    Square4,
    Tetrahedron1,
    Tetrahedron4,
    Tetrahedron14,
    Tetrahedron24,
    TetrahedronConical4,
    Cube2,
    Cube3,
    Cube4,
    Cube5,
    Wedge3x2,
    Wedge6x3,
    Wedge12x4,
    WedgeConical5,
}

/// One more than the last of [`Rule`].
const RULES: usize = Rule::WedgeConical5 as usize + 1;

static POINTS: [OnceLock<Vec<QuadraturePoint>>; RULES] = [const { OnceLock::new() }; RULES];

impl QuadratureRule {
    /// Line, 4 points, degree 7.
    pub const LINE_4: Self = Self(Rule::Line4);
    /// Triangle, 1 point, degree 1.
    pub const TRIANGLE_1: Self = Self(Rule::Triangle1);
    /// Triangle, 3 interior points, degree 2.
    pub const TRIANGLE_3: Self = Self(Rule::Triangle3);
    /// Triangle, 6 interior points, degree 4.
    pub const TRIANGLE_6: Self = Self(Rule::Triangle6);
    /// Triangle, 12 interior points, degree 6.
    pub const TRIANGLE_12: Self = Self(Rule::Triangle12);
    /// Square, 2 x 2 points, degree 3 in each direction.
    pub const SQUARE_2X2: Self = Self(Rule::Square2);
    /// Square, 3 x 3 points, degree 5 in each direction.
    pub const SQUARE_3X3: Self = Self(Rule::Square3);
    /// Square, 4 x 4 points, degree 7 in each direction.
    pub const SQUARE_4X4: Self = Self(Rule::Square4);
    /// Tetrahedron, 1 point, degree 1.
    pub const TETRAHEDRON_1: Self = Self(Rule::Tetrahedron1);
    /// Tetrahedron, 4 interior points, degree 2.
    pub const TETRAHEDRON_4: Self = Self(Rule::Tetrahedron4);
    /// Tetrahedron, 14 interior points, degree 5.
    pub const TETRAHEDRON_14: Self = Self(Rule::Tetrahedron14);
    /// Tetrahedron, 24 interior points, degree 6.
    pub const TETRAHEDRON_24: Self = Self(Rule::Tetrahedron24);
    /// Tetrahedron, conical product of 4 x 4 x 4 points, degree 7.
    pub const TETRAHEDRON_64: Self = Self(Rule::TetrahedronConical4);
    /// Cube, 2 x 2 x 2 points, degree 3 in each direction.
    pub const CUBE_2X2X2: Self = Self(Rule::Cube2);
    /// Cube, 3 x 3 x 3 points, degree 5 in each direction.
    pub const CUBE_3X3X3: Self = Self(Rule::Cube3);
    /// Cube, 4 x 4 x 4 points, degree 7 in each direction.
    pub const CUBE_4X4X4: Self = Self(Rule::Cube4);
    /// Cube, 5 x 5 x 5 points, degree 9 in each direction.
    pub const CUBE_5X5X5: Self = Self(Rule::Cube5);
    /// Wedge, 3 triangle x 2 line points, degree 2 and 3.
    pub const WEDGE_3X2: Self = Self(Rule::Wedge3x2);
    /// Wedge, 6 triangle x 3 line points, degree 4 and 5.
    pub const WEDGE_6X3: Self = Self(Rule::Wedge6x3);
    /// Wedge, 12 triangle x 4 line points, degree 6 and 7.
    pub const WEDGE_12X4: Self = Self(Rule::Wedge12x4);
    /// Wedge, 25 triangle (conical) x 5 line points, degree 9 and 9.
    pub const WEDGE_25X5: Self = Self(Rule::WedgeConical5);

    /// The points, in a fixed order; computed at the first call.
    pub fn points(self) -> &'static [QuadraturePoint] {
        POINTS[self.0 as usize].get_or_init(|| self.0.build())
    }
}

impl Rule {
    fn build(self) -> Vec<QuadraturePoint> {
        match self {
            Self::Line4 => product(&[origin()], 4, 0),
            Self::Triangle1 => simplex::triangle_1(),
            Self::Triangle3 => simplex::triangle_3(),
            Self::Triangle6 => simplex::triangle_6(),
            Self::Triangle12 => simplex::triangle_12(),
            Self::Square2 => square(2),
            Self::Square3 => square(3),
            Self::Square4 => square(4),
            Self::Tetrahedron1 => simplex::tetrahedron_1(),
            Self::Tetrahedron4 => simplex::tetrahedron_4(),
            Self::Tetrahedron14 => simplex::tetrahedron_14(),
            Self::Tetrahedron24 => simplex::tetrahedron_24(),
            Self::TetrahedronConical4 => simplex::conical_tetrahedron(4),
            Self::Cube2 => cube(2),
            Self::Cube3 => cube(3),
            Self::Cube4 => cube(4),
            Self::Cube5 => cube(5),
            Self::Wedge3x2 => product(&simplex::triangle_3(), 2, 2),
            Self::Wedge6x3 => product(&simplex::triangle_6(), 3, 2),
            Self::Wedge12x4 => product(&simplex::triangle_12(), 4, 2),
            Self::WedgeConical5 => product(&simplex::conical_triangle(5), 5, 2),
        }
    }
}

/// The one point that a product starts from.
const fn origin() -> QuadraturePoint {
    QuadraturePoint { natural: [0.0; 3], weight: 1.0 }
}

/// A rule times an n-point Gauss-Legendre rule in another direction.
pub(super) fn product(base: &[QuadraturePoint], n: usize, direction: usize) -> Vec<QuadraturePoint> {
    let line = gauss(n, 0);
    let along = |point: &QuadraturePoint| {
        let point = *point;
        line.clone().into_iter().map(move |g| {
            let mut natural = point.natural;
            natural[direction] = g.at;
            QuadraturePoint { natural, weight: point.weight * g.weight }
        })
    };
    base.iter().flat_map(along).collect()
}

/// n x n Gauss-Legendre points on [-1, 1]^2.
pub(super) fn square(n: usize) -> Vec<QuadraturePoint> {
    product(&product(&[origin()], n, 0), n, 1)
}

/// n x n x n Gauss-Legendre points on [-1, 1]^3.
pub(super) fn cube(n: usize) -> Vec<QuadraturePoint> {
    product(&square(n), n, 2)
}
