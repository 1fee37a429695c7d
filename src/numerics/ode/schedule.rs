//! The steps of a run, and the instants that its samples are taken at.

use super::error::{TransientError, require};

/// Most steps in an output interval: the filter of each sensor has 28 numbers a step, 0.2 GB then.
pub const MOST_STEPS_PER_INTERVAL: u32 = 1_000_000;

/// When a run ends, how it is cut into steps, and how often it is checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Schedule {
    /// Time between checks and progress reports, s; a whole number of steps.
    pub interval: f64,
    /// Steps in an interval, >= 1.
    pub steps_per_interval: u32,
    /// Number of intervals.
    pub intervals: u64,
}

impl Schedule {
    /// Intervals of `interval` seconds that cover `duration`, each cut into equal steps of at most
    /// `largest_step`: methods and steps of any kind then meet at the same instants.
    ///
    /// # Errors
    /// [`TransientError::Schedule`] for values that are not positive and finite.
    pub fn covering(duration: f64, interval: f64, largest_step: f64) -> Result<Self, TransientError> {
        for (what, value) in [("duration", duration), ("output interval", interval), ("step", largest_step)] {
            require(value > 0.0 && value.is_finite(), what, value, "positive and finite")?;
        }
        // a step that fits a whole number of times up to round-off is kept as it is
        let steps = (interval / largest_step * (1.0 - 1e-9)).ceil().max(1.0);
        let intervals = (duration / interval * (1.0 - 1e-12)).ceil();
        let long_enough = "at least a millionth of the output interval, 1 / output_hz (stiff or strongly damped contacts and \
                           light balls shorten it: check bearing.ball_mass, bearing.stiffness, bearing.contact_damping)";
        require(steps <= f64::from(MOST_STEPS_PER_INTERVAL), "step", largest_step, long_enough)?;
        require(intervals * steps <= 1e15, "step", largest_step, "large enough to finish: fewer than 1e15 steps")?;
        Ok(Self { interval, steps_per_interval: steps as u32, intervals: intervals as u64 })
    }

    /// Step length, s.
    pub fn step(&self) -> f64 {
        self.interval / f64::from(self.steps_per_interval)
    }

    /// Sample `place` (from 1) of an interval in a run from `start` (s), s. Counted, not summed: every method has the same
    /// instants to the last bit.
    pub(super) fn instant(&self, start: f64, interval: u64, place: u32) -> f64 {
        if place == self.steps_per_interval {
            start + (interval + 1) as f64 * self.interval
        } else {
            start + interval as f64 * self.interval + f64::from(place) * self.step()
        }
    }
}
