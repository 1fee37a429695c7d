//! The cage: where the balls are when the shaft has turned.
//!
//! ```text
//! ω_c = (ω_s / 2)(1 − D_b / D_p)(1 − s)        θ_j = θ_0 + ∫ ω_c dt + 2 π j / N_b
//! ```
//!
//! Speed and slip are piecewise linear in time, their product is quadratic, and the cage's angle is integrated exactly.

use std::f64::consts::TAU;

use super::error::BearingError;
use super::geometry::BearingGeometry;
use super::rotation::{Piece, Rotation, RotationState};
use super::slip::SlipProfile;
use super::speed::SpeedProfile;

/// A rigid cage that carries the balls at equal angles, driven by the shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct Cage {
    /// Cage turns per shaft turn without slip.
    rolling_ratio: f64,
    shaft: SpeedProfile,
    pub(crate) slip: SlipProfile,
    /// Angle between neighbouring balls, rad.
    pub(crate) spacing: f64,
    /// Of ball 0.
    pub(crate) rotation: Rotation,
}

impl Cage {
    /// Cage of `bearing` under a `shaft` of that speed, with `slip`; ball 0 is at `first_ball_angle` (rad, from x,
    /// counter-clockwise) at time zero.
    ///
    /// # Errors
    /// [`BearingError`] names the value out of range.
    pub fn new(
        bearing: &BearingGeometry,
        shaft: SpeedProfile,
        slip: SlipProfile,
        first_ball_angle: f64,
    ) -> Result<Self, BearingError> {
        if !first_ball_angle.is_finite() {
            return Err(BearingError(format!("first ball angle {first_ball_angle} rad must be finite")));
        }
        let rolling_ratio = bearing.orders().cage;
        let times = slip.knot_times(&shaft);
        let piece = |place: usize| {
            let time = times[place];
            let driving = shaft.motion(time);
            let start = slip.at(time, driving.speed);
            let slope = times.get(place + 1).map_or(0.0, |&next| {
                let end = slip.at(next, shaft.speed(next));
                (end - start) / (next - time)
            });
            Piece {
                time,
                speed: rolling_ratio * driving.speed * (1.0 - start),
                acceleration: rolling_ratio * (driving.acceleration * (1.0 - start) - driving.speed * slope),
                jerk: -2.0 * rolling_ratio * driving.acceleration * slope,
                ..Piece::default()
            }
        };
        let pieces = (0..times.len()).map(piece).collect();
        Ok(Self {
            rolling_ratio,
            spacing: TAU / f64::from(bearing.balls()),
            rotation: Rotation::new(pieces, first_ball_angle),
            shaft,
            slip,
        })
    }

    /// Speed of the shaft that drives it.
    pub fn shaft(&self) -> &SpeedProfile {
        &self.shaft
    }

    /// Cage turns per shaft turn between two times (s); without slip where the shaft does not turn.
    pub(crate) fn ratio_between(&self, from: f64, to: f64) -> f64 {
        let shaft = self.shaft.angle(to) - self.shaft.angle(from);
        let ratio = (self.rotation.at(to).angle - self.rotation.at(from).angle) / shaft;
        if ratio.is_finite() { ratio } else { self.rolling_ratio }
    }

    /// Motion at `time` (s); the angle is that of ball 0 (not reduced to one turn).
    #[inline]
    pub fn motion(&self, time: f64) -> RotationState {
        self.rotation.at(time)
    }

