//! Speed of a shaft from a line of the signal itself.

use serde::Serialize;

use super::{FrequencyAxis, Peak, ShaftAngle, SignalError, SpeedPoint, WaveletTransform};
use crate::numerics::series::TimeSeries;

/// Frequencies of the axis in one standard deviation of the wavelet's response.
const FREQUENCIES_A_DEVIATION: f64 = 4.0;

/// Readings in one standard deviation of the longest wavelet's envelope.
const READINGS_A_DEVIATION: f64 = 2.0;

/// Readings apart that are taken for independent: two deviations of the envelope.
const STRIDE: usize = 4;

/// Independent readings in the parabola about which the scatter is taken.
const FITTED: usize = 9;

/// How a speed is read from a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedSearch {
    /// Order of the line: its frequency over the shaft's, > 0.
    pub order: f64,
    /// Lowest frequency of the line, Hz.
    pub from_hz: f64,
    /// Highest frequency of the line, Hz. No stronger line may lie between the two.
    pub to_hz: f64,
    /// Cycles of the wavelet that follows it; a speed that changes by its own part p in a second asks for fewer than
    /// 2 sqrt(f / p).
    pub cycles: f64,
}

/// A speed read from a line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpeedReading {
    /// Instant, s.
    pub time_s: f64,
    /// Speed, Hz.
    pub speed_hz: f64,
    /// Standard deviation of the reading, Hz, from its scatter.
    pub uncertainty_hz: f64,
}

impl SpeedSearch {
    /// Speed over time from the ridge of the scalogram between the limits, over the order of the line. Instants nearer to an
    /// end than the cone of influence, or without a maximum between the limits, have no reading.
    ///
    /// The uncertainty is the scatter of nine readings around it, two deviations of the wavelet's envelope apart and so
    /// independent, about a parabola through them (six degrees of freedom: known itself to 30 %). It holds what noise does, and
    /// what the speed does beyond a parabola over those nine; not what another line within the wavelet's bandwidth does
    /// steadily.
    ///
    /// # Errors
    /// [`SignalError`] for an order that is not positive, as [`WaveletTransform::scalogram`], and if fewer than nine
    /// independent readings are left.
    pub fn readings(&self, series: &TimeSeries) -> Result<Vec<SpeedReading>, SignalError> {
        if !(self.order.is_finite() && self.order > 0.0) {
            return Err(SignalError(format!("order of a line must be positive, found {}", self.order)));
        }
        let deviations = (self.to_hz / self.from_hz).ln().abs() * self.cycles;
        // a band of 1e4 deviations has no one line; what is no number is refused with the axis
        let count = (deviations * FREQUENCIES_A_DEVIATION).clamp(8.0, 4e4) as usize;
        let deviation_s = self.cycles / (std::f64::consts::TAU * self.from_hz);
        let step = deviation_s / READINGS_A_DEVIATION / series.step_s();
        let half = series.values().len() / 2;
        let transform = WaveletTransform {
            frequencies: FrequencyAxis::Logarithmic { from_hz: self.from_hz, to_hz: self.to_hz, count },
            cycles: self.cycles,
            decimation: (step as usize).clamp(1, half.max(1)),
        };
        let scalogram = transform.scalogram(series)?;
        let cone_s = scalogram.cone_s.first().copied().unwrap_or(0.0);
        let inside = |t: f64| t - series.start_s() >= cone_s && series.end_s() - t >= cone_s;
        let ridge = scalogram.ridge(self.from_hz, self.to_hz);
        let read = |(t, peak): (&f64, Option<Peak>)| {
            let speed_hz = peak?.frequency_hz / self.order;
            inside(*t).then_some(SpeedPoint { time_s: *t, speed_hz })
        };
        let points: Vec<SpeedPoint> = scalogram.time_s.iter().zip(ridge).filter_map(read).collect();
        let needed = STRIDE * (FITTED - 1) + 1;
        if points.len() < needed {
            let readings = points.len();
            return Err(SignalError(format!(
                "{readings} readings of the speed, at least {needed} needed: take a longer stretch"
            )));
        }
        let reach = STRIDE * (FITTED - 1) / 2;
        let reading = |(k, point): (usize, &SpeedPoint)| {
            let first = k.saturating_sub(reach).min(points.len() - needed);
            let around = points[first..first + needed].iter().step_by(STRIDE);
            SpeedReading { time_s: point.time_s, speed_hz: point.speed_hz, uncertainty_hz: scatter(around.copied()) }
        };
        Ok(points.iter().enumerate().map(reading).collect())
    }
}

/// Angle of the shaft from readings, linear between them.
///
/// # Errors
/// As [`ShaftAngle::from_points`].
pub fn angle_from_readings(readings: &[SpeedReading]) -> Result<ShaftAngle, SignalError> {
    let point = |reading: &SpeedReading| SpeedPoint { time_s: reading.time_s, speed_hz: reading.speed_hz };
    ShaftAngle::from_points(readings.iter().map(point).collect())
}

