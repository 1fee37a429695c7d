//! Quadrilaterals and hexahedra: products of linear functions, and serendipity.

use super::{ShapeDerivatives, ShapeValues};
use crate::fe::element::continuum::{ContinuumKind, MAX_NODES};

/// With `u_d = xi_d a_d` for a node at `a`, in D directions: linear `2^-D prod (1 + u_d)`; serendipity corner
/// `2^-D prod (1 + u_d) (sum u_d - D + 1)`; middle of an edge along m
/// `2^(1-D) (1 - xi_m^2) prod_(d != m) (1 + u_d)`.
pub(super) fn evaluate(kind: ContinuumKind, natural: [f64; 3]) -> (ShapeValues, ShapeDerivatives) {
    let dimension = kind.dimension();
    let quadratic = !kind.edges().is_empty();
    let mut values = [0.0; MAX_NODES];
    let mut derivatives = [[0.0; 3]; MAX_NODES];
    for (i, node) in kind.natural_nodes().iter().enumerate() {
        // one factor a direction, with its derivative
        let mut factors = [1.0; 3];
        let mut slopes = [0.0; 3];
        for d in 0..dimension {
            let middle = node[d].abs() < 0.5;
            (factors[d], slopes[d]) = if middle {
                (1.0 - natural[d] * natural[d], -2.0 * natural[d])
            } else {
                (0.5 * (1.0 + natural[d] * node[d]), 0.5 * node[d])
            };
        }
        let product: f64 = factors.iter().product();
        let along = |d: usize| slopes[d] * factors[(d + 1) % 3] * factors[(d + 2) % 3];
        values[i] = product;
        derivatives[i] = [along(0), along(1), along(2)];
        if quadratic && i < kind.corners() {
            let u: f64 = (0..dimension).map(|d| natural[d] * node[d]).sum();
            let taper = u - dimension as f64 + 1.0;
            values[i] = product * taper;
            for d in 0..dimension {
                derivatives[i][d] = along(d) * taper + product * node[d];
            }
        }
    }
    (values, derivatives)
}
