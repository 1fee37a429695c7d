//! Properties: plane assumptions, thickness, and the axes of orthotropic plane parts.

use super::Outcome;
use super::fixtures::{THICKNESS, aluminium, distorted, laminate_along, message};
use crate::fe::element::continuum::{ContinuumProperties, Formulation, PlaneAssumption, stiffness};
use crate::fe::material::{ElasticMaterial, Material, OrthotropicMaterial};

#[test]
fn thickness_must_be_positive() -> Outcome {
    for (value, text) in [(0.0, "0"), (-1.0, "-1"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let found = ContinuumProperties::plane(&aluminium()?, PlaneAssumption::Strain, value);
        assert_eq!(message(found), format!("thickness must be positive and finite, found {text} m"));
    }
    Ok(())
}

#[test]
fn the_plane_must_be_normal_to_the_material_axis_z() -> Outcome {
    let tilted = laminate_along([1.0, 0.0, 0.0], [0.0, 0.8, 0.6])?;
    let found = ContinuumProperties::plane(&tilted, PlaneAssumption::Stress, THICKNESS);
    assert_eq!(
        message(found),
        "the material axis z must be normal to the plane of the mesh, (0, 0, 1) or (0, 0, -1), found \
         (0.000000, -0.600000, 0.800000)"
    );
    let reversed = laminate_along([0.6, 0.8, 0.0], [0.8, -0.6, 0.0])?;
    assert!(ContinuumProperties::plane(&reversed, PlaneAssumption::Stress, THICKNESS).is_ok());
    Ok(())
}

/// Two ways to one matrix: Lame's constants, and the 6 x 6 stiffness of the same material as an orthotropic
/// one.
#[test]
fn isotropic_and_orthotropic_ways_agree() -> Outcome {
    let (e, nu) = (208e9, 0.3);
    let g = e / 2.6;
    let one = ElasticMaterial::from(Material::new(e, nu, 7800.0)?);
    let (x, y) = ([0.6, 0.8, 0.0], [-0.8, 0.6, 0.0]);
    let other = OrthotropicMaterial::new([e; 3], [nu; 3], [g; 3], 7800.0, x, y)?.into();
    for kind in super::fixtures::continua() {
        let coords = distorted(kind);
        let ways = [&one, &other].map(|m| super::fixtures::properties(kind, m));
        let [one, other] = ways;
        for (p, q) in one?.iter().zip(other?) {
            let k = stiffness(kind, &coords, p, Formulation::default())?;
            let error = (stiffness(kind, &coords, &q, Formulation::default())? - &k).amax();
            assert!(error < 1e-14 * k.amax(), "{kind:?}: {error:e}");
            assert!((p.density - q.density).abs() < 1e-12);
        }
    }
    Ok(())
}
