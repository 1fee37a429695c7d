//! The power of a comb of lines in the squared envelope of a band, with its scatter.

use super::comb::{ByChance, factors};
use super::known::KnownLine;
use super::ratio_interval::Scattered;
use super::stretch_spectrum::StretchSpectrum;

/// Half of a tooth's width in 1 / T: a Hann window's line has its first zeros there.
const HALF_WIDTH: f64 = 2.0;
/// What slip adds to it, of the tooth's order: slip that varies by 0.1 % within the window.
const SLIP: f64 = 1e-3;
/// Part of that width in which a line is sought: within all of it, its place would not be known.
const SOUGHT_WIDTH: f64 = 0.5;
/// Distance of a known line from a tooth's edge, in 1 / T, from which it adds nothing to it.
const APART: f64 = 1.5;
/// Amplitude of a tooth over the floor, a, counts as a / (1 + a / 10) in the search: no single line makes a comb, and no two places tie.
const LARGEST_LEVEL: f64 = 10.0;
/// Places of the search in the resolution of the highest tooth.
const PLACES: f64 = 2.0;
/// Variance of a line's power in one stretch over its square, where no stretches can be compared: one for a line that is noise itself, none
/// for one that never changes. Measured lines lie between.
const LINE_VARIANCE: f64 = 0.15;
/// Degrees of freedom that this is worth beside those of the stretches.
const LINE_FREEDOM: f64 = 2.0;
/// Degrees of freedom of what the two amount to, beside those of the stretches: the expected variance does not scatter.
const EXPECTED_FREEDOM: f64 = 4.0;
/// The variance of the mean of stretches that share their halves is larger by this than that of so many separate ones: 1.056 of noise under Hann
/// windows; lines whose slip and strength drift are more alike.
const SHARED: f64 = 1.4;

/// A tooth of a comb: so many times its order, and an order beside that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tooth {
    pub(super) harmonic: u32,
    pub(super) beside: f64,
}

impl Tooth {
    fn order(self, fundamental: f64) -> f64 {
        f64::from(self.harmonic) * fundamental + self.beside
    }
}

/// A comb where it fits best in a spectrum.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Comb {
    pub(super) order: f64,
    /// Places in the list of teeth of those that no multiple of the shaft covers.
    pub(super) free: Vec<usize>,
    score: f64,
}

impl StretchSpectrum {
    fn half(&self, order: f64) -> f64 {
        HALF_WIDTH * self.resolution + SLIP * order
    }

    fn covered(&self, order: f64, known: &[KnownLine]) -> bool {
        let reach = self.half(order) + APART * self.resolution;
        known.iter().any(|line| (line.order - order).abs() < reach + line.error * line.order)
    }

    /// The comb of `teeth` whose teeth stand highest above their floor, a strong one counting tenfold at most, within a reach about an
    /// order.
    pub(super) fn best_comb(&self, teeth: &[Tooth], [sought, reach]: [f64; 2], known: &[KnownLine]) -> Option<Comb> {
        let last = teeth.iter().map(|tooth| tooth.harmonic).max()?;
        let reach = reach.max(0.5 * self.resolution);
        let steps = (reach * f64::from(last) * PLACES / self.resolution).ceil();
        let mut best: Option<Comb> = None;
        for step in -(steps as i32)..=steps as i32 {
            let order = sought + reach * f64::from(step) / steps;
            let mut free = Vec::new();
            let mut sum = 0.0;
            for (place, tooth) in teeth.iter().enumerate() {
                let line = tooth.order(order);
                let Some(bins) = self.bins(line, SOUGHT_WIDTH * self.half(line)) else {
                    continue;
                };
                if self.covered(line, known) {
                    continue;
                }
                let floor = self.floor(bins).max(f64::MIN_POSITIVE);
                let amplitude = (self.power(bins) / floor).sqrt();
                sum += amplitude / (1.0 + amplitude / LARGEST_LEVEL) - 1.0;
                free.push(place);
            }
            if free.is_empty() {
                continue;
            }
            let score = sum / (free.len() as f64).sqrt();
            if best.as_ref().is_none_or(|best| score > best.score) {
                best = Some(Comb { order, free, score });
            }
        }
        best
    }

    /// Probability that chance makes as good a comb beside what is `known`, its own lines among it: by the same search at other orders.
    pub(super) fn chance(&self, teeth: &[Tooth], sought: [f64; 2], comb: &Comb, known: &[KnownLine]) -> f64 {
        let scores = factors(sought[1] / sought[0]).filter_map(|factor| {
            let other = sought.map(|order| order * factor);
            self.best_comb(teeth, other, known).map(|comb| comb.score)
        });
        ByChance::of(scores.collect()).map_or(1.0, |chance| chance.probability(comb.score, 1.0))
    }

    /// Power of some teeth of a comb, all together, with its scatter.
    ///
    /// The variance of the mean of the stretches is that of their scatter and that which lines of an expected variance in this
    /// floor would have, each weighed by its degrees of freedom.
    pub(super) fn comb_power(&self, teeth: &[Tooth], order: f64) -> Option<Scattered> {
        let bins: Vec<[usize; 2]> = teeth
            .iter()
            .filter_map(|tooth| {
                let line = tooth.order(order);
                self.bins(line, self.half(line))
            })
            .collect();
        if bins.is_empty() {
            return None;
        }
        let (mut power, mut floor, mut expected, mut floor_square) = (0.0, 0.0, 0.0, 0.0);
        for &bins in &bins {
            let (all, noise) = (self.power(bins), self.floor(bins));
            let line = (all - noise).max(0.0);
            power += all;
            floor += noise;
            floor_square += noise * noise;
            expected += LINE_VARIANCE * line * line + (2.0 * line * noise + noise * noise) / self.independent(bins);
        }
        if power <= 0.0 {
            return None;
        }
        let count = self.stretches() as f64;
        let deviation = |stretch: usize| {
            let of_stretch: f64 = bins.iter().map(|&bins| self.power_of(stretch, bins)).sum();
            (of_stretch - power).powi(2)
        };
        let squares: f64 = (0..self.stretches()).map(deviation).sum();
        let freedom = count - 1.0 + LINE_FREEDOM;
        let of_one = (squares + LINE_FREEDOM * expected) / freedom;
        let shared = if count > 1.0 { SHARED } else { 1.0 };
        Some(Scattered {
            power,
            variance: shared * of_one / (count * power * power),
            freedom: count - 1.0 + EXPECTED_FREEDOM,
            floor,
            floor_variance: self.floor_variance() * floor_square / (floor * floor).max(f64::MIN_POSITIVE),
        })
    }
}
