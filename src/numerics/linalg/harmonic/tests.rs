//! Closed forms and limits of harmonic responses.

use super::*;
use crate::numerics::linalg::factor::Numbers;
use crate::numerics::linalg::numeric::NumericFactor;
use crate::numerics::linalg::{EigenProblem, TripletBuilder};
use std::f64::consts::PI;

fn matrix(rows: &[&[f64]]) -> SparseMatrix {
    let mut builder = TripletBuilder::new(rows.len(), rows.len());
    for (row, entries) in rows.iter().enumerate() {
        for (column, &value) in entries.iter().enumerate() {
            if value != 0.0 {
                builder.add(row, column, value);
            }
        }
    }
    builder.build()
}

/// Chain of unit masses and springs, the first and last held by a spring of `ground`.
fn chain(order: usize, ground: f64) -> (SparseMatrix, SparseMatrix) {
    let (mut k, mut m) = (TripletBuilder::new(order, order), TripletBuilder::new(order, order));
    for row in 0..order {
        let ends = usize::from(row == 0) + usize::from(row + 1 == order);
        k.add(row, row, 2.0 - ends as f64 * (1.0 - ground));
        m.add(row, row, 1.0);
        if row + 1 < order {
            k.add(row, row + 1, -1.0);
            k.add(row + 1, row, -1.0);
        }
    }
    (k.build(), m.build())
}

fn unit_load(order: usize, place: usize) -> ComplexMatrix {
    ComplexMatrix::from_fn(order, 1, |row, _| c64::new(f64::from(u8::from(row == place)), 0.0))
}

/// `Z^-1` of two masses by Cramer's rule, with all kinds of damping at once.
#[test]
fn two_masses_in_closed_form() {
    let k = [[3.0e6, -1.0e6], [-1.0e6, 1.5e6]];
    let (m, c) = ([2.0, 0.5], [[12.0, -5.0], [-5.0, 7.0]]);
    let (alpha, beta, eta) = (4.0, 2e-5, 0.03);
    let rows = |a: &[[f64; 2]; 2]| matrix(&[&a[0], &a[1]]);
    let structural = k.map(|row| row.map(|entry| eta * entry));
    let damping =
        HarmonicDamping { alpha, beta, viscous: Some(&rows(&c)), structural: Some(&rows(&structural)), motions: None };
    let mass = [[m[0], 0.0], [0.0, m[1]]];
    let problem = HarmonicProblem::new(&rows(&k), &rows(&mass), &damping).expect("regular");
    for omega in [0.0, 300.0, 1034.7, 1900.0, 1e5] {
        let z = |i: usize, j: usize| {
            let viscous = alpha * mass[i][j] + beta * k[i][j] + c[i][j];
            c64::new(k[i][j] - omega * omega * mass[i][j], omega * viscous + eta * k[i][j])
        };
        let determinant = z(0, 0) * z(1, 1) - z(0, 1) * z(1, 0);
        let f = [c64::new(1.0, 2.0), c64::new(-0.5, 0.25)];
        let exact = [(f[0] * z(1, 1) - f[1] * z(0, 1)) / determinant, (f[1] * z(0, 0) - f[0] * z(1, 0)) / determinant];
        let loads = ComplexMatrix::from_fn(2, 1, |row, _| f[row]);
        let solution = problem.solve(omega, &loads).expect("damped");
        for (row, exact) in exact.iter().enumerate() {
            let error = (solution.displacements[(row, 0)] - exact).norm() / exact.norm();
            // condition below 100 at these frequencies, times the unit round-off and the aim of 1e-12
            assert!(error < 1e-11, "{omega}: {error:e}");
        }
    }
}

