//! Small substructures for tests.

use crate::fe::assembly::SystemMatrices;
use crate::fe::model::HousingPartition;
use crate::numerics::linalg::{DenseMatrix, TripletBuilder};

/// Rod of unit springs and masses, free at both ends.
pub(super) fn rod(nodes: usize) -> SystemMatrices {
    let (mut k, mut m) = (TripletBuilder::new(nodes, nodes), TripletBuilder::new(nodes, nodes));
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
        ordering: None,
    }
}

/// The rod held by its first node.
pub(super) fn partition(nodes: usize) -> HousingPartition {
    let mut tie = TripletBuilder::new(1, 1);
    tie.add(0, 0, 1.0);
    HousingPartition { driven: vec![0], interior: (1..nodes).collect(), tie: tie.build(), mean: Box::default() }
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
        mean: Box::default(),
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

/// The rod held by every third node.
pub(super) fn every_third(nodes: usize) -> HousingPartition {
    let driven: Vec<usize> = (0..nodes).step_by(3).collect();
    let mut tie = TripletBuilder::new(driven.len(), driven.len());
    (0..driven.len()).for_each(|place| tie.add(place, place, 1.0));
    HousingPartition {
        interior: (0..nodes).filter(|node| node % 3 != 0).collect(),
        tie: tie.build(),
        mean: Box::default(),
        driven,
    }
}

/// Stiffness and mass of masses that are attached to an interface, neighbours joined by springs; `ground` holds the first.
pub(super) fn train(interface: usize, mass: f64, spring: f64, ground: f64) -> [DenseMatrix; 2] {
    let stiffness = DenseMatrix::from_fn(interface, interface, |row, column| {
        let ends = f64::from(u8::from(row > 0) + u8::from(row + 1 < interface));
        match row.abs_diff(column) {
            0 => spring * ends + if row == 0 { ground } else { 0.0 },
            1 => -spring,
            _ => 0.0,
        }
    });
    // every fifth one is heavy
    let mass = DenseMatrix::from_fn(interface, interface, |row, column| match (row == column, row % 5) {
        (true, 0) => mass,
        (true, _) => 0.1 * mass,
        _ => 0.0,
    });
    [stiffness, mass]
}
