use super::super::samples::{Cells, Solved, description, solve, support};
use super::super::{MassProperties, rigid_motions};
use super::*;
use crate::fe::model::{Constraint, HousingDescription};
use crate::numerics::linalg::{SparseCholesky, submatrix};

fn participation(solved: &Solved) -> (Participation, DenseMatrix) {
    let mass = MassProperties::of_housing(&solved.matrices, &solved.model).expect("mass");
    let about = mass.centroid().map(Option::unwrap_or_default);
    let rigid = rigid_motions(solved.model.coordinates(), solved.model.dimension(), about);
    let found = Participation::new(&solved.matrices.mass, &solved.shapes, &rigid);
    (found.expect("modes with mass"), rigid)
}

/// A beam of Quad4 along x, clamped at the left end.
fn cantilever(cells: i32) -> Solved {
    let beam = Cells::new(2, [0.05, 0.05, 0.05]).block("beam", 0, [0, 0, 0], [cells, 1, 0]).points(
        "wall",
        0,
        &[[0, 0, 0], [0, 1, 0]],
    );
    let fixed = Constraint::Fixed([true, true, false]);
    let description =
        HousingDescription { supports: vec![support("wall", fixed)], ..description(&beam, &["beam"], 1.0) };
    solve(&beam.mesh, description)
}

/// Rigid modes of a free body carry its whole mass and all its moments of inertia, elastic ones nothing.
#[test]
fn rigid_modes_of_a_free_body_carry_everything() {
    for (dimension, rigid_modes) in [(2, 3), (3, 6)] {
        let body = Cells::new(dimension, [0.1, 0.11, 0.12]).block("b", 0, [0; 3], [3, 2, 2]);
        let solved = solve(&body.mesh, description(&body, &["b"], 1.0));
        let (found, _) = participation(&solved);
        for direction in 0..rigid_modes {
            let rigid =
                (0..rigid_modes).map(|mode| found.fraction(mode, direction)).sum::<Option<f64>>().expect("mass");
            // the solver's modes are orthogonal to 1e-12 or so, and that enters squared
            assert!((rigid - 1.0).abs() < 1e-11, "{dimension} {direction} {rigid}");
            let elastic = found.sums[direction] / found.totals[direction] - rigid;
            assert!(elastic.abs() < 1e-11, "{dimension} {direction} {elastic}");
        }
        assert_eq!(found.fraction(0, rigid_modes), None);
        assert_eq!(found.fraction(10_000, 0), None);
    }
}

/// All modes of a cantilever sum to `r^T M_:f M_ff^-1 M_f: r`, what can move at all.
#[test]
fn all_modes_of_a_cantilever_carry_what_can_move() {
    let solved = cantilever(6);
    let (found, rigid) = participation(&solved);
    let free = solved.model.free_dofs();
    let all: Vec<usize> = (0..solved.model.dof()).collect();
    let m_ff = submatrix(&solved.matrices.mass, &free, &free);
    let m_f = submatrix(&solved.matrices.mass, &free, &all);
    let loads = sparse_times_dense(&m_f, &rigid);
    let factor = SparseCholesky::new(&m_ff).expect("definite");
    let mut solution = loads.clone();
    factor.solve_columns(&mut solution).expect("of its order");
    let movable = loads.transpose() * solution;
    for direction in 0..3 {
        let ratio = found.sums[direction] / movable[(direction, direction)];
        // completeness of the computed modes, 1e-13 times their number
        assert!((ratio - 1.0).abs() < 1e-10, "{direction} {ratio}");
        // the wall's own share of 6 elements is missing
        assert!(found.sums[direction] < 0.99 * found.totals[direction]);
    }
}

/// Bernoulli beam: 61.3 %, 18.8 %, 6.5 % of the mass across, 8 / pi^2 = 81.1 % along.
#[test]
fn bending_modes_of_a_slender_cantilever() {
    let solved = cantilever(40);
    let (found, _) = participation(&solved);
    let largest = |direction: usize| {
        let mut all: Vec<f64> =
            (0..solved.eigenvalues.len()).filter_map(|mode| found.fraction(mode, direction)).collect();
        all.sort_by(|a, b| b.total_cmp(a));
        all
    };
    let bending = largest(1);
    for (share, expected) in bending.iter().zip([0.613, 0.188, 0.065]) {
        // shear and the 1/40 of the mass at the wall's nodes shift the shares in the third digit
        assert!((share - expected).abs() < 4e-3, "{share} {expected}");
    }
    // linear elements along: 40 of them, error of the order (1/40)^2, and Poisson's clamp at the wall
    let along = largest(0)[0];
    assert!((along - 8.0 / std::f64::consts::PI.powi(2)).abs() < 4e-3, "{along}");
}

#[test]
fn matrices_that_do_not_fit_are_refused() {
    let solved = cantilever(2);
    let rigid = rigid_motions(&solved.model.coordinates()[1..], 2, [0.0; 3]);
    let found = Participation::new(&solved.matrices.mass, &solved.shapes, &rigid);
    assert!(matches!(found, Err(ModalError::Shape { .. })));
    let still = DenseMatrix::zeros(solved.model.dof(), 1);
    let rigid = rigid_motions(solved.model.coordinates(), 2, [0.0; 3]);
    let found = Participation::new(&solved.matrices.mass, &still, &rigid);
    assert!(matches!(found, Err(ModalError::NoMass { .. })));
}
