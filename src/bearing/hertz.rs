//! Hertz stiffness of an elliptical point contact from geometry and material.
//!
//! Two bodies touch in one point; each has two principal curvatures in common planes, convex
//! positive (the paper's (21), (22) with the sign of the second bracket put right):
//!
//! ```text
//! Σρ   = ρ_I1 + ρ_I2 + ρ_II1 + ρ_II2                                          [1/m]
//! F(ρ) = |(ρ_I1 − ρ_I2) + (ρ_II1 − ρ_II2)| / Σρ                               [-]
//! F(ρ) = ((κ² + 1) E − 2 K) / ((κ² − 1) E),   K, E at m = 1 − 1/κ²            -> κ = a/b ≥ 1
//! δ*   = (2 K / π) (π / (2 κ² E))^{1/3}
//! Q    = k δ^{3/2},   k = (4 √2 / 3) E* / (δ*^{3/2} Σρ^{1/2})                 [N/m^{3/2}]
//! ```
//!
//! Source: T. A. Harris, *Rolling Bearing Analysis*, 4th edition, chapter 6, (6.23) to (6.41).
//! Physical sense: the closer the surfaces conform, the larger the patch and the stiffer the contact.
//!
//! Complete elliptic integrals of the first and second kind by the arithmetic-geometric mean.
//!
//! ```text
//! K(m) = ∫₀^{π/2} dφ / sqrt(1 − m sin²φ)      E(m) = ∫₀^{π/2} sqrt(1 − m sin²φ) dφ
//! ```
//!
//! The argument is the parameter `m = k²`, not the modulus `k`. Sources: Abramowitz and Stegun,
//! *Handbook of Mathematical Functions*, 17.3.1, 17.3.3 and 17.6.

use super::error::{BearingError, refused};
use std::f64::consts::FRAC_PI_2;

/// Upper end of the search for `ln κ`: the smallest `1 − F` that doubles can hold needs about 20.
const LOG_ELLIPTICITY_MAX: f64 = 36.0;

/// Halvings of the search interval: 36 · 2⁻⁵⁵ is 1e-15 in `ln κ`.
const HALVINGS: usize = 55;

/// Principal curvatures of one body at the contact, 1/m, convex positive.
///
/// The planes are the same two for both bodies; on a race, plane 1 holds the bearing's axis (the
/// groove) and plane 2 is the rolling plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalCurvatures {
    /// Curvature in plane 1, 1/m.
    pub plane_1: f64,
    /// Curvature in plane 2, 1/m.
    pub plane_2: f64,
}

impl PrincipalCurvatures {
    /// A sphere of the given radius (m): the same curvature in both planes.
    pub fn sphere(radius: f64) -> Self {
        Self { plane_1: 1.0 / radius, plane_2: 1.0 / radius }
    }

    /// A flat surface: no curvature.
    pub fn flat() -> Self {
        Self { plane_1: 0.0, plane_2: 0.0 }
    }
}

/// Stiffness of one point contact and what it was computed from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzStiffness {
    /// k in `Q = k δ^{3/2}`, N/m^{3/2}.
    pub stiffness: f64,
    /// Effective modulus E*, Pa.
    pub effective_modulus: f64,
    /// Σρ, 1/m.
    pub curvature_sum: f64,
    /// F(ρ), 0 (circular patch) up to 1 (line contact).
    pub curvature_difference: f64,
    /// κ = a/b, ratio of the patch's axes, 1 or more.
    pub ellipticity: f64,
    /// δ*, dimensionless approach; 1 for a circular patch.
    pub approach: f64,
    /// a*, dimensionless longer half-axis of the patch; 1 for a circular one.
    pub half_axis: f64,
}

/// The patch in which two bodies touch, and its pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPatch {
    /// Longer half-axis a, m: across the rolling direction on a race.
    pub longer: f64,
    /// Shorter half-axis b, m.
    pub shorter: f64,
    /// Largest pressure, in the middle, Pa.
    pub peak_pressure: f64,
}

