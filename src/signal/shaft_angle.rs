//! The angle that a shaft has turned through, from its speed.

use crate::numerics::Brief;
use serde::Serialize;

use super::SignalError;
use crate::numerics::series::TimeWindow;

/// Speed of a shaft at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpeedPoint {
    /// Instant, s.
    pub time_s: f64,
    /// Speed, Hz (turns a second), > 0.
    pub speed_hz: f64,
}

/// Angle of a shaft over time, in turns from the first instant that its speed is known at; it turns one way.
#[derive(Debug, Clone, PartialEq)]
pub struct ShaftAngle {
    points: Vec<SpeedPoint>,
    turns: Vec<f64>,
}

impl ShaftAngle {
    /// Angle for a speed that is linear between points, two at least, in order of time: integrated exactly.
    ///
    /// # Errors
    /// [`SignalError`] for instants too few or out of order, and for a speed that is not positive.
    pub fn from_points(points: Vec<SpeedPoint>) -> Result<Self, SignalError> {
        let is_ordered = points.windows(2).all(|p| p[0].time_s < p[1].time_s);
        if points.len() < 2 || !is_ordered || points.iter().any(|p| !p.time_s.is_finite()) {
            let points = points.len();
            return Err(SignalError(format!(
                "speed must be known at two instants at least, finite and in order of time, found {points} instants"
            )));
        }
        let is_speed = |p: &&SpeedPoint| !(p.speed_hz.is_finite() && p.speed_hz > 0.0);
        if let Some(point) = points.iter().find(is_speed) {
            let [time_s, speed_hz] = [point.time_s, point.speed_hz].map(Brief);
            return Err(SignalError(format!(
                "shaft speed must be positive throughout, found {speed_hz} Hz at {time_s} s: take a stretch in which the \
                 shaft turns one way"
            )));
        }
        let mut turns = vec![0.0];
        let mut angle = 0.0;
        for pair in points.windows(2) {
            angle += 0.5 * (pair[0].speed_hz + pair[1].speed_hz) * (pair[1].time_s - pair[0].time_s);
            turns.push(angle);
        }
        Ok(Self { points, turns })
    }

    /// Angle at the last known instant, turns.
    pub fn turns(&self) -> f64 {
        self.turns.last().copied().unwrap_or(0.0)
    }

    /// Window of time in which the speed is known.
    pub fn window(&self) -> TimeWindow {
        let at = |point: Option<&SpeedPoint>| point.map_or(0.0, |p| p.time_s);
        TimeWindow { from: at(self.points.first()), to: at(self.points.last()) }
    }

    /// Angle (turns) and speed (Hz) at an instant; outside the window by the speed at its end.
    pub fn at(&self, time_s: f64) -> (f64, f64) {
        let after = self.points.partition_point(|p| p.time_s <= time_s);
        let index = after.clamp(1, self.points.len() - 1) - 1;
        let (from, to) = (self.points[index], self.points[index + 1]);
        let length = to.time_s - from.time_s;
        let part = (time_s - from.time_s) / length;
        if part < 0.0 {
            return (from.speed_hz * (time_s - from.time_s), from.speed_hz);
        }
        if part > 1.0 {
            let turns = self.turns() + to.speed_hz * (time_s - to.time_s);
            return (turns, to.speed_hz);
        }
        // cubic with the angle and the speed at both ends; a parabola where the speed is linear
        let (a, b) = (from.speed_hz * length, to.speed_hz * length);
        let rise = self.turns[index + 1] - self.turns[index];
        let (c2, c3) = (3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise);
        let turns = self.turns[index] + part * (a + part * (c2 + part * c3));
        let speed = (a + part * (2.0 * c2 + 3.0 * part * c3)) / length;
        (turns, speed)
    }

    /// The instant at which the shaft has turned so far, s: Newton's method kept between the points around.
    pub fn time_at(&self, turns: f64) -> f64 {
        let after = self.turns.partition_point(|t| *t <= turns);
        let index = after.clamp(1, self.turns.len() - 1) - 1;
        let (from, to) = (self.points[index], self.points[index + 1]);
        if turns < 0.0 {
            return from.time_s + turns / from.speed_hz;
        }
        if turns > self.turns() {
            return to.time_s + (turns - self.turns()) / to.speed_hz;
        }
        let (mut low, mut high) = (from.time_s, to.time_s);
        let mut time = 0.5 * (low + high);
        for _ in 0..60 {
            let (found, speed) = self.at(time);
            if found < turns {
                low = time;
            } else {
                high = time;
            }
            let newton = time + (turns - found) / speed;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - time).abs() <= f64::EPSILON * next.abs() {
                return next;
            }
            time = next;
        }
        time
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(pairs: &[(f64, f64)]) -> Vec<SpeedPoint> {
        let point = |&(time_s, speed_hz): &(f64, f64)| SpeedPoint { time_s, speed_hz };
        pairs.iter().map(point).collect()
    }

    #[test]
    fn a_linear_speed_is_integrated_exactly_and_back() {
        let angle = ShaftAngle::from_points(points(&[(1.0, 10.0), (3.0, 20.0), (4.0, 20.0)]));
        let angle = angle.expect("a valid speed");
        assert!((angle.turns() - 50.0).abs() < 1e-12);
        // 10 (t - 1) + 2.5 (t - 1)^2
        let (turns, speed) = angle.at(2.5);
        assert!((turns - 20.625).abs() < 1e-12 && (speed - 17.5).abs() < 1e-12);
        for turns in [-3.0, 0.0, 0.1, 20.625, 30.0, 41.7, 50.0, 57.0] {
            assert!((angle.at(angle.time_at(turns)).0 - turns).abs() < 1e-11, "{turns}");
        }
        assert!((angle.time_at(20.625) - 2.5).abs() < 1e-14);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |pairs: &[(f64, f64)]| ShaftAngle::from_points(points(pairs)).expect_err("must fail").to_string();
        let order = "speed must be known at two instants at least, finite and in order of time";
        assert_eq!(message(&[(0.0, 1.0)]), format!("{order}, found 1 instants"));
        assert!(message(&[(0.0, 1.0), (0.0, 1.0)]).starts_with(order));
        assert!(message(&[(f64::NEG_INFINITY, 1.0), (0.0, 1.0)]).starts_with(order));
        assert_eq!(
            message(&[(0.0, 1.0), (2.0, 0.0)]),
            "shaft speed must be positive throughout, found 0 Hz at 2 s: take a stretch in which the shaft turns one way"
        );
    }
}
