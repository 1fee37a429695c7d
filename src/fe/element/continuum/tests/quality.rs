//! The quality of good and bad elements.

use super::Outcome;
use super::fixtures::{curved, distorted, message, straight};
use crate::fe::element::continuum::{measure, quality};
use crate::fe::mesh::ElementKind;

#[test]
fn straight_elements_have_ratio_one() -> Outcome {
    for kind in super::fixtures::continua() {
        let found = quality(kind, &straight(kind))?;
        assert!((found.scaled_jacobian - 1.0).abs() < 1e-13, "{kind:?}: {found:?}");
        let natural: f64 = kind.mass_rule().points().iter().map(|p| p.weight).sum();
        let expected = measure(kind, &straight(kind))? / natural;
        assert!((found.smallest_determinant / expected - 1.0).abs() < 1e-13);
        for coords in [distorted(kind), curved(kind)] {
            let found = quality(kind, &coords)?;
            assert!(found.smallest_determinant > 0.0 && found.scaled_jacobian < 1.0 + 1e-15);
        }
    }
    Ok(())
}

/// Inverted ones are negative and no error; a point has zero.
#[test]
fn bad_elements_have_a_quality_too() -> Outcome {
    for kind in super::fixtures::continua() {
        let mirrored: Vec<_> = straight(kind).iter().map(|&[x, y, z]| [-x, y, z]).collect();
        let found = quality(kind, &mirrored)?;
        assert!(found.smallest_determinant < 0.0 && (found.scaled_jacobian + 1.0).abs() < 1e-13);
        let found = quality(kind, &vec![[1.0; 3]; kind.nodes()])?;
        assert!(found.smallest_determinant.abs() < 1e-300 && found.scaled_jacobian.abs() < 1e-300);
    }
    Ok(())
}

/// By hand: an arrowhead has det J = -1/8 at its inner corner and 1/4 (side times side over four) at the
/// opposite one.
#[test]
fn arrowhead_by_hand() -> Outcome {
    let arrowhead = [[0.0; 3], [1.0, 0.0, 0.0], [0.25, 0.25, 0.0], [0.0, 1.0, 0.0]];
    let found = quality(ElementKind::Quad4, &arrowhead)?;
    assert!((found.smallest_determinant + 0.125).abs() < 1e-15);
    assert!((found.scaled_jacobian + 0.5).abs() < 1e-15);
    assert!((found.position[0] - 0.25).abs() < 1e-15 && (found.position[1] - 0.25).abs() < 1e-15);
    Ok(())
}

#[test]
fn only_input_that_is_none_is_an_error() {
    let found = quality(ElementKind::Tet4, &[[0.0; 3]]);
    assert_eq!(message(found), "a Tet4 element has 4 nodes, found 1");
    let mut coords = straight(ElementKind::Tet4);
    coords[2] = [0.0, f64::INFINITY, 1.0];
    assert_eq!(
        message(quality(ElementKind::Tet4, &coords)),
        "node 2 of the Tet4 element has the coordinates (0, inf, 1) m: expected finite numbers"
    );
}
