//! Integration rules on the natural elements.
//!
//! The rules, and products of them.
//!
//! Points of rules, and Gauss-Jacobi rules on [-1, 1], by Newton's method.
//!
//! Rules on the natural triangle and tetrahedron.

use std::sync::OnceLock;

/// An integration rule: `int f dxi deta dzeta ~ sum weight f(natural)`.
///
/// Triangles: Dunavant, Int. J. Numer. Methods Eng. 21 (1985) 1129, degrees 1, 2, 4 and 6. Tetrahedra:
/// Hammer and Stroud (1956), degree 2; Walkington (2000), 14 points, degree 5; Keast, Comput. Methods Appl.
/// Mech. Eng. 55 (1986) 339, 24 points, degree 6. Squares, cubes: products of Gauss-Legendre rules, n
/// points are exact to degree 2 n - 1 in each direction. Conical products (Stroud, Approximate
/// Calculation of Multiple Integrals (1971), section 2.5) of Gauss-Jacobi rules: n points a direction are
/// exact to degree 2 n - 1. Wedges: triangle times line. Pyramids: conical products too, whose degrees are those in
/// `xi = x / (1 - z)`, `eta = y / (1 - z)` and z.
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
    /// Pyramid, 2 x 2 points across, 1 along z, degree 3 and 1.
    Pyramid2x1,
    /// Pyramid, 2 x 2 points across, 2 along z, degree 3 and 3.
    Pyramid2x2,
    /// Pyramid, 3 x 3 points across, 2 along z, degree 5 and 3.
    Pyramid3x2,
    /// Pyramid, 3 x 3 points across, 3 along z, degree 5 and 5.
    Pyramid3x3,
    /// Pyramid, 5 x 5 points across, 4 along z, degree 9 and 7.
    Pyramid5x4,
}

/// Number of rules: one more than the last.
const RULES: usize = QuadratureRule::Pyramid5x4 as usize + 1;

static POINTS: [OnceLock<Vec<QuadraturePoint>>; RULES] = [const { OnceLock::new() }; RULES];

impl QuadratureRule {
    /// The points, in a fixed order; computed at the first call.
    pub fn points(self) -> &'static [QuadraturePoint] {
        POINTS[self as usize].get_or_init(|| self.build())
    }

    fn build(self) -> Vec<QuadraturePoint> {
        match self {
            Self::Line4 => product(&[origin()], 4, 0),
            Self::Triangle1 => vec![point([1.0 / 3.0, 1.0 / 3.0, 0.0], 0.5)],
            Self::Triangle3 => triangle_3(),
            Self::Triangle6 => triangle_6(),
            Self::Triangle12 => triangle_12(),
            Self::Square2 => square(2),
            Self::Square3 => square(3),
            Self::Square4 => square(4),
            Self::Tetrahedron1 => vec![point([0.25; 3], SIXTH)],
            Self::Tetrahedron4 => tetrahedron_4(),
            Self::Tetrahedron14 => tetrahedron_14(),
            Self::Tetrahedron24 => tetrahedron_24(),
            Self::Tetrahedron64 => conical_tetrahedron(4),
            Self::Cube2 => cube(2),
            Self::Cube3 => cube(3),
            Self::Cube4 => cube(4),
            Self::Cube5 => cube(5),
            Self::Wedge3x2 => product(&triangle_3(), 2, 2),
            Self::Wedge6x3 => product(&triangle_6(), 3, 2),
            Self::Wedge12x4 => product(&triangle_12(), 4, 2),
            Self::Wedge25x5 => product(&conical_triangle(5), 5, 2),
            Self::Pyramid2x1 => conical_pyramid(2, 1),
            Self::Pyramid2x2 => conical_pyramid(2, 2),
            Self::Pyramid3x2 => conical_pyramid(3, 2),
            Self::Pyramid3x3 => conical_pyramid(3, 3),
            Self::Pyramid5x4 => conical_pyramid(5, 4),
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

/// A point of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadraturePoint {
    /// Natural coordinates (xi, eta, zeta); zeros beyond the rule's dimension.
    pub natural: [f64; 3],
    /// Weight; the weights of a rule sum to the natural size: 2 (line), 1/2 (triangle), 4 (square),
    /// 1/6 (tetrahedron), 8 (cube), 1 (wedge), 4/3 (pyramid).
    pub weight: f64,
}

/// One point of a rule on [-1, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fe::element::continuum) struct Gauss {
    pub(in crate::fe::element::continuum) at: f64,
    pub(in crate::fe::element::continuum) weight: f64,
}

