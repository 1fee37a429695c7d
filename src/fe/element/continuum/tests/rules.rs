//! The choice of rules: straight and full ones agree where they should, and curved elements are converged.

use nalgebra::DMatrix;

use super::Outcome;
use super::fixtures::{aluminium, distorted, properties, very_fine};
use crate::fe::element::ElementError;
use crate::fe::element::continuum::geometry::Placed;
use crate::fe::element::continuum::table::Table;
use crate::fe::element::continuum::table::for_kind;
use crate::fe::element::continuum::{
    ContinuumProperties, Formulation, QuadraturePoint, QuadratureRule, mass, shape_values, stiffness,
};
use crate::fe::mesh::ElementKind;

/// The stiffness by any points.
fn by_points(
    kind: ElementKind,
    coords: &[[f64; 3]],
    p: &ContinuumProperties,
    points: &[QuadraturePoint],
) -> Result<DMatrix<f64>, ElementError> {
    fn integrate<const N: usize, const D: usize>(
        kind: ElementKind,
        coords: &[[f64; 3]],
        p: &ContinuumProperties,
        points: &[QuadraturePoint],
        out: &mut [f64],
    ) -> Result<(), ElementError> {
        let placed = Placed::<N>::new(kind, coords)?;
        let table = Table::new(kind, points);
        crate::fe::element::continuum::stiffness::integrate::<N, D>(kind, coords, &placed, p, &table, out)
    }
    let mut out = DMatrix::zeros(kind.dof(), kind.dof());
    for_kind!(kind, integrate(kind, coords, p, points, out.as_mut_slice()))?;
    Ok(out)
}

/// Straight triangles and tetrahedra: the cheap rule, the full one, and a very fine one.
#[test]
fn straight_simplices_do_not_depend_on_the_rule() -> Outcome {
    use ElementKind::{Tet4, Tet10, Tri3, Tri6};
    for kind in [Tri3, Tri6, Tet4, Tet10] {
        let coords = distorted(kind);
        for p in properties(kind, &aluminium()?)? {
            let k = stiffness(kind, &coords, &p, Formulation::default())?;
            for points in [kind.rules()[0][0].points(), &very_fine(kind)] {
                let error = (by_points(kind, &coords, &p, points)? - &k).amax() / k.amax();
                assert!(error < 1e-14, "{kind:?}: {error:e}");
            }
        }
    }
    Ok(())
}

/// A middle node moved by less than counts as straight changes nothing to speak of, and by more takes the full
/// rule.
#[test]
fn straightness_has_no_step() -> Outcome {
    let kind = ElementKind::Tet10;
    let p = properties(kind, &aluminium()?)?[0];
    let straight = distorted(kind);
    let k = stiffness(kind, &straight, &p, Formulation::default())?;
    let m = mass(kind, &straight, &p, Formulation::default())?;
    for (moved, is_straight) in [(5e-14, true), (1e-11, false)] {
        let mut coords = straight.clone();
        coords[5][2] += moved;
        assert_eq!(Placed::<10>::new(kind, &coords)?.straight, is_straight);
        let error = (stiffness(kind, &coords, &p, Formulation::default())? - &k).amax() / k.amax();
        assert!(error < 20.0 * moved + 1e-14, "{moved}: {error:e}");
        let error = (mass(kind, &coords, &p, Formulation::default())? - &m).amax() / m.amax();
        assert!(error < 20.0 * moved + 1e-14, "{moved}: {error:e}");
    }
    // a millimetre a hundred metres from the origin: coordinates are rounded to 1e-14 m
    let far: Vec<_> = straight.iter().map(|x| x.map(|v| 1e-3 * v + 100.0)).collect();
    assert!(Placed::<10>::new(kind, &far)?.straight);
    Ok(())
}

