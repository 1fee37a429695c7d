//! Hertz stiffness against the source bearing, 30-digit arithmetic and limits.

use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;

/// The source's ball bearing (m): ball, race radii, groove radii.
const BALL: f64 = 1e-3;
const INNER: PrincipalCurvatures = PrincipalCurvatures { plane_1: -1.0 / 1.04e-3, plane_2: 1.0 / 2.754e-3 };
const OUTER: PrincipalCurvatures = PrincipalCurvatures { plane_1: -1.0 / 1.07e-3, plane_2: -1.0 / 4.7565e-3 };

fn steel() -> f64 {
    effective_modulus([206e9; 2], [0.3; 2]).unwrap()
}

#[test]
fn source_bearing_has_the_documented_stiffnesses() {
    let ball = PrincipalCurvatures::sphere(BALL);
    let inner = stiffness(ball, INNER, steel()).unwrap();
    assert_relative_eq!(inner.stiffness, 1.257e10, max_relative = 5e-4);
    assert_relative_eq!(inner.curvature_difference, 0.9451, epsilon = 5e-5);
    assert_relative_eq!(inner.ellipticity, 9.818, epsilon = 5e-4);
    let outer = stiffness(ball, OUTER, steel()).unwrap();
    assert_relative_eq!(outer.stiffness, 1.129e10, max_relative = 5e-4);
    assert_relative_eq!(outer.curvature_difference, 0.8470, epsilon = 5e-5);
    assert_relative_eq!(outer.ellipticity, 5.065, epsilon = 5e-4);
}

/// Two bodies with a given F: relative curvatures (1 ± F)/2.
fn bodies(difference: f64) -> (PrincipalCurvatures, PrincipalCurvatures) {
    let low = 0.5 * (1.0 - difference);
    (PrincipalCurvatures { plane_1: low, plane_2: 1.0 - low }, PrincipalCurvatures::flat())
}

#[test]
fn ellipticity_and_approach_agree_with_30_digit_arithmetic() {
    // (F, κ, δ*) by root search in mpmath.
    for (difference, ellipticity, approach) in [
        (0.3, 1.509_792_320_119_546_3, 0.979_206_401_529_582_3),
        (0.9451, 9.816_249_204_614_99, 0.590_358_481_603_446),
        (0.999, 99.893_730_503_426_92, 0.205_898_454_408_654_1),
    ] {
        let (first, second) = bodies(difference);
        let contact = stiffness(first, second, 1e11).unwrap();
        // 1e-12, plus what the rounding of F itself moves κ: about ε / (1 − F).
        let tolerance = 1e-12 + 2e-16 / (1.0 - difference);
        assert_relative_eq!(contact.ellipticity, ellipticity, max_relative = tolerance);
        assert_relative_eq!(contact.approach, approach, max_relative = 1e-12);
    }
}

#[test]
fn sphere_is_the_limit_of_no_curvature_difference() {
    let contact = sphere_on_flat(5e-3, 1.2e11).unwrap();
    assert_relative_eq!(contact.ellipticity, 1.0, max_relative = 1e-15);
    assert_relative_eq!(contact.approach, 1.0, max_relative = 1e-15);
    let closed = 4.0 / 3.0 * 1.2e11 * 5e-3_f64.sqrt();
    assert_relative_eq!(contact.stiffness, closed, max_relative = 1e-14);
    // and it is approached without a jump
    let (first, second) = bodies(1e-9);
    let near = stiffness(first, second, 1.2e11).unwrap();
    // F = 3/4 (κ − 1) to first order, from the series of K and E at m = 0
    assert_relative_eq!(near.ellipticity - 1.0, 4.0 / 3.0 * 1e-9, max_relative = 1e-6);
}

#[test]
fn near_line_contact_stays_finite() {
    for difference in [0.999_999_9, 1.0 - 1e-12, 1.0 - 2e-16] {
        let (first, second) = bodies(difference);
        let contact = stiffness(first, second, 1e11).unwrap();
        assert!(contact.stiffness.is_finite() && contact.ellipticity > 1e4);
    }
    let (first, second) = bodies(0.999_999_9);
    let contact = stiffness(first, second, 1e11).unwrap();
    // The rounding of (1 − F)/2 at F = 0.9999999 is 1e-9 relative.
    assert_relative_eq!(contact.ellipticity, 14_099.794_045_23, max_relative = 2e-9);
}