impl HertzStiffness {
    /// Patch under a `force` (N, zero or positive); all zero without force.
    ///
    /// ```text
    /// a = a* (3 Q / (2 Σρ E*))^{1/3},   a* = (2 κ² E / π)^{1/3},   b = a / κ,   p_max = 3 Q / (2 π a b)
    /// ```
    pub fn patch(&self, force: f64) -> ContactPatch {
        let scale = 1.5 * force / (self.curvature_sum * self.effective_modulus);
        let longer = self.half_axis * scale.cbrt();
        let shorter = longer / self.ellipticity;
        let area = std::f64::consts::PI * longer * shorter;
        ContactPatch { longer, shorter, peak_pressure: if area > 0.0 { 1.5 * force / area } else { 0.0 } }
    }
}

/// Effective modulus E* of two bodies, Pa: `1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂`.
///
/// `young` in Pa, positive; `poisson` above −1 and at most 0.5; one entry a body.
///
/// # Errors
/// [`BearingError`] names the modulus or ratio out of range.
pub fn effective_modulus(young: [f64; 2], poisson: [f64; 2]) -> Result<f64, BearingError> {
    let mut compliance = 0.0;
    for (young, poisson) in young.into_iter().zip(poisson) {
        finite("Young's modulus", young)?;
        finite("Poisson's ratio", poisson)?;
        positive_modulus(young)?;
        if poisson <= -1.0 || poisson > 0.5 {
            return Err(BearingError(format!("Poisson's ratio {poisson} must be above -1 and at most 0.5")));
        }
        compliance += (1.0 - poisson * poisson) / young;
    }
    Ok(1.0 / compliance)
}

/// Hertz stiffness of two bodies with the given curvatures and effective modulus (Pa).
///
/// # Errors
/// [`BearingError`] for NaN or infinite input, Σρ ≤ 0, F(ρ) ≥ 1, and a modulus ≤ 0.
pub fn stiffness(
    first: PrincipalCurvatures,
    second: PrincipalCurvatures,
    effective_modulus: f64,
) -> Result<HertzStiffness, BearingError> {
    for (name, value) in [
        ("curvature of the first body in plane 1", first.plane_1),
        ("curvature of the first body in plane 2", first.plane_2),
        ("curvature of the second body in plane 1", second.plane_1),
        ("curvature of the second body in plane 2", second.plane_2),
        ("effective modulus", effective_modulus),
    ] {
        finite(name, value)?;
    }
    positive_modulus(effective_modulus)?;
    let relative_1 = first.plane_1 + second.plane_1;
    let relative_2 = first.plane_2 + second.plane_2;
    let curvature_sum = relative_1 + relative_2;
    if curvature_sum <= 0.0 {
        return Err(BearingError(format!(
            "curvature sum {curvature_sum} 1/m must be positive: the concave surface is tighter than the convex one"
        )));
    }
    let curvature_difference = (relative_1 - relative_2).abs() / curvature_sum;
    // 1 − F without cancellation: twice the smaller relative curvature over the sum.
    let complement = 2.0 * relative_1.min(relative_2) / curvature_sum;
    if complement <= 0.0 {
        return Err(BearingError(format!(
            "curvature difference F = {curvature_difference} must be below 1: the surfaces conform in one plane"
        )));
    }
    let patch = solve_patch(curvature_difference, complement);
    let approach = patch.approach();
    let factor = 4.0 * std::f64::consts::SQRT_2 / 3.0;
    let stiffness = factor * effective_modulus / (approach * approach.sqrt() * curvature_sum.sqrt());
    Ok(HertzStiffness {
        stiffness,
        effective_modulus,
        curvature_sum,
        curvature_difference,
        ellipticity: patch.ellipticity,
        approach,
        half_axis: patch.half_axis(),
    })
}

/// Stiffness of a sphere (radius in m) on a flat, N/m^{3/2}: `k = (4/3) E* √R`.
///
/// # Errors
/// As [`stiffness`]; the curvature of a radius ≤ 0 is not positive, that of a zero one not finite.
pub fn sphere_on_flat(radius: f64, effective_modulus: f64) -> Result<HertzStiffness, BearingError> {
    stiffness(PrincipalCurvatures::sphere(radius), PrincipalCurvatures::flat(), effective_modulus)
}

/// The elliptical patch: its axis ratio and the integrals that belong to it.
struct Patch {
    ellipticity: f64,
    integrals: CompleteElliptic,
}

