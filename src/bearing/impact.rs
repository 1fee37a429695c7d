//! A sphere striking a flat at right angles: Hertz's quasi-static impact.
//!
//! ```text
//! δ_max = (5 m v² / (4 k))^{2/5}       F_max = k δ_max^{3/2}
//! T     = (4/5) √π Γ(2/5) / Γ(9/10) · δ_max / v = 2.9433 δ_max / v
//! ```
//!
//! Source: K. L. Johnson, *Contact Mechanics*, 1985, section 11.4, (11.22) to (11.24).
//! Physical sense: a faster ball stays in contact for a slightly shorter time, `T ~ v^{-1/5}`.

use super::error::{BearingError, positive};

/// `(4/5) √π Γ(2/5) / Γ(9/10)`: contact time in units of `δ_max / v`.
pub const CONTACT_TIME_FACTOR: f64 = 2.943_275_184_324_704_7;

/// What an elastic impact does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactPeak {
    /// Largest approach δ_max, m.
    pub indentation: f64,
    /// Largest force, N.
    pub force: f64,
    /// Time from first touch to release, s.
    pub contact_time: f64,
}

/// Peak and duration of an impact with contact stiffness `stiffness` (N/m^{3/2}), moving mass
/// `mass` (kg; the reduced mass if both bodies move) and approach speed `speed` (m/s), all positive.
///
/// # Errors
/// [`BearingError`] names the value that is not.
pub fn impact(stiffness: f64, mass: f64, speed: f64) -> Result<ImpactPeak, BearingError> {
    for (name, value) in [("stiffness", stiffness), ("mass", mass), ("speed", speed)] {
        positive(name, value)?;
    }
    let indentation = (1.25 * mass * speed * speed / stiffness).powf(0.4);
    Ok(ImpactPeak {
        indentation,
        force: stiffness * indentation * indentation.sqrt(),
        contact_time: CONTACT_TIME_FACTOR * indentation / speed,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::hertz;
    use approx::assert_relative_eq;

    /// Steel sphere, diameter 10 mm, on a flat of the same steel: E 2.1e11 Pa, ν 0.3, 7800 kg/m³, 1 m/s.
    fn reference_stiffness_and_mass() -> (f64, f64) {
        let modulus = hertz::effective_modulus([2.1e11; 2], [0.3; 2]).unwrap();
        let contact = hertz::sphere_on_flat(5e-3, modulus).unwrap();
        let mass = 7800.0 * 4.0 / 3.0 * std::f64::consts::PI * 5e-3_f64.powi(3);
        (contact.stiffness, mass)
    }

    #[test]
    fn steel_sphere_at_one_metre_per_second() {
        let (stiffness, mass) = reference_stiffness_and_mass();
        let peak = impact(stiffness, mass, 1.0).unwrap();
        assert_relative_eq!(stiffness, 1.087_857e10, max_relative = 1e-6);
        assert_relative_eq!(peak.indentation, 1.171_042e-5, max_relative = 1e-6);
        assert_relative_eq!(peak.force, 435.94, max_relative = 1.2e-5); // five digits are given
        assert_relative_eq!(peak.contact_time, 3.446_700e-5, max_relative = 1e-6);
    }

    /// The factor is `2 ∫₀¹ dx / sqrt(1 − x^{5/2})`; with `x = 1 − y²` the integrand is smooth.
    #[test]
    fn contact_time_factor_is_the_integral_of_the_motion() {
        let panels = 2000;
        let integrand = |y: f64| {
            if y < 1e-9 {
                return 4.0 / 2.5_f64.sqrt();
            }
            let x = 1.0 - y * y;
            4.0 * y / (1.0 - x * x * x.sqrt()).sqrt()
        };
        let h = 1.0 / f64::from(panels);
        let mut sum = 0.0;
        for i in 0..panels {
            let a = f64::from(i) * h;
            sum += h / 6.0 * (integrand(a) + 4.0 * integrand(a + 0.5 * h) + integrand(a + h));
        }
        assert_relative_eq!(sum, CONTACT_TIME_FACTOR, max_relative = 1e-8);
    }

    #[test]
    fn energy_at_the_peak_is_the_kinetic_energy() {
        let peak = impact(3e9, 0.02, 0.7).unwrap();
        assert_relative_eq!(0.4 * peak.force * peak.indentation, 0.5 * 0.02 * 0.49, max_relative = 1e-14);
    }

    #[test]
    fn values_that_are_not_positive_are_named() {
        let error = impact(1.0, 1.0, -2.0).unwrap_err();
        assert_eq!(error.to_string(), "speed = -2 must be positive and finite");
        assert!(impact(0.0, 1.0, 1.0).is_err() && impact(1.0, f64::NAN, 1.0).is_err());
    }
}
