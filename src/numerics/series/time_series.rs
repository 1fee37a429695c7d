//! `TimeSeries`: samples at equal steps, with the unit they are in.
//!
//! What a sensor or a converter did to a signal: clipping, and stretches that stand still.
//!
//! Figures that sum a signal up: mean, RMS, peak, kurtosis.

use crate::numerics::Brief;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Part of a step by which an instant may miss a sample and still mean it: window bounds are typed in decimal and
/// a sample instant is `start + k step` in binary. A millionth of a step is far above rounding (t / step * 2e-16,
/// 1e-9 for 10 s at 1 MHz) and far below anything one could mean.
const INSTANT_TOLERANCE_STEPS: f64 = 1e-6;

/// Steps by which an instant may miss a sample: round-off counts where time has its origin far away, as seconds since 1970 do.
pub(crate) fn tolerance_steps(latest_s: f64, step_s: f64) -> f64 {
    INSTANT_TOLERANCE_STEPS + 4.0 * f64::EPSILON * latest_s / step_s
}

/// Why a series, a window of it or a decimator cannot be made: a sentence with the values found.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct SeriesError(pub(super) String);

impl SeriesError {
    /// A series without samples.
    pub(crate) fn empty() -> Self {
        Self("series has no samples".to_owned())
    }
}

/// Refuses a sampling step (s) that is not positive and finite.
pub(super) fn check_step(step_s: f64) -> Result<(), SeriesError> {
    if step_s.is_finite() && step_s > 0.0 {
        return Ok(());
    }
    Err(SeriesError(format!("sampling step must be positive and finite, found {step_s} s")))
}

/// Samples x_k = x(start + k step), k = 0 .. n-1, all finite, n >= 1, in one unit.
///
/// ```
/// use plummer::numerics::series::TimeSeries;
/// let series = TimeSeries::new(2.0, 0.5, "m/s^2", vec![1.0, -3.0, 2.0, 0.0])?;
/// assert_eq!(series.window(2.5, 3.5)?.values(), &[-3.0, 2.0]);
/// # Ok::<(), plummer::numerics::series::SeriesError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TimeSeries {
    start_s: f64,
    step_s: f64,
    unit: String,
    values: Vec<f64>,
}

/// A stretch of time, from <= t < to, s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeWindow {
    /// First instant, in s.
    pub from: f64,
    /// End, in s, after `from`; the instant itself is outside.
    pub to: f64,
}

impl TimeWindow {
    /// Checks that the window lies in a series of so many samples, the first at `start_s`, one every `step_s`, without the
    /// series: for one that is read in part.
    ///
    /// # Errors
    /// [`SeriesError`] for a window that ends before it starts, and for one that reaches beyond the series.
    pub(crate) fn check_inside(self, start_s: f64, step_s: f64, samples: usize) -> Result<(), SeriesError> {
        let (from_s, to_s) = (self.from, self.to);
        if !(from_s.is_finite() && to_s.is_finite() && from_s < to_s) {
            let [from_s, to_s] = [from_s, to_s].map(Brief);
            return Err(SeriesError(format!("window must end after it starts, found {from_s} s to {to_s} s")));
        }
        let position = |t: f64| (t - start_s) / step_s;
        let samples = samples as f64;
        let tolerance = tolerance_steps(start_s.abs().max(to_s.abs()), step_s);
        if position(from_s) < -tolerance || position(to_s) > samples + tolerance {
            let [from_s, to_s, start_s, end_s] = [from_s, to_s, start_s, start_s + samples * step_s].map(Brief);
            return Err(SeriesError(format!(
                "window {from_s} s to {to_s} s is not inside the series, which covers {start_s} s to {end_s} s"
            )));
        }
        Ok(())
    }
}

impl TimeSeries {
    /// Series of `values` (length n >= 1, in `unit`), the first at `start_s`, one every `step_s` > 0 seconds.
    ///
    /// # Errors
    /// [`SeriesError`] for start, step or an empty series, and with the first sample that is NaN or infinite.
    pub fn new(start_s: f64, step_s: f64, unit: impl Into<String>, values: Vec<f64>) -> Result<Self, SeriesError> {
        if !start_s.is_finite() {
            return Err(SeriesError(format!("start of the series must be finite, found {start_s} s")));
        }
        check_step(step_s)?;
        if values.is_empty() {
            return Err(SeriesError::empty());
        }
        if let Some((index, value)) = values.iter().enumerate().find(|(_, v)| !v.is_finite()) {
            let time_s = start_s + index as f64 * step_s;
            return Err(SeriesError(format!("sample {index} (t = {time_s} s) is {value}, not a finite number")));
        }
        Ok(Self { start_s, step_s, unit: unit.into(), values })
    }

