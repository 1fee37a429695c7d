//! How far two signals are apart.

use super::SignalError;
use crate::numerics::series::{TimeSeries, root_mean_square};

/// Part of a step by which the instants of two compared series may differ.
const INSTANT_TOLERANCE_STEPS: f64 = 1e-6;

/// Relative difference rms(a - b) / rms(b) of `a` against the reference `b`, dimensionless; means are not removed.
/// Both must have the same unit and the same instants (to a millionth of a step): compare signals of two methods
/// band-limited, at the very same instants.
///
/// # Errors
/// [`SignalError`] for series that differ in instants or unit, and for a reference that is zero throughout.
pub fn relative_difference(a: &TimeSeries, b: &TimeSeries) -> Result<f64, SignalError> {
    let apart = (a.start_s() - b.start_s()).abs().max((a.end_s() - b.end_s()).abs());
    // round-off counts where time has its origin far away
    let most = INSTANT_TOLERANCE_STEPS * b.step_s() + 4.0 * f64::EPSILON * b.end_s().abs();
    if a.values().len() != b.values().len() || apart > most {
        let [first, second] = [a, b].map(|x| (x.values().len(), x.start_s(), x.step_s()));
        return Err(SignalError(format!(
            "series are not sampled at the same instants: {} samples from {} s every {} s against {} from {} s every {} s",
            first.0, first.1, first.2, second.0, second.1, second.2
        )));
    }
    if a.unit() != b.unit() {
        let message = format!("series have different units: \"{}\" against \"{}\"", a.unit(), b.unit());
        return Err(SignalError(message));
    }
    let reference = b.rms();
    if reference <= 0.0 {
        return Err(SignalError::zero_reference());
    }
    let difference: Vec<f64> = a.values().iter().zip(b.values()).map(|(a, b)| a - b).collect();
    Ok(root_mean_square(&difference) / reference)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(start_s: f64, step_s: f64, unit: &str, values: &[f64]) -> TimeSeries {
        TimeSeries::new(start_s, step_s, unit, values.to_vec()).expect("a valid series")
    }

    #[test]
    fn difference_over_reference() {
        // rms((0, 1)) / rms((3, 4)) = 1 / 5: the reference is the second.
        let a = series(0.0, 0.5, "m", &[3.0, 5.0]);
        let b = series(1e-9, 0.5, "m", &[3.0, 4.0]);
        assert!((relative_difference(&a, &b).expect("comparable") - 0.2).abs() < 1e-15);
        assert!(relative_difference(&a, &a).expect("comparable") <= 0.0);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let a = series(0.0, 0.5, "m", &[3.0, 5.0]);
        let message = |b| relative_difference(&a, &b).expect_err("must fail").to_string();
        assert_eq!(
            message(series(0.25, 0.5, "m", &[1.0, 2.0])),
            "series are not sampled at the same instants: 2 samples from 0 s every 0.5 s against \
             2 from 0.25 s every 0.5 s"
        );
        assert!(message(series(0.0, 0.25, "m", &[1.0, 2.0])).starts_with("series are not sampled"));
        assert!(message(series(0.0, 0.5, "m", &[1.0])).starts_with("series are not sampled"));
        assert_eq!(message(series(0.0, 0.5, "N", &[1.0, 2.0])), "series have different units: \"m\" against \"N\"");
        assert_eq!(
            message(series(0.0, 0.5, "m", &[0.0, 0.0])),
            "relative difference needs a reference that is not zero throughout"
        );
    }
}
