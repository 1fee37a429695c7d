use super::super::{DenseMatrix, LinalgError, SparseMatrix, TripletBuilder, sparse_times_dense};
use super::*;
use std::f64::consts::PI;

/// Chain of unit masses and springs `stiffness`, fixed at both ends: `4 k sin^2(j pi / (2 n + 2))`.
fn chain(order: usize, stiffness: f64) -> (SparseMatrix, SparseMatrix) {
    let (mut k, mut m) = (TripletBuilder::new(order, order), TripletBuilder::new(order, order));
    for row in 0..order {
        k.add(row, row, 2.0 * stiffness);
        m.add(row, row, 1.0);
        if row + 1 < order {
            k.add(row, row + 1, -stiffness);
            k.add(row + 1, row, -stiffness);
        }
    }
    (k.build(), m.build())
}

fn exact(j: usize, order: usize) -> f64 {
    4.0 * (0.5 * j as f64 * PI / (order + 1) as f64).sin().powi(2)
}

/// Copies of a matrix on a diagonal: every eigenvalue as often as there are copies.
fn beside(one: &SparseMatrix, copies: usize) -> SparseMatrix {
    let length = one.rows();
    let mut all = TripletBuilder::new(copies * length, copies * length);
    for copy in 0..copies {
        for (&value, (row, column)) in one.iter() {
            all.add(copy * length + row, copy * length + column, value);
        }
    }
    all.build()
}

/// Free rods beside each other: one zero eigenvalue each.
fn free_rods(rods: usize, length: usize) -> (SparseMatrix, SparseMatrix) {
    let (mut k, mut m) = (TripletBuilder::new(length, length), TripletBuilder::new(length, length));
    for row in 0..length {
        m.add(row, row, 1.0);
        k.add(row, row, if row == 0 || row + 1 == length { 1.0 } else { 2.0 });
        if row + 1 < length {
            k.add(row, row + 1, -1.0);
            k.add(row + 1, row, -1.0);
        }
    }
    (beside(&k.build(), rods), beside(&m.build(), rods))
}

fn problem(k: &SparseMatrix, m: &SparseMatrix) -> EigenProblem {
    EigenProblem::new(k, m).expect("an order")
}

fn assert_within_bounds(pairs: &EigenPairs, expected: impl Fn(usize) -> f64) {
    for (index, value) in pairs.values.iter().enumerate() {
        let error = (value - expected(index)).abs();
        // the expected value itself is a sine: a few units of round-off
        let allowed = pairs.bounds[index] + 8.0 * f64::EPSILON * value.abs();
        assert!(error <= allowed, "{index}: {value} off by {error:e}, bound {allowed:e}");
    }
}

#[test]
fn iteration_and_dense_solver_find_the_chain() {
    for (order, count) in [(30, 8), (300, 8), (2000, 30)] {
        let (k, m) = chain(order, 1.0);
        let pairs = problem(&k, &m).lowest(count).expect("converges");
        assert_within_bounds(&pairs, |index| exact(index + 1, order));
        assert_eq!(pairs.count_check.counted, pairs.count_check.found);
        assert!(pairs.count_check.found >= count);
        assert!(pairs.orthogonality < 1e-12, "{:e}", pairs.orthogonality);
        // the bound is worth something: for the first of 2000 round-off alone leaves 3e-10, 32 eps 4 / sqrt(n) of it
        assert!((0..count).all(|index| pairs.bounds[index] < 1e-9 * pairs.values[index]));
    }
}

#[test]
fn repeated_eigenvalues_are_found_as_often_as_they_occur() {
    let (copies, length) = (12, 60);
    let (k, m) = chain(length, 1.0);
    let (k, m) = (beside(&k, copies), beside(&m, copies));
    for count in [6, 12, 14, 24] {
        let pairs = problem(&k, &m).lowest(count).expect("converges");
        assert_within_bounds(&pairs, |index| exact(index / copies + 1, length));
        let mass = sparse_times_dense(&m, &pairs.vectors);
        let gram = pairs.vectors.transpose() * mass - DenseMatrix::identity(count, count);
        assert!(gram.norm_max() < 1e-11, "{:e}", gram.norm_max());
    }
}

#[test]
fn twelve_motions_without_strain() {
    let (k, m) = free_rods(12, 80);
    for count in [12, 16, 30] {
        let pairs = problem(&k, &m).lowest(count).expect("converges");
        let zero = |index: &usize| pairs.values[*index].abs() <= 4.0 * pairs.bounds[*index];
        assert_eq!((0..count).filter(zero).count(), 12, "{count}");
    }
}

#[test]
fn a_limit_finds_what_is_below_it_and_a_band_what_is_inside() {
    let order = 500;
    let (k, m) = chain(order, 1.0);
    let problem = problem(&k, &m);
    let middle = |j: usize| 0.5 * (exact(j, order) + exact(j + 1, order));
    let below = problem.below(middle(13), &|_| {}).expect("converges");
    assert_eq!(below.values.len(), 13);
    assert_within_bounds(&below, |index| exact(index + 1, order));
    assert!(problem.below(0.5 * exact(1, order), &|_| {}).expect("none").values.is_empty());
    let band = problem.between(middle(100), middle(112), &|_| {}).expect("converges");
    assert_eq!(band.values.len(), 12);
    assert_eq!(band.count_check.counted, 12);
    assert_within_bounds(&band, |index| exact(index + 101, order));
    let empty = 0.6 * exact(9, order) + 0.4 * exact(10, order);
    assert!(problem.between(empty, middle(9), &|_| {}).expect("none").values.is_empty());
}

