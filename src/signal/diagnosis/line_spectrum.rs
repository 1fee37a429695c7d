//! The spectrum of an envelope over the shaft's angle, averaged over stretches of revolutions, against its own floor.

use super::DiagnosisError;
use crate::signal::{Forward, WindowFunction, fast_length, running_median};

/// Revolutions of a stretch whose spectra are averaged. Slip lets the k-th harmonic of a line wander by k times the slip's
/// variation: 0.1 % of the fourth harmonic of an inner race (order 21) is 0.02 orders, a bin of 64 revolutions.
pub(super) const REVOLUTIONS: f64 = 64.0;
/// Bins for each 1 / T.
const PADDING: usize = 2;
/// Bins 1 / T on each side whose median is the floor.
const FLOOR_BINS: f64 = 20.0;
/// Largest power over the floor that counts, as a natural logarithm: 26 dB. A tooth that is higher says no more, or a single line
/// would make a comb.
pub(super) const LARGEST_LEVEL: f64 = 10.0;
/// Harmonics that decide: where slip is averaged over, resonances, filters and slip damp those beyond. A short stretch is coarser than slip
/// spreads them, and needs every one.
const AVERAGED_HARMONICS: u32 = 5;
const SHORT_HARMONICS: u32 = 8;
/// Standard deviations above the mean, by the transform of Wilson and Hilferty, from which a line is called seen: noise does that
/// once in 300 bins, once in a hundred of the places where a tooth may be.
const SEEN_DEVIATIONS: f64 = 2.2;

/// Power of an envelope's lines over their floor, over the order.
#[derive(Debug, Clone)]
pub(super) struct LineSpectrum {
    /// Orders from bin to bin.
    step: f64,
    /// 1 / revolutions of a stretch: lines as far apart are told apart.
    pub(super) resolution: f64,
    /// Natural logarithm of the power over the floor, the largest within half of the resolution; 0 to [`LARGEST_LEVEL`].
    pub(super) level: Vec<f64>,
    /// Power over the floor.
    pub(super) ratio: Vec<f64>,
    /// Amplitude of a line over the mean of the envelope.
    amplitude: Vec<f64>,
    /// Harmonics that decide.
    pub(super) harmonics: u32,
    /// Level of noise, on the average.
    pub(super) typical: f64,
    /// Ratio from which a line is seen.
    seen_ratio: f64,
}

impl LineSpectrum {
    /// Whether it is of one stretch, shorter than those that are averaged.
    pub(super) fn is_short(&self) -> bool {
        self.harmonics == SHORT_HARMONICS
    }

    /// Spectrum of values at equal angles, `per_turn` a revolution, up to an order; amplitudes are those over `scale`.
    ///
    /// Stretches of so many `revolutions` with a Hann window, half of each shared with the next; of fewer than one and a half, the whole.
    pub(super) fn new(
        values: &[f64],
        per_turn: f64,
        highest: f64,
        scale: f64,
        revolutions: f64,
    ) -> Result<Self, DiagnosisError> {
        let all = values.len();
        let stretches = stretches(all as f64 / per_turn, revolutions);
        let (window, harmonics) = if stretches == 1 {
            (half_sine(all), SHORT_HARMONICS)
        } else {
            let length = (revolutions * per_turn).round() as usize;
            (WindowFunction::Hann.samples(length), AVERAGED_HARMONICS)
        };
        let length = window.len();
        let points = fast_length(PADDING * length);
        let plan = Forward::new(points);
        let mean = values.iter().sum::<f64>() / all as f64;
        let step = per_turn / points as f64;
        let bins = ((highest / step) as usize + 2).min(points / 2);
        let mut power = vec![0.0; bins];
        for stretch in 0..stretches {
            let first = (all - length) * stretch / stretches.saturating_sub(1).max(1);
            let part = values[first..first + length].iter().zip(&window);
            let spectrum = plan.transform(part.map(|(value, weight)| (value - mean) * weight))?;
            for (sum, bin) in power.iter_mut().zip(&spectrum) {
                *sum += bin.norm_sqr();
            }
        }
        let resolution = per_turn / length as f64;
        // a Hann window's stretches that share a half are worth 0.75 of as many
        let averages = 1.0 + 0.75 * (stretches - 1) as f64;
        let reach = (FLOOR_BINS * resolution / step).round() as usize;
        let floor = running_median(&power, reach);
        let median = gamma_quantile(averages, 0.0);
        let ratio: Vec<f64> = power
            .iter()
            .zip(&floor)
            .map(|(power, floor)| match floor / median {
                floor if floor > 0.0 => power / floor,
                _ => 0.0,
            })
            .collect();
        let near = |bin: usize| Self::largest(&ratio, bin).max(1.0);
        let level = (0..bins).map(|bin| near(bin).sqrt().min(LARGEST_LEVEL)).collect();
        // of the two or three bins of a tooth the largest: 0.8 deviations above the mean
        let typical = gamma_quantile(averages, 0.8).sqrt();
        // one-sided, and the gain of the window
        let gain = 2.0 / (window.iter().sum::<f64>() * scale);
        let amplitude = power.iter().map(|power| gain * (power / stretches as f64).sqrt()).collect();
        Ok(Self {
            step,
            resolution,
            harmonics,
            level,
            ratio,
            amplitude,
            typical,
            seen_ratio: gamma_quantile(averages, SEEN_DEVIATIONS),
        })
    }