    /// Instant of the first sample, s.
    pub(crate) fn start_s(&self) -> f64 {
        self.start_s
    }

    /// Sampling step, s.
    pub(crate) fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Sampling rate, Hz: 1 / step.
    pub(crate) fn rate_hz(&self) -> f64 {
        1.0 / self.step_s
    }

    /// One step after the last sample, s: start + n step.
    pub(crate) fn end_s(&self) -> f64 {
        self.time_s(self.values.len())
    }

    /// Length in time, s: n step.
    pub(crate) fn duration_s(&self) -> f64 {
        self.values.len() as f64 * self.step_s
    }

    /// Instant of sample `index`, s: start + index step (any index; not checked against the length).
    pub(crate) fn time_s(&self, index: usize) -> f64 {
        self.start_s + index as f64 * self.step_s
    }

    /// Unit of the values, as a label ("m/s^2").
    pub(crate) fn unit(&self) -> &str {
        &self.unit
    }

    /// The samples, length n >= 1, in `unit`.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Stretch of time that the series covers: start <= t < end.
    pub fn span(&self) -> TimeWindow {
        TimeWindow { from: self.start_s, to: self.end_s() }
    }

    /// The samples with `from_s` <= t < `to_s` (half-open, so that adjoining windows share no sample); bounds within
    /// a millionth of a step of a sample mean that sample. `to_s` may be the end of the series, start + n step.
    ///
    /// # Errors
    /// [`SeriesError`] if `to_s` <= `from_s` or a bound is not finite, if the window reaches beyond the series, and if
    /// it falls between two samples.
    pub fn window(&self, from_s: f64, to_s: f64) -> Result<Self, SeriesError> {
        let samples = self.values.len();
        let window = TimeWindow { from: from_s, to: to_s };
        window.check_inside(self.start_s, self.step_s, samples)?;
        let position = |t: f64| (t - self.start_s) / self.step_s;
        let samples = samples as f64;
        let index = |t: f64| {
            (position(t) - tolerance_steps(self.start_s.abs().max(t.abs()), self.step_s)).ceil().clamp(0.0, samples)
                as usize
        };
        let (first, end) = (index(from_s), index(to_s));
        if first >= end {
            let [from_s, to_s, step_s] = [from_s, to_s, self.step_s].map(Brief);
            return Err(SeriesError(format!(
                "window {from_s} s to {to_s} s holds no sample: the sampling step is {step_s} s"
            )));
        }
        Ok(Self {
            start_s: self.time_s(first),
            step_s: self.step_s,
            unit: self.unit.clone(),
            values: self.values[first..end].to_vec(),
        })
    }

    /// Series on the same instants and in the same unit with other values, as a filter makes it.
    ///
    /// # Errors
    /// As [`TimeSeries::new`]: values empty or not finite.
    pub fn with_values(&self, values: Vec<f64>) -> Result<Self, SeriesError> {
        Self::new(self.start_s, self.step_s, self.unit.clone(), values)
    }
}

/// Equal samples in a row at the largest or smallest value from which they are clipped, and how many times as many as at the next
/// value: a smooth top has two by rounding, that of a quantised sine more, and 1.4 times as many as the next step.
const CLIPPED_RUN: usize = 3;
const RUN_TIMES: usize = 2;
/// The same without a row, and fewest values that the signal takes: pulses between a few levels are not clipped.
const CLIPPED_COUNT: usize = 20;
const COUNT_TIMES: usize = 4;
const CLIPPED_LEVELS: usize = 64;
/// Values as near, over the range, are one: a sine that is sampled again and again at the same phases differs so by rounding.
const SAME_LEVEL: f64 = 1e-9;

