//! The shaft's speed, sharpened by the lines that it leaves in a signal and in its envelope.
//!
//! The lines of an inner race that lie beside the shaft's multiples: at BPFI = 4.95 its harmonics and sidebands are a comb at 0.99 of the shaft's.

use super::bands::BandSpectrum;
use super::comb::ByChance;
use super::fault::{Fault, FaultOrders};
use super::line_spectrum::LineSpectrum;
use super::order_spectrum::AngleGrid;
use super::verdict::FaultVerdict;
use super::{Conclusion, DiagnosisError, LEAST_SHORT_HARMONICS};
use crate::numerics::series::TimeSeries;
use crate::signal::WhiteSpectrum;
use schemars::JsonSchema;
use serde::Serialize;

/// Largest relative error of a speed that is looked for: a motor's nominal speed under load.
const LARGEST_ERROR: f64 = 0.03;
/// Relative uncertainty of a speed that the signal does not show.
const UNSEEN_ERROR: f64 = 3e-3;
/// Revolutions of a stretch whose spectra are averaged.
const REVOLUTIONS: f64 = 256.0;
/// Fewest revolutions: the lines of fewer are no sharper than the speed is known.
pub(super) const FEWEST_REVOLUTIONS: f64 = 48.0;
/// Multiples of the shaft's order that are looked at.
const MULTIPLES: u32 = 12;
/// Places of the search in the resolution of the highest multiple.
const PLACES: f64 = 3.0;
/// Factors of the speed at which the same comb is tried for what it scores by chance lie between these.
const CONTROLS: [f64; 2] = [0.4, 2.6];
/// Probability by chance below which the lines are the shaft's.
const SEEN_BELOW: f64 = 0.02;
/// A speed that is so many times its uncertainty away from the given one is clearly another.
const CLEARLY: f64 = 2.0;
/// Combs that score this part of the best are as good: they bound the uncertainty.
const AS_GOOD: f64 = 0.9;

/// Probability by chance below which a race's order is certain, indicated or not.
const CERTAIN_BELOW: f64 = 1e-6;
/// Orders of both races sum up to the number of balls within this part of it: printed orders are rounded.
const WHOLE: f64 = 5e-3;

/// Harmonics of one line among which the orders of two races are looked for.
const HARMONICS_OF_ONE: u32 = 5;

/// How well the shaft's speed is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub enum SpeedSource {
    /// Exactly: a simulation's.
    #[serde(rename = "exact")]
    Exact,
    /// As given, and the signal's own lines do not show it better.
    #[serde(rename = "given")]
    Given,
    /// As given, sharpened by the shaft's lines in the signal.
    #[serde(rename = "shaft lines")]
    Sharpened,
    /// The same, and lines stand halfway between them: the shaft may turn half as fast.
    #[serde(rename = "shaft lines, perhaps every second")]
    EverySecond,
    /// The same, and only even multiples of the speed stand out: the shaft may turn twice as fast.
    #[serde(rename = "shaft lines, even ones only")]
    EvenOnly,
    /// As given, sharpened by the lines of both races, `BPFO + BPFI = N`.
    #[serde(rename = "lines of both races")]
    Races,
}

impl SpeedSource {
    /// In words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Given => "as given: the signal's lines do not confirm it",
            Self::Sharpened => "by the shaft's lines",
            Self::EverySecond => "by the shaft's lines, of which it may be every second",
            Self::EvenOnly => "by the shaft's lines, even multiples alone",
            Self::Races => "by the lines of both races",
        }
    }
}

/// The shaft's speed over the given one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ShaftSpeed {
    /// Over the speed that was given.
    pub(super) factor: f64,
    /// Relative uncertainty.
    pub(super) error: f64,
    pub(super) source: SpeedSource,
}

