//! `plummer analyze`: signals from files, analysed.

use super::{AnalysisSettings, Kinematics, StageError, Watch, WindowAnalysis, analyse};
use crate::diagnosis::DiagnosisError;
use crate::exchange::MeasuredSignal;
use crate::series::TimeWindow;

/// Corner of the high-pass unless one is asked for, Hz: that of the source paper.
const HIGH_PASS_HZ: f64 = 5e3;
/// The same as a part of the sampling rate, for slow recorders.
const HIGH_PASS_PART: f64 = 0.125;

/// Analyses every signal in every window; without windows each as a whole. Without a filter in `settings`: a high-pass at 5 kHz or
/// an eighth of the sampling rate, whichever is lower.
///
/// # Errors
/// [`StageError`]: a window outside a signal, a filter beyond half the sampling rate.
pub fn compute_analysis(
    signals: &[MeasuredSignal],
    settings: &AnalysisSettings,
    kinematics: &Kinematics,
    watch: &impl Watch,
) -> Result<Vec<WindowAnalysis>, StageError> {
    watch.stage("analyse");
    let mut windows = Vec::new();
    for signal in signals {
        let series = &signal.series;
        let mut own = settings.clone();
        if own.windows.is_empty() {
            own.windows.push(series.span());
        }
        if own.high_pass_hz.is_none() && own.low_pass_hz.is_none() {
            own.high_pass_hz = Some(HIGH_PASS_HZ.min(HIGH_PASS_PART * series.rate_hz()));
        }
        let read = |window: TimeWindow, margin_s: f64| {
            let samples = series.values().len();
            let inside = window.check_inside(series.start_s(), series.step_s(), samples);
            // a window that was asked for and is not there is wrong input
            inside.map_err(DiagnosisError::from)?;
            let span = series.span();
            let from = (window.from - margin_s).max(span.from);
            let to = (window.to + margin_s).min(span.to);
            Ok(series.window(from, to)?)
        };
        windows.extend(analyse(&signal.name, &own, read, kinematics)?);
    }
    Ok(windows)
}
