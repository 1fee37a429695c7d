//! What is said of a window of a signal.
//!
//! Whether a signal is a piece of another, repeated exactly: whatever the piece holds then comes at a fixed rate, as impacts do.
//!
//! Whether a signal has noise to judge lines against, or nothing beside its tones but the rounding of its numbers.
//!
//! The rounding of a smooth signal repeats with it, so that it makes lines of its own. Noise that is as strong as the rounding takes
//! these apart: J. Vanderkooy and S. P. Lipshitz, Resolution below the least significant bit in digital systems with dither, Journal
//! of the Audio Engineering Society 32 (1984) 106-113.

use super::bands::{Spectra, band_spectra, check_band, searched_band};
use super::cage_lines::doubt_clipped;
use super::comb::SHOWN_HARMONICS;
use super::explain::Found;
use super::findings::envelope_name;
use super::order_spectrum::AngleGrid;
use super::search::Search;
use super::shaft_speed::{FEWEST_REVOLUTIONS, ShaftSpeed, SpeedSource, speed_of_races};
use super::strictly_periodic::say_strictly_periodic;
use super::verdict::UnexplainedImpacts;
use super::{Conclusion, DiagnosisError, EnvelopeOrderSpectrum, Fault, FaultOrders, FaultVerdict};
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::{Forward, WhiteSpectrum, fast_length};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use std::f64::consts::{LN_2, PI};

/// Relative change of a given speed that is said.
const SAID_CHANGE: f64 = 0.01;

/// What is said of a window.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Diagnosis {
    /// The envelope that shows most.
    pub envelope: String,
    /// How many were judged.
    pub envelopes: usize,
    /// Spectrum of that envelope over the shaft's angle. JSON results hold only the number of revolutions in the window.
    #[serde(rename = "turns", serialize_with = "turns_alone")]
    #[schemars(with = "f64", description = "Turns of the shaft in the window.")]
    pub spectrum: EnvelopeOrderSpectrum,
    /// Mean shaft speed, Hz: the given one, sharpened where the signal shows it.
    pub speed_hz: f64,
    /// The mean speed that was given, Hz.
    pub given_speed_hz: f64,
    /// Relative uncertainty of the speed.
    #[serde(rename = "speed_relative_error")]
    pub speed_error: f64,
    /// What shows the speed.
    pub speed_source: SpeedSource,
    /// One verdict a fault whose order is known, in the order of [`Fault::ALL`](super::Fault::ALL).
    pub faults: Vec<FaultVerdict>,
    /// Impacts that belong to no part.
    pub unexplained: Vec<UnexplainedImpacts>,
    /// Faults that the signal alone indicates and something else speaks against.
    pub by_signal_alone: Vec<Fault>,
    /// What grew by 20 dB and more since an earlier signal, with the change in words; most first.
    pub grew: Vec<String>,
}

fn turns_alone<S: Serializer>(spectrum: &EnvelopeOrderSpectrum, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_f64(spectrum.turns)
}

