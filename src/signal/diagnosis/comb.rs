//! A line and its harmonics in a spectrum, together: a comb whose teeth move as one.
//!
//! How good a comb is by chance, measured on the signal itself: the same comb at orders at which nothing is known to strike.

use super::bands::BandSpectrum;
use super::known::{KnownLine, half_width};

/// Harmonics that are shown.
pub(super) const SHOWN_HARMONICS: u32 = 8;
/// Fewest harmonics that coincide with nothing else.
pub(super) const LEAST_FREE: usize = 3;
/// Places of the search in the resolution of the highest deciding harmonic.
const PLACES: f64 = 2.0;

/// A comb where it fits best.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fit {
    /// How far its teeth are above the level of noise, over the root of their number.
    pub(super) score: f64,
    /// Its fundamental.
    pub(super) order: f64,
    /// Which spectrum.
    pub(super) spectrum: usize,
    /// Distance of the lines beside the harmonics, where these count too.
    pub(super) beside: Option<f64>,
}

/// Part of the best score that only round-off is below.
const AS_GOOD: f64 = 1.0 - 1e-9;
/// Places of the search for the most power, in the resolution of the highest harmonic that is shown.
const SHARP_PLACES: f64 = 8.0;

impl Fit {
    /// The same with the order at which its free teeth have most power, of those within half of the resolution that score as much: the level
    /// of a tooth is limited, and the same over half of the resolution, so that strong combs score alike over 0.2 % of their order. The
    /// search takes the lowest of these.
    pub(super) fn sharpened(self, spectra: &[Masked<'_>]) -> Self {
        let masked = &spectra[self.spectrum];
        let lines = &masked.spectrum.lines;
        let free = |tooth: f64| lines.bin(tooth).is_some_and(|bin| !masked.taken[bin]);
        let sides = self.beside.map_or_else(|| vec![0.0], |spacing| vec![-spacing, 0.0, spacing]);
        let teeth = (1..=SHOWN_HARMONICS).flat_map(|k| sides.iter().map(move |side| (f64::from(k), *side)));
        let teeth: Vec<(f64, f64)> = teeth.filter(|(k, side)| free(k * self.order + side)).collect();
        let power = |order: f64| teeth.iter().map(|(k, side)| lines.ratio_at(k * order + side)).sum::<f64>();
        let steps = (0.5 * f64::from(SHOWN_HARMONICS) * SHARP_PLACES) as i32;
        let places =
            (-steps..=steps).map(|step| self.order + 0.5 * lines.resolution * f64::from(step) / f64::from(steps));
        let as_good =
            |order: &f64| score(masked, *order, self.beside).is_some_and(|found| found >= AS_GOOD * self.score);
        let best = places.filter(as_good).max_by(|a, b| power(*a).total_cmp(&power(*b)));
        Self { order: best.unwrap_or(self.order), ..self }
    }
}

/// A spectrum, and which of its bins have a reason already.
#[derive(Clone)]
pub(super) struct Masked<'a> {
    pub(super) spectrum: &'a BandSpectrum,
    pub(super) taken: Vec<bool>,
}

impl Masked<'_> {
    /// The same without the bins of more lines.
    pub(super) fn without(mut self, known: &[KnownLine]) -> Self {
        let lines = &self.spectrum.lines;
        for line in known {
            let half = half_width(lines, line);
            let first = lines.bin((line.order - half).max(0.0));
            let Some(first) = first else { continue };
            let last = lines.bin(line.order + half).unwrap_or(self.taken.len() - 1);
            for bin in first..=last {
                self.taken[bin] |= line.explains(lines, lines.ratio[bin]);
            }
        }
        self
    }
}