#[test]
fn every_error_fires_with_its_values() {
    let ball = PrincipalCurvatures::sphere(BALL);
    let race = |plane_1: f64, plane_2: f64| stiffness(ball, PrincipalCurvatures { plane_1, plane_2 }, 1e11);
    let message = |found: Result<HertzStiffness, BearingError>| found.unwrap_err().to_string();
    assert_eq!(
        race(-1000.0, -1000.0).unwrap_err().to_string(),
        "curvature sum 0 1/m must be positive: the concave surface is tighter than the convex one"
    );
    assert_eq!(
        race(-1250.0, 0.0).unwrap_err().to_string(),
        "curvature difference F = 1.6666666666666667 must be below 1: the surfaces conform in one plane"
    );
    assert!(message(race(-1000.0, 0.0)).starts_with("curvature difference"));
    assert_eq!(
        race(f64::NAN, 0.0).unwrap_err().to_string(),
        "curvature of the second body in plane 1 = NaN is not a finite number"
    );
    assert!(message(sphere_on_flat(0.0, 1e11)).ends_with("is not a finite number"));
    assert!(message(sphere_on_flat(-1.0, 1e11)).starts_with("curvature sum"));
    assert!(message(sphere_on_flat(1.0, 0.0)).starts_with("Young's modulus"));
    assert_eq!(
        effective_modulus([2e11, -1.0], [0.3; 2]).unwrap_err().to_string(),
        "Young's modulus -1 Pa must be positive"
    );
    assert_eq!(
        effective_modulus([2e11; 2], [0.3, 0.6]).unwrap_err().to_string(),
        "Poisson's ratio 0.6 must be above -1 and at most 0.5"
    );
    let infinite = effective_modulus([f64::INFINITY, 1.0], [0.3; 2]).unwrap_err().to_string();
    assert!(infinite.ends_with("is not a finite number"));
}

proptest! {
    /// Halving all lengths divides k by √2; swapping planes or bodies changes nothing.
    #[test]
    fn scaling_and_symmetry(a in 1.0..1e4_f64, b in 1.0..1e4_f64, c in 0.0..1e3_f64) {
        let first = PrincipalCurvatures { plane_1: a, plane_2: b };
        let second = PrincipalCurvatures { plane_1: c, plane_2: 0.0 };
        let one = stiffness(first, second, 1e11).unwrap();
        let doubled = |s: PrincipalCurvatures| PrincipalCurvatures { plane_1: 2.0 * s.plane_1, plane_2: 2.0 * s.plane_2 };
        let two = stiffness(doubled(first), doubled(second), 1e11).unwrap();
        prop_assert!((two.stiffness * 2f64.sqrt() / one.stiffness - 1.0).abs() < 1e-12);
        let turned = |s: PrincipalCurvatures| PrincipalCurvatures { plane_1: s.plane_2, plane_2: s.plane_1 };
        let other = stiffness(turned(second), turned(first), 1e11).unwrap();
        prop_assert!((other.stiffness / one.stiffness - 1.0).abs() < 1e-12);
    }

    /// The solved κ satisfies Harris' equation as printed.
    #[test]
    fn ellipticity_satisfies_the_printed_equation(difference in 0.02..0.999_f64) {
        let (first, second) = bodies(difference);
        let contact = stiffness(first, second, 1e11).unwrap();
        let k2 = contact.ellipticity * contact.ellipticity;
        let at = complete_elliptic(1.0 - 1.0 / k2).unwrap();
        let printed = ((k2 + 1.0) * at.second - 2.0 * at.first) / ((k2 - 1.0) * at.second);
        prop_assert!((printed - difference).abs() < 1e-12);
    }
}

