//! Followers against the dense matrix with the followers eliminated.

use super::super::{EigenProblem, Factor, Kind, Plan, SparseCholesky, SymmetricMatrix, symmetric_generalised_eigen};
use super::*;
use crate::numerics::linalg::dense::pseudo_random;
use crate::numerics::linalg::sparse::placed;

/// A chain of unit springs over n + p unknowns, held at one end, whose last p follow the others by numbers without pattern.
struct Sample {
    sparse: [SparseMatrix; 2],
    followers: [Followers; 2],
    /// Stiffness and mass with the followers eliminated [n x n].
    whole: [DenseMatrix; 2],
}

fn sample(n: usize, p: usize) -> Sample {
    let all = n + p;
    let stiffness = DenseMatrix::from_fn(all, all, |row, column| match row.abs_diff(column) {
        0 => 2.0 + 0.01 * row as f64,
        1 => -1.0,
        // the followers hang on unknowns far away, too
        distance if distance == n => 0.3,
        _ => 0.0,
    });
    let mass = DenseMatrix::from_fn(all, all, |row, column| match row.abs_diff(column) {
        0 => 1.0 + 0.1 * (row % 7) as f64,
        1 => 0.2,
        _ => 0.0,
    });
    let numbers = pseudo_random(n, p, 7);
    // every third unknown is followed
    let g = DenseMatrix::from_fn(n, p, |row, column| if row % 3 == 0 { 0.3 * numbers[(row, column)] } else { 0.0 });
    let follow = Arc::new(sparse(&g));
    let expand = faer::concat![[DenseMatrix::identity(n, n)], [g.transpose()]];
    let parts = [stiffness, mass].map(|a| {
        let own = placed(&a.submatrix(0, 0, n, n).to_owned(), 0, n);
        let coupling = sparse(&a.submatrix(0, n, n, p).to_owned());
        let corner = a.submatrix(n, n, p, p).to_owned();
        let whole = expand.transpose() * &a * &expand;
        (own, Followers::new(Arc::clone(&follow), coupling, corner), whole)
    });
    let [(k, of_k, whole_k), (m, of_m, whole_m)] = parts;
    Sample { sparse: [k, m], followers: [of_k, of_m], whole: [whole_k, whole_m] }
}

fn sparse(a: &DenseMatrix) -> SparseMatrix {
    let mut entries = TripletBuilder::new(a.nrows(), a.ncols());
    for column in 0..a.ncols() {
        let values = a.col_as_slice(column).iter().enumerate().filter(|(_, value)| **value != 0.0);
        values.for_each(|(row, &value)| entries.add(row, column, value));
    }
    entries.build()
}

fn problem(sample: &Sample) -> (SparseCholesky, EigenProblem) {
    let [k, m] = &sample.sparse;
    let [of_k, of_m] = &sample.followers;
    let ordering = Ordering::of(k).expect("an order");
    let (problem, factor) = EigenProblem::factorised([k, m], ordering, Some([of_k, of_m])).expect("definite");
    (factor, problem)
}

#[test]
fn products_and_solutions_are_those_of_the_whole_matrix() {
    let sample = sample(90, 4);
    let (factor, problem) = problem(&sample);
    let x = pseudo_random(90, 5, 3);
    let [k, m] = &sample.whole;
    let stiff = k * &x;
    // round-off of sums of a hundred terms near one
    assert!((problem.stiffness_times(&x) - &stiff).norm_max() < 1e-12);
    assert!((problem.mass_times(&x) - m * &x).norm_max() < 1e-12);
    let mut solved = stiff;
    factor.solve_columns(&mut solved).expect("same length");
    // condition of a few hundred
    let error = (solved - &x).norm_max();
    assert!(error < 1e-12, "{error:e}");
}

#[test]
fn diagonal_and_scatter_know_the_followers() {
    let sample = sample(60, 3);
    let ordering = Ordering::of(&sample.sparse[0]).expect("an order");
    let mut a = SymmetricMatrix::permuted(&sample.sparse[0], &ordering);
    let alone = a.energy_scatters(DenseMatrix::identity(60, 60).as_ref());
    a.followers = Some(sample.followers[0].permuted(&ordering));
    for (place, found) in a.diagonal().into_iter().enumerate() {
        let old = ordering.old[place] as usize;
        assert!((found - sample.whole[0][(old, old)]).abs() < 1e-13, "{old}");
    }
    // unit motions: terms K_ii, 2 B_ij g_ij and g_ij D_jk g_ik
    let scatters = a.energy_scatters(DenseMatrix::identity(60, 60).as_ref());
    let followers = &sample.followers[0];
    let g = transpose_times_dense(&followers.follow, &DenseMatrix::identity(60, 60));
    let b = transpose_times_dense(&followers.coupling, &DenseMatrix::identity(60, 60));
    for (place, found) in scatters.into_iter().enumerate() {
        let old = ordering.old[place] as usize;
        let mut expected = alone[place].powi(2);
        for j in 0..3 {
            expected += (2.0 * b[(j, old)] * g[(j, old)]).powi(2);
            for k in 0..=j {
                let counted = if j == k { 1.0 } else { 2.0 };
                expected += (counted * g[(j, old)] * followers.corner[(j, k)] * g[(k, old)]).powi(2);
            }
        }
        assert!((found - expected.sqrt()).abs() < 1e-13, "{old}: {found} {}", expected.sqrt());
    }
}

/// By search with its count, in slices beside it, and by the dense solver: 400 and 50 unknowns take different ways.
#[test]
fn eigenvalues_and_their_count_are_those_of_the_whole_matrix() {
    for (n, p, count) in [(400, 6, 12), (50, 3, 50)] {
        let sample = sample(n, p);
        let (_, problem) = problem(&sample);
        let found = problem.lowest(count).expect("found and counted");
        let expected = symmetric_generalised_eigen(&sample.whole[0], &sample.whole[1]).expect("definite");
        for (found, expected) in found.values.iter().zip(&expected.values) {
            assert!((found / expected - 1.0).abs() < 1e-10, "{n}: {found} {expected}");
        }
        assert_eq!(found.count_check.counted, found.count_check.found);
        // a band from the middle needs counts at indefinite shifts
        let [low, high] = [expected.values[20] * 1.0001, expected.values[27] * 1.0001];
        let band = problem.between(low, high, &|_| {}).expect("found and counted");
        assert_eq!(band.values.len(), 7, "{n}: {:?}", band.count_check);
    }
}

/// The search has other ways where a count is wrong: the count itself, between all eigenvalues.
#[test]
fn negative_eigenvalues_are_counted_at_every_shift() {
    let sample = sample(40, 5);
    let expected = symmetric_generalised_eigen(&sample.whole[0], &sample.whole[1]).expect("definite").values;
    let ordering = Ordering::of(&sample.sparse[0]).expect("an order");
    let part = |which: usize| {
        let mut a = SymmetricMatrix::permuted(&sample.sparse[which], &ordering);
        a.followers = Some(sample.followers[which].permuted(&ordering));
        a
    };
    let [stiffness, mass] = [part(0), part(1)];
    let symbolic = Arc::new(Plan::of(&stiffness.shifted(1.0, &mass)).expect("analysed"));
    for below in 0..=40 {
        let value = |place: usize| expected.get(place).copied().unwrap_or(2.0 * expected[39]);
        let sigma = if below == 0 { -0.1 } else { 0.5 * (value(below - 1) + value(below)) };
        let factor = Factor::double(&symbolic, &stiffness.shifted(sigma, &mass), Kind::Indefinite).expect("regular");
        assert_eq!(factor.negative(), below, "{sigma}");
    }
}
