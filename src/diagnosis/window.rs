//! What is said of a window of a signal.

use super::angle_grid::AngleGrid;
use super::bands::{Spectra, band_spectra};
use super::comb::SHOWN_HARMONICS;
use super::explain::{Found, Search};
use super::findings::envelope_name;
use super::shaft_speed::{SpeedFit, UNSEEN_ERROR, sharpened, speed_of_races};
use super::verdict::UnexplainedImpacts;
use super::{Conclusion, DiagnosisError, EnvelopeOrderSpectrum, Fault, FaultOrders, FaultVerdict};
use crate::series::{TimeSeries, TimeWindow};
use crate::signal::WhiteSpectrum;

/// The lowest frequency of a band over the highest at which a part strikes: an envelope needs a carrier that is faster than it.
const LOWEST_CARRIER: f64 = 2.0;

/// How well the shaft's speed is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpeedSource {
    /// Exactly: a simulation's.
    Exact,
    /// As given, and the signal's own lines do not show it better.
    Given,
    /// As given, sharpened by the shaft's lines in the signal.
    Sharpened,
    /// As given, sharpened by the lines of both races, `BPFO + BPFI = N`.
    Races,
}

/// What is said of a window.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Mean shaft speed, Hz: the given one, sharpened where the signal shows it.
    pub speed_hz: f64,
    /// The mean speed that was given, Hz.
    pub given_speed_hz: f64,
    /// Relative uncertainty of the speed.
    pub speed_error: f64,
    /// Where it is from.
    pub speed_source: SpeedSource,
    /// The envelope that shows most.
    pub envelope: String,
    /// How many were judged.
    pub envelopes: usize,
    /// Spectrum of that envelope over the shaft's angle.
    pub spectrum: EnvelopeOrderSpectrum,
    /// One verdict a fault whose order is known, in the order of [`Fault::ALL`](super::Fault::ALL).
    pub faults: Vec<FaultVerdict>,
    /// Impacts that belong to no part.
    pub unexplained: Vec<UnexplainedImpacts>,
}

impl Diagnosis {
    /// Judges a window (s) of a signal by the envelopes of its bands `within_hz` (Hz; `None`: all); `turns` is the shaft's angle at
    /// a time, in turns. The signal may be longer than the window.
    ///
    /// An error of the orders of 0 means that the speed is exact as well.
    ///
    /// # Errors
    /// [`DiagnosisError`]: a shaft that rests or turns back, a window outside the signal or without samples.
    pub fn of(
        signal: &TimeSeries,
        within_hz: Option<[f64; 2]>,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64,
        orders: &FaultOrders,
    ) -> Result<Self, DiagnosisError> {
        let samples = signal.values().len();
        window.check_inside(signal.start_s(), signal.step_s(), samples)?;
        if signal.window(window.from, window.to)?.kurtosis().is_none() {
            return Err(DiagnosisError::Constant {
                from_s: window.from,
                to_s: window.to,
            });
        }
        let highest = (f64::from(SHOWN_HARMONICS) + 1.0) * orders.highest();
        let grid = AngleGrid::new(window, signal.step_s(), &turns, highest)?;
        let white = WhiteSpectrum::of(signal)?;
        let strikes_hz = orders.highest() * grid.fastest_hz;
        let asked_hz = within_hz;
        let within_hz = edges(
            within_hz,
            0.5 * signal.rate_hz(),
            LOWEST_CARRIER * strikes_hz,
        );
        let mut speed = sharpened_speed(signal, &white, asked_hz, window, &turns, orders)?;
        // a signal too short for its kurtosis has no emphasis
        let impulsive = white.impulsive(signal).ok();
        let given_speed_hz =
            (turns(window.to) - turns(window.from)).abs() / (window.to - window.from);
        let search = |speed: SharpenedSpeed| -> Result<(Spectra, Found), DiagnosisError> {
            let sharp = |time: f64| speed.factor * turns(time);
            let grid = AngleGrid::new(window, signal.step_s(), sharp, highest)?;
            let spectra = band_spectra(
                &white,
                impulsive.as_ref(),
                &grid,
                within_hz,
                strikes_hz,
                highest,
            )?;
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
            speed = SharpenedSpeed::by(races, SpeedSource::Races);
            (spectra, found) = search(speed)?;
        }
        let sharp = |time: f64| speed.factor * turns(time);
        let best = spectra
            .lines
            .get(found.spectrum)
            .ok_or(DiagnosisError::NoEnvelope)?;
        let envelope = white.envelope(best.band_hz);
        let magnitude = envelope.squared.iter().map(|power| power.sqrt()).collect();
        let shown = TimeSeries::new(envelope.start_s, envelope.step_s, "", magnitude)?;
        let shown_window = TimeWindow {
            from: window.from,
            to: window.to.min(shown.end_s()),
        };
        Ok(Self {
            speed_hz: speed.factor * given_speed_hz,
            given_speed_hz,
            speed_error: speed.error,
            speed_source: speed.source,
            envelope: envelope_name(best),
            envelopes: spectra.lines.len(),
            spectrum: EnvelopeOrderSpectrum::new(&shown, shown_window, sharp, highest)?,
            faults: found.faults,
            unexplained: found.unexplained,
        })
    }

