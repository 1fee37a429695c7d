//! Points of rules, and Gauss-Jacobi rules on [-1, 1], by Newton's method.

/// A point of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadraturePoint {
    /// Natural coordinates (xi, eta, zeta); zeros beyond the rule's dimension.
    pub natural: [f64; 3],
    /// Weight; the weights of a rule sum to the natural size: 2 (line), 1/2 (triangle), 4 (square),
    /// 1/6 (tetrahedron), 8 (cube), 1 (wedge).
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
