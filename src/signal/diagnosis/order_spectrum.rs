//! Spectrum of an envelope over the shaft's angle, for a verdict.
//!
//! Instants at equal angles of the shaft, and the means of a signal between them.

use super::DiagnosisError;
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::{BandEnvelope, WindowFunction, amplitude_spectrum};
use serde::Serialize;

/// Least padding: lines between bins are then read 0.6 % low at most.
const PADDING: f64 = 8.0;
/// Amplitude of an envelope over the order, events per shaft turn.
///
/// The envelope is averaged over equal angles before it is transformed, so that a speed that changes in the window smears
/// nothing: a run-up's lines are as sharp as those of a constant speed.
///
/// Why it is not interpolated at P samples a turn: the filter reaches 32 / P of a turn to each side, in all a tenth of the shortest
/// window that is judged (6.2 turns, P = 100), which is lost where a record ends with its window. And it takes 64 / P of a turn for
/// every value, 11 600 samples of an envelope at 400 kHz and 22 Hz, where an average takes each sample once.
///
/// The price are images: of what is at P - q there is a part sinc((P - q) / P) at q, 0.50 at q = 0.4 P and 0.11 at 0.1 P. Those of
/// the bursts of highest order (its harmonics from the 14th on; P is 22.5 times it) lie halfway between its lines, those of other
/// parts anywhere; noise is raised by 1.7 at most (in power, at the highest order).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnvelopeOrderSpectrum {
    /// Orders from 0, equally spaced.
    pub order: Vec<f64>,
    /// Amplitudes, same length, in `unit`.
    pub amplitude: Vec<f64>,
    /// Unit of the amplitudes.
    pub unit: String,
    /// Turns of the shaft in the window; orders 1 / turns apart can be told apart.
    pub turns: f64,
    /// Mean of the envelope, in `unit`.
    pub mean: f64,
    /// Highest order that is not cut by the sampling.
    pub highest: f64,
}

impl EnvelopeOrderSpectrum {
    /// The same of the magnitude of a band's envelope, in a unit; the window ends with the envelope at the latest.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub(super) fn of_band(
        envelope: &BandEnvelope,
        unit: &str,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64,
        highest: f64,
    ) -> Result<Self, DiagnosisError> {
        let magnitude = TimeSeries::new(envelope.start_s, envelope.step_s, unit, envelope.magnitude())?;
        let to = window.to.min(magnitude.end_s());
        Self::new(&magnitude, TimeWindow { to, ..window }, turns, highest)
    }

    /// Spectrum of an envelope in a window (s), up to `highest` > 0 orders or what the sampling gives; `turns` is the shaft's
    /// angle at a time (s), in turns.
    ///
    /// # Errors
    /// As `AngleGrid::new`, and of a window outside the envelope.
    pub fn new(
        envelope: &TimeSeries,
        window: TimeWindow,
        turns: impl Fn(f64) -> f64,
        highest: f64,
    ) -> Result<Self, DiagnosisError> {
        let part = envelope.window(window.from, window.to)?;
        let step_s = part.step_s();
        let grid = AngleGrid::new(part.span(), step_s, turns, highest)?;
        let means = grid.means(part.start_s(), step_s, part.values());
        // a series over turns in the place of seconds
        let series = TimeSeries::new(0.0, 1.0 / grid.per_turn, part.unit(), means)?;
        let turned = series.duration_s();
        let spectrum = amplitude_spectrum(&series, WindowFunction::Boxcar, 1.0 / (PADDING * turned))?;
        Ok(Self {
            order: spectrum.frequency_hz,
            amplitude: spectrum.amplitude,
            unit: spectrum.unit,
            turns: turned,
            mean: series.mean(),
            highest: grid.highest(),
        })
    }
}

/// Values a turn for each order that is to be seen: two would do. A mean over 1 / P of a turn has the gain
/// sinc(order / P), 0.76 at the highest order and 0.90 at a quarter of P.
const VALUES_AN_ORDER: f64 = 2.5;
/// Fewest values at equal angles.
const FEWEST: usize = 16;

