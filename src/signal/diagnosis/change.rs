//! What grew since an earlier signal of the same machine: the impacts of each part, in the band that shows them best now.
//!
//! Compared is the squared envelope of the band, of the signal as it is: whitening divides by the signal's own level and would hide what
//! grew. The square, since it is linear in the power of what is added: a floor of noise that rises or falls leaves the lines of
//! impacts as they were, where those of the envelope itself would sink in it. A line's amplitude in it is a power, so that the
//! root of that is the level, and ten decibels of change are ten decibels of the impacts' amplitude.

use super::DiagnosisError;
use super::comb_power::{Comb, Tooth};
use super::compared_lines::{COMPARED_HARMONICS, Compared, ComparedSignal};
use super::known::{Strikes, shaft_lines};
use super::line_change::{ChangeConclusion, LineChange};
use super::order_spectrum::AngleGrid;
use super::ratio_interval::{Scattered, interval_db};
use super::stretch_spectrum::{StretchSpectrum, stretch_revolutions};
use super::verdict::UNSEEN_ABOVE;
use crate::signal::RawSpectrum;

/// Fewest lines of a comb: one alone may be anything.
const LEAST_TEETH: usize = 2;
/// Fewest revolutions of a window.
const FEWEST_REVOLUTIONS: f64 = 8.0;

/// Why nothing is compared where multiples of the shaft leave too few lines.
const COVERED: &str = "Multiples of the shaft's order cover all of its harmonics but one at most in one of the two signals. A longer window separates more.";

/// One of the two signals with what is computed once.
struct Side<'a> {
    compared: &'a ComparedSignal<'a>,
    raw: RawSpectrum,
    grid: AngleGrid,
    revolutions: f64,
}

/// How the impacts of each part of a diagnosis, and of those that belong to none, changed since an earlier signal.
///
/// # Errors
/// [`DiagnosisError`]: a shaft that rests or turns back in one of them.
pub(crate) fn line_changes(
    now: &ComparedSignal<'_>,
    earlier: &ComparedSignal<'_>,
) -> Result<Vec<LineChange>, DiagnosisError> {
    let parts = now.diagnosis.faults.iter();
    let parts = parts.map(|verdict| Compared::part(verdict, now, earlier));
    let others = now.diagnosis.unexplained.iter();
    let others = others.map(|impacts| Compared::impacts(impacts, now, earlier));
    let compared: Vec<Compared> = parts.chain(others).collect();
    let orders = compared.iter().map(|compared| compared.places[0][0]);
    let highest = (f64::from(COMPARED_HARMONICS) + 1.0) * orders.fold(1.0, f64::max);
    let grids = [now.grid(highest)?, earlier.grid(highest)?];
    let least = grids.iter().fold(f64::INFINITY, |least, grid| least.min(grid.turns()));
    let revolutions = stretch_revolutions(least);
    let [grid_now, grid_earlier] = grids;
    let sides = [
        Side { compared: now, raw: RawSpectrum::of(now.signal)?, grid: grid_now, revolutions },
        Side { compared: earlier, raw: RawSpectrum::of(earlier.signal)?, grid: grid_earlier, revolutions },
    ];
    compared.into_iter().map(|compared| compared.change(&sides, least, highest)).collect()
}

impl Compared {
    /// What is known before anything is compared.
    fn not_compared(&self, why: String) -> LineChange {
        LineChange { fault: self.fault, name: self.name.clone(), band_hz: self.band_hz, why, ..LineChange::default() }
    }

