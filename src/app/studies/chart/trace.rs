//! The signals of one run, ready to be compared, or why there are none.
//!
//! How much a chart computes.

use crate::app::case;
use crate::app::case::Case;
use crate::app::commands::run::{Simulation, Span};
use crate::app::error::ComputeError;
use crate::numerics::ode::TransientError;
use crate::numerics::series::TimeSeries;
use crate::signal::{SignalError, band_limit, band_limit_edge_s, relative_difference};

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
    /// The budget ended before.
    OutOfTime,
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
            Self::OutOfTime => "out of time",
        }
    }
}

impl Failure {
    /// A failure without a signal that could be compared.
    pub(super) fn new(kind: FailureKind, reason: String) -> Self {
        Self { kind, reason, error: None }
    }

    /// A run that the budget cut short.
    pub(super) fn out_of_time() -> Self {
        Self::new(FailureKind::OutOfTime, "the budget ended before".to_owned())
    }
}

impl From<ComputeError> for Failure {
    fn from(error: ComputeError) -> Self {
        let kind = match error {
            ComputeError::Interrupted { .. } => return Self::out_of_time(),
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

    /// The signals of a run, limited to the band of the settings.
    ///
    /// # Errors
    /// [`Failure`] for a signal that cannot be limited.
    pub(crate) fn of_run(run: &Simulation, settings: &Settings) -> Result<Self, Failure> {
        let signals = (0..run.record.sensors.len()).map(|sensor| {
            let signal = run.signal(sensor)?;
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

fn part(signal: &TimeSeries, from: f64, to: f64) -> Result<TimeSeries, SignalError> {
    let start = signal.start_s();
    // half a step early: the sample at `from` belongs to it whatever the rounding
    let early = 0.5 * signal.step_s();
    Ok(signal.window((start + from - early).max(start), start + to - early)?)
}

/// Samples of the compared signals in a period of the band's highest frequency: well above what must be told apart.
const SAMPLES_A_PERIOD: f64 = 5.0;

/// Periods of the band's highest frequency over which a distance is taken.
const WINDOW_PERIODS: f64 = 10.0;

/// Length of the span in which methods are compared point by point, full and quick, s.
const SPAN: [f64; 2] = [8e-3, 3e-3];

/// Most starts of a quick chart.
const QUICK_RUNS: usize = 6;

/// Most starts from which a candidate is computed; the reference, its growth and statistics take all.
const POINT_STARTS: usize = 8;

/// Length of the runs whose statistics are compared, in spans.
const STATISTICS_SPANS: f64 = 3.0;

/// Starts that a budget keeps as long as the span can be shortened instead, and the fewest: a scatter needs two.
const FEW_STARTS: usize = 3;
pub(super) const LEAST_STARTS: usize = 2;

/// Windows of the shortest span that a budget leaves: two tell a growth, and an impact may fall into the first.
const LEAST_WINDOWS: f64 = 4.0;

/// How much a chart computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Effort {
    /// All methods and models, every run of the ensemble.
    #[default]
    Full,
    /// Fewer starts, a shorter span and fewer models: to look at a scene.
    Quick,
}

impl Effort {
    /// What belongs to this effort, of what belongs to the full and to the quick one.
    pub(super) fn pick<T>(self, [full, quick]: [T; 2]) -> T {
        match self {
            Self::Full => full,
            Self::Quick => quick,
        }
    }
}

/// What is simulated for a chart, and what is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// How much is computed.
    pub effort: Effort,
    /// Highest frequency that is compared, Hz.
    pub band_hz: f64,
    /// Relative error that is good enough.
    pub target: f64,
    /// Longest span compared point by point, s.
    pub span_s: f64,
    /// Span of the runs whose statistics are compared, s.
    pub statistics_s: f64,
    /// Time over which a distance of two solutions is taken, s.
    pub window_s: f64,
    /// Reach of the band limit beyond the compared span, s.
    pub edge_s: f64,
    /// Sampling rate of the compared signals, Hz.
    pub output_hz: f64,
    /// The starts.
    pub ensemble: case::Ensemble,
}

impl Settings {
    /// Those of a case.
    ///
    /// # Errors
    /// [`ComputeError::Input`] if what is simulated is too short for the band.
    pub(crate) fn of(case: &Case, asked: &case::Transient, effort: Effort) -> Result<Self, ComputeError> {
        let band_hz = case.band_hz().map_or(0.5 * asked.output_hz, |band| band[1]);
        let output_hz = SAMPLES_A_PERIOD * band_hz;
        let edge_s = band_limit_edge_s(1.0 / output_hz, band_hz)?;
        let length = asked.end - asked.start;
        let window_s = WINDOW_PERIODS / band_hz;
        // low bands have long windows
        let span_s = length.min(effort.pick(SPAN).max(4.0 * window_s));
        // two windows tell a growth
        if span_s < 2.0 * window_s {
            return Err(too_short(length, band_hz, 2.0 * window_s));
        }
        let mut ensemble = asked.ensemble;
        ensemble.runs = effort.pick([ensemble.runs, ensemble.runs.min(QUICK_RUNS)]);
        Ok(Self {
            effort,
            band_hz,
            target: case.target(),
            span_s,
            statistics_s: length.min(STATISTICS_SPANS * span_s),
            window_s,
            edge_s,
            output_hz,
            ensemble,
        })
    }

    /// With fewer starts and, where these are few, a shorter span, so that `cost` (s a simulated second of a start) comes to at
    /// most `time` (s); the least of both where that is too much.
    pub(super) fn fitted(self, cost: f64, time: f64) -> Self {
        let fits = |settings: &Self| (time / (cost * (settings.span_s + settings.edge_s))) as usize;
        let mut fitted = self;
        while fits(&fitted) < FEW_STARTS.min(self.ensemble.runs)
            && let Some(shorter) = fitted.shorter()
        {
            fitted = shorter;
        }
        fitted.ensemble.runs = fits(&fitted).max(LEAST_STARTS).min(self.ensemble.runs);
        fitted
    }

    /// With half the span; `None` where it is the shortest already.
    pub(super) fn shorter(self) -> Option<Self> {
        let least = LEAST_WINDOWS * self.window_s;
        let span_s = (0.5 * self.span_s).max(least);
        // the last half may be a part of it alone
        (span_s < 0.99 * self.span_s).then(|| Self {
            span_s,
            statistics_s: self.statistics_s.min(STATISTICS_SPANS * span_s),
            ..self
        })
    }

    /// Every how many starts a candidate is computed.
    pub(crate) fn point_stride(&self) -> usize {
        self.ensemble.runs.div_ceil(POINT_STARTS)
    }

    /// Time between two samples of the compared signals, s.
    pub(crate) fn interval(&self) -> f64 {
        1.0 / self.output_hz
    }

    /// What is to be simulated for `seconds` of compared signals.
    pub(crate) fn simulated(&self, seconds: f64) -> Span {
        Span { duration: seconds + self.edge_s, output_hz: self.output_hz }
    }
}

/// The error of a simulated time (s) that is too short for a chart in a band up to `band_hz` (Hz), which needs `needed` (s).
fn too_short(found: f64, band_hz: f64, needed: f64) -> ComputeError {
    ComputeError::input(
        format!(
            "transient.end - transient.start is {found} s: a chart in the band up to {band_hz} Hz needs at least {needed} s"
        ),
        format!("a later transient.end, by at least {needed} s after transient.start"),
    )
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

#[cfg(test)]
mod effort_tests {
    use super::{Effort, Settings, too_short};
    use crate::app::case::Case;

    #[test]
    fn a_budget_takes_starts_first_and_then_from_the_span() {
        let case = Case::example("scenes/smooth", &[]);
        let asked = Settings::of(&case, case.for_run().unwrap().transient, Effort::Quick).unwrap();
        let fitted = |time: f64| {
            // a second of computing for a start over the whole span
            let settings = asked.fitted(1.0 / (asked.span_s + asked.edge_s), time);
            assert!(settings.statistics_s <= 3.0 * settings.span_s + 1e-12);
            (settings.ensemble.runs, (1e3 * settings.span_s * 1e3).round() / 1e3)
        };
        assert_eq!([6.5, 4.5, 3.5].map(fitted), [(6, 3.0), (4, 3.0), (3, 3.0)]);
        // half the span and its edge take a little more than half the time
        assert_eq!(fitted(2.0), (3, 1.5));
        // four windows of ten periods of 40 kHz are 1 ms, of two starts
        assert_eq!([0.9, 0.0].map(fitted), [(2, 1.0), (2, 1.0)]);
        assert!(asked.fitted(1.0, 0.0).shorter().is_none());
    }

    #[test]
    fn a_time_that_is_too_short_is_wrong_input() {
        let error = too_short(1e-4, 4e4, 5e-4);
        assert!(error.is_input());
        let message =
            "transient.end - transient.start is 0.0001 s: a chart in the band up to 40000 Hz needs at least 0.0005 s";
        assert_eq!(error.to_string(), message);
        assert_eq!(error.help().unwrap(), "a later transient.end, by at least 0.0005 s after transient.start");
    }
}