/// A sphere on a flat: a³ = 3 Q R / (4 E*), p_max = (6 Q E*² / (π³ R²))^{1/3} (Johnson, Contact Mechanics, (4.22) to
/// (4.24)).
#[test]
fn patch_of_a_sphere_on_a_flat() {
    let (radius, modulus, force) = (5e-3, 1.2e11, 30.0_f64);
    let patch = sphere_on_flat(radius, modulus).unwrap().patch(force);
    let a = (0.75 * force * radius / modulus).cbrt();
    let pressure = (6.0 * force * modulus * modulus / (std::f64::consts::PI.powi(3) * radius * radius)).cbrt();
    assert_relative_eq!(patch.longer, a, max_relative = 1e-14);
    assert_relative_eq!(patch.shorter, a, max_relative = 1e-14);
    assert_relative_eq!(patch.peak_pressure, pressure, max_relative = 1e-13);
    let unloaded = sphere_on_flat(radius, modulus).unwrap().patch(0.0);
    assert_relative_eq!(unloaded.peak_pressure, 0.0);
}

/// The pressure p_max sqrt(1 − x²/a² − y²/b²) flattens the gap: its deflection at the middle is the approach, and the
/// curvatures of the deflection are those of the gap. With p_max, a and b of the patch, E* δ = p_max b K(e) and
/// E* A = p_max b / (e² a²) (K − E) for the smaller relative curvature 2 A (Johnson, (4.26)).
#[test]
fn patch_of_an_ellipse_supports_its_own_shape() {
    let ball = PrincipalCurvatures::sphere(BALL);
    let contact = stiffness(ball, INNER, steel()).unwrap();
    let force = 12.0;
    let patch = contact.patch(force);
    let parameter = 1.0 - 1.0 / (contact.ellipticity * contact.ellipticity);
    let k = from_complement(parameter, 1.0 - parameter);
    let approach = patch.peak_pressure * patch.shorter * k.first / contact.effective_modulus;
    let by_stiffness = (force / contact.stiffness).powf(2.0 / 3.0);
    // κ is found to 1e-12
    assert_relative_eq!(approach, by_stiffness, max_relative = 1e-11);
    let smaller = 1.0 / BALL - 1.0 / 1.04e-3;
    let flattened = 2.0 * patch.peak_pressure * patch.shorter * (k.first - k.second)
        / (parameter * patch.longer * patch.longer * contact.effective_modulus);
    assert_relative_eq!(flattened, smaller, max_relative = 1e-10);
}

/// T. A. Harris, *Rolling Bearing Analysis*, 4th edition, table 6.1: F, a*, b*, δ*, as printed.
const TABLE_6_1: [[f64; 4]; 7] = [
    [0.1075, 1.0760, 0.9318, 0.9974],
    [0.4795, 1.4556, 0.7278, 0.9429],
    [0.7332, 2.011, 0.5881, 0.8394],
    [0.87366, 2.800, 0.4863, 0.7169],
    [0.95738, 4.395, 0.3830, 0.5551],
    [0.990902, 8.062, 0.2814, 0.3745],
    [0.9998527, 37.38, 0.13050, 0.11995],
];

#[test]
fn dimensionless_axes_and_approach_meet_table_6_1() {
    let at = |difference: f64| {
        // relative curvatures of sum 2 and this difference, against a flat
        let body = PrincipalCurvatures { plane_1: 1.0 - difference, plane_2: 1.0 + difference };
        let found = stiffness(body, PrincipalCurvatures::flat(), steel()).unwrap();
        [found.half_axis, found.half_axis / found.ellipticity, found.approach]
    };
    for [difference, printed @ ..] in TABLE_6_1 {
        let found = at(difference);
        println!("F {difference}: {found:?}; table {printed:?}");
        for (found, printed) in found.into_iter().zip(printed) {
            // four digits of F, which the largest a* depends on by 1e-3
            assert_relative_eq!(found, printed, max_relative = 1e-3);
        }
    }
    // between two rows of the table
    let [a, b, approach] = at(0.9978);
    assert!((12.789..14.839).contains(&a) && (0.2072..0.2232).contains(&b), "{a} {b}");
    assert!((0.2427..0.2705).contains(&approach), "{approach}");
}