/// `x_j = sum_r phi_jr phi_lr / (lambda_r - w^2 + i w (alpha + beta lambda_r))` with the chain's known modes.
#[test]
fn a_chain_by_its_modes() {
    let order = 60;
    let (k, m) = chain(order, 1.0);
    let (alpha, beta) = (0.01, 0.03);
    let damping = HarmonicDamping { alpha, beta, ..HarmonicDamping::default() };
    let problem = HarmonicProblem::new(&k, &m, &damping).expect("regular");
    let place = 17;
    for omega in [0.0, 0.3, 1.0, 1.9] {
        let solution = problem.solve(omega, &unit_load(order, place)).expect("damped");
        assert!(solution.residuals[0] <= 1e-12);
        for row in [0, 17, 40] {
            let mut exact = c64::new(0.0, 0.0);
            for mode in 1..=order {
                let angle = mode as f64 * PI / (order + 1) as f64;
                let shape = |node: usize| ((node + 1) as f64 * angle).sin();
                let value = 2.0 - 2.0 * angle.cos();
                let weight = 2.0 / (order + 1) as f64 * shape(row) * shape(place);
                let stiffness = c64::new(value - omega * omega, omega * (alpha + beta * value));
                exact += weight / stiffness;
            }
            let error = (solution.displacements[(row, 0)] - exact).norm();
            // condition 1500 times a residual of 1e-12, response of order 1
            assert!(error < 1e-9, "{omega} {row}: {error:e}");
        }
    }
}

#[test]
fn an_undamped_resonance_is_an_error() {
    let (k, m) = chain(80, 1.0);
    let values = EigenProblem::new(&k, &m).and_then(|problem| problem.lowest(5));
    let omega = values.expect("held").values[4].sqrt();
    let none = HarmonicProblem::new(&k, &m, &HarmonicDamping::default()).expect("regular");
    let load = unit_load(80, 3);
    let error = none.solve(omega, &load).expect_err("resonance");
    let HarmonicError::Resonance { hz, uncertainty } = error else {
        panic!("{error}");
    };
    assert!((hz - omega / TAU).abs() < 1e-15 && uncertainty > 1e-4);
    assert_eq!(
        HarmonicError::Resonance { hz: 12.5, uncertainty: 0.5 }.to_string(),
        "at 12.5 Hz the undamped structure is in resonance: its response is without bound (round-off times amplification is 5.0e-1); give it damping, or leave this frequency out"
    );
    // a thousandth beside it there is a response, and with damping there is one on it
    let beside = none.solve(1.001 * omega, &load).expect("beside");
    assert!(beside.residuals[0] < 1e-11);
    let damping = HarmonicDamping { beta: 1e-3, ..HarmonicDamping::default() };
    let damped = HarmonicProblem::new(&k, &m, &damping).expect("regular");
    let on = damped.solve(omega, &load).expect("damped");
    assert!(on.residuals[0] < 1e-11, "{:e}", on.residuals[0]);
    // mode 5 alone, sin^2 over 81/2 and beta w^3 below: the others add a few thousandths
    let angle = 5.0 * PI / 81.0;
    let peak = (4.0 * angle).sin().powi(2) * 2.0 / 81.0 / (1e-3 * omega.powi(3));
    let found = on.displacements[(3, 0)].norm();
    assert!((found / peak - 1.0).abs() < 1e-2, "{found} {peak}");
}

#[test]
fn a_free_body_at_rest_is_an_error() {
    let (k, m) = chain(30, 0.0);
    let structural = k.map(|value| 0.1 * value);
    for structural in [None, Some(&structural)] {
        let damping = HarmonicDamping { alpha: 0.1, structural, ..HarmonicDamping::default() };
        let free = HarmonicProblem::new(&k, &m, &damping).expect("analysed");
        let error = free.solve(0.0, &unit_load(30, 0)).expect_err("free");
        assert_eq!(error, HarmonicError::FreeAtRest);
        let moving = free.solve(1e-3, &unit_load(30, 0)).expect("moves");
        // the rigid body: f / (n (-w^2 + i w alpha)); the springs add the static 10 of a free chain, 1 % of 333
        let rigid = 1.0 / c64::new(-1e-6, 1e-4) / 30.0;
        let found = moving.displacements[(0, 0)];
        assert!((found - rigid).norm() < 0.05 * rigid.norm(), "{found} {rigid}");
    }
    assert_eq!(
        HarmonicError::FreeAtRest.to_string(),
        "at 0 Hz the structure moves without bound: parts of it are held by nothing; hold them, or begin above 0 Hz"
    );
}

/// A mode without damping beside a damped part: the iteration must not say that it solved what has no solution.
#[test]
fn a_loose_undamped_mode_in_resonance_is_an_error() {
    let k = matrix(&[&[2.0, 0.0], &[0.0, 3.0]]);
    let m = matrix(&[&[1.0, 0.0], &[0.0, 3.0]]);
    let structural = matrix(&[&[0.2, 0.0], &[0.0, 0.0]]);
    let damping = HarmonicDamping { structural: Some(&structural), ..HarmonicDamping::default() };
    let problem = HarmonicProblem::new(&k, &m, &damping).expect("regular");
    let error = problem.solve(1.0, &unit_load(2, 1)).expect_err("resonance");
    assert!(matches!(error, HarmonicError::NotSolved { load: 0, residual, .. } if residual > 0.1), "{error}");
}

