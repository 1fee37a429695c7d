//! Integration rules on the natural triangle and square.

/// A point of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadraturePoint {
    /// Natural coordinates (xi, eta).
    pub natural: [f64; 2],
    /// Weight; the weights of a rule sum to the natural area, 1/2 (triangle) or 4 (square).
    pub weight: f64,
}

/// An integration rule: `int f dxi deta ~ sum weight f(natural)`.
///
/// Triangles: Dunavant 1985, degrees 1, 2, 4 and 6 (the points of degree 4 and 6 refined to double precision by
/// Newton on the moment equations). Squares: products of Gauss-Legendre rules (Abramowitz and Stegun,
/// table 25.4), n points are exact to degree 2 n - 1 in each direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadratureRule(Points);

#[derive(Debug, Clone, Copy, PartialEq)]
enum Points {
    Triangle(&'static [QuadraturePoint]),
    Product(&'static [Gauss]),
}

/// One point of a rule on [-1, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gauss {
    pub(super) at: f64,
    pub(super) weight: f64,
}

impl QuadratureRule {
    /// Triangle, 1 point, degree 1.
    pub const TRIANGLE_1: Self = Self(Points::Triangle(&TRIANGLE_1));
    /// Triangle, 3 interior points, degree 2.
    pub const TRIANGLE_3: Self = Self(Points::Triangle(&TRIANGLE_3));
    /// Triangle, 6 interior points, degree 4.
    pub const TRIANGLE_6: Self = Self(Points::Triangle(&TRIANGLE_6));
    /// Triangle, 12 interior points, degree 6.
    pub const TRIANGLE_12: Self = Self(Points::Triangle(&TRIANGLE_12));
    /// Square, 2 x 2 points, degree 3 in each direction.
    pub const GAUSS_2X2: Self = Self(Points::Product(&GAUSS_2));
    /// Square, 3 x 3 points, degree 5 in each direction.
    pub const GAUSS_3X3: Self = Self(Points::Product(&GAUSS_3));
    /// Square, 4 x 4 points, degree 7 in each direction.
    pub const GAUSS_4X4: Self = Self(Points::Product(&GAUSS_4));