impl Diagnosis {
    /// Judges a window (s) of a signal by the envelopes of its bands within `asked_hz` (Hz; `None`: all); `turns` is the shaft's angle at
    /// a time, in turns. The signal may be longer than the window.
    ///
    /// An error of the orders of 0 means that the speed is exact as well.
    ///
    /// # Errors
    /// [`DiagnosisError`]: a shaft that rests or turns back, a window outside the signal or without samples.
    pub(crate) fn of(
        signal: &TimeSeries,
        asked_hz: Option<[f64; 2]>,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64,
        orders: &FaultOrders,
    ) -> Result<Self, DiagnosisError> {
        let samples = signal.values().len();
        window.check_inside(signal.start_s(), signal.step_s(), samples)?;
        let judged = signal.window(window.from, window.to)?;
        if judged.kurtosis().is_none() {
            return Err(DiagnosisError::Constant { from_s: window.from, to_s: window.to });
        }
        check_band(asked_hz, signal)?;
        let highest = (f64::from(SHOWN_HARMONICS) + 1.0) * orders.highest();
        let grid = AngleGrid::new(window, signal.step_s(), &turns, highest)?;
        let strikes_hz = orders.highest() * grid.fastest_hz;
        let within_hz = searched_band(asked_hz, signal, strikes_hz);
        check_noise(signal, within_hz)?;
        check_repeated(&judged)?;
        let white = WhiteSpectrum::of(signal)?;
        let mut speed = ShaftSpeed::of(signal, &white, &grid, within_hz, orders)?;
        // a signal too short for its kurtosis has no emphasis
        let impulsive = white.impulsive(signal).ok();
        let given_speed_hz = (turns(window.to) - turns(window.from)).abs() / (window.to - window.from);
        let search = |speed: ShaftSpeed| -> Result<(Spectra, Found), DiagnosisError> {
            let sharp = |time: f64| speed.factor * turns(time);
            let grid = AngleGrid::new(window, signal.step_s(), sharp, highest)?;
            let spectra = band_spectra(&white.whitened, impulsive.as_ref(), &grid, within_hz, strikes_hz, highest)?;
            let search = Search {
                spectra: &spectra.lines,
                fine: &spectra.fine,
                orders,
                turns: grid.turns(),
                speed_hz: speed.factor * given_speed_hz,
                speed_error: speed.error,
            };
            let found = search.run();
            Ok((spectra, found))
        };
        let (mut spectra, mut found) = search(speed)?;
        if speed.source == SpeedSource::Given
            && let Some(races) = speed_of_races(&found.faults, orders, &spectra.lines)
        {
            speed = races;
            (spectra, found) = search(speed)?;
        }
        doubt_clipped(&mut found.faults, judged.clipped_share());
        say_strictly_periodic(&mut found.faults, &white, within_hz, orders, speed.factor * given_speed_hz, speed);
        let sharp = |time: f64| speed.factor * turns(time);
        let best = &spectra.lines[found.spectrum];
        let envelope = white.whitened.envelope(best.band_hz);
        Ok(Self {
            speed_hz: speed.factor * given_speed_hz,
            given_speed_hz,
            speed_error: speed.error,
            speed_source: speed.source,
            envelope: envelope_name(best),
            envelopes: spectra.lines.len(),
            spectrum: EnvelopeOrderSpectrum::of_band(&envelope, "", window, sharp, highest)?,
            faults: found.faults,
            unexplained: found.unexplained,
            by_signal_alone: Vec::new(),
            grew: Vec::new(),
        })
    }

    /// The faults that are indicated.
    pub fn named(&self) -> impl Iterator<Item = &FaultVerdict> {
        let named = |verdict: &&FaultVerdict| verdict.conclusion == Conclusion::Named;
        self.faults.iter().filter(named)
    }

    /// Takes the indication of a fault back, for a reason that the signal does not know.
    pub(crate) fn doubt(&mut self, fault: Fault, reason: &str) {
        let indicated = |verdict: &&mut FaultVerdict| verdict.fault == fault && verdict.conclusion == Conclusion::Named;
        if let Some(verdict) = self.faults.iter_mut().find(indicated) {
            verdict.revise(Conclusion::NotEnough, reason.to_owned());
            self.by_signal_alone.push(fault);
        }
    }

    /// Whether any part was judged: the window is long enough, and lines are free.
    pub(crate) fn is_judged(&self) -> bool {
        let mut faults = self.faults.iter();
        faults.any(|verdict| verdict.false_alarm.is_some())
    }

    /// Why a verdict is right at the given speed alone: no line shows that this speed is right. At a wrong one faults are hidden, and one part's
    /// lines are another's.
    pub(crate) fn speed_doubt(&self) -> Option<String> {
        let consequence = match (self.named().next(), self.unexplained.as_slice()) {
            (Some(_), _) => "at a different speed, the same lines would mean a different part",
            (None, []) if self.is_judged() => "at a wrong speed, faults stay hidden",
            _ => return None,
        };
        let speed = both(self.speed_hz);
        match self.speed_source {
            SpeedSource::Exact | SpeedSource::Sharpened | SpeedSource::Races => None,
            SpeedSource::Given if self.spectrum.turns < FEWEST_REVOLUTIONS => Some(format!(
                "no line confirms the shaft speed of {speed} in fewer than {FEWEST_REVOLUTIONS:.0} revolutions: {consequence}"
            )),
            SpeedSource::Given => {
                Some(format!("no line of the signal confirms the shaft speed of {speed}: {consequence}"))
            }
            SpeedSource::EverySecond => Some(format!(
                "lines stand halfway between those of a shaft at {speed}, so that it may turn half as fast: {consequence}"
            )),
            SpeedSource::EvenOnly => Some(format!(
                "only even multiples of {speed} stand out, so that the shaft may turn twice as fast: {consequence}"
            )),
        }
    }

