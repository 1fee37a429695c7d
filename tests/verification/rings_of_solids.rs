//! Reference: NAFEMS test 6 (free ring of round section) and SDLS109 (thick free ring of rectangular section), both as
//!   published in secondary sources; for SDLS109 also converged quadratic solids, 205.16, 210.00, 586.30 Hz, and
//!   three-dimensional elasticity solved by Fourier series and Legendre polynomials (see `ring_in_space`): 205.127,
//!   209.998, 586.290, 586.948 Hz.
//! Goal: curved hex20 in three dimensions, free; six rigid modes; pairs.
//! Sketch: a torus of 64 x 12 hex20; a ring of 64 x 3 x 3 hex20, both about the z axis.
//! Conditions: free.
//! Parameters: NAFEMS 6: R 1 m, d 0.1 m, E 200 GPa, nu 0.3, rho 8000. SDLS109: R 0.369 m, 0.048 m thick, 0.05 m wide,
//!   E 185 GPa, nu 0.3, rho 7800.
//!
//! Traps: the published values of NAFEMS 6 are thin-ring theory, solids lie 0.3 to 2 % below; every mode is double and
//! in-plane and out-of-plane ones alternate, so a list compared without its pairs is off by one. The published values
//! of SDLS109 come from linear elements and are 0.3 % high. Curved hex20 lock a little where an arc is long: half as
//! many elements round the torus put its in-plane pair 0.9 % higher (53.72 instead of 53.25 Hz), above thin theory.

use crate::reference_frequencies::data;
use plummer::fe::assembly::SystemMatrices;
use plummer::fe::material::Material;
use plummer::fe::mesh::Mesh;
use plummer::fe::modal::{ModeRange, housing_modes};
use plummer::fe::model::{HousingDescription, HousingModel, HousingPart};
use plummer::numerics::units::LengthUnit;

/// Frequencies of the first `pairs` double elastic modes, Hz.
fn pairs(file: &str, material: Material, pairs: usize) -> Vec<f64> {
    let mesh = Mesh::read_gmsh(&data(file), LengthUnit::Metre).unwrap();
    let part = HousingPart { group: "ring".to_owned(), material: material.into() };
    let description = HousingDescription { parts: vec![part], ..HousingDescription::default() };
    let model = HousingModel::new(&mesh, description).unwrap();
    let matrices = SystemMatrices::assemble(&model).unwrap();
    let modes = housing_modes(&model, matrices, ModeRange::Count(6 + 2 * pairs)).unwrap();
    assert_eq!(modes.rigid_modes, 6);
    let rigid = (modes.eigenvalues[5].abs() / modes.eigenvalues[6]).sqrt();
    assert!(rigid < 1e-5, "{rigid:e}");
    let elastic = modes.frequencies_hz[6..].chunks_exact(2);
    elastic
        .map(|pair| {
            // the mesh repeats every 5.6 degrees: it keeps pairs together
            assert!((pair[1] / pair[0] - 1.0).abs() < 1e-6, "no pair: {pair:?}");
            pair[0]
        })
        .collect()
}

#[test]
fn nafems_6() {
    let material = Material::new(200e9, 0.3, 8000.0).unwrap();
    let found = pairs("nafems6_ring.msh", material, 6);
    let published = [51.849, 53.382, 148.77, 150.99, 286.98, 289.51];
    println!("NAFEMS 6: {found:.3?}, published {published:.3?}");
    for (found, published) in found.iter().zip(published) {
        let below = 1.0 - found / published;
        assert!((0.002..0.022).contains(&below), "{found} {published}");
    }
}

#[test]
fn sdls109() {
    let material = Material::new(185e9, 0.3, 7800.0).unwrap();
    let found = pairs("sdls109_ring.msh", material, 4);
    let elasticity = [205.127, 209.998, 586.290, 586.948];
    let published = [205.89, 210.55, 587.92, 588.88];
    println!("SDLS109: {found:.3?}, elasticity {elasticity:?}");
    for (place, found) in found.iter().enumerate() {
        let above = found / elasticity[place] - 1.0;
        // 1.5e-4 to 5.5e-4 with this mesh; the out-of-plane pairs twist the section and need three elements across
        assert!((0.0..8e-4).contains(&above), "{found} {above:e}");
        assert!((found / published[place] - 1.0).abs() < 5e-3);
    }
}
