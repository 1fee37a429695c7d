//! A ball that shows by the lines of the cage.
//!
//! A flaw on a ball meets the races only where the ball's axis of spin lets it, and that axis wanders: the lines of the ball itself smear, often
//! beyond recognition. What stays is that one ball of all differs, and it passes the load once a revolution of the cage. Of the
//! records of seeded faults that Smith and Randall (Mech. Syst. Signal Process. 64-65 (2015) 100-131) grade, those of balls have the
//! cage's harmonics and hardly any of the ball's.

use super::comb::{Masked, best_fit};
use super::fault::Fault;
use super::known::{KnownLine, Strikes, shaft_lines};
use super::search::{Candidate, Search};
use super::unexplained::has_teeth_between;
use super::verdict::{
    BALL_BY_CAGE_BELOW, CageLines, Conclusion, Evidence, FaultVerdict, LEAST_CAGE_LINES_DB, LEAST_HARMONICS,
    LEAST_STRENGTH_DB, NAMED_BELOW, UnexplainedImpacts, probability,
};

/// A race whose lines are by so many dB stronger than the cage's explains these.
const RACE_OVER_CAGE_DB: f64 = 2.0;

/// Orders at which cages of ball bearings turn, `(1 - gamma) / 2`: gamma is 0.08 to 0.4.
const CAGE_ORDERS: [f64; 2] = [0.3, 0.46];

/// Multiples of the cage's order at which something else may strike.
const MOST_MULTIPLE: u32 = 4;

/// Share of clipped samples from which the cage's lines indicate no ball. Of 79 measured records, each clipped at 1.5, 2 and 2.5
/// standard deviations, these lines named a ball 40 times, 5 of them wrongly; other lines named 100 parts, all rightly.
const MOST_CLIPPED: f64 = 0.01;

/// Takes the indication of a ball by the lines of the cage back where so large a share of the samples is clipped: the largest impacts of
/// a race lose their height, and what is left changes with the load.
pub(super) fn doubt_clipped(faults: &mut [FaultVerdict], share: f64) {
    let by_cage = |verdict: &&mut FaultVerdict| verdict.conclusion == Conclusion::Named && verdict.cage_lines.is_some();
    if share >= MOST_CLIPPED {
        faults.iter_mut().filter(by_cage).for_each(|verdict| {
            let reason = format!(
                "{:.0} % of the samples are clipped, which makes such lines of damage of a race as well: record with a larger range.",
                100.0 * share
            );
            verdict.revise(Conclusion::NotEnough, reason);
        });
    }
}

