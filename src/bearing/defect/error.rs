//! Why a defect is refused.

use thiserror::Error;

use crate::bearing::hertz::HertzError;

/// Why a defect is refused; a key is the name in the case file.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DefectError {
    /// A value is not finite, or breaks its rule.
    #[error("defect {key} = {value} {rule}")]
    Value {
        /// Key in the case file.
        key: &'static str,
        /// Value that was given, SI.
        value: f64,
        /// What it must satisfy.
        rule: &'static str,
    },
    /// Too deep for its length.
    #[error(
        "defect depth {depth} m is more than a quarter of its length {length} m: take a shallower or a longer dent"
    )]
    TooDeep {
        /// Depth, m.
        depth: f64,
        /// Length, m.
        length: f64,
    },
    /// A dent in three dimensions without its width.
    #[error(
        "defect profile = \"surface\" needs width, the dent's extent across the race: give it, or use profile = \"in-plane\""
    )]
    NoWidth,
    /// Too deep for its width.
    #[error(
        "defect depth {depth} m is more than a quarter of its width {width} m: take a shallower or a wider dent, or \
         profile = \"in-plane\""
    )]
    TooDeepForWidth {
        /// Depth, m.
        depth: f64,
        /// Width, m.
        width: f64,
    },
    /// The rim takes away so much that little of the given dent or flat is left.
    #[error(
        "defect rim_radius {rim_radius} m opens a dent of length {length} m to {opened} m, more than {limit} times: \
         take a smaller rim_radius, or a longer or shallower dent"
    )]
    RimTooLarge {
        /// Rim radius, m.
        rim_radius: f64,
        /// Length without rims, m.
        length: f64,
        /// Distance along the circle between the outer ends of the rims, m.
        opened: f64,
        /// Largest allowed ratio of the two.
        limit: f64,
    },
    /// The defect, rims included, is longer than a quarter of the race (or ball) that carries it.
    #[error("defect length {length} m ({opened} m with its rims) is more than a quarter of the race, {limit} m")]
    TooLong {
        /// Length without rims, m.
        length: f64,
        /// Length with rims, m.
        opened: f64,
        /// A quarter of the circle, m.
        limit: f64,
    },
    /// A measured profile has too few samples for a curve.
    #[error("defect profile has {count} samples: it needs at least {least}")]
    TooFewSamples {
        /// Samples that were given.
        count: usize,
        /// Fewest that are accepted.
        least: usize,
    },
    /// A sample of a measured profile breaks a rule.
    #[error("defect profile, sample {sample}: {what} {value} m {rule}")]
    Sample {
        /// Number of the sample, from 1.
        sample: usize,
        /// Arc length or depth.
        what: &'static str,
        /// Value that was given, m.
        value: f64,
        /// What it must satisfy.
        rule: &'static str,
    },
    /// A measured profile rises or falls too steeply behind a sample.
    #[error(
        "defect profile is as steep as {slope:.2} between samples {sample} and {next}, at most {limit} is \
         possible: a measurement so steep is noise or a step; smooth it"
    )]
    Steep {
        /// Number of the sample before, from 1.
        sample: usize,
        /// Number of the sample behind, from 1.
        next: usize,
        /// Change of depth over arc length.
        slope: f64,
        /// Largest allowed.
        limit: f64,
    },
    /// Hertz theory refuses a curvature on the defect.
    #[error("contact on the defect: {0}")]
    Hertz(#[from] HertzError),
}

/// Refuses a value that is not positive and finite.
pub(super) fn positive(key: &'static str, value: f64) -> Result<(), DefectError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        let rule = "must be positive and finite";
        Err(DefectError::Value { key, value, rule })
    }
}

/// Refuses an angle (rad) that is not finite.
pub(super) fn finite_angle(angle: f64) -> Result<(), DefectError> {
    if angle.is_finite() {
        Ok(())
    } else {
        Err(DefectError::Value { key: "angle_deg", value: angle.to_degrees(), rule: "must be finite" })
    }
}
