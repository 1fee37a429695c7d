//! Waviness of a race: its deviation from a circle by orders.
//!
//! ```text
//! R(φ) = R + h(φ)        h(φ) = Σ a cos(n φ + p)
//! ```
//!
//! Physical sense: what makes a sound bearing heard. Waves are long beside the patch of a contact, so that a ball follows
//! them with one contact and the stiffness of the undamaged race.

use super::error::{BearingError, refused};
use super::geometry::BearingGeometry;
use super::materials::Race;

/// Largest curvature of a wave in units of the relative curvature of ball and race: the contact's stiffness then changes by
/// less than a hundredth, and a ball touches in one place.
const CURVATURE_LIMIT: f64 = 0.05;

/// One wave round a race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// The race.
    pub race: Race,
    /// Waves in one turn, 1 or more.
    pub order: u32,
    /// Radial amplitude a, m, zero or more.
    pub amplitude: f64,
    /// Phase p, rad: of the cosine at angle zero in the race's own frame.
    pub phase: f64,
}

impl Wave {
    /// Checks the wave against the bearing.
    ///
    /// # Errors
    /// [`BearingError`] names the value out of range.
    pub(crate) fn checked(self, bearing: &BearingGeometry) -> Result<Self, BearingError> {
        if self.order == 0 {
            return refused("order", 0.0, "must be at least 1");
        }
        if !(self.amplitude.is_finite() && self.amplitude >= 0.0) {
            return refused("amplitude", self.amplitude, "must be finite and not below 0");
        }
        if !self.phase.is_finite() {
            return refused("phase_deg", self.phase.to_degrees(), "must be finite");
        }
        let (race, radius) = match self.race {
            Race::Inner => (bearing.inner_curvatures(), bearing.effective_inner_race_radius()),
            Race::Outer => (bearing.outer_curvatures(), bearing.outer_race_radius()),
        };
        let relative = bearing.ball_curvatures().plane_2 + race.plane_2;
        let limit = CURVATURE_LIMIT * relative;
        let curvature = self.amplitude * (f64::from(self.order) / radius).powi(2);
        if curvature > limit {
            let Self { order, amplitude, .. } = self;
            return Err(BearingError(format!(
                "order {order} with amplitude {amplitude} m has a curvature of {curvature:.3e} 1/m, more than \
                 {limit:.3e}: take a lower order or amplitude, or a measured profile"
            )));
        }
        Ok(self)
    }
}

/// All waves of one race.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Waviness {
    waves: Vec<Wave>,
}

impl Waviness {
    /// Those of `waves` that are on `race`.
    pub(crate) fn of(race: Race, waves: &[Wave]) -> Self {
        let own = waves.iter().filter(|wave| wave.race == race && wave.amplitude > 0.0);
        Self { waves: own.copied().collect() }
    }

    /// Whether there is none.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.waves.is_empty()
    }

    /// Largest deviation that is possible, m.
    pub(crate) fn most(&self) -> f64 {
        self.waves.iter().map(|wave| wave.amplitude).sum()
    }

    /// Deviation h at `angle` (rad, in the race's own frame), m, and its first two derivatives, m/rad and m/rad²; outwards
    /// positive.
    #[inline]
    pub(crate) fn at(&self, angle: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for wave in &self.waves {
            let order = f64::from(wave.order);
            let (sin, cos) = (order * angle + wave.phase).sin_cos();
            sum[0] += wave.amplitude * cos;
            sum[1] -= wave.amplitude * order * sin;
            sum[2] -= wave.amplitude * order * order * cos;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::samples::source_bearing;
    use approx::assert_relative_eq;

    fn wave(race: Race, order: u32, amplitude: f64, phase: f64) -> Wave {
        Wave { race, order, amplitude, phase }
    }

    #[test]
    fn derivatives_are_those_of_the_height() {
        let waves =
            [wave(Race::Outer, 3, 1e-6, 0.4), wave(Race::Inner, 5, 9e-6, 0.0), wave(Race::Outer, 17, 2e-7, -1.0)];
        let waviness = Waviness::of(Race::Outer, &waves);
        assert_relative_eq!(waviness.most(), 1.2e-6, max_relative = 1e-14);
        let (angle, step) = (2.3, 1e-4);
        let [[before, slope_before, _], [height, slope, bend], [after, slope_after, _]] =
            [angle - step, angle, angle + step].map(|angle| waviness.at(angle));
        let expected = 1e-6 * (3.0 * angle + 0.4_f64).cos() + 2e-7 * (17.0 * angle - 1.0_f64).cos();
        assert_relative_eq!(height, expected, max_relative = 1e-13);
        // differences: error (17 step)^2 / 6
        assert_relative_eq!((after - before) / (2.0 * step), slope, max_relative = 1e-5);
        let change = (slope_after - slope_before) / (2.0 * step);
        assert_relative_eq!(change, bend, max_relative = 1e-5);
        assert!(Waviness::of(Race::Inner, &waves[..1]).is_empty());
    }

    #[test]
    fn each_rule_fires_with_its_message() {
        let bearing = source_bearing();
        let message = |wave: Wave| wave.checked(&bearing).unwrap_err().to_string();
        assert_eq!(message(wave(Race::Outer, 0, 1e-6, 0.0)), "order = 0 must be at least 1");
        assert_eq!(message(wave(Race::Outer, 2, -1e-6, 0.0)), "amplitude = -0.000001 must be finite and not below 0");
        let steep = message(wave(Race::Outer, 100, 1e-6, 0.0));
        assert!(steep.contains("more than 3.949e1"), "{steep}");
        assert!(wave(Race::Outer, 20, 1e-6, 0.0).checked(&bearing).is_ok());
        assert!(wave(Race::Inner, 2, f64::NAN, 0.0).checked(&bearing).is_err());
        assert!(wave(Race::Inner, 2, 0.0, f64::NAN).checked(&bearing).is_err());
    }
}