/// Ends of a band on eigenvalues: counted a little beside them, and the answer says where.
#[test]
fn a_limit_on_an_eigenvalue_is_moved() {
    let order = 400;
    let (k, m) = chain(order, 1.0);
    let pairs = problem(&k, &m).below(exact(7, order), &|_| {}).expect("moved");
    assert_eq!(pairs.values.len(), 7);
    assert_eq!(pairs.count_check.counted, 7);
}

#[test]
fn a_band_of_repeated_eigenvalues() {
    let (k, m) = chain(80, 1.0);
    let (k, m) = (beside(&k, 5), beside(&m, 5));
    let band = problem(&k, &m)
        .between(0.5 * (exact(9, 80) + exact(10, 80)), 0.5 * (exact(12, 80) + exact(13, 80)), &|_| {})
        .expect("converges");
    assert_eq!(band.values.len(), 15);
    assert_within_bounds(&band, |index| exact(10 + index / 5, 80));
}

/// Two chains, one 1e6 times stiffer, coupled by nothing: the soft one's values come first, to all digits.
#[test]
fn a_ratio_of_stiffness_of_a_million() {
    let (soft, m) = chain(150, 1.0);
    let (stiff, _) = chain(150, 1e6);
    let mut k = TripletBuilder::new(300, 300);
    for (first, part) in [(0, &stiff), (150, &soft)] {
        for (&value, (row, column)) in part.iter() {
            k.add(first + row, first + column, value);
        }
    }
    let pairs = problem(&k.build(), &beside(&m, 2)).lowest(20).expect("converges");
    assert_within_bounds(&pairs, |index| exact(index + 1, 150));
}

/// Every second node without mass: as many eigenvalues as masses, and an error that says so beyond.
#[test]
fn mass_in_part_of_the_model() {
    let order = 200;
    let (k, _) = chain(order, 1.0);
    let mut m = TripletBuilder::new(order, order);
    for row in (1..order).step_by(2) {
        m.add(row, row, 1.0);
    }
    let m = m.build();
    let pairs = problem(&k, &m).lowest(10).expect("converges");
    // the nodes without mass eliminated: springs of one half, and a whole one at the far end
    let reduced = DenseMatrix::from_fn(100, 100, |row, column| match row.abs_diff(column) {
        0 if row == 99 => 1.5,
        0 => 1.0,
        1 => -0.5,
        _ => 0.0,
    });
    let all = super::super::symmetric_eigen(&reduced).expect("finite").values;
    assert_within_bounds(&pairs, |index| all[index]);
    assert_eq!(problem(&k, &m).lowest(101).err(), Some(LinalgError::TooManyModes { asked: 101, available: 100 }));
}

#[test]
fn a_run_repeats_to_the_bit() {
    let (k, m) = chain(350, 1.0);
    let values = || problem(&k, &m).lowest(9).expect("converges").values;
    assert_eq!(values(), values());
}

#[test]
fn more_modes_than_degrees_of_freedom_is_an_error() {
    let (k, m) = chain(5, 1.0);
    let expected = LinalgError::TooManyModes { asked: 6, available: 5 };
    assert_eq!(problem(&k, &m).lowest(6).err(), Some(expected));
    assert_eq!(problem(&k, &m).lowest(5).expect("all").values.len(), 5);
    let (k, m) = chain(200, 1.0);
    assert_eq!(problem(&k, &m).lowest(200).expect("all").values.len(), 200);
}

#[test]
fn a_part_of_the_unknowns() {
    // held in the middle: two chains of 50
    let (k, m) = chain(101, 1.0);
    let kept: Vec<usize> = (0..101).filter(|&row| row != 50).collect();
    let pairs = EigenProblem::restricted(&k, &m, &kept).expect("an order").lowest(8).expect("found");
    assert_within_bounds(&pairs, |index| exact(index / 2 + 1, 50));
    assert_eq!(pairs.vectors.nrows(), 100);
}

/// A chain and beside it degrees of freedom without mass, joined to each other by `spring` alone.
fn chain_and_nothing(order: usize, spring: f64) -> (SparseMatrix, SparseMatrix) {
    let (k, m) = chain(order, 1.0);
    let mut all = [TripletBuilder::new(order + 2, order + 2), TripletBuilder::new(order + 2, order + 2)];
    for (whole, part) in all.iter_mut().zip([&k, &m]) {
        for (&value, (row, column)) in part.iter() {
            whole.add(row, column, value);
        }
    }
    let [mut k, m] = all;
    for a in 0..2 {
        for b in 0..2 {
            let sign = if a == b { 1.0 } else { -1.0 };
            k.add(order + a, order + b, sign * spring);
        }
    }
    (k.build(), m.build())
}

/// Solved densely and by iteration; the entries are there and zero.
#[test]
fn neither_stiffness_nor_mass_is_an_error() {
    for order in [20, 300] {
        let (k, m) = chain_and_nothing(order, 0.0);
        let error = EigenProblem::new(&k, &m).expect_err("refused").to_string();
        assert!(error.starts_with(&format!("row {order} of stiffness and mass is empty")), "{error}");
        // left out, the rest is solved
        let kept: Vec<usize> = (0..order).collect();
        let problem = EigenProblem::restricted(&k, &m, &kept).expect("an order");
        let pairs = problem.lowest(5).expect("converges");
        assert_within_bounds(&pairs, |index| exact(index + 1, order));
    }
}

/// Two of them joined by a spring: no row is empty, and K + s M is singular for every s all the same.
#[test]
fn a_motion_without_stiffness_and_mass_is_an_error() {
    for order in [20, 300] {
        let (k, m) = chain_and_nothing(order, 1.0);
        let error = problem(&k, &m).lowest(5).err();
        println!("{order}: {error:?}");
        assert!(
            matches!(error, Some(LinalgError::NotPositiveDefinite { .. } | LinalgError::NearlySingular { .. })),
            "{order}: {error:?}"
        );
    }
}
