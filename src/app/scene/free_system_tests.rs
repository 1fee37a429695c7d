//! Rows of exported matrices: do they move as their names say, and have they the frequencies of the case.

use nalgebra::{DMatrix, Vector3};

use super::structure::FreeSystem;
use crate::app::case::{Case, Source};
use crate::app::commands::modes::compute_mode_shapes;
use crate::formats::{DofDirection, DofLabel};
use crate::numerics::Unwatched;
use crate::numerics::linalg::{SparseMatrix, sparse_times_dense};

/// A case beside the example meshes; the tie's axes are turned against the mesh's.
fn case(text: &str) -> Case {
    let root = env!("CARGO_MANIFEST_DIR");
    Case::from_source(Source { path: format!("{root}/meshes/a.toml").into(), text: text.to_owned(), set: Vec::new() })
        .unwrap()
}

const RING: &str = "[ring]\nnodes = 24\nouter_radius = 6e-3\n\
    sections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n";

fn solid(rest: &str) -> String {
    format!(
        "[housing]\nmesh = \"pedestal.msh\"\nlength_unit = \"mm\"\n\
         parts = [{{ group = \"housing\", material = \"aluminium\" }}]\n{rest}"
    )
}

fn plane(rest: &str) -> String {
    format!(
        "[housing]\nmesh = \"ring_6_9_coarse.msh\"\nlength_unit = \"mm\"\n\
         plane = {{ assumption = \"stress\", thickness = 4e-3 }}\n\
         parts = [{{ group = \"housing\", material = \"aluminium\" }}]\n{rest}"
    )
}

/// A sliding ring must be held; `spring` (N/m) may be next to nothing.
fn tied(fit: &str, axis: &str, spring: &str) -> String {
    format!(
        "{RING}tie = {{ group = \"bore\", fit = \"{fit}\", centre = [0, 0, 0], axis = {axis}, zero_deg = [1, 2, 0] }}\n\
         supports = [{{ from_deg = 0, to_deg = 360, spring = {{ x = {spring}, y = {spring} }} }}]\n"
    )
}

/// Displacements of a free body that moves by `shift` and turns by `turn` about the origin, from the labels alone.
fn rigid(rows: &[DofLabel], shift: [f64; 3], turn: [f64; 3]) -> Vec<f64> {
    let (shift, turn) = (Vector3::from(shift), Vector3::from(turn));
    let component = |row: &DofLabel| {
        let axis = Vector3::from(row.axis);
        match row.direction {
            DofDirection::About(_) => axis.dot(&turn),
            _ => axis.dot(&(shift + turn.cross(&Vector3::from(row.position)))),
        }
    };
    rows.iter().map(component).collect()
}

fn energy(a: &SparseMatrix, x: &[f64]) -> f64 {
    let x = crate::numerics::linalg::DenseMatrix::from_fn(x.len(), 1, |row, _| x[row]);
    (x.transpose() * sparse_times_dense(a, &x))[(0, 0)]
}

