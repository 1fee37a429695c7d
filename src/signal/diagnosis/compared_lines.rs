//! Which lines of a part are compared with an earlier signal: the harmonics that nothing else covers, in the band that shows them
//! best now, and where they are expected in each of the two signals.
//!
//! A signal that is compared with another: its window, the angle of its shaft, its orders.

use super::comb_power::Tooth;
use super::known::Strikes;
use super::order_spectrum::AngleGrid;
use super::verdict::{FaultVerdict, UNSEEN_ABOVE, UnexplainedImpacts};
use super::{Diagnosis, DiagnosisError, EnvelopeOrderSpectrum, Fault, FaultOrders};
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::RawSpectrum;

/// Harmonics that are compared.
pub(super) const COMPARED_HARMONICS: u32 = 5;

/// Whether a verdict says that chance would not do it.
fn is_seen(verdict: &FaultVerdict) -> bool {
    let chance = verdict.false_alarm;
    chance.is_some_and(|chance| chance < UNSEEN_ABOVE)
}

/// What is compared.
pub(super) struct Compared {
    pub(super) fault: Option<Fault>,
    pub(super) name: String,
    pub(super) band_hz: Option<[f64; 2]>,
    pub(super) teeth: Vec<Tooth>,
    /// Order that is expected in each signal, this one first, and how far it may be off.
    pub(super) places: [[f64; 2]; 2],
    pub(super) cage: Option<f64>,
    /// Whether the verdict says that chance would not do it.
    pub(super) seen: bool,
    /// Why it cannot be compared, if the verdict says so.
    pub(super) why_not: String,
}

impl Compared {
    pub(super) fn part(verdict: &FaultVerdict, now: &ComparedSignal<'_>, earlier: &ComparedSignal<'_>) -> Self {
        let cage = now.orders.order(Fault::Cage);
        let (by_cage, band_hz, harmonics) = match &verdict.cage_lines {
            Some(lines) => (true, Some(lines.band_hz), &lines.harmonics),
            None => (false, verdict.band_hz, &verdict.harmonics),
        };
        let fault = if by_cage { Fault::Cage } else { verdict.fault };
        let spacing = cage.unwrap_or(0.0);
        // where a signal shows the part, its comb is the verdict's; lines of others may lie within the error of the order
        let place = |signal: &ComparedSignal<'_>| {
            let mut faults = signal.diagnosis.faults.iter();
            let own = faults.find(|own| own.fault == verdict.fault);
            let found = own.and_then(|own| match (&own.cage_lines, by_cage) {
                (Some(lines), true) => Some(lines.order),
                (None, false) => own.order.filter(|_| is_seen(own)),
                _ => None,
            });
            let expected = signal.orders.order(fault).unwrap_or(verdict.expected_order);
            match found {
                Some(order) => [order, 0.0],
                None => [expected, signal.error(fault) * expected],
            }
        };
        let name = verdict.fault.name();
        // the first harmonics, with the lines beside them where they count, that coincide with nothing else in this signal
        let first = harmonics.iter().filter(|line| line.harmonic <= COMPARED_HARMONICS);
        let free = first.filter(|line| line.coincides_with.is_none());
        let teeth = free.map(|line| Tooth { harmonic: line.harmonic, beside: f64::from(line.side) * spacing });
        Self {
            fault: Some(verdict.fault),
            name: match by_cage {
                true => format!("{name} by the cage's lines"),
                false => name.to_owned(),
            },
            band_hz,
            teeth: teeth.collect(),
            places: [place(now), place(earlier)],
            cage: cage.filter(|_| fault != Fault::Cage),
            seen: is_seen(verdict),
            why_not: verdict.why.clone(),
        }
    }

    pub(super) fn impacts(
        impacts: &UnexplainedImpacts,
        now: &ComparedSignal<'_>,
        earlier: &ComparedSignal<'_>,
    ) -> Self {
        let place = |signal: &ComparedSignal<'_>| [impacts.order, signal.error(Fault::OuterRace) * impacts.order];
        let teeth = (1..=COMPARED_HARMONICS).map(|harmonic| Tooth { harmonic, beside: 0.0 });
        Self {
            fault: None,
            name: format!("impacts at {:.2} Hz", impacts.frequency_hz),
            band_hz: Some(impacts.band_hz),
            teeth: teeth.collect(),
            places: [place(now), place(earlier)],
            cage: now.orders.order(Fault::Cage),
            seen: true,
            why_not: String::new(),
        }
    }

    /// Impacts of something else that a signal shows more strongly than what is compared: their lines say nothing about it.
    pub(super) fn others<'a>(&self, earlier: &'a ComparedSignal<'_>) -> Vec<Strikes<'a>> {
        let found = earlier.diagnosis;
        let is_own = |verdict: &&FaultVerdict| Some(verdict.fault) == self.fault;
        let own = found.named().find(is_own);
        let own_db = own.and_then(|verdict| verdict.strength_db);
        let stronger = |db: Option<f64>| own.is_none() || db > own_db;
        let parts = found.named().filter_map(|verdict| {
            let other = !is_own(&verdict) && stronger(verdict.strength_db);
            let (fault, order) = match &verdict.cage_lines {
                Some(lines) => (Fault::Cage, Some(lines.order)),
                None => (verdict.fault, verdict.order),
            };
            Some(Strikes { fault: Some(fault), name: fault.name(), order: order.filter(|_| other)? })
        });
        let [expected, reach] = self.places[1];
        let is_same = |order: f64| self.fault.is_none() && (order - expected).abs() <= reach;
        let unexplained = found.unexplained.iter().filter_map(|impacts| {
            let other = !is_same(impacts.order) && stronger(impacts.strength_db);
            other.then_some(Strikes { fault: None, name: "impacts of no part", order: impacts.order })
        });
        parts.chain(unexplained).collect()
    }
}