impl TimeSeries {
    /// Share of the samples, 0 to 1, at the largest or the smallest value, where three in a row or many lie at one of them, and far fewer at
    /// the next: a converter's range ends there. 0 for a constant signal.
    #[must_use]
    pub(crate) fn clipped_share(&self) -> f64 {
        let values = self.values();
        let mut sorted = values.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let last = sorted.len() - 1;
        let (lowest, highest) = (sorted[0], sorted[last]);
        if lowest >= highest {
            return 0.0;
        }
        let near = SAME_LEVEL * (highest - lowest);
        let levels = sorted.chunk_by(|a, b| b - a <= near).take(CLIPPED_LEVELS).count();
        let at_lowest = sorted.partition_point(|&x| x <= lowest);
        let below_highest = sorted.partition_point(|&x| x < highest);
        let counts = [
            (lowest, at_lowest, sorted.partition_point(|&x| x <= sorted[at_lowest] + near) - at_lowest),
            (
                highest,
                sorted.len() - below_highest,
                below_highest - sorted.partition_point(|&x| x < sorted[below_highest - 1] - near),
            ),
        ];
        let clipped = |(end, count, next): (f64, usize, usize)| {
            let in_a_row = || runs(values).any(|run| run.len() >= CLIPPED_RUN && [end].contains(&run[0]));
            let piled = count >= CLIPPED_COUNT && count >= COUNT_TIMES * next && levels == CLIPPED_LEVELS;
            piled || count >= RUN_TIMES * next && in_a_row()
        };
        if !counts.into_iter().any(clipped) {
            return 0.0;
        }
        (counts[0].1 + counts[1].1) as f64 / values.len() as f64
    }

    /// The longest stretch of equal samples, s; as long as a sample where no two are equal.
    #[must_use]
    pub(crate) fn longest_still(&self) -> TimeWindow {
        let (mut begin, mut longest) = (0, (0, 1));
        for run in runs(self.values()) {
            if run.len() > longest.1 {
                longest = (begin, run.len());
            }
            begin += run.len();
        }
        let (first, count) = longest;
        TimeWindow { from: self.time_s(first), to: self.time_s(first + count) }
    }
}

/// Stretches of equal samples.
fn runs(values: &[f64]) -> impl Iterator<Item = &[f64]> {
    values.chunk_by(|a, b| a.to_bits() == b.to_bits())
}

impl TimeSeries {
    /// Mean value, in the series' unit; the mean of what a first pass left is added, so that the rounding of a long
    /// sum (1e-11 of the mean for 3e5 samples) does not show.
    pub(crate) fn mean(&self) -> f64 {
        let samples = self.values().len() as f64;
        let first = self.values().iter().sum::<f64>() / samples;
        first + self.values().iter().map(|v| v - first).sum::<f64>() / samples
    }

    /// Root mean square of the values as they are, the mean NOT removed: sqrt(1/n sum x_k^2), in the series' unit.
    pub fn rms(&self) -> f64 {
        root_mean_square(self.values())
    }

    /// Largest absolute value, the mean NOT removed, in the series' unit.
    pub(crate) fn peak(&self) -> f64 {
        self.values().iter().fold(0.0, |peak, v| v.abs().max(peak))
    }

    /// Kurtosis after Pearson, mean removed, biased (no small-sample correction):
    /// (1/n sum (x - mean)^4) / (1/n sum (x - mean)^2)^2; dimensionless, >= 1. A normal distribution has 3, a
    /// sinusoid 1.5; repeated impacts of a local defect drive it well above 3. Equal to
    /// `scipy.stats.kurtosis(x, fisher=False)`.
    ///
    /// `None` for a constant signal, whose scatter is zero within rounding.
    pub(crate) fn kurtosis(&self) -> Option<f64> {
        let mean = self.mean();
        let samples = self.values().len() as f64;
        let moment = |power: i32| self.values().iter().map(|v| (v - mean).powi(power)).sum::<f64>() / samples;
        let variance = moment(2);
        // Rounding of the mean alone leaves about (epsilon |mean|)^2 of variance.
        let rounding = (4.0 * f64::EPSILON * self.peak()).powi(2);
        (variance > rounding).then(|| moment(4) / (variance * variance))
    }
}

