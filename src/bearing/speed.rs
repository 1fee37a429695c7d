//! Prescribed shaft speed: piecewise linear in time, its angle integrated exactly.
//!
//! ```text
//! ω(t) = ω_k + α_k (t − t_k)       θ(t) = θ_k + (t − t_k) (ω_k + ω(t)) / 2       t_k ≤ t < t_{k+1}
//! ```
//!
//! Before the first and after the last knot the speed is constant. `θ(0) = 0` whatever the knots, so
//! that angles of a cage or an unbalance are those at time zero. Any sign of speed is allowed. The
//! acceleration jumps at a knot: there it is that of the interval to the right, and an integrator of high
//! order should end a step at [`SpeedProfile::knot_times`].

use std::f64::consts::TAU;

use thiserror::Error;

/// Why a speed table is refused.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SpeedError {
    /// The table has no row.
    #[error("speed profile is empty: give at least one {{ time, hz }}")]
    Empty,
    /// A time or speed is NaN or infinite.
    #[error("speed profile row {row}: {name} = {value} must be finite")]
    NotFinite {
        /// Row, from 0.
        row: usize,
        /// Which entry.
        name: &'static str,
        /// What it is.
        value: f64,
    },
    /// A time does not come after the one before.
    #[error(
        "speed profile row {row}: time {time} s must be later than {previous} s in the row before"
    )]
    NotIncreasing {
        /// Row, from 0.
        row: usize,
        /// Its time, s.
        time: f64,
        /// The previous row's time, s.
        previous: f64,
    },
}

/// One row of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedKnot {
    /// Time, s.
    pub time: f64,
    /// Shaft frequency at that time, Hz; negative turns clockwise.
    pub frequency_hz: f64,
}

/// Angle and its derivatives at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftMotion {
    /// Angle, rad, not reduced to one turn.
    pub angle: f64,
    /// Angular speed, rad/s.
    pub speed: f64,
    /// Angular acceleration, rad/s².
    pub acceleration: f64,
}

/// Remembers the interval of the last call: successive times cost no search.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SpeedCursor {
    interval: usize,
}

/// Interval that starts at `time` and holds up to the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Interval {
    time: f64,
    angle: f64,
    speed: f64,
    acceleration: f64,
}

impl Interval {
    #[inline]
    fn motion(&self, time: f64) -> ShaftMotion {
        let dt = time - self.time;
        let speed = self.speed + self.acceleration * dt;
        ShaftMotion {
            angle: self.angle + 0.5 * dt * (self.speed + speed),
            speed,
            acceleration: self.acceleration,
        }
    }
}

/// Piecewise linear speed over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedProfile {
    /// Constant speed before the first knot; its reference time is the first knot's.
    before: Interval,
    /// One interval a knot; the last goes on for ever at constant speed.
    intervals: Vec<Interval>,
}

impl SpeedProfile {
    /// Builds the profile from knots in order of time.
    ///
    /// # Errors
    /// [`SpeedError`] if the table is empty, an entry is not finite or times do not increase.
    pub fn new(knots: &[SpeedKnot]) -> Result<Self, SpeedError> {
        let first = knots.first().ok_or(SpeedError::Empty)?;
        for (row, knot) in knots.iter().enumerate() {
            for (name, value) in [("time", knot.time), ("hz", knot.frequency_hz)] {
                if !value.is_finite() {
                    return Err(SpeedError::NotFinite { row, name, value });
                }
            }
        }
        for (row, pair) in knots.windows(2).enumerate() {
            let [previous, next] = [pair[0].time, pair[1].time];
            if next <= previous {
                return Err(SpeedError::NotIncreasing {
                    row: row + 1,
                    time: next,
                    previous,
                });
            }
        }
        let mut angle = 0.0;
        let mut intervals = Vec::with_capacity(knots.len());
        for (row, knot) in knots.iter().enumerate() {
            let speed = TAU * knot.frequency_hz;
            let mut interval = Interval {
                time: knot.time,
                angle,
                speed,
                acceleration: 0.0,
            };
            if let Some(next) = knots.get(row + 1) {
                let duration = next.time - knot.time;
                let next_speed = TAU * next.frequency_hz;
                interval.acceleration = (next_speed - speed) / duration;
                angle += 0.5 * duration * (speed + next_speed);
            }
            intervals.push(interval);
        }
        let before = Interval {
            time: first.time,
            angle: 0.0,
            speed: TAU * first.frequency_hz,
            acceleration: 0.0,
        };
        let mut profile = Self { before, intervals };
        let at_zero = profile.angle(0.0);
        profile.before.angle -= at_zero;
        for interval in &mut profile.intervals {
            interval.angle -= at_zero;
        }
        Ok(profile)
    }

    /// Constant speed (Hz).
    ///
    /// # Errors
    /// [`SpeedError::NotFinite`].
    pub fn constant(frequency_hz: f64) -> Result<Self, SpeedError> {
        Self::new(&[SpeedKnot {
            time: 0.0,
            frequency_hz,
        }])
    }

    /// Times (s) at which the acceleration jumps.
    pub fn knot_times(&self) -> impl Iterator<Item = f64> + '_ {
        self.intervals.iter().map(|interval| interval.time)
    }

    /// Angular speed at `time` (s), rad/s.
    #[must_use]
    #[inline]
    pub fn speed(&self, time: f64) -> f64 {
        self.motion(time).speed
    }

    /// Angular acceleration at `time` (s), rad/s²; at a knot that of the interval to its right.
    #[must_use]
    #[inline]
    pub fn acceleration(&self, time: f64) -> f64 {
        self.motion(time).acceleration
    }

    /// Angle turned since t = 0 at `time` (s), rad.
    #[must_use]
    #[inline]
    pub fn angle(&self, time: f64) -> f64 {
        self.motion(time).angle
    }

    /// All three at `time` (s); O(log n).
    #[must_use]
    #[inline]
    pub fn motion(&self, time: f64) -> ShaftMotion {
        let started = self
            .intervals
            .partition_point(|interval| interval.time <= time);
        self.interval(started).motion(time)
    }

    /// All three at `time` (s), searching from where `cursor` was left: constant cost for times
    /// that move in small steps, either way.
    #[must_use]
    #[inline]
    pub fn motion_from(&self, cursor: &mut SpeedCursor, time: f64) -> ShaftMotion {
        let mut started = cursor.interval.min(self.intervals.len());
        while started < self.intervals.len() && self.intervals[started].time <= time {
            started += 1;
        }
        while started > 0 && self.intervals[started - 1].time > time {
            started -= 1;
        }
        cursor.interval = started;
        self.interval(started).motion(time)
    }

    /// The interval in force once `started` knots have passed.
    #[inline]
    fn interval(&self, started: usize) -> &Interval {
        if started == 0 {
            &self.before
        } else {
            &self.intervals[started - 1]
        }
    }
}

#[cfg(test)]
#[path = "speed_tests.rs"]
mod tests;