/// Instants at equal angles of the shaft within a window.
#[derive(Debug, Clone)]
pub(super) struct AngleGrid {
    /// One more than there are values, s.
    times: Vec<f64>,
    /// Values a turn.
    pub(super) per_turn: f64,
    /// Highest speed in the window, Hz.
    pub(super) fastest_hz: f64,
}

impl AngleGrid {
    /// Grid for orders up to `highest` > 0 in a window (s); `turns` is the shaft's angle at a time (s), in turns, looked at every
    /// `step_s`.
    ///
    /// # Errors
    /// [`DiagnosisError::Refused`] for a shaft that rests or turns back, and for too few samples.
    pub(super) fn new(
        window: TimeWindow,
        step_s: f64,
        turns: impl Fn(f64) -> f64,
        highest: f64,
    ) -> Result<Self, DiagnosisError> {
        let samples = ((window.to - window.from) / step_s + 1e-6).floor().max(1.0) as usize;
        let time = |k: usize| window.from + k as f64 * step_s;
        let origin = turns(window.from);
        let sign = (turns(time(samples)) - origin).signum();
        let angles: Vec<f64> = (0..=samples).map(|k| sign * (turns(time(k)) - origin)).collect();
        let mut fastest = 0.0_f64;
        for (k, pair) in angles.windows(2).enumerate() {
            let step = pair[1] - pair[0];
            // NaN does not turn on either
            if step.is_nan() || step <= 0.0 {
                return Err(DiagnosisError::Refused(format!(
                    "from {} s to {} s: expected a shaft that turns one way all the time, found one that rests or turns \
                     back at {} s",
                    window.from,
                    window.to,
                    time(k)
                )));
            }
            fastest = fastest.max(step);
        }
        // every mean has a sample of its own at least
        let per_turn = (VALUES_AN_ORDER * highest).min(0.9 / fastest);
        let count = (angles[samples] * per_turn).floor() as usize;
        if count < FEWEST {
            return Err(DiagnosisError::Refused(format!(
                "from {} s to {} s: expected at least {FEWEST} samples at equal angles, found {count}: a longer window, or \
                 a higher sampling rate",
                window.from, window.to
            )));
        }
        let mut times = Vec::with_capacity(count + 1);
        let mut place = 0;
        for value in 0..=count {
            let angle = value as f64 / per_turn;
            while place + 1 < samples && angles[place + 1] < angle {
                place += 1;
            }
            let part = (angle - angles[place]) / (angles[place + 1] - angles[place]);
            times.push(time(place) + part * step_s);
        }
        Ok(Self { times, per_turn, fastest_hz: fastest / step_s })
    }

    /// Turns of the shaft.
    pub(super) fn turns(&self) -> f64 {
        (self.times.len() - 1) as f64 / self.per_turn
    }

    /// Highest order that its means show.
    pub(super) fn highest(&self) -> f64 {
        self.per_turn / VALUES_AN_ORDER
    }

