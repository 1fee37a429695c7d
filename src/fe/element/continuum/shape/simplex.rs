//! Triangles and tetrahedra, from barycentric coordinates.

use super::{ShapeDerivatives, ShapeValues};
use crate::fe::element::continuum::{ContinuumKind, MAX_NODES};

/// Barycentric coordinates `L_0 = 1 - xi - eta - zeta, L_1 = xi, L_2 = eta, L_3 = zeta`, and their gradients.
pub(super) fn barycentric([xi, eta, zeta]: [f64; 3]) -> [f64; 4] {
    [1.0 - xi - eta - zeta, xi, eta, zeta]
}

/// Gradient of `L_i` in `dimension` directions.
pub(super) fn gradient(i: usize, dimension: usize) -> [f64; 3] {
    let mut gradient = [0.0; 3];
    if i == 0 {
        gradient[..dimension].fill(-1.0);
    } else {
        gradient[i - 1] = 1.0;
    }
    gradient
}

/// Linear: `L_i`. Quadratic: `L_i (2 L_i - 1)` at a corner, `4 L_a L_b` at the middle of an edge.
pub(super) fn evaluate(kind: ContinuumKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    let dimension = kind.dimension();
    let l = barycentric(natural);
    let mut values = [0.0; MAX_NODES];
    let mut derivatives = [[0.0; 3]; MAX_NODES];
    let quadratic = !kind.edges().is_empty();
    for i in 0..kind.corners() {
        let (value, slope) = if quadratic {
            (l[i] * (2.0 * l[i] - 1.0), 4.0 * l[i] - 1.0)
        } else {
            (l[i], 1.0)
        };
        values[i] = value;
        derivatives[i] = gradient(i, dimension).map(|g| slope * g);
    }
    for (&[a, b], i) in kind.edges().iter().zip(kind.corners()..) {
        let (to_a, to_b) = (gradient(a, dimension), gradient(b, dimension));
        values[i] = 4.0 * l[a] * l[b];
        for d in 0..3 {
            derivatives[i][d] = 4.0 * (l[b] * to_a[d] + l[a] * to_b[d]);
        }
    }
    (values, derivatives)
}
