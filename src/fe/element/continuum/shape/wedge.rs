//! Wedges: triangle times line.

use super::simplex::{barycentric, gradient};
use super::{ShapeDerivatives, ShapeValues};
use crate::fe::element::continuum::{ContinuumKind, MAX_NODES};

/// A function of the triangle and its gradient there.
type OnTriangle = (f64, [f64; 3]);
/// A function of zeta and its derivative.
type OnLine = (f64, f64);

/// With `z = +-1` the layer of a corner: linear `L_i (1 + z zeta) / 2`; serendipity corner
/// `L_i (2 L_i - 1)(1 + z zeta) / 2 - L_i (1 - zeta^2) / 2`, middle of a triangle's edge
/// `4 L_a L_b (1 + z zeta) / 2`, middle of an upright edge `L_i (1 - zeta^2)`.
pub(super) fn evaluate(kind: ContinuumKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
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
    let quadratic = !kind.edges().is_empty();
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
    for (&[a, b], i) in kind.edges().iter().zip(6..) {
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
