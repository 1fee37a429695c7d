use super::*;
use crate::fe::reduction::interior_basis::{Attached, coupled_modes, reduced_matrices};
use crate::fe::reduction::samples::{every_third, grounded_rod, rod, train};
use crate::fe::reduction::{InteriorBasis, Substructure};

const NODES: usize = 150;
const INTERFACE: usize = 50;

/// Free, held, and free with the ground under what is attached; no vectors of the interior, few and many.
#[test]
fn the_lowest_modes_are_those_of_the_dense_problem() {
    let one = DenseMatrix::from_fn(INTERFACE, 1, |_, _| 1.0);
    let none = DenseMatrix::zeros(INTERFACE, 0);
    for (held, ground, rigid) in [(false, 0.0, &one), (true, 0.0, &none), (false, 2.0, &one)] {
        let matrices = match held {
            true => grounded_rod(NODES, 0.1),
            false => rod(NODES),
        };
        let substructure = Substructure::new(&matrices, &every_third(NODES)).expect("connected");
        let [stiffness, mass] = &train(INTERFACE, 5.0, 0.3, ground);
        let attached = Some(Attached { stiffness, mass });
        let interface = CharacteristicModes::of(&substructure, attached, rigid).expect("finite");
        let problem = CoupledProblem::new(&interface);
        let pairs = substructure.lowest_modes(31).expect("definite");
        for vectors in [0, 5, 30] {
            let basis = InteriorBasis::of_modes(&substructure, &pairs, vectors);
            let expected = coupled_modes(&substructure, &basis, attached).expect("definite");
            let found = problem.lowest(&basis, 8).expect("definite");
            assert_eq!(found.values.len(), 8);
            let [k, m] = reduced_matrices(&substructure, &basis, attached);
            let (stiff, moved) = (&k * &found.vectors, &m * &found.vectors);
            for mode in 0..8 {
                let error = (found.values[mode] - expected.values[mode]).abs();
                // the shift and the highest eigenvalue, about 1e-3 and 4, in units of round-off
                assert!(error < 1e-11 * expected.values[7], "{held} {ground} {vectors} {mode}: {error:e}");
                for row in 0..k.nrows() {
                    let rest = stiff[(row, mode)] - found.values[mode] * moved[(row, mode)];
                    // values settle to 1e-13: vectors to the root of it
                    assert!(rest.abs() < 1e-6, "{row} {mode}: {rest:e}");
                }
            }
        }
    }
}

#[test]
fn all_modes_are_there_when_asked_for() {
    let matrices = grounded_rod(12, 0.1);
    let substructure = Substructure::new(&matrices, &every_third(12)).expect("connected");
    let interface = CharacteristicModes::of(&substructure, None, &DenseMatrix::zeros(4, 0));
    let interface = interface.expect("finite");
    let pairs = substructure.lowest_modes(3).expect("definite");
    let basis = InteriorBasis::of_modes(&substructure, &pairs, 2);
    let found = CoupledProblem::new(&interface).lowest(&basis, 100).expect("definite");
    let expected = coupled_modes(&substructure, &basis, None).expect("definite");
    assert_eq!(found.values.len(), 6);
    for (found, expected) in found.values.iter().zip(&expected.values) {
        assert!((found / expected - 1.0).abs() < 1e-11);
    }
}
