use super::super::samples::{Cells, Solved, description, sharp_modes, solve, support};
use super::super::{ModalError, over_all_dofs, strain_products};
use super::*;
use crate::fe::assembly::SystemMatrices;
use crate::fe::model::{Constraint, HousingDescription, HousingModel, SpringStiffness};

/// A block of 72 cells (plane: 12) with springs at one corner, in fractions of the largest diagonal entry of K.
fn block(dimension: usize, scale: f64, spring: Option<f64>) -> Solved {
    let cells =
        Cells::new(dimension, [0.03, 0.02, 0.01]).block("b", 0, [0; 3], [4, 3, 2]).points("corner", 0, &[[0, 0, 0]]);
    let stiffest = |scale| {
        let model = HousingModel::new(&cells.mesh, description(&cells, &["b"], scale));
        let matrices = SystemMatrices::assemble(&model.expect("a model")).expect("matrices");
        let diagonal = matrices.stiffness.diag();
        diagonal.iter().fold(0.0_f64, |k, entry| k.max(*entry.1))
    };
    let springs = spring.map(|fraction| {
        let k = fraction * stiffest(scale);
        support("corner", Constraint::Spring(SpringStiffness::Global([k; 3])))
    });
    let description =
        HousingDescription { supports: springs.into_iter().collect(), ..description(&cells, &["b"], scale) };
    solve(&cells.mesh, description)
}

/// Whatever the unit of stiffness.
#[test]
fn a_free_block_has_its_rigid_modes() {
    for (dimension, expected) in [(2, 3), (3, 6)] {
        for scale in [1e-9, 1e-4, 1.0, 1e4, 1e9] {
            let found = block(dimension, scale, None).rigid_modes;
            assert_eq!(found, expected, "{dimension} {scale:e}");
        }
    }
}

/// Springs at one corner hold the translations, however soft: only the turns about it are left. By the matrix alone
/// springs below 1e-15 of its diagonal are lost.
#[test]
fn soft_springs_are_no_rigid_modes() {
    for (dimension, free) in [(2, 1), (3, 3)] {
        let mut before = None;
        for fraction in [1e-6, 1e-9, 1e-12, 1e-15, 1e-18, 1e-21] {
            let solved = block(dimension, 1.0, Some(fraction));
            assert_eq!(solved.rigid_modes, free, "{dimension} {fraction:e}");
            // eigenvalues follow the spring to four digits: the block is rigid beside it
            let relative = solved.eigenvalues[free] / fraction;
            let first = *before.get_or_insert(relative);
            assert!((relative / first - 1.0).abs() < 1e-4, "{fraction:e}");
        }
    }
}

/// The sparse iteration, and no elastic mode beside the rigid ones.
#[test]
fn iterated_rigid_modes_are_recognised() {
    let cells = Cells::new(3, [0.03, 0.02, 0.01]).block("b", 0, [0; 3], [6, 4, 3]);
    for scale in [1e-9, 1.0, 1e9] {
        let model = HousingModel::new(&cells.mesh, description(&cells, &["b"], scale));
        let model = model.expect("a model");
        let matrices = SystemMatrices::assemble(&model).expect("matrices");
        for count in [4, 6, 10] {
            let basis = sharp_modes(&model, &matrices, count);
            assert_eq!(basis.rigid_modes, count.min(6), "{scale:e} {count}");
        }
    }
}

/// A rigid mode is known beside the first elastic one, an elastic one by itself, and rigid ones alone by what the model leaves free.
#[test]
fn modes_that_round_off_hides_are_unknown() {
    let cells = Cells::new(3, [0.03, 0.02, 0.01]).block("b", 0, [0; 3], [6, 4, 3]);
    let model = HousingModel::new(&cells.mesh, description(&cells, &["b"], 1.0)).expect("a model");
    let matrices = SystemMatrices::assemble(&model).expect("matrices");
    let rigid = sharp_modes(&model, &matrices, 6);
    assert_eq!([Some(6), None, Some(5)].map(|free| rigid.unknown(free).len()), [0, 0, 6]);
    let mut basis = sharp_modes(&model, &matrices, 8);
    assert_eq!(basis.unknown(Some(6)), [0; 0]);
    for (mode, unknown) in [(7, vec![7]), (2, vec![2, 7])] {
        basis.error_bounds_hz[mode] = 0.11 * basis.frequencies_hz[mode.max(6)];
        assert_eq!(basis.unknown(Some(6)), unknown);
    }
}

