//! Force law of one contact: Hertz with optional Hunt-Crossley damping, never tensile.
//!
//! ```text
//! F = k δ^{3/2} (1 + c δ̇)   for δ > 0 and 1 + c δ̇ > 0,   else 0
//! ```
//!
//! `δ` m, `δ̇` m/s, `k` N/m^{3/2} (the paper's (7), (8)), `c` s/m. Source of the damping term:
//! K. H. Hunt and F. R. E. Crossley, J. Applied Mechanics 42 (1975) 440-445. The force is continuous at
//! first touch, unlike a parallel dashpot's. A NaN penetration gives a NaN force, so that a failed
//! computation shows itself.

/// Force and its derivatives at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// Force, N, zero or compressive (positive).
    pub force: f64,
    /// ∂F/∂δ, N/m.
    pub by_penetration: f64,
    /// ∂F/∂δ̇, N s/m.
    pub by_rate: f64,
}

/// Force law with a fixed stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzContact {
    /// k, N/m^{3/2}, positive.
    pub stiffness: f64,
    /// Hunt-Crossley coefficient c, s/m, zero or positive.
    pub damping: f64,
}

impl HertzContact {
    /// Force at penetration `delta` (m) growing at `rate` (m/s).
    #[inline]
    pub fn force(&self, delta: f64, rate: f64) -> f64 {
        if delta <= 0.0 {
            return 0.0;
        }
        let factor = 1.0 + self.damping * rate;
        if factor <= 0.0 {
            return 0.0;
        }
        self.stiffness * (delta * delta.sqrt()) * factor
    }

    /// Force and derivatives at penetration `delta` (m) growing at `rate` (m/s).
    ///
    /// At the edges (δ = 0, or damping that cancels the force) the derivatives of the free side, zero, are given.
    #[inline]
    pub(crate) fn linearised(&self, delta: f64, rate: f64) -> ContactForce {
        let factor = 1.0 + self.damping * rate;
        if delta <= 0.0 || factor <= 0.0 {
            return ContactForce { force: 0.0, by_penetration: 0.0, by_rate: 0.0 };
        }
        let root = self.stiffness * delta.sqrt();
        let elastic = root * delta;
        ContactForce { force: elastic * factor, by_penetration: 1.5 * root * factor, by_rate: elastic * self.damping }
    }

    /// Elastic energy at penetration `delta` (m), J: `(2/5) k δ^{5/2}`, the paper's (9).
    #[inline]
    pub(crate) fn energy(&self, delta: f64) -> f64 {
        if delta <= 0.0 { 0.0 } else { 0.4 * self.stiffness * delta * delta * delta.sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    const LAW: HertzContact = HertzContact { stiffness: 1.129e10, damping: 1.5 };

    #[test]
    fn force_is_the_power_law() {
        let elastic = HertzContact { damping: 0.0, ..LAW };
        assert_relative_eq!(elastic.force(2e-6, 0.3), 1.129e10 * 2e-6_f64.powf(1.5), max_relative = 1e-14);
        assert_relative_eq!(LAW.force(2e-6, 0.1), 1.15 * elastic.force(2e-6, 0.0), max_relative = 1e-14);
    }

    #[test]
    fn nothing_without_overlap_and_nan_shows() {
        for delta in [-1e-6, 0.0] {
            assert!(LAW.force(delta, 5.0).abs() < f64::MIN_POSITIVE);
            assert!(LAW.linearised(delta, 5.0).by_penetration.abs() < f64::MIN_POSITIVE);
            assert!(LAW.energy(delta).abs() < f64::MIN_POSITIVE);
        }
        assert!(LAW.force(f64::NAN, 0.0).is_nan());
        assert!(LAW.force(1e-6, f64::NAN).is_nan());
        assert!(LAW.linearised(f64::NAN, 0.0).force.is_nan());
    }

    proptest! {
        #[test]
        fn never_tensile(delta in -1e-5..1e-5_f64, rate in -10.0..10.0_f64) {
            prop_assert!(LAW.force(delta, rate) >= 0.0);
            prop_assert!((LAW.force(delta, rate) - LAW.linearised(delta, rate).force).abs() <= 1e-12);
        }

        #[test]
        fn derivatives_agree_with_differences(delta in 1e-7..1e-5_f64, rate in -0.6..3.0_f64) {
            let at = LAW.linearised(delta, rate);
            let (h, g) = (1e-4 * delta, 1e-4);
            let by_delta = (LAW.force(delta + h, rate) - LAW.force(delta - h, rate)) / (2.0 * h);
            let by_rate = (LAW.force(delta, rate + g) - LAW.force(delta, rate - g)) / (2.0 * g);
            prop_assert!((at.by_penetration / by_delta - 1.0).abs() < 1e-7);
            prop_assert!((at.by_rate / by_rate - 1.0).abs() < 1e-7);
            let by_energy = (LAW.energy(delta + h) - LAW.energy(delta - h)) / (2.0 * h);
            prop_assert!((LAW.force(delta, 0.0) / by_energy - 1.0).abs() < 1e-7);
        }
    }
}