impl Patch {
    fn at(log_ellipticity: f64) -> Self {
        let complement = (-2.0 * log_ellipticity).exp();
        let parameter = -(-2.0 * log_ellipticity).exp_m1();
        Self { ellipticity: log_ellipticity.exp(), integrals: from_complement(parameter, complement) }
    }

    /// F and 1 − F, each without cancellation:
    /// `F = m K second_difference / E`, `1 − F = 2 (1 − m) K difference / E`.
    fn difference_and_complement(&self) -> (f64, f64) {
        let complement = 1.0 / (self.ellipticity * self.ellipticity);
        let ratio = self.integrals.first / self.integrals.second;
        (
            (1.0 - complement) * ratio * self.integrals.second_difference,
            2.0 * complement * ratio * self.integrals.difference,
        )
    }

    fn half_axis(&self) -> f64 {
        let square = self.ellipticity * self.ellipticity;
        (2.0 * square * self.integrals.second / std::f64::consts::PI).cbrt()
    }

    fn approach(&self) -> f64 {
        use std::f64::consts::PI;
        let CompleteElliptic { first, second, .. } = self.integrals;
        let cube = PI / (2.0 * self.ellipticity * self.ellipticity * second);
        2.0 * first / PI * cube.cbrt()
    }
}

/// Halves `ln κ` until F is met: F grows with κ. Works on 1 − F where F is near one.
fn solve_patch(difference: f64, complement: f64) -> Patch {
    let (mut low, mut high) = (0.0, LOG_ELLIPTICITY_MAX);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let (at_difference, at_complement) = Patch::at(middle).difference_and_complement();
        let too_round = if difference < 0.5 { at_difference < difference } else { at_complement > complement };
        if too_round {
            low = middle;
        } else {
            high = middle;
        }
    }
    // The lower end, so that F = 0 gives κ = 1 exactly.
    Patch::at(low)
}

fn finite(name: &str, value: f64) -> Result<(), BearingError> {
    if value.is_finite() { Ok(()) } else { refused(name, value, "is not a finite number") }
}

fn positive_modulus(young: f64) -> Result<(), BearingError> {
    if young > 0.0 { Ok(()) } else { Err(BearingError(format!("Young's modulus {young} Pa must be positive"))) }
}

/// Steps of the mean after which the sequence has converged for every parameter: the error squares
/// in each step, and from the smallest positive `sqrt(1 − m)` some ten steps bring the two means together.
const MEAN_STEPS: usize = 40;

/// Relative distance of the two means at which the next step no longer changes them.
const MEAN_TOLERANCE: f64 = 1e-9;

/// K and E at one parameter, with the differences that cancel when they are formed from K and E.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompleteElliptic {
    /// K(m), first kind; from π/2 at m = 0 to infinity at m = 1.
    pub first: f64,
    /// E(m), second kind; from π/2 at m = 0 to 1 at m = 1.
    pub second: f64,
    /// `(K − E) / (m K)`, accurate to rounding for every m; 1/2 at m = 0.
    pub difference: f64,
    /// `((2 − m) E − 2 (1 − m) K) / (m² K)`, accurate to rounding for every m; 3/8 at m = 0.
    pub second_difference: f64,
}

/// K(m) and E(m) for `m < 1` (negative values included), to about 1e-15 relative.
///
/// # Errors
/// [`BearingError`] unless `m < 1`.
///
/// # Example
/// ```
/// let at = plummer::bearing::hertz::complete_elliptic(0.5).unwrap();
/// assert!((at.first - 1.854_074_677_301_371_9).abs() < 4e-15);
/// ```
pub fn complete_elliptic(parameter: f64) -> Result<CompleteElliptic, BearingError> {
    if parameter.is_finite() && parameter < 1.0 {
        Ok(from_complement(parameter, 1.0 - parameter))
    } else {
        Err(BearingError(format!("elliptic parameter m = {parameter} must be below 1")))
    }
}

