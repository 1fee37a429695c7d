//! Ring formulas against published values and an independent integration of the beam's equations.

use super::*;
use approx::assert_relative_eq;

#[test]
fn free_ring_of_nafems_test_6() {
    // R 1 m, round section d 0.1 m, E 2e11, rho 8000: 53.382, 150.99, 289.51 Hz.
    let d: f64 = 0.1;
    let bending = 2e11 * PI * d.powi(4) / 64.0;
    let mass = 8000.0 * PI * d * d / 4.0;
    for (order, hz) in [(2, 53.382), (3, 150.99), (4, 289.51)] {
        let computed = thin_frequency_hz(order, 1.0, bending, mass).unwrap();
        assert_relative_eq!(computed, hz, max_relative = 3e-5);
    }
    assert!(thin_frequency_hz(1, 1.0, bending, mass).unwrap().abs() < f64::MIN_POSITIVE);
    // out of the plane, nu 0.3: 51.849, 148.77, 286.98 Hz
    let torsion = bending / 1.3;
    let computed = |order| thin_out_of_plane_frequency_hz(order, 1.0, bending, torsion, mass);
    for (order, hz) in [(2, 51.849), (3, 148.77), (4, 286.98)] {
        assert_relative_eq!(computed(order).unwrap(), hz, max_relative = 3e-5);
    }
    assert!(computed(1).unwrap().abs() < f64::MIN_POSITIVE);
}

#[test]
fn thin_constants_have_four_published_digits() {
    assert_relative_eq!(THIN_SHORTENING, 0.1488, epsilon = 5e-5);
    assert_relative_eq!(THIN_WIDENING, 0.1366, epsilon = 5e-5);
}

/// State along the arc: u, w, θ, N, V, M; the right-hand side is strains and equilibrium as printed above.
fn slope(section: &RingSection, y: &[f64; 6]) -> [f64; 6] {
    let [u, w, rotation, axial, shear, moment] = *y;
    let r = section.radius;
    [
        r * axial / section.axial - w,
        r * shear / section.shear + u - r * rotation,
        r * moment / section.bending,
        -shear,
        axial,
        r * shear,
    ]
}

/// Fourth-order Runge-Kutta over a quarter, from the free section (φ = 0) to the load (φ = π/2).
fn quarter(section: &RingSection, start: [f64; 6]) -> [f64; 6] {
    let steps = 400;
    let h = 0.5 * PI / f64::from(steps);
    let shifted = |y: &[f64; 6], k: &[f64; 6], f: f64| std::array::from_fn(|i| y[i] + f * k[i]);
    let mut y = start;
    for _ in 0..steps {
        let k1 = slope(section, &y);
        let k2 = slope(section, &shifted(&y, &k1, 0.5 * h));
        let k3 = slope(section, &shifted(&y, &k2, 0.5 * h));
        let k4 = slope(section, &shifted(&y, &k3, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    y
}

/// Shooting: u = θ = V = 0 at both ends but V = −P/2 at the load; N = −P/2 at φ = 0.
/// Unknown at φ = 0: w and M; two conditions at φ = π/2: u = 0 and θ = 0.
#[test]
fn thick_ring_agrees_with_integration_of_its_differential_equations() {
    let section = RingSection { radius: 0.1, bending: 30.0, axial: 4e4, shear: 9e3 };
    let force = 7.0;
    let base = quarter(&section, [0.0, 0.0, 0.0, -0.5 * force, 0.0, 0.0]);
    let by_w = quarter(&section, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    let by_moment = quarter(&section, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let moment = -base[2] / by_moment[2]; // θ does not depend on w
    let w_start = -(base[0] + moment * by_moment[0]) / by_w[0];
    let end: [f64; 6] = std::array::from_fn(|i| base[i] + w_start * by_w[i] + moment * by_moment[i]);
    assert_relative_eq!(end[4], -0.5 * force, max_relative = 1e-9);
    let ring = pinched(&section, force).unwrap();
    assert_relative_eq!(ring.shortening, -2.0 * end[1], max_relative = 1e-8);
    assert_relative_eq!(ring.widening, 2.0 * w_start, max_relative = 1e-8);
}

#[test]
fn rigid_section_forces_leave_the_thin_ring() {
    let section = RingSection { radius: 2.0, bending: 5.0, axial: f64::INFINITY, shear: f64::INFINITY };
    let ring = pinched(&section, 1.0).unwrap();
    assert_relative_eq!(ring.shortening, THIN_SHORTENING * 8.0 / 5.0, max_relative = 1e-15);
    assert_relative_eq!(ring.widening, THIN_WIDENING * 8.0 / 5.0, max_relative = 1e-15);
}

#[test]
fn properties_that_are_not_positive_are_named() {
    let good = RingSection { radius: 1.0, bending: 1.0, axial: 1.0, shear: 1.0 };
    for (section, message) in [
        (RingSection { radius: -1.0, ..good }, "radius = -1 must be positive"),
        (RingSection { bending: 0.0, ..good }, "bending stiffness = 0 must be positive"),
        (RingSection { axial: f64::NAN, ..good }, "axial stiffness = NaN must be positive"),
        (RingSection { shear: 0.0, ..good }, "shear stiffness = 0 must be positive"),
    ] {
        assert_eq!(pinched(&section, 1.0).unwrap_err().to_string(), message);
    }
    let error = thin_frequency_hz(2, 1.0, 1.0, 0.0).unwrap_err();
    assert_eq!(error.to_string(), "mass per length = 0 must be positive");
    for (torsion, mass, message) in
        [(0.0, 1.0, "torsion stiffness = 0 must be positive"), (1.0, -1.0, "mass per length = -1 must be positive")]
    {
        let error = thin_out_of_plane_frequency_hz(2, 1.0, 1.0, torsion, mass).unwrap_err();
        assert_eq!(error.to_string(), message);
    }
}