/// A quadratic element on a bore of radius 1, `degrees` round it, as long along the bore as round it, and
/// `height` times that in the radial direction. Edges on the bore are curved, all others straight.
fn on_a_bore(kind: ElementKind, degrees: f64, height: f64) -> Vec<[f64; 3]> {
    let arc = degrees.to_radians();
    let simplex = kind.is_simplex();
    let wedge = kind.corners() == 6;
    let pyramid = kind.corners() == 5;
    let unit = |value: f64, is_unit: bool| if is_unit { value } else { 0.5 * (value + 1.0) };
    let place = |&[xi, eta, zeta]: &[f64; 3]| {
        let radius = 1.0 + height * arc * unit(xi, simplex || wedge);
        let angle = arc * unit(eta, simplex || wedge);
        let along = if kind.dimension() == 3 { arc * unit(zeta, simplex || pyramid) } else { 0.0 };
        [radius * angle.cos(), radius * angle.sin(), along]
    };
    let corners = &kind.natural_nodes()[..kind.corners()];
    let mut coords: Vec<[f64; 3]> = corners.iter().map(place).collect();
    for &[a, b] in kind.middle_edges() {
        let (p, q) = (coords[a], coords[b]);
        let mut middle = [0, 1, 2].map(|d| 0.5 * (p[d] + q[d]));
        if [p, q].iter().all(|x| (x[0].hypot(x[1]) - 1.0).abs() < 1e-9) {
            let radius = middle[0].hypot(middle[1]);
            middle = [middle[0] / radius, middle[1] / radius, middle[2]];
        }
        coords.push(middle);
    }
    // centres where the element without them has that point, as gmsh places them
    let without = match kind {
        ElementKind::Quad9 => ElementKind::Quad8,
        ElementKind::Hex27 => ElementKind::Hex20,
        ElementKind::Wedge18 => ElementKind::Wedge15,
        ElementKind::Pyramid14 => ElementKind::Pyramid13,
        complete => complete,
    };
    for &natural in &kind.natural_nodes()[without.nodes()..] {
        let values = shape_values(without, natural);
        coords.push([0, 1, 2].map(|d| coords[..without.nodes()].iter().zip(values).map(|(x, n)| n * x[d]).sum()));
    }
    coords
}

/// Error of a rule on a bore's element, relative to 12 points a direction (norms of the stiffness).
fn rule_error(
    kind: ElementKind,
    (degrees, height): (f64, f64),
    rule: QuadratureRule,
) -> Result<f64, Box<dyn std::error::Error>> {
    let p = properties(kind, &aluminium()?)?[0];
    let coords = on_a_bore(kind, degrees, height);
    let fine = by_points(kind, &coords, &p, &very_fine(kind))?;
    let k = by_points(kind, &coords, &p, rule.points())?;
    Ok((k - &fine).norm() / fine.norm())
}

/// The numbers in the documentation of `ElementKind::rules`.
#[test]
fn curved_tet10_is_converged() -> Outcome {
    let candidates = [
        (QuadratureRule::Tetrahedron4, [1.4e-3, 2.8e-3, 5.9e-3]),
        (QuadratureRule::Tetrahedron14, [5.3e-9, 1.2e-7, 3.6e-6]),
        (QuadratureRule::Tetrahedron24, [4.9e-11, 2.3e-9, 1.7e-7]),
    ];
    for (rule, errors) in candidates {
        for (degrees, expected) in [5.0, 10.0, 20.0].into_iter().zip(errors) {
            let shape = (degrees, 1.0);
            let found = rule_error(ElementKind::Tet10, shape, rule)?;
            let near = (found / expected - 1.0).abs() < 0.1;
            assert!(near, "{rule:?} {shape:?}: {found:.1e} documented {expected:.1e}");
        }
    }
    Ok(())
}

/// Tri6 and the rules of the others likewise; a coarser rule would be seen.
#[test]
fn other_curved_elements_are_as_documented() -> Outcome {
    use ElementKind::{Hex20, Hex27, Pyramid13, Pyramid14, Quad8, Quad9, Tet10, Tri6, Wedge15, Wedge18};
    let documented = [
        (Tet10, 2.3e-9),
        (Tri6, 3.1e-6),
        (Quad8, 2.9e-4),
        (Quad9, 9.1e-4),
        (Hex20, 2.6e-4),
        (Hex27, 9.5e-4),
        (Wedge15, 9.4e-5),
        (Wedge18, 4.1e-4),
        (Pyramid13, 1.3e-4),
        (Pyramid14, 4.7e-4),
    ];
    for (kind, expected) in documented {
        let found = rule_error(kind, (10.0, 1.0), kind.rules()[0][0])?;
        let near = (found / expected - 1.0).abs() < 0.1;
        assert!(near, "{kind:?}: {found:.1e} documented {expected:.1e}");
    }
    let coarse = rule_error(Tri6, (10.0, 1.0), QuadratureRule::Triangle3)?;
    assert!(coarse > 1e-3, "three points would do: {coarse:e}");
    Ok(())
}
