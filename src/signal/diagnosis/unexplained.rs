//! Repeated impacts that belong to no part of the bearing: another bearing, a wrong speed, a gear.

use super::comb::{Fit, Masked, best_fit};
use super::fault::Fault;
use super::known::KnownLine;
use super::search::{Candidate, Search, UNEXPLAINED_ORDERS, turns_needed};
use super::verdict::{Evidence, UnexplainedImpacts};

/// Impacts of something else are said below this probability by chance.
const UNEXPLAINED_BELOW: f64 = 1e-2;
/// Ratios and sums in which orders are related, so that a comb of the one is one of the other's lines.
const RELATED: u32 = 4;
const RELATED_SIDES: i32 = 5;
/// A comb at a part of another's order is the same impacts' where it scores at least this part of the other's score.
const SAME_COMB: f64 = 0.7;
/// And where the teeth between reach this part of the level of those that both have: a race's line has sidebands halfway at times.
const OWN_TEETH: f64 = 0.5;
/// Parts of an order in which its fundamental is sought.
const LOWEST_PART: u32 = 5;

/// Whether a comb has teeth of its own between every so many, which a coarser comb has too.
pub(super) fn has_teeth_between(masked: &[Masked<'_>], fit: &Fit, part: u32) -> bool {
    let lines = &masked[fit.spectrum].spectrum.lines;
    let mean = |shared: bool| {
        let teeth = (1..=lines.harmonics).filter(|k| (k % part == 0) == shared);
        let bins = teeth.filter_map(|k| lines.bin(f64::from(k) * fit.order));
        let levels: Vec<f64> = bins.map(|bin| lines.level[bin] - lines.typical).collect();
        levels.iter().sum::<f64>() / levels.len().max(1) as f64
    };
    mean(false) >= OWN_TEETH * mean(true)
}

impl Search<'_> {
    /// The best comb that is none of a part, of the shaft, or of what an explained part and the shaft or the cage make together.
    pub(super) fn something_else(&self, masked: &[Masked<'_>], explained: &[Fault]) -> Option<Candidate> {
        let [from, to] = UNEXPLAINED_ORDERS;
        let resolution = self.spectra.first()?.lines.resolution;
        let mut best: Option<Fit> = None;
        // so that every place is looked at by one search of half the resolution to each side
        let least = from.max(turns_needed(1.0) / self.turns);
        let mut order = least;
        let fit_at = |order: f64| {
            let fit = best_fit(masked, order, 0.0, None)?;
            (!self.is_related(fit.order, resolution, explained)).then_some(fit)
        };
        while order < to {
            if let Some(fit) = fit_at(order)
                && best.is_none_or(|best| fit.score > best.score)
                && (2..=3).all(|part| has_teeth_between(masked, &fit, part))
            {
                best = Some(fit);
            }
            order += resolution;
        }
        // the harmonics of a harmonic score as much as those of its fundamental
        let lowest = best.and_then(|best| {
            let parts = (2..=LOWEST_PART).rev();
            let mut fits = parts
                .filter(|part| best.order / f64::from(*part) >= least)
                .filter_map(|part| Some((part, fit_at(best.order / f64::from(part))?)));
            let same =
                fits.find(|(part, fit)| fit.score >= SAME_COMB * best.score && has_teeth_between(masked, fit, *part));
            same.map(|(_, fit)| fit)
        });
        lowest.or(best).map(|fit| Candidate::at(None, fit.sharpened(masked)))
    }

    /// Whether an order is one of the shaft's, or one of a part: its first harmonics, and of a ball its spin. Of a part that explains lines also what
    /// it makes with others. A part that explains nothing has no sidebands, and the harmonics of another order that coincide with its own are no
    /// evidence for it.
    pub(super) fn is_related(&self, order: f64, resolution: f64, explained: &[Fault]) -> bool {
        let cage = self.orders.order(Fault::Cage);
        let near = |line: f64, reach: f64| (order - line).abs() < reach + resolution;
        // strong lines of the shaft have feet; half and third revolutions: belts, rubs
        let of_shaft = self.speed_error * order;
        let part = |n: f64| (order * n).round() / n;
        if near(part(1.0), of_shaft + 2.0 * resolution)
            || near(part(2.0), of_shaft)
            || near(part(3.0), of_shaft)
            || cage.is_some_and(|cage| near(1.0 - cage, self.orders.error(Fault::Cage)))
        {
            return true;
        }
        Fault::ALL.into_iter().any(|fault| {
            let Some(part) = self.orders.order(fault) else {
                return false;
            };
            let reach = (self.orders.error(fault) + self.speed_error) * part;
            let of_part = |ratio: f64| near(ratio * part, ratio * reach);
            let spin = fault == Fault::Ball && of_part(0.5);
            if spin || (1..=RELATED).any(|harmonic| of_part(f64::from(harmonic))) {
                return true;
            }
            if !explained.contains(&fault) {
                return false;
            }
            let ratios = (1..=RELATED).flat_map(|i| (2..=RELATED).map(move |j| (i, j)));
            let mut ratios = ratios.map(|(i, j)| f64::from(i) / f64::from(j));
            ratios.any(of_part)
                || (1..=2).any(|harmonic| {
                    (-RELATED_SIDES..=RELATED_SIDES).any(|side| {
                        let (line, side) = (f64::from(harmonic) * part, f64::from(side));
                        let reach = f64::from(harmonic) * reach;
                        // a spectrum folds what lies below zero
                        near((line + side).abs(), reach)
                            || cage.is_some_and(|cage| near((line + side * cage).abs(), reach))
                    })
                })
        })
    }

    /// Impacts of something else, if they are as clear as those of a part have to be.
    pub(super) fn unexplained(
        &self,
        candidate: &Candidate,
        chance: f64,
        known: &[KnownLine],
    ) -> Option<UnexplainedImpacts> {
        let order = candidate.fit.order;
        let harmonics = self.harmonics(&candidate.fit, None, known);
        let band = &self.spectra[candidate.fit.spectrum];
        let evidence = Evidence::of(&harmonics, &band.lines);
        if chance >= UNEXPLAINED_BELOW || !evidence.is_clear() {
            return None;
        }
        Some(UnexplainedImpacts {
            order,
            frequency_hz: order * self.speed_hz,
            false_alarm: chance,
            harmonics_seen: evidence.seen,
            strength_db: evidence.strength_db,
            band_hz: band.band_hz,
        })
    }
}