impl ShaftSpeed {
    /// The speed as given, sharpened by the comb of the shaft's multiples in the spectra of the signal and of its envelope within a band
    /// (Hz). As given where the window is short or the lines do not show: those among them that are no part's at a speed nearby, as every
    /// third is at BPFO = 3.05.
    pub(super) fn of(
        signal: &TimeSeries,
        white: &WhiteSpectrum,
        grid: &AngleGrid,
        within_hz: [f64; 2],
        orders: &FaultOrders,
    ) -> Result<Self, DiagnosisError> {
        let given = Self { factor: 1.0, error: UNSEEN_ERROR, source: SpeedSource::Given };
        if orders.is_exact() {
            return Ok(Self { error: 0.0, source: SpeedSource::Exact, ..given });
        }
        if grid.turns() < FEWEST_REVOLUTIONS {
            return Ok(given);
        }
        let highest = (f64::from(MULTIPLES) + 1.0) * CONTROLS[1];
        let spectrum = |start_s: f64, step_s: f64, values: &[f64]| {
            let means = grid.means(start_s, step_s, values);
            LineSpectrum::new(&means, grid.per_turn, highest, 1.0, REVOLUTIONS)
        };
        let envelope = white.whitened.envelope(within_hz);
        let spectra = [
            spectrum(signal.start_s(), signal.step_s(), signal.values())?,
            spectrum(envelope.start_s, envelope.step_s, &envelope.magnitude())?,
        ];
        let resolution = spectra[0].resolution;
        let level = |line: f64| {
            let levels = spectra.iter().map(move |spectrum| {
                let level = spectrum.bin(line).map(|bin| spectrum.level[bin]);
                level.unwrap_or(0.0)
            });
            levels.sum::<f64>()
        };
        let score = |order: f64, teeth: &[f64]| {
            let teeth = teeth.iter().map(|tooth| level(tooth * order));
            teeth.sum::<f64>()
        };
        let step = resolution / (f64::from(MULTIPLES) * PLACES);
        let best = |centre: f64, teeth: &[f64], reach: f64| {
            let steps = (reach * centre / step).ceil();
            let places = -(steps as i32)..=steps as i32;
            let fits = places.map(|place| {
                let order = centre * (1.0 + reach * f64::from(place) / steps);
                (score(order, teeth), order)
            });
            let fits: Vec<(f64, f64)> = fits.collect();
            let most = fits.iter().fold(0.0_f64, |most, fit| most.max(fit.0));
            // the middle of those that are about as good, and how far they reach
            let near = fits.iter().filter(|fit| fit.0 >= AS_GOOD * most);
            let (low, high) = near.fold((f64::INFINITY, 0.0_f64), |(low, high), fit| (low.min(fit.1), high.max(fit.1)));
            (most, low, high)
        };
        // probability that chance finds as good a comb in as wide a search
        let chance = |most: f64, teeth: &[f64], reach: f64| {
            let scores = controls().map(|centre| best(centre, teeth, reach).0);
            ByChance::of(scores.collect()).map_or(1.0, |by_chance| by_chance.probability(most, 1.0))
        };
        let fit = |teeth: &[f64]| {
            let highest_tooth = teeth.last()?;
            let (most, low, high) = best(1.0, teeth, LARGEST_ERROR);
            let error = (0.5 * (high - low)).max(resolution / highest_tooth);
            let factor = 0.5 * (low + high);
            // lines that leave more room than the given speed has do not sharpen it, unless it is clearly another
            let sharper = error < UNSEEN_ERROR || (factor - 1.0).abs() > CLEARLY * error;
            let clear = sharper && high - low < LARGEST_ERROR;
            (clear && chance(most, teeth, LARGEST_ERROR) < SEEN_BELOW).then_some((factor, error))
        };
        let seen =
            |centre: f64, teeth: &[f64], reach: f64| chance(best(centre, teeth, reach).0, teeth, reach) < SEEN_BELOW;
        // every multiple together is sharpest, where those show too that no part's lines can be taken for
        let free = free_multiples(orders);
        let every: Vec<f64> = (1..=MULTIPLES).map(f64::from).collect();
        let moves = |factor: f64| (factor - 1.0).abs() > UNSEEN_ERROR;
        // a strong line of the shaft at the given speed reaches a little farther than it should
        let better =
            |factor: f64, error: f64| AS_GOOD * best(factor, &free, error).0 > best(1.0, &free, UNSEEN_ERROR).0;
        let shown = fit(&every)
            .filter(|&(factor, error)| seen(factor, &free, error) && (!moves(factor) || better(factor, error)));
        let Some((factor, error)) = shown.or_else(|| fit(&free)) else {
            return Ok(given);
        };
        let moved = moves(factor);
        let errors = [UNSEEN_ERROR, LARGEST_ERROR];
        if moved && inner_race_explains_more(orders, errors, best(factor, &every, error).0, &every, step, &level) {
            return Ok(given);
        }
        let halves: Vec<f64> = every.iter().map(|tooth| tooth - 0.5).collect();
        let source = if seen(1.0, &halves, LARGEST_ERROR) {
            SpeedSource::EverySecond
        } else if seen(2.0 * factor, &every, error) && !seen(2.0 * factor, &halves, error) {
            SpeedSource::EvenOnly
        } else {
            SpeedSource::Sharpened
        };
        Ok(Self { factor, error, source })
    }
}

