//! The patch test: linear displacements on the boundary of a distorted patch, and the inside must follow
//! exactly.
//!
//! Plane: five quadrilaterals or ten triangles. Solid: MacNeal and Harder's cube in a cube (Finite Elem. Anal.
//! Des. 1 (1985) 3), seven hexahedra, each cut into twelve tetrahedra about its centre; twenty wedges on the
//! plane patch of triangles in two layers. Curved inner edges pass as well: the condition is that
//! `int dN/dx dV`, a polynomial, is integrated exactly, which every full rule does. The four points of Tet10 do
//! not.

use std::collections::HashMap;

use nalgebra::{DMatrix, DVector};

use super::fixtures::{all_properties, field};
use super::{FOUR_POINT, Outcome};
use crate::fe::element::continuum::{ContinuumProperties, Formulation, stiffness};
use crate::fe::mesh::ElementKind;

/// Nodes, elements, and which nodes are on the boundary.
struct Patch {
    nodes: Vec<[f64; 3]>,
    elements: Vec<Vec<usize>>,
    outer: Vec<bool>,
}

pub(super) fn check(kind: ElementKind, formulation: Formulation) -> Outcome {
    let straight = build(kind, 0.0);
    // small enough that nothing folds: tetrahedra have the shortest edges
    let bulge = if kind == ElementKind::Tet10 { 0.01 } else { 0.02 };
    let curved = build(kind, bulge);
    for p in all_properties(kind)? {
        let error = error(kind, &p, formulation, &straight)?;
        assert!(error < 1e-12, "{kind:?}: {error:e}");
        let error = self::error(kind, &p, formulation, &curved)?;
        if formulation == FOUR_POINT {
            assert!(error > 1e-5, "four points pass a curved patch: {error:e}");
        } else {
            assert!(error < 1e-12, "{kind:?}, curved: {error:e}");
        }
    }
    Ok(())
}

const PLANE: [[f64; 2]; 8] =
    [[0.0, 0.0], [2.0, 0.0], [2.0, 1.5], [0.0, 1.5], [0.5, 0.4], [1.5, 0.3], [1.6, 1.1], [0.4, 0.9]];
const PLANE_CELLS: [[usize; 4]; 5] = [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]];

/// The inner corners of the cube after MacNeal and Harder 1985, figure 2; the fifth has y = 0.286 instead of
/// 0.186, with which the element outside it has a negative determinant at a corner (-0.0016, computed).
const CUBE: [[f64; 3]; 8] = [
    [0.249, 0.342, 0.192],
    [0.826, 0.288, 0.288],
    [0.850, 0.649, 0.263],
    [0.273, 0.750, 0.230],
    [0.320, 0.286, 0.643],
    [0.677, 0.305, 0.683],
    [0.788, 0.693, 0.644],
    [0.165, 0.745, 0.702],
];
/// The faces of a hexahedron, seen from outside.
const FACES: [[usize; 4]; 6] = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn triangles([a, b, c, d]: [usize; 4]) -> [[usize; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn plane_cells(kind: ElementKind) -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
    let nodes = PLANE.map(|[x, y]| [x, y, 0.0]).to_vec();
    let cells = if kind.corners() == 3 {
        let cut = PLANE_CELLS.into_iter().flat_map(triangles);
        cut.map(Vec::from).collect()
    } else {
        PLANE_CELLS.map(Vec::from).to_vec()
    };
    (nodes, cells)
}

/// Two layers on the plane triangles, the inner nodes of the one between moved.
fn wedge_cells() -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
    let mut nodes = Vec::new();
    for layer in 0..3 {
        for (i, [x, y]) in PLANE.into_iter().enumerate() {
            let moved = if layer == 1 && i > 3 { 0.1 } else { 0.0 };
            let s = moved * (3.0 * i as f64).sin();
            nodes.push([x + s, y - 0.5 * s, 0.6 * layer as f64 + 0.8 * s]);
        }
    }
    let mut cells = Vec::new();
    for layer in 0..2 {
        for [a, b, c] in PLANE_CELLS.into_iter().flat_map(triangles) {
            let up = |corner: usize, level: usize| corner + 8 * level;
            let levels = [layer, layer + 1];
            cells.push(levels.into_iter().flat_map(|l| [up(a, l), up(b, l), up(c, l)]).collect());
        }
    }
    (nodes, cells)
}

/// Corners 0 to 7 of the cube outside, 8 to 15 inside.
fn hexahedron_cells() -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
    let natural = &ElementKind::Hex8.natural_nodes();
    let mut nodes: Vec<[f64; 3]> = natural.iter().map(|n| n.map(|v| 0.5 * (v + 1.0))).collect();
    nodes.extend(CUBE);
    let mut cells = vec![(8..16).collect()];
    for face in FACES {
        // the outer face seen from inside comes first, the inner one follows
        let [a, b, c, d] = face;
        let bottom = [a, d, c, b];
        cells.push(bottom.into_iter().chain(bottom.map(|n| n + 8)).collect());
    }
    (nodes, cells)
}

