//! Explanations compared: each part of the bearing, repeated impacts of something else, or neither. What explains the most goes first;
//! its lines are no evidence for the others, whether it is named or not.

use super::comb::Fit;
use super::fault::Fault;
use super::known::{COMBS_BESIDE, coincidence, shaft_lines};
use super::search::{Candidate, Search};
use super::verdict::{Conclusion, FaultVerdict, UnexplainedImpacts};

/// Probability by chance below which a comb explains lines, named or not.
const EXPLAINS_BELOW: f64 = 0.01;
/// Relative difference of orders that are multiples of one: combs are fitted within half of the resolution.
const SAME_ORDER: f64 = 5e-3;
/// Most combs that are explained one after the other.
const MOST_ROUNDS: usize = 8;

/// What was found.
pub(super) struct Found {
    pub(super) faults: Vec<FaultVerdict>,
    pub(super) unexplained: Vec<UnexplainedImpacts>,
    /// Spectrum of the strongest comb.
    pub(super) spectrum: usize,
}

impl Search<'_> {
    pub(super) fn run(&self) -> Found {
        let highest = self.end();
        let mut known = shaft_lines(highest, self.speed_error);
        let mut found = Found { faults: Vec::new(), unexplained: Vec::new(), spectrum: 0 };
        let mut open: Vec<(Fault, f64)> = Vec::new();
        for fault in Fault::ALL {
            let Some(order) = self.orders.order(fault) else {
                continue;
            };
            if self.can_judge(order) {
                open.push((fault, order));
            } else {
                found.faults.push(self.too_short(fault, order));
            }
        }
        let mut strongest: Option<Fit> = None;
        let mut explained = Vec::new();
        for _ in 0..MOST_ROUNDS {
            let masked = self.masked(&known);
            let parts = open.iter().filter_map(|&(fault, order)| self.measured(&masked, fault, order));
            let other = self.something_else(&masked, &explained);
            let mut candidates: Vec<Candidate> = parts.chain(other).collect();
            candidates.sort_by(|a, b| b.fit.score.total_cmp(&a.fit.score));
            // the wider a search is the more it scores by chance: one that says nothing does not silence the next
            let explains = candidates.into_iter().find_map(|candidate| {
                let own = self.own_lines(&candidate, highest);
                let chance = self.chance(&masked, &candidate, &own)?;
                strongest.get_or_insert(candidate.fit);
                (chance < EXPLAINS_BELOW).then_some((candidate, own, chance))
            });
            let Some((best, own, chance)) = explains else {
                break;
            };
            match best.fault {
                Some(fault) => {
                    let expected = self.orders.order(fault).unwrap_or(best.fit.order);
                    let verdict = self.verdict(fault, expected, &best, chance, &known);
                    found.faults.push(verdict);
                    open.retain(|(other, _)| *other != fault);
                    explained.push(fault);
                }
                None => {
                    let impacts = self.unexplained(&best, chance, &known);
                    // the harmonics of what was said are not said again
                    let new = impacts.filter(|impacts| !self.is_multiple(impacts, &found));
                    found.unexplained.extend(new);
                }
            }
            known.extend(own);
        }
        found.spectrum = strongest.map_or(0, |fit| fit.spectrum);
        let masked = self.masked(&known);
        for (fault, order) in open {
            let verdict = match self.measured(&masked, fault, order) {
                Some(best) => {
                    let own = self.own_lines(&best, highest);
                    let chance = self.chance(&masked, &best, &own).unwrap_or(1.0);
                    self.verdict(fault, order, &best, chance, &known)
                }
                None => self.hidden(fault, order, &known),
            };
            found.faults.push(verdict);
        }
        self.doubt_sidebands_of_hidden_parts(&mut found.faults);
        self.judge_balls_by_cage_lines(&mut found.faults, &found.unexplained);
        let named = |verdict: &FaultVerdict| verdict.conclusion == Conclusion::Named;
        if found.unexplained.is_empty() && !found.faults.iter().any(named) {
            found.unexplained.extend(self.other_cage_lines());
        }
        found.faults.sort_by_key(|verdict| verdict.fault as usize);
        found
    }

    /// Whether impacts of no part repeat a few times as often as others that were found before.
    fn is_multiple(&self, impacts: &UnexplainedImpacts, found: &Found) -> bool {
        let mut earlier = found.unexplained.iter();
        earlier.any(|earlier| {
            let ratio = impacts.order / earlier.order;
            let multiple = ratio.round();
            multiple >= 1.0 && (ratio / multiple - 1.0).abs() < SAME_ORDER
        })
    }

    /// A comb one or two revolutions beside a place where the shaft's lines hide another part may be sidebands of that part.
    fn doubt_sidebands_of_hidden_parts(&self, faults: &mut [FaultVerdict]) {
        let shaft = shaft_lines(self.end(), self.speed_error);
        let named = |verdict: &&mut FaultVerdict| verdict.conclusion == Conclusion::Named;
        for verdict in faults.iter_mut().filter(named) {
            let Some(order) = verdict.order else { continue };
            let covered = |place: f64| {
                let mut bands = self.spectra.iter();
                bands.any(|band| coincidence(&band.lines, place, &shaft).is_some())
            };
            let hidden = |fault: Fault| {
                let part = self.orders.order(fault)?;
                let reach = (self.orders.error(fault) + self.speed_error) * part;
                let revolutions = (part - order).round();
                let place = order + revolutions;
                let beside = (1.0..=f64::from(COMBS_BESIDE)).contains(&revolutions.abs());
                (fault != verdict.fault && beside && (place - part).abs() <= reach && covered(place)).then_some(fault)
            };
            let races = [Fault::OuterRace, Fault::InnerRace];
            if let Some(fault) = races.into_iter().find_map(hidden) {
                let reason = format!(
                    "They may be sidebands of the {}, whose own lines the shaft's hide in this window. A longer window decides.",
                    fault.name()
                );
                verdict.revise(Conclusion::NotEnough, reason);
            }
        }
    }
}
