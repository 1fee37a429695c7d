//! Small substructures for tests.

use crate::assembly::SystemMatrices;
use crate::linalg::{DenseMatrix, TripletBuilder};
use crate::model::HousingPartition;

/// Rod of unit springs and masses, free at both ends.
pub(super) fn rod(nodes: usize) -> SystemMatrices {
    let (mut k, mut m) = (
        TripletBuilder::new(nodes, nodes),
        TripletBuilder::new(nodes, nodes),
    );
    for node in 0..nodes {
        m.add(node, node, 1.0);
        if node + 1 < nodes {
            for (row, column, value) in [(0, 0, 1.0), (1, 1, 1.0), (0, 1, -1.0), (1, 0, -1.0)] {
                k.add(node + row, node + column, value);
            }
        }
    }
    SystemMatrices {
        stiffness: k.build(),
        mass: m.build(),
        weight: DenseMatrix::from_fn(nodes, 2, |_, axis| f64::from(u8::from(axis == 0))),
        total_mass: nodes as f64,
    }
}

/// The rod held by its first node.
pub(super) fn partition(nodes: usize) -> HousingPartition {
    let mut tie = TripletBuilder::new(1, 1);
    tie.add(0, 0, 1.0);
    HousingPartition {
        driven: vec![0],
        interior: (1..nodes).collect(),
        tie: tie.build(),
    }
}

/// The rod held by both ends.
pub(super) fn both_ends(nodes: usize) -> HousingPartition {
    let mut tie = TripletBuilder::new(2, 2);
    tie.add(0, 0, 1.0);
    tie.add(1, 1, 1.0);
    HousingPartition {
        driven: vec![0, nodes - 1],
        interior: (1..nodes - 1).collect(),
        tie: tie.build(),
    }
}

/// The rod with a spring to the ground at its middle.
pub(super) fn grounded_rod(nodes: usize, spring: f64) -> SystemMatrices {
    let mut rod = rod(nodes);
    let mut ground = TripletBuilder::new(nodes, nodes);
    ground.add(nodes / 2, nodes / 2, spring);
    rod.stiffness = &rod.stiffness + &ground.build();
    rod
}