/// sqrt(1/n sum x_k^2) of a slice; 0 for an empty one.
pub(crate) fn root_mean_square(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(start_s: f64, step_s: f64, samples: usize) -> TimeSeries {
        TimeSeries::new(start_s, step_s, "m", (0..samples).map(|k| k as f64).collect()).expect("a valid ramp")
    }

    #[test]
    fn window_is_half_open_and_adjoining_windows_share_nothing() {
        let series = ramp(0.0, 1e-5, 300_000);
        let first = series.window(2.3, 2.4).expect("inside");
        let second = series.window(2.4, 2.5).expect("inside");
        assert_eq!(first.values().len(), 10_000);
        assert_eq!(first.values().first(), Some(&230_000.0));
        assert_eq!(first.values().last(), Some(&239_999.0));
        assert_eq!(second.values().first(), Some(&240_000.0));
        assert!((first.start_s() - 2.3).abs() < 1e-12);
    }

    #[test]
    fn instants_typed_in_decimal_mean_their_sample() {
        // Of these quotients t / step many lie just above or below a whole number.
        let series = ramp(0.2, 1e-5, 280_000);
        for hundredth in 21..300_u32 {
            let from = f64::from(hundredth) / 100.0;
            let first = series.window(from, 3.0).expect("inside").values()[0];
            assert!((first - 1000.0 * f64::from(hundredth - 20)).abs() < 0.5, "{from} s: sample {first}");
        }
    }

    #[test]
    fn window_may_be_the_whole_series() {
        let series = ramp(-0.3, 0.1, 7);
        let span = series.span();
        assert_eq!(series.window(span.from, span.to).expect("inside"), series);
    }

    /// Seconds since 1970 have steps of 2.4e-7 s, 3e-3 of a sample at 12 kHz.
    #[test]
    fn a_window_may_begin_far_from_the_origin() {
        let series = TimeSeries::new(1.7e9, 1.0 / 12e3, "V", vec![0.0; 120_000]).expect("valid");
        let span = series.span();
        let whole = series.window(span.from, span.to).expect("inside");
        assert_eq!(whole.values().len(), 120_000);
        let part = series.window(1.7e9 + 1.0, 1.7e9 + 2.0).expect("inside");
        assert_eq!(part.values().len(), 12_000);
        assert!(series.window(span.from, span.to + 1e-4).is_err());
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |r: Result<TimeSeries, SeriesError>| r.expect_err("must fail").to_string();
        let series = ramp(1.0, 0.5, 4);
        assert_eq!(message(series.window(2.0, 2.0)), "window must end after it starts, found 2 s to 2 s");
        assert_eq!(
            message(series.window(0.5, 2.0)),
            "window 0.5 s to 2 s is not inside the series, which covers 1 s to 3 s"
        );
        assert_eq!(
            message(series.window(2.0, 3.5)),
            "window 2 s to 3.5 s is not inside the series, which covers 1 s to 3 s"
        );
        assert_eq!(
            message(series.window(1.1, 1.2)),
            "window 1.1 s to 1.2 s holds no sample: the sampling step is 0.5 s"
        );
        assert_eq!(message(series.window(f64::NAN, 1.2)), "window must end after it starts, found NaN s to 1.2 s");
        assert_eq!(
            message(TimeSeries::new(0.0, 0.0, "m", vec![1.0])),
            "sampling step must be positive and finite, found 0 s"
        );
        assert_eq!(
            message(TimeSeries::new(f64::INFINITY, 1.0, "m", vec![1.0])),
            "start of the series must be finite, found inf s"
        );
        assert_eq!(message(TimeSeries::new(0.0, 1.0, "m", vec![])), "series has no samples");
        assert_eq!(
            message(TimeSeries::new(0.0, 0.5, "m", vec![1.0, 2.0, f64::NAN])),
            "sample 2 (t = 1 s) is NaN, not a finite number"
        );
    }
}

#[cfg(test)]
mod flaws_tests {
    use super::*;

    fn series(values: &[f64]) -> TimeSeries {
        TimeSeries::new(1.0, 0.5, "", values.to_vec()).unwrap()
    }

    #[allow(clippy::float_cmp)] // shares of eight samples
    #[test]
    fn clipped_samples_lie_in_a_row_at_an_end_of_the_range() {
        let share = |values: &[f64]| series(values).clipped_share();
        assert_eq!(share(&[0.0, 2.0, 2.0, 2.0, 1.0, -3.0, 0.0, -3.0]), 5.0 / 8.0);
        // two at the top are rounding, three in between no end
        assert_eq!(share(&[0.0, 2.0, 2.0, 1.0, 1.0, 1.0, -3.0, -3.0]), 0.0);
        // a square wave is none; nor is a constant
        assert_eq!(share(&[1.0, -1.0, 1.0, -1.0]), 0.0);
        assert_eq!(share(&[5.0; 8]), 0.0);
    }

