//! Reference: a manufactured displacement, sum of two plane waves `u = A sin(k.x + phi)`, held by the body force
//!   `-div sigma = ((lambda + mu) (A.k) k + mu |k|^2 A) sin(k.x + phi)`.
//! Goal: order of convergence of every element: p + 1 of the displacement in L2, p the degree; that of frequencies is a built-in
//!   check (`verification::orders`).
//! Sketch: unit square or cube under a smooth map that shears and bends its lines; n cells a side, halved each time.
//! Conditions: displacement prescribed on the whole boundary.
//! Parameters: E 2.5, nu 0.3, rho 1.6, plane stress 0.7 thick; about a third of a wave in the body.
//!
//! Limits: order within 0.1 of theory on the last halving. The map is smooth, so that the elements of finer meshes
//! become parallelograms: on meshes of trapezoids that keep their shape serendipity elements converge one order
//! slower (Arnold, Boffi, Falk, Math. Comp. 71 (2002) 909), which the last test shows.

use plummer::app::verification::{BODY, StructuredMesh};
use plummer::fe::assembly::SystemMatrices;
use plummer::fe::element::continuum::{
    Formulation, Integration, LinearFormulation, PlaneAssumption, QuadratureRule, shape_derivatives, shape_values,
};
use plummer::fe::material::Material;
use plummer::fe::mesh::ElementKind;
use plummer::fe::model::{HousingDescription, HousingModel, HousingPart, PlaneModel};
use plummer::numerics::linalg::{DenseMatrix, SparseCholesky, sparse_times_dense, submatrix};
use std::f64::consts::PI;

const THICKNESS: f64 = 0.7;

fn material() -> Material {
    Material::new(2.5, 0.3, 1.6).unwrap()
}

fn model(grid: &StructuredMesh, kind: ElementKind, formulation: Formulation) -> HousingModel {
    let description = HousingDescription {
        parts: vec![HousingPart { group: BODY.to_owned(), material: material().into() }],
        plane: (kind.dimension() == 2)
            .then_some(PlaneModel { assumption: PlaneAssumption::Stress, thickness: THICKNESS }),
        formulation,
        ..HousingDescription::default()
    };
    HousingModel::new(&grid.mesh, description).unwrap()
}

/// Amplitude, wave vector, phase.
const WAVES: [([f64; 3], [f64; 3], f64); 2] =
    [([1.0, -0.6, 0.5], [1.6, 1.1, -0.9], 0.4), ([0.3, 0.8, -0.7], [-0.9, 1.7, 1.2], -0.7)];

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Displacement and body force at a point; in the plane without a third component.
fn manufactured(x: [f64; 3], dimension: usize) -> ([f64; 3], [f64; 3]) {
    let flat = |v: [f64; 3]| if dimension == 2 { [v[0], v[1], 0.0] } else { v };
    let (mu, lambda) = (material().shear_modulus(), material().lame_lambda());
    let lambda = if dimension == 2 {
        2.0 * lambda * mu / (lambda + 2.0 * mu) // plane stress
    } else {
        lambda
    };
    let (mut u, mut force) = ([0.0; 3], [0.0; 3]);
    for (amplitude, wave, phase) in WAVES {
        let (amplitude, wave) = (flat(amplitude), flat(wave));
        let sine = (dot(wave, flat(x)) + phase).sin();
        for i in 0..3 {
            u[i] += amplitude[i] * sine;
            force[i] += sine * ((lambda + mu) * dot(amplitude, wave) * wave[i] + mu * dot(wave, wave) * amplitude[i]);
        }
    }
    (u, force)
}

/// Rule of high degree, not one of the points where a linear element's error happens to be small.
fn fine_rule(kind: ElementKind) -> QuadratureRule {
    match kind {
        ElementKind::Tri3 | ElementKind::Tri6 => QuadratureRule::Triangle12,
        ElementKind::Quad4 | ElementKind::Quad8 | ElementKind::Quad9 => QuadratureRule::Square4,
        ElementKind::Tet4 | ElementKind::Tet10 => QuadratureRule::Tetrahedron64,
        ElementKind::Pyramid5 | ElementKind::Pyramid13 | ElementKind::Pyramid14 => QuadratureRule::Pyramid5x4,
        ElementKind::Hex8 | ElementKind::Hex20 | ElementKind::Hex27 => QuadratureRule::Cube4,
        _ => QuadratureRule::Wedge12x4,
    }
}

