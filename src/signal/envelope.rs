//! Envelope of a signal: magnitude of its analytic signal.

use realfft::num_complex::Complex;

use super::SignalError;
use super::fourier::{forward, inverse};
use crate::numerics::series::TimeSeries;

/// Envelope e(t) = |x + i H x|, H the Hilbert transform, by Fourier transform over the whole series: the transform of
/// H x is -i sign(f) X(f). Same instants and unit as the series; e >= |x|. Equal to
/// `abs(scipy.signal.hilbert(x))`.
///
/// The series is taken as periodic: where its end does not meet its start the envelope is wrong over a few periods
/// of the signal there. Take the envelope of a longer stretch and cut the window out of it
/// ([`EnvelopeAnalysis`](super::EnvelopeAnalysis) does).
///
/// # Errors
/// [`SignalError`], which no valid series causes.
pub fn envelope(series: &TimeSeries) -> Result<TimeSeries, SignalError> {
    let x = series.values();
    let envelope = x.iter().zip(quadrature(x)?).map(|(x, h)| x.hypot(h));
    Ok(series.with_values(envelope.collect())?)
}

/// The square of an envelope, in the square of its unit.
///
/// # Errors
/// Values whose squares are not finite.
pub fn squared(envelope: &TimeSeries) -> Result<TimeSeries, SignalError> {
    let unit = match envelope.unit() {
        "" => String::new(),
        unit => format!("({unit})^2"),
    };
    let values = envelope.values().iter().map(|value| value * value);
    let (start, step) = (envelope.start_s(), envelope.step_s());
    Ok(TimeSeries::new(start, step, unit, values.collect())?)
}

/// Hilbert transform H x of values taken as periodic.
pub(super) fn quadrature(x: &[f64]) -> Result<Vec<f64>, SignalError> {
    let points = x.len();
    let mut bins = forward(x, points)?;
    for bin in &mut bins {
        *bin *= Complex::new(0.0, -1.0);
    }
    // At zero and half the rate the Hilbert transform of a real signal vanishes; `inverse` drops what is imaginary.
    inverse(bins, points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::samples::{items, load, numbers, worst};
    use std::f64::consts::PI;

    fn series(values: Vec<f64>) -> TimeSeries {
        TimeSeries::new(0.0, 1e-5, "m/s^2", values).expect("a valid series")
    }

    #[test]
    fn envelope_of_a_modulated_carrier_is_the_modulation() {
        // Periodic in the window: exact.
        let modulation = |k: f64| 1.0 + 0.6 * (2.0 * PI * 5.0 * k / 2000.0).cos();
        let x = series(
            (0..2000).map(|k| modulation(f64::from(k)) * (2.0 * PI * 300.0 * f64::from(k) / 2000.0).sin()).collect(),
        );
        for (k, e) in envelope(&x).expect("envelope").values().iter().enumerate() {
            assert!((e - modulation(k as f64)).abs() < 1e-12, "sample {k}");
        }
    }

    #[test]
    fn agrees_with_scipy_for_even_and_odd_lengths() {
        for case in items(&load("envelope")["cases"]) {
            let found = envelope(&series(numbers(&case["x"]))).expect("envelope");
            // rounding of two transforms of 240 points
            assert!(worst(found.values(), &numbers(&case["envelope"])) < 1e-13);
        }
    }
}
