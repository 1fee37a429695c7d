use super::*;
use crate::fe::reduction::BasisSize;
use crate::fe::reduction::parts::dense;
use crate::fe::reduction::samples::{every_third, partition, rod};
use crate::numerics::linalg::{SymmetricSpectrum, TripletBuilder, symmetric_generalised_eigen};
use std::f64::consts::TAU;

const fn plain(size: BasisSize) -> BasisChoice {
    BasisChoice { size, enhanced: false, band_hz: 0.1 }
}

fn condensed(nodes: usize, size: BasisSize) -> CraigBampton {
    craig_bampton(&rod(nodes), &partition(nodes), plain(size), None).expect("connected")
}

fn modes(element: &Superelement) -> SymmetricSpectrum {
    symmetric_generalised_eigen(&element.stiffness, &element.mass).expect("free")
}

#[test]
fn all_modes_kept_is_the_full_model() {
    let rod = rod(12);
    let found = modes(&condensed(12, BasisSize::Count(11)).superelement);
    let full = symmetric_generalised_eigen(&dense(&rod.stiffness), &dense(&rod.mass)).expect("free");
    for mode in 0..12 {
        let error = (found.values[mode] - full.values[mode]).abs();
        assert!(error < 1e-11, "{mode}: {error:e}");
    }
}

/// m_bb is put together in blocks, half of it by symmetry: here of three blocks.
#[test]
fn the_mass_of_a_long_interface_is_that_of_its_motions() {
    let nodes = 240;
    let mut rod = rod(nodes);
    let mut coupled = TripletBuilder::new(nodes, nodes);
    for node in 1..nodes {
        coupled.add(node, node - 1, 0.2);
        coupled.add(node - 1, node, 0.2);
    }
    rod.mass = &rod.mass + &coupled.build();
    let partition = every_third(nodes);
    let substructure = Substructure::new(&rod, &partition).expect("connected");
    let order = substructure.interface_dof();
    assert!(order > 64);
    let mut motions = DenseMatrix::zeros(nodes, order);
    for column in 0..order {
        motions[(partition.driven[column], column)] = 1.0;
        for (row, &node) in partition.interior.iter().enumerate() {
            motions[(node, column)] = substructure.constraint_modes[(row, column)];
        }
    }
    let expected = motions.transpose() * dense(&rod.mass) * &motions;
    // round-off of masses of order one
    assert!((&substructure.mass - expected).norm_max() < 1e-14);
}

/// To the last bit: threads share the blocks of the interface.
#[test]
fn a_substructure_does_not_depend_on_the_number_of_threads() {
    let (rod, partition) = (rod(300), every_third(300));
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| Substructure::new(&rod, &partition)).expect("connected")
    };
    let one = of(1);
    // four blocks: two and one at the end, three and one, all at once
    assert_eq!(one.interface_dof(), 100);
    for threads in [2, 3, 8] {
        let found = of(threads);
        assert!(found.stiffness() == one.stiffness() && found.mass == one.mass, "{threads}");
        assert!(found.constraint_modes == one.constraint_modes, "{threads}");
    }
}

#[test]
fn frequencies_converge_from_above() {
    let rod = rod(40);
    let full = symmetric_generalised_eigen(&dense(&rod.stiffness), &dense(&rod.mass)).expect("free");
    let mut before = f64::INFINITY;
    for kept in [0, 2, 5, 10] {
        let modes = modes(&condensed(40, BasisSize::Count(kept)).superelement);
        // the rigid mode is exact, so is static response: k_bb of a free rod is zero
        assert!(modes.values[0].abs() < 1e-12);
        if kept > 0 {
            let error = modes.values[1] - full.values[1];
            assert!(error > -1e-13 && error < before);
            before = error;
        }
    }
    // ten of 39 modes: the loop shows that the error falls, this how far
    assert!(before < 3e-4 * full.values[1], "{:e}", before / full.values[1]);
}

#[test]
fn a_loose_piece_is_named() {
    let rod = rod(10);
    let loose = HousingPartition { interior: vec![5, 6, 7], ..partition(10) };
    // nodes 5 to 7 hang on nothing once 4 and 8 are neither driven nor interior: held by them
    assert!(craig_bampton(&rod, &loose, plain(BasisSize::Count(1)), None).is_ok());
    let mut springs = TripletBuilder::new(10, 10);
    springs.add(0, 0, 1.0);
    let nothing = SystemMatrices { stiffness: springs.build(), ..rod };
    let error = craig_bampton(&nothing, &partition(10), plain(BasisSize::Count(1)), None).expect_err("no stiffness");
    assert_eq!(error, ReductionError::FloatingInterior { interior: 9, dof: 1 });
}

#[test]
fn a_cut_off_frequency_keeps_what_is_below() {
    // fixed-free rod of 59 masses: lambda_j = 4 sin^2((2j - 1) pi / (2 (2n + 1)))
    let limit: f64 = 0.5;
    let exact = (1..=59)
        .filter(|j| {
            let angle = f64::from(2 * j - 1) * std::f64::consts::PI / (2.0 * 119.0);
            2.0 * angle.sin() <= limit
        })
        .count();
    let reduced = condensed(60, BasisSize::UpTo(limit / TAU));
    assert_eq!(reduced.basis.count(), exact);
}
