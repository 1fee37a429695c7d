//! What verdicts are sought in, and how good a comb there is: its fit, the lines that it explains, its probability by chance.
//!
//! How long a window has to be for a part's lines to be told from the floor and from the shaft's.

use super::bands::BandSpectrum;
use super::comb::{ByChance, Fit, LEAST_FREE, Masked, SHOWN_HARMONICS, best_fit, factors};
use super::fault::{Fault, FaultOrders};
use super::known::{KnownLine, SHORT_WIDTH, STRONG_HALF_WIDTH, Strikes};
use super::line_spectrum::REVOLUTIONS;
use rayon::prelude::*;

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

    /// The same at the order that its lines have in the signal: what is known of others is told by it.
    pub(super) fn measured(&self, masked: &[Masked<'_>], fault: Fault, order: f64) -> Option<Candidate> {
        let best = self.part(masked, fault, order)?;
        Some(Candidate { fit: best.fit.sharpened(masked), ..best })
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

impl FaultOrders {
    /// Revolutions of the shaft that a window needs for a verdict on a part whose order is exact. `None` where its order is not known,
    /// or where its lines lie so close to the shaft's that no window tells them apart.
    pub(crate) fn turns_to_judge(&self, fault: Fault) -> Option<f64> {
        let order = self.order(fault)?;
        let distance = |harmonic: u32| {
            let line = f64::from(harmonic) * order;
            (line - line.round().max(1.0)).abs()
        };
        let mut distances: Vec<f64> = (1..=SHOWN_HARMONICS).map(distance).collect();
        let first = distances[0].max(distances[1]);
        distances.sort_by(|a, b| b.total_cmp(a));
        let least = distances[LEAST_FREE - 1].min(first);
        // of longer windows stretches of 64 revolutions are averaged, which are no finer
        let apart = SHORT_WIDTH * STRONG_HALF_WIDTH / least;
        (apart < 1.5 * REVOLUTIONS).then(|| apart.max(turns_needed(order)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_close_to_the_shafts_need_long_windows() {
        let turns = |order: f64| {
            let orders = FaultOrders::new([Some(order), None, None, None], 0.0).unwrap();
            orders.turns_to_judge(Fault::OuterRace)
        };
        // the second harmonic is 0.09 from the shaft's sixth: 2 / 0.09
        assert!((turns(3.045).unwrap() - 22.2).abs() < 0.1);
        // the third harmonic that is farthest from the shaft's, the fourth: 2 / 0.34
        assert!((turns(3.585).unwrap() - 5.88).abs() < 0.05);
        // the floor decides, 16 / 2.4
        assert!((turns(2.4).unwrap() - 6.67).abs() < 0.01);
        // the ball of 6203: 2 / 0.026
        assert!((turns(3.987).unwrap() - 76.9).abs() < 0.1);
        assert_eq!(turns(3.005), None);
        assert_eq!(turns(4.0), None);
        let orders = FaultOrders::new([None; 4], 0.0).unwrap();
        assert_eq!(orders.turns_to_judge(Fault::OuterRace), None);
    }
}
