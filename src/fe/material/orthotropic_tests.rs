use nalgebra::Matrix6;

use super::*;
use crate::fe::material::Material;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// A unidirectional carbon laminate, fibres along x.
const YOUNG: [f64; 3] = [140e9, 10e9, 9e9];
const POISSON: [f64; 3] = [0.3, 0.45, 0.28];
const SHEAR: [f64; 3] = [5e9, 3.5e9, 4.5e9];

fn laminate(x: [f64; 3], y: [f64; 3]) -> Result<OrthotropicMaterial, MaterialError> {
    OrthotropicMaterial::new(YOUNG, POISSON, SHEAR, 1600.0, x, y)
}

/// Reference: the definition of each constant, stress along one axis at a time.
#[test]
fn stiffness_inverts_the_compliance() -> Result<(), MaterialError> {
    let c = laminate(X, Y)?.stiffness_matrix();
    let mut s = Matrix6::zeros();
    for i in 0..3 {
        s[(i, i)] = 1.0 / YOUNG[i];
        s[(i + 3, i + 3)] = 1.0 / SHEAR[i];
    }
    for (k, [i, j]) in [(0, [0, 1]), (1, [1, 2]), (2, [0, 2])] {
        s[(i, j)] = -POISSON[k] / YOUNG[i];
        s[(j, i)] = s[(i, j)];
    }
    let product = Matrix6::from_fn(|i, j| c[i][j]) * s;
    let error = (product - Matrix6::identity()).amax();
    assert!(error < 1e-14, "{error:e}");
    Ok(())
}

/// Axes along y, z, x of the mesh: constants change places and nothing else happens.
#[test]
fn permuted_axes_permute_the_stiffness() -> Result<(), MaterialError> {
    let own = laminate(X, Y)?.stiffness_matrix();
    let turned = laminate(Y, [0.0, 0.0, 1.0])?.stiffness_matrix();
    // material x, y, z lie along mesh y, z, x
    let place = [1, 2, 0, 4, 5, 3];
    for i in 0..6 {
        for j in 0..6 {
            let error = (turned[place[i]][place[j]] - own[i][j]).abs();
            assert!(error < 1e-14 * own[0][0], "{i} {j}: {error}");
        }
    }
    Ok(())
}

/// `lambda + 2 mu` on the first three diagonal entries, `lambda` beside them, `mu` on the last three, with
/// `lambda = E nu / ((1 + nu)(1 - 2 nu))`, `mu = E / (2 (1 + nu))` (Bathe, Finite Element Procedures (1996), table 4.3).
fn isotropic_stiffness(material: &Material) -> [[f64; 6]; 6] {
    let (lambda, mu) = (material.lame_lambda(), material.shear_modulus());
    let mut c = [[0.0; 6]; 6];
    for i in 0..3 {
        c[i][..3].fill(lambda);
        c[i][i] += 2.0 * mu;
        c[i + 3][i + 3] = mu;
    }
    c
}

/// Reference: uniaxial stress, `eps_x = sigma / E`, `eps_y = eps_z = -nu sigma / E`, and `tau = G gamma`.
#[test]
fn isotropic_stiffness_gives_uniaxial_stress_and_shear() -> Result<(), MaterialError> {
    let steel = Material::new(208e9, 0.3, 7800.0)?;
    assert!((steel.density - 7800.0).abs() < 1e-12);
    let c = isotropic_stiffness(&steel);
    let strain = [1.0 / 208e9, -0.3 / 208e9, -0.3 / 208e9, 0.0, 1.0 / 80e9, 0.0];
    for (i, expected) in [1.0, 0.0, 0.0, 0.0, 1.0, 0.0].into_iter().enumerate() {
        let stress: f64 = (0..6).map(|j| c[i][j] * strain[j]).sum();
        assert!((stress - expected).abs() < 1e-15, "{i}: {stress}");
    }
    Ok(())
}