    fn change(&self, sides: &[Side<'_>; 2], least_turns: f64, highest: f64) -> Result<LineChange, DiagnosisError> {
        let Some(band_hz) = self.band_hz else {
            return Ok(self.not_compared(self.why_not.clone()));
        };
        if self.teeth.len() < LEAST_TEETH {
            return Ok(self.not_compared(
                "Other lines cover its first harmonics in this signal. A longer window separates more.".to_owned(),
            ));
        }
        let end_hz = 0.5 * sides[1].compared.signal.rate_hz();
        if band_hz[1] > end_hz * (1.0 + 1e-6) {
            return Ok(self.not_compared(format!(
                "The band that shows it is {:.0} to {:.0} Hz. The earlier signal ends at {end_hz:.0} Hz, half its sampling rate. A --band below that compares them.",
                band_hz[0], band_hz[1]
            )));
        }
        if least_turns < FEWEST_REVOLUTIONS {
            return Ok(self.not_compared(format!(
                "The shorter of the two windows has {least_turns:.1} revolutions. At least {FEWEST_REVOLUTIONS} are needed."
            )));
        }
        let others = self.others(sides[1].compared);
        let Some(now) = self.found(&sides[0], 0, &[], band_hz, highest)? else {
            return Ok(self.not_compared(COVERED.to_owned()));
        };
        let common = |earlier: &Found| -> Vec<Tooth> {
            let teeth = self.teeth.iter().enumerate();
            let free = teeth.filter(|(place, _)| now.comb.free.contains(place) && earlier.comb.free.contains(place));
            free.map(|(_, tooth)| *tooth).collect()
        };
        let enough = |earlier: &Found| common(earlier).len() >= LEAST_TEETH;
        let earlier = self.found(&sides[1], 1, &others, band_hz, highest)?;
        // what else stands there bounds what the part had
        let bound = !others.is_empty() && !earlier.as_ref().is_some_and(enough);
        let earlier = match bound {
            true => self.found(&sides[1], 1, &[], band_hz, highest)?,
            false => earlier,
        };
        let Some(earlier) = earlier.filter(enough) else {
            return Ok(self.not_compared(COVERED.to_owned()));
        };
        let common = common(&earlier);
        let power = |found: &Found| found.spectrum.comb_power(&common, found.comb.order);
        let (Some(now_power), Some(earlier_power)) = (power(&now), power(&earlier)) else {
            return Ok(self.not_compared("One of the two signals is silent in the band that shows it.".to_owned()));
        };
        let sharing = others.first().filter(|_| bound).map(|other| other.name);
        Ok(self.concluded(&common, [&now, &earlier], [&now_power, &earlier_power], sharing))
    }

    fn found(
        &self,
        side: &Side<'_>,
        place: usize,
        others: &[Strikes<'_>],
        band_hz: [f64; 2],
        highest: f64,
    ) -> Result<Option<Found>, DiagnosisError> {
        let envelope = side.raw.envelope(band_hz);
        let means = side.grid.means(envelope.start_s, envelope.step_s, &envelope.squared);
        // an envelope has nothing beyond the width of its band
        let highest = highest.min((band_hz[1] - band_hz[0]) / side.grid.fastest_hz);
        let power = 0.5 * means.iter().sum::<f64>() / means.len() as f64;
        let spectrum = StretchSpectrum::new(&means, side.grid.per_turn, highest, side.revolutions)?;
        let (sought, speed_error) = (self.places[place], side.compared.diagnosis.speed_error);
        let (end, resolution) = (spectrum.end(), spectrum.resolution);
        let mut known = shaft_lines(end, speed_error);
        for other in others {
            known.extend(other.lines(&side.compared.orders, speed_error, end, resolution));
        }
        let Some(comb) = spectrum.best_comb(&self.teeth, sought, &known) else {
            return Ok(None);
        };
        let own = Strikes { fault: None, name: "", order: comb.order };
        known.extend(own.impact_lines(self.cage, end, resolution));
        let chance = spectrum.chance(&self.teeth, sought, &comb, &known);
        Ok(Some(Found { power, spectrum, comb, chance }))
    }

    fn concluded(
        &self,
        common: &[Tooth],
        [now, earlier]: [&Found; 2],
        [now_power, earlier_power]: [&Scattered; 2],
        sharing: Option<&str>,
    ) -> LineChange {
        let is_seen = |found: &Found, power: &Scattered| found.chance < UNSEEN_ABOVE && power.above() > 0.0;
        let seen_now = self.seen && is_seen(now, now_power);
        let seen_earlier = sharing.is_none() && is_seen(earlier, earlier_power);
        // the envelope is squared
        let level = |seen: bool, power: &Scattered| seen.then(|| (2.0 * power.above()).sqrt().sqrt());
        let mut harmonics: Vec<u32> = common.iter().map(|tooth| tooth.harmonic).collect();
        harmonics.dedup();
        let mut change = LineChange {
            order_now: Some(now.comb.order),
            order_earlier: Some(earlier.comb.order),
            now: level(seen_now, now_power),
            earlier: level(seen_earlier, earlier_power),
            harmonics,
            band_change_db: (now.power > 0.0 && earlier.power > 0.0)
                .then(|| 10.0 * (now.power / earlier.power).log10()),
            ..self.not_compared(String::new())
        };
        if !seen_now && !seen_earlier {
            change.why = "Its lines are above the noise in neither signal.".to_owned();
            return change;
        }
        let [low, high] = interval_db(now_power, earlier_power).map(|end| end.map(|db| 0.5 * db));
        change.interval_db = [low.filter(|_| seen_now), high.filter(|_| seen_earlier)];
        if seen_now && seen_earlier {
            change.change_db = Some(5.0 * (now_power.above() / earlier_power.above()).log10());
        }
        change.conclusion = ChangeConclusion::of(change.interval_db);
        change.why = Self::why(&change, [seen_now, seen_earlier], sharing);
        change
    }

    fn why(change: &LineChange, [seen_now, seen_earlier]: [bool; 2], sharing: Option<&str>) -> String {
        let harmonics = change.harmonics.iter().map(ToString::to_string);
        let harmonics = harmonics.collect::<Vec<_>>().join(", ");
        let mut why = format!("Harmonics {harmonics} of the squared envelope are compared.");
        if let Some(other) = sharing {
            why.push_str(&format!(
                " Lines of the {other} stand there in the earlier signal, so that this is a lower bound."
            ));
        } else if !seen_earlier {
            why.push_str(" They are not above the noise in the earlier signal, so that this is a lower bound.");
        }
        if !seen_now {
            why.push_str(" They are not above the noise in this signal, so that this is an upper bound.");
        }
        if change.conclusion == ChangeConclusion::NotCertain {
            why.push_str(" Longer windows may decide.");
        }
        why
    }
}

/// A comb in one of the signals.
struct Found {
    /// Mean square of the band.
    power: f64,
    spectrum: StretchSpectrum,
    comb: Comb,
    chance: f64,
}
