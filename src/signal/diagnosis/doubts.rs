//! Three doubts of a part whose comb stands out: impacts that are no part's may have some of its lines.
//!
//! - They repeat more seldom: every second to fifth of their harmonics is one of the part's, and the others stand between.
//! - They repeat twice or three times as often: only every second or third harmonic of the part stands out. As many flaws at equal
//!   distances do the same.
//! - They lie at an order beside that of the part, where the comb fits better.

use super::comb::best_fit;
use super::fault::Fault;
use super::known::{KnownLine, coincidence};
use super::line_spectrum::LineSpectrum;
use super::search::{Candidate, Search};
use super::unexplained::has_teeth_between;

/// Most of their harmonics from one of the part to the next.
const MOST_PARTS: u32 = 5;
/// Harmonics of the part up to which lines are looked for between.
const HARMONICS: u32 = 3;
/// Fewest places between them that no other line takes.
const LEAST_PLACES: usize = 2;
/// The lines between are weaker than those of the part by so much at most, dB on the average: sidebands are weaker by more.
const WEAKER_DB: f64 = 6.0;
/// So many of them stand out.
const MOST_SEEN: f64 = 2.0 / 3.0;

/// How far beyond the error of an order a better comb is looked for, in units of the resolution.
const BESIDE: f64 = 3.0;
/// Multiples of a part's order of which something else may be the first harmonic.
const MOST_MULTIPLE: u32 = 3;

impl Search<'_> {
    /// Why the lines of a comb that looks like a part's are something else's; `expected` is the part's order.
    pub(super) fn doubt(&self, expected: f64, comb: &Candidate, known: &[KnownLine]) -> Option<String> {
        let hz = |order: f64| order * self.speed_hz;
        let fit = comb.fit;
        if let Some(parts) = self.divided(comb, known) {
            return Some(format!(
                "Lines as strong stand between its harmonics, at all multiples of {:.2} Hz, 1/{parts} of its frequency: something strikes that seldom, and it is no part of this bearing.",
                hz(fit.order / f64::from(parts))
            ));
        }
        let masked = self.masked(known);
        let multiple = |times: &u32| !has_teeth_between(&masked, &fit, *times);
        // lines beside the harmonics count in a sided comb, and these need not stand out
        if let Some(times) = (2..=MOST_MULTIPLE).filter(|_| fit.beside.is_none()).find(multiple) {
            return Some(format!(
                "Only harmonics of {:.2} Hz stand out, {times} times its frequency. One flaw has all harmonics; {times} at equal distances, or something else that strikes that often, have these.",
                hz(fit.order * f64::from(times))
            ));
        }
        let band = &masked[fit.spectrum..=fit.spectrum];
        let lines = &band[0].spectrum.lines;
        let resolution = lines.resolution;
        // how well a comb's place is known
        let place = 0.5 * resolution / f64::from(lines.harmonics);
        let reach = comb.relative_reach * expected;
        let wider = best_fit(band, expected, reach + BESIDE * resolution, fit.beside)?;
        let outside = (wider.order - expected).abs() > reach + place;
        (outside && wider.score > fit.score).then(|| {
            format!(
                "They fit better at {:.2} Hz, {:+.1} % from what is expected, which is beyond the error of orders and speed.",
                hz(wider.order),
                100.0 * (wider.order / expected - 1.0)
            )
        })
    }

    /// Into how many parts lines as strong as those of a comb divide it, all free of known lines and of the comb's own sidebands.
    ///
    /// A flaw of a ball strikes both races, not always alike: lines halfway between its harmonics are its own. The sidebands of a cage lie
    /// about halfway as well, since five times its order is about two: the fine spectra tell them apart where anything does.
    pub(super) fn divided(&self, comb: &Candidate, known: &[KnownLine]) -> Option<u32> {
        if comb.fault == Some(Fault::Cage) {
            let fine = self.fine_search();
            let refined = fine.part(&fine.masked(known), Fault::Cage, comb.fit.order)?;
            return fine.divided_from(2, &refined, known);
        }
        let least = if comb.fault == Some(Fault::Ball) { 3 } else { 2 };
        self.divided_from(least, comb, known)
    }

    fn divided_from(&self, least: u32, comb: &Candidate, known: &[KnownLine]) -> Option<u32> {
        let lines = &self.spectra[comb.fit.spectrum].lines;
        // lines of what is no part are those that are looked for
        let known = known.iter().filter(|line| !line.foreign);
        let known: Vec<KnownLine> = known.cloned().collect();
        let taken = [self.own_lines(comb, self.end()), known.clone()].concat();
        let mut parts = (least..=MOST_PARTS).rev();
        parts.find(|&parts| divides(lines, comb.fit.order, parts, &taken, &known))
    }
}

/// Whether lines at all multiples of a part of an order stand about as high as those of the order itself.
fn divides(lines: &LineSpectrum, order: f64, parts: u32, taken: &[KnownLine], known: &[KnownLine]) -> bool {
    let place = |k: u32| f64::from(k) * order / f64::from(parts);
    let free = |own: bool, known: &[KnownLine]| -> Vec<f64> {
        let places = (1..=HARMONICS * parts).filter(|k| k.is_multiple_of(parts) == own);
        let places =
            places.map(place).filter(|&order| lines.bin(order).is_some() && coincidence(lines, order, known).is_none());
        places.collect()
    };
    let (between, own) = (free(false, taken), free(true, known));
    let mean_db = |places: &[f64]| {
        let db = places.iter().map(|&order| 10.0 * lines.ratio(order).max(1.0).log10());
        db.sum::<f64>() / places.len().max(1) as f64
    };
    let seen = between.iter().filter(|&&order| lines.seen(order)).count();
    between.len() >= LEAST_PLACES
        && seen as f64 >= MOST_SEEN * between.len() as f64
        && mean_db(&between) >= mean_db(&own) - WEAKER_DB
}
