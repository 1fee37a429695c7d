//! What can go wrong in a time integration.

use super::{Divergence, Method, Resonance, SnapshotError, Statistics, StepLimit};
use std::fmt;
use thiserror::Error;

/// Failure of a time integration.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TransientError {
    /// The time span, the step or a parameter of the method does not make sense.
    #[error("{0}")]
    Schedule(String),
    /// The solution blew up.
    #[error(transparent)]
    BlewUp(Box<BlowUp>),
    /// A snapshot to go on from is of something else.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
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

/// Refuses a value that breaks its rule.
pub(super) fn require(holds: bool, what: &str, value: f64, rule: &str) -> Result<(), TransientError> {
    if holds { Ok(()) } else { Err(TransientError::Schedule(format!("{what} must be {rule}, found {value:?}"))) }
}

/// A solution that blew up: when, what was noticed, and what step the method could take there.
#[derive(Debug, Clone, PartialEq, Error)]
pub struct BlowUp {
    /// Method that was in use.
    pub method: Method,
    /// End of the step after which it was noticed, s.
    pub time: f64,
    /// Last instant at which the state was looked at and meant something, s: a few steps before, or the start.
    pub good_until: f64,
    /// Whole intervals before it.
    pub good_intervals: u64,
    /// Step length, or time between samples of a method with a step of its own, s.
    pub step_s: f64,
    /// What it took until then.
    pub statistics: Statistics,
    /// The method's limit at the first of the good states that were kept where the step is beyond it; the least of them if it is
    /// beyond none.
    pub limit: Option<StepLimit>,
    /// The mode that the step is in resonance with, where it is below the limit.
    pub resonance: Option<Resonance>,
    /// What was noticed.
    pub cause: Divergence,
}

impl BlowUp {
    /// Whether the step was beyond the method's limit in the last good states; none if it has
    /// no limit there.
    pub(crate) fn beyond_the_limit(&self) -> Option<bool> {
        self.limit.map(|limit| self.step_s > limit.step_s)
    }
}

impl fmt::Display for BlowUp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { time, step_s, .. } = self;
        write!(f, "the solution blew up at t = {time:.9} s (")?;
        let steps = self.statistics.steps;
        if self.method.chooses_its_steps() {
            write!(f, "after {steps} steps by tolerance")?;
        } else {
            write!(f, "step {steps} of {step_s:.3e} s")?;
        }
        write!(f, "; good until {:.9} s): {}", self.good_until, self.cause)?;
        let Some(limit) = self.limit else {
            return Ok(());
        };
        let (method, hz, limit) = (self.method.name(), limit.highest_hz, limit.step_s);
        let what = match self.method {
            Method::NewmarkExplicit => "modes and contacts there vibrate",
            _ => "contacts there vibrate",
        };
        write!(f, "; {what} at up to ")?;
        if hz >= 1e3 {
            write!(f, "{:.1} kHz", 1e-3 * hz)?;
        } else {
            write!(f, "{hz:.3} Hz")?;
        }
        write!(f, ", {method} is stable up to {limit:.2e} s")?;
        if let Some(Resonance { mode_hz, multiple }) = self.resonance {
            let turns = match multiple {
                1 => "half a turn".to_owned(),
                2 => "a turn".to_owned(),
                more => format!("{more} half turns"),
            };
            write!(f, " but for resonances: in this step a mode of {:.1} kHz makes about {turns}", 1e-3 * mode_hz)?;
        }
        Ok(())
    }
}
