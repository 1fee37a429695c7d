//! Dense responses against closed forms, each other and themselves on other numbers of threads.

use super::*;
use crate::numerics::linalg::{ComplexMatrix, DenseMatrix};
use faer::{Scale, c64};
use std::f64::consts::TAU;

fn dense<const N: usize>(rows: [[f64; N]; N]) -> DenseMatrix {
    DenseMatrix::from_fn(N, N, |row, column| rows[row][column])
}

const STIFFNESS: [[f64; 2]; 2] = [[3.0e6, -1.0e6], [-1.0e6, 1.5e6]];
const MASS: [[f64; 2]; 2] = [[2.0, 0.0], [0.0, 0.5]];
const VISCOUS: [[f64; 2]; 2] = [[12.0, -5.0], [-5.0, 7.0]];
const STRUCTURAL: [[f64; 2]; 2] = [[9.0e4, -2.0e4], [-2.0e4, 2.0e4]];

fn oscillator() -> ReducedSystem {
    ReducedSystem::new(dense(STIFFNESS), dense(MASS)).expect("square")
}

/// Loads and sensors on each coordinate.
fn everywhere(order: usize) -> FrfPaths {
    FrfPaths { loads: DenseMatrix::identity(order, order), sensors: DenseMatrix::identity(order, order) }
}

/// Chain of unit masses and springs between walls, with springs of different stiffness.
fn chain(order: usize) -> ReducedSystem {
    let spring = |place: usize| 1e6 * (1.0 + 0.3 * (place as f64).sin());
    let stiffness = DenseMatrix::from_fn(order, order, |row, column| {
        if row == column {
            spring(row) + spring(row + 1)
        } else if row.abs_diff(column) == 1 {
            -spring(row.max(column))
        } else {
            0.0
        }
    });
    ReducedSystem::new(stiffness, DenseMatrix::identity(order, order)).expect("square")
}

/// `Z^-1` by Cramer's rule.
#[test]
fn two_masses_with_both_kinds_of_damping_in_closed_form() {
    let system = oscillator()
        .with_viscous(dense(VISCOUS))
        .and_then(|system| system.with_structural(dense(STRUCTURAL)))
        .expect("square");
    let list = [0.0, 50.0, 164.7, 300.0, 1e4];
    let found = direct_response(&system, &everywhere(2), &list).expect("damped");
    for (&hz, receptance) in list.iter().zip(found.receptance()) {
        let w = TAU * hz;
        let z =
            |i: usize, j: usize| c64::new(STIFFNESS[i][j] - w * w * MASS[i][j], w * VISCOUS[i][j] + STRUCTURAL[i][j]);
        let determinant = z(0, 0) * z(1, 1) - z(0, 1) * z(1, 0);
        let exact = [[z(1, 1), -z(0, 1)], [-z(1, 0), z(0, 0)]];
        for (i, row) in exact.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let exact = entry / determinant;
                let error = (receptance[(i, j)] - exact).norm() / exact.norm();
                // condition below 100 times the unit round-off, and the closed form's own
                assert!(error < 1e-12, "{hz} {i} {j}: {error:e}");
            }
        }
    }
    assert!(found.uncertainty().iter().all(|&share| share < 1e-13));
}

#[test]
fn mobility_and_accelerance_are_derivatives() {
    let receptance = ComplexMatrix::from_fn(1, 1, |_, _| c64::new(2.0, -1.0));
    let response = FrequencyResponse::new(vec![3.0], vec![receptance]).expect("fits");
    let w = TAU * 3.0;
    let of = |quantity| response.path(0, 0, quantity).expect("there")[0];
    assert!((of(FrfQuantity::Mobility) - c64::new(w, 2.0 * w)).norm() < 1e-13);
    let acceleration = c64::new(-2.0 * w * w, w * w);
    assert!((of(FrfQuantity::Accelerance) - acceleration).norm() < 1e-12);
    let error = response.path(1, 0, FrfQuantity::Mobility).expect_err("one sensor");
    assert_eq!(error.to_string(), "sensor 1 asked for, there are 1");
}

