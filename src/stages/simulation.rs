//! A scene stepped through time by one model.

use super::{RunModel, Scene, StageError};
use crate::dynamics::State;
use crate::series::TimeSeries;
use crate::system::{CoupledSystem, Recorder, RunRecord};
use crate::transient::{BlowUp, Method, Schedule, Statistics, Stepping, TransientError, integrate};
use std::time::Instant;

/// What is simulated of a scene, from its start on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Length, s.
    pub duration: f64,
    /// Sampling rate of the signals, Hz.
    pub output_hz: f64,
}

/// How a simulation ended.
#[derive(Debug)]
pub enum RunEnd {
    /// At the end of its time.
    Complete,
    /// The solution blew up; what was recorded before is there.
    BlewUp(Box<BlowUp>),
}

/// Signals of a scene by one model, and what they took.
#[derive(Debug)]
pub struct Simulation {
    /// Method used.
    pub method: Method,
    /// How the time was cut.
    pub schedule: Schedule,
    /// Kept modes of the structure.
    pub modes: usize,
    /// Whether the static residual of the others was in use.
    pub residual: bool,
    /// Steps and evaluations.
    pub statistics: Statistics,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Wall time of the stepping alone, s.
    pub stepping_s: f64,
    /// Signals.
    pub record: RunRecord,
    /// How it ended.
    pub end: RunEnd,
}

impl Simulation {
    /// Steps a scene through `span` from rest; `fraction` is told how far it is, 0 to 1.
    ///
    /// # Errors
    /// [`StageError`]; a solution that blows up is no error here but a [`RunEnd`].
    pub fn from_rest(
        scene: &Scene,
        model: &RunModel,
        span: Span,
        fraction: impl Fn(f64),
    ) -> Result<Self, StageError> {
        let system = scene.system(model)?;
        let state = scene.at_rest(&system);
        Self::from_state(system, state, model, span, fraction)
    }

    /// Steps a system of a model through `span` from a state.
    ///
    /// # Errors
    /// As [`from_rest`](Self::from_rest).
    pub fn from_state(
        mut system: CoupledSystem,
        mut state: State,
        model: &RunModel,
        span: Span,
        fraction: impl Fn(f64),
    ) -> Result<Self, StageError> {
        let start = state.t;
        let mut schedule = Schedule::covering(span.duration, 1.0 / span.output_hz, model.step)?;
        let wanted = usize::try_from(schedule.intervals)
            .unwrap_or(usize::MAX)
            .saturating_add(1);
        let mut recorder = Recorder::new(
            &system,
            schedule.steps_per_interval,
            schedule.step(),
            wanted,
        )?;
        schedule.intervals += recorder.intervals_past_the_end();
        let report_every = (schedule.intervals / 1000).max(1);
        let clock = Instant::now();
        let stepped = integrate(
            &mut system,
            model.method,
            &schedule,
            &mut state,
            &mut recorder,
            |done, total| {
                if done.is_multiple_of(report_every) {
                    fraction(done as f64 / total as f64);
                }
                Stepping::Continue
            },
        );
        let stepping_s = clock.elapsed().as_secs_f64();
        let (statistics, end, record) = match stepped {
            Ok(statistics) => (statistics, RunEnd::Complete, recorder.finish()),
            Err(error) => {
                let TransientError::BlewUp(blow_up) = error else {
                    return Err(error.into());
                };
                let record = recorder.finish_after(blow_up.good_intervals);
                (blow_up.statistics, RunEnd::BlewUp(blow_up), record)
            }
        };
        Ok(Self {
            method: model.method,
            schedule,
            modes: system.modes(),
            residual: system.has_residual(),
            statistics,
            simulated_s: state.t - start,
            stepping_s,
            record,
            end,
        })
    }

    /// Simulated time over wall time of the stepping.
    pub fn realtime_factor(&self) -> f64 {
        self.simulated_s / self.stepping_s.max(f64::MIN_POSITIVE)
    }

    /// Length of a step, s; of a method with steps of its own their mean.
    pub fn step_s(&self) -> f64 {
        if self.method.chooses_its_steps() {
            self.simulated_s / (self.statistics.steps.max(1) as f64)
        } else {
            self.schedule.step()
        }
    }

    /// A sensor's acceleration as a series, m/s^2.
    ///
    /// # Errors
    /// [`StageError::Series`] if nothing was recorded.
    pub fn signal(&self, sensor: usize) -> Result<TimeSeries, StageError> {
        let start = self.record.time_s.first().copied().unwrap_or(0.0);
        let values = self.record.sensors[sensor].1.clone();
        Ok(TimeSeries::new(
            start,
            self.schedule.interval,
            "m/s^2",
            values,
        )?)
    }
}