/// Standard deviation of speeds about the parabola through them in time.
fn scatter(points: impl Iterator<Item = SpeedPoint>) -> f64 {
    let points: Vec<SpeedPoint> = points.collect();
    let count = points.len() as f64;
    let time: Vec<f64> = points.iter().map(|p| p.time_s).collect();
    // orthogonal polynomials of degree 0, 1, 2 over these instants, taken out one after the other
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut rest: Vec<f64> = points.iter().map(|p| p.speed_hz).collect();
    let middle = time.iter().sum::<f64>() / count;
    for degree in 0..3 {
        let mut next: Vec<f64> = time.iter().map(|t| (t - middle).powi(degree)).collect();
        for known in &basis {
            remove(&mut next, known);
        }
        remove(&mut rest, &next);
        basis.push(next);
    }
    (rest.iter().map(|r| r * r).sum::<f64>() / (count - 3.0)).sqrt()
}

/// Takes out of `values` its part along `direction`.
fn remove(values: &mut [f64], direction: &[f64]) {
    let along: f64 = values.iter().zip(direction).map(|(a, b)| a * b).sum();
    let square: f64 = direction.iter().map(|b| b * b).sum();
    for (value, part) in values.iter_mut().zip(direction) {
        *value -= along / square * part;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::gaussian;
    use crate::signal::{AngleSeries, WindowFunction};
    use std::f64::consts::PI;

    const SEARCH: SpeedSearch = SpeedSearch { order: 3.0, from_hz: 60.0, to_hz: 200.0, cycles: 12.0 };

    /// 30 to 50 Hz over 4 s at 2 kHz, third order of amplitude 1 in noise.
    fn run_up(noise: f64, seed: u64) -> TimeSeries {
        let values = gaussian(8000, seed).into_iter().enumerate().map(|(k, n)| {
            let t = k as f64 * 5e-4;
            let turns = 30.0 * t + 2.5 * t * t;
            (2.0 * PI * 3.0 * turns).cos() + noise * n
        });
        TimeSeries::new(0.0, 5e-4, "m/s^2", values.collect()).expect("a valid series")
    }

    #[test]
    fn without_noise_the_speed_is_that_of_the_run_up() {
        let readings = SEARCH.readings(&run_up(0.0, 0)).expect("readings");
        assert!(readings.len() > 200);
        for reading in &readings {
            let expected = 30.0 + 5.0 * reading.time_s;
            // the chirp's own bias
            assert!((reading.speed_hz / expected - 1.0).abs() < 1e-3, "{reading:?}");
            assert!(reading.uncertainty_hz < 0.03, "{reading:?}");
        }
        let span = readings[readings.len() - 1].time_s - readings[0].time_s;
        assert!(span > 3.8, "{span}");
    }

    #[test]
    fn the_stated_uncertainty_is_the_error_in_noise() {
        let (mut errors, mut stated, mut count) = (0.0, 0.0, 0.0);
        for seed in 0..5 {
            for reading in SEARCH.readings(&run_up(0.5, seed)).expect("readings") {
                let error = reading.speed_hz - (30.0 + 5.0 * reading.time_s);
                errors += error * error;
                stated += reading.uncertainty_hz * reading.uncertainty_hz;
                count += 1.0;
            }
        }
        let ratio = (stated / errors).sqrt();
        // about 5 x 60 independent readings, and some bias of the estimate
        assert!((ratio - 1.0).abs() < 0.15, "{ratio}");
        assert!((errors / count).sqrt() > 0.02);
    }

    #[test]
    fn orders_come_out_sharp_by_the_signals_own_speed() {
        let signal = run_up(0.1, 3);
        let readings = SEARCH.readings(&signal).expect("readings");
        let angle = angle_from_readings(&readings).expect("a valid speed");
        let turns = AngleSeries::resampled(&signal, &angle, 16).expect("turns");
        let spectrum = turns.order_spectrum(WindowFunction::Hann).expect("spectrum");
        let peak = super::super::peak_near(&spectrum.order, &spectrum.amplitude, 3.0, 0.05);
        let peak = peak.expect("a line");
        assert!((peak.frequency_hz - 3.0).abs() < 0.01, "{peak:?}");
        // over time the line is smeared over 60 Hz
        assert!((peak.amplitude - 1.0).abs() < 0.1, "{peak:?}");
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let signal = run_up(0.0, 0);
        let message =
            |search: SpeedSearch, signal: &TimeSeries| search.readings(signal).expect_err("must fail").to_string();
        assert_eq!(message(SpeedSearch { order: 0.0, ..SEARCH }, &signal), "order of a line must be positive, found 0");
        assert!(message(SpeedSearch { from_hz: f64::NAN, ..SEARCH }, &signal).contains("frequencies"));
        assert!(message(SpeedSearch { from_hz: 0.0, ..SEARCH }, &signal).contains("frequencies"));
        assert!(message(SpeedSearch { cycles: 1e9, ..SEARCH }, &signal).contains("cycles"));
        let short = signal.window(0.0, 0.3).expect("inside");
        let found = message(SEARCH, &short);
        assert!(found.ends_with("readings of the speed, at least 33 needed: take a longer stretch"), "{found}");
    }
}
