//! What is said of a window of a signal.

use super::comb::HARMONICS;
use super::judge::faults;
use super::{
    Conclusion, DiagnosisError, EnvelopeOrderSpectrum, Envelopes, FaultOrders, FaultVerdict,
};
use crate::series::TimeWindow;

/// What is said of a window.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Mean shaft speed, Hz.
    pub speed_hz: f64,
    /// Which envelope shows most, of those that were judged.
    pub envelope: &'static str,
    /// How many were.
    pub envelopes: usize,
    /// Spectrum of that envelope over the shaft's angle.
    pub spectrum: EnvelopeOrderSpectrum,
    /// One verdict a fault whose order is known, in the order of [`Fault::ALL`](super::Fault::ALL).
    pub faults: Vec<FaultVerdict>,
}

impl Diagnosis {
    /// Judges a window (s) of a signal by its `envelopes`, at least one judged; `turns` is the shaft's angle at a time, in turns.
    ///
    /// Each envelope is judged by itself; the verdict is that of the one with the least probability under noise, of those that name a
    /// fault if there are any. Probabilities are those of the best of all envelopes by chance, at most their number times as large.
    /// Faults are judged from the least likely under noise on; the lines of one that is named do not count for the others.
    ///
    /// # Errors
    /// [`DiagnosisError`]: a shaft that rests or turns back, a window outside the envelope or without samples.
    pub fn of(
        envelopes: &Envelopes,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64,
        orders: &FaultOrders,
    ) -> Result<Self, DiagnosisError> {
        // room for the floor beside the highest harmonic
        let highest = (f64::from(HARMONICS) + 1.0) * orders.highest();
        let plain = EnvelopeOrderSpectrum::new(&envelopes.plain, window, &turns, highest)?;
        let trials = envelopes.judged.len();
        let judged = envelopes.judged.iter().map(|envelope| {
            let spectrum = EnvelopeOrderSpectrum::new(&envelope.series, window, &turns, highest)?;
            // of the window itself; the spectrum ends at the last whole sample
            let speed_hz =
                (turns(window.to) - turns(window.from)).abs() / (window.to - window.from);
            Ok(Self {
                speed_hz,
                envelope: envelope.name,
                envelopes: trials,
                faults: faults([&spectrum, &plain], speed_hz, orders, trials),
                spectrum,
            })
        });
        let judged: Vec<Self> = judged.collect::<Result<_, DiagnosisError>>()?;
        let place = |one: &Self| (one.named().next().is_none(), one.least_chance());
        let best = judged.into_iter().min_by(|a, b| {
            let (a, b) = (place(a), place(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        best.ok_or(DiagnosisError::NoEnvelope)
    }

    /// The least probability under noise of a fault.
    fn least_chance(&self) -> f64 {
        let chances = self.faults.iter().filter_map(|verdict| verdict.false_alarm);
        chances.fold(f64::INFINITY, f64::min)
    }

    /// The faults that are named.
    pub fn named(&self) -> impl Iterator<Item = &FaultVerdict> {
        let named = |verdict: &&FaultVerdict| verdict.conclusion == Conclusion::Named;
        self.faults.iter().filter(named)
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
            (Conclusion::Named, "fault: "),
            (Conclusion::NotEnough, "not enough evidence: "),
            (Conclusion::NotSeen, "not seen: "),
        ];
        let parts = parts
            .into_iter()
            .map(|(conclusion, word)| (of(conclusion), word));
        let parts = parts.filter(|(faults, _)| !faults.is_empty());
        let parts: Vec<String> = parts
            .map(|(faults, word)| format!("{word}{}", faults.join(", ")))
            .collect();
        parts.join("; ")
    }
}
