//! `plummer analyze`: signals from files, analysed.

use super::band_search::AskedBand;
use super::window::{AnalysisSettings, WindowAnalysis, analyse};
use crate::app::error::ComputeError;
use crate::formats::MeasuredSignal;
use crate::numerics::Watch;
use crate::numerics::series::TimeWindow;
use crate::signal::diagnosis::DiagnosisError;
use crate::signal::diagnosis::Kinematics;
use crate::signal::usual_high_pass_hz;

/// Analyses every signal in every window; without windows each as a whole. Without a band in `settings`: the high-pass of
/// `usual_high_pass_hz`.
///
/// # Errors
/// [`ComputeError`]: a window outside a signal, a filter beyond half the sampling rate.
pub fn compute_analysis(
    signals: &[MeasuredSignal],
    settings: &AnalysisSettings,
    kinematics: &Kinematics,
    watch: &impl Watch,
) -> Result<Vec<WindowAnalysis>, ComputeError> {
    watch.stage("analyse");
    let mut windows = Vec::new();
    for signal in signals {
        let series = &signal.series;
        let mut own = settings.clone();
        if own.windows.is_empty() {
            own.windows.push(series.span());
        }
        let usual = AskedBand::HighPass(usual_high_pass_hz(series.rate_hz()));
        own.shown_band.get_or_insert(usual);
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