/// Calls `visit(nodes, shape values, position, weight det J)` at every point of every element.
fn at_points(grid: &StructuredMesh, kind: ElementKind, mut visit: impl FnMut(&[usize], &[f64], [f64; 3], f64)) {
    let points = fine_rule(kind).points().iter();
    let tables: Vec<_> =
        points.map(|p| (shape_values(kind, p.natural), shape_derivatives(kind, p.natural), p.weight)).collect();
    for nodes in grid.mesh.blocks[0].elements() {
        for (values, derivatives, weight) in &tables {
            let mut x = [0.0; 3];
            let plane = f64::from(u8::from(kind.dimension() == 2));
            let mut j = [[0.0; 3], [0.0; 3], [0.0, 0.0, plane]];
            for (a, &node) in nodes.iter().enumerate() {
                for i in 0..3 {
                    x[i] += values[a] * grid.mesh.nodes[node][i];
                    for d in 0..kind.dimension() {
                        j[d][i] += derivatives[a][d] * grid.mesh.nodes[node][i];
                    }
                }
            }
            let [a, b, c] = j;
            let across = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            visit(nodes, &values[..nodes.len()], x, weight * dot(a, across));
        }
    }
}

/// Error of the displacement in L2, relative to the displacement.
fn static_error(grid: &StructuredMesh, kind: ElementKind, formulation: Formulation) -> f64 {
    let d = kind.dimension();
    let thickness = if d == 2 { THICKNESS } else { 1.0 };
    let model = model(grid, kind, formulation);
    let stiffness = SystemMatrices::assemble(&model).unwrap().stiffness;
    let mut u: Vec<f64> = (0..model.dof()).map(|dof| manufactured(grid.mesh.nodes[dof / d], d).0[dof % d]).collect();
    let mut load = vec![0.0; model.dof()];
    at_points(grid, kind, |nodes, values, x, volume| {
        let (_, force) = manufactured(x, d);
        for (&node, value) in nodes.iter().zip(values) {
            for i in 0..d {
                load[d * node + i] += thickness * volume * value * force[i];
            }
        }
    });
    let on_boundary = |dof: &usize| (0..d).any(|axis| grid.is_on_face(dof / d, axis));
    let (held, free): (Vec<usize>, Vec<usize>) = model.free_dofs().into_iter().partition(on_boundary);
    let prescribed = DenseMatrix::from_fn(held.len(), 1, |row, _| u[held[row]]);
    let reaction = sparse_times_dense(&submatrix(&stiffness, &free, &held), &prescribed);
    let mut solution: Vec<f64> = (0..free.len()).map(|row| load[free[row]] - reaction[(row, 0)]).collect();
    let factor = SparseCholesky::new(&submatrix(&stiffness, &free, &free)).unwrap();
    factor.solve_vector(&mut solution).unwrap();
    for (&dof, value) in free.iter().zip(solution) {
        u[dof] = value;
    }
    let (mut error, mut norm) = (0.0, 0.0);
    at_points(grid, kind, |nodes, values, x, volume| {
        let (exact, _) = manufactured(x, d);
        for i in 0..d {
            let found: f64 = nodes.iter().zip(values).map(|(node, value)| value * u[d * node + i]).sum();
            error += volume * (found - exact[i]).powi(2);
            norm += volume * exact[i].powi(2);
        }
    });
    (error / norm).sqrt()
}

/// Shear, and lines that bend and draw together; the Jacobian lies between 0.7 and 1.3.
fn smooth(dimension: usize) -> impl Fn([f64; 3]) -> [f64; 3] {
    move |[x, y, z]| {
        let third = if dimension == 2 { 0.0 } else { 1.0 };
        [
            x + 0.1 * y + 0.04 * (PI * y).sin() + 0.03 * (2.0 * x).sin(),
            y + third * (0.08 * z + 0.04 * (2.0 * z).sin()) - 0.03 * x * y,
            third * (z + 0.05 * (PI * x).sin() + 0.03 * z * z),
        ]
    }
}

const INCOMPATIBLE: Formulation =
    Formulation { integration: Integration::Full, linear: LinearFormulation::Incompatible };
const PLAIN: Formulation = Formulation { integration: Integration::Full, linear: LinearFormulation::Plain };
const FOUR_POINT: Formulation =
    Formulation { integration: Integration::FourPoint, linear: LinearFormulation::Incompatible };

fn listed(errors: &[f64]) -> String {
    errors.iter().map(|error| format!("{error:.2e} ")).collect()
}

/// Orders of convergence from each mesh to the next.
fn orders(cells: &[usize], errors: &[f64]) -> Vec<f64> {
    let finer = cells.windows(2).map(|pair| pair[1] as f64 / pair[0] as f64);
    let better = errors.windows(2).map(|pair| (pair[0] / pair[1]).abs());
    better.zip(finer).map(|(error, cells)| error.ln() / cells.ln()).collect()
}

