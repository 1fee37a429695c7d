//! Reference: NAFEMS FV32 (tapered membrane) and the free annulus 6-9 mm, first natural frequencies of the
//!   same meshes from an independent assembly (NumPy, exact integration; shift-invert Lanczos); FV32 as
//!   published: 44.623, 130.03, 162.70, 246.05, 379.90, 391.44 Hz.
//! Goal: stiffness and mass of Quad4, Tri6, Quad8 in a model.
//! Sketch: membrane 10 m long, 5 m high at the root (fixed, left), 1 m at the tip, plane stress.
//! Conditions: FV32 root fixed; annulus free (three rigid motions).
//! Parameters: FV32 E 200 GPa, nu 0.3, rho 8000, t 0.05 m; annulus E 70 GPa, nu 0.33, rho 2700, t 4 mm.
//!
//! Limit 1e-6: both sides integrate (almost) exactly, what remains is the eigen-solvers' rounding.

use std::path::Path;

use nalgebra::{Cholesky, DMatrix};
use plummer::element::plane::{PlaneAssumption, PlaneKind, PlaneProperties, mass, stiffness};
use plummer::material::Material;
use plummer::mesh::{ElementKind, Mesh};
use plummer::units::LengthUnit;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn plane_kind(kind: ElementKind) -> Option<PlaneKind> {
    PlaneKind::ALL
        .into_iter()
        .find(|plane| plane.name() == kind.name())
}

/// The lowest frequencies in Hz of a mesh with the nodes of a group fixed, by dense Cholesky and QR.
fn frequencies_hz(
    name: &str,
    fixed_group: Option<&str>,
    properties: &PlaneProperties,
) -> Result<Vec<f64>, Box<dyn std::error::Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/{name}.msh"));
    let mesh = Mesh::read_gmsh(&path, LengthUnit::Metre)?;
    let fixed = match fixed_group {
        Some(group) => mesh.group(group)?.nodes.clone(),
        None => Vec::new(),
    };
    let mut number = vec![None; mesh.nodes.len()];
    let mut free = 0;
    for node in (0..mesh.nodes.len()).filter(|node| fixed.binary_search(node).is_err()) {
        number[node] = Some(free);
        free += 2;
    }
    let mut k: DMatrix<f64> = DMatrix::zeros(free, free);
    let mut m: DMatrix<f64> = DMatrix::zeros(free, free);
    for block in &mesh.blocks {
        let Some(kind) = plane_kind(block.kind) else {
            continue;
        };
        for element in block.elements() {
            let coords: Vec<[f64; 2]> = element
                .iter()
                .map(|&node| [mesh.nodes[node][0], mesh.nodes[node][1]])
                .collect();
            let local = [
                stiffness(kind, &coords, properties)?,
                mass(kind, &coords, properties)?,
            ];
            let rows: Vec<Option<usize>> = element
                .iter()
                .flat_map(|&node| [number[node], number[node].map(|row| row + 1)])
                .collect();
            for (i, row) in rows.iter().enumerate() {
                for (j, column) in rows.iter().enumerate() {
                    if let (Some(row), Some(column)) = (row, column) {
                        k[(*row, *column)] += local[0][(i, j)];
                        m[(*row, *column)] += local[1][(i, j)];
                    }
                }
            }
        }
    }
    let l = Cholesky::new(m)
        .ok_or("the mass is not positive definite")?
        .unpack();
    let half = l.solve_lower_triangular(&k).ok_or("singular")?;
    let reduced = l
        .solve_lower_triangular(&half.transpose())
        .ok_or("singular")?;
    let mut hz: Vec<f64> = reduced
        .symmetric_eigenvalues()
        .iter()
        .map(|&value| value.signum() * value.abs().sqrt() / std::f64::consts::TAU)
        .collect();
    hz.sort_by(f64::total_cmp);
    Ok(hz)
}

fn membrane() -> Result<PlaneProperties, Box<dyn std::error::Error>> {
    let steel = Material::new(200e9, 0.3, 8000.0)?;
    Ok(PlaneProperties::new(steel, PlaneAssumption::Stress, 0.05)?)
}

fn annulus() -> Result<PlaneProperties, Box<dyn std::error::Error>> {
    let aluminium = Material::new(70e9, 0.33, 2700.0)?;
    Ok(PlaneProperties::new(
        aluminium,
        PlaneAssumption::Stress,
        4e-3,
    )?)
}

fn assert_close(found: &[f64], expected: &[f64], limit: f64) {
    for (mode, (found, expected)) in found.iter().zip(expected).enumerate() {
        let error = (found / expected - 1.0).abs();
        assert!(
            error < limit,
            "mode {}: {found} Hz, expected {expected}: {error:e}",
            mode + 1
        );
    }
}

#[test]
fn fv32_quad8() -> Outcome {
    let found = frequencies_hz("fv32_quad8", Some("root"), &membrane()?)?;
    let reference = [
        44.62283725462569,
        130.0343403029877,
        162.6982174846914,
        246.05307395148805,
        379.89827083655894,
        391.4357994433057,
        523.0196170728759,
        564.8248169394285,
        606.8702623204338,
        660.9130559732046,
    ];
    assert_close(&found, &reference, 1e-6);
    // published to five digits
    assert_close(
        &found,
        &[44.623, 130.03, 162.70, 246.05, 379.90, 391.44],
        5e-5,
    );
    Ok(())
}

#[test]
fn fv32_tri6() -> Outcome {
    let found = frequencies_hz("fv32_tri6", Some("root"), &membrane()?)?;
    let reference = [
        44.62400370248599,
        130.04059824664702,
        162.69943593543508,
        246.09786749404137,
        380.04977648957794,
        391.44574481782195,
        523.3636857187232,
        564.9044468853051,
        607.0041288139759,
        661.3532523924773,
    ];
    assert_close(&found, &reference, 1e-6);
    Ok(())
}

#[test]
fn free_annulus_quad4() -> Outcome {
    let found = frequencies_hz("ring2d_quad4_coarse", None, &annulus()?)?;
    let reference = [
        33513.837964880026,
        33513.83797411109,
        87616.75017644907,
        87616.75017646674,
        110141.440149909,
        149989.08627993675,
        149989.0862799473,
        153945.3026075593,
        153945.30261171886,
    ];
    assert!(
        found[..3].iter().all(|hz| hz.abs() < 1e-5 * found[3]),
        "{:?}",
        &found[..3]
    );
    assert_close(&found[3..], &reference, 1e-6);
    Ok(())
}