/// Proportional and modal damping do not couple modes: all modes are the direct response.
#[test]
fn all_modes_are_the_direct_response_for_proportional_damping() {
    let system = chain(25);
    let basis = ModalBasis::new(&system).expect("definite");
    let list: Vec<f64> = (0..40).map(|place| 12.0 * f64::from(place)).collect();
    let (alpha, beta) = (20.0, 2e-5);
    let points = ModalDamping::Points(vec![(0.0, 0.02), (200.0, 0.005)]);
    let each = ModalDamping::Each((0..25).map(|mode| 0.01 + 0.001 * mode as f64).collect());
    let dampings = [ModalDamping::Uniform(0.03), ModalDamping::Rayleigh { alpha, beta }, points, each];
    for damping in &dampings {
        let viscous = basis.viscous_matrix(&system, damping).expect("in range");
        let loss = system.stiffness() * Scale(0.01);
        let damped =
            system.clone().with_viscous(viscous).and_then(|system| system.with_structural(loss)).expect("square");
        let direct = direct_response(&damped, &everywhere(25), &list).expect("damped");
        let none = ModalDamping::Uniform(0.0);
        let sum = ModalSuperposition::new(&damped, &basis, &everywhere(25), 25, &none);
        let sum = sum.expect("in range");
        // condition 300 times round-off: no coupling, no difference
        assert!(sum.coupling < 1e-11, "{:e}", sum.coupling);
        let found = sum.response(&list).expect("damped");
        let difference = found.largest_difference(&direct).expect("alike");
        assert!(difference.norm_max() < 1e-11, "{:e}", difference.norm_max());
        // the damping given as ratios is the same as that given as a matrix
        let undamped = system.clone().with_structural(system.stiffness() * Scale(0.01)).expect("square");
        let other = ModalSuperposition::new(&undamped, &basis, &everywhere(25), 25, damping)
            .and_then(|sum| sum.response(&list))
            .expect("damped");
        let difference = other.largest_difference(&direct).expect("alike");
        assert!(difference.norm_max() < 1e-11, "{:e}", difference.norm_max());
    }
    let rayleigh = chain(25).with_rayleigh(alpha, beta).expect("in range");
    let by_ratios = basis.viscous_matrix(&rayleigh, &dampings[1]).expect("in range");
    let given = rayleigh.viscous().expect("damped");
    assert!((&by_ratios - given).norm_max() < 1e-10 * given.norm_max());
}

/// A damper at one mass couples modes: the sum says so, and differs.
#[test]
fn coupled_modes_are_noticed() {
    let mut damper = DenseMatrix::zeros(10, 10);
    damper[(2, 2)] = 400.0;
    let system = chain(10).with_viscous(damper).expect("square");
    let basis = ModalBasis::new(&system).expect("definite");
    let none = ModalDamping::Uniform(0.0);
    let sum = ModalSuperposition::new(&system, &basis, &everywhere(10), 10, &none).expect("fits");
    // one damper: c_rs = v_r v_s, every pair fully coupled
    assert!((sum.coupling - 1.0).abs() < 1e-10, "{}", sum.coupling);
    let list: Vec<f64> = (1..30).map(|place| 10.0 * f64::from(place)).collect();
    let direct = direct_response(&system, &everywhere(10), &list).expect("damped");
    let found = sum.response(&list).expect("damped");
    let difference = found.largest_difference(&direct).expect("alike");
    assert!(difference.norm_max() > 0.05, "{:e}", difference.norm_max());
}

/// With the statics of the modes left out, the error at w is of order `(w / w_left)^2` of what they carry.
#[test]
fn modes_left_out_follow_statically() {
    let system = chain(30).with_rayleigh(5.0, 1e-6).expect("in range");
    let basis = ModalBasis::new(&system).expect("definite");
    let none = ModalDamping::Uniform(0.0);
    let sum = ModalSuperposition::new(&system, &basis, &everywhere(30), 8, &none).expect("fits");
    let difference = |hz: f64| {
        let direct = direct_response(&system, &everywhere(30), &[hz]).expect("damped");
        let found = sum.response(&[hz]).expect("damped");
        let error = &found.receptance()[0] - &direct.receptance()[0];
        error.norm_max() / sum.residual.norm_max()
    };
    assert!(difference(0.0) < 1e-12, "{:e}", difference(0.0));
    let first_left = basis.frequencies_hz()[8];
    let (near, far) = (difference(0.2 * first_left), difference(0.1 * first_left));
    // of 22 modes that add up the lowest errs by (1/5)^2 of its own
    assert!(near < 0.04, "{near:e}");
    assert!((near / far - 4.0).abs() < 0.5, "{near:e} {far:e}");
}

