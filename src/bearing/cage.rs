//! The cage: where the balls are when the shaft has turned.
//!
//! ```text
//! ω_c = (ω_s / 2)(1 − D_b / D_p)(1 − s)        θ_j = θ_0 + (ω_c / ω_s) θ_s + 2 π j / N_b
//! ```
//!
//! Slip `s` is constant here: 0 is pure rolling, 1 a cage at rest (the paper's assumptions 4 and 5).

use std::f64::consts::TAU;

use thiserror::Error;

use super::geometry::BearingGeometry;
use crate::bearing::speed::ShaftMotion;

/// Why a cage cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CageError {
    /// Slip outside its range.
    #[error("slip = {slip} must be 0 (pure rolling) to 1 (cage at rest)")]
    Slip {
        /// Slip that was given.
        slip: f64,
    },
    /// The first ball's angle is not a number.
    #[error("first ball angle {angle} rad must be finite")]
    FirstBall {
        /// Angle that was given, rad.
        angle: f64,
    },
}

/// A rigid cage that carries the balls at equal angles, geared to the shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cage {
    ratio: f64,
    first_ball_angle: f64,
    spacing: f64,
}

impl Cage {
    /// Cage of `bearing` with constant `slip` (0 to 1) whose ball 0 is at `first_ball_angle` (rad, from x,
    /// counter-clockwise) when the shaft's angle is zero.
    ///
    /// # Errors
    /// [`CageError`] names the value out of range.
    pub fn new(
        bearing: &BearingGeometry,
        slip: f64,
        first_ball_angle: f64,
    ) -> Result<Self, CageError> {
        if !(0.0..=1.0).contains(&slip) {
            return Err(CageError::Slip { slip });
        }
        if !first_ball_angle.is_finite() {
            return Err(CageError::FirstBall {
                angle: first_ball_angle,
            });
        }
        Ok(Self {
            ratio: bearing.orders().cage * (1.0 - slip),
            first_ball_angle,
            spacing: TAU / f64::from(bearing.balls()),
        })
    }

    /// Cage turns per shaft turn, 0 to 1/2.
    #[must_use]
    #[inline]
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Angle between neighbouring balls, rad.
    #[must_use]
    #[inline]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Cage motion that belongs to a shaft motion; the angle is that of ball 0 (not reduced to one turn).
    #[must_use]
    #[inline]
    pub fn motion(&self, shaft: ShaftMotion) -> ShaftMotion {
        ShaftMotion {
            angle: self.first_ball_angle + self.ratio * shaft.angle,
            speed: self.ratio * shaft.speed,
            acceleration: self.ratio * shaft.acceleration,
        }
    }

    /// Angle of `ball` (counted counter-clockwise from ball 0), rad, not reduced, from the cage angle.
    #[must_use]
    #[inline]
    pub fn ball_angle(&self, cage_angle: f64, ball: u32) -> f64 {
        cage_angle + self.spacing * f64::from(ball)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::samples::source_bearing;
    use approx::assert_relative_eq;

    const SHAFT: ShaftMotion = ShaftMotion {
        angle: 10.0,
        speed: -4.0,
        acceleration: 2.0,
    };

    #[test]
    fn pure_rolling_follows_the_cage_order() {
        let cage = Cage::new(&source_bearing(), 0.0, 1.0).unwrap();
        let ratio = 0.5 * (1.0 - 2e-3 / 7.5105e-3);
        let motion = cage.motion(SHAFT);
        assert_relative_eq!(motion.angle, 1.0 + 10.0 * ratio, max_relative = 1e-14);
        assert_relative_eq!(motion.speed, -4.0 * ratio, max_relative = 1e-14);
        assert_relative_eq!(motion.acceleration, 2.0 * ratio, max_relative = 1e-14);
        assert_relative_eq!(cage.ball_angle(0.5, 7), 0.5 + TAU, max_relative = 1e-14);
    }

    #[test]
    fn slip_slows_the_cage_in_proportion() {
        let rolling = Cage::new(&source_bearing(), 0.0, 0.0).unwrap();
        let slipping = Cage::new(&source_bearing(), 0.25, 0.0).unwrap();
        assert_relative_eq!(
            slipping.ratio(),
            0.75 * rolling.ratio(),
            max_relative = 1e-15
        );
    }

    #[test]
    fn values_out_of_range_are_refused() {
        let error = Cage::new(&source_bearing(), -0.1, 0.0).unwrap_err();
        assert_eq!(
            error.to_string(),
            "slip = -0.1 must be 0 (pure rolling) to 1 (cage at rest)"
        );
        assert!(Cage::new(&source_bearing(), f64::NAN, 0.0).is_err());
        let error = Cage::new(&source_bearing(), 0.0, f64::INFINITY).unwrap_err();
        assert_eq!(error.to_string(), "first ball angle inf rad must be finite");
    }
}
