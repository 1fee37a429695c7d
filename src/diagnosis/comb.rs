//! A fault's line and its harmonics in a spectrum, together: a comb whose teeth move as one.

use std::f64::consts::PI;

use super::EnvelopeOrderSpectrum;
use super::chance::{log_exceedance, log_gamma_tail, search_probability};

/// Harmonics that are looked at, the fundamental counted.
pub(super) const HARMONICS: u32 = 8;
/// Bins 1 / T to each side whose median is the floor of a line.
const FLOOR_BINS: usize = 12;
/// Fewest of them: the median of 17 bins is within 25 % (one standard deviation, 1 / sqrt(17)) of its limit.
const FEWEST_FLOOR_BINS: usize = 8;
/// The floor reaches at most this part of the fundamental to each side, so that no neighbouring tooth is in it and a floor
/// that falls with the frequency is nearly straight.
const FLOOR_REACH: f64 = 0.5;
/// Places of the search in a bin 1 / T of the highest harmonic.
const PLACES: f64 = 4.0;
/// A line that leaks A / (pi d) to d bins beside it (no taper) is said to do so with this margin; leakages of several add up.
const LEAKAGE_MARGIN: f64 = 1.2;
/// Probability below which a tooth is called seen.
pub(super) const SEEN: f64 = 0.01;

/// A line that has another reason, and which.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Known {
    pub(super) order: f64,
    pub(super) name: String,
}

/// What a tooth is worth.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Worth {
    /// Counted, and above its floor so that noise would do it once in a hundred.
    Seen,
    /// Counted, and as noise would be.
    Hidden,
    /// Not counted: it coincides with this within the resolution.
    Coincides(String),
    /// Counted as no evidence: the leakage of this stronger line could be all of it.
    Leakage(String),
}

/// A harmonic, or a line beside one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tooth {
    pub(super) harmonic: u32,
    /// How many spacings beside its harmonic.
    pub(super) side: i32,
    pub(super) order: f64,
    pub(super) amplitude: f64,
    /// Power over the median of its floor.
    pub(super) ratio: f64,
    pub(super) worth: Worth,
}

/// The comb where it fits best.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Comb {
    /// Its fundamental.
    pub(super) order: f64,
    /// Probability that noise alone has one as good somewhere in the search; 1 without a tooth that counts.
    pub(super) chance: f64,
    pub(super) teeth: Vec<Tooth>,
    /// Harmonics with a tooth that counts.
    pub(super) free: usize,
    /// Those of them whose teeth together are above their floors so that noise would do it once in a hundred.
    pub(super) seen: usize,
}

/// Where a tooth is: `harmonic * fundamental + side * spacing`.
struct Place {
    harmonic: u32,
    side: i32,
    offset: f64,
    floor: Floor,
}

impl Place {
    fn line(&self, fundamental: f64) -> f64 {
        f64::from(self.harmonic) * fundamental + self.offset
    }
}

/// A floor: its median power and how many bins that is of.
struct Floor {
    power: f64,
    bins: usize,
}

/// Turns of the shaft that the floor of a fault's lines needs.
pub(super) fn turns_needed(order: f64) -> f64 {
    FEWEST_FLOOR_BINS as f64 / (FLOOR_REACH * order)
}

impl Comb {
    /// The best comb within the larger of a relative `error` and half a bin about `order`; `None` if the window is too short
    /// for a floor. Teeth on multiples of the shaft's order or on `known` lines do not count. With a spacing `beside`, in orders, every
    /// harmonic has a tooth on each side too.
    pub(super) fn find(
        spectrum: &EnvelopeOrderSpectrum,
        order: f64,
        error: f64,
        beside: Option<f64>,
        known: &[Known],
    ) -> Option<Self> {
        let bin = 1.0 / spectrum.turns;
        let places = places(spectrum, order, beside);
        // without its first two lines a comb is no evidence
        let central = |harmonic| {
            let mut places = places.iter();
            places.any(|place| (place.harmonic, place.side) == (harmonic, 0))
        };
        if !(central(1) && central(2)) {
            return None;
        }
        let reach = (error * order).max(0.5 * bin);
        let step = bin / (f64::from(HARMONICS) * PLACES);
        let steps = (2.0 * reach / step).ceil();
        let mut best = (f64::INFINITY, order, 0, 0.0, 0.0);
        for step in 0..=steps as usize {
            let at = order - reach + 2.0 * reach * step as f64 / steps;
            let (mut count, mut sum, mut squares) = (0, 0.0, 0.0);
            for place in &places {
                if let Some(evidence) = evidence(spectrum, place, at, known) {
                    count += 1;
                    squares += f64::from(place.harmonic * place.harmonic);
                    sum += evidence;
                }
            }
            if count > 0 {
                let chance = log_gamma_tail(count, sum);
                if chance < best.0 {
                    best = (chance, at, count, sum, (squares / count as f64).sqrt());
                }
            }
        }
        let (_, order, count, sum, harmonic) = best;
        let chance = match count {
            0 => 1.0,
            _ => search_probability(count, sum, 2.0 * reach / bin * harmonic),
        };
        let (free, seen) = harmonics(spectrum, &places, order, known);
        let teeth = places.iter().map(|place| {
            let line = place.line(order);
            let ratio = ratio(spectrum, line, &place.floor);
            let stands_out = log_exceedance(ratio, place.floor.bins) < SEEN.ln();
            let worth = match (
                coincidence(line, bin, known),
                leakage(spectrum, line, known),
            ) {
                (Some(name), _) => Worth::Coincides(name),
                (None, Some(name)) => Worth::Leakage(name),
                (None, None) if stands_out => Worth::Seen,
                (None, None) => Worth::Hidden,
            };
            Tooth {
                harmonic: place.harmonic,
                side: place.side,
                order: line,
                amplitude: spectrum.at(line),
                ratio,
                worth,
            }
        });
        Some(Self {
            order,
            chance,
            teeth: teeth.collect(),
            free,
            seen,
        })
    }
}