/// K and E from `m` and `1 − m` given separately, so that neither end loses digits.
///
/// `c_n² = a_n² − g_n²` of the mean, `E = K (1 − Σ 2^{n−1} c_n²)`; `c_0² = m` is taken out of every
/// sum by hand, which leaves differences of terms of unlike size only.
/// Requires `complement > 0` and `parameter + complement = 1`.
pub(crate) fn from_complement(parameter: f64, complement: f64) -> CompleteElliptic {
    let root = complement.sqrt();
    let mut arithmetic = 0.5 * (1.0 + root);
    let mut geometric = root.sqrt();
    // c_1 = (1 − root)/2 = m / (2 (1 + root)); `scaled` is c_n / m and `plain` is c_n.
    let mut scaled = 0.5 / (1.0 + root);
    let mut plain = scaled * parameter;
    let mut weight = 1.0;
    let mut tail = 0.0; // Σ_{n ≥ 1} 2^{n−1} (c_n / m)²
    for _ in 0..MEAN_STEPS {
        tail += weight * scaled * scaled;
        if plain.abs() <= MEAN_TOLERANCE * arithmetic {
            break;
        }
        let next = 0.5 * (arithmetic + geometric);
        geometric = (arithmetic * geometric).sqrt();
        scaled *= plain / (4.0 * next);
        plain = plain * plain / (4.0 * next);
        arithmetic = next;
        weight *= 2.0;
    }
    let first = FRAC_PI_2 / (0.5 * (arithmetic + geometric));
    let difference = 0.5 + parameter * tail;
    CompleteElliptic {
        first,
        second: first * (1.0 - parameter * difference),
        difference,
        second_difference: 0.5 - (2.0 - parameter) * tail,
    }
}

#[cfg(test)]
#[path = "hertz_tests.rs"]
mod tests;

#[cfg(test)]
mod elliptic_tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Reference: 30-digit arithmetic (mpmath `ellipk`, `ellipe`).
    const TABLE: [(f64, f64, f64); 6] = [
        (0.0, FRAC_PI_2, FRAC_PI_2),
        (1e-9, 1.570_796_327_187_595_7, 1.570_796_326_402_197_5),
        (0.5, 1.854_074_677_301_371_9, 1.350_643_881_047_675_5),
        (0.99, 3.695_637_362_989_874_7, 1.015_993_545_025_224),
        (0.999_999, 8.294_051_463_615_44, 1.000_003_897_026_172),
        (-3.0, 1.078_257_823_749_821_6, 2.422_112_055_136_919),
    ];

    #[test]
    fn table_of_both_kinds_to_1e_15() {
        for (m, first, second) in TABLE {
            let at = complete_elliptic(m).unwrap();
            // 0.999999 is not representable: K moves by 2e-11 relative per 1e-16 of m there.
            let tolerance = if m > 0.999 { 2e-11 } else { 1e-15 };
            assert_relative_eq!(at.first, first, max_relative = tolerance);
            assert_relative_eq!(at.second, second, max_relative = 1e-15);
        }
    }

    #[test]
    fn legendre_relation_holds_between_complementary_parameters() {
        for m in [1e-12, 1e-3, 0.2, 0.5, 0.77, 0.999] {
            let here = from_complement(m, 1.0 - m);
            let there = from_complement(1.0 - m, m);
            let relation = here.second * there.first + there.second * here.first - here.first * there.first;
            assert_relative_eq!(relation, FRAC_PI_2, max_relative = 4e-15);
        }
    }

    #[test]
    fn differences_agree_with_their_definitions_and_limits() {
        for m in [-2.0, 0.3, 0.6, 0.9, 0.99] {
            let at = complete_elliptic(m).unwrap();
            let (k, e) = (at.first, at.second);
            assert_relative_eq!(at.difference, (k - e) / (m * k), max_relative = 1e-14);
            let second = ((2.0 - m) * e - 2.0 * (1.0 - m) * k) / (m * m * k);
            assert_relative_eq!(at.second_difference, second, max_relative = 1e-13);
        }
        let at = complete_elliptic(1e-14).unwrap();
        assert_relative_eq!(at.difference, 0.5, max_relative = 1e-13);
        assert_relative_eq!(at.second_difference, 0.375, max_relative = 1e-13);
    }

    #[test]
    fn one_and_above_are_refused_by_value() {
        for m in [1.0, 1.5, f64::NAN, f64::NEG_INFINITY] {
            assert!(complete_elliptic(m).is_err());
        }
        let error = complete_elliptic(1.0).unwrap_err();
        assert_eq!(error.to_string(), "elliptic parameter m = 1 must be below 1");
    }
}