/// `int (1 - x)^alpha f(x) dx ~ sum weight f(at)`, exact to degree 2 n - 1; alpha = 0 is Gauss-Legendre.
///
/// The points are the roots of the Jacobi polynomial `P_n^(alpha, 0)`, found one after the other with the
/// earlier ones divided out (Karniadakis and Sherwin, Spectral/hp Element Methods (2005), appendix B);
/// `weight = 2^(alpha + 1) / ((1 - x^2) P_n'(x)^2)` (Abramowitz and Stegun, 25.4.33 and 22.6).
pub(in crate::fe::element::continuum) fn gauss(n: usize, alpha: u32) -> Vec<Gauss> {
    let a = f64::from(alpha);
    let mut rule: Vec<Gauss> = Vec::with_capacity(n);
    for k in 0..n {
        let chebyshev = -(std::f64::consts::PI * (k as f64 + 0.5) / n as f64).cos();
        let mut x = rule.last().map_or(chebyshev, |last| 0.5 * (chebyshev + last.at));
        // Newton is quadratic near a root: the bound only ends a cycle between two roundings
        for _ in 0..50 {
            let (p, slope) = jacobi(n, a, x);
            let deflation: f64 = rule.iter().map(|root| 1.0 / (x - root.at)).sum();
            let step = p / (slope - p * deflation);
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        let slope = jacobi(n, a, x).1;
        let weight = (a + 1.0).exp2() / ((1.0 - x * x) * slope * slope);
        rule.push(Gauss { at: x, weight });
    }
    rule
}

/// `P_n^(a, 0)(x)` by its recurrence, and the derivative (Abramowitz and Stegun, 22.7.1 and 22.8.1).
fn jacobi(n: usize, a: f64, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, 0.5 * (a + (a + 2.0) * x));
    for k in 2..=n {
        let k = k as f64;
        let c = 2.0 * k + a;
        let up = 2.0 * k * (k + a) * (c - 2.0);
        let middle = (c - 1.0) * (c * (c - 2.0) * x + a * a);
        let down = 2.0 * (k + a - 1.0) * (k - 1.0) * c;
        (before, value) = (value, (middle * value - down * before) / up);
    }
    let n = n as f64;
    let c = 2.0 * n + a;
    let slope = (n * (a - c * x) * value + 2.0 * (n + a) * n * before) / (c * (1.0 - x * x));
    (value, slope)
}

pub(super) const SIXTH: f64 = 1.0 / 6.0;

pub(super) const fn point(natural: [f64; 3], weight: f64) -> QuadraturePoint {
    QuadraturePoint { natural, weight }
}

/// The three points with barycentric coordinates (1 - 2 b, b, b).
fn triangle_orbit_3(b: f64, weight: f64) -> [QuadraturePoint; 3] {
    let a = 1.0 - 2.0 * b;
    [[b, b, 0.0], [a, b, 0.0], [b, a, 0.0]].map(|natural| point(natural, weight))
}

/// The six points with barycentric coordinates (1 - d - e, d, e).
fn triangle_orbit_6(d: f64, e: f64, weight: f64) -> [QuadraturePoint; 6] {
    let c = 1.0 - d - e;
    [[c, d], [d, c], [c, e], [e, c], [d, e], [e, d]].map(|[x, y]| point([x, y, 0.0], weight))
}

pub(super) fn triangle_3() -> Vec<QuadraturePoint> {
    triangle_orbit_3(SIXTH, SIXTH).to_vec()
}

/// Dunavant 1985, p = 4, refined to double precision by Newton on the moment equations.
pub(super) fn triangle_6() -> Vec<QuadraturePoint> {
    [
        triangle_orbit_3(0.445_948_490_915_964_9, 0.111_690_794_839_005_74),
        triangle_orbit_3(0.091_576_213_509_770_74, 0.054_975_871_827_660_935),
    ]
    .concat()
}

/// Dunavant 1985, p = 6, refined likewise.
pub(super) fn triangle_12() -> Vec<QuadraturePoint> {
    let threes = [
        triangle_orbit_3(0.249_286_745_170_910_42, 0.058_393_137_863_189_68),
        triangle_orbit_3(0.063_089_014_491_502_23, 0.025_422_453_185_103_41),
    ];
    let six = triangle_orbit_6(0.310_352_451_033_784_4, 0.636_502_499_121_398_6, 0.041_425_537_809_186_79);
    [&threes.concat(), six.as_slice()].concat()
}

/// The four points with barycentric coordinates (1 - 3 b, b, b, b).
fn tetrahedron_orbit_4(b: f64, weight: f64) -> [QuadraturePoint; 4] {
    let a = 1.0 - 3.0 * b;
    [[b, b, b], [a, b, b], [b, a, b], [b, b, a]].map(|natural| point(natural, weight))
}

