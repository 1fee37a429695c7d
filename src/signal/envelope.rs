//! Envelope of a signal: magnitude of its analytic signal.

use realfft::num_complex::Complex;

use super::SignalError;
use super::fourier::{forward, inverse};
use crate::series::TimeSeries;

/// Envelope e(t) = |x + i H x|, H the Hilbert transform, by Fourier transform over the whole series: the transform of
/// H x is -i sign(f) X(f). Same instants and unit as the series; e >= |x|. Equal to
/// `abs(scipy.signal.hilbert(x))`.
///
/// The series is taken as periodic: where its end does not meet its start the envelope is wrong over a few periods
/// of the signal there. Take the envelope of a longer stretch and cut the window out of it
/// ([`EnvelopeAnalysis`](super::EnvelopeAnalysis) does).
///
/// # Errors
/// [`SignalError::Transform`], which no valid series causes.
pub fn envelope(series: &TimeSeries) -> Result<TimeSeries, SignalError> {
    let x = series.values();
    let points = x.len();
    let mut bins = forward(x, points)?;
    for bin in &mut bins {
        *bin *= Complex::new(0.0, -1.0);
    }
    // At zero and half the rate the Hilbert transform of a real signal vanishes; `inverse` drops what is imaginary.
    let quadrature = inverse(bins, points)?;
    let envelope = x.iter().zip(&quadrature).map(|(x, h)| x.hypot(*h));
    Ok(series.with_values(envelope.collect())?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn series(values: Vec<f64>) -> TimeSeries {
        TimeSeries::new(0.0, 1e-5, "m/s^2", values).expect("a valid series")
    }

    #[test]
    fn envelope_of_a_modulated_carrier_is_the_modulation() {
        // Periodic in the window: exact.
        let modulation = |k: f64| 1.0 + 0.6 * (2.0 * PI * 5.0 * k / 2000.0).cos();
        let x = series(
            (0..2000)
                .map(|k| {
                    modulation(f64::from(k)) * (2.0 * PI * 300.0 * f64::from(k) / 2000.0).sin()
                })
                .collect(),
        );
        for (k, e) in envelope(&x).expect("envelope").values().iter().enumerate() {
            assert!((e - modulation(k as f64)).abs() < 1e-12, "sample {k}");
        }
    }

    #[test]
    fn agrees_with_scipy_for_even_and_odd_lengths() {
        // abs(scipy.signal.hilbert(x))[[0, 5, -1]], x_k = sin(0.7 k) + 0.1 k, n = 16 and 15; SciPy 1.17.1
        for (n, expected) in [
            (
                16,
                [0.19918075239535737, 0.6756450540462866, 1.0930871771782016],
            ),
            (
                15,
                [0.47003416593236225, 0.675883654769, 1.5823691227571886],
            ),
        ] {
            let x = series(
                (0..n)
                    .map(|k| (0.7 * f64::from(k)).sin() + 0.1 * f64::from(k))
                    .collect(),
            );
            let e = envelope(&x).expect("envelope");
            let found = [e.values()[0], e.values()[5], e.values()[n as usize - 1]];
            for (found, expected) in found.into_iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 1e-13,
                    "{found} against {expected}"
                );
            }
        }
    }
}