    /// The points, in a fixed order.
    pub fn points(self) -> impl Iterator<Item = QuadraturePoint> {
        let (triangle, line): (&[QuadraturePoint], &[Gauss]) = match self.0 {
            Points::Triangle(points) => (points, &[]),
            Points::Product(points) => (&[], points),
        };
        let square = line.iter().flat_map(move |a| {
            line.iter().map(move |b| QuadraturePoint {
                natural: [a.at, b.at],
                weight: a.weight * b.weight,
            })
        });
        triangle.iter().copied().chain(square)
    }
}

const fn point(xi: f64, eta: f64, weight: f64) -> QuadraturePoint {
    QuadraturePoint {
        natural: [xi, eta],
        weight,
    }
}

const fn gauss(at: f64, weight: f64) -> Gauss {
    Gauss { at, weight }
}

const THIRD: f64 = 1.0 / 3.0;
const SIXTH: f64 = 1.0 / 6.0;

static TRIANGLE_1: [QuadraturePoint; 1] = [point(THIRD, THIRD, 0.5)];

static TRIANGLE_3: [QuadraturePoint; 3] = [
    point(SIXTH, SIXTH, SIXTH),
    point(4.0 * SIXTH, SIXTH, SIXTH),
    point(SIXTH, 4.0 * SIXTH, SIXTH),
];

// Dunavant 1985, p = 4: two orbits of three points (A, B, B).
const A4: f64 = 0.108_103_018_168_070_23;
const B4: f64 = 0.445_948_490_915_964_9;
const W4: f64 = 0.111_690_794_839_005_74;
const A5: f64 = 0.816_847_572_980_458_5;
const B5: f64 = 0.091_576_213_509_770_74;
const W5: f64 = 0.054_975_871_827_660_935;

static TRIANGLE_6: [QuadraturePoint; 6] = [
    point(B4, B4, W4),
    point(A4, B4, W4),
    point(B4, A4, W4),
    point(B5, B5, W5),
    point(A5, B5, W5),
    point(B5, A5, W5),
];

// Dunavant 1985, p = 6: two orbits of three points (A, B, B) and one of six (C, D, E).
const A1: f64 = 0.501_426_509_658_179_1;
const B1: f64 = 0.249_286_745_170_910_42;
const W1: f64 = 0.058_393_137_863_189_68;
const A2: f64 = 0.873_821_971_016_995_5;
const B2: f64 = 0.063_089_014_491_502_23;
const W2: f64 = 0.025_422_453_185_103_41;
const C3: f64 = 0.053_145_049_844_816_95;
const D3: f64 = 0.310_352_451_033_784_4;
const E3: f64 = 0.636_502_499_121_398_6;
const W3: f64 = 0.041_425_537_809_186_79;

static TRIANGLE_12: [QuadraturePoint; 12] = [
    point(B1, B1, W1),
    point(A1, B1, W1),
    point(B1, A1, W1),
    point(B2, B2, W2),
    point(A2, B2, W2),
    point(B2, A2, W2),
    point(C3, D3, W3),
    point(D3, C3, W3),
    point(C3, E3, W3),
    point(E3, C3, W3),
    point(D3, E3, W3),
    point(E3, D3, W3),
];

static GAUSS_2: [Gauss; 2] = [
    gauss(-0.577_350_269_189_625_8, 1.0),
    gauss(0.577_350_269_189_625_8, 1.0),
];

static GAUSS_3: [Gauss; 3] = [
    gauss(-0.774_596_669_241_483_4, 5.0 / 9.0),
    gauss(0.0, 8.0 / 9.0),
    gauss(0.774_596_669_241_483_4, 5.0 / 9.0),
];

pub(super) static GAUSS_4: [Gauss; 4] = [
    gauss(-0.861_136_311_594_052_6, 0.347_854_845_137_453_9),
    gauss(-0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    gauss(0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    gauss(0.861_136_311_594_052_6, 0.347_854_845_137_453_9),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// `int xi^i eta^j` over the natural triangle: `i! j! / (i + j + 2)!`.
    fn triangle_moment(i: i32, j: i32) -> f64 {
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        factorial(i) * factorial(j) / factorial(i + j + 2)
    }

    /// The same over [-1, 1]^2.
    fn square_moment(i: i32, j: i32) -> f64 {
        let line = |n: i32| {
            if n % 2 == 0 {
                2.0 / f64::from(n + 1)
            } else {
                0.0
            }
        };
        line(i) * line(j)
    }

    fn error(rule: QuadratureRule, i: i32, j: i32, exact: f64) -> f64 {
        let sum: f64 = rule
            .points()
            .map(|p| p.weight * p.natural[0].powi(i) * p.natural[1].powi(j))
            .sum();
        (sum - exact).abs()
    }

    #[test]
    fn triangle_rules_are_exact_to_their_degree_and_no_further() {
        let rules = [
            (QuadratureRule::TRIANGLE_1, 1, 1),
            (QuadratureRule::TRIANGLE_3, 2, 3),
            (QuadratureRule::TRIANGLE_6, 4, 6),
            (QuadratureRule::TRIANGLE_12, 6, 12),
        ];
        for (rule, degree, count) in rules {
            assert_eq!(rule.points().count(), count);
            let worst = |total: i32| {
                (0..=total)
                    .map(|i| error(rule, i, total - i, triangle_moment(i, total - i)))
                    .fold(0.0, f64::max)
            };
            for total in 0..=degree {
                assert!(
                    worst(total) < 1e-16,
                    "{count} points, degree {total}: {}",
                    worst(total)
                );
            }
            assert!(
                worst(degree + 1) > 1e-7,
                "{count} points: {}",
                worst(degree + 1)
            );
        }
    }

    #[test]
    fn square_rules_are_exact_to_their_degree_and_no_further() {
        let rules = [
            (QuadratureRule::GAUSS_2X2, 3),
            (QuadratureRule::GAUSS_3X3, 5),
            (QuadratureRule::GAUSS_4X4, 7),
        ];
        for (rule, degree) in rules {
            for i in 0..=degree {
                for j in 0..=degree {
                    let found = error(rule, i, j, square_moment(i, j));
                    assert!(found < 1e-15, "degree {degree}, ({i}, {j}): {found}");
                }
            }
            let beyond = error(rule, degree + 1, 0, square_moment(degree + 1, 0));
            assert!(beyond > 1e-3, "degree {degree}: {beyond}");
        }
    }
}
