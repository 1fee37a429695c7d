//! Bending: what the incompatible modes are for.

use nalgebra::{DMatrix, DVector};

use super::{Outcome, PLAIN};
use crate::fe::element::continuum::{ContinuumProperties, Formulation, PlaneAssumption, stiffness};
use crate::fe::material::{ElasticMaterial, Material};
use crate::fe::mesh::ElementKind;

const LENGTH: f64 = 1.0;
const HEIGHT: f64 = 0.05;
const THICKNESS: f64 = 0.04;
const ELEMENTS: usize = 4;

/// Deflection of the end of a cantilever under an end moment, one layer of elements, over `M L^2 / (2 E I)`.
fn deflection(
    kind: ElementKind,
    poisson: f64,
    formulation: Formulation,
    slant: f64,
) -> Result<f64, Box<dyn std::error::Error>> {
    let young = 70e9;
    let material = ElasticMaterial::from(Material::new(young, poisson, 2700.0)?);
    let n = kind.dimension();
    let p = match n {
        2 => ContinuumProperties::plane(&material, PlaneAssumption::Stress, THICKNESS)?,
        _ => ContinuumProperties::solid(&material),
    };
    // a station is a section: its nodes, (y, z) in a section
    let section: &[[f64; 2]] = match n {
        2 => &[[0.0, 0.0], [HEIGHT, 0.0]],
        _ => &[[0.0, 0.0], [HEIGHT, 0.0], [HEIGHT, THICKNESS], [0.0, THICKNESS]],
    };
    let per = section.len();
    let mut nodes = Vec::new();
    for station in 0..=ELEMENTS {
        let inner = station > 0 && station < ELEMENTS;
        let sign = if station % 2 == 0 { 1.0 } else { -1.0 };
        for &[y, z] in section {
            let lean = if inner { slant * sign * (y - 0.5 * HEIGHT) } else { 0.0 };
            nodes.push([LENGTH * station as f64 / ELEMENTS as f64 + lean, y, z]);
        }
    }
    let mut k = DMatrix::zeros(n * nodes.len(), n * nodes.len());
    for station in 0..ELEMENTS {
        let (left, right) = (station * per, (station + 1) * per);
        let element: Vec<usize> = match n {
            2 => vec![left, right, right + 1, left + 1],
            _ => [0, 1, 2, 3].map(|i| left + i).into_iter().chain([0, 1, 2, 3].map(|i| right + i)).collect(),
        };
        let coords: Vec<_> = element.iter().map(|&i| nodes[i]).collect();
        let local = stiffness(kind, &coords, &p, formulation)?;
        for (i, &a) in element.iter().enumerate() {
            for (j, &b) in element.iter().enumerate() {
                let mut target = k.view_mut((n * a, n * b), (n, n));
                target += local.view((n * i, n * j), (n, n));
            }
        }
    }
    let moment = 1.0;
    let mut force = DVector::zeros(n * nodes.len());
    let last = ELEMENTS * per;
    for (i, &[y, _]) in section.iter().enumerate() {
        let side = if y > 0.0 { -1.0 } else { 1.0 };
        force[n * (last + i)] = side * moment / HEIGHT * 2.0 / per as f64;
    }
    // x of the first section held, y and z of one node of it, and what would turn it about x
    let mut held: Vec<usize> = (0..per).map(|i| n * i).collect();
    held.push(1);
    if n == 3 {
        held.extend([2, 5]);
    }
    let free: Vec<usize> = (0..n * nodes.len()).filter(|i| !held.contains(i)).collect();
    let k_ff = k.select_rows(&free).select_columns(&free);
    let solution = k_ff.cholesky().ok_or("the beam is loose")?.solve(&force.select_rows(&free));
    let wanted = n * last + 1;
    let at = free.iter().position(|&i| i == wanted).ok_or("the end is held")?;
    let inertia = THICKNESS * HEIGHT.powi(3) / 12.0;
    Ok(solution[at] / (moment * LENGTH * LENGTH / (2.0 * young * inertia)))
}

/// Slenderness 20 in one layer of four elements. The bound is round-off times the condition of a slender beam.
#[test]
fn one_layer_bends_as_beam_theory_says() -> Outcome {
    for kind in [ElementKind::Quad4, ElementKind::Hex8] {
        for poisson in [0.0, 0.33] {
            let found = deflection(kind, poisson, Formulation::default(), 0.0)?;
            assert!((found - 1.0).abs() < 1e-9, "{kind:?} nu {poisson}: {found}");
        }
        // the plain element locks: 1 / (1 + (length / height)^2 / 2) with nu = 0, for elements of 5 : 1
        let locked = deflection(kind, 0.0, PLAIN, 0.0)?;
        assert!((locked - 1.0 / 13.5).abs() < 1e-9, "{kind:?}: {locked}");
    }
    Ok(())
}

/// Distorted elements bend too stiffly, with either formulation (MacNeal 1987: no element can do both that and
/// pass the patch test), but more than twice as softly with the modes.
#[test]
fn slanted_elements_stiffen() -> Outcome {
    for kind in [ElementKind::Quad4, ElementKind::Hex8] {
        let modes = deflection(kind, 0.0, Formulation::default(), 0.5)?;
        let plain = deflection(kind, 0.0, PLAIN, 0.5)?;
        assert!(modes > 2.0 * plain && modes < 1.0, "{kind:?}: {modes} {plain}");
    }
    Ok(())
}