/// Score of a comb; `None` where fewer than three harmonics are free, or neither of the first two.
///
/// `sum_k (L_k - typical) / sqrt(n)`, L_k the level of the n teeth that no other reason takes.
fn score(masked: &Masked<'_>, order: f64, beside: Option<f64>) -> Option<f64> {
    let lines = &masked.spectrum.lines;
    let (mut sum, mut count, mut free) = (0.0, 0_u32, 0);
    let mut first = false;
    for harmonic in 1..=lines.harmonics {
        let line = f64::from(harmonic) * order;
        let mut tooth = |order: f64| {
            let bin = lines.bin(order)?;
            if masked.taken[bin] {
                return None;
            }
            sum += lines.level[bin];
            count += 1;
            Some(())
        };
        if tooth(line).is_some() {
            free += 1;
            first |= harmonic <= 2;
        }
        if let Some(spacing) = beside {
            tooth(line - spacing);
            tooth(line + spacing);
        }
    }
    if free < LEAST_FREE || !first {
        return None;
    }
    let count = f64::from(count);
    Some((sum - count * lines.typical) / count.sqrt())
}

/// The best comb within `reach` orders about an order, in all spectra; with a spacing `beside`, every harmonic has a tooth on each
/// side too.
pub(super) fn best_fit(spectra: &[Masked<'_>], order: f64, reach: f64, beside: Option<f64>) -> Option<Fit> {
    let mut best: Option<Fit> = None;
    for (place, masked) in spectra.iter().enumerate() {
        let resolution = masked.spectrum.lines.resolution;
        let reach = reach.max(0.5 * resolution);
        let steps = (reach * f64::from(masked.spectrum.lines.harmonics) * PLACES / resolution).ceil();
        for step in -(steps as i32)..=steps as i32 {
            let at = order + reach * f64::from(step) / steps;
            let Some(score) = score(masked, at, beside) else {
                continue;
            };
            if best.is_none_or(|best| score > best.score) {
                best = Some(Fit { score, order: at, spectrum: place, beside });
            }
        }
    }
    best
}

/// Orders at which the comb is tried.
const CONTROLS: u32 = 400;
/// They lie within this factor of the part's own order, to each side.
const SPREAD: f64 = 2.0;
/// And no nearer to it than this part of it, or twice the reach of its search.
const NEAREST: f64 = 0.03;
/// Fewest controls that a distribution is taken from.
const FEWEST: usize = 40;

/// Distribution of the best score of a search by chance: Gumbel's, since it is the largest of many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ByChance {
    /// Most likely score.
    mode: f64,
    /// Scale.
    pub(super) scale: f64,
}

impl ByChance {
    /// From the scores at control orders: the quartiles decide, so that a few of them that meet lines of something else do not.
    /// `None` for fewer than 40.
    pub(super) fn of(mut scores: Vec<f64>) -> Option<Self> {
        if scores.len() < FEWEST {
            return None;
        }
        scores.sort_by(f64::total_cmp);
        let quantile = |part: f64| scores[(part * (scores.len() - 1) as f64).round() as usize];
        // F = exp(-exp(-z)): z = -ln(-ln F)
        let place = |part: f64| -(-f64::ln(part)).ln();
        let scale = (quantile(0.75) - quantile(0.25)) / (place(0.75) - place(0.25));
        let scale = scale.max(1e-6);
        Some(Self { mode: quantile(0.5) - place(0.5) * scale, scale })
    }

    /// Probability of a score as good or better, in the best of so many searches.
    pub(super) fn probability(&self, score: f64, searches: f64) -> f64 {
        let expected = searches * (-(score - self.mode) / self.scale).exp();
        -(-expected).exp_m1()
    }
}

/// Control orders over the part's own.
pub(super) fn factors(relative_reach: f64) -> impl Iterator<Item = f64> {
    let gap = NEAREST.max(2.0 * relative_reach);
    let span = 2.0 * SPREAD.ln();
    (0..CONTROLS).filter_map(move |control| {
        let part = (f64::from(control) + 0.5) / f64::from(CONTROLS);
        let factor = (span * (part - 0.5)).exp();
        ((factor - 1.0).abs() >= gap).then_some(factor)
    })
}
