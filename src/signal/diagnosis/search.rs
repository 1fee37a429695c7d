//! What verdicts are sought in, and how good a comb there is: its fit, the lines that it explains, its probability by chance.

use rayon::prelude::*;

use super::bands::BandSpectrum;
use super::comb::{Fit, Masked, best_fit};
use super::control::{ByChance, factors};
use super::fault::{Fault, FaultOrders};
use super::known::{KnownLine, Strikes};
use super::line_spectrum::REVOLUTIONS;

/// Bins that the floor of a part's fundamental needs within half of it, to each side.
const FLOOR_BINS: f64 = 8.0;
/// Lowest and highest order of impacts of something else.
pub(super) const UNEXPLAINED_ORDERS: [f64; 2] = [0.3, 16.0];

/// Everything that verdicts are sought in.
pub(super) struct Search<'a> {
    pub(super) spectra: &'a [BandSpectrum],
    /// The low orders of the same envelopes at a finer resolution, for the cage's lines.
    pub(super) fine: &'a [BandSpectrum],
    pub(super) orders: &'a FaultOrders,
    /// Shaft revolutions of the window.
    pub(super) turns: f64,
    pub(super) speed_hz: f64,
    /// Relative uncertainty of the shaft's speed.
    pub(super) speed_error: f64,
}

/// A comb that is the best of its kind, before it is judged.
pub(super) struct Candidate {
    pub(super) fault: Option<Fault>,
    pub(super) fit: Fit,
    /// Reach of its search over its order.
    pub(super) relative_reach: f64,
}

impl Candidate {
    /// A comb of this fault, or of something else, without lines beside its harmonics, at a known place.
    pub(super) fn at(fault: Option<Fault>, fit: Fit) -> Self {
        Self { fault, fit, relative_reach: 0.0 }
    }
}

/// Shaft revolutions that the floor of a part's lines needs.
pub(super) fn turns_needed(order: f64) -> f64 {
    2.0 * FLOOR_BINS / order
}

impl Search<'_> {
    /// The order at which the widest spectrum ends.
    pub(super) fn end(&self) -> f64 {
        let ends = self.spectra.iter().map(|spectrum| spectrum.lines.end());
        ends.fold(1.0, f64::max)
    }

    /// Whether the window has revolutions enough for the floor about an order's lines.
    pub(super) fn can_judge(&self, order: f64) -> bool {
        self.turns >= turns_needed(order)
    }

    pub(super) fn masked(&self, known: &[KnownLine]) -> Vec<Masked<'_>> {
        let taken = |spectrum: &BandSpectrum| vec![false; spectrum.lines.level.len()];
        let spectra = self.spectra.iter();
        spectra.map(|spectrum| Masked { spectrum, taken: taken(spectrum) }.without(known)).collect()
    }

    /// The best comb of a part; lines beside the harmonics count where that scores more.
    pub(super) fn part(&self, masked: &[Masked<'_>], fault: Fault, order: f64) -> Option<Candidate> {
        let relative_reach = self.orders.error(fault) + self.speed_error;
        let reach = relative_reach * order;
        let of = |beside| {
            Some(Candidate { fault: Some(fault), fit: best_fit(masked, order, reach, beside)?, relative_reach })
        };
        let alone = of(None);
        match self.side_spacing(fault) {
            Some(spacing) if fault == Fault::Ball => {
                alone.into_iter().chain(of(Some(spacing))).max_by(|a, b| a.fit.score.total_cmp(&b.fit.score))
            }
            _ => alone,
        }
    }

    /// Lines that a candidate explains.
    pub(super) fn own_lines(&self, candidate: &Candidate, highest: f64) -> Vec<KnownLine> {
        let name = format!("{:.2} Hz", candidate.fit.order * self.speed_hz);
        let strikes = Strikes {
            fault: candidate.fault,
            name: candidate.fault.map_or(&name, |fault| fault.name()),
            order: candidate.fit.order,
        };
        let resolution = self.spectra[candidate.fit.spectrum].lines.resolution;
        strikes.lines(self.orders, self.speed_error, highest, resolution)
    }

    /// Probability by chance of a candidate, its own lines taken out of the controls.
    pub(super) fn chance(&self, masked: &[Masked<'_>], candidate: &Candidate, own: &[KnownLine]) -> Option<f64> {
        let without: Vec<Masked<'_>> = masked.iter().map(|masked| masked.clone().without(own)).collect();
        let fit = candidate.fit;
        let relative_reach = candidate.relative_reach;
        let factors: Vec<f64> = factors(relative_reach).collect();
        let scores = factors.into_par_iter().filter_map(|factor| {
            let at = fit.order * factor;
            best_fit(&without, at, relative_reach * at, fit.beside).map(|fit| fit.score)
        });
        let by_chance = ByChance::of(scores.collect())?;
        let searches = match candidate.fault {
            Some(Fault::Ball) => 2.0,
            Some(_) => 1.0,
            None => (UNEXPLAINED_ORDERS[1] - UNEXPLAINED_ORDERS[0]) * self.turns.min(REVOLUTIONS),
        };
        Some(by_chance.probability(fit.score, searches))
    }
}
