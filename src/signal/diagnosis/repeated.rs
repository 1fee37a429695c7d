//! Whether a signal is a piece of another, repeated exactly: whatever the piece holds then comes at a fixed rate, as impacts do.

use super::DiagnosisError;
use crate::numerics::series::TimeSeries;

/// Values that have to come again before the rest is compared.
const BEGINNING: usize = 16;

/// Refuses a signal whose values come again exactly, to the end, at least once and a half.
///
/// # Errors
/// [`DiagnosisError::Repeated`].
pub(super) fn check_repeated(signal: &TimeSeries) -> Result<(), DiagnosisError> {
    match period(signal.values()) {
        Some(samples) => Err(DiagnosisError::Repeated { period_s: samples as f64 * signal.step_s() }),
        None => Ok(()),
    }
}

/// After how many samples all values come again. Those that begin with a run of equal values are taken for a pause.
fn period(values: &[f64]) -> Option<usize> {
    let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
    let beginning = values.get(..BEGINNING)?;
    if same(&beginning[1..], beginning) {
        return None;
    }
    let periods = 1..=values.len() * 2 / 3;
    periods.filter(|&samples| same(beginning, &values[samples..])).find(|&samples| same(values, &values[samples..]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::diagnosis::tests::{Noise, bearing, steady};
    use crate::signal::diagnosis::{Diagnosis, FaultOrders};

    #[test]
    fn repeated_noise_has_no_verdict() {
        let mut noise = Noise(91);
        let piece: Vec<f64> = (0..3049).map(|_| noise.normal()).collect();
        let judged = |values: Vec<f64>| {
            let series = TimeSeries::new(0.0, 1.0 / 12e3, "g", values).unwrap();
            let orders = FaultOrders::of(&bearing(), 0.01).unwrap();
            Diagnosis::of(&series, None, series.span(), steady, &orders)
        };
        let found = judged(piece.repeat(40));
        let Err(DiagnosisError::Repeated { period_s }) = found else {
            panic!("{found:?}");
        };
        assert!((period_s - 3049.0 / 12e3).abs() < 1e-12, "{period_s}");
        // one value of 121 960 that differs is no repetition
        let mut other = piece.repeat(40);
        other[100_000] += 1e-9;
        assert!(!matches!(judged(other), Err(DiagnosisError::Repeated { .. })));
    }

    #[test]
    fn periods_are_those_of_all_values() {
        let ramp: Vec<f64> = (0..30).map(f64::from).collect();
        assert_eq!(period(&ramp), None);
        assert_eq!(period(&ramp.repeat(2)), Some(30));
        assert_eq!(period(&[ramp.repeat(1), ramp[..16].to_vec()].concat()), Some(30));
        assert_eq!(period(&[ramp.repeat(1), ramp[..14].to_vec()].concat()), None);
        assert_eq!(period(&[1.0; 100]), None);
        assert_eq!(period(&ramp[..3]), None);
    }
}
