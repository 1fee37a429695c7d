//! A block with a ring tied to its corners; every count against the eigenvalues of the coupled matrices.

use super::super::samples::{block_round_a_ring, description, ring_for_block, ringed, support};
use super::super::{ModalBasis, ModeRange};
use super::*;
use crate::fe::model::{Constraint, Fit, HousingDescription, Ring, RingSupport, SpringShare, SpringStiffness};
use crate::numerics::linalg::{EigenProblem, TripletBuilder};
use std::f64::consts::TAU;

fn counts(found: &Mechanisms) -> [usize; 3] {
    [found.of_whole, found.of_loose_pieces, found.mechanisms]
}

fn held(mut ring: Ring, spring: [f64; 3]) -> Ring {
    let support = RingSupport { from: 0.0, to: TAU, spring, share: SpringShare::Total, offset: 2e-3 };
    ring.add_support(&support).expect("nodes all round");
    ring
}

/// A body in the ring's housing and, `apart`, a lid that hangs on nothing.
fn find(dimension: usize, apart: bool, fit: Fit, ring: Ring, feet: bool) -> Mechanisms {
    let (mut cells, frame) = block_round_a_ring(dimension);
    cells = cells.points("feet", 0, &[[0, 1, 0], [1, 0, 0], [2, 1, 0]]);
    let mut parts = vec!["body"];
    if apart {
        // larger than the body with the ring, and still the loose one
        cells = cells.block("lid", 1, [4, 0, 0], [7, 3, 3]);
        parts.push("lid");
    }
    let springs = Constraint::Spring(SpringStiffness::Global([1e-3; 3]));
    let description = HousingDescription {
        frame,
        supports: feet.then(|| support("feet", springs)).into_iter().collect(),
        ..description(&cells, &parts, 1.0)
    };
    let solved = ringed(&cells.mesh, description, ring, fit, 20);
    let bore = Bore::Rings(&solved.tie, &solved.rings);
    let found = Mechanisms::find_in(&cells.mesh, &solved.model, &bore).expect("its own mesh").expect("few bodies");
    assert_eq!(found.total(), solved.basis.rigid_modes, "{found:?}");
    found
}

#[test]
fn ring_and_housing_move_as_one() {
    for (dimension, full) in [(2, 3), (3, 6)] {
        let ring = || ring_for_block(dimension);
        let free = find(dimension, false, Fit::Bonded, ring(), false);
        assert_eq!(counts(&free), [full, 0, 0]);
        assert!(free.sentences().is_empty());
        assert_eq!(free.bodies.iter().filter(|body| body.is_ring).count(), 1);
        // held by what holds the housing or by what holds the ring, however soft
        let feet = find(dimension, false, Fit::Bonded, ring(), true);
        assert_eq!(counts(&feet), [0; 3]);
        let sprung = held(ring(), [1e-3, 2e-3, 3e-3]);
        let sprung = find(dimension, false, Fit::Bonded, sprung, false);
        assert_eq!(counts(&sprung), [0; 3]);
    }
}

#[test]
fn the_part_without_the_ring_is_the_loose_one() {
    for (dimension, full, count) in [(2, 3, "9"), (3, 6, "27")] {
        let found = find(dimension, true, Fit::Bonded, ring_for_block(dimension), false);
        assert_eq!(counts(&found), [full, full, 0]);
        let sentences = found.sentences();
        assert_eq!(sentences.len(), 1, "{sentences:?}");
        let start = format!("part \"lid\" ({count} elements, near x = 0.55");
        assert!(sentences[0].starts_with(&start), "{sentences:?}");
        let end = format!("is not connected: {full} extra rigid modes");
        assert!(sentences[0].ends_with(&end), "{sentences:?}");
        let found = find(dimension, true, Fit::Bonded, ring_for_block(dimension), true);
        assert_eq!(counts(&found), [0, full, 0]);
    }
}

/// In its bore a sliding ring turns, and in space moves along its axis.
#[test]
fn a_sliding_ring_keeps_its_motions() {
    for (dimension, free, motions) in [(2, 1, "1 mechanism"), (3, 2, "2 mechanisms")] {
        let found = find(dimension, false, Fit::Sliding, ring_for_block(dimension), true);
        assert_eq!(counts(&found), [0, 0, free]);
        let expected = format!("\"body\" and the ring are joined by a tie and can still move: {motions}");
        assert_eq!(found.sentences(), [expected]);
        let sprung = held(ring_for_block(dimension), [1e-3, 2e-3, 3e-3]);
        let found = find(dimension, false, Fit::Sliding, sprung, true);
        assert_eq!(counts(&found), [0; 3]);
    }
}

#[test]
fn a_ring_alone() {
    for (spring, expected) in [
        (None, [3, 0, 0]),
        (Some([0.0; 3]), [3, 0, 0]),
        // springs along x at other heights than the centre hold the turn too
        (Some([1e3, 0.0, 0.0]), [0, 0, 1]),
        (Some([1e3, 1e-3, 0.0]), [0, 0, 0]),
    ] {
        let ring = match spring {
            Some(spring) => held(ring_for_block(2), spring),
            None => ring_for_block(2),
        };
        let found = Mechanisms::of_rings(&ring.clone().into());
        assert_eq!(counts(&found), expected, "{spring:?}");
        let sentences = match expected[2] {
            0 => Vec::new(),
            _ => vec!["the ring is held, but can still move: 1 motion without stiffness"],
        };
        assert_eq!(found.sentences(), sentences);
        let n = ring.dof();
        let (mut k, mut m) = (TripletBuilder::new(n, n), TripletBuilder::new(n, n));
        for column in 0..n {
            for row in 0..n {
                k.add(row, column, ring.stiffness()[(row, column)]);
                m.add(row, column, ring.mass()[(row, column)]);
            }
        }
        let problem = EigenProblem::new(&k.build(), &m.build()).expect("an order");
        let mut basis = ModalBasis::of(&problem, ModeRange::Count(8)).expect("converges");
        let products = |shapes: &crate::numerics::linalg::DenseMatrix| {
            let strain = ring.strain_products(shapes);
            Ok::<_, crate::numerics::linalg::LinalgError>(strain.beams + strain.springs)
        };
        basis.sharpen(products).expect("of its order");
        assert_eq!(found.total(), basis.rigid_modes, "{spring:?}");
    }
}
