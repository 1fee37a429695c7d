//! The signals of one run, ready to be compared, or why there are none.

use super::Settings;
use crate::app::commands::run::{InMemory, RunEnd, Simulation, Span};
use crate::app::error::ComputeError;
use crate::app::scene::RunModel;
use crate::numerics::ode::State;
use crate::numerics::ode::TransientError;
use crate::numerics::series::TimeSeries;
use crate::signal::{SignalError, band_limit, relative_difference};
use crate::system::CoupledSystem;

/// Accelerations of all sensors over the same instants, limited to the scene's band.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    signals: Vec<TimeSeries>,
}

/// Kinds of failure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FailureKind {
    /// The model does not take such coordinates, or the method such a step.
    Refused,
    /// The step is beyond the method's linear stability limit.
    Unstable,
    /// The solution blew up.
    BlewUp,
    /// The signal is as far from the reference as zero is, or farther.
    TooInaccurate,
}

/// Why a run has no signals that could be compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    /// Kind.
    pub kind: FailureKind,
    /// What happened.
    pub reason: String,
    /// Relative error, where the signals could be compared.
    pub error: Option<f64>,
}

impl FailureKind {
    /// In results and reports.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Refused => "refused",
            Self::Unstable => "unstable",
            Self::BlewUp => "blew up",
            Self::TooInaccurate => "too inaccurate",
        }
    }
}

impl Failure {
    /// A failure without a signal that could be compared.
    pub(super) fn new(kind: FailureKind, reason: String) -> Self {
        Self { kind, reason, error: None }
    }
}

impl From<ComputeError> for Failure {
    fn from(error: ComputeError) -> Self {
        let kind = match error {
            ComputeError::Transient(TransientError::Unstable { .. }) => FailureKind::Unstable,
            _ => FailureKind::Refused,
        };
        Self::new(kind, error.to_string())
    }
}

impl Trace {
    /// Signals at hand, one a sensor.
    pub fn of(signals: Vec<TimeSeries>) -> Self {
        Self { signals }
    }

    /// The signals of a run from `state` over `seconds` (s), limited to the band.
    ///
    /// # Errors
    /// [`Failure`]: what happened instead.
    pub(crate) fn simulate(
        system: CoupledSystem,
        state: State,
        model: &RunModel,
        settings: &Settings,
        seconds: f64,
    ) -> Result<Self, Failure> {
        let whole = simulate(system, state, model, settings.simulated(seconds))?;
        let signals = (0..whole.record.sensors.len()).map(|sensor| {
            let signal = whole.signal(sensor)?;
            Ok(band_limit(&signal, settings.band_hz)?)
        });
        let signals = signals.collect::<Result<Vec<_>, ComputeError>>();
        Ok(Self::of(signals?))
    }

    /// Root of the sum of the sensors' mean squares over the time since the start from `from` to `to` (s).
    ///
    /// # Errors
    /// [`SignalError`] if the signals do not reach so far.
    pub(crate) fn rms(&self, from: f64, to: f64) -> Result<f64, SignalError> {
        let mut squares = 0.0;
        for signal in &self.signals {
            squares += part(signal, from, to)?.rms().powi(2);
        }
        Ok(squares.sqrt())
    }

    /// Root of the sum of the mean squares of the difference from a reference, from `from` to `to` (s) since the start.
    ///
    /// # Errors
    /// [`SignalError`] if the signals do not reach so far or have other instants.
    pub(crate) fn difference(&self, reference: &Self, from: f64, to: f64) -> Result<f64, SignalError> {
        let mut squares = 0.0;
        for (own, other) in self.signals.iter().zip(&reference.signals) {
            let (own, other) = (part(own, from, to)?, part(other, from, to)?);
            let size = other.rms();
            // a sensor that the reference does not move is compared with zero
            squares += if size > 0.0 { (relative_difference(&own, &other)? * size).powi(2) } else { own.rms().powi(2) };
        }
        Ok(squares.sqrt())
    }

    /// `difference` over the reference's `rms` in the same time.
    ///
    /// # Errors
    /// `SignalError::ZeroReference` and as these.
    pub fn error(&self, reference: &Self, from: f64, to: f64) -> Result<f64, SignalError> {
        let size = reference.rms(from, to)?;
        if size <= 0.0 {
            return Err(SignalError::zero_reference());
        }
        Ok(self.difference(reference, from, to)? / size)
    }
}

/// A whole simulation.
///
/// # Errors
/// [`Failure`] also for one that ended before its time.
pub(super) fn simulate(
    system: CoupledSystem,
    state: State,
    model: &RunModel,
    span: Span,
) -> Result<Simulation, Failure> {
    let simulation = Simulation::kept(system, state, model, span, false, &mut InMemory, |_| ())?;
    match simulation.end {
        RunEnd::Complete => Ok(simulation),
        RunEnd::BlewUp(error) => Err(Failure::new(FailureKind::BlewUp, error.to_string())),
    }
}

fn part(signal: &TimeSeries, from: f64, to: f64) -> Result<TimeSeries, SignalError> {
    let start = signal.start_s();
    // half a step early: the sample at `from` belongs to it whatever the rounding
    let early = 0.5 * signal.step_s();
    Ok(signal.window((start + from - early).max(start), start + to - early)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trace(signals: &[&[f64]]) -> Trace {
        let series =
            signals.iter().map(|values| TimeSeries::new(1.0, 0.5, "m/s^2", values.to_vec()).expect("a valid series"));
        Trace::of(series.collect())
    }

    #[test]
    fn sensors_count_by_their_size() {
        let reference = trace(&[&[3.0, -3.0, 9.0], &[4.0, 4.0, 9.0]]);
        let other = trace(&[&[3.0, -3.0, 0.0], &[5.0, 3.0, 0.0]]);
        // the first second: rms 3 and 4 together 5, differences 0 and 1
        assert!((other.error(&reference, 0.0, 1.0).unwrap() - 0.2).abs() < 1e-15);
        assert!((other.difference(&reference, 1.0, 1.5).unwrap() - 162_f64.sqrt()).abs() < 1e-12);
        let still = trace(&[&[0.0, 0.0, 0.0], &[4.0, 4.0, 9.0]]);
        assert!((reference.difference(&still, 0.0, 1.0).unwrap() - 3.0).abs() < 1e-15);
        let nothing = trace(&[&[0.0; 3]]);
        assert_eq!(reference.error(&nothing, 0.0, 1.0), Err(SignalError::zero_reference()));
    }
}
