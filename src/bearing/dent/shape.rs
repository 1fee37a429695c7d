//! What a user says about a dent, and the rules it must satisfy.

use thiserror::Error;

use crate::closed_form::hertz::HertzError;

/// Rim radius when none is given, m: the order of the radius left by a hard particle's edge.
pub const DEFAULT_RIM_RADIUS: f64 = 0.05e-3;

/// A dent may not be deeper than this fraction of its length: steeper is a hole, not an impression.
pub(super) const DEPTH_LIMIT: f64 = 0.25;

/// A rim may not open the dent to more than this multiple of its length.
pub(super) const OPENING_LIMIT: f64 = 1.5;

/// Which in-plane curvature of the floor enters the Hertz stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DentCurvature {
    /// Race and ellipse together, `−(1/R_0 + κ_D)`: the true curvature of the floor.
    #[default]
    Total,
    /// The ellipse alone, `−κ_D`, as the source prints in (23), (24): depth measured from a flat.
    Paper,
}

/// Elliptical dent in the outer race, in the plane of the bearing (the source's Figure 8b without the width).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DentShape {
    /// Angle of the dent's middle from x, counter-clockwise, rad; any turn.
    pub angle: f64,
    /// Length 2a along the undeformed race, m, positive.
    pub length: f64,
    /// Depth b at the middle, measured radially from the undeformed race, m, positive, at most a quarter of the length.
    pub depth: f64,
    /// Radius of the convex arc that rounds both ends, m, positive; [`DEFAULT_RIM_RADIUS`].
    pub rim_radius: f64,
    /// Curvature used for the stiffness on the floor.
    pub curvature: DentCurvature,
}

/// Why a dent is refused; the key is the name in the case file.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DentError {
    /// A value is not finite, or not positive where it must be.
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
    /// The rim takes away so much that little of the given dent is left.
    #[error(
        "defect rim_radius {rim_radius} m opens a dent of length {length} m to {opened} m, more than {limit} times: \
         take a smaller rim_radius, or a longer or shallower dent"
    )]
    RimTooLarge {
        /// Rim radius, m.
        rim_radius: f64,
        /// Length that was given, m.
        length: f64,
        /// Distance along the race between the outer ends of the rims, m.
        opened: f64,
        /// Largest allowed ratio of the two.
        limit: f64,
    },
    /// The dent, rims included, is longer than a quarter of the race.
    #[error(
        "defect length {length} m ({opened} m with its rims) is more than a quarter of the race, {limit} m"
    )]
    TooLong {
        /// Length that was given, m.
        length: f64,
        /// Length with rims, m.
        opened: f64,
        /// A quarter of the race, m.
        limit: f64,
    },
    /// Hertz theory refuses a curvature on the dent.
    #[error("contact on the defect: {0}")]
    Hertz(#[from] HertzError),
}

impl DentShape {
    /// Checks what can be said without the bearing.
    ///
    /// # Errors
    /// [`DentError::Value`], [`DentError::TooDeep`].
    pub(super) fn check(&self) -> Result<(), DentError> {
        if !self.angle.is_finite() {
            let rule = "must be finite";
            return Err(DentError::Value {
                key: "angle_deg",
                value: self.angle.to_degrees(),
                rule,
            });
        }
        for (key, value) in [
            ("length", self.length),
            ("depth", self.depth),
            ("rim_radius", self.rim_radius),
        ] {
            if !(value.is_finite() && value > 0.0) {
                let rule = "must be positive and finite";
                return Err(DentError::Value { key, value, rule });
            }
        }
        if self.depth > DEPTH_LIMIT * self.length {
            return Err(DentError::TooDeep {
                depth: self.depth,
                length: self.length,
            });
        }
        Ok(())
    }
}
