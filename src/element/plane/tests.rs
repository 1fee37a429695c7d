//! One harness for every plane element: a line an element, all checks the same.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use super::*;
use crate::element::ElementError;
use crate::material::Material;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Corners of a distorted triangle and quadrilateral, m.
const TRIANGLE: [[f64; 2]; 3] = [[0.1, -0.2], [1.3, 0.15], [0.35, 0.9]];
const QUADRILATERAL: [[f64; 2]; 4] = [[0.1, -0.2], [1.3, 0.15], [1.1, 1.2], [-0.2, 0.9]];

#[test]
fn tri3() -> Outcome {
    harness(PlaneKind::Tri3)
}

#[test]
fn tri6() -> Outcome {
    harness(PlaneKind::Tri6)
}

#[test]
fn quad4() -> Outcome {
    harness(PlaneKind::Quad4)
}

#[test]
fn quad8() -> Outcome {
    harness(PlaneKind::Quad8)
}

fn harness(kind: PlaneKind) -> Outcome {
    partition_of_unity(kind);
    nodal_property(kind);
    derivatives_against_differences(kind);
    for assumption in [PlaneAssumption::Stress, PlaneAssumption::Strain] {
        let properties = properties(assumption)?;
        for coords in [straight(kind), curved(kind)] {
            symmetry(kind, &coords, &properties)?;
            three_rigid_motions_and_no_other_mechanism(kind, &coords, &properties)?;
            mass_is_density_times_volume(kind, &coords, &properties)?;
        }
        uniform_strain_energy(kind, &properties)?;
        inertia_about_the_origin(kind, &properties)?;
        patch(kind, &properties, 0.0)?;
        patch(kind, &properties, 0.03)?;
    }
    rules_fire(kind)
}

fn properties(assumption: PlaneAssumption) -> Result<PlaneProperties, Box<dyn std::error::Error>> {
    let aluminium = Material::new(70e9, 0.33, 2700.0)?;
    Ok(PlaneProperties::new(aluminium, assumption, 4e-3)?)
}

fn is_triangle(kind: PlaneKind) -> bool {
    matches!(kind, PlaneKind::Tri3 | PlaneKind::Tri6)
}

fn corners(kind: PlaneKind) -> &'static [[f64; 2]] {
    if is_triangle(kind) {
        &TRIANGLE
    } else {
        &QUADRILATERAL
    }
}