/// Places of the teeth that have a floor.
fn places(spectrum: &EnvelopeOrderSpectrum, order: f64, beside: Option<f64>) -> Vec<Place> {
    // lines nearer than a bin are not told apart
    let spacing = beside.filter(|spacing| *spacing > 1.0 / spectrum.turns);
    let sides: &[i32] = if spacing.is_some() { &[-1, 0, 1] } else { &[0] };
    let pairs =
        (1..=HARMONICS).flat_map(|harmonic| sides.iter().map(move |&side| (harmonic, side)));
    let place = |(harmonic, side): (u32, i32)| {
        let offset = f64::from(side) * spacing.unwrap_or(0.0);
        Some(Place {
            harmonic,
            side,
            offset,
            floor: floor(spectrum, f64::from(harmonic) * order + offset, order)?,
        })
    };
    pairs.filter_map(place).collect()
}

/// What a tooth says against noise, -ln of its probability; `None` where it does not count, 0 where it may be leakage. That stays
/// in the count, so that noise is not helped by leaving its weak bins out.
fn evidence(
    spectrum: &EnvelopeOrderSpectrum,
    place: &Place,
    at: f64,
    known: &[Known],
) -> Option<f64> {
    let line = place.line(at);
    if coincidence(line, 1.0 / spectrum.turns, known).is_some() {
        return None;
    }
    if leakage(spectrum, line, known).is_some() {
        return Some(0.0);
    }
    Some(-log_exceedance(
        ratio(spectrum, line, &place.floor),
        place.floor.bins,
    ))
}

/// Harmonics with teeth that count, and those whose teeth together stand out.
fn harmonics(
    spectrum: &EnvelopeOrderSpectrum,
    places: &[Place],
    order: f64,
    known: &[Known],
) -> (usize, usize) {
    let (mut free, mut seen) = (0, 0);
    for harmonic in 1..=HARMONICS {
        let own = places.iter().filter(|place| place.harmonic == harmonic);
        let said = own.filter_map(|place| evidence(spectrum, place, order, known));
        let (count, sum) = said.fold((0, 0.0), |(count, sum), evidence| {
            (count + 1, sum + evidence)
        });
        if count > 0 {
            free += 1;
            seen += usize::from(log_gamma_tail(count, sum) < SEEN.ln());
        }
    }
    (free, seen)
}

/// A line beside a tooth: its power over its floor, and whether noise would do that once in a hundred.
pub(super) fn side_line(
    spectrum: &EnvelopeOrderSpectrum,
    line: f64,
    fundamental: f64,
) -> Option<(f64, bool)> {
    let floor = floor(spectrum, line, fundamental)?;
    let bin = 1.0 / spectrum.turns;
    // the largest within half a bin
    let places = (-4_i32..=4).map(|j| ratio(spectrum, line + f64::from(j) * bin / 8.0, &floor));
    let largest = places.fold(0.0, f64::max);
    let sum = -log_exceedance(largest, floor.bins);
    Some((largest, search_probability(1, sum, 1.0) < SEEN))
}

/// What a line coincides with: a multiple of the shaft's order, or a known line, nearer than a bin.
pub(super) fn coincidence(line: f64, bin: f64, known: &[Known]) -> Option<String> {
    let multiple = line.round();
    if multiple >= 1.0 && (line - multiple).abs() < bin {
        return Some(format!("{multiple} x shaft"));
    }
    let other = known.iter().find(|other| (line - other.order).abs() < bin);
    other.map(|other| other.name.clone())
}

/// The shaft's multiple or known line nearest to this one whose leakage could be all of it.
fn leakage(spectrum: &EnvelopeOrderSpectrum, line: f64, known: &[Known]) -> Option<String> {
    let own = spectrum.at(line);
    let leaks = |from: f64| {
        let bins = ((line - from) * spectrum.turns).abs();
        LEAKAGE_MARGIN * spectrum.at(from) / (PI * bins) > own
    };
    let multiple = line.round();
    if multiple >= 1.0 && leaks(multiple) {
        return Some(format!("{multiple} x shaft"));
    }
    let distance = |other: &&Known| (line - other.order).abs();
    let nearest = known
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let nearest = nearest.filter(|other| leaks(other.order));
    nearest.map(|other| other.name.clone())
}

fn ratio(spectrum: &EnvelopeOrderSpectrum, line: f64, floor: &Floor) -> f64 {
    spectrum.at(line).powi(2) / floor.power
}

/// Floor about a line; `None` where the window is too short for it or the spectrum ends.
fn floor(spectrum: &EnvelopeOrderSpectrum, line: f64, fundamental: f64) -> Option<Floor> {
    let reach = (FLOOR_REACH * fundamental * spectrum.turns + 1e-9) as usize;
    let reach = reach.min(FLOOR_BINS);
    let bin = 1.0 / spectrum.turns;
    let (lowest, highest) = (line - reach as f64 * bin, line + reach as f64 * bin);
    if reach < FEWEST_FLOOR_BINS || lowest < 0.5 * bin || highest > spectrum.highest * 1.25 {
        return None;
    }
    let mut powers: Vec<f64> = (0..=2 * reach)
        .map(|j| spectrum.at(lowest + j as f64 * bin).powi(2))
        .collect();
    let power = *powers.select_nth_unstable_by(reach, f64::total_cmp).1;
    (power > 0.0).then_some(Floor {
        power,
        bins: 2 * reach + 1,
    })
}
