//! Published sections, parts put together, and every rule with its message.

use super::*;
use crate::fe::material::{Material, MaterialError};

fn steel_in_aluminium() -> [RingLayer; 2] {
    let layer = |young, density, area, inertia, radius| RingLayer {
        material: Material::new(young, 0.3, density).expect("valid"),
        area,
        inertia,
        axial_inertia: None,
        torsion: None,
        radius,
        shear_coefficient: 5.0 / 6.0,
    };
    [layer(210e9, 7850.0, 5.37e-6, 8.88e-13, 5.314e-3), layer(72e9, 2700.0, 12e-6, 9e-12, 7.5e-3)]
}

/// Inextensional frequency of a thin ring, n = 2, Hz.
fn thin_frequency(section: &BeamSection) -> f64 {
    let stiffness = section.bending / (section.mass * section.radius.powi(4));
    6.0 / 5.0_f64.sqrt() * stiffness.sqrt() / std::f64::consts::TAU
}

#[test]
fn the_published_two_rings() {
    // 32.9 and 36.4 kHz: computed for the design page, given there to three digits
    let combine = |bond| BeamSection::combine(&steel_in_aluminium(), bond).expect("valid");
    let own = combine(Bond::Slip(RadiusRule::Own));
    let common = combine(Bond::Slip(RadiusRule::CommonCentroid));
    assert!((thin_frequency(&own) - 32.94e3).abs() < 50.0);
    assert!((thin_frequency(&common) - 36.4e3).abs() < 50.0);
    assert!((common.radius - 6.262e-3).abs() < 1e-6);
}

#[test]
fn halves_of_one_ring_bonded_are_the_whole() {
    // a rectangle of height h, cut in two, put together again: I = b h^3 / 12
    let (width, height, radius) = (4e-3, 3e-3, 7.5e-3);
    let material = Material::new(70e9, 0.33, 2700.0).expect("valid");
    let half = |offset: f64| RingLayer {
        material,
        area: width * height / 2.0,
        inertia: width * (height / 2.0_f64).powi(3) / 12.0,
        axial_inertia: None,
        torsion: None,
        radius: radius + offset,
        shear_coefficient: 5.0 / 6.0,
    };
    let layers = [half(-height / 4.0), half(height / 4.0)];
    let whole = BeamSection::combine(&layers, Bond::Composite).expect("valid");
    let exact = 70e9 * width * height.powi(3) / 12.0;
    assert!((whole.bending / exact - 1.0).abs() < 1e-12);
    assert!((whole.radius / radius - 1.0).abs() < 1e-12);
    assert!((whole.mass / (2700.0 * width * height) - 1.0).abs() < 1e-12);
}

#[test]
fn a_section_out_of_range_is_named() {
    let mut layers = steel_in_aluminium();
    layers[1].area = -1.0;
    let error = BeamSection::combine(&layers, Bond::Composite).expect_err("negative area");
    assert_eq!(error.to_string(), "ring section 1: area must be positive and finite, found -1");
    assert_eq!(
        BeamSection::combine(&[], Bond::Composite),
        Err(MaterialError::Refused("a ring needs at least one section".to_owned()))
    );
}

#[test]
fn halves_of_one_ring_bonded_are_the_whole_out_of_its_plane() {
    let (width, height) = (4e-3, 3e-3);
    let material = Material::new(70e9, 0.33, 2700.0).expect("valid");
    let part = |height: f64, radius: f64| RingLayer {
        material,
        area: width * height,
        inertia: width * height.powi(3) / 12.0,
        axial_inertia: None,
        torsion: None,
        radius,
        shear_coefficient: 5.0 / 6.0,
    };
    let combine = |layers: &[RingLayer]| {
        let section = BeamSection::combine(layers, Bond::Composite).expect("valid");
        section.out_of_plane
    };
    let halves = combine(&[part(height / 2.0, 7.5e-3 - height / 4.0), part(height / 2.0, 7.5e-3 + height / 4.0)]);
    let whole = combine(&[part(height, 7.5e-3)]);
    for (found, exact) in [
        (halves.bending, whole.bending),
        (halves.shear_compliance, whole.shear_compliance),
        (halves.radial_rotary, whole.radial_rotary),
    ] {
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
    }
    // with the parallel-axis terms of the halves
    assert!((halves.polar_rotary / whole.polar_rotary - 1.0).abs() < 1e-12);
    // the sum of the halves' torsion is a lower bound of the whole's
    assert!(halves.torsion < whole.torsion);
}

#[test]
fn rings_that_slip_are_summed_on_the_rule_of_their_radii() {
    let layers = steel_in_aluminium();
    let combine = |rule| {
        let section = BeamSection::combine(&layers, Bond::Slip(rule)).expect("valid");
        section.out_of_plane
    };
    let (own, common) = (combine(RadiusRule::Own), combine(RadiusRule::CommonCentroid));
    let ratio = layers[1].radius / layers[0].radius;
    let inertia = layers.map(|layer| layer.material.young * layer.out_of_plane_inertia());
    let twist = layers.map(|layer| layer.material.shear_modulus() * layer.torsion_constant());
    for (found, exact) in [
        (own.bending, inertia[0] + inertia[1] / ratio),
        (own.torsion, twist[0] + twist[1] / ratio),
        (common.bending, inertia[0] + inertia[1]),
        (common.torsion, twist[0] + twist[1]),
    ] {
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
    }
}

#[test]
fn what_is_switched_off_is_off_out_of_the_plane_too() {
    let combine = |bond| BeamSection::combine(&steel_in_aluminium(), bond).expect("valid");
    let section = combine(Bond::Composite);
    let stiff = section.without_shear();
    assert_eq!(stiff.shear_compliance.to_bits(), 0);
    assert_eq!(stiff.out_of_plane.shear_compliance.to_bits(), 0);
    assert!(stiff.out_of_plane.polar_rotary > 0.0);
    let light = section.without_rotary_inertia();
    assert_eq!(light.out_of_plane.radial_rotary.to_bits(), 0);
    assert_eq!(light.out_of_plane.polar_rotary.to_bits(), 0);
    assert!(light.out_of_plane.shear_compliance > 0.0);
}

#[test]
fn values_out_of_the_plane_are_checked_where_given() {
    let axial = |layer: &mut RingLayer, value| layer.axial_inertia = Some(value);
    let torsion = |layer: &mut RingLayer, value| layer.torsion = Some(value);
    type Set = fn(&mut RingLayer, f64);
    for (quantity, set) in [("axial_inertia", axial as Set), ("torsion", torsion as Set)] {
        for value in [0.0, -1.0, f64::NAN] {
            let mut layers = steel_in_aluminium();
            set(&mut layers[1], value);
            let error = BeamSection::combine(&layers, Bond::Composite).expect_err("no section");
            assert_eq!(
                error.to_string(),
                format!("ring section 1: {quantity} must be positive and finite, found {value}")
            );
        }
    }
}