    /// What is to be checked where the speed that is used is more than 1 % from the given one.
    pub(crate) fn speed_change(&self) -> Option<String> {
        let change = self.speed_hz / self.given_speed_hz - 1.0;
        (change.abs() > SAID_CHANGE).then(|| {
            format!(
                "the speed that is used is {}, {}, where {} were given: check that these lines are not another machine's",
                both(self.speed_hz),
                self.speed_source.words(),
                both(self.given_speed_hz)
            )
        })
    }

    /// The verdict in a few words: what is indicated, else what grew strongly, else what is said of most.
    pub fn headline(&self) -> String {
        match (self.decisive(), self.unexplained.first()) {
            (Some((Conclusion::Named, parts)), _) => format!("{}: {}", Conclusion::Named.words(), names(&parts)),
            _ if !self.grew.is_empty() => format!("strong growth: {}", self.grew.join(", ")),
            (_, Some(impacts)) => {
                format!("impacts at {:.2} Hz belong to no part", impacts.frequency_hz)
            }
            (Some((Conclusion::NotSeen, _)), None) => "no fault indicated".to_owned(),
            (Some((conclusion, parts)), None) => format!("{}: {}", conclusion.words(), names(&parts)),
            (None, None) => "no verdict".to_owned(),
        }
    }

    /// What decided it, in a sentence or two.
    pub fn reason(&self) -> String {
        match (self.decisive(), self.unexplained.first()) {
            (Some((conclusion, _)), _) if conclusion != Conclusion::Named && !self.grew.is_empty() => {
                "Ten times the amplitude of the earlier signal is strong evidence of damage; which part it is, this signal alone does not prove.".to_owned()
            }
            (Some((Conclusion::Named, parts)), _) | (Some((_, parts)), None) => parts[0].reason.clone(),
            (_, Some(_)) => "Check bearing and speed, and what else turns.".to_owned(),
            (None, None) => self.faults.first().map_or_else(String::new, |verdict| verdict.reason.clone()),
        }
    }

    /// The strongest thing that is said of any part, and of which parts; `None` where none could be judged. A race or ball that
    /// could not be judged counts as not enough evidence; the cage turns so slowly that most windows are too short for it.
    pub(crate) fn decisive(&self) -> Option<(Conclusion, Vec<&FaultVerdict>)> {
        let is_judged = |verdict: &FaultVerdict| verdict.false_alarm.is_some();
        if !self.faults.iter().any(is_judged) {
            return None;
        }
        let all = [Conclusion::Named, Conclusion::NotEnough, Conclusion::NotSeen];
        all.into_iter().find_map(|conclusion| {
            let counts = |verdict: &&FaultVerdict| {
                let is_open = conclusion == Conclusion::NotEnough && verdict.fault != Fault::Cage;
                verdict.conclusion == conclusion && (is_judged(verdict) || is_open)
            };
            let parts: Vec<&FaultVerdict> = self.faults.iter().filter(counts).collect();
            (!parts.is_empty()).then_some((conclusion, parts))
        })
    }

    /// The verdict in a line.
    pub fn sentence(&self) -> String {
        let doubts = self.speed_doubt().into_iter().chain(self.speed_change());
        let doubts: String = doubts.map(|doubt| format!(" Speed: {doubt}.")).collect();
        format!("{}. {}{doubts}", self.headline(), self.reason())
    }
}