/// With the constants of an isotropic material the axes do not matter.
#[test]
fn isotropic_constants_ignore_the_axes() -> Result<(), MaterialError> {
    let steel = Material::new(208e9, 0.3, 7800.0)?;
    let same = OrthotropicMaterial::new([208e9; 3], [0.3; 3], [80e9; 3], 7800.0, [1.0, 2.0, -0.5], [0.3, 1.0, 4.0])?;
    let (expected, found) = (isotropic_stiffness(&steel), same.stiffness_matrix());
    for i in 0..6 {
        for j in 0..6 {
            let error = (found[i][j] - expected[i][j]).abs();
            assert!(error < 1e-14 * expected[0][0], "{i} {j}: {error}");
        }
    }
    Ok(())
}

#[test]
fn axes_are_orthonormal_and_right_handed() -> Result<(), MaterialError> {
    let axes = laminate([3.0, 4.0, 0.0], [1e-3, 1.0, 2e-3])?.axes.map(Vector3::from);
    assert!((axes[0][0] - 0.6).abs() < 1e-15 && (axes[0][1] - 0.8).abs() < 1e-15);
    for i in 0..3 {
        let j = (i + 1) % 3;
        let z = axes[i].cross(&axes[j]);
        for k in 0..3 {
            assert!((z[k] - axes[(i + 2) % 3][k]).abs() < 1e-15);
        }
        assert!((axes[i].norm() - 1.0).abs() < 1e-15);
    }
    let towards: f64 = (0..3).map(|k| axes[1][k] * [1e-3, 1.0, 2e-3][k]).sum();
    assert!(towards > 0.0, "y points away: {towards}");
    Ok(())
}

#[test]
fn every_rule_fires_with_its_message() {
    let message = |change: &dyn Fn(&mut [[f64; 3]; 6])| {
        let mut given = [YOUNG, POISSON, SHEAR, [1600.0, 0.0, 0.0], X, Y];
        change(&mut given);
        let [young, poisson, shear, [density, ..], x, y] = given;
        match OrthotropicMaterial::new(young, poisson, shear, density, x, y) {
            Ok(material) => format!("accepted {material:?}"),
            Err(error) => error.to_string(),
        }
    };
    assert_eq!(message(&|g| g[0][1] = 0.0), "E_y (Pa) must be positive and finite, found 0");
    assert_eq!(message(&|g| g[0][2] = f64::INFINITY), "E_z (Pa) must be positive and finite, found inf");
    assert_eq!(message(&|g| g[2][1] = f64::NAN), "G_yz (Pa) must be positive and finite, found NaN");
    assert_eq!(message(&|g| g[1][0] = 4.0), "nu_xy must be smaller than sqrt(E_x / E_y) in magnitude, found 4");
    assert_eq!(message(&|g| g[1][1] = -1.1), "nu_yz must be smaller than sqrt(E_y / E_z) in magnitude, found -1.1");
    assert_eq!(message(&|g| g[1][2] = f64::NAN), "nu_xz must be smaller than sqrt(E_x / E_z) in magnitude, found NaN");
    assert_eq!(
        message(&|g| (g[0], g[1]) = ([1e9; 3], [0.5; 3])),
        "the three Poisson's ratios do not go together: 1 - nu_xy^2 E_y/E_x - nu_yz^2 E_z/E_y - \
         nu_xz^2 E_z/E_x - 2 nu_xy nu_yz nu_xz E_z/E_x must be positive, found 0"
    );
    assert_eq!(message(&|g| g[3][0] = -1.0), "density (kg/m^3) must be positive and finite, found -1");
    assert_eq!(message(&|g| g[4] = [0.0; 3]), "the material axis x needs a direction, found (0, 0, 0)");
    assert_eq!(message(&|g| g[5] = [0.0, f64::NAN, 1.0]), "the material axis y needs a direction, found (0, NaN, 1)");
    assert_eq!(
        message(&|g| g[5] = [-2.0, 0.0, 1e-5]),
        "the material axes x (1, 0, 0) and y (-2, 0, 0.00001) are parallel: two different directions are needed"
    );
}
