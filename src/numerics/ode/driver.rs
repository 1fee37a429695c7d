//! One loop for all methods: steps, records, checks.

use super::adams::Adams;
use super::dop853::Dop853;
use super::error::TransientError;
use super::exponential::Exponential;
use super::implicit::Implicit;
use super::integration::Integration;
use super::newmark::NewmarkExplicit;
use super::splitting::Splitting;
use crate::numerics::ode::{
    Divergence, Observer, SecondOrderSystem, Snapshot, SnapshotError, SnapshotReader, State,
};
use std::f64::consts::TAU;

/// Integration method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Exponential velocity Verlet.
    Exponential,
    /// Exponential Adams method.
    ExponentialAdams {
        /// Largest part of the force, in units of the largest that a coordinate has seen, that a step may leave out of its
        /// prediction: steps are halved until it is less, and of fourth order where that predicts better. Equal steps of third
        /// order without it.
        tolerance: Option<f64>,
    },
    /// Central differences with implicit damping, the source paper's.
    NewmarkExplicit,
    /// Impulses of the force between exact flows: keeps no equilibrium between a force and a spring.
    Splitting,
    /// Newmark's method of average acceleration, implicit: stable at every step, keeps energy.
    Newmark,
    /// Generalized-alpha, implicit: stable at every step, damps what the step does not resolve.
    GeneralizedAlpha {
        /// Share of the amplitude that a step leaves of a motion far too fast for it, 0 to 1.
        spectral_radius: f64,
    },
    /// Explicit Runge-Kutta of order 8(5,3) with a step of its own.
    Dop853 {
        /// Largest error of a step in units of what each coordinate reaches in the run, from [`LEAST_TOLERANCE`] to 1.
        tolerance: f64,
        /// Whether steps end where the force is not smooth, as far as the system tells.
        events: bool,
    },
}

/// Least tolerance of a method with a step of its own: below this round-off alone would shorten the steps.
pub const LEAST_TOLERANCE: f64 = 1e-14;

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

/// Counts of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Statistics {
    /// Steps taken.
    pub steps: u64,
    /// Steps that were tried and not good enough.
    pub rejected: u64,
    /// Force evaluations.
    pub evaluations: u64,
    /// Linear systems solved.
    pub solves: u64,
    /// Steps that ended at an event.
    pub events: u64,
}

/// Whether to go on after an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stepping {
    /// Go on.
    Continue,
    /// Stop here; the state is that of this instant.
    Stop,
}

impl Statistics {
    /// Of so many steps with one evaluation each, and one before the first.
    pub(super) fn of_single_evaluations(steps: u64) -> Self {
        Self {
            steps,
            evaluations: steps + 1,
            ..Self::default()
        }
    }

    /// Writes the counts.
    pub(super) fn remember(&self, snapshot: &mut Snapshot) {
        for count in [
            self.steps,
            self.rejected,
            self.evaluations,
            self.solves,
            self.events,
        ] {
            snapshot.count(count);
        }
    }

    /// The counts as they were written.
    ///
    /// # Errors
    /// [`SnapshotError::Short`].
    pub(super) fn recalled(snapshot: &mut SnapshotReader) -> Result<Self, SnapshotError> {
        Ok(Self {
            steps: snapshot.count()?,
            rejected: snapshot.count()?,
            evaluations: snapshot.count()?,
            solves: snapshot.count()?,
            events: snapshot.count()?,
        })
    }
}

impl Method {
    /// Whether steps follow from a tolerance instead of the schedule.
    pub fn chooses_its_steps(self) -> bool {
        matches!(
            self,
            Self::Dop853 { .. } | Self::ExponentialAdams { tolerance: Some(_) }
        )
    }

    /// Whether a step is solved for: no step is too long for a linear system.
    pub fn is_implicit(self) -> bool {
        matches!(self, Self::Newmark | Self::GeneralizedAlpha { .. })
    }

    /// Name in case files and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exponential => "exponential",
            Self::ExponentialAdams { .. } => "exponential-adams",
            Self::NewmarkExplicit => "newmark-explicit",
            Self::Splitting => "splitting",
            Self::Newmark => "newmark",
            Self::GeneralizedAlpha { .. } => "generalized-alpha",
            Self::Dop853 { .. } => "dop853",
        }
    }
}

