//! Checks of a single element; what a whole ring must reach is in `tests/verification/ring.rs`.

use super::force_method::over_arc;
use super::*;
use crate::fe::material::{BeamSection, Bond, Material, RadiusRule, RingLayer};
use nalgebra::{Vector3, Vector6};

/// Rectangular ring section of unit radius.
fn section(thickness: f64) -> BeamSection {
    let layer = RingLayer {
        material: Material::new(2e11, 0.3, 7800.0).expect("valid"),
        area: 0.1 * thickness,
        inertia: 0.1 * thickness.powi(3) / 12.0,
        axial_inertia: None,
        torsion: None,
        radius: 1.0,
        shear_coefficient: 5.0 / 6.0,
    };
    BeamSection::combine(&[layer], Bond::Slip(RadiusRule::Own)).expect("valid")
}

/// (u, w, theta) of the three rigid motions at phi, radius 1.
fn rigid(motion: usize, phi: f64) -> Vector3<f64> {
    let (sin, cos) = phi.sin_cos();
    [Vector3::new(-sin, cos, 0.0), Vector3::new(cos, sin, 0.0), Vector3::new(1.0, 0.0, 1.0)][motion]
}

fn at_nodes(half: f64, field: impl Fn(f64) -> Vector3<f64>) -> Vector6<f64> {
    let (first, second) = (field(-half), field(half));
    Vector6::new(first.x, first.y, first.z, second.x, second.y, second.z)
}

#[test]
fn the_exact_arc_has_no_energy_in_rigid_motions_however_slender() {
    for thickness in [0.2, 0.01, 1e-4] {
        for elements in [3, 36, 72, 720] {
            let half = std::f64::consts::PI / f64::from(elements);
            let element = CurvedBeam::new(&section(thickness), half, RingInterpolation::ExactArc);
            for motion in 0..3 {
                let d = at_nodes(half, |phi| rigid(motion, phi));
                let force = element.stiffness() * d;
                // the bound that the design page states: round-off on the stiffness's own scale
                assert!(force.norm() <= 1e-12 * element.stiffness().norm() * d.norm());
            }
        }
    }
}

#[test]
fn the_exact_arc_interpolates_rigid_motions_and_its_nodes() {
    let half = 0.3;
    let element = CurvedBeam::new(&section(0.05), half, RingInterpolation::ExactArc);
    for motion in 0..3 {
        let d = at_nodes(half, |phi| rigid(motion, phi));
        for phi in [-0.3, -0.11, 0.0, 0.27] {
            // round-off of the 6 x 6 coefficients
            assert!((element.interpolation(phi) * d - rigid(motion, phi)).norm() < 1e-12);
        }
    }
}

#[test]
fn both_interpolations_take_their_nodal_values() {
    for kind in [RingInterpolation::ExactArc, RingInterpolation::Raveendranath] {
        let half = 0.05;
        let element = CurvedBeam::new(&section(0.05), half, kind);
        for (phi, first) in [(-half, 0), (half, 3)] {
            let n = element.interpolation(phi);
            for row in 0..3 {
                for column in 0..6 {
                    let expected = f64::from(column == first + row);
                    assert!((n[(row, column)] - expected).abs() < 1e-9, "{kind:?}");
                }
            }
        }
    }
}

#[test]
fn shear_and_extension_follow_from_the_interpolation() {
    // stiffness = integral B^T D B of the interpolation's own strains, by differences
    let section = section(0.3);
    let half = 0.2;
    for kind in [RingInterpolation::ExactArc, RingInterpolation::Raveendranath] {
        let element = CurvedBeam::new(&section, half, kind);
        let step = 1e-5;
        let moduli = nalgebra::Matrix3::from_diagonal(&Vector3::new(
            section.axial,
            1.0 / section.shear_compliance,
            section.bending,
        ));
        let integrated = over_arc(half, |phi| {
            let n = element.interpolation(phi);
            let slope = (element.interpolation(phi + step) - element.interpolation(phi - step)) / (2.0 * step);
            let mut strains = nalgebra::Matrix3x6::zeros();
            strains.set_row(0, &(slope.row(0) + n.row(1)));
            strains.set_row(1, &(slope.row(1) - n.row(0) + n.row(2)));
            strains.set_row(2, &slope.row(2));
            strains.transpose() * moduli * strains
        });
        // differences of step 1e-5 are good to about 1e-9 of the largest entry
        let error = (integrated - element.stiffness()).norm() / element.stiffness().norm();
        assert!(error < 1e-7, "{kind:?}: {error}");
    }
}

#[test]
fn the_mass_is_that_of_the_arc() {
    let section = section(0.05);
    let half = 0.1;
    let element = CurvedBeam::new(&section, half, RingInterpolation::ExactArc);
    let d = at_nodes(half, |phi| rigid(0, phi));
    let mass = (d.transpose() * element.mass * d)[0];
    assert!((mass / (section.mass * 2.0 * half) - 1.0).abs() < 1e-12);
}