/// A body that nothing holds has no strain energy in a rigid motion, and twice the kinetic energy of a unit velocity
/// is its mass: only if every row's node, direction and axis is the right one.
#[test]
fn rows_move_as_their_labels_say() {
    let ring_mass = {
        let ring = FreeSystem::build(&case(RING), &Unwatched).unwrap();
        energy(&ring.mass, &rigid(&ring.rows, [1.0, 0.0, 0.0], [0.0; 3]))
    };
    for (text, in_space) in [
        (RING.to_owned(), false),
        (plane(""), false),
        (plane(&tied("bonded", "[0, 0, -1]", "1e-6")), false),
        (plane(&tied("sliding", "[0, 0, -1]", "1e-6")), false),
        (solid(""), true),
        (solid(&tied("bonded", "[0, 0, -1]", "1e-6")), true),
        (solid(&tied("sliding", "[0, 0, -1]", "1e-6")), true),
    ] {
        let system = FreeSystem::build(&case(&text), &Unwatched).unwrap();
        let stiffest = system.stiffness.diag().iter().map(|(_, &k)| k).fold(0.0, f64::max);
        let mut motions = vec![([1.0, 0.0, 0.0], [0.0; 3]), ([0.0, 1.0, 0.0], [0.0; 3])];
        motions.push(([0.0; 3], [0.0, 0.0, 100.0]));
        if in_space {
            motions.push(([0.0, 0.0, 1.0], [0.0; 3]));
            motions.push(([0.0; 3], [100.0, 0.0, 0.0]));
            motions.push(([0.0; 3], [0.0, 100.0, 0.0]));
        }
        for (shift, turn) in motions {
            // a hundred radians a metre moves the bodies' ends by about a metre
            let x = rigid(&system.rows, shift, turn);
            let strain = energy(&system.stiffness, &x);
            // roundings of about 1e4 terms of the largest stiffness
            assert!(strain.abs() < 1e-10 * stiffest, "{text} {shift:?} {turn:?}: {strain:e}");
        }
        let masses: Vec<f64> = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
            .map(|shift| energy(&system.mass, &rigid(&system.rows, shift, [0.0; 3])))
            .to_vec();
        assert!((masses[0] / masses[1] - 1.0).abs() < 1e-12, "{text} {masses:?}");
        let ring = if text.contains("[ring]") { ring_mass } else { 0.0 };
        let housing = masses[0] - ring;
        let expected = match text.contains("[housing]") {
            false => 0.0,
            // an annulus of radii 6 and 9 mm, 4 mm thick; curved edges of Quad8 miss 1e-5 of it
            true if !in_space => 2700.0 * 4e-3 * std::f64::consts::PI * (81e-6 - 36e-6),
            // the drawn volume of the pedestal; curved edges of Tet10 miss 1.1e-4 of it
            true => {
                let pi = std::f64::consts::PI;
                let section = 44.0 * 5.0 + 20.0 * 8.0 + pi * (50.0 - 36.0);
                2700.0 * 1e-9 * (10.0 * section - 40.0 * pi)
            }
        };
        assert!((housing - expected).abs() < 2e-4 * expected.max(ring), "{text} {housing} {expected}");
    }
}

/// A dense solver on the rows, against the survey of `plummer modes`.
#[test]
fn the_frequencies_are_those_of_the_case() {
    let modes = "\n[modes]\ncount = 8\n";
    for text in [
        format!("{RING}supports = [{{ from_deg = 180, to_deg = 360, spring = {{ x = 1e5, y = 1e5 }} }}]{modes}"),
        plane(&format!("{}{modes}", tied("bonded", "[0, 0, 1]", "1e5"))),
    ] {
        let case = case(&text);
        let system = FreeSystem::build(&case, &Unwatched).unwrap();
        let (_, shapes) = compute_mode_shapes(&case, &Unwatched).unwrap();
        let n = system.rows.len();
        let dense = |a: &SparseMatrix| DMatrix::from_fn(n, n, |row, column| a.get(row, column).copied().unwrap_or(0.0));
        let factor = dense(&system.mass).cholesky().unwrap();
        let half = factor.l().solve_lower_triangular(&dense(&system.stiffness)).unwrap();
        let whole = factor.l().solve_lower_triangular(&half.transpose()).unwrap();
        let mut values: Vec<f64> = whole.symmetric_eigenvalues().iter().copied().collect();
        values.sort_by(f64::total_cmp);
        for (value, expected) in values.iter().zip(&shapes.frequencies_hz) {
            let found = value.max(0.0).sqrt() / std::f64::consts::TAU;
            // dense eigenvalues are good to 1e-15 of the largest, (2 pi 1e7 Hz)^2: half a hertz for rigid modes
            assert!((found - expected).abs() < 1e-8 * expected + 1.0, "{found} {expected}");
        }
    }
}