/// Straight sides, middle nodes in the middle.
fn straight(kind: PlaneKind) -> Vec<[f64; 2]> {
    let corners = corners(kind);
    let mut coords = corners.to_vec();
    if kind.nodes() > corners.len() {
        for (i, a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            coords.push([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
        }
    }
    coords
}

/// The same with middle nodes moved, if there are any.
fn curved(kind: PlaneKind) -> Vec<[f64; 2]> {
    let mut coords = straight(kind);
    for (i, node) in coords.iter_mut().enumerate().skip(corners(kind).len()) {
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        node[0] += 0.04 * sign;
        node[1] -= 0.03;
    }
    coords
}

fn sample_points(kind: PlaneKind) -> Vec<[f64; 2]> {
    let square = |i: usize| -0.95 + 0.19 * i as f64;
    let mut points = Vec::new();
    for i in 0..=10 {
        for j in 0..=10 {
            let (a, b) = (square(i), square(j));
            if !is_triangle(kind) {
                points.push([a, b]);
            } else if a + b < 0.0 {
                points.push([0.5 * (a + 1.0), 0.5 * (b + 1.0)]);
            }
        }
    }
    points
}

fn partition_of_unity(kind: PlaneKind) {
    for point in sample_points(kind) {
        let sum: f64 = shape_values(kind, point).iter().sum();
        assert!((sum - 1.0).abs() < 1e-14, "{kind:?} {point:?}: {sum}");
        for direction in 0..2 {
            let sum: f64 = shape_derivatives(kind, point)
                .iter()
                .map(|d| d[direction])
                .sum();
            assert!(sum.abs() < 1e-14, "{kind:?} {point:?}: {sum}");
        }
    }
}

fn nodal_property(kind: PlaneKind) {
    for (i, &point) in kind.natural_nodes().iter().enumerate() {
        for (j, value) in shape_values(kind, point).into_iter().enumerate() {
            let expected = if i == j { 1.0 } else { 0.0 };
            assert!(
                (value - expected).abs() < 1e-15,
                "{kind:?} N_{j} at node {i}: {value}"
            );
        }
    }
}

fn derivatives_against_differences(kind: PlaneKind) {
    let h = 1e-5;
    for [xi, eta] in sample_points(kind) {
        let exact = shape_derivatives(kind, [xi, eta]);
        for direction in 0..2 {
            let (dx, dy) = if direction == 0 { (h, 0.0) } else { (0.0, h) };
            let plus = shape_values(kind, [xi + dx, eta + dy]);
            let minus = shape_values(kind, [xi - dx, eta - dy]);
            for (i, derivative) in exact.iter().enumerate() {
                let difference = (plus[i] - minus[i]) / (2.0 * h);
                let error = (difference - derivative[direction]).abs();
                assert!(
                    error < 1e-9,
                    "{kind:?} node {i} direction {direction}: {error}"
                );
            }
        }
    }
}

fn symmetry(kind: PlaneKind, coords: &[[f64; 2]], p: &PlaneProperties) -> Result<(), ElementError> {
    for matrix in [stiffness(kind, coords, p)?, mass(kind, coords, p)?] {
        assert_eq!(matrix.shape(), (kind.dof(), kind.dof()));
        let error = (&matrix - matrix.transpose()).norm();
        assert!(error <= 1e-15 * matrix.norm(), "{kind:?}: {error}");
    }
    Ok(())
}

/// A displacement field at the nodes.
fn field(coords: &[[f64; 2]], u: impl Fn(f64, f64) -> [f64; 2]) -> DVector<f64> {
    let values: Vec<f64> = coords.iter().flat_map(|&[x, y]| u(x, y)).collect();
    DVector::from_vec(values)
}

fn three_rigid_motions_and_no_other_mechanism(
    kind: PlaneKind,
    coords: &[[f64; 2]],
    p: &PlaneProperties,
) -> Result<(), ElementError> {
    let k = stiffness(kind, coords, p)?;
    let rigid = [
        field(coords, |_, _| [1.0, 0.0]),
        field(coords, |_, _| [0.0, 1.0]),
        field(coords, |x, y| [-y, x]),
    ];
    for motion in rigid {
        let force = (&k * &motion).norm();
        assert!(
            force <= 1e-14 * k.norm() * motion.norm(),
            "{kind:?}: {force}"
        );
    }
    let mut values: Vec<f64> = k.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    let largest = values[values.len() - 1];
    assert!(
        values[3] > 1e-4 * largest,
        "{kind:?} has a mechanism: {values:?}"
    );
    Ok(())
}

fn mass_is_density_times_volume(
    kind: PlaneKind,
    coords: &[[f64; 2]],
    p: &PlaneProperties,
) -> Result<(), ElementError> {
    let m = mass(kind, coords, p)?;
    let expected = p.material.density * p.thickness * area(kind, coords)?;
    for motion in [
        field(coords, |_, _| [1.0, 0.0]),
        field(coords, |_, _| [0.0, 1.0]),
    ] {
        let found = motion.dot(&(&m * &motion));
        assert!(
            (found / expected - 1.0).abs() < 1e-14,
            "{kind:?}: {found} {expected}"
        );
    }
    let smallest = m.symmetric_eigenvalues().min();
    assert!(smallest > 0.0, "{kind:?}: mass eigenvalue {smallest}");
    Ok(())
}

/// Area and polar moment about the origin of a polygon (Green's theorem).
fn polygon(corners: &[[f64; 2]]) -> (f64, f64) {
    let (mut area, mut polar) = (0.0, 0.0);
    for (i, a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let cross = a[0] * b[1] - b[0] * a[1];
        area += cross / 2.0;
        for d in 0..2 {
            polar += cross * (a[d] * a[d] + a[d] * b[d] + b[d] * b[d]) / 12.0;
        }
    }
    (area, polar)
}

/// A rotation meets `rho t int (x^2 + y^2) dA`: only an exact mass integration passes.
fn inertia_about_the_origin(kind: PlaneKind, p: &PlaneProperties) -> Result<(), ElementError> {
    let coords = straight(kind);
    let (polygon_area, polar) = polygon(corners(kind));
    assert!((area(kind, &coords)? / polygon_area - 1.0).abs() < 1e-14);
    let rotation = field(&coords, |x, y| [-y, x]);
    let found = rotation.dot(&(mass(kind, &coords, p)? * &rotation));
    let expected = p.material.density * p.thickness * polar;
    assert!(
        (found / expected - 1.0).abs() < 1e-14,
        "{kind:?}: {found} {expected}"
    );
    Ok(())
}

/// Energy of a uniform strain, written out by hand: `t A / 2 (sigma . eps)`.
fn uniform_strain_energy(kind: PlaneKind, p: &PlaneProperties) -> Result<(), ElementError> {
    let (e, nu) = (p.material.young, p.material.poisson);
    let coords = straight(kind);
    let k = stiffness(kind, &coords, p)?;
    let volume = p.thickness * polygon(corners(kind)).0;
    let energy = |u: DVector<f64>| 0.5 * u.dot(&(&k * &u)) / volume;
    let shear = energy(field(&coords, |_, y| [y, 0.0]));
    let shear_expected = 0.25 * e / (1.0 + nu);
    assert!(
        (shear / shear_expected - 1.0).abs() < 1e-13,
        "{kind:?} shear"
    );
    // equal strain in x and y: sigma = E / (1 - nu) in stress, E / ((1 + nu)(1 - 2 nu)) in strain
    let swelling = energy(field(&coords, |x, y| [x, y]));
    let expected = match p.assumption {
        PlaneAssumption::Stress => e / (1.0 - nu),
        PlaneAssumption::Strain => e / ((1.0 + nu) * (1.0 - 2.0 * nu)),
    };
    assert!(
        (swelling / expected - 1.0).abs() < 1e-13,
        "{kind:?} swelling"
    );
    // stretching along x with y held: sigma_x = E / (1 - nu^2), or the confined modulus
    let stretch = energy(field(&coords, |x, _| [x, 0.0]));
    let expected = match p.assumption {
        PlaneAssumption::Stress => 0.5 * e / (1.0 - nu * nu),
        PlaneAssumption::Strain => 0.5 * e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)),
    };
    assert!((stretch / expected - 1.0).abs() < 1e-13, "{kind:?} stretch");
    Ok(())
}