#[test]
fn a_load_of_zeros_moves_nothing() {
    let (k, m) = chain(10, 1.0);
    let problem = HarmonicProblem::new(&k, &m, &HarmonicDamping::default()).expect("regular");
    let solution = problem.solve(0.1, &ComplexMatrix::zeros(10, 2)).expect("nothing to do");
    assert!(solution.displacements.norm_max() == 0.0 && solution.residuals == [0.0, 0.0]);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let (k, m) = chain(4, 1.0);
    let problem = HarmonicProblem::new(&k, &m, &HarmonicDamping::default()).expect("regular");
    let message = |omega: f64, loads: &ComplexMatrix| match problem.solve(omega, loads) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    };
    let one = unit_load(4, 0);
    assert_eq!(message(-TAU, &one), "a frequency must be zero or more and finite, found -1 Hz");
    assert_eq!(message(f64::NAN, &one), "a frequency must be zero or more and finite, found NaN Hz");
    assert_eq!(message(0.1, &unit_load(3, 0)), "loads: expected 4 rows, found 3");
    let bad = ComplexMatrix::from_fn(4, 2, |_, column| c64::new(0.0, 1.0 / (1.0 - column as f64)));
    assert_eq!(message(0.1, &bad), "load 1 has an entry that is not finite");
    let negative = HarmonicDamping { beta: -1.0, ..HarmonicDamping::default() };
    let error = HarmonicProblem::new(&k, &m, &negative).expect_err("drives");
    assert_eq!(error.to_string(), "the damping coefficient beta must be zero or more and finite, found -1");
    let (_, small) = chain(3, 1.0);
    let error = HarmonicProblem::new(&k, &small, &HarmonicDamping::default()).expect_err("shape");
    assert_eq!(error.to_string(), "mass: expected 4 rows, found 3");
    let other = HarmonicDamping { structural: Some(&small), ..HarmonicDamping::default() };
    let error = HarmonicProblem::new(&k, &m, &other).expect_err("shape");
    assert_eq!(error.to_string(), "structural damping: expected 4 rows, found 3");
}

/// What a restriction leaves out is held.
#[test]
fn rows_left_out_are_held() {
    let (k, m) = chain(12, 0.0);
    let kept: Vec<usize> = (1..12).collect();
    let part = |a: &SparseMatrix| crate::numerics::linalg::submatrix(a, &kept, &kept);
    let damping = HarmonicDamping { beta: 0.1, ..HarmonicDamping::default() };
    let whole = HarmonicProblem::restricted(&k, &m, &damping, &kept).expect("held");
    let alone = HarmonicProblem::new(&part(&k), &part(&m), &damping).expect("held");
    let [a, b] = [&whole, &alone].map(|problem| {
        let solution = problem.solve(0.7, &unit_load(11, 5)).expect("damped");
        solution.displacements
    });
    // condition 100 times the aim of 1e-12
    assert!((&a - &b).norm_max() < 1e-10 * a.norm_max());
}

/// Single precision carries a large problem: the same solution from both factors.
#[test]
fn both_precisions_lead_to_the_same_response() {
    let (k, m) = chain(400, 1.0);
    let damping = HarmonicDamping { alpha: 0.01, ..HarmonicDamping::default() };
    let problem = HarmonicProblem::new(&k, &m, &damping).expect("held");
    let f = problem.split(&unit_load(400, 100)).expect("fits");
    let omega = 0.5;
    let a = problem.matrices.real(omega * omega);
    let solve = |factor: &Factor| krylov::solve(&f, |x| problem.matrices.times(omega, x), |x| factor.solve(x.as_mut()));
    let double = Factor::unjudged(&problem.plan, &a, Kind::Indefinite, true, FactorMemory::default());
    let numbers = NumericFactor::new(problem.plan.own(), &a, Kind::Indefinite, Vec::new()).expect("regular");
    let single = Factor::measured(&problem.plan, &a, Numbers::Single(numbers));
    let found = [double.expect("regular"), single].map(|factor| solve(&factor));
    assert!(found.iter().all(|found| found.residuals[0] <= 1e-12));
    let difference = (&found[0].x - &found[1].x).norm_max();
    assert!(difference < 1e-9 * found[0].x.norm_max(), "{difference:e}");
    assert!(found[1].iterations[0] >= found[0].iterations[0]);
    // a third of what a solve may take
    assert!(found[1].iterations[0] <= 90, "{:?}", found[1].iterations);
}