/// A judged signal that is compared with another.
pub struct ComparedSignal<'a> {
    pub(super) signal: &'a TimeSeries,
    window: TimeWindow,
    turns: Box<dyn Fn(f64) -> f64 + 'a>,
    pub(super) orders: FaultOrders,
    /// What was found in it.
    pub(crate) diagnosis: &'a Diagnosis,
}

impl<'a> ComparedSignal<'a> {
    /// A signal with what its diagnosis was made by: the window (s), the shaft's angle at a time (turns), the orders.
    pub fn new(
        signal: &'a TimeSeries,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64 + 'a,
        orders: FaultOrders,
        diagnosis: &'a Diagnosis,
    ) -> Self {
        let factor = diagnosis.speed_hz / diagnosis.given_speed_hz;
        Self { signal, window, turns: Box::new(move |time| factor * turns(time)), orders, diagnosis }
    }

    /// How far the order of a part may be off in this signal, relative.
    pub(super) fn error(&self, fault: Fault) -> f64 {
        self.orders.error(fault) + self.diagnosis.speed_error
    }

    pub(super) fn grid(&self, highest: f64) -> Result<AngleGrid, DiagnosisError> {
        AngleGrid::new(self.window, self.signal.step_s(), &self.turns, highest)
    }

    /// Spectrum of the envelope of a band (Hz) over the shaft's angle, up to an order, in the signal's unit: for a picture.
    ///
    /// # Errors
    /// As [`EnvelopeOrderSpectrum::new`].
    pub(crate) fn order_spectrum(
        &self,
        band_hz: [f64; 2],
        highest: f64,
    ) -> Result<EnvelopeOrderSpectrum, DiagnosisError> {
        let envelope = RawSpectrum::of(self.signal)?.envelope(band_hz);
        EnvelopeOrderSpectrum::of_band(&envelope, self.signal.unit(), self.window, &self.turns, highest)
    }
}
