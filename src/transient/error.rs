//! What can go wrong in a time integration.

use super::driver::Statistics;
use crate::dynamics::Divergence;
use thiserror::Error;

/// Failure of a time integration.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TransientError {
    /// The time span, the step or a parameter of the method does not make sense.
    #[error("{what} must be {rule}, found {value}")]
    Schedule {
        /// Which quantity.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        rule: &'static str,
    },
    /// The solution blew up.
    #[error(
        "the solution blew up at t = {time:.9} s (step {} of {step_s:.3e} s): {cause}",
        statistics.steps
    )]
    BlewUp {
        /// When it was noticed, s.
        time: f64,
        /// Whole intervals before it.
        good_intervals: u64,
        /// Step length, or time between samples of a method with a step of its own, s.
        step_s: f64,
        /// What it took until then.
        statistics: Statistics,
        /// What was noticed.
        cause: Divergence,
    },
    /// The step is beyond the method's linear stability limit.
    #[error(
        "step {step_s:.4e} s is beyond the stability limit {limit_s:.4e} s of newmark-explicit (2 / omega of the highest mode, {highest_hz:.4e} Hz)"
    )]
    Unstable {
        /// Step asked for, s.
        step_s: f64,
        /// The limit, s.
        limit_s: f64,
        /// Highest frequency of the linear part, Hz.
        highest_hz: f64,
    },
}
