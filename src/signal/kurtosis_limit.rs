//! What Gaussian noise reaches in kurtosis.

use super::SignalError;

/// Fewest independent values for which the limit is offered; below 32 it is on the safe side.
pub(super) const FEWEST_VALUES: f64 = 8.0;

/// Kurtosis M S_2 / S_1^2 - 2 (S_1 = sum |x|^2, S_2 = sum |x|^4) of M independent complex Gaussian values is 0 on average
/// but for -2 / (M + 1), and exceeds this limit in one of `trials` trials with probability 1 - `confidence`.
///
/// (M + 1) / (M - 1) (M S_2 / S_1^2 - 1) has mean 1 and the moments of G. M. Nita and D. E. Gary, "Statistics of the
/// spectral kurtosis estimator", Publ. Astronomical Society of the Pacific 122 (2010) 595-607; its quantile by the
/// Cornish-Fisher expansion to the fourth moment. By simulation of 2e5 to 6e6 trials each, M = 32 to 1024, the rate of
/// excess is 0.4 to 1.2 of the wanted one down to 1e-4, at most 2 at 1e-5. The normal law, 2 u / sqrt(M), is exceeded
/// several times more often.
///
/// # Errors
/// [`SignalError`] unless 0 < confidence < 1.
pub(super) fn kurtosis_limit(values: f64, trials: usize, confidence: f64) -> Result<f64, SignalError> {
    if !(confidence > 0.0 && confidence < 1.0) {
        return Err(SignalError(format!("confidence must lie between 0 and 1, found {confidence}")));
    }
    let m = values;
    let variance = 4.0 * m * m / ((m - 1.0) * (m + 2.0) * (m + 3.0));
    let skewness_squared =
        4.0 * (m + 2.0) * (m + 3.0) * (5.0 * m - 7.0).powi(2) / ((m - 1.0) * (m + 4.0).powi(2) * (m + 5.0).powi(2));
    let fourth = 3.0 * (m + 2.0) * (m + 3.0) * (m.powi(3) + 98.0 * m * m - 185.0 * m + 78.0)
        / ((m - 1.0) * (m + 4.0) * (m + 5.0) * (m + 6.0) * (m + 7.0));
    let (skewness, excess) = (skewness_squared.sqrt(), fourth - 3.0);
    let z = normal_excess((1.0 - confidence) / trials as f64);
    let quantile = z + (z * z - 1.0) * skewness / 6.0 + (z.powi(3) - 3.0 * z) * excess / 24.0
        - (2.0 * z.powi(3) - 5.0 * z) * skewness_squared / 36.0;
    Ok((m - 1.0) / (m + 1.0) * (1.0 + variance.sqrt() * quantile) - 1.0)
}

/// z that a standard normal variable exceeds with probability 0 < p < 1, to 4.5e-4: Abramowitz and Stegun, "Handbook of
/// Mathematical Functions", 26.2.23.
fn normal_excess(p: f64) -> f64 {
    let t = (-2.0 * p.min(1.0 - p).ln()).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let z = t - above / below;
    if p <= 0.5 { z } else { -z }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_quantiles_are_those_of_tables() {
        for (p, z) in [(0.5, 0.0), (0.05, 1.644_854), (0.99, -2.326_348), (1e-6, 4.753_424)] {
            assert!((normal_excess(p) - z).abs() < 4.5e-4, "{p}");
        }
    }

    #[test]
    fn one_noise_in_a_hundred_exceeds_the_limit() {
        // |x|^2 of complex Gaussian noise is exponential
        let mut state = 5_u64;
        let mut exponential = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            -(((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64).ln()
        };
        for (values, limit_at) in [(64, 0.01), (500, 0.01)] {
            let limit = kurtosis_limit(f64::from(values), 1, 1.0 - limit_at).expect("a limit");
            let trials = 4000;
            let exceeding = (0..trials).filter(|_| {
                let (mut first, mut second) = (0.0, 0.0);
                for _ in 0..values {
                    let power = exponential();
                    first += power;
                    second += power * power;
                }
                f64::from(values) * second / (first * first) - 2.0 > limit
            });
            // 40 expected, 28 with 64 values; scatter 6
            let count = exceeding.count();
            assert!((15..60).contains(&count), "{values}: {count}");
        }
    }

    #[test]
    fn confidence_outside_zero_to_one_is_refused() {
        let message = |c| kurtosis_limit(100.0, 1, c).expect_err("must fail").to_string();
        assert_eq!(message(1.0), "confidence must lie between 0 and 1, found 1");
        assert!(message(f64::NAN).ends_with("found NaN"));
    }
}
