//! The rules, and products of them.

use super::line::{QuadraturePoint, gauss};
use super::simplex;
use std::sync::OnceLock;

/// An integration rule: `int f dxi deta dzeta ~ sum weight f(natural)`.
///
/// Triangles: Dunavant, Int. J. Numer. Methods Eng. 21 (1985) 1129, degrees 1, 2, 4 and 6. Tetrahedra:
/// Hammer and Stroud (1956), degree 2; Walkington (2000), 14 points, degree 5; Keast, Comput. Methods Appl.
/// Mech. Eng. 55 (1986) 339, 24 points, degree 6. Squares, cubes: products of Gauss-Legendre rules, n
/// points are exact to degree 2 n - 1 in each direction. Conical products (Stroud, Approximate
/// Calculation of Multiple Integrals (1971), section 2.5) of Gauss-Jacobi rules: n points a direction are
/// exact to degree 2 n - 1. Wedges: triangle times line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuadratureRule {
    /// Line, 4 points, degree 7.
    Line4,
    /// Triangle, 1 point, degree 1.
    Triangle1,
    /// Triangle, 3 interior points, degree 2.
    Triangle3,
    /// Triangle, 6 interior points, degree 4.
    Triangle6,
    /// Triangle, 12 interior points, degree 6.
    Triangle12,
    /// Square, 2 x 2 points, degree 3 in each direction.
    Square2,
    /// Square, 3 x 3 points, degree 5 in each direction.
    Square3,
    /// Square, 4 x 4 points, degree 7 in each direction.
    Square4,
    /// Tetrahedron, 1 point, degree 1.
    Tetrahedron1,
    /// Tetrahedron, 4 interior points, degree 2.
    Tetrahedron4,
    /// Tetrahedron, 14 interior points, degree 5.
    Tetrahedron14,
    /// Tetrahedron, 24 interior points, degree 6.
    Tetrahedron24,
    /// Tetrahedron, conical product of 4 x 4 x 4 points, degree 7.
    Tetrahedron64,
    /// Cube, 2 x 2 x 2 points, degree 3 in each direction.
    Cube2,
    /// Cube, 3 x 3 x 3 points, degree 5 in each direction.
    Cube3,
    /// Cube, 4 x 4 x 4 points, degree 7 in each direction.
    Cube4,
    /// Cube, 5 x 5 x 5 points, degree 9 in each direction.
    Cube5,
    /// Wedge, 3 triangle x 2 line points, degree 2 and 3.
    Wedge3x2,
    /// Wedge, 6 triangle x 3 line points, degree 4 and 5.
    Wedge6x3,
    /// Wedge, 12 triangle x 4 line points, degree 6 and 7.
    Wedge12x4,
    /// Wedge, 25 triangle (conical) x 5 line points, degree 9 and 9.
    Wedge25x5,
}

/// Number of rules: one more than the last.
const RULES: usize = QuadratureRule::Wedge25x5 as usize + 1;

static POINTS: [OnceLock<Vec<QuadraturePoint>>; RULES] = [const { OnceLock::new() }; RULES];

impl QuadratureRule {
    /// The points, in a fixed order; computed at the first call.
    pub fn points(self) -> &'static [QuadraturePoint] {
        POINTS[self as usize].get_or_init(|| self.build())
    }

    fn build(self) -> Vec<QuadraturePoint> {
        match self {
            Self::Line4 => product(&[origin()], 4, 0),
            Self::Triangle1 => vec![simplex::point([1.0 / 3.0, 1.0 / 3.0, 0.0], 0.5)],
            Self::Triangle3 => simplex::triangle_3(),
            Self::Triangle6 => simplex::triangle_6(),
            Self::Triangle12 => simplex::triangle_12(),
            Self::Square2 => square(2),
            Self::Square3 => square(3),
            Self::Square4 => square(4),
            Self::Tetrahedron1 => vec![simplex::point([0.25; 3], simplex::SIXTH)],
            Self::Tetrahedron4 => simplex::tetrahedron_4(),
            Self::Tetrahedron14 => simplex::tetrahedron_14(),
            Self::Tetrahedron24 => simplex::tetrahedron_24(),
            Self::Tetrahedron64 => simplex::conical_tetrahedron(4),
            Self::Cube2 => cube(2),
            Self::Cube3 => cube(3),
            Self::Cube4 => cube(4),
            Self::Cube5 => cube(5),
            Self::Wedge3x2 => product(&simplex::triangle_3(), 2, 2),
            Self::Wedge6x3 => product(&simplex::triangle_6(), 3, 2),
            Self::Wedge12x4 => product(&simplex::triangle_12(), 4, 2),
            Self::Wedge25x5 => product(&simplex::conical_triangle(5), 5, 2),
        }
    }
}

/// The one point that a product starts from.
const fn origin() -> QuadraturePoint {
    QuadraturePoint { natural: [0.0; 3], weight: 1.0 }
}

/// A rule times an n-point Gauss-Legendre rule in another direction.
pub(in crate::fe::element::continuum) fn product(
    base: &[QuadraturePoint],
    n: usize,
    direction: usize,
) -> Vec<QuadraturePoint> {
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
pub(in crate::fe::element::continuum) fn square(n: usize) -> Vec<QuadraturePoint> {
    product(&product(&[origin()], n, 0), n, 1)
}

/// n x n x n Gauss-Legendre points on [-1, 1]^3.
pub(in crate::fe::element::continuum) fn cube(n: usize) -> Vec<QuadraturePoint> {
    product(&square(n), n, 2)
}
