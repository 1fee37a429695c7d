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
//!
//! Rotation with piecewise polynomial speed: angle, speed and acceleration at any time, without integration error.
//!
//! ```text
//! ω(t) = ω_k + α_k (t − t_k) + j_k (t − t_k)² / 2        t_k ≤ t < t_{k+1}
//! θ(t) = θ_k + ω_k (t − t_k) + α_k (t − t_k)² / 2 + j_k (t − t_k)³ / 6
//! ```
//!
//! Before the first and after the last knot the speed is constant. The acceleration may jump at a knot: there it is that of
//! the piece to the right.

use super::error::{BearingError, refused};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{Deserializer, Error, Unexpected};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::f64::consts::TAU;

/// Shaft speed at a time. A file gives it by `hz` or by `rpm`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpeedKnot {
    /// In s.
    pub time: f64,
    /// Revolutions per second, positive from +x towards +y; negative turns clockwise.
    #[serde(rename = "hz")]
    pub frequency_hz: f64,
}

/// Shaft speed at a time: exactly one of `hz` and `rpm`, positive from +x towards +y; negative turns clockwise.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = serde_json::json!([{ "required": ["hz"] }, { "required": ["rpm"] }])))]
struct SpeedKnotForm {
    /// In s.
    time: f64,
    /// Revolutions per second.
    hz: Option<f64>,
    /// Revolutions per minute.
    rpm: Option<f64>,
}

impl<'de> Deserialize<'de> for SpeedKnot {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let SpeedKnotForm { time, hz, rpm } = SpeedKnotForm::deserialize(from)?;
        let wrong = |found| Err(D::Error::invalid_value(Unexpected::Other(found), &"exactly one of `hz`, `rpm`"));
        match (hz, rpm) {
            (Some(frequency_hz), None) => Ok(Self { time, frequency_hz }),
            (None, Some(rpm)) => Ok(Self { time, frequency_hz: rpm / 60.0 }),
            (None, None) => wrong("none of them"),
            (Some(_), Some(_)) => wrong("both"),
        }
    }
}

impl JsonSchema for SpeedKnot {
    fn schema_name() -> Cow<'static, str> {
        "SpeedKnot".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        SpeedKnotForm::json_schema(generator)
    }
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
        self.speed(self.fastest_instant(start, end)).abs()
    }

    /// The first instant of that speed, s: `start`, a knot or `end`.
    pub(crate) fn fastest_instant(&self, start: f64, end: f64) -> f64 {
        let knots = self.knot_times().filter(|&time| start < time && time < end);
        let speed = |time: f64| self.speed(time).abs();
        knots.chain([end]).fold(start, |best, time| if speed(time) > speed(best) { time } else { best })
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

/// Angle and its derivatives at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotationState {
    /// Angle, rad, not reduced to one turn.
    pub angle: f64,
    /// Angular speed, rad/s.
    pub speed: f64,
    /// Angular acceleration, rad/s².
    pub acceleration: f64,
}

/// Remembers the piece of the last call: successive times cost no search.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RotationCursor {
    piece: usize,
}

/// A polynomial from a knot on.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Piece {
    /// Time of the knot, s.
    pub time: f64,
    /// Angle there, rad; [`Rotation::new`] sets it.
    pub angle: f64,
    /// Angular speed there, rad/s.
    pub speed: f64,
    /// Angular acceleration there, rad/s².
    pub acceleration: f64,
    /// Its rate, rad/s³, constant.
    pub jerk: f64,
}

impl Piece {
    #[inline]
    fn at(&self, time: f64) -> RotationState {
        let dt = time - self.time;
        let acceleration = self.acceleration + self.jerk * dt;
        let gained = dt * (self.acceleration + 0.5 * self.jerk * dt);
        let gained_mean = dt * (0.5 * self.acceleration + self.jerk * dt * (1.0 / 6.0));
        RotationState { angle: self.angle + dt * (self.speed + gained_mean), speed: self.speed + gained, acceleration }
    }
}

/// A rotation over all time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rotation {
    /// Constant speed before the first knot; its reference time is the first knot's.
    before: Piece,
    /// One piece a knot.
    pieces: Vec<Piece>,
}

impl Rotation {
    /// A rotation by `angle_at_zero` (rad) at time zero from `pieces`, at least one, times ascending; the first one's speed
    /// holds before it.
    pub(super) fn new(mut pieces: Vec<Piece>, angle_at_zero: f64) -> Self {
        let first = pieces.first().copied().unwrap_or_default();
        let before = Piece { time: first.time, speed: first.speed, ..Piece::default() };
        for next in 1..pieces.len() {
            pieces[next].angle = pieces[next - 1].at(pieces[next].time).angle;
        }
        let mut rotation = Self { before, pieces };
        let shift = angle_at_zero - rotation.at(0.0).angle;
        rotation.before.angle += shift;
        for piece in &mut rotation.pieces {
            piece.angle += shift;
        }
        rotation
    }

    /// Times (s) of the knots.
    pub(super) fn knot_times(&self) -> impl Iterator<Item = f64> + '_ {
        self.pieces.iter().map(|piece| piece.time)
    }

    /// The first knot after `time` (s), s; infinity if there is none. O(log n).
    pub(crate) fn next_knot(&self, time: f64) -> f64 {
        let started = self.pieces.partition_point(|piece| piece.time <= time);
        self.pieces.get(started).map_or(f64::INFINITY, |piece| piece.time)
    }

    /// State at `time` (s); O(log n).
    #[inline]
    pub(super) fn at(&self, time: f64) -> RotationState {
        let started = self.pieces.partition_point(|piece| piece.time <= time);
        self.piece(started).at(time)
    }

    /// State at `time` (s), searching from where `cursor` was left: constant cost for times that move in small steps,
    /// either way.
    #[inline]
    pub(crate) fn at_from(&self, cursor: &mut RotationCursor, time: f64) -> RotationState {
        let mut started = cursor.piece.min(self.pieces.len());
        while started < self.pieces.len() && self.pieces[started].time <= time {
            started += 1;
        }
        while started > 0 && self.pieces[started - 1].time > time {
            started -= 1;
        }
        cursor.piece = started;
        self.piece(started).at(time)
    }

    /// The piece in force once `started` knots have passed.
    #[inline]
    fn piece(&self, started: usize) -> &Piece {
        if started == 0 { &self.before } else { &self.pieces[started - 1] }
    }
}

#[cfg(test)]
#[path = "speed_tests.rs"]
mod tests;