/// A distorted patch of five quadrilaterals or ten triangles, inner middle nodes moved by `bulge`.
fn patch_mesh(kind: PlaneKind, bulge: f64) -> (Vec<[f64; 2]>, Vec<Vec<usize>>, usize) {
    let mut nodes = vec![
        [0.0, 0.0],
        [2.0, 0.0],
        [2.2, 1.6],
        [0.0, 1.4],
        [0.5, 0.4],
        [1.5, 0.3],
        [1.6, 1.1],
        [0.4, 0.9],
    ];
    let quads = [
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
        [4, 5, 6, 7],
    ];
    let cells: Vec<Vec<usize>> = if is_triangle(kind) {
        let split = |[a, b, c, d]: [usize; 4]| [vec![a, b, c], vec![a, c, d]];
        quads.into_iter().flat_map(split).collect()
    } else {
        quads.into_iter().map(Vec::from).collect()
    };
    let mut edges: Vec<([usize; 2], usize)> = Vec::new();
    let mut elements = Vec::new();
    for cell in cells {
        let mut element = cell.clone();
        if kind.nodes() > cell.len() {
            for (i, &a) in cell.iter().enumerate() {
                let b = cell[(i + 1) % cell.len()];
                let key = [a.min(b), a.max(b)];
                let known = edges.iter().find(|edge| edge.0 == key).map(|edge| edge.1);
                let middle = known.unwrap_or_else(|| {
                    let (p, q): ([f64; 2], [f64; 2]) = (nodes[a], nodes[b]);
                    let outer = key[1] < 4;
                    let moved = if outer { 0.0 } else { bulge };
                    nodes.push([0.5 * (p[0] + q[0]) + moved, 0.5 * (p[1] + q[1]) - moved]);
                    edges.push((key, nodes.len() - 1));
                    nodes.len() - 1
                });
                element.push(middle);
            }
        }
        elements.push(element);
    }
    (nodes, elements, 4)
}