/// A massless coordinate hung on a mass by a spring of 4: its own force moves it by 1/4 more.
#[test]
fn motions_without_mass_follow_statically() {
    let stiffness = dense([[12.0, -2.0, -4.0], [-2.0, 5.0, 0.0], [-4.0, 0.0, 4.0]]);
    let mass = dense([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.0]]);
    let system = ReducedSystem::new(stiffness, mass)
        .expect("square")
        .with_structural(dense([[0.1, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0; 3]]))
        .expect("square");
    let basis = ModalBasis::new(&system).expect("definite");
    assert_eq!(basis.frequencies_hz().len(), 2);
    let none = ModalDamping::Uniform(0.0);
    let sum = ModalSuperposition::new(&system, &basis, &everywhere(3), 2, &none).expect("fits");
    for row in 0..3 {
        for column in 0..3 {
            let exact = if row == 2 && column == 2 { 0.25 } else { 0.0 };
            let found = sum.residual[(row, column)];
            assert!((found - exact).abs() < 1e-14, "{row} {column} {found}");
        }
    }
    // structural damping proportional to the mass: no coupling
    let list = [0.0, 0.2, 0.5];
    let direct = direct_response(&system, &everywhere(3), &list).expect("damped");
    let found = sum.response(&list).expect("damped");
    let difference = found.largest_difference(&direct).expect("alike");
    assert!(difference.norm_max() < 1e-13, "{:e}", difference.norm_max());
}

#[test]
fn contributions_add_up_and_shares_to_one() {
    let system = chain(12).with_rayleigh(3.0, 1e-6).expect("in range");
    let basis = ModalBasis::new(&system).expect("definite");
    let none = ModalDamping::Uniform(0.0);
    let sum = ModalSuperposition::new(&system, &basis, &everywhere(12), 6, &none).expect("fits");
    let third = basis.frequencies_hz()[2];
    let band = [0.9 * third, 1.1 * third];
    let resonances: Vec<Resonance> = (0..6)
        .map(|mode| Resonance { frequency_hz: basis.frequencies_hz()[mode], ratio: sum.ratio(mode).expect("elastic") })
        .collect();
    let grid = FrequencyGrid { band_hz: band, intervals: 20, points_a_bandwidth: 8, reach: 4.0 };
    let list = frequency_list(&grid, &resonances).expect("in range");
    let whole = sum.response(&list).expect("damped");
    let path = whole.path(7, 1, FrfQuantity::Receptance).expect("there");
    let parts = sum.contributions(7, 1, &list).expect("there");
    for (place, value) in path.iter().enumerate() {
        let added: c64 = (0..7).map(|mode| parts[(mode, place)]).sum();
        assert!((added - value).norm() < 1e-14 * value.norm().max(1e-7));
    }
    let shares = sum.shares(7, 1, band, &list).expect("covered");
    let total: f64 = shares.modes.iter().map(|mode| mode.share).sum();
    assert!((total + shares.residual - 1.0).abs() < 1e-12);
    let first = shares.modes[0];
    assert!(first.mode == 2 && first.share > 0.9, "{first:?}");
    assert!((first.frequency_hz - third).abs() < 1e-12);
    // 3 / (2 w) + 1e-6 w / 2
    let omega = TAU * third;
    let ratio = first.ratio.expect("elastic");
    assert!((ratio - (1.5 / omega + 0.5e-6 * omega)).abs() < 1e-12);
    let falls = |pair: &[ModeShare]| pair[0].share.abs() >= pair[1].share.abs();
    assert!(shares.modes.windows(2).all(falls));
}

/// Two modes that cancel on a path: each alone brings much, and their shares say that one works against the other.
#[test]
fn modes_that_cancel_have_opposite_shares() {
    // free from the wall but for a weak spring: modes in phase and in opposition of nearly equal frequency
    let stiffness = dense([[1000.0, -1.0], [-1.0, 1000.0]]);
    let system = ReducedSystem::new(stiffness, DenseMatrix::identity(2, 2)).expect("square");
    let basis = ModalBasis::new(&system).expect("definite");
    let damping = ModalDamping::Uniform(0.01);
    let sum = ModalSuperposition::new(&system, &basis, &everywhere(2), 2, &damping).expect("fits");
    let list: Vec<f64> = (0..=100).map(|place| 0.02 * f64::from(place)).collect();
    let across = sum.shares(0, 1, [0.0, 2.0], &list).expect("covered");
    let [first, second] = across.modes[..] else {
        panic!("two modes");
    };
    // 0.5 / (999 - w^2) over 1 / (1000 - w^2)^2: 500 at rest, 421 at 2 Hz, and as much against it
    assert!(first.share > 400.0 && second.share < -400.0);
    assert!((first.share + second.share - 1.0).abs() < 1e-9);
    assert!(first.alone > 400f64.powi(2) && second.alone > 400f64.powi(2));
}

