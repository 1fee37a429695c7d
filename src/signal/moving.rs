//! Figures of a signal over time: RMS, crest factor, kurtosis in a sliding window.

use serde::Serialize;

use super::SignalError;
use crate::numerics::series::TimeSeries;

/// Figures over a sliding window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MovingFigures {
    /// Middles of the windows, s.
    pub time_s: Vec<f64>,
    /// Root mean square in each, the mean not removed, in `unit`.
    pub rms: Vec<f64>,
    /// Largest magnitude over root mean square; 1.41 for a sinusoid, 0 for a signal of zeros.
    pub crest_factor: Vec<f64>,
    /// Kurtosis after Pearson, 3 for Gaussian noise (`TimeSeries::kurtosis`); `None` where the signal is constant.
    pub kurtosis: Vec<Option<f64>>,
    /// Unit of the root mean square, that of the signal.
    pub unit: String,
    /// Length of a window, s: a whole number of samples.
    pub window_s: f64,
}

/// Figures of a series in windows of `window_samples` >= 2, each `hop_samples` >= 1 after the one before; the last samples
/// that fill no window are left out. Independent windows of n samples of Gaussian noise scatter by sqrt(24 / n) in
/// kurtosis and by 1 / sqrt(2 n) of the RMS.
///
/// # Errors
/// [`SignalError`] if no window fits, or windows do not move.
pub fn moving_figures(
    series: &TimeSeries,
    window_samples: usize,
    hop_samples: usize,
) -> Result<MovingFigures, SignalError> {
    let samples = series.values().len();
    if window_samples < 2 || samples < window_samples {
        return Err(SignalError::too_short(samples.min(window_samples), window_samples.max(2)));
    }
    if hop_samples == 0 {
        return Err(SignalError("windows must move by at least one sample, found 0".to_owned()));
    }
    let window_s = window_samples as f64 * series.step_s();
    let mut figures = MovingFigures {
        time_s: Vec::new(),
        rms: Vec::new(),
        crest_factor: Vec::new(),
        kurtosis: Vec::new(),
        unit: series.unit().to_owned(),
        window_s,
    };
    for first in (0..=samples - window_samples).step_by(hop_samples) {
        let values = series.values()[first..first + window_samples].to_vec();
        let part = series.with_values(values)?;
        let rms = part.rms();
        // of the samples, the last of which is one step before the window's end
        let middle_s = 0.5 * (window_s - series.step_s());
        figures.time_s.push(series.time_s(first) + middle_s);
        figures.rms.push(rms);
        figures.crest_factor.push(if rms > 0.0 { part.peak() / rms } else { 0.0 });
        figures.kurtosis.push(part.kurtosis());
    }
    Ok(figures)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn figures_follow_the_signal() {
        // silence, a sinusoid of amplitude 2 and period 10, a click of 5
        let mut values = vec![0.0; 300];
        for (k, v) in values.iter_mut().enumerate().take(200).skip(100) {
            *v = 2.0 * (0.2 * PI * k as f64).cos();
        }
        values[250] = 5.0;
        let series = TimeSeries::new(1.0, 0.01, "N", values).expect("a valid series");
        let found = moving_figures(&series, 100, 50).expect("figures");
        assert_eq!(found.time_s.len(), 5);
        assert!((found.time_s[1] - (1.0 + 0.5 + 0.495)).abs() < 1e-12);
        assert!((found.window_s - 1.0).abs() < 1e-12);
        assert!((found.rms[2] - 2_f64.sqrt()).abs() < 1e-12);
        assert!((found.crest_factor[2] - 2_f64.sqrt()).abs() < 1e-12);
        assert!((found.kurtosis[2].expect("moves") - 1.5).abs() < 1e-12);
        assert_eq!((found.rms[0], found.crest_factor[0], found.kurtosis[0]), (0.0, 0.0, None));
        // one click in 100: peak 5, root mean square 0.5, kurtosis about 100
        assert!((found.crest_factor[4] - 10.0).abs() < 1e-12);
        assert!(found.kurtosis[4].expect("moves") > 90.0);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let series = TimeSeries::new(0.0, 1.0, "N", vec![1.0; 10]).expect("a valid series");
        let message = |window, hop| moving_figures(&series, window, hop).expect_err("must fail").to_string();
        assert_eq!(message(11, 1), "series has 10 samples, the filter or transform needs at least 11");
        assert!(message(1, 1).ends_with("needs at least 2"));
        assert_eq!(message(5, 0), "windows must move by at least one sample, found 0");
    }
}
