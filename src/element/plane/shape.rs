//! Shape functions and their derivatives with respect to the natural coordinates.
//!
//! Fixed-size arrays, zero beyond the element's nodes: nothing is allocated in an assembly loop.
//! Source: Bathe, figures 5.4 (quadrilaterals) and 5.11 (triangles).

use super::{MAX_NODES, PlaneKind};

/// `N_i` at a point; entries beyond the element's nodes are zero.
pub type ShapeValues = [f64; MAX_NODES];

/// `[dN_i/dxi, dN_i/deta]` at a point; entries beyond the element's nodes are zero.
pub type ShapeDerivatives = [[f64; 2]; MAX_NODES];

/// Shape functions `N_i(xi, eta)`, dimensionless: 1 at node i, 0 at the others, sum 1.
pub fn shape_values(kind: PlaneKind, [xi, eta]: [f64; 2]) -> ShapeValues {
    let mut values = [0.0; MAX_NODES];
    match kind {
        PlaneKind::Tri3 => values[..3].copy_from_slice(&[1.0 - xi - eta, xi, eta]),
        PlaneKind::Tri6 => {
            let zeta = 1.0 - xi - eta;
            values[..6].copy_from_slice(&[
                zeta * (2.0 * zeta - 1.0),
                xi * (2.0 * xi - 1.0),
                eta * (2.0 * eta - 1.0),
                4.0 * zeta * xi,
                4.0 * xi * eta,
                4.0 * eta * zeta,
            ]);
        }
        PlaneKind::Quad4 => {
            for (value, node) in values.iter_mut().zip(kind.natural_nodes()) {
                *value = 0.25 * (1.0 + xi * node[0]) * (1.0 + eta * node[1]);
            }
        }
        PlaneKind::Quad8 => {
            for (value, &[a, b]) in values.iter_mut().zip(kind.natural_nodes()) {
                let (u, v) = (xi * a, eta * b);
                *value = match middle_of(a, b) {
                    Edge::Corner => 0.25 * (1.0 + u) * (1.0 + v) * (u + v - 1.0),
                    Edge::AlongXi => 0.5 * (1.0 - xi * xi) * (1.0 + v),
                    Edge::AlongEta => 0.5 * (1.0 + u) * (1.0 - eta * eta),
                };
            }
        }
    }
    values
}

/// Derivatives `dN_i/dxi`, `dN_i/deta` at (xi, eta), dimensionless; their sums are zero.
pub fn shape_derivatives(kind: PlaneKind, [xi, eta]: [f64; 2]) -> ShapeDerivatives {
    let mut derivatives = [[0.0; 2]; MAX_NODES];
    match kind {
        PlaneKind::Tri3 => {
            derivatives[..3].copy_from_slice(&[[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]]);
        }
        PlaneKind::Tri6 => {
            let zeta = 1.0 - xi - eta;
            let first = 1.0 - 4.0 * zeta;
            derivatives[..6].copy_from_slice(&[
                [first, first],
                [4.0 * xi - 1.0, 0.0],
                [0.0, 4.0 * eta - 1.0],
                [4.0 * (zeta - xi), -4.0 * xi],
                [4.0 * eta, 4.0 * xi],
                [-4.0 * eta, 4.0 * (zeta - eta)],
            ]);
        }
        PlaneKind::Quad4 => {
            for (derivative, &[a, b]) in derivatives.iter_mut().zip(kind.natural_nodes()) {
                *derivative = [0.25 * a * (1.0 + eta * b), 0.25 * b * (1.0 + xi * a)];
            }
        }
        PlaneKind::Quad8 => {
            for (derivative, &[a, b]) in derivatives.iter_mut().zip(kind.natural_nodes()) {
                let (u, v) = (xi * a, eta * b);
                *derivative = match middle_of(a, b) {
                    Edge::Corner => [
                        0.25 * a * (1.0 + v) * (2.0 * u + v),
                        0.25 * b * (1.0 + u) * (u + 2.0 * v),
                    ],
                    Edge::AlongXi => [-xi * (1.0 + v), 0.5 * b * (1.0 - xi * xi)],
                    Edge::AlongEta => [0.5 * a * (1.0 - eta * eta), -eta * (1.0 + u)],
                };
            }
        }
    }
    derivatives
}

/// Where a Quad8 node sits.
enum Edge {
    Corner,
    AlongXi,
    AlongEta,
}

/// Corners are at (+-1, +-1), the others have one coordinate 0.
fn middle_of(a: f64, b: f64) -> Edge {
    if a.abs() < 0.5 {
        Edge::AlongXi
    } else if b.abs() < 0.5 {
        Edge::AlongEta
    } else {
        Edge::Corner
    }
}
