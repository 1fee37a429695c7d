//! Power of an envelope over the order in stretches of a window, in its own unit: what two signals are compared by.

use super::DiagnosisError;
use super::line_spectrum::gamma_quantile;
use crate::signal::{Forward, WindowFunction, fast_length, running_median};

/// Longest stretch, in revolutions: as that of the verdicts' spectra.
const LONGEST: f64 = 64.0;
/// Shortest stretch for whose sake a window is cut into several.
const SHORTEST: f64 = 32.0;
/// Length of a window in stretches: four that share their halves.
const WANTED: f64 = 2.5;
/// Bins for each 1 / T.
const PADDING: usize = 4;
/// Bins 1 / T on each side whose median is the floor.
const FLOOR_BINS: f64 = 20.0;
/// A Hann window's noise bandwidth in bins 1 / T.
const NOISE_BANDWIDTH: f64 = 1.5;

/// Revolutions of the stretches that windows are cut into, the same in all: enough for four of them in the shortest of `turns`
/// revolutions, between 32 and 64; the whole of a shorter one.
pub(super) fn stretch_revolutions(turns: f64) -> f64 {
    let wanted = (turns / WANTED).clamp(SHORTEST, LONGEST);
    if count(turns, wanted) < 2 { turns } else { wanted }
}

/// Stretches that share a half with the next at most.
fn count(turns: f64, revolutions: f64) -> usize {
    1 + (2.0 * (turns - revolutions) / revolutions + 1e-6).max(0.0) as usize
}

/// Spectra of the stretches of a window, one-sided: the sum of the bins about a line is its mean square.
#[derive(Debug, Clone)]
pub(super) struct StretchSpectrum {
    /// Orders from bin to bin.
    step: f64,
    /// 1 / revolutions of a stretch.
    pub(super) resolution: f64,
    /// Of each stretch, the sum of its bins below each.
    sums: Vec<Vec<f64>>,
    /// The same of the mean of all stretches.
    mean: Vec<f64>,
    /// The same of the floor: the running median of that mean, as a mean of noise.
    floor: Vec<f64>,
}

impl StretchSpectrum {
    /// Spectra of values at equal angles, `per_turn` a revolution, up to an order, in stretches of so many revolutions (Hann).
    pub(super) fn new(values: &[f64], per_turn: f64, highest: f64, revolutions: f64) -> Result<Self, DiagnosisError> {
        let all = values.len();
        let length = ((revolutions * per_turn).round() as usize).clamp(1, all);
        let stretches = count(all as f64, length as f64);
        let window = WindowFunction::Hann.samples(length);
        let points = fast_length(PADDING * length);
        let plan = Forward::new(points);
        let step = per_turn / points as f64;
        let bins = ((highest / step) as usize + 2).min(points / 2);
        let average = values.iter().sum::<f64>() / all as f64;
        let weight: f64 = window.iter().map(|w| w * w).sum();
        let scale = 2.0 / (points as f64 * weight).max(f64::MIN_POSITIVE);
        let mut mean = vec![0.0; bins];
        let mut sums = Vec::with_capacity(stretches);
        for stretch in 0..stretches {
            let first = (all - length) * stretch / stretches.saturating_sub(1).max(1);
            let part = values[first..first + length].iter().zip(&window);
            let spectrum = plan.transform(part.map(|(value, w)| (value - average) * w))?;
            let power = spectrum.iter().take(bins).map(|bin| scale * bin.norm_sqr());
            let power: Vec<f64> = power.collect();
            for (mean, power) in mean.iter_mut().zip(&power) {
                *mean += power / stretches as f64;
            }
            sums.push(running_sum(&power));
        }
        let resolution = per_turn / length as f64;
        let reach = (FLOOR_BINS * resolution / step).round() as usize;
        // stretches that share a half are worth 0.95 of as many, and of those of a Hann window no two are alike by more than a 36th
        let median = gamma_quantile(stretches as f64, 0.0);
        let floor = running_median(&mean, reach);
        let floor: Vec<f64> = floor.iter().map(|floor| floor / median).collect();
        Ok(Self { step, resolution, sums, mean: running_sum(&mean), floor: running_sum(&floor) })
    }

    pub(super) fn stretches(&self) -> usize {
        self.sums.len()
    }

    /// Order after the last bin.
    pub(super) fn end(&self) -> f64 {
        (self.mean.len() - 1) as f64 * self.step
    }

    /// The bins about an order, to each side by `half` of a width.
    pub(super) fn bins(&self, order: f64, half: f64) -> Option<[usize; 2]> {
        let first = ((order - half) / self.step).round();
        let end = ((order + half) / self.step).round() + 1.0;
        (first >= 1.0 && end < self.mean.len() as f64).then_some([first as usize, end as usize])
    }

    /// Mean square in some bins, on the average of all stretches.
    pub(super) fn power(&self, [first, end]: [usize; 2]) -> f64 {
        self.mean[end] - self.mean[first]
    }

    /// Mean square of the floor in some bins.
    pub(super) fn floor(&self, [first, end]: [usize; 2]) -> f64 {
        self.floor[end] - self.floor[first]
    }

    /// Mean square in some bins of one stretch.
    pub(super) fn power_of(&self, stretch: usize, [first, end]: [usize; 2]) -> f64 {
        self.sums[stretch][end] - self.sums[stretch][first]
    }

    /// How many independent values of noise so many bins have.
    pub(super) fn independent(&self, [first, end]: [usize; 2]) -> f64 {
        ((end - first) as f64 * self.step / (NOISE_BANDWIDTH * self.resolution)).max(1.0)
    }

    /// Relative variance of the floor in the bins of one line.
    pub(super) fn floor_variance(&self) -> f64 {
        let independent = 2.0 * FLOOR_BINS / NOISE_BANDWIDTH * self.stretches() as f64;
        // the median of exponential variables: 1 / (n ln^2 2)
        1.0 / (independent * std::f64::consts::LN_2.powi(2))
    }
}

/// Sums of the values before each, and of all.
fn running_sum(values: &[f64]) -> Vec<f64> {
    let sums = values.iter().scan(0.0, |sum, value| {
        *sum += value;
        Some(*sum)
    });
    std::iter::once(0.0).chain(sums).collect()
}
