//! Prescribed shaft speed: piecewise linear in time, its angle integrated exactly.
//!
//! ```text
//! ω(t) = ω_k + α_k (t − t_k)       θ(t) = θ_k + (t − t_k) (ω_k + ω(t)) / 2       t_k ≤ t < t_{k+1}
//! ```
//!
//! Before the first and after the last knot the speed is constant. `θ(0) = 0` whatever the knots, so
//! that angles of a cage or an unbalance are those at time zero. Any sign of speed is allowed. The
//! acceleration jumps at a knot: there it is that of the interval to the right, and an integrator of high
//! order should end a step at `SpeedProfile::knot_times`.

use std::f64::consts::TAU;

use super::error::{BearingError, refused};
use super::rotation::{Piece, Rotation, RotationState};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shaft speed at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpeedKnot {
    /// In s.
    pub time: f64,
    /// Revolutions per second, positive from +x towards +y; negative turns clockwise.
    #[serde(rename = "hz")]
    pub frequency_hz: f64,
}

/// Piecewise linear speed over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedProfile {
    pub(crate) rotation: Rotation,
}

impl SpeedProfile {
    /// Builds the profile from knots in order of time.
    ///
    /// # Errors
    /// [`BearingError`] if the table is empty, an entry is not finite or times do not increase.
    pub fn new(knots: &[SpeedKnot]) -> Result<Self, BearingError> {
        if knots.is_empty() {
            return Err(BearingError("speed profile is empty: give at least one { time, hz }".to_owned()));
        }
        for (row, knot) in knots.iter().enumerate() {
            for (name, value) in [("time", knot.time), ("hz", knot.frequency_hz)] {
                if !value.is_finite() {
                    return refused(format_args!("speed profile row {row}: {name}"), value, "must be finite");
                }
            }
        }
        for (row, pair) in knots.windows(2).enumerate() {
            let [previous, next] = [pair[0].time, pair[1].time];
            if next <= previous {
                let row = row + 1;
                return Err(BearingError(format!(
                    "speed profile row {row}: time {next} s must be later than {previous} s in the row before"
                )));
            }
        }
        let piece = |(row, knot): (usize, &SpeedKnot)| {
            let rise = knots
                .get(row + 1)
                .map_or(0.0, |next| (next.frequency_hz - knot.frequency_hz) / (next.time - knot.time));
            let (speed, acceleration) = (TAU * knot.frequency_hz, TAU * rise);
            Piece { time: knot.time, speed, acceleration, ..Piece::default() }
        };
        Ok(Self { rotation: Rotation::new(knots.iter().enumerate().map(piece).collect(), 0.0) })
    }

    /// Constant speed (Hz).
    ///
    /// # Errors
    /// [`BearingError`] unless finite.
    pub fn constant(frequency_hz: f64) -> Result<Self, BearingError> {
        Self::new(&[SpeedKnot { time: 0.0, frequency_hz }])
    }

    /// Times (s) at which the acceleration jumps.
    pub(crate) fn knot_times(&self) -> impl Iterator<Item = f64> + '_ {
        self.rotation.knot_times()
    }

    /// Angular speed at `time` (s), rad/s.
    #[inline]
    pub fn speed(&self, time: f64) -> f64 {
        self.motion(time).speed
    }

    /// Largest magnitude of the angular speed from `start` to `end` (s), rad/s.
    pub(crate) fn fastest(&self, start: f64, end: f64) -> f64 {
        let knots = self.knot_times().filter(|&time| start < time && time < end);
        let times = knots.chain([start, end]);
        times.map(|time| self.speed(time).abs()).fold(0.0, f64::max)
    }

    /// Angle at `time` (s), rad, zero at time zero.
    #[inline]
    pub fn angle(&self, time: f64) -> f64 {
        self.motion(time).angle
    }

    /// All three at `time` (s); O(log n).
    #[inline]
    pub fn motion(&self, time: f64) -> RotationState {
        self.rotation.at(time)
    }
}

#[cfg(test)]
#[path = "speed_tests.rs"]
mod tests;
