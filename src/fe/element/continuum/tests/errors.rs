//! Every rule fires, with its exact message, for stiffness, mass and measure alike.

use proptest::prelude::*;

use super::fixtures::{all_properties, aluminium, distorted, message, properties, rigid_motions, straight};
use super::{FOUR_POINT, Outcome, PLAIN};
use crate::fe::element::continuum::incompatible::soft_modes;
use crate::fe::element::continuum::{
    ContinuumProperties, Formulation, mass, mass_into, measure, stiffness, stiffness_into,
};
use crate::fe::mesh::ElementKind;

pub(super) fn check(kind: ElementKind, formulation: Formulation) -> Outcome {
    let p = all_properties(kind)?[0];
    let name = kind.name();
    let good = distorted(kind);
    let (cause, numbers) = match kind.dimension() {
        2 => ("its nodes run clockwise", "(1.3, NaN, 0)"),
        _ => ("its nodes are numbered inside out", "(1.3, NaN, 0.25)"),
    };
    let mirrored: Vec<_> = good.iter().map(|&[x, y, z]| [-x, y, z]).collect();
    let flat: Vec<_> = good.iter().map(|&[x, _, z]| [x, 2.0 * x, z]).collect();
    let point = vec![[0.5, 0.25, 0.125]; kind.nodes()];
    let huge: Vec<_> = straight(kind).iter().map(|x| x.map(|v| 1e61 * v)).collect();
    let mut missing = good.clone();
    missing[1] = [1.3, f64::NAN, if kind.dimension() == 2 { 0.0 } else { 0.25 }];
    let (nodes, dof) = (kind.nodes(), kind.dof());
    let degenerate = format!("the {name} element is degenerate or folded: Jacobian determinant ");
    let cases: [(&[[f64; 3]], String); 6] = [
        (&mirrored, format!("the {name} element is inverted: {cause} (")),
        (&flat, degenerate.clone()),
        (&point, degenerate),
        (&missing, format!("node 1 of the {name} element has the coordinates {numbers} m: expected")),
        (&huge, format!("the {name} element measures ")),
        (&good[1..], format!("a {name} element has {nodes} nodes, found {}", nodes - 1)),
    ];
    for (coords, expected) in cases {
        let found = [
            message(stiffness(kind, coords, &p, formulation)),
            message(mass(kind, coords, &p, formulation)),
            message(measure(kind, coords)),
        ];
        for text in found {
            assert!(text.starts_with(&expected), "{text}\nexpected {expected}");
        }
    }
    let mut buffer = [0.0; 6];
    assert_eq!(
        message(stiffness_into(kind, &good, &p, formulation, &mut buffer)),
        format!("the matrix of a {name} element has {dof} x {dof} entries, the buffer holds 6")
    );
    assert_eq!(
        message(mass_into(kind, &good, &p, formulation, [true; 3], &mut buffer)),
        format!("the matrix of a {name} element has {dof} x {dof} entries, the buffer holds 6")
    );
    wrong_properties(kind, formulation)
}

fn wrong_properties(kind: ElementKind, formulation: Formulation) -> Outcome {
    let (other, text) = match kind.dimension() {
        2 => (ElementKind::Tet4, "plane properties, found solid ones"),
        _ => (ElementKind::Tri3, "solid properties, found plane ones"),
    };
    let expected = format!("the {} element needs {text}", kind.name());
    let p = all_properties(other)?[0];
    let coords = straight(kind);
    assert_eq!(message(stiffness(kind, &coords, &p, formulation)), expected);
    assert_eq!(message(mass(kind, &coords, &p, formulation)), expected);
    Ok(())
}

fn solid() -> Result<ContinuumProperties, Box<dyn std::error::Error>> {
    Ok(ContinuumProperties::solid(&aluminium()?))
}

#[test]
fn inverted_and_folded_plane_elements_say_where() -> Outcome {
    let p = properties(ElementKind::Tri3, &aluminium()?)?[0];
    let clockwise = [[0.0, 0.0, 0.0], [0.0, 1e-3, 0.0], [2e-3, 0.0, 0.0]];
    assert_eq!(
        message(stiffness(ElementKind::Tri3, &clockwise, &p, PLAIN)),
        "the Tri3 element is inverted: its nodes run clockwise (Jacobian determinant -2e-6 m^2 \
         at (0, 0) m); turn it in gmsh (a surface of the mesh whose elements all run so is turned)"
    );
    let arrowhead = [[0.0; 3], [1.0, 0.0, 0.0], [0.25, 0.25, 0.0], [0.0, 1.0, 0.0]];
    for formulation in [PLAIN, Formulation::default()] {
        assert_eq!(
            message(stiffness(ElementKind::Quad4, &arrowhead, &p, formulation)),
            "the Quad4 element is degenerate or folded: Jacobian determinant -0.125 m^2 at \
             (0.25, 0.25) m, natural coordinates (1.000, 1.000); it must be positive everywhere"
        );
    }
    Ok(())
}