/// Multiples of the shaft's order that are no part's line at a speed within the largest error.
fn free_multiples(orders: &FaultOrders) -> Vec<f64> {
    let parts = [Fault::OuterRace, Fault::InnerRace, Fault::Ball];
    let parts: Vec<f64> = parts.iter().filter_map(|&part| orders.order(part)).collect();
    let free = |multiple: &f64| {
        let nearest = |part: &f64| (multiple / part).round().max(1.0) * part;
        let mut parts = parts.iter();
        parts.all(|part| (multiple / nearest(part) - 1.0).abs() > LARGEST_ERROR)
    };
    (1..=MULTIPLES).map(f64::from).filter(free).collect()
}

/// Orders, related to no simple ratio of the shaft's, at which its comb is tried for what it scores by chance.
fn controls() -> impl Iterator<Item = f64> {
    let simple = [0.5, 2.0 / 3.0, 1.0, 1.5, 2.0];
    let centres = std::iter::successors(Some(CONTROLS[0]), |centre| Some(centre * (1.0 + 0.5 * LARGEST_ERROR)));
    let centres = centres.take_while(|centre| *centre < CONTROLS[1]);
    centres.filter(move |centre| {
        let related = |ratio: &f64| (centre / ratio - 1.0).abs() < 2.0 * LARGEST_ERROR;
        !simple.iter().any(related)
    })
}

/// Sharpens the speed by the orders at which both races were found, where both are certain. The inner race turns past the cage by what the
/// cage lacks of a revolution of the shaft, so that `BPFO + BPFI = N` whatever the cage slips.
pub(super) fn speed_of_races(
    faults: &[FaultVerdict],
    orders: &FaultOrders,
    spectra: &[BandSpectrum],
) -> Option<ShaftSpeed> {
    let balls = orders.order(Fault::OuterRace)? + orders.order(Fault::InnerRace)?;
    let off = balls / balls.round() - 1.0;
    if off.abs() > WHOLE {
        return None;
    }
    let found = |fault: Fault| {
        let verdict = faults.iter().find(|verdict| verdict.fault == fault)?;
        let certain = verdict.conclusion == Conclusion::Named || verdict.false_alarm.is_some_and(|p| p < CERTAIN_BELOW);
        let seen = verdict.harmonics_seen >= LEAST_SHORT_HARMONICS;
        verdict.order.filter(|_| certain && seen)
    };
    let (outer, inner) = (found(Fault::OuterRace)?, found(Fault::InnerRace)?);
    let lines = &spectra.first()?.lines;
    let of_a_race = lines.resolution / f64::from(lines.harmonics);
    if share_a_fundamental(outer, inner, 2.0 * of_a_race) {
        return None;
    }
    let error = std::f64::consts::SQRT_2 * of_a_race / balls.round();
    (error < UNSEEN_ERROR).then_some(ShaftSpeed {
        factor: (outer + inner) / balls.round(),
        error,
        source: SpeedSource::Races,
    })
}

