//! Checks of a single element; closed forms and whole rings are in
//! `tests/verification/ring_in_space.rs`.

use super::*;
use crate::fe::element::curved_beam::force_method::over_arc;
use crate::fe::material::{Bond, Material, RadiusRule, RingLayer};
use nalgebra::Vector6;

/// Rectangular ring section of radius 2 m, thickness radially, 0.1 m along the axis.
fn section(thickness: f64) -> BeamSection {
    let layer = RingLayer {
        material: Material::new(2e11, 0.3, 7800.0).expect("valid"),
        area: 0.1 * thickness,
        inertia: 0.1 * thickness.powi(3) / 12.0,
        axial_inertia: None,
        torsion: None,
        radius: 2.0,
        shear_coefficient: 5.0 / 6.0,
    };
    BeamSection::combine(&[layer], Bond::Slip(RadiusRule::Own)).expect("valid")
}

/// (v, alpha, beta) at phi of rigid motions about the ring's centre: along z, about x, about y.
fn rigid(motion: usize, phi: f64) -> Vector3<f64> {
    let (sin, cos) = phi.sin_cos();
    [Vector3::new(1.0, 0.0, 0.0), Vector3::new(2.0 * sin, cos, -sin), Vector3::new(-2.0 * cos, sin, cos)][motion]
}

fn at_nodes(half: f64, field: impl Fn(f64) -> Vector3<f64>) -> Vector6<f64> {
    let (first, second) = (field(-half), field(half));
    Vector6::new(first.x, first.y, first.z, second.x, second.y, second.z)
}

#[test]
fn rigid_motions_have_no_energy_however_slender() {
    for thickness in [1.0, 0.01, 1e-4] {
        for elements in [3, 36, 72, 720] {
            let half = std::f64::consts::PI / f64::from(elements);
            for section in [section(thickness), section(thickness).without_shear()] {
                let element = OutOfPlaneArc::new(&section, half);
                for motion in 0..3 {
                    let d = at_nodes(half, |phi| rigid(motion, phi));
                    let force = element.stiffness() * d;
                    // the bound of the element in the plane: round-off on the stiffness's own scale
                    let bound = 1e-12 * element.stiffness().norm() * d.norm();
                    assert!(force.norm() <= bound, "{thickness} {elements} {motion}");
                }
            }
        }
    }
}

#[test]
fn rigid_motions_and_nodal_values_are_interpolated() {
    for half in [1.0, 0.3, 0.004] {
        let element = OutOfPlaneArc::new(&section(0.05), half);
        for motion in 0..3 {
            let d = at_nodes(half, |phi| rigid(motion, phi));
            for phi in [-half, -0.4 * half, 0.0, 0.9 * half] {
                let error = (element.interpolation(phi) * d - rigid(motion, phi)).norm();
                // round-off of the 6 x 6 coefficients
                assert!(error < 1e-12, "{half} {motion} {phi}: {error:e}");
            }
        }
        for (phi, first) in [(-half, 0), (half, 3)] {
            let mut expected = Matrix3x6::zeros();
            for row in 0..3 {
                expected[(row, first + row)] = 1.0;
            }
            // curvatures of a short element are differences of its nodal values over its length
            let error = (element.interpolation(phi) - expected).norm();
            assert!(error < 1e-11 / half, "{half}: {error:e}");
        }
    }
}

#[test]
fn the_fields_of_the_states_have_their_strains() {
    // stiffness = integral B^T D B of the interpolation's own strains, by differences; this ties the
    // displacement fields, the force states and the work matrix to the strains as defined
    let section = section(0.3);
    let (half, step) = (0.4, 1e-5);
    let element = OutOfPlaneArc::new(&section, half);
    let out = &section.out_of_plane;
    let moduli = Matrix3::from_diagonal(&Vector3::new(1.0 / out.shear_compliance, out.bending, out.torsion));
    let radius = section.radius;
    let integrated = over_arc(half, |phi| {
        let n = element.interpolation(phi);
        let slope = (element.interpolation(phi + step) - element.interpolation(phi - step)) / (2.0 * step);
        let mut strains = Matrix3x6::zeros();
        strains.set_row(0, &(slope.row(0) / radius - n.row(1)));
        strains.set_row(1, &((slope.row(1) - n.row(2)) / radius));
        strains.set_row(2, &((slope.row(2) + n.row(1)) / radius));
        strains.transpose() * moduli * strains * radius
    });
    // differences of step 1e-5 are good to about 1e-9 of the largest entry
    let error = (integrated - element.stiffness()).norm() / element.stiffness().norm();
    assert!(error < 1e-7, "{error:e}");
}

#[test]
fn the_mass_is_that_of_the_arc() {
    let section = section(0.05);
    let half = 0.1;
    let element = OutOfPlaneArc::new(&section, half);
    let of = |motion: usize| {
        let d = at_nodes(half, |phi| rigid(motion, phi));
        (d.transpose() * element.mass * d)[0]
    };
    let (radius, out) = (section.radius, &section.out_of_plane);
    let mean = |sign: f64| radius * (half + sign * 0.5 * (2.0 * half).sin());
    // integrals of sin^2 and cos^2 over the arc, times R
    let (sines, cosines) = (mean(-1.0), mean(1.0));
    let square = radius * radius * section.mass;
    let turn_x = (square + out.polar_rotary) * sines + out.radial_rotary * cosines;
    let turn_y = (square + out.polar_rotary) * cosines + out.radial_rotary * sines;
    let total = section.mass * 2.0 * half * radius;
    for (found, exact) in [(of(0), total), (of(1), turn_x), (of(2), turn_y)] {
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
    }
}