#[test]
fn inverted_and_folded_solids_say_where() -> Outcome {
    let p = solid()?;
    let mut coords = ElementKind::Tet4.natural_nodes().to_vec();
    coords.swap(0, 1);
    assert_eq!(
        message(stiffness(ElementKind::Tet4, &coords, &p, PLAIN)),
        "the Tet4 element is inverted: its nodes are numbered inside out (Jacobian determinant \
         -1 m^3 at (1, 0, 0) m); the mesh was mirrored or the node order is \
         not gmsh's"
    );
    let mut coords = ElementKind::Hex8.natural_nodes().to_vec();
    coords[6] = [-0.5, -0.5, -0.5];
    for formulation in [PLAIN, Formulation::default()] {
        assert_eq!(
            message(stiffness(ElementKind::Hex8, &coords, &p, formulation)),
            "the Hex8 element is degenerate or folded: Jacobian determinant -1.25 m^3 at \
             (-0.5, -0.5, -0.5) m, natural coordinates (1.000, 1.000, 1.000); it must be \
             positive everywhere"
        );
    }
    let huge = [[0.0; 3], [1e61, 0.0, 0.0], [0.0, 1e61, 0.0], [0.0, 0.0, 1e61]];
    assert_eq!(message(measure(ElementKind::Tet4, &huge)), "the Tet4 element measures 1e61 m: expected at most 1e60 m");
    Ok(())
}

/// A middle node nearer to one end than a quarter of the edge folds the element at that end, and a corner just
/// inside the diagonal of its neighbours folds it there, though all points of the rules see a good element.
#[test]
fn a_fold_at_a_node_is_found() -> Outcome {
    let fires = |kind: ElementKind, coords: &[[f64; 3]]| -> Outcome {
        let p = properties(kind, &aluminium()?)?[0];
        for text in [
            message(stiffness(kind, coords, &p, Formulation::default())),
            message(stiffness(kind, coords, &p, PLAIN)),
            message(mass(kind, coords, &p, Formulation::default())),
            message(mass(kind, coords, &p, PLAIN)),
            message(measure(kind, coords)),
        ] {
            assert!(text.contains("degenerate or folded"), "{kind:?}: {text}");
        }
        Ok(())
    };
    for kind in super::fixtures::continua() {
        if let Some(&[a, b]) = kind.middle_edges().first() {
            let mut coords = straight(kind);
            let (from, to) = (coords[a], coords[b]);
            coords[kind.corners()] = [0, 1, 2].map(|d| from[d] + 0.24 * (to[d] - from[d]));
            fires(kind, &coords)?;
        }
    }
    let inside = 0.49;
    let quadrilateral = [[0.0; 3], [1.0, 0.0, 0.0], [inside, inside, 0.0], [0.0, 1.0, 0.0]];
    fires(ElementKind::Quad4, &quadrilateral)?;
    let upper = quadrilateral.map(|[x, y, _]| [x, y, 1.0]);
    fires(ElementKind::Hex8, &[quadrilateral, upper].concat())
}

#[test]
fn condensation_failure_names_the_element() {
    let error = soft_modes(ElementKind::Hex8, -1.5);
    assert_eq!(
        error.to_string(),
        "the incompatible modes of the Hex8 element have no stiffness (pivot -1.5 N/m): use the plain \
         formulation"
    );
}

/// Ordinary coordinates, and those at the ends of the number range.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        20 => -0.5_f64..0.5,
        1 => prop::num::f64::ANY,
    ]
}

proptest! {
    /// Whatever the coordinates: finite matrices or an error, and no stiffness against rigid motion.
    #[test]
    fn any_coordinates_give_matrices_or_an_error(
        which in 0_usize..16,
        four in any::<bool>(),
        wild in prop::collection::vec(coordinate(), 81),
        tame in prop::collection::vec(-0.15_f64..0.15, 81),
        is_wild in any::<bool>(),
        scale in prop_oneof![Just(1.0), Just(1e-3), Just(1e-40), Just(1e-90), Just(1e40)],
    ) {
        let fail = |e: Box<dyn std::error::Error>| TestCaseError::fail(e.to_string());
        let kind = super::fixtures::continua().nth(which).unwrap_or(ElementKind::Tri3);
        let formulation = if four { FOUR_POINT } else { PLAIN };
        let moved = if is_wild { &wild } else { &tame };
        let mut coords = straight(kind);
        for (node, d) in coords.iter_mut().zip(moved.chunks(3)) {
            for i in 0..kind.dimension() {
                node[i] = scale * (node[i] + d[i]);
            }
        }
        for p in all_properties(kind).map_err(fail)? {
            if let Ok(m) = mass(kind, &coords, &p, formulation) {
                prop_assert!(m.iter().all(|value| value.is_finite()));
            }
            if let Ok(k) = stiffness(kind, &coords, &p, formulation) {
                prop_assert!(k.iter().all(|value| value.is_finite()));
                // an element near folding has a large inverse Jacobian, whose rounding this bound leaves room
                // for
                for motion in rigid_motions(kind, &coords) {
                    let force = (&k * &motion).amax();
                    prop_assert!(force <= 1e-10 * k.amax() * motion.amax());
                }
            }
        }
    }
}