/// Each hexahedron about its centre; the diagonal of a face starts at its lowest node, so that both sides
/// agree.
fn tetrahedron_cells() -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
    let (mut nodes, hexahedra) = hexahedron_cells();
    let mut cells = Vec::new();
    for hexahedron in hexahedra {
        let centre = nodes.len();
        let mean = |d: usize| hexahedron.iter().map(|&n: &usize| nodes[n][d]).sum::<f64>() / 8.0;
        let at = [mean(0), mean(1), mean(2)];
        nodes.push(at);
        for face in FACES {
            let mut face = face.map(|corner| hexahedron[corner]);
            let lowest = (0..4).min_by_key(|&i| face[i]).unwrap_or_default();
            face.rotate_left(lowest);
            for [a, b, c] in triangles(face) {
                cells.push(vec![a, c, b, centre]);
            }
        }
    }
    (nodes, cells)
}

/// The patch of a kind, with the middle nodes of inner edges moved by `bulge`.
fn build(kind: ElementKind, bulge: f64) -> Patch {
    let (mut nodes, cells) = match kind.corners() {
        3 => plane_cells(kind),
        4 if kind.dimension() == 2 => plane_cells(kind),
        4 => tetrahedron_cells(),
        6 => wedge_cells(),
        _ => hexahedron_cells(),
    };
    let high = nodes.iter().fold([0.0_f64; 3], |m, n| [0, 1, 2].map(|d| m[d].max(n[d])));
    let sides = |node: &[f64; 3]| {
        let on = |d: usize| node[d].abs() < 1e-9 || (node[d] - high[d]).abs() < 1e-9;
        (0..kind.dimension()).any(on)
    };
    let mut middles = HashMap::new();
    let mut elements = Vec::new();
    for cell in cells {
        let mut element = cell.clone();
        for &[a, b] in kind.middle_edges() {
            let (a, b) = (cell[a].min(cell[b]), cell[a].max(cell[b]));
            element.push(*middles.entry((a, b)).or_insert_with(|| {
                let mut middle = [0, 1, 2].map(|d| 0.5 * (nodes[a][d] + nodes[b][d]));
                if !sides(&middle) {
                    for (d, value) in middle[..kind.dimension()].iter_mut().enumerate() {
                        *value += bulge * (4.0 * nodes.len() as f64 + 2.0 * d as f64).sin();
                    }
                }
                nodes.push(middle);
                nodes.len() - 1
            }));
        }
        elements.push(element);
    }
    let outer = nodes.iter().map(sides).collect();
    Patch { nodes, elements, outer }
}

/// The largest error inside, relative to the largest displacement.
fn error(
    kind: ElementKind,
    p: &ContinuumProperties,
    formulation: Formulation,
    patch: &Patch,
) -> Result<f64, Box<dyn std::error::Error>> {
    let n = kind.dimension();
    let dof = n * patch.nodes.len();
    let mut k = DMatrix::zeros(dof, dof);
    for element in &patch.elements {
        let coords: Vec<[f64; 3]> = element.iter().map(|&n| patch.nodes[n]).collect();
        let local = stiffness(kind, &coords, p, formulation)?;
        for (i, &a) in element.iter().enumerate() {
            for (j, &b) in element.iter().enumerate() {
                let mut target = k.view_mut((n * a, n * b), (n, n));
                target += local.view((n * i, n * j), (n, n));
            }
        }
    }
    let exact = field(kind, &patch.nodes, |[x, y, z]| {
        [
            1e-3 * (1.0 + 2.0 * x - y + 0.4 * z),
            1e-3 * (0.5 * x + 3.0 * y - 1.2 * z),
            1e-3 * (0.7 * x - 0.2 * y - 1.5 * z - 0.3),
        ]
    });
    let inside: Vec<usize> = (0..dof).filter(|i| !patch.outer[i / n]).collect();
    assert!(inside.len() >= 8, "{kind:?}: the patch needs inner nodes");
    let k_ii = k.select_rows(&inside).select_columns(&inside);
    let mut held = exact.clone();
    inside.iter().for_each(|&i| held[i] = 0.0);
    let force = &k * &held;
    let load = DVector::from_fn(inside.len(), |i, _| -force[inside[i]]);
    let found = k_ii.cholesky().ok_or("the patch is singular")?.solve(&load);
    let errors = inside.iter().zip(found.iter()).map(|(&i, value)| (value - exact[i]).abs());
    Ok(errors.fold(0.0, f64::max) / exact.amax())
}
