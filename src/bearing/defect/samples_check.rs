//! The rules for the samples of a measured profile.

use super::depression::too_long;
use super::spline::LEAST_KNOTS;
use crate::bearing::error::BearingError;

/// Depth at the ends that counts as none, m: far below what is measured.
const NO_DEPTH: f64 = 1e-9;

/// Greatest depth, either sign, as a fraction of the profile's length.
const DEPTH_LIMIT: f64 = 0.25;

/// First and last arc length (m) of samples that keep every rule; `limit` (m) is the greatest length.
///
/// # Errors
/// [`BearingError`] for too few samples, with the number of a sample that breaks a rule, or for the length.
pub(super) fn span(samples: &[(f64, f64)], limit: f64) -> Result<[f64; 2], BearingError> {
    let (Some(first), Some(last), LEAST_KNOTS..) = (samples.first(), samples.last(), samples.len()) else {
        let count = samples.len();
        return Err(BearingError(format!("defect profile has {count} samples: it needs at least {LEAST_KNOTS}")));
    };
    let mut before = f64::NEG_INFINITY;
    for (index, &(s, depth)) in samples.iter().enumerate() {
        for (what, value) in [("arc length", s), ("depth", depth)] {
            if !value.is_finite() {
                return Err(refused(index, what, value, "must be finite"));
            }
        }
        if s <= before {
            let rule = "must be greater than that of the sample before";
            return Err(refused(index, "arc length", s, rule));
        }
        before = s;
    }
    for (index, &(_, depth)) in [(0, first), (samples.len() - 1, last)] {
        if depth.abs() > NO_DEPTH {
            let rule = "must be 0 at both ends: level the profile against the race, or add a sample of depth 0";
            return Err(refused(index, "depth", depth, rule));
        }
    }
    let length = last.0 - first.0;
    if length > limit {
        return Err(too_long(length, length, limit));
    }
    let deep = |&(_, depth): &(f64, f64)| depth.abs() > DEPTH_LIMIT * length;
    if let Some(index) = samples.iter().position(deep) {
        let rule = "must be within a quarter of the profile's length";
        return Err(refused(index, "depth", samples[index].1, rule));
    }
    Ok([first.0, last.0])
}

fn refused(index: usize, what: &str, value: f64, rule: &str) -> BearingError {
    BearingError(format!("defect profile, sample {}: {what} {value} m {rule}", index + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(samples: &[(f64, f64)]) -> String {
        span(samples, 1e-2).unwrap_err().to_string()
    }

    #[test]
    fn every_rule_names_the_sample() {
        let good = [(0.0, 0.0), (1e-4, 1e-6), (2e-4, 2e-6), (3e-4, 0.0)];
        assert_eq!(span(&good, 1e-2), Ok([0.0, 3e-4]));
        assert_eq!(message(&[]), "defect profile has 0 samples: it needs at least 4");
        assert_eq!(message(&good[..3]), "defect profile has 3 samples: it needs at least 4");
        let with = |index: usize, sample| {
            let mut samples = good;
            samples[index] = sample;
            message(&samples)
        };
        for (index, sample, expected) in [
            (2, (f64::NAN, 0.0), "defect profile, sample 3: arc length NaN m must be finite"),
            (1, (1e-4, f64::INFINITY), "defect profile, sample 2: depth inf m must be finite"),
            (
                2,
                (1e-4, 0.0),
                "defect profile, sample 3: arc length 0.0001 m must be greater than that of the sample before",
            ),
            (
                1,
                (1e-4, -1e-4),
                "defect profile, sample 2: depth -0.0001 m must be within a quarter of the profile's length",
            ),
        ] {
            assert_eq!(with(index, sample), expected);
        }
        for (index, sample) in [(0, (0.0, 2e-9)), (3, (3e-4, -2e-9))] {
            let found = with(index, sample);
            assert!(
                found.starts_with(&format!("defect profile, sample {}: depth", index + 1))
                    && found.contains("must be 0 at both ends"),
                "{found}"
            );
        }
        let error = span(&good, 2e-4).unwrap_err();
        assert!(error.to_string().contains("is more than a quarter of the race"), "{error}");
    }
}