/// Linear displacements on the boundary of the patch: the inside must follow exactly.
fn patch(kind: PlaneKind, p: &PlaneProperties, bulge: f64) -> Outcome {
    let (nodes, elements, outer_corners) = patch_mesh(kind, bulge);
    let dof = 2 * nodes.len();
    let mut k = DMatrix::zeros(dof, dof);
    for element in &elements {
        let coords: Vec<[f64; 2]> = element.iter().map(|&n| nodes[n]).collect();
        let local = stiffness(kind, &coords, p)?;
        for (i, &a) in element.iter().enumerate() {
            for (j, &b) in element.iter().enumerate() {
                let block = local.view((2 * i, 2 * j), (2, 2));
                let mut target = k.view_mut((2 * a, 2 * b), (2, 2));
                target += block;
            }
        }
    }
    let exact = field(&nodes, |x, y| {
        [1e-3 * (1.0 + 2.0 * x - y), 1e-3 * (0.5 * x + 3.0 * y)]
    });
    let on_side = |n: usize| {
        let [x, y] = nodes[n];
        let right = (x - 2.0 - 0.2 * y / 1.6).abs() < 1e-9;
        let top = (y - 1.4 - 0.2 * x / 2.2).abs() < 1e-9;
        n < outer_corners || x.abs() < 1e-9 || y.abs() < 1e-9 || right || top
    };
    let inside: Vec<usize> = (0..dof).filter(|i| !on_side(i / 2)).collect();
    assert!(inside.len() >= 8, "{kind:?}: the patch needs inner nodes");
    let k_ii = DMatrix::from_fn(inside.len(), inside.len(), |i, j| k[(inside[i], inside[j])]);
    let mut held = exact.clone();
    inside.iter().for_each(|&i| held[i] = 0.0);
    let force = &k * &held;
    let load = DVector::from_fn(inside.len(), |i, _| -force[inside[i]]);
    let found = k_ii.lu().solve(&load).ok_or("the patch is singular")?;
    for (i, value) in inside.iter().zip(found.iter()) {
        let error = (value - exact[*i]).abs() / exact.amax();
        assert!(error < 1e-12, "{kind:?} bulge {bulge}, dof {i}: {error}");
    }
    Ok(())
}

fn message<T: std::fmt::Debug>(result: Result<T, ElementError>) -> String {
    match result {
        Ok(value) => format!("accepted: {value:?}"),
        Err(error) => error.to_string(),
    }
}

/// Every rule fires, for stiffness, mass and area alike.
fn rules_fire(kind: PlaneKind) -> Outcome {
    let p = properties(PlaneAssumption::Stress)?;
    let name = kind.name();
    let good = straight(kind);
    let mirrored: Vec<_> = good.iter().map(|&[x, y]| [-x, y]).collect();
    let flat: Vec<_> = good.iter().map(|&[x, _]| [x, 2.0 * x]).collect();
    let mut missing = good.clone();
    missing[1][1] = f64::NAN;
    let cases: [(&[[f64; 2]], String); 4] = [
        (
            &mirrored,
            format!("the {name} element is inverted: its nodes run clockwise ("),
        ),
        (
            &flat,
            format!("the {name} element is degenerate or folded: Jacobian determinant "),
        ),
        (
            &missing,
            format!("node 1 of the {name} element has the coordinates (1.3, NaN) m: expected"),
        ),
        (
            &good[1..],
            format!(
                "a {name} element has {0} nodes, found {1}",
                kind.nodes(),
                kind.nodes() - 1
            ),
        ),
    ];
    for (coords, expected) in cases {
        let found = [
            message(stiffness(kind, coords, &p)),
            message(mass(kind, coords, &p)),
            message(area(kind, coords)),
        ];
        for text in found {
            assert!(text.starts_with(&expected), "{text}\nexpected {expected}");
        }
    }
    let mut buffer = DMatrix::zeros(3, 2);
    let expected = format!(
        "the matrix of a {name} element is {0} x {0}, the buffer is 3 x 2",
        kind.dof()
    );
    assert_eq!(
        message(stiffness_into(kind, &good, &p, &mut buffer)),
        expected
    );
    assert_eq!(message(mass_into(kind, &good, &p, &mut buffer)), expected);
    Ok(())
}

