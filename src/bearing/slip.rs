//! How much slower than by pure rolling the cage turns: constant, over time, or over speed.

use super::error::{BearingError, refused};
use super::speed::SpeedProfile;
use std::f64::consts::TAU;

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
