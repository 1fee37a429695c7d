use super::super::rigid_motions;
use super::super::samples::{Cells, description, solve, support};
use super::*;
use crate::fe::model::{
    Connection, Constraint, HousingDescription, HousingModel, HousingSupport, Link, SpringStiffness, SupportShare,
};
use crate::numerics::linalg::sparse_times_dense;

/// Two blocks linked by springs, on springs.
fn on_springs(dimension: usize) -> (Cells, HousingDescription) {
    let up = |z: i32| if dimension == 2 { [0, z, 0] } else { [0, 0, z] };
    let to = |z: i32| if dimension == 2 { [3, z, 0] } else { [3, 2, z] };
    let cells = Cells::new(dimension, [0.03, 0.02, 0.025])
        .block("foot", 0, up(0), to(2))
        .block("lid", 1, up(2), to(4))
        .face("under", 0, up(0), to(0))
        .face("seat", 0, up(2), to(2))
        .face("cover", 1, up(2), to(2));
    let stiffness = SpringStiffness::Global([2e8, 1e8, 3e8]);
    let all = HousingDescription {
        supports: vec![HousingSupport {
            share: SupportShare::PerGroup,
            ..support("under", Constraint::Spring(stiffness))
        }],
        links: vec![Link {
            between: ["cover", "seat"].map(str::to_owned),
            connection: Connection::Spring(stiffness, SupportShare::PerGroup),
        }],
        ..description(&cells, &["foot", "lid"], 1.0)
    };
    (cells, all)
}

/// Where nothing cancels, the assembled matrix gives the same products.
#[test]
fn products_are_those_of_the_matrix() {
    for dimension in [2, 3] {
        let (cells, description) = on_springs(dimension);
        let solved = solve(&cells.mesh, description);
        let shapes = solved.shapes.subcols(0, 9).to_owned();
        let found = strain_products(&solved.model, &shapes).expect("of its order");
        let expected = shapes.transpose() * sparse_times_dense(&solved.matrices.stiffness, &shapes);
        // the lowest has 1e-3 of the highest, and K's round-off 1e-3 of that again
        let difference = (&found - &expected).norm_max();
        assert!(difference < 1e-11 * expected.norm_max(), "{difference:e}");
        for mode in 0..9 {
            assert!((found[(mode, mode)] / solved.eigenvalues[mode] - 1.0).abs() < 1e-9);
        }
    }
}

/// What a rigid motion leaves: eps squared here, eps in the matrix. The link has both its sides in the motion.
#[test]
fn rigid_motions_have_no_energy() {
    for dimension in [2, 3] {
        let (cells, all) = on_springs(dimension);
        let free = HousingDescription { supports: Vec::new(), ..all };
        let model = HousingModel::new(&cells.mesh, free).expect("a model");
        for about in [[0.0; 3], [1.0, 2.0, 3.0]] {
            let r = rigid_motions(model.coordinates(), dimension, about);
            let found = strain_products(&model, &r).expect("of its order");
            let size = r.norm_max().powi(2) * 2.1e11 * 0.03;
            for motion in 0..r.ncols() {
                let relative = found[(motion, motion)].abs() / (size * f64::EPSILON.powi(2));
                // 20 elements of up to 24 rows, each displacement off by half an eps or so
                assert!(relative < 1e4, "{dimension} {about:?} {motion}: {relative:e} eps^2");
            }
        }
    }
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let cells = Cells::new(3, [0.01; 3]).block("b", 0, [0; 3], [12, 12, 8]);
    let model = HousingModel::new(&cells.mesh, description(&cells, &["b"], 1.0)).expect("a model");
    let shapes = DenseMatrix::from_fn(model.dof(), 3, |dof, mode| (0.37 * (dof + 1) as f64 * (mode + 1) as f64).sin());
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| strain_products(&model, &shapes)).expect("products")
    };
    let one = on(1);
    assert!(one == on(2) && one == on(8));
}

#[test]
fn shapes_of_another_model_are_refused() {
    let (cells, all) = on_springs(2);
    let model = HousingModel::new(&cells.mesh, all).expect("a model");
    let found = strain_products(&model, &DenseMatrix::zeros(3, 1));
    assert!(matches!(found, Err(ModalError::Shape { .. })));
}
