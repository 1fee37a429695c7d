//! A signal that is compared with another: its window, the angle of its shaft, its orders.

use super::angle_grid::AngleGrid;
use super::shaft_speed::ShaftSpeed;
use super::{Diagnosis, DiagnosisError, EnvelopeOrderSpectrum, FaultOrders};
use crate::series::{TimeSeries, TimeWindow};
use crate::signal::{RawSpectrum, WhiteSpectrum};

/// A signal that is compared with another.
pub struct ComparedSignal<'a> {
    pub(super) signal: &'a TimeSeries,
    window: TimeWindow,
    turns: Box<dyn Fn(f64) -> f64 + 'a>,
    pub(super) orders: FaultOrders,
    pub(super) speed_error: f64,
    /// Mean shaft speed in the window, Hz.
    pub speed_hz: f64,
}

impl<'a> ComparedSignal<'a> {
    /// A signal that was judged, with what it was judged by.
    pub fn judged(
        signal: &'a TimeSeries,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64 + 'a,
        orders: FaultOrders,
        diagnosis: &Diagnosis,
    ) -> Self {
        let factor = diagnosis.speed_hz / diagnosis.given_speed_hz;
        Self {
            signal,
            window,
            turns: Box::new(move |time| factor * turns(time)),
            orders,
            speed_error: diagnosis.speed_error,
            speed_hz: diagnosis.speed_hz,
        }
    }

    /// A signal that is not judged. Its speed is sharpened by its own lines in the envelope of `within_hz` (Hz; `None`: all), as that of one
    /// that is.
    ///
    /// # Errors
    /// As [`Diagnosis::of`].
    pub fn earlier(
        signal: &'a TimeSeries,
        within_hz: Option<[f64; 2]>,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64 + 'a,
        orders: FaultOrders,
    ) -> Result<Self, DiagnosisError> {
        let samples = signal.values().len();
        window.check_inside(signal.start_s(), signal.step_s(), samples)?;
        let white = WhiteSpectrum::of(signal)?;
        let speed = ShaftSpeed::of(signal, &white, within_hz, window, &turns, &orders)?;
        let given_hz = (turns(window.to) - turns(window.from)).abs() / (window.to - window.from);
        Ok(Self {
            signal,
            window,
            turns: Box::new(move |time| speed.factor * turns(time)),
            orders,
            speed_error: speed.error,
            speed_hz: speed.factor * given_hz,
        })
    }

    pub(super) fn grid(&self, highest: f64) -> Result<AngleGrid, DiagnosisError> {
        AngleGrid::new(self.window, self.signal.step_s(), &self.turns, highest)
    }

    /// Spectrum of the envelope of a band (Hz) over the shaft's angle, up to an order, in the signal's unit: for a picture.
    ///
    /// # Errors
    /// As [`EnvelopeOrderSpectrum::new`].
    pub fn order_spectrum(
        &self,
        band_hz: [f64; 2],
        highest: f64,
    ) -> Result<EnvelopeOrderSpectrum, DiagnosisError> {
        let envelope = RawSpectrum::of(self.signal)?.envelope(band_hz);
        let magnitude = envelope.squared.iter().map(|power| power.sqrt()).collect();
        let shown = TimeSeries::new(
            envelope.start_s,
            envelope.step_s,
            self.signal.unit(),
            magnitude,
        )?;
        let window = TimeWindow {
            from: self.window.from,
            to: self.window.to.min(shown.end_s()),
        };
        EnvelopeOrderSpectrum::new(&shown, window, &self.turns, highest)
    }
}
