//! How much a chart computes.

use crate::app::case::{self, RunCase};
use crate::app::commands::run::Span;
use crate::app::error::ComputeError;
use crate::signal::band_limit_edge_s;

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
    pub(crate) fn of(run: RunCase<'_>, effort: Effort) -> Result<Self, ComputeError> {
        let RunCase { case, transient: asked, .. } = run;
        let band_hz = case.band_hz().map_or(0.5 * asked.output_hz, |band| band[1]);
        let output_hz = SAMPLES_A_PERIOD * band_hz;
        let edge_s = band_limit_edge_s(1.0 / output_hz, band_hz)?;
        let length = asked.end - asked.start;
        let span_s = length.min(effort.pick(SPAN));
        let window_s = WINDOW_PERIODS / band_hz;
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
    use super::too_short;

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
