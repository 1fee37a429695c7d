//! What is said of a window of a signal.

use super::angle_grid::AngleGrid;
use super::bands::{Spectra, band_spectra, check_band, searched_band};
use super::comb::SHOWN_HARMONICS;
use super::explain::Found;
use super::findings::envelope_name;
use super::repeated::check_repeated;
use super::rounding::check_noise;
use super::search::Search;
use super::shaft_speed::{ShaftSpeed, SpeedSource, speed_of_races};
use super::strictly_periodic::say_strictly_periodic;
use super::verdict::UnexplainedImpacts;
use super::{Conclusion, DiagnosisError, EnvelopeOrderSpectrum, Fault, FaultOrders, FaultVerdict};
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::WhiteSpectrum;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// Relative change of a given speed that is said.
const SAID_CHANGE: f64 = 0.01;

/// What is said of a window.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Diagnosis {
    /// The envelope that shows most.
    pub envelope: String,
    /// How many were judged.
    pub envelopes: usize,
    /// Spectrum of that envelope over the shaft's angle. Results have nothing of it but the turns of the shaft in the window.
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
            verdict.take_back(reason);
            self.by_signal_alone.push(fault);
        }
    }

    /// Parts on which nothing can be said: the window is too short, or lines that have another reason hide theirs.
    pub(crate) fn not_judged(&self) -> impl Iterator<Item = &FaultVerdict> {
        let faults = self.faults.iter();
        faults.filter(|verdict| verdict.false_alarm.is_none())
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
            (Some(_), _) => "at another the same lines are another part's",
            (None, []) if self.is_judged() => "a wrong one hides faults",
            _ => return None,
        };
        let speed = format!("{:.2}", self.speed_hz);
        match self.speed_source {
            SpeedSource::Exact | SpeedSource::Sharpened | SpeedSource::Races => None,
            SpeedSource::Given => {
                Some(format!("no line of the signal confirms the speed of {speed} Hz: {consequence}"))
            }
            SpeedSource::EverySecond => Some(format!(
                "lines stand halfway between those of a shaft at {speed} Hz, so that it may turn half as fast: {consequence}"
            )),
            SpeedSource::EvenOnly => Some(format!(
                "only even multiples of {speed} Hz stand out, so that the shaft may turn twice as fast: {consequence}"
            )),
        }
    }

    /// What is to be checked where the speed that is used is more than 1 % from the given one.
    pub(crate) fn speed_change(&self) -> Option<String> {
        let change = self.speed_hz / self.given_speed_hz - 1.0;
        (change.abs() > SAID_CHANGE).then(|| {
            format!(
                "the speed that is used is {:.2} Hz, {}, where {:.2} Hz were given: check that these lines are not another machine's",
                self.speed_hz,
                self.speed_source.words(),
                self.given_speed_hz
            )
        })
    }

    /// The verdict in a line.
    pub fn sentence(&self) -> String {
        let of = |conclusion: Conclusion| {
            let of = self.faults.iter().filter(|verdict| verdict.conclusion == conclusion);
            of.map(|verdict| verdict.fault.name()).collect::<Vec<_>>()
        };
        let parts = [Conclusion::Named, Conclusion::NotEnough, Conclusion::NotSeen];
        let parts = parts.into_iter().map(|conclusion| (of(conclusion), conclusion.words()));
        let parts = parts.filter(|(faults, _)| !faults.is_empty());
        let mut parts: Vec<String> = parts.map(|(faults, word)| format!("{word}: {}", faults.join(", "))).collect();
        let alone = self.by_signal_alone.iter().map(|fault| fault.name());
        let alone: Vec<&str> = alone.collect();
        if !alone.is_empty() {
            parts.push(format!("by the signal alone {}: {}", Conclusion::Named.words(), alone.join(", ")));
        }
        parts.extend(self.unexplained.iter().map(|impacts| {
            format!(
                "impacts at {:.2} Hz with {} harmonics belong to no part of this bearing",
                impacts.frequency_hz, impacts.harmonics_seen
            )
        }));
        parts.extend(self.speed_doubt());
        parts.extend(self.speed_change());
        parts.join("; ")
    }
}
