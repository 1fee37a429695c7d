//! A ball that shows by the lines of the cage.
//!
//! A flaw on a ball meets the races only where the ball's axis of spin lets it, and that axis wanders: the lines of the ball itself smear, often
//! beyond recognition. What stays is that one ball of all differs, and it passes the load once a revolution of the cage. Of the
//! records of seeded faults that Smith and Randall (Mech. Syst. Signal Process. 64-65 (2015) 100-131) grade, those of balls have the
//! cage's harmonics and hardly any of the ball's.

use super::explain::Search;
use super::fault::Fault;
use super::known::shaft_lines;
use super::verdict::{
    BALL_BY_CAGE_BELOW, CageLines, Conclusion, Evidence, FaultVerdict, LEAST_CAGE_LINES_DB,
    LEAST_HARMONICS, LEAST_STRENGTH_DB, NAMED_BELOW, probability,
};

/// A race whose lines are by so many dB stronger than the cage's explains these.
const RACE_OVER_CAGE_DB: f64 = 2.0;

impl Search<'_> {
    /// Indicates a ball by the lines of the cage, where no other part shows as clearly: a flaw on a race is struck harder by a ball that
    /// differs, once a revolution of the cage as well.
    pub(super) fn judge_balls_by_cage_lines(&self, faults: &mut [FaultVerdict]) {
        let Some(lines) = self.cage_lines() else {
            return;
        };
        let clearest = LEAST_STRENGTH_DB.min(lines.strength_db + RACE_OVER_CAGE_DB);
        let clearer = |verdict: &FaultVerdict| {
            let certain = verdict.false_alarm.is_some_and(|p| p < NAMED_BELOW);
            let strong = verdict.strength_db.is_some_and(|db| db >= clearest);
            verdict.conclusion == Conclusion::Named
                || verdict.fault != Fault::Cage && certain && strong
        };
        if faults.iter().any(clearer) {
            return;
        }
        for verdict in faults.iter_mut() {
            match verdict.fault {
                Fault::Ball => {
                    verdict.conclusion = Conclusion::Named;
                    verdict.why = format!(
                        "{} harmonics of the cage's line stand out by {:.0} dB on the average; probability by chance {}. One ball differs from the others: it is damaged, or of another size. Its own lines need not show, since its axis of spin wanders.",
                        lines.harmonics_seen,
                        lines.strength_db,
                        probability(lines.false_alarm)
                    );
                    verdict.false_alarm = Some(lines.false_alarm);
                    verdict.strength_db = Some(lines.strength_db);
                    verdict.cage_lines = Some(lines.clone());
                }
                Fault::Cage if verdict.conclusion != Conclusion::Named => {
                    verdict.conclusion = Conclusion::NotEnough;
                    verdict.why =
                        "Its lines are there. A ball that differs from the others makes them too, and is likelier."
                            .to_owned();
                }
                Fault::OuterRace | Fault::InnerRace | Fault::Cage => {}
            }
        }
    }

    /// The lines of the cage in the fine spectra, if they are clear.
    fn cage_lines(&self) -> Option<CageLines> {
        let order = self.orders.order(Fault::Cage)?;
        if !self.can_judge(order) {
            return None;
        }
        let fine = Search {
            spectra: self.fine,
            ..*self
        };
        let known = shaft_lines(fine.end(), self.speed_error);
        let masked = fine.masked(&known);
        let best = fine.part(&masked, Fault::Cage, order)?;
        let own = fine.own_lines(&best, fine.end());
        let chance = fine.chance(&masked, &best, &own)?;
        let harmonics = fine.part_harmonics(&best, Fault::Cage, &known);
        let evidence = Evidence::of(&harmonics, &fine.spectra[best.fit.spectrum].lines);
        let strength_db = evidence.strength_db?;
        let clear = chance < BALL_BY_CAGE_BELOW
            && strength_db >= LEAST_CAGE_LINES_DB
            && evidence.seen >= LEAST_HARMONICS
            && evidence.first;
        clear.then(|| CageLines {
            false_alarm: chance,
            order: best.fit.order,
            frequency_hz: best.fit.order * self.speed_hz,
            band_hz: fine.spectra[best.fit.spectrum].band_hz,
            harmonics_seen: evidence.seen,
            strength_db,
            harmonics,
        })
    }
}
