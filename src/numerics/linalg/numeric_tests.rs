//! Factors of matrices in any order and by any number of threads.

use super::super::dense::pseudo_random;
use super::super::ordering::{Ordering, Pattern};
use super::super::symbolic::analysed;
use super::super::{DenseMatrix, SparseMatrix, TripletBuilder};
use super::*;

/// A cube of nodes with `unknowns` each, coupled with their neighbours.
fn cube(side: usize, unknowns: usize) -> SparseMatrix {
    let nodes = side * side * side;
    let mut a = TripletBuilder::new(unknowns * nodes, unknowns * nodes);
    let mut couple = |one: usize, other: usize, value: f64| {
        for i in 0..unknowns {
            for j in 0..unknowns {
                // no two couplings alike: nothing cancels
                let value = value * if i == j { 1.0 } else { 0.1 + 0.01 * ((one + 3 * other) as f64).sin() };
                a.add(unknowns * one + i, unknowns * other + j, value);
                if one != other {
                    a.add(unknowns * other + j, unknowns * one + i, value);
                }
            }
        }
    };
    for node in 0..nodes {
        couple(node, node, 8.0);
        for (stride, place) in [(1, node % side), (side, node / side % side), (side * side, node / side / side)] {
            if place + 1 < side {
                couple(node, node + stride, -1.0);
            }
        }
    }
    a.build()
}

/// Largest entry of `A F^-1 B - B`.
fn remainder(symbolic: &Symbolic, a: &SymmetricMatrix, kind: Kind) -> f64 {
    let factor = NumericFactor::<f64>::new(symbolic, a, kind, Vec::new()).expect("regular");
    let b = pseudo_random(a.order(), 3, 7);
    let mut x = b.clone();
    factor.solve(symbolic, x.as_mut());
    (a.times(x.as_ref()) - b).norm_max()
}

/// The order as it was made is no postorder of the elimination tree; one shuffled at random is none either.
#[test]
fn any_order_can_be_factorised() {
    // enough work for several parts, if the order were a postorder
    let a = cube(12, 1);
    let n = a.rows();
    let mut shuffled: Vec<usize> = (0..n).collect();
    shuffled.sort_by_key(|&row| (row * 2_654_435_761) % 4_294_967_291);
    let orders = [(0..n).collect(), (0..n).rev().collect(), shuffled];
    for order in orders {
        let ordering = Ordering::as_given(&order);
        let matrix = SymmetricMatrix::permuted(&a, &ordering);
        let symbolic = analysed(&matrix).expect("analysed");
        for kind in [Kind::Definite, Kind::Indefinite] {
            // of entries of order ten
            let error = remainder(&symbolic, &matrix, kind);
            assert!(error < 1e-13, "{kind:?} {error:e}");
        }
    }
}

/// A factor has places for all that elimination fills: as many as the dense one where everything is coupled.
#[test]
fn what_is_full_has_one_supernode() {
    let n = 300;
    let mut a = TripletBuilder::new(n, n);
    for row in 0..n {
        for column in 0..n {
            a.add(row, column, if row == column { 2.0 * n as f64 } else { 1.0 });
        }
    }
    let a = a.build();
    let matrix = SymmetricMatrix::permuted(&a, &Ordering::of(&a).expect("an order"));
    let symbolic = analysed(&matrix).expect("analysed");
    assert_eq!(symbolic.supernodes(), 1);
    // panels of 128, 128 and 44 columns
    assert_eq!(symbolic.entries(), 128 * (300 + 172) + 44 * 44);
    assert!(remainder(&symbolic, &matrix, Kind::Definite) < 1e-13);
}

/// Apart from each other, and a chain whose tree is as deep as it is long.
#[test]
fn forests_and_chains_are_trees_too() {
    for coupling in [0.0, -1.0] {
        let n = 20_000;
        let mut a = TripletBuilder::new(n, n);
        for row in 0..n {
            a.add(row, row, 3.0 + (row % 7) as f64);
            if coupling != 0.0 && row + 1 < n {
                a.add(row, row + 1, coupling);
                a.add(row + 1, row, coupling);
            }
        }
        let a = a.build();
        let matrix = SymmetricMatrix::permuted(&a, &Ordering::as_given(&(0..n).collect::<Vec<_>>()));
        let symbolic = analysed(&matrix).expect("analysed");
        assert!(remainder(&symbolic, &matrix, Kind::Indefinite) < 1e-13);
    }
}

/// To the last bit, in a tree of several parts with a front that threads share at its top.
#[test]
fn threads_change_nothing() {
    let a = cube(22, 1);
    let matrix = SymmetricMatrix::permuted(&a, &Ordering::of(&a).expect("an order"));
    let symbolic = analysed(&matrix).expect("analysed");
    assert!(symbolic.tree.len() > 4, "{} parts", symbolic.tree.len());
    for kind in [Kind::Definite, Kind::Indefinite] {
        let computed = |threads: usize| -> (Vec<f32>, DenseMatrix) {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| {
                let factor = NumericFactor::<f32>::new(&symbolic, &matrix, kind, Vec::new()).expect("regular");
                let mut x = pseudo_random(matrix.order(), 9, 5);
                factor.solve(&symbolic, x.as_mut());
                (factor.values, x)
            })
        };
        let (values, solution) = computed(1);
        for threads in [2, 3, 7] {
            let (others, other) = computed(threads);
            assert!(values.iter().zip(&others).all(|(a, b)| a.to_bits() == b.to_bits()), "{kind:?} {threads}");
            assert!(solution == other, "{kind:?} {threads}");
        }
    }
}

/// The column that is reported does not depend on which thread fails first.
#[test]
fn the_first_column_that_fails_is_named() {
    let mut a = cube(22, 1);
    let order = a.rows();
    let ordering = Ordering::of(&a).expect("an order");
    for row in [17, 4000, 9000] {
        *a.get_mut(row, row).expect("stored") = -8.0;
    }
    let matrix = SymmetricMatrix::permuted(&a, &ordering);
    let symbolic = analysed(&matrix).expect("analysed");
    let failed = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| NumericFactor::<f64>::new(&symbolic, &matrix, Kind::Definite, Vec::new()).unwrap_err())
    };
    let first = [17, 4000, 9000].map(|row: usize| ordering.new[row] as usize).into_iter().min().expect("three");
    for threads in [1, 2, 4] {
        assert_eq!(failed(threads), LinalgError::NotPositiveDefinite { order, pivot: first });
    }
}

/// Part of a matrix in the order of the whole: it fills hardly more than in an order of its own, and supernodes are as wide.
#[test]
fn a_part_keeps_the_order_of_the_whole() {
    let a = cube(12, 3);
    let pattern = Pattern::of(&a);
    // without one of the faces
    let kept: Vec<usize> = (0..a.rows()).filter(|row| row / 3 % 12 > 0).collect();
    let whole = Ordering::of(&a).expect("an order");
    let orders = [whole.restricted(pattern, &kept), Ordering::of_part(pattern, &kept)];
    let [(entries, supernodes), (own_entries, own_supernodes)] = orders.map(|ordering| {
        let permuted = SymmetricMatrix::permuted(&a, &ordering.expect("an order"));
        let symbolic = analysed(&permuted).expect("analysed");
        (symbolic.entries() as f64, symbolic.supernodes() as f64)
    });
    // METIS's own luck is as large
    assert!(entries < 1.15 * own_entries, "{entries} {own_entries}");
    assert!(supernodes < 1.15 * own_supernodes, "{supernodes} {own_supernodes}");
}