/// One ratio for every mode: a few modes, and Ritz vectors of the forces for the others, against the sum of all modes.
#[test]
fn a_few_modes_and_ritz_vectors_damp_as_all_modes_do() {
    let (order, kept, ratio) = (60, 12, 0.05);
    let (k, m) = chain(order, 1.0);
    let problem = EigenProblem::new(&k, &m).expect("held");
    let modes = problem.lowest(kept).expect("held");
    let places = [17, 40];
    let forces = DenseMatrix::from_fn(order, 2, |row, force| f64::from(u8::from(row == places[force])));
    let all = |mode: usize| {
        let angle = (mode + 1) as f64 * PI / (order + 1) as f64;
        let shape = |node: usize| ((node + 1) as f64 * angle).sin() * (2.0 / (order + 1) as f64).sqrt();
        (2.0 - 2.0 * angle.cos(), places.map(shape))
    };
    let limit = 0.5 * (modes.values[kept - 1] + all(kept).0);
    let top = (limit / 2.25).sqrt();
    // without Ritz vectors what the modes above take is left out; each block takes its part
    for (blocks, least, most) in [(0, 1e-3, 0.1), (2, 1e-6, 2e-4), (4, 0.0, 2e-5)] {
        let beyond = problem.beyond(&modes.vectors, limit, &forces, blocks).expect("definite");
        let shapes = faer::concat![[modes.vectors, beyond.vectors]];
        let gram = shapes.transpose() * &shapes;
        let off = (gram - DenseMatrix::identity(shapes.ncols(), shapes.ncols())).norm_max();
        assert!(off < 1e-10, "{blocks}: {off:e}");
        let squared = modes.values.iter().chain(&beyond.values);
        let rates: Vec<f64> = squared.map(|squared| 2.0 * ratio * squared.sqrt()).collect();
        let motions = Some(MotionDamping { shapes: &shapes, rates: &rates });
        let damping = HarmonicDamping { motions, ..HarmonicDamping::default() };
        let problem = HarmonicProblem::new(&k, &m, &damping).expect("regular");
        let mut largest = 0.0_f64;
        // on a resonance, between two, and at the top
        for omega in [all(3).0.sqrt(), 0.5 * top, top] {
            let loads = complex_columns(&forces);
            let solution = problem.solve(omega, &loads).expect("damped");
            assert!(solution.residuals.iter().all(|residual| *residual <= 1e-11));
            for (row, load) in [(0, 0), (0, 1), (1, 1)] {
                let part = |mode: usize| {
                    let (squared, shape) = all(mode);
                    let stiffness = c64::new(squared - omega * omega, 2.0 * ratio * squared.sqrt() * omega);
                    shape[row] * shape[load] / stiffness
                };
                let exact: c64 = (0..order).map(part).sum();
                largest = largest.max((solution.displacements[(places[row], load)] - exact).norm() / exact.norm());
            }
        }
        assert!((least..most).contains(&largest), "{blocks} blocks: {largest:e}");
    }
}

#[test]
fn damped_motions_that_do_not_fit_are_refused() {
    let (k, m) = chain(4, 1.0);
    let message = |shapes: &DenseMatrix, rates: &[f64]| {
        let damping = HarmonicDamping { motions: Some(MotionDamping { shapes, rates }), ..HarmonicDamping::default() };
        HarmonicProblem::new(&k, &m, &damping).map_or_else(|error| error.to_string(), |_| String::new())
    };
    let one = DenseMatrix::identity(4, 1);
    assert_eq!(message(&DenseMatrix::identity(3, 1), &[1.0]), "damped motions: expected 4 rows, found 3");
    assert_eq!(message(&one, &[1.0, 2.0]), "damping rates: expected 1 rows, found 2");
    assert_eq!(message(&one, &[-1.0]), "a damping rate must be zero or more and finite, found -1 1/s");
    // rates of zero damp nothing
    assert_eq!(message(&one, &[0.0]), "");
}
