//! A signal that is compared with another: its window, the angle of its shaft, its orders.

use super::angle_grid::AngleGrid;
use super::{Diagnosis, DiagnosisError, EnvelopeOrderSpectrum, Fault, FaultOrders};
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::RawSpectrum;

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
