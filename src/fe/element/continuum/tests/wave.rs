//! The mass with incompatible modes: what the bubbles add, and what they must not touch.

use nalgebra::{DMatrix, Matrix2};

use super::fixtures::{distorted, field};
use super::{Outcome, PLAIN};
use crate::fe::element::continuum::{ContinuumProperties, Formulation, PlaneAssumption, mass, mass_into, stiffness};
use crate::fe::material::{ElasticMaterial, Material};
use crate::fe::mesh::ElementKind;
use std::f64::consts::TAU;

const YOUNG: f64 = 70e9;
const DENSITY: f64 = 2700.0;
const HEIGHT: f64 = 1e-3;

fn properties(kind: ElementKind) -> Result<ContinuumProperties, Box<dyn std::error::Error>> {
    let material = ElasticMaterial::from(Material::new(YOUNG, 0.0, DENSITY)?);
    Ok(match kind.dimension() {
        2 => ContinuumProperties::plane(&material, PlaneAssumption::Stress, HEIGHT)?,
        _ => ContinuumProperties::solid(&material),
    })
}

/// Relative error of the frequency of a bending wave, with a period of it in a closed line of `count` elements of `length`, in
/// one layer of HEIGHT, against Timoshenko's beam without a shear coefficient: sections of elements stay plane.
fn bending_wave(
    kind: ElementKind,
    in_plate: bool,
    count: usize,
    length: f64,
) -> Result<f64, Box<dyn std::error::Error>> {
    let (d, nodes, p) = (kind.dimension(), kind.nodes(), properties(kind)?);
    let natural = &kind.natural_nodes()[..nodes];
    let sides = [length, HEIGHT, if d == 3 { HEIGHT } else { 0.0 }];
    let coords: Vec<_> = natural.iter().map(|x| [0, 1, 2].map(|i| 0.5 * x[i] * sides[i])).collect();
    let formulation = Formulation::default();
    let mut mass = DMatrix::zeros(kind.dof(), kind.dof());
    mass_into(kind, &coords, &p, formulation, [in_plate; 3], mass.as_mut_slice())?;
    let matrices = [stiffness(kind, &coords, &p, formulation)?, mass];
    // a section moves across and turns
    let wave = TAU / (count as f64 * length);
    let mut sums = [Matrix2::zeros(); 2];
    for element in 0..count {
        let shapes = DMatrix::from_fn(d * nodes, 2, |row, shape| {
            let [along, across, _] = coords[row / d];
            let (sine, cosine) = (wave * ((element as f64 + 0.5) * length + along)).sin_cos();
            match (shape, row % d) {
                (0, 1) => cosine,
                (1, 0) => across * wave * sine,
                _ => 0.0,
            }
        });
        for (sum, matrix) in sums.iter_mut().zip(&matrices) {
            *sum += Matrix2::from_fn(|i, j| (shapes.column(i).transpose() * matrix * shapes.column(j))[0]);
        }
    }
    let (area, inertia) = (HEIGHT * HEIGHT, HEIGHT.powi(4) / 12.0);
    let shear = 0.5 * YOUNG * area * wave.powi(2);
    let exact = [
        Matrix2::new(shear, -shear, -shear, YOUNG * inertia * wave.powi(4) + shear),
        Matrix2::new(DENSITY * area, 0.0, 0.0, DENSITY * inertia * wave.powi(2)),
    ];
    let [found, exact] = [sums, exact].map(|[k, m]| lowest(k, m));
    Ok((found.ok_or("no mass")? / exact.ok_or("no mass")?).sqrt() - 1.0)
}

/// Lowest eigenvalue of a pencil.
fn lowest(k: Matrix2<f64>, m: Matrix2<f64>) -> Option<f64> {
    let lower = m.cholesky()?.l();
    let half = lower.solve_lower_triangular(&k)?;
    Some(lower.solve_lower_triangular(&half.transpose())?.symmetric_eigenvalues().min())
}

/// Elements as long as twice their height: with the bubbles' mass the error falls by the fourth power of the size.
#[test]
fn bending_waves_converge_with_the_fourth_order() -> Outcome {
    for kind in [ElementKind::Quad4, ElementKind::Hex8] {
        let error = |count| bending_wave(kind, true, count, 2.0 * HEIGHT);
        let errors = [error(12)?, error(24)?, error(48)?];
        for pair in errors.windows(2) {
            // 3.95 and 3.99
            assert!(((pair[0] / pair[1]).log2() - 4.0).abs() < 0.1, "{kind:?}: {errors:?}");
        }
    }
    Ok(())
}

/// `rho int |u|^2` of motions with uniform strains, which drive no bubbles, over any shape; and no motion without mass.
#[test]
fn motions_with_uniform_strains_have_their_kinetic_energy() -> Outcome {
    for kind in [ElementKind::Quad4, ElementKind::Hex8] {
        let (p, coords) = (properties(kind)?, distorted(kind));
        let own = mass(kind, &coords, &p, Formulation::default())?;
        let plain = mass(kind, &coords, &p, PLAIN)?;
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (1, 2), (2, 2)] {
            let motion = field(kind, &coords, |x| [0, 1, 2].map(|row| if row == i { x[j] + 0.3 } else { 0.0 }));
            let [found, exact] = [&own, &plain].map(|m| motion.dot(&(m * &motion)));
            assert!((found - exact).abs() <= 1e-13 * exact, "{kind:?}: {found} {exact}");
        }
        assert!(own.symmetric_eigenvalues().min() > 0.0 && own != plain);
    }
    Ok(())
}

/// The bubble along an edge of four times the height moves in the mass as in the stiffness in a plate, and `3/2 (3/8)^3` as far
/// elsewhere. To second order in k h the stiffness is `(k h)^2 / 12` too large, and the mass `(k h)^2 / 6` too small less
/// the bubble's share of as much.
#[test]
fn the_bubbles_of_flat_elements_have_less_mass() -> Outcome {
    for kind in [ElementKind::Quad4, ElementKind::Hex8] {
        for (in_plate, share) in [(true, 1.0), (false, 1.5 * 0.375_f64.powi(3))] {
            let found = bending_wave(kind, in_plate, 48, 4.0 * HEIGHT)?;
            let expected = 0.5 * (1.0 / 12.0 + (1.0 - share) / 6.0) * (TAU / 48.0).powi(2);
            // the next order is (k h)^2 of it, 2 %
            assert!((found / expected - 1.0).abs() < 0.02, "{kind:?}: {found} {expected}");
        }
    }
    Ok(())
}
