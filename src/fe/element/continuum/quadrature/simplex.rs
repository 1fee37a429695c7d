//! Rules on the natural triangle and tetrahedron.

use super::line::{Gauss, QuadraturePoint, gauss};

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