    /// Means of a series between the instants; each value of it holds for a step, the first from `start_s` on. Beyond its ends the
    /// series goes on with its last value.
    pub(super) fn means(&self, start_s: f64, step_s: f64, values: &[f64]) -> Vec<f64> {
        let (mut whole, mut sum) = (0, 0.0);
        // integral of the values up to a place; places grow
        let mut up_to = |place: f64| {
            let wanted = (place.max(0.0) as usize).min(values.len() - 1).max(whole);
            for value in &values[whole..wanted] {
                sum += value;
            }
            whole = wanted;
            sum + (place - whole as f64) * values[whole]
        };
        let places = self.times.iter().map(|time| (time - start_s) / step_s);
        let mut ends = places.map(|place| (place, up_to(place)));
        let mut last = ends.next().unwrap_or((0.0, 0.0));
        ends.map(|end| {
            let mean = (end.1 - last.1) / (end.0 - last.0);
            last = end;
            mean
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// Amplitude at an order between its bins; 0 beyond the spectrum.
    fn at(spectrum: &EnvelopeOrderSpectrum, order: f64) -> f64 {
        let Some(&step) = spectrum.order.get(1) else {
            return 0.0;
        };
        let place = order / step;
        let below = place.floor().max(0.0) as usize;
        match spectrum.amplitude.get(below..below + 2) {
            Some(&[a, b]) => a + (place - below as f64) * (b - a),
            _ => 0.0,
        }
    }

    /// A run-up from 10 to 40 Hz in 2 s.
    fn turns(t: f64) -> f64 {
        10.0 * t + 7.5 * t * t
    }

    fn window(to: f64) -> TimeWindow {
        TimeWindow { from: 0.0, to }
    }

    #[test]
    fn a_run_up_does_not_smear_a_line() {
        let values = (0..40_000).map(|k| {
            let t = f64::from(k) / 20e3;
            3.0 + 0.5 * (TAU * 3.57 * turns(t)).cos()
        });
        let envelope = TimeSeries::new(0.0, 1.0 / 20e3, "g", values.collect()).unwrap();
        let spectrum = EnvelopeOrderSpectrum::new(&envelope, window(2.0), turns, 40.0).unwrap();
        assert!((spectrum.turns - 50.0).abs() < 0.05);
        // the average over a hundredth of a turn takes 0.2 % of this line, leakage of its image as much
        assert!((at(&spectrum, 3.57) / 0.5 - 1.0).abs() < 0.01, "{}", at(&spectrum, 3.57));
        assert!((spectrum.mean - 3.0).abs() < 0.01);
        // first zero of the window at 1 / turns, and no line elsewhere
        assert!(at(&spectrum, 3.57 + 1.0 / spectrum.turns) < 0.02);
        assert!(at(&spectrum, 2.0) < 0.01);
        assert!(at(&spectrum, 1e9).abs() < 1e-300);
    }

    #[test]
    fn what_lies_beyond_the_averages_leaves_an_image() {
        // 100 averages a turn for orders up to 40; a line at 60 comes through at 40
        let values = (0..100_000).map(|k| 1.0 + (TAU * 60.0 * 20.0 * f64::from(k) / 100e3).cos());
        let envelope = TimeSeries::new(0.0, 1e-5, "g", values.collect()).unwrap();
        let spectrum = EnvelopeOrderSpectrum::new(&envelope, window(1.0), |t| 20.0 * t, 40.0).unwrap();
        let gain = (0.6 * PI).sin() / (0.6 * PI);
        // sums of 50 samples in the place of integrals, and leakage of the image's image
        assert!((at(&spectrum, 40.0) / gain - 1.0).abs() < 0.01, "{}", at(&spectrum, 40.0));
        assert!(at(&spectrum, 37.3) < 0.02);
    }

    #[test]
    fn what_does_not_turn_on_is_refused() {
        let envelope = TimeSeries::new(0.0, 1e-3, "g", vec![1.0; 1000]).unwrap();
        let message = |turns: fn(f64) -> f64| {
            let spectrum = EnvelopeOrderSpectrum::new(&envelope, window(1.0), turns, 10.0);
            spectrum.unwrap_err().to_string()
        };
        assert_eq!(
            message(|t| if t < 0.5 { 10.0 * t } else { 5.0 }),
            "from 0 s to 1 s: expected a shaft that turns one way all the time, found one that rests or turns back at 0.5 s"
        );
        assert!(message(|_| 0.0).contains("found one that rests"));
        assert!(message(|_| f64::NAN).contains("found one that rests"));
        assert_eq!(
            message(|t| 0.01 * t),
            "from 0 s to 1 s: expected at least 16 samples at equal angles, found 0: a longer window, or a higher sampling rate"
        );
        // backwards is as good as forwards
        let back = EnvelopeOrderSpectrum::new(&envelope, window(1.0), |t| -20.0 * t, 10.0).unwrap();
        assert!((back.turns - 20.0).abs() < 1e-9);
    }
}