fn displacement_order(kind: ElementKind, formulation: Formulation, straight: bool, cells: &[usize]) {
    let errors: Vec<f64> = cells
        .iter()
        .map(|&n| {
            let mut grid = StructuredMesh::new(kind, [n; 3], smooth(kind.dimension()));
            if straight {
                grid.straighten();
            }
            static_error(&grid, kind, formulation)
        })
        .collect();
    let orders = orders(cells, &errors);
    let degree = kind.order() as f64;
    let edges = if straight { "straight" } else { "curved" };
    println!(
        "{:<8} {:?} {:?} {edges}: cells {cells:?}, errors {}, orders {orders:.3?}",
        kind.name(),
        formulation.linear,
        formulation.integration,
        listed(&errors)
    );
    let last = orders[orders.len() - 1];
    assert!((last - (degree + 1.0)).abs() < 0.1, "{}: order {last}", kind.name());
}

macro_rules! displacement_orders {
    ($($test:ident: $kind:ident, $formulation:expr, $straight:expr, $cells:expr;)*) => {
        $(#[test]
        fn $test() {
            displacement_order(ElementKind::$kind, $formulation, $straight, &$cells);
        })*
    };
}

displacement_orders! {
    tri3: Tri3, PLAIN, true, [6, 12, 24];
    quad4_plain: Quad4, PLAIN, true, [6, 12, 24];
    quad4_incompatible: Quad4, INCOMPATIBLE, true, [6, 12, 24];
    tri6_straight: Tri6, PLAIN, true, [6, 12, 24];
    tri6_curved: Tri6, PLAIN, false, [6, 12, 24];
    quad8_straight: Quad8, PLAIN, true, [6, 12, 24];
    quad8_curved: Quad8, PLAIN, false, [6, 12, 24];
    tet4: Tet4, PLAIN, true, [4, 8, 12];
    wedge6: Wedge6, PLAIN, true, [4, 8, 12];
    hex8_plain: Hex8, PLAIN, true, [4, 8, 12];
    hex8_incompatible: Hex8, INCOMPATIBLE, true, [4, 8, 12];
    tet10_straight_full: Tet10, INCOMPATIBLE, true, [2, 4, 6];
    tet10_straight_four_point: Tet10, FOUR_POINT, true, [2, 4, 6];
    tet10_curved_full: Tet10, INCOMPATIBLE, false, [2, 4, 6];
    tet10_curved_four_point: Tet10, FOUR_POINT, false, [2, 4, 6];
    wedge15_straight: Wedge15, PLAIN, true, [2, 4, 6];
    wedge15_curved: Wedge15, PLAIN, false, [2, 4, 6];
    hex20_straight: Hex20, PLAIN, true, [2, 4, 6];
    hex20_curved: Hex20, PLAIN, false, [2, 4, 6];
    quad9_straight: Quad9, PLAIN, true, [6, 12, 24];
    quad9_curved: Quad9, PLAIN, false, [6, 12, 24];
    hex27_straight: Hex27, PLAIN, true, [2, 4, 6];
    hex27_curved: Hex27, PLAIN, false, [2, 4, 6];
    wedge18_straight: Wedge18, PLAIN, true, [2, 4, 6];
    wedge18_curved: Wedge18, PLAIN, false, [2, 4, 6];
    pyramid5: Pyramid5, PLAIN, true, [2, 4, 6];
    pyramid13_straight: Pyramid13, PLAIN, true, [2, 4, 6];
    pyramid13_curved: Pyramid13, PLAIN, false, [2, 4, 6];
    pyramid14_straight: Pyramid14, PLAIN, true, [2, 4, 6];
    pyramid14_curved: Pyramid14, PLAIN, false, [2, 4, 6];
}

/// Quad8 on trapezoids that keep their shape: order 2, not 3.
#[test]
fn quad8_loses_an_order_on_trapezoids() {
    let cells = [16, 32, 48];
    let errors = cells.map(|n: usize| {
        let alternate = |[x, y, _]: [f64; 3]| {
            // every other line of nodes across y rises and falls by a quarter of a cell
            let (column, row) = ((x * n as f64).round(), y * n as f64);
            let inner = if y > 0.0 && y < 1.0 { 0.25 } else { 0.0 };
            let sign = if (column + row.round()) % 2.0 < 0.5 { 1.0 } else { -1.0 };
            [x, y + sign * inner / n as f64, 0.0]
        };
        let mut grid = StructuredMesh::new(ElementKind::Quad8, [n; 3], alternate);
        grid.straighten();
        static_error(&grid, ElementKind::Quad8, PLAIN)
    });
    let orders = orders(&cells, &errors);
    println!("Quad8 on trapezoids: errors {}, orders {orders:.3?}", listed(&errors));
    assert!((orders[1] - 2.0).abs() < 0.15, "{orders:?}");
}