/// Hammer and Stroud 1956: b = (5 - sqrt 5) / 20.
pub(super) fn tetrahedron_4() -> Vec<QuadraturePoint> {
    tetrahedron_orbit_4((5.0 - 5.0_f64.sqrt()) / 20.0, 0.25 * SIXTH).to_vec()
}

/// Walkington 2000, 14 points, degree 5: two orbits of four and one of six, (b, b, c, c) with
/// c = 1/2 - b.
pub(super) fn tetrahedron_14() -> Vec<QuadraturePoint> {
    let fours = [
        tetrahedron_orbit_4(0.310_885_919_263_300_6, 0.112_687_925_718_015_85 * SIXTH),
        tetrahedron_orbit_4(0.092_735_250_310_891_23, 0.073_493_043_116_361_95 * SIXTH),
    ];
    let b = 0.045_503_704_125_649_65;
    let c = 0.5 - b;
    let six = [[b, b, c], [b, c, b], [c, b, b], [b, c, c], [c, b, c], [c, c, b]]
        .map(|natural| point(natural, 0.042_546_020_777_081_466 * SIXTH));
    [&fours.concat(), six.as_slice()].concat()
}

/// Keast 1986, 24 points, degree 6: three orbits of four and one of twelve, (b, b, d, e).
pub(super) fn tetrahedron_24() -> Vec<QuadraturePoint> {
    let fours = [
        tetrahedron_orbit_4(0.214_602_871_259_152, 0.006_653_791_709_694_6),
        tetrahedron_orbit_4(0.040_673_958_534_611_35, 0.001_679_535_175_886_77),
        tetrahedron_orbit_4(0.322_337_890_142_275_5, 0.009_226_196_923_942_4),
    ];
    let (b, d) = (0.063_661_001_875_017_53, 0.269_672_331_458_315_8);
    let e = 1.0 - 2.0 * b - d;
    let twelve = [
        [b, b, d],
        [b, d, b],
        [d, b, b],
        [b, b, e],
        [b, e, b],
        [e, b, b],
        [b, d, e],
        [b, e, d],
        [d, b, e],
        [e, b, d],
        [d, e, b],
        [e, d, b],
    ]
    .map(|natural| point(natural, 27.0 / 560.0 * SIXTH));
    [&fours.concat(), twelve.as_slice()].concat()
}

/// A Gauss-Jacobi rule moved to [0, 1]: `int (1 - u)^alpha f(u) du`.
fn unit_interval(n: usize, alpha: u32) -> Vec<Gauss> {
    let shrunk = |g: Gauss| Gauss { at: 0.5 * (1.0 + g.at), weight: g.weight / f64::from(alpha + 1).exp2() };
    gauss(n, alpha).into_iter().map(shrunk).collect()
}

/// Degree 2 n - 1: `xi = u, eta = (1 - u) v` takes the unit square to the triangle.
pub(in crate::fe::element::continuum) fn conical_triangle(n: usize) -> Vec<QuadraturePoint> {
    let mut points = Vec::with_capacity(n * n);
    for u in unit_interval(n, 1) {
        for v in unit_interval(n, 0) {
            let natural = [u.at, (1.0 - u.at) * v.at, 0.0];
            points.push(point(natural, u.weight * v.weight));
        }
    }
    points
}

/// Degree 2 n - 1: `xi = u, eta = (1 - u) v, zeta = (1 - u)(1 - v) w`.
pub(in crate::fe::element::continuum) fn conical_tetrahedron(n: usize) -> Vec<QuadraturePoint> {
    let mut points = Vec::with_capacity(n * n * n);
    for u in unit_interval(n, 2) {
        for v in unit_interval(n, 1) {
            for w in unit_interval(n, 0) {
                let rest = (1.0 - u.at) * (1.0 - v.at);
                let natural = [u.at, (1.0 - u.at) * v.at, rest * w.at];
                points.push(point(natural, u.weight * v.weight * w.weight));
            }
        }
    }
    points
}

/// n x n points across, m along the axis: `x = (1 - z) xi, y = (1 - z) eta` takes the cube to the pyramid, with the
/// Jacobian `(1 - z)^2`. Exact where the integrand is of degree 2 n - 1 in xi and in eta and of 2 m - 1 in z.
pub(in crate::fe::element::continuum) fn conical_pyramid(n: usize, m: usize) -> Vec<QuadraturePoint> {
    let along = unit_interval(m, 2);
    let at = |across: &QuadraturePoint, g: &Gauss| {
        let [xi, eta, _] = across.natural;
        point([(1.0 - g.at) * xi, (1.0 - g.at) * eta, g.at], across.weight * g.weight)
    };
    square(n).iter().flat_map(|across| along.iter().map(move |g| at(across, g))).collect()
}

#[cfg(test)]
mod tests;