    /// Bin of an order, if it is in the spectrum.
    pub(super) fn bin(&self, order: f64) -> Option<usize> {
        let bin = (order / self.step).round();
        (bin >= 0.0 && bin + 1.0 < self.level.len() as f64).then_some(bin as usize)
    }

    /// Order after its last bin.
    pub(super) fn end(&self) -> f64 {
        self.level.len() as f64 * self.step
    }

    fn largest(values: &[f64], bin: usize) -> f64 {
        let about = &values[bin.saturating_sub(1)..(bin + 2).min(values.len())];
        about.iter().fold(0.0_f64, |most, &value| most.max(value))
    }

    /// Power over the floor, the largest within half of the resolution; 0 outside.
    pub(super) fn ratio(&self, order: f64) -> f64 {
        self.bin(order).map_or(0.0, |bin| Self::largest(&self.ratio, bin))
    }

    /// Power over the floor between two bins; 0 outside.
    pub(super) fn ratio_at(&self, order: f64) -> f64 {
        let place = order / self.step;
        let below = place.floor().max(0.0) as usize;
        match self.ratio.get(below..below + 2) {
            Some(&[a, b]) => a + (place - below as f64) * (b - a),
            _ => 0.0,
        }
    }

    /// Amplitude over the mean of the envelope, the largest within half of the resolution; 0 outside.
    pub(super) fn amplitude(&self, order: f64) -> f64 {
        self.bin(order).map_or(0.0, |bin| Self::largest(&self.amplitude, bin))
    }

    /// Whether noise would have a line as high once in a hundred places.
    pub(super) fn seen(&self, order: f64) -> bool {
        self.ratio(order) > self.seen_ratio
    }
}

/// Half a period of a sine: lines of a short window are 1.2 bins wide by it, in the place of Hann's 1.5, and leak 23 dB lower.
fn half_sine(length: usize) -> Vec<f64> {
    let place = |k: usize| std::f64::consts::PI * (k as f64 + 0.5) / length as f64;
    (0..length).map(|k| place(k).sin()).collect()
}

/// Stretches of so many revolutions that a window of so many `turns` is cut into, each sharing a half with the next; one where
/// there is not enough for one and a half.
pub(super) fn stretches(turns: f64, revolutions: f64) -> usize {
    if turns < 1.5 * revolutions {
        return 1;
    }
    1 + (2.0 * (turns - revolutions) / revolutions).ceil() as usize
}

/// Quantile of the mean of so many exponential variables, at so many standard deviations of the normal distribution: the transform of
/// Wilson and Hilferty (1931), within 2 % for one variable.
pub(super) fn gamma_quantile(averages: f64, deviations: f64) -> f64 {
    (1.0 - 1.0 / (9.0 * averages) + deviations / (3.0 * averages.sqrt())).max(0.0).powi(3)
}