/// Turned modes are modes: normalised, and with the energy that their eigenvalue says.
#[test]
fn sharpened_modes_are_normal_modes() {
    let cells = Cells::new(3, [0.03, 0.02, 0.01]).block("b", 0, [0; 3], [6, 4, 3]).points("corner", 0, &[[0, 0, 0]]);
    let soft = Constraint::Spring(SpringStiffness::Global([1e-7, 1e-6, 0.0]));
    let description =
        HousingDescription { supports: vec![support("corner", soft)], ..description(&cells, &["b"], 1.0) };
    let model = HousingModel::new(&cells.mesh, description).expect("a model");
    let matrices = SystemMatrices::assemble(&model).expect("matrices");
    let free = model.free_dofs();
    let problem = EigenProblem::restricted(&matrices.stiffness, &matrices.mass, &free);
    let rough = ModalBasis::of(&problem.expect("an order"), ModeRange::Count(10));
    let rough = rough.expect("converges");
    let basis = sharp_modes(&model, &matrices, 10);
    assert_eq!((rough.rigid_modes, basis.rigid_modes), (6, 4));
    let products = strain_products(&model, &over_all_dofs(&model, &free, &basis.shapes).expect("of its order"))
        .expect("of its order");
    for a in 0..6 {
        for b in 0..6 {
            let expected = if a == b { basis.eigenvalues[a] } else { 0.0 };
            let error = (products[(a, b)] - expected).abs();
            // beside the largest of the six
            assert!(error < 1e-12 * basis.eigenvalues[5], "{a} {b}: {error:e}");
        }
    }
    assert!(basis.frequencies_hz[4] > 10.0 * basis.error_bounds_hz[3]);
    // those beyond are as they were
    assert_eq!(basis.eigenvalues[6..], rough.eigenvalues[6..]);
    let orthogonality = |basis: &ModalBasis| {
        let heavy = crate::numerics::linalg::sparse_times_dense(
            &matrices.mass,
            &over_all_dofs(&model, &free, &basis.shapes).expect("of its order"),
        );
        let all = over_all_dofs(&model, &free, &basis.shapes).expect("of its order");
        (all.transpose() * heavy - DenseMatrix::identity(10, 10)).norm_max()
    };
    // as orthogonal as they came from the solver, and that beside springs of 1e-7 N/m
    let [rough, sharp] = [&rough, &basis].map(orthogonality);
    assert!(rough < 1e-10 && sharp < 1.01 * rough + 1e-13, "{rough:e} {sharp:e}");
}

#[test]
fn what_the_energies_report_is_handed_on() {
    let cells = Cells::new(2, [0.1; 3]).block("b", 0, [0; 3], [2, 2, 1]);
    let model = HousingModel::new(&cells.mesh, description(&cells, &["b"], 1.0)).expect("a model");
    let matrices = SystemMatrices::assemble(&model).expect("matrices");
    let mut basis = sharp_modes(&model, &matrices, 5);
    let before = basis.eigenvalues.clone();
    let error = basis.sharpen(|_| Err(ModalError::NoMass { mass: 0.0 }));
    assert!(matches!(error, Err(ModalError::NoMass { .. })));
    assert_eq!(basis.eigenvalues, before);
    let error: Result<(), ModalError> =
        basis.sharpen(|space| Ok(DenseMatrix::from_fn(space.ncols(), space.ncols(), |_, _| f64::NAN)));
    let refused = LinalgError::DenseEigen { order: 3 };
    assert!(matches!(error, Err(ModalError::Linalg(found)) if found == refused));
    let error: Result<(), ModalError> = basis.sharpen(|_| Ok(DenseMatrix::zeros(1, 1)));
    assert!(matches!(error, Err(ModalError::Linalg(LinalgError::Shape { .. }))));
}

/// What is left of zero in matrices and in energies: rounding of the entries of K, sums over elements, against
/// that of single elements. Both lie within what counts as zero.
#[test]
fn energies_of_elements_leave_less_of_zero() {
    let largest = |values: &[f64]| values[..6].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    for cells in [2, 4, 8] {
        let body = Cells::new(3, [0.03, 0.02, 0.01]).block("b", 0, [0; 3], [cells; 3]);
        let model = HousingModel::new(&body.mesh, description(&body, &["b"], 1.0)).unwrap();
        let matrices = SystemMatrices::assemble(&model).unwrap();
        let free = model.free_dofs();
        let problem = EigenProblem::restricted(&matrices.stiffness, &matrices.mass, &free).unwrap();
        let rough = ModalBasis::of(&problem, ModeRange::Count(10)).unwrap();
        let sharp = sharp_modes(&model, &matrices, 10);
        println!("{cells}^3: first elastic {:.3e}", rough.eigenvalues[6]);
        for (name, basis) in [("matrix", &rough), ("elements", &sharp)] {
            let (value, bound) = (largest(&basis.eigenvalues), largest(&basis.bounds));
            println!("  {name}: {value:.1e}, bound {bound:.1e}");
            assert!(value <= ZERO * bound, "{name}: {value:e} {bound:e}");
            assert_eq!(basis.rigid_modes, 6, "{name}");
        }
        // the point of it: what can be told from zero becomes smaller, not only the number printed
        assert!(largest(&sharp.eigenvalues) < largest(&rough.eigenvalues));
        assert!(largest(&sharp.bounds) < largest(&rough.bounds));
    }
}