    /// Angle of `ball` (counted counter-clockwise from ball 0), rad, not reduced, from the cage angle.
    #[inline]
    pub fn ball_angle(&self, cage_angle: f64, ball: u32) -> f64 {
        cage_angle + self.spacing * f64::from(ball)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::SpeedKnot;
    use crate::bearing::samples::source_bearing;
    use approx::assert_relative_eq;

    const RATIO: f64 = 0.5 * (1.0 - 2e-3 / 7.5105e-3);

    /// Up, past standstill to the other side, and constant.
    fn varied() -> SpeedProfile {
        let knots = [(-0.5, 0.0), (0.5, 30.0), (1.5, -20.0), (2.0, -20.0)];
        let knots = knots.map(|(time, frequency_hz)| SpeedKnot { time, frequency_hz });
        SpeedProfile::new(&knots).unwrap()
    }

    #[test]
    fn pure_rolling_follows_the_cage_order() {
        let speed = varied();
        let slip = SlipProfile::constant(0.0).unwrap();
        let cage = Cage::new(&source_bearing(), speed.clone(), slip, 1.0).unwrap();
        for time in [-2.0, -0.1, 0.0, 0.7, 1.4, 3.0] {
            let (motion, shaft) = (cage.motion(time), speed.motion(time));
            assert_relative_eq!(motion.angle, 1.0 + RATIO * shaft.angle, max_relative = 1e-13);
            assert_relative_eq!(motion.speed, RATIO * shaft.speed, epsilon = 1e-12);
            assert_relative_eq!(motion.acceleration, RATIO * shaft.acceleration, epsilon = 1e-12);
        }
        assert_relative_eq!(cage.ball_angle(0.5, 7), 0.5 + TAU, max_relative = 1e-14);
    }

    /// The angle against Gauss integration of the speed, piece by piece between all knots; the speed against its definition.
    #[test]
    fn slip_over_time_and_over_speed_is_integrated_exactly() {
        let speed = varied();
        for slip in [
            SlipProfile::constant(0.25).unwrap(),
            SlipProfile::over_time(&[(0.0, 0.3), (0.9, 0.0), (1.1, 0.2)]).unwrap(),
            SlipProfile::over_speed(&[(5.0, 0.5), (12.0, 0.1), (25.0, 0.0)]).unwrap(),
        ] {
            let cage = Cage::new(&source_bearing(), speed.clone(), slip.clone(), -0.4).unwrap();
            let defined = |time: f64| {
                let shaft = speed.speed(time);
                RATIO * shaft * (1.0 - slip.at(time, shaft))
            };
            let mut angle = -0.4;
            let mut from = 0.0;
            let mut knots = slip.knot_times(&speed);
            knots.push(2.5);
            for &to in knots.iter().filter(|&&time| time > 0.0) {
                // two points are exact for cubics, the speed is a square
                let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
                let node = half / 3.0_f64.sqrt();
                angle += half * (defined(middle - node) + defined(middle + node));
                assert_relative_eq!(cage.motion(to).angle, angle, max_relative = 1e-12);
                assert_relative_eq!(cage.motion(middle).speed, defined(middle), max_relative = 1e-11);
                let step = 1e-4 * half;
                let rate = (defined(middle + step) - defined(middle - step)) / (2.0 * step);
                // a difference over 1e-4 of the piece
                assert_relative_eq!(cage.motion(middle).acceleration, rate, epsilon = 1e-7 * rate.abs().max(1.0));
                from = to;
            }
            assert_relative_eq!(cage.motion(0.0).angle, -0.4, epsilon = 1e-14);
        }
    }

    #[test]
    fn the_mean_ratio_counts_slip() {
        let speed = SpeedProfile::constant(20.0).unwrap();
        let slip = SlipProfile::over_time(&[(0.0, 0.0), (1.0, 0.2)]).unwrap();
        let cage = Cage::new(&source_bearing(), speed, slip.clone(), 0.0).unwrap();
        assert_relative_eq!(cage.ratio_between(0.0, 1.0), 0.9 * RATIO, max_relative = 1e-13);
        let still = SpeedProfile::constant(0.0).unwrap();
        let cage = Cage::new(&source_bearing(), still, slip, 0.0).unwrap();
        assert_relative_eq!(cage.ratio_between(0.0, 1.0), RATIO);
    }

    #[test]
    fn a_first_ball_nowhere_is_refused() {
        let (speed, slip) = (varied(), SlipProfile::constant(0.0).unwrap());
        let error = Cage::new(&source_bearing(), speed, slip, f64::INFINITY).unwrap_err();
        assert_eq!(error.to_string(), "first ball angle inf rad must be finite");
    }
}
