//! Substitution with factors of both kinds in blocks of every width.

use super::super::dense::pseudo_random;
use super::super::front::Kind;
use super::super::numeric::NumericFactor;
use super::super::ordering::Ordering;
use super::super::symbolic::{Symbolic, analysed};
use super::super::symmetric::SymmetricMatrix;
use super::super::{DenseMatrix, TripletBuilder};
use super::*;

const SIDE: usize = 8;

/// Grid of springs, grounded. What is not definite has small diagonal entries, so that pivots of order two are needed; they
/// change sign from node to node, which keeps all eigenvalues as far from zero as they are.
fn grid(definite: bool) -> (Symbolic, SymmetricMatrix) {
    let order = SIDE * SIDE * SIDE;
    let mut a = TripletBuilder::new(order, order);
    for row in 0..order {
        let place = row % SIDE + row / SIDE % SIDE + row / SIDE / SIDE;
        let sign = if place.is_multiple_of(2) { 0.5 } else { -0.5 };
        a.add(row, row, if definite { 8.0 } else { sign });
        for (stride, place) in [(1, row % SIDE), (SIDE, row / SIDE % SIDE), (SIDE * SIDE, row / SIDE / SIDE)] {
            if place + 1 < SIDE {
                // no two couplings alike: nothing cancels
                let spring = -1.0 - 0.3 * ((7 * row + stride) as f64).sin();
                a.add(row, row + stride, spring);
                a.add(row + stride, row, spring);
            }
        }
    }
    let a = a.build();
    let ordering = Ordering::of(&a).expect("an order");
    let a = SymmetricMatrix::permuted(&a, &ordering);
    (analysed(&a).expect("analysed"), a)
}

/// Largest entry of `A F^-1 B - B`.
fn remainder<T: Precision>(symbolic: &Symbolic, a: &SymmetricMatrix, kind: Kind, b: &DenseMatrix) -> f64 {
    let factor = NumericFactor::<T>::new(symbolic, a, kind, Vec::new()).expect("regular");
    let mut x = b.clone();
    factor.solve(symbolic, x.as_mut());
    (a.times(x.as_ref()) - b).norm_max()
}

/// Few and many columns, so that blocks of every width are met, full and not.
#[test]
fn blocks_of_every_width_solve() {
    for definite in [true, false] {
        let (symbolic, a) = grid(definite);
        let kinds = [Kind::Definite, Kind::Indefinite];
        for kind in &kinds[usize::from(!definite)..] {
            for columns in [1, 4, 5, 8, 9, 21] {
                let b = pseudo_random(a.order(), columns, 3);
                // condition at most 16; growth where pivots are sought within a supernode alone
                let double = remainder::<f64>(&symbolic, &a, *kind, &b);
                assert!(double < 1e-13, "{kind:?} {columns} {double:e}");
                let single = remainder::<f32>(&symbolic, &a, *kind, &b);
                assert!(single < 1e-4, "{kind:?} {columns} {single:e}");
            }
        }
    }
}

/// To the last bit: threads share the columns, and results must not depend on their number.
#[test]
fn a_solution_does_not_depend_on_its_neighbours() {
    fn check<T: Precision>(symbolic: &Symbolic, a: &SymmetricMatrix, kind: Kind) {
        let factor = NumericFactor::<T>::new(symbolic, a, kind, Vec::new()).expect("regular");
        let b = pseudo_random(a.order(), 21, 3);
        let solved = |first: usize, width: usize| {
            let mut x = b.subcols(first, width).to_owned();
            factor.solve(symbolic, x.as_mut());
            x
        };
        let together = solved(0, 21);
        for (first, width) in [(0, 1), (3, 4), (2, 7), (5, 16)] {
            let difference = solved(first, width) - together.subcols(first, width);
            assert!(difference.norm_max() == 0.0, "{kind:?} {first} {width}");
        }
    }
    for kind in [Kind::Definite, Kind::Indefinite] {
        let (symbolic, a) = grid(kind == Kind::Definite);
        check::<f64>(&symbolic, &a, kind);
        check::<f32>(&symbolic, &a, kind);
    }
}

/// Loads on single nodes pass over most supernodes on the way forward, loads everywhere over none: together in one
/// call, in different blocks, they have the same answers as alone.
#[test]
fn what_is_passed_over_is_zero() {
    let (symbolic, a) = grid(true);
    let factor = NumericFactor::<f64>::new(&symbolic, &a, Kind::Definite, Vec::new());
    let factor = factor.expect("definite");
    let order = a.order();
    let everywhere = pseudo_random(order, 8, 1);
    for node in [0, order / 3, order - 1] {
        let mut b = DenseMatrix::zeros(order, 24);
        b[(node, 0)] = 1.0;
        b[(node / 2, 7)] = -2.0;
        b.as_mut().subcols_mut(8, 8).copy_from(&everywhere);
        b[(node, 20)] = 3.0;
        let mut x = b.clone();
        factor.solve(&symbolic, x.as_mut());
        // of a matrix with entries of order one
        assert!((a.times(x.as_ref()) - &b).norm_max() < 2e-13);
        let nothing = x.col_as_slice(1).iter().all(|entry| entry.abs() == 0.0);
        assert!(nothing, "a column without load");
    }
}
