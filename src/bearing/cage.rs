//! The cage: where the balls are when the shaft has turned.
//!
//! ```text
//! ω_c = (ω_s / 2)(1 − D_b / D_p)(1 − s)        θ_j = θ_0 + ∫ ω_c dt + 2 π j / N_b
//! ```
//!
//! Speed and slip are piecewise linear in time, their product is quadratic, and the cage's angle is integrated exactly.
//!
//! How much slower than by pure rolling the cage turns: constant, over time, or over speed.

use super::error::{BearingError, refused};
use super::geometry::BearingGeometry;
use super::speed::{Piece, Rotation, RotationState, SpeedProfile};
use std::f64::consts::TAU;

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
        Self::rolling(bearing.orders().cage, bearing.balls(), shaft, slip, first_ball_angle)
    }

    /// The same of so many `balls` that without slip turn `rolling_ratio` times in a turn of the shaft.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub(crate) fn rolling(
        rolling_ratio: f64,
        balls: u32,
        shaft: SpeedProfile,
        slip: SlipProfile,
        first_ball_angle: f64,
    ) -> Result<Self, BearingError> {
        if !first_ball_angle.is_finite() {
            return Err(BearingError(format!("first ball angle {first_ball_angle} rad must be finite")));
        }
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
            spacing: TAU / f64::from(balls),
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

/// What a slip profile runs over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Over {
    /// Time, s.
    Time,
    /// Magnitude of the shaft's speed, rad/s.
    Speed,
}

/// Slip `s` of the cage, 0 (pure rolling) to 1 (cage at rest): piecewise linear, constant beyond its ends.
#[derive(Debug, Clone, PartialEq)]
pub struct SlipProfile {
    over: Over,
    /// Place and slip, places ascending, at least one.
    points: Vec<(f64, f64)>,
}

impl SlipProfile {
    /// The same slip always.
    ///
    /// # Errors
    /// [`BearingError`] for slip out of range.
    pub fn constant(slip: f64) -> Result<Self, BearingError> {
        Self::over_time(&[(0.0, slip)])
    }

    /// Slip over time: (s, slip), times ascending.
    ///
    /// # Errors
    /// [`BearingError`] naming the row.
    pub(crate) fn over_time(points: &[(f64, f64)]) -> Result<Self, BearingError> {
        check(points, "time", f64::NEG_INFINITY, "must be finite")?;
        Ok(Self { over: Over::Time, points: points.to_vec() })
    }

    /// Slip over the magnitude of the shaft's frequency: (Hz, slip), frequencies zero or more, ascending.
    ///
    /// # Errors
    /// [`BearingError`] naming the row.
    pub(crate) fn over_speed(points: &[(f64, f64)]) -> Result<Self, BearingError> {
        check(points, "hz", 0.0, "must be finite and zero or more")?;
        Ok(Self { over: Over::Speed, points: points.iter().map(|&(hz, slip)| (TAU * hz, slip)).collect() })
    }