impl Schedule {
    /// Intervals of `interval` seconds that cover `duration`, each cut into equal steps of at most
    /// `largest_step`: methods and steps of any kind then meet at the same instants.
    ///
    /// # Errors
    /// [`TransientError::Schedule`] for values that are not positive and finite.
    pub fn covering(
        duration: f64,
        interval: f64,
        largest_step: f64,
    ) -> Result<Self, TransientError> {
        for (what, value) in [
            ("duration", duration),
            ("output interval", interval),
            ("step", largest_step),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(TransientError::Schedule {
                    what,
                    value,
                    rule: "positive and finite",
                });
            }
        }
        // a step that fits a whole number of times up to round-off is kept as it is
        let steps = (interval / largest_step * (1.0 - 1e-9)).ceil().max(1.0);
        let intervals = (duration / interval * (1.0 - 1e-12)).ceil();
        if steps > f64::from(MOST_STEPS_PER_INTERVAL) {
            return Err(TransientError::Schedule {
                what: "step",
                value: largest_step,
                rule: "at least a millionth of the output interval, 1 / output_hz (stiff or strongly damped contacts and light balls shorten it: check bearing.ball_mass, bearing.stiffness, bearing.contact_damping)",
            });
        }
        if intervals * steps > 1e15 {
            return Err(TransientError::Schedule {
                what: "step",
                value: largest_step,
                rule: "large enough to finish: fewer than 1e15 steps",
            });
        }
        Ok(Self {
            interval,
            steps_per_interval: steps as u32,
            intervals: intervals as u64,
        })
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

/// A method on its way from sample to sample.
pub(super) trait Stepper<S> {
    /// Goes from the last instant to `t1` (s), the next sample's; `g` is the force at the state on entry and on return. A
    /// method with a step of its own goes beyond it and gives what is between.
    ///
    /// # Errors
    /// [`Divergence`] if no step can be found that the method can take.
    fn step(
        &mut self,
        system: &mut S,
        t1: f64,
        y: &mut [f64],
        v: &mut [f64],
        g: &mut [f64],
    ) -> Result<(), Divergence>;

    /// What it took so far.
    fn statistics(&self) -> Statistics;

    /// Writes all that the next steps depend on, beside state and force, and the counts.
    fn remember(&self, snapshot: &mut Snapshot);

    /// Reads what [`remember`](Self::remember) wrote, into a stepper made for the same system and step.
    ///
    /// # Errors
    /// [`SnapshotError`] for a snapshot of something else.
    fn recall(&mut self, snapshot: &mut SnapshotReader) -> Result<(), SnapshotError>;
}

/// Integrates `system` from `state`, which is left at the end or at the last good instant.
///
/// `observer` sees every sample, `schedule.steps_per_interval` an interval: the steps of a method that has none of its own.
/// `after_interval(done, total)` is called between intervals and may stop the run.
///
/// # Errors
/// [`TransientError::Unstable`] and [`TransientError::Schedule`] before the first step, [`TransientError::BlewUp`] with the last
/// good state and the records of the steps before it left in place.
pub fn integrate<S: SecondOrderSystem>(
    system: &mut S,
    method: Method,
    schedule: &Schedule,
    state: &mut State,
    observer: &mut impl Observer<S>,
    mut after_interval: impl FnMut(u64, u64) -> Stepping,
) -> Result<Statistics, TransientError> {
    let mut integration = Integration::begin(system, method, *schedule, state.clone(), observer)?;
    let mut ended = Ok(());
    while ended.is_ok() && !integration.is_complete() {
        ended = integration.advance(system, observer);
        let done = integration.intervals();
        if ended.is_ok() && after_interval(done, schedule.intervals) == Stepping::Stop {
            break;
        }
    }
    state.clone_from(integration.state());
    ended.map(|()| integration.statistics())
}

/// The method ready to go from `start` (s) with the schedule's steps.
pub(super) fn stepper<S: SecondOrderSystem>(
    system: &S,
    method: Method,
    schedule: &Schedule,
    start: f64,
) -> Result<Box<dyn Stepper<S>>, TransientError> {
    let h = schedule.step();
    Ok(match method {
        Method::Exponential => Box::new(Exponential::new(system, h)),
        Method::ExponentialAdams { tolerance } => {
            tolerance.map_or(Ok(()), check_tolerance)?;
            Box::new(Adams::new(system, h, tolerance))
        }
        Method::Splitting => Box::new(Splitting::new(system, h)),
        Method::Newmark => Box::new(Implicit::average_acceleration(system, h)),
        Method::GeneralizedAlpha { spectral_radius } => {
            check_spectral_radius(spectral_radius)?;
            Box::new(Implicit::generalized_alpha(system, h, spectral_radius))
        }
        Method::Dop853 { tolerance, events } => {
            check_tolerance(tolerance)?;
            Box::new(Dop853::new(system, start, tolerance, events))
        }
        Method::NewmarkExplicit => {
            check_stability(system, h)?;
            Box::new(NewmarkExplicit::new(system, h))
        }
    })
}

fn check_spectral_radius(value: f64) -> Result<(), TransientError> {
    if (0.0..=1.0).contains(&value) {
        Ok(())
    } else {
        Err(TransientError::Schedule {
            what: "spectral radius",
            value,
            rule: "from 0 to 1",
        })
    }
}

fn check_tolerance(tolerance: f64) -> Result<(), TransientError> {
    if (LEAST_TOLERANCE..1.0).contains(&tolerance) {
        Ok(())
    } else {
        Err(TransientError::Schedule {
            what: "tolerance",
            value: tolerance,
            rule: "at least 1e-14 and below 1",
        })
    }
}

fn check_stability(system: &impl SecondOrderSystem, h: f64) -> Result<(), TransientError> {
    let highest = system
        .linear()
        .iter()
        .map(|coordinate| coordinate.squared_frequency)
        .fold(0.0, f64::max)
        .sqrt();
    if h * highest < 2.0 {
        Ok(())
    } else {
        Err(TransientError::Unstable {
            step_s: h,
            limit_s: 2.0 / highest,
            highest_hz: highest / TAU,
        })
    }
}