#[test]
fn inverted_and_folded_elements_say_where() -> Outcome {
    let p = properties(PlaneAssumption::Stress)?;
    let clockwise = [[0.0, 0.0], [0.0, 1e-3], [2e-3, 0.0]];
    assert_eq!(
        message(stiffness(PlaneKind::Tri3, &clockwise, &p)),
        "the Tri3 element is inverted: its nodes run clockwise (Jacobian determinant -2.000000e-6 m^2 \
         at (0.000000e0, 0.000000e0) m); reverse the surface in gmsh"
    );
    let arrowhead = [[0.0, 0.0], [1.0, 0.0], [0.25, 0.25], [0.0, 1.0]];
    assert_eq!(
        message(stiffness(PlaneKind::Quad4, &arrowhead, &p)),
        "the Quad4 element is degenerate or folded: Jacobian determinant -1.250000e-1 m^2 at \
         (2.500000e-1, 2.500000e-1) m, natural coordinates (1.000, 1.000); it must be positive everywhere"
    );
    Ok(())
}

/// Reference: the stiffness of an arc's Tri6 (5 degrees, as on a bore) by the rule of degree 6.
#[test]
fn curved_tri6_is_converged() -> Outcome {
    let at = |radius: f64, degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [radius * cos, radius * sin]
    };
    let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let (a, b, c) = (at(6e-3, 5.0), at(6e-3, 0.0), at(6.5e-3, 2.5));
    let coords = [a, b, c, at(6e-3, 2.5), middle(b, c), middle(c, a)];
    let p = properties(PlaneAssumption::Stress)?;
    let mut fine = DMatrix::zeros(12, 12);
    super::stiffness::integrate(
        PlaneKind::Tri6,
        &coords,
        &p,
        QuadratureRule::TRIANGLE_12,
        &mut fine,
    );
    let found = stiffness(PlaneKind::Tri6, &coords, &p)?;
    let error = (&found - &fine).norm() / fine.norm();
    assert!(error < 1e-6, "{error}");
    let mut coarse = DMatrix::zeros(12, 12);
    super::stiffness::integrate(
        PlaneKind::Tri6,
        &coords,
        &p,
        QuadratureRule::TRIANGLE_3,
        &mut coarse,
    );
    let error = (&coarse - &fine).norm() / fine.norm();
    assert!(error > 1e-5, "three points would do: {error}");
    Ok(())
}

#[test]
fn thickness_must_be_positive() -> Outcome {
    let material = Material::new(70e9, 0.33, 2700.0)?;
    for (value, text) in [
        (0.0, "0"),
        (-1.0, "-1"),
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
    ] {
        let found = message(PlaneProperties::new(
            material,
            PlaneAssumption::Strain,
            value,
        ));
        assert_eq!(
            found,
            format!("thickness must be positive and finite, found {text} m")
        );
    }
    Ok(())
}

proptest! {
    /// Whatever the coordinates: matrices or an error, and no stiffness against rigid motion.
    #[test]
    fn any_coordinates_give_matrices_or_an_error(
        which in 0_usize..4,
        moved in prop::collection::vec(-0.5_f64..0.5, 16),
    ) {
        let kind = PlaneKind::ALL[which];
        let mut coords = straight(kind);
        for (node, d) in coords.iter_mut().zip(moved.chunks(2)) {
            *node = [node[0] + d[0], node[1] + d[1]];
        }
        let aluminium = Material::new(70e9, 0.33, 2700.0).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let p = PlaneProperties::new(aluminium, PlaneAssumption::Stress, 4e-3)
            .map_err(|e| TestCaseError::fail(e.to_string()))?;
        if let Ok(k) = stiffness(kind, &coords, &p) {
            let rotation = field(&coords, |x, y| [-y, x]);
            prop_assert!((&k * &rotation).norm() <= 1e-12 * k.norm() * rotation.norm());
        }
    }
}