impl Search<'_> {
    /// Indicates a ball by the lines of the cage, where no other part shows as clearly: a flaw on a race is struck harder by a ball that
    /// differs, once a revolution of the cage as well.
    pub(super) fn judge_balls_by_cage_lines(&self, faults: &mut [FaultVerdict], unexplained: &[UnexplainedImpacts]) {
        let Some(lines) = self.cage_lines(unexplained) else {
            return;
        };
        let clearest = LEAST_STRENGTH_DB.min(lines.strength_db + RACE_OVER_CAGE_DB);
        let clearer = |verdict: &FaultVerdict| {
            let certain = verdict.false_alarm.is_some_and(|p| p < NAMED_BELOW);
            let strong = verdict.strength_db.is_some_and(|db| db >= clearest);
            verdict.conclusion == Conclusion::Named || verdict.fault != Fault::Cage && certain && strong
        };
        if faults.iter().any(clearer) {
            return;
        }
        for verdict in faults.iter_mut() {
            match verdict.fault {
                Fault::Ball => {
                    verdict.why.clear();
                    let reason = format!(
                        "{} harmonics of the cage's line stand out by {:.0} dB on the average; probability by chance {}. One ball differs from the others, by damage or size, unless something else of the machine turns or strikes at this order: a belt, another shaft, a rub. Its own lines need not show, since its axis of spin wanders.",
                        lines.harmonics_seen,
                        lines.strength_db,
                        probability(lines.false_alarm)
                    );
                    verdict.revise(Conclusion::Named, reason);
                    verdict.false_alarm = Some(lines.false_alarm);
                    verdict.strength_db = Some(lines.strength_db);
                    verdict.cage_lines = Some(lines.clone());
                }
                Fault::Cage if verdict.conclusion != Conclusion::Named => {
                    verdict.why.clear();
                    let reason =
                        "Its lines are there. A ball that differs from the others makes them too, and is likelier.";
                    verdict.revise(Conclusion::NotEnough, reason.to_owned());
                }
                Fault::OuterRace | Fault::InnerRace | Fault::Cage => {}
            }
        }
    }

    /// The lines of the cage in the fine spectra, if they are clear beside those of impacts of no part.
    fn cage_lines(&self, unexplained: &[UnexplainedImpacts]) -> Option<CageLines> {
        let order = self.orders.order(Fault::Cage)?;
        if !self.can_judge(order) {
            return None;
        }
        let fine = self.fine_search();
        let mut known = shaft_lines(fine.end(), self.speed_error);
        let resolution = fine.spectra.first()?.lines.resolution;
        for impacts in unexplained {
            let strikes = Strikes { fault: None, name: "impacts of no part", order: impacts.order };
            known.extend(strikes.lines(self.orders, self.speed_error, fine.end(), resolution));
        }
        let masked = fine.masked(&known);
        let best = fine.part(&masked, Fault::Cage, order)?;
        fine.clear_cage_lines(&masked, &known, &best)
    }

    /// The lines of a cage of another bearing: a comb where cages turn, and this bearing's does not.
    pub(super) fn other_cage_lines(&self) -> Option<UnexplainedImpacts> {
        let [from, to] = CAGE_ORDERS;
        if !self.can_judge(from) {
            return None;
        }
        let fine = self.fine_search();
        let resolution = fine.spectra.first()?.lines.resolution;
        let known = shaft_lines(fine.end(), self.speed_error);
        let masked = fine.masked(&known);
        let own = self.orders.order(Fault::Cage).map(|order| {
            let reach = (self.orders.error(Fault::Cage) + self.speed_error) * order;
            (order, reach + 3.0 * resolution)
        });
        let places = ((to - from) / resolution) as u32;
        let fits = (0..=places).filter_map(|place| {
            let fit = best_fit(&masked, from + f64::from(place) * resolution, 0.0, None)?;
            let of_own = own.is_some_and(|(order, reach)| (fit.order - order).abs() < reach);
            (!of_own && !self.is_related(fit.order, resolution, &[])).then_some(fit)
        });
        let fit = fits.max_by(|a, b| a.score.total_cmp(&b.score))?;
        let best = Candidate::at(None, fit);
        let lines = fine.clear_cage_lines(&masked, &known, &best)?;
        Some(UnexplainedImpacts {
            order: lines.order,
            frequency_hz: lines.frequency_hz,
            false_alarm: lines.false_alarm,
            harmonics_seen: lines.harmonics_seen,
            strength_db: Some(lines.strength_db),
            band_hz: lines.band_hz,
        })
    }

    pub(super) fn fine_search(&self) -> Self {
        Self { spectra: self.fine, ..*self }
    }

    /// A comb of the fine spectra, if it is as clear as lines of a cage have to be.
    fn clear_cage_lines(&self, masked: &[Masked<'_>], known: &[KnownLine], best: &Candidate) -> Option<CageLines> {
        let own = self.own_lines(best, self.end());
        let chance = self.chance(masked, best, &own)?;
        let harmonics = self.harmonics(&best.fit, Some(Fault::Cage), known);
        let band = &self.spectra[best.fit.spectrum];
        let evidence = Evidence::of(&harmonics, &band.lines);
        let strength_db = evidence.strength_db?;
        let clear = chance < BALL_BY_CAGE_BELOW
            && strength_db >= LEAST_CAGE_LINES_DB
            && evidence.seen >= LEAST_HARMONICS
            && evidence.first
            // what strikes at twice to four times the order has every second to fourth of its harmonics alone
            && (2..=MOST_MULTIPLE).all(|part| has_teeth_between(masked, &best.fit, part))
            && self.divided(best, known).is_none();
        clear.then_some(CageLines {
            false_alarm: chance,
            order: best.fit.order,
            frequency_hz: best.fit.order * self.speed_hz,
            band_hz: band.band_hz,
            harmonics_seen: evidence.seen,
            strength_db,
            harmonics,
        })
    }
}