    /// Smallest and largest slip of the table.
    pub(crate) fn range(&self) -> [f64; 2] {
        let slips = self.points.iter().map(|point| point.1);
        slips.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], slip| [low.min(slip), high.max(slip)])
    }

    /// Slip at a `time` (s) when the shaft turns at `speed` (rad/s).
    pub(crate) fn at(&self, time: f64, speed: f64) -> f64 {
        let place = match self.over {
            Over::Time => time,
            Over::Speed => speed.abs(),
        };
        let after = self.points.partition_point(|point| point.0 <= place);
        match (after.checked_sub(1), self.points.get(after)) {
            (Some(before), Some(&(end, last))) => {
                let (start, first) = self.points[before];
                first + (last - first) * (place - start) / (end - start)
            }
            (Some(before), None) => self.points[before].1,
            (None, Some(first)) => first.1,
            (None, None) => 0.0,
        }
    }

    /// Times (s) between which slip is linear in time, for a shaft that follows `speed`: ascending, with its knots.
    pub(super) fn knot_times(&self, speed: &SpeedProfile) -> Vec<f64> {
        let mut times: Vec<f64> = speed.knot_times().collect();
        match self.over {
            Over::Time => times.extend(self.points.iter().map(|point| point.0)),
            Over::Speed => {
                let knots = times.clone();
                for pair in knots.windows(2) {
                    times.extend(self.crossings(speed, pair[0], pair[1]));
                }
            }
        }
        times.sort_by(f64::total_cmp);
        // crossings that differ by round-off are one
        times.dedup_by(|next, before| *next - *before <= 1e-12 * (1.0 + before.abs()));
        times
    }

    /// Times inside an interval of linear speed at which the magnitude of the speed passes a point of the table, or zero.
    fn crossings(&self, speed: &SpeedProfile, start: f64, end: f64) -> Vec<f64> {
        let at_start = speed.motion(start);
        let passed = self.points.iter().flat_map(|&(place, _)| [-place, place]);
        let time = |value: f64| start + (value - at_start.speed) / at_start.acceleration;
        // without acceleration nothing is passed: the time is not finite, and not inside
        let inside = |time: &f64| *time > start && *time < end;
        passed.chain([0.0]).map(time).filter(inside).collect()
    }
}

fn check(points: &[(f64, f64)], name: &str, least: f64, rule: &str) -> Result<(), BearingError> {
    if points.is_empty() {
        return Err(BearingError("slip profile is empty: give at least one point".to_owned()));
    }
    for (row, &(value, slip)) in points.iter().enumerate() {
        if !(value.is_finite() && value >= least) {
            return refused(format_args!("slip profile row {row}: {name}"), value, rule);
        }
        if !(0.0..=1.0).contains(&slip) {
            return refused("slip", slip, "must be 0 (pure rolling) to 1 (cage at rest)");
        }
    }
    for (row, pair) in points.windows(2).enumerate() {
        let [(previous, _), (value, _)] = [pair[0], pair[1]];
        if value <= previous {
            let row = row + 1;
            return Err(BearingError(format!(
                "slip profile row {row}: {name} {value} must be above {previous} in the row before"
            )));
        }
    }
    Ok(())
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

#[cfg(test)]
mod slip_tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn straight_between_points_and_constant_beyond() {
        let slip = SlipProfile::over_speed(&[(10.0, 0.4), (20.0, 0.0)]).unwrap();
        for (hz, expected) in [(0.0, 0.4), (10.0, 0.4), (-15.0, 0.2), (20.0, 0.0), (99.0, 0.0)] {
            assert_relative_eq!(slip.at(7.0, TAU * hz), expected, epsilon = 1e-15);
        }
        let slip = SlipProfile::over_time(&[(-1.0, 0.1), (1.0, 0.3)]).unwrap();
        assert_relative_eq!(slip.at(0.0, 5.0), 0.2, epsilon = 1e-15);
        assert_relative_eq!(slip.range()[1], 0.3);
    }

    #[test]
    fn each_rule_names_its_row() {
        let message = |error: BearingError| error.to_string();
        let error = SlipProfile::constant(-0.1).unwrap_err();
        assert_eq!(message(error), "slip = -0.1 must be 0 (pure rolling) to 1 (cage at rest)");
        let error = SlipProfile::over_speed(&[(0.0, 0.1), (-2.0, 0.1)]).unwrap_err();
        assert_eq!(message(error), "slip profile row 1: hz = -2 must be finite and zero or more");
        let error = SlipProfile::over_time(&[(1.0, 0.1), (1.0, 0.1)]).unwrap_err();
        assert_eq!(message(error), "slip profile row 1: time 1 must be above 1 in the row before");
        let error = SlipProfile::over_time(&[]).unwrap_err();
        assert_eq!(message(error), "slip profile is empty: give at least one point");
        assert!(SlipProfile::constant(f64::NAN).is_err());
    }
}