fn names(parts: &[&FaultVerdict]) -> String {
    parts.iter().map(|verdict| verdict.fault.name()).collect::<Vec<_>>().join(", ")
}

/// A speed in both units that people use.
fn both(speed_hz: f64) -> String {
    format!("{speed_hz:.2} Hz ({:.0} rpm)", 60.0 * speed_hz)
}

/// Values that have to come again before the rest is compared.
const BEGINNING: usize = 16;

/// Refuses a signal whose values come again exactly, to the end, at least once and a half.
///
/// # Errors
/// [`DiagnosisError::Repeated`].
pub(super) fn check_repeated(signal: &TimeSeries) -> Result<(), DiagnosisError> {
    match period(signal.values()) {
        Some(samples) => Err(DiagnosisError::Repeated { period_s: samples as f64 * signal.step_s() }),
        None => Ok(()),
    }
}

/// After how many samples all values come again. Those that begin with a run of equal values are taken for a pause.
fn period(values: &[f64]) -> Option<usize> {
    let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
    let beginning = values.get(..BEGINNING)?;
    if same(&beginning[1..], beginning) {
        return None;
    }
    let periods = 1..=values.len() * 2 / 3;
    periods.filter(|&samples| same(beginning, &values[samples..])).find(|&samples| same(values, &values[samples..]))
}

/// Power of the floor over that of the rounding from which there is noise: as much noise as rounding.
const LEAST_FLOOR: f64 = 2.0;
/// Finest step of a recorded signal over its largest deviation, 22 bits: no converter's noise is lower.
const FINEST_STEP: f64 = 1.0 / (1 << 22) as f64;

/// Refuses a signal whose floor within a band (Hz) is that of its rounding.
///
/// # Errors
/// [`DiagnosisError::NoNoise`].
pub(super) fn check_noise(signal: &TimeSeries, [from_hz, to_hz]: [f64; 2]) -> Result<(), DiagnosisError> {
    let mean = signal.mean();
    let centred: Vec<f64> = signal.values().iter().map(|value| value - mean).collect();
    let step = step(&centred);
    let count = centred.len() as f64;
    // tones, a drift and the ends leak 30 dB less with each octave of the distance
    let weight = |k: usize| (PI * (k as f64 + 0.5) / count).sin().powi(4);
    let points = fast_length(centred.len());
    let weighted = centred.iter().enumerate().map(|(k, x)| x * weight(k));
    let spectrum = Forward::new(points).transform(weighted)?;
    let bin_of = |hz: f64| (hz * signal.step_s() * points as f64).round() as usize;
    let end = bin_of(to_hz).clamp(1, spectrum.len());
    let bins = &spectrum[bin_of(from_hz).min(end - 1)..end];
    let mut power: Vec<f64> = bins.iter().map(|bin| bin.norm_sqr()).collect();
    let middle = power.len() / 2;
    let median = *power.select_nth_unstable_by(middle, f64::total_cmp).1;
    // mean of sin^8 is 35 / 128; the median of a bin's power is ln 2 of its mean
    let floor = median / (LN_2 * count * 35.0 / 128.0);
    if floor < LEAST_FLOOR * step * step / 12.0 {
        return Err(DiagnosisError::NoNoise { noise: floor.sqrt(), step });
    }
    Ok(())
}