    /// The faults that are indicated.
    pub fn named(&self) -> impl Iterator<Item = &FaultVerdict> {
        let named = |verdict: &&FaultVerdict| verdict.conclusion == Conclusion::Named;
        self.faults.iter().filter(named)
    }

    /// Takes the indication of a fault back, for a reason that the signal does not know.
    pub fn doubt(&mut self, fault: Fault, reason: &str) {
        let indicated = |verdict: &&mut FaultVerdict| {
            verdict.fault == fault && verdict.conclusion == Conclusion::Named
        };
        if let Some(verdict) = self.faults.iter_mut().find(indicated) {
            verdict.conclusion = Conclusion::NotEnough;
            verdict.why = format!("{} {reason}", verdict.why);
        }
    }

    /// The verdict in a line.
    #[must_use]
    pub fn sentence(&self) -> String {
        let of = |conclusion: Conclusion| {
            let of = self
                .faults
                .iter()
                .filter(|verdict| verdict.conclusion == conclusion);
            of.map(|verdict| verdict.fault.name()).collect::<Vec<_>>()
        };
        let parts = [
            Conclusion::Named,
            Conclusion::NotEnough,
            Conclusion::NotSeen,
        ];
        let parts = parts
            .into_iter()
            .map(|conclusion| (of(conclusion), conclusion.words()));
        let parts = parts.filter(|(faults, _)| !faults.is_empty());
        let mut parts: Vec<String> = parts
            .map(|(faults, word)| format!("{word}: {}", faults.join(", ")))
            .collect();
        parts.extend(self.unexplained.iter().map(|impacts| {
            format!(
                "impacts at {:.2} Hz with {} harmonics belong to no part of this bearing",
                impacts.frequency_hz, impacts.harmonics_seen
            )
        }));
        parts.join("; ")
    }
}

/// The band that is searched: as asked for, else from the lowest carrier on.
fn edges(asked: Option<[f64; 2]>, end_hz: f64, lowest_hz: f64) -> [f64; 2] {
    match asked {
        Some([from, to]) => [from.min(0.9 * end_hz), to.min(end_hz)],
        None => [lowest_hz.min(0.5 * end_hz), end_hz],
    }
}

/// The shaft's speed over the given one, and how well it is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct SharpenedSpeed {
    pub(super) factor: f64,
    pub(super) error: f64,
    pub(super) source: SpeedSource,
}

impl SharpenedSpeed {
    fn by(fit: SpeedFit, source: SpeedSource) -> Self {
        Self {
            factor: fit.factor,
            error: fit.error,
            source,
        }
    }
}

/// Sharpens the speed by the shaft's lines, where orders are not exact.
pub(super) fn sharpened_speed(
    signal: &TimeSeries,
    white: &WhiteSpectrum,
    within_hz: Option<[f64; 2]>,
    window: TimeWindow,
    turns: impl Fn(f64) -> f64,
    orders: &FaultOrders,
) -> Result<SharpenedSpeed, DiagnosisError> {
    if orders.is_exact() {
        return Ok(SharpenedSpeed {
            factor: 1.0,
            error: 0.0,
            source: SpeedSource::Exact,
        });
    }
    let highest = (f64::from(SHOWN_HARMONICS) + 1.0) * orders.highest();
    let grid = AngleGrid::new(window, signal.step_s(), turns, highest)?;
    let strikes_hz = orders.highest() * grid.fastest_hz;
    let within_hz = edges(
        within_hz,
        0.5 * signal.rate_hz(),
        LOWEST_CARRIER * strikes_hz,
    );
    let fit = speed_fit(signal, white, within_hz, &grid)?;
    Ok(match fit {
        Some(fit) => SharpenedSpeed::by(fit, SpeedSource::Sharpened),
        None => SharpenedSpeed {
            factor: 1.0,
            error: UNSEEN_ERROR,
            source: SpeedSource::Given,
        },
    })
}

/// The shaft's lines in the signal and in its envelope.
fn speed_fit(
    signal: &TimeSeries,
    white: &WhiteSpectrum,
    within_hz: [f64; 2],
    grid: &AngleGrid,
) -> Result<Option<SpeedFit>, DiagnosisError> {
    let envelope = white.envelope(within_hz);
    let magnitude: Vec<f64> = envelope.squared.iter().map(|power| power.sqrt()).collect();
    sharpened(
        grid,
        &[
            (signal.start_s(), signal.step_s(), signal.values()),
            (envelope.start_s, envelope.step_s, &magnitude),
        ],
    )
}