    /// What rings near a quarter of the sampling rate has no three samples in a row at an end.
    #[test]
    fn a_pile_at_an_end_of_the_range_is_clipped() {
        let share = |value: &dyn Fn(f64) -> f64| {
            series(&(0..4000).map(f64::from).map(value).collect::<Vec<f64>>()).clipped_share()
        };
        let ringing = |k: f64| (1.0 + 0.5 * (0.0137 * k).sin()) * (1.6 * k).sin();
        assert!(share(&|k| ringing(k)) < 1e-12);
        let clipped = share(&|k| ringing(k).clamp(-1.2, 9.0));
        assert!((0.05..0.2).contains(&clipped), "{clipped}");
        assert!((clipped - share(&|k| (-ringing(k)).min(1.2))).abs() < 1e-12);
        // a converter of eight bits, whose range holds it, and is too small
        assert!(share(&|k| (80.0 * ringing(k)).round()) < 1e-12);
        assert!(share(&|k| (80.0 * ringing(k)).round().min(90.0)) > 0.05);
        // sines, sampled coherently or quantised
        for k_hz in [0.125, 0.01, 0.0025] {
            let sine = |k: f64| (std::f64::consts::TAU * k_hz * k).sin();
            for stored in [|x: f64| x, |x: f64| f64::from(x as f32), |x: f64| (200.0 * x).round()] {
                assert!(share(&|k| stored(sine(k))) < 1e-12, "{k_hz}");
            }
        }
        // a quantised sine has three in a row at its top, pulses stay at theirs
        assert!(share(&|k| (50.0 * (0.02 * k).sin()).round()) < 1e-12);
        assert!(share(&|k| (0.02 * k).sin().signum()) < 1e-12);
        assert!(share(&|k| if k % 10.0 < 1.0 { 1.0 } else { [-1.0, -0.5][k as usize % 2] }) < 1e-12);
    }

    #[allow(clippy::float_cmp)] // times of halves
    #[test]
    fn the_longest_still_stretch_is_found() {
        let still = |values: &[f64]| {
            let window = series(values).longest_still();
            (window.from, window.to)
        };
        assert_eq!(still(&[1.0, 0.0, 0.0, 0.0, 2.0, 2.0]), (1.5, 3.0));
        assert_eq!(still(&[1.0, 2.0]), (1.0, 1.5));
    }
}

#[cfg(test)]
mod statistics_tests {
    use super::*;
    use std::f64::consts::PI;

    fn series(values: Vec<f64>) -> TimeSeries {
        TimeSeries::new(0.0, 1e-3, "m/s^2", values).expect("a valid series")
    }

    #[test]
    fn sinusoid_with_offset() {
        // 20 whole periods: mean 0.5, RMS sqrt(0.25 + 2^2 / 2), peak 2.5, kurtosis 3/2 whatever the offset.
        let x = series((0..1000).map(|k| 0.5 + 2.0 * (2.0 * PI * 0.02 * k as f64).cos()).collect());
        assert!((x.mean() - 0.5).abs() < 1e-13);
        assert!((x.rms() - 2.25_f64.sqrt()).abs() < 1e-13);
        assert!((x.peak() - 2.5).abs() < 1e-13);
        assert!((x.kurtosis().expect("not constant") - 1.5).abs() < 1e-12);
    }

    #[test]
    fn kurtosis_agrees_with_scipy_and_is_three_for_normal() {
        // scipy.stats.kurtosis([1, 2, 2, 3, 9, -4, 0.5], fisher=False)
        let x = series(vec![1.0, 2.0, 2.0, 3.0, 9.0, -4.0, 0.5]);
        let scipy = 3.291_140_518_499_667;
        assert!((x.kurtosis().expect("not constant") - scipy).abs() < 1e-12);
        // Sum of 12 uniform numbers: kurtosis 3 - 6/5/12 = 2.9; the scatter of the estimate is sqrt(24/n) = 0.011.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let x = series((0..200_000).map(|_| (0..12).map(|_| uniform()).sum()).collect());
        assert!((x.kurtosis().expect("not constant") - 2.9).abs() < 0.04);
    }

    #[test]
    fn constant_signal_has_no_kurtosis() {
        assert_eq!(series(vec![0.1; 300_001]).kurtosis(), None);
        assert_eq!(series(vec![0.0; 7]).kurtosis(), None);
    }
}
