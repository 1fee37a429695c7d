use super::super::samples::{Cells, description};
use super::*;
use crate::fe::model::{HousingDescription, PointMass};

/// A block of 0.3 x 0.2 x 0.1 m with a corner at the origin, with or without a point mass.
fn block(dimension: usize, mass: Option<f64>) -> MassProperties {
    let cells =
        Cells::new(dimension, [0.1; 3]).block("block", 0, [0, 0, 0], [3, 2, 1]).points("corner", 0, &[[3, 2, 0]]);
    let masses = mass.map(|mass| PointMass { group: "corner".to_owned(), mass });
    let description =
        HousingDescription { masses: masses.into_iter().collect(), ..description(&cells, &["block"], 1.0) };
    let model = HousingModel::new(&cells.mesh, description).expect("a model");
    let matrices = SystemMatrices::assemble(&model).expect("matrices");
    MassProperties::of_housing(&matrices, &model).expect("properties")
}

/// Sums of a few dozen terms of one sign.
const ROUND_OFF: f64 = 1e-13;

#[test]
fn a_block_has_the_moments_of_the_formula() {
    let found = block(3, None);
    let mass = 7800.0 * 0.3 * 0.2 * 0.1;
    assert!((found.mass / mass - 1.0).abs() < ROUND_OFF);
    let centroid = found.centroid().map(|x| x.expect("in space"));
    for (x, expected) in centroid.iter().zip([0.15, 0.1, 0.05]) {
        assert!((x - expected).abs() < ROUND_OFF);
    }
    let principal = found.principal().expect("in space");
    // m (b^2 + c^2) / 12, largest about the shortest side
    let expected = [0.04 + 0.01, 0.09 + 0.01, 0.09 + 0.04].map(|sum| mass * sum / 12.0);
    for (k, moment) in expected.iter().enumerate() {
        // trilinear shape functions hold every rigid motion exactly
        assert!((principal.moments[k] / moment - 1.0).abs() < ROUND_OFF);
        assert!((principal.axes[k][k].abs() - 1.0).abs() < ROUND_OFF);
    }
}

#[test]
fn a_plane_model_knows_its_polar_moment_alone() {
    let found = block(2, None);
    let mass = 7800.0 * 0.3 * 0.2 * 0.01;
    assert!((found.mass / mass - 1.0).abs() < ROUND_OFF);
    let MassDistribution::Plane { centroid, polar } = found.distribution else {
        panic!("{found:?}");
    };
    assert!((centroid[0] - 0.15).abs() < ROUND_OFF && (centroid[1] - 0.1).abs() < ROUND_OFF);
    assert!((polar / (mass * 0.13 / 12.0) - 1.0).abs() < ROUND_OFF);
    assert_eq!((found.centroid()[2], found.principal()), (None, None));
}

/// Axes of a turned inertia are found turned, and are right-handed.
#[test]
fn principal_axes_of_a_turned_body() {
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.7, 1.1);
    let inertia = turn.matrix() * Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 4.0));
    let body = MassProperties {
        mass: 1.0,
        distribution: MassDistribution::Space {
            centroid: [0.0; 3],
            inertia: (inertia * turn.matrix().transpose()).transpose().into(),
        },
    };
    let principal = body.principal().expect("in space");
    for k in 0..3 {
        assert!((principal.moments[k] - [1.0, 2.0, 4.0][k]).abs() < ROUND_OFF);
        let along = Vector3::from(principal.axes[k]).dot(&turn.matrix().column(k));
        assert!((along.abs() - 1.0).abs() < ROUND_OFF);
    }
    let axes = Matrix3::from_fn(|i, j| principal.axes[i][j]);
    assert!((axes.determinant() - 1.0).abs() < ROUND_OFF);
}

#[test]
fn nothing_weighs_nothing() {
    let rigid = DenseMatrix::zeros(6, 6);
    assert!(matches!(MassProperties::from_rigid_inertia(&rigid, [0.0; 3]), Err(ModalError::NoMass { .. })));
    assert!(matches!(
        MassProperties::from_rigid_inertia(&DenseMatrix::zeros(4, 4), [0.0; 3]),
        Err(ModalError::Shape { .. })
    ));
}
