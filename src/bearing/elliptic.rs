//! Complete elliptic integrals of the first and second kind by the arithmetic-geometric mean.
//!
//! ```text
//! K(m) = ∫₀^{π/2} dφ / sqrt(1 − m sin²φ)      E(m) = ∫₀^{π/2} sqrt(1 − m sin²φ) dφ
//! ```
//!
//! The argument is the parameter `m = k²`, not the modulus `k`. Sources: Abramowitz and Stegun,
//! *Handbook of Mathematical Functions*, 17.3.1, 17.3.3 and 17.6.

use super::error::BearingError;
use std::f64::consts::FRAC_PI_2;

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
/// let at = plummer::bearing::elliptic::complete(0.5).unwrap();
/// assert!((at.first - 1.854_074_677_301_371_9).abs() < 4e-15);
/// ```
pub fn complete(parameter: f64) -> Result<CompleteElliptic, BearingError> {
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
mod tests {
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
            let at = complete(m).unwrap();
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
            let at = complete(m).unwrap();
            let (k, e) = (at.first, at.second);
            assert_relative_eq!(at.difference, (k - e) / (m * k), max_relative = 1e-14);
            let second = ((2.0 - m) * e - 2.0 * (1.0 - m) * k) / (m * m * k);
            assert_relative_eq!(at.second_difference, second, max_relative = 1e-13);
        }
        let at = complete(1e-14).unwrap();
        assert_relative_eq!(at.difference, 0.5, max_relative = 1e-13);
        assert_relative_eq!(at.second_difference, 0.375, max_relative = 1e-13);
    }

    #[test]
    fn one_and_above_are_refused_by_value() {
        for m in [1.0, 1.5, f64::NAN, f64::NEG_INFINITY] {
            assert!(complete(m).is_err());
        }
        let error = complete(1.0).unwrap_err();
        assert_eq!(error.to_string(), "elliptic parameter m = 1 must be below 1");
    }
}