/// Whether two orders, each known to `error`, may be harmonics of one line: of one race where the shaft turns at a fraction of the given speed.
pub(super) fn share_a_fundamental(outer: f64, inner: f64, error: f64) -> bool {
    (1..=HARMONICS_OF_ONE).any(|k| {
        let k = f64::from(k);
        let fundamental = outer / k;
        let nearest = (inner / fundamental).round();
        nearest <= f64::from(HARMONICS_OF_ONE) && (inner - nearest * fundamental).abs() <= error * (1.0 + nearest / k)
    })
}

/// Harmonics of the race, and sidebands on each side of one, that are looked for.
const HARMONICS: u32 = 2;
const SIDEBANDS: f64 = 3.0;
/// Times the shaft's comb that the race's lines have to score. The largest of 53 measured bearings whose shaft is known to turn at another speed
/// than the given one is 0.85 (0.86 to 0.97 where its lines are blurred); made inner races of four bearings score 1.07 to 1.57.
const BETTER: f64 = 1.05;

/// Whether the lines of these orders' inner race explain more of the `level` of an order than the comb of these multiples of the shaft at
/// another speed does, which scores `shafts`. The race turns at the given speed, whose relative uncertainty is the first of two errors; none
/// of its lines is farther from a multiple that it is taken for than the second, relative. Speeds are tried `step` apart.
pub(super) fn inner_race_explains_more(
    orders: &FaultOrders,
    [speed_error, farthest]: [f64; 2],
    shafts: f64,
    multiples: &[f64],
    step: f64,
    level: &impl Fn(f64) -> f64,
) -> bool {
    let (Some(order), Some(highest)) = (orders.order(Fault::InnerRace), multiples.last()) else {
        return false;
    };
    let step_of_order = 0.5 * step * highest / order;
    around(speed_error, step).any(|speed| {
        around(orders.error(Fault::InnerRace), step_of_order).any(|factor| {
            let lines = multiples.iter();
            let lines = lines.map(|&multiple| nearest(multiple, factor * order, farthest));
            lines.map(|line| level(speed * line)).sum::<f64>() > BETTER * shafts
        })
    })
}

/// The line of a race of this order that may be taken for a multiple of the shaft's, with the fewest sidebands between; the multiple itself
/// where there is none within the relative distance `farthest`.
fn nearest(multiple: f64, order: f64, farthest: f64) -> f64 {
    let lines = (1..=HARMONICS).map(|harmonic| {
        let carrier = f64::from(harmonic) * order;
        let sideband = (multiple - carrier).round();
        (carrier + sideband, sideband.abs())
    });
    let near = lines.filter(|(line, sideband)| *sideband <= SIDEBANDS && (line - multiple).abs() < farthest * multiple);
    let nearest = near.min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map_or(multiple, |(line, _)| line)
}

/// Factors within `reach` of 1, at most `step` apart.
fn around(reach: f64, step: f64) -> impl Iterator<Item = f64> {
    let steps = (reach / step).ceil().max(1.0);
    let places = -(steps as i32)..=steps as i32;
    places.map(move |place| 1.0 + reach * f64::from(place) / steps)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    /// BPFI = 4.95: sidebands of the first harmonic up to the seventh multiple, of the second from the eighth on.
    #[test]
    fn the_lines_beside_the_shafts_multiples() {
        let expected = [1.0, 1.95, 2.95, 3.95, 4.95, 5.95, 6.95, 7.9, 8.9, 9.9, 10.9, 11.9];
        for (multiple, expected) in (1..=12).zip(expected) {
            let line = nearest(f64::from(multiple), 4.95, 0.03);
            assert!((line - expected).abs() < 1e-12, "{multiple}: {line}");
        }
        // none of its lines is near a multiple
        assert!((nearest(5.0, 5.42, 0.03) - 5.0).abs() < 1e-12);
    }
}