#[test]
fn an_undamped_resonance_and_a_free_body_are_errors() {
    let system = oscillator();
    let basis = ModalBasis::new(&system).expect("definite");
    let on = basis.frequencies_hz()[1];
    let none = ModalDamping::Uniform(0.0);
    let sum = |system: &ReducedSystem, basis: &ModalBasis| {
        let order = system.order();
        ModalSuperposition::new(system, basis, &everywhere(order), order, &none).expect("fits")
    };
    let message = |found: Result<FrequencyResponse, FrfError>| match found {
        Ok(_) => "a response".to_owned(),
        Err(error) => error.to_string(),
    };
    let unbounded = |hz: f64| {
        format!(
            "at {hz} Hz the structure is in resonance without damping (at 0 Hz: it is held by nothing, or so softly that round-off hides it): its response is without bound; give it damping, or leave this frequency out"
        )
    };
    let modal = sum(&system, &basis);
    assert_eq!(message(modal.response(&[1.0, on])), unbounded(on));
    let direct = direct_response(&system, &everywhere(2), &[1.0, on]);
    assert_eq!(message(direct), unbounded(on));
    assert!(direct_response(&system, &everywhere(2), &[1.001 * on]).is_ok());
    assert!(modal.response(&[1.001 * on]).is_ok());
    let springs = dense([[1.0e4, -1.0e4], [-1.0e4, 1.0e4]]);
    let free = ReducedSystem::new(springs, dense(MASS)).expect("square");
    let basis = ModalBasis::new(&free).expect("semidefinite");
    assert_eq!(message(sum(&free, &basis).response(&[0.0])), unbounded(0.0));
    let direct = direct_response(&free, &everywhere(2), &[0.0]);
    assert_eq!(message(direct), unbounded(0.0));
    let list = [1e-3, 1.0];
    let direct = direct_response(&free, &everywhere(2), &list).expect("moves");
    let modal = sum(&free, &basis).response(&list).expect("moves");
    // statics of a free body beside 1e-3 Hz: a condition of 1e9
    let difference = modal.largest_difference(&direct).expect("alike");
    assert!(difference.norm_max() < 1e-6, "{:e}", difference.norm_max());
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let system = chain(40).with_rayleigh(1.0, 1e-5).expect("in range");
    let basis = ModalBasis::new(&system).expect("definite");
    let none = ModalDamping::Uniform(0.0);
    let sum = ModalSuperposition::new(&system, &basis, &everywhere(40), 20, &none).expect("fits");
    let list: Vec<f64> = (0..64).map(|place| 3.7 * f64::from(place)).collect();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| {
            (direct_response(&system, &everywhere(40), &list).expect("damped"), sum.response(&list).expect("damped"))
        })
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn what_does_not_fit_is_refused() {
    let message = |error: Option<FrfError>| error.map_or_else(String::new, |e| e.to_string());
    let square = DenseMatrix::identity(3, 3);
    let two = DenseMatrix::identity(2, 2);
    assert_eq!(message(ReducedSystem::new(square.clone(), two.clone()).err()), "mass: expected 3, found 2");
    let system = ReducedSystem::new(square.clone(), square).expect("square");
    assert_eq!(message(system.clone().with_viscous(two.clone()).err()), "viscous damping: expected 3, found 2");
    assert_eq!(message(system.clone().with_structural(two).err()), "structural damping: expected 3, found 2");
    assert_eq!(
        message(system.clone().with_rayleigh(-1.0, 0.0).err()),
        "the damping coefficient alpha must be zero or more and finite, found -1"
    );
    assert_eq!(
        message(direct_response(&system, &everywhere(2), &[1.0]).err()),
        "rows of the loads: expected 3, found 2"
    );
    assert_eq!(
        message(direct_response(&system, &everywhere(3), &[2.0, 1.0]).err()),
        "frequencies must ascend, found 1 Hz after 2 Hz"
    );
    let basis = ModalBasis::new(&system).expect("definite");
    let none = ModalDamping::Uniform(0.0);
    let sum = ModalSuperposition::new(&system, &basis, &everywhere(3), 4, &none);
    assert_eq!(message(sum.err()), "4 modes asked for, but the system has only 3 with mass");
}
