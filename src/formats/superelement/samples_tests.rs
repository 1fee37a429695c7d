//! A superelement for tests.

use std::f64::consts::TAU;

use super::{FieldRecovery, SensorRow, SuperelementRecord};
use crate::formats::{DofBody, DofDirection, DofLabel};
use crate::numerics::linalg::DenseMatrix;

pub(crate) fn dense<const N: usize>(rows: &[[f64; N]]) -> DenseMatrix {
    DenseMatrix::from_fn(rows.len(), N, |row, column| rows[row][column])
}

/// Two interface displacements of node 7, two modes, everything that there can be.
pub(crate) fn record() -> SuperelementRecord {
    let label = |axis: usize| DofLabel {
        body: DofBody::Housing,
        node: 7,
        direction: DofDirection::Along(axis),
        position: [0.1, 0.2, 1.0 / 3.0],
        axis: [0, 1, 2].map(|own| if own == axis { 1.0 } else { 0.0 }),
    };
    let stiffness = dense(&[[3e8, -1e7, 0.0, 0.0], [-1e7, 2e8, 0.0, 0.0], [0.0, 0.0, 4e6, 0.0], [0.0, 0.0, 0.0, 9e6]]);
    let mass = dense(&[[1.5, 0.25, 0.3, -0.1], [0.25, 1.25, 0.2, 0.4], [0.3, 0.2, 1.0, 0.0], [-0.1, 0.4, 0.0, 1.0]]);
    SuperelementRecord {
        damping: Some(DenseMatrix::from_fn(4, 4, |i, j| 1e-5 * stiffness[(i, j)])),
        structural: Some(DenseMatrix::from_fn(4, 4, |i, j| 2e-2 * stiffness[(i, j)])),
        stiffness,
        mass,
        interface: vec![label(0), label(2)],
        interface_recovery: None,
        modal_hz: vec![2e3 / TAU, 3e3 / TAU],
        band_hz: Some(250.0),
        complete_hz: Some(310.0),
        outer_radius: Some(0.031),
        weight: Some(dense(&[[1.5, 0.0, 0.25], [0.25, 0.0, 1.25], [0.3, 0.5, 0.2], [-0.1, 0.1, 0.4]])),
        sensors: vec![
            SensorRow { name: "foot".to_owned(), row: vec![0.0, 0.5, 0.25, -0.125] },
            SensorRow { name: "Lager 2, außen".to_owned(), row: vec![1.0, 0.0, 0.0, 1.0 / 3.0] },
        ],
        field: Some(FieldRecovery {
            node_tags: vec![7, 120_000],
            positions: vec![[0.1, 0.2, 1.0 / 3.0], [0.0, -0.5, 2.0]],
            recovery: DenseMatrix::from_fn(6, 4, |i, j| match (i, j) {
                (0, 0) | (2, 1) => 1.0,
                (3.., _) => 0.1 * i as f64 - 0.03 * j as f64,
                _ => 0.0,
            }),
        }),
    }
}