/// The smallest difference of two values, at least the finest step of a recorded signal.
fn step(centred: &[f64]) -> f64 {
    let mut sorted = centred.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let largest = centred.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let finest = FINEST_STEP * largest;
    let gaps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let least = gaps.filter(|gap| *gap > finest).min_by(f64::total_cmp);
    least.unwrap_or(finest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::diagnosis::tests::{Noise, bearing, steady};
    use crate::signal::diagnosis::{Diagnosis, FaultOrders};

    #[test]
    fn repeated_noise_has_no_verdict() {
        let mut noise = Noise(91);
        let piece: Vec<f64> = (0..3049).map(|_| noise.normal()).collect();
        let judged = |values: Vec<f64>| {
            let series = TimeSeries::new(0.0, 1.0 / 12e3, "g", values).unwrap();
            let orders = FaultOrders::of(&bearing(), 0.01).unwrap();
            Diagnosis::of(&series, None, series.span(), steady, &orders)
        };
        let found = judged(piece.repeat(40));
        let Err(DiagnosisError::Repeated { period_s }) = found else {
            panic!("{found:?}");
        };
        assert!((period_s - 3049.0 / 12e3).abs() < 1e-12, "{period_s}");
        // one value of 121 960 that differs is no repetition
        let mut other = piece.repeat(40);
        other[100_000] += 1e-9;
        assert!(!matches!(judged(other), Err(DiagnosisError::Repeated { .. })));
    }

    #[test]
    fn periods_are_those_of_all_values() {
        let ramp: Vec<f64> = (0..30).map(f64::from).collect();
        assert_eq!(period(&ramp), None);
        assert_eq!(period(&ramp.repeat(2)), Some(30));
        assert_eq!(period(&[ramp.repeat(1), ramp[..16].to_vec()].concat()), Some(30));
        assert_eq!(period(&[ramp.repeat(1), ramp[..14].to_vec()].concat()), None);
        assert_eq!(period(&[1.0; 100]), None);
        assert_eq!(period(&ramp[..3]), None);
    }
}

#[cfg(test)]
mod rounding_tests {
    use super::*;
    use crate::signal::diagnosis::tests::{RATE, bearing, judged, steady, with_noise};
    use crate::signal::diagnosis::{Diagnosis, FaultOrders};
    use std::f64::consts::TAU;

    fn series(value: impl Fn(f64) -> f64, stored: impl Fn(f64) -> f64) -> TimeSeries {
        let values = (0..4 * RATE as usize).map(|k| stored(value(k as f64 / RATE)));
        TimeSeries::new(0.0, 1.0 / RATE, "g", values.collect()).unwrap()
    }

    #[test]
    fn what_has_no_noise_is_refused() {
        let orders = FaultOrders::of(&bearing(), 0.01).unwrap();
        let sine = |t: f64| (TAU * 107.3 * t).sin();
        let sines = |t: f64| [25.0, 89.6, 1234.5, 2222.2].map(|f| (TAU * f * t).sin()).iter().sum();
        let chirp = |t: f64| (TAU * (100.0 + 100.0 * t) * t).sin();
        let square = |t: f64| (TAU * 50.0 * t + 0.1).sin().signum();
        let whole = |x: f64| x;
        let single = |x: f64| f64::from(x as f32);
        let short = |x: f64| (8000.0 * x).round();
        let offset = |x: f64| f64::from((1e6 + x) as f32);
        let signals: [&dyn Fn(f64) -> f64; 5] = [&sine, &sines, &chirp, &square, &|t| t];
        let stored: [&dyn Fn(f64) -> f64; 4] = [&whole, &single, &short, &offset];
        for (which, signal) in signals.iter().enumerate() {
            for (how, stored) in stored.iter().enumerate() {
                let series = series(signal, stored);
                let found = Diagnosis::of(&series, None, series.span(), steady, &orders);
                assert!(matches!(found, Err(DiagnosisError::NoNoise { .. })), "{which} {how}: {found:?}");
            }
        }
    }

    /// The noise of a recorder of 16 bits is half of its step at least.
    #[test]
    fn noise_of_half_a_step_is_enough() {
        let tones: Vec<f64> = (0..4 * RATE as usize).map(|k| 2e4 * (TAU * 107.3 * k as f64 / RATE).sin()).collect();
        let noisy = with_noise(&tones, 0.5, 61);
        let rounded = noisy.values().iter().map(|value| value.round() / 32768.0);
        let series = TimeSeries::new(0.0, 1.0 / RATE, "g", rounded.collect()).unwrap();
        let found = judged(&series, steady, &bearing(), 0.01);
        assert!(found.is_judged() && found.unexplained.is_empty());
        // an offset that double precision holds takes nothing away
        let offset = noisy.values().iter().map(|value| 1e9 + value);
        let series = TimeSeries::new(0.0, 1.0 / RATE, "g", offset.collect()).unwrap();
        assert!(judged(&series, steady, &bearing(), 0.01).is_judged());
    }
}
