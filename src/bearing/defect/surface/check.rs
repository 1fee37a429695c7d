//! Rules for a dent with a width.

use std::f64::consts::FRAC_PI_2;

use super::super::dent::DentShape;
use super::super::depression;
use super::super::error::{DefectError, positive};
use super::outline::Outline;

/// Depth over width at most, as over length.
const DEPTH_LIMIT: f64 = 0.25;

/// The width (m) that the dent must have.
///
/// # Errors
/// [`DefectError`]: no width; not positive; as wide as the ball; the dent too deep for it.
pub(super) fn width(shape: &DentShape, ball_radius: f64) -> Result<f64, DefectError> {
    let width = shape.width.ok_or(DefectError::NoWidth)?;
    positive("width", width)?;
    // grooves are wider than the ball
    if width >= 2.0 * ball_radius {
        return Err(DefectError::Value { key: "width", value: width, rule: "must be less than the ball's diameter" });
    }
    if shape.depth > DEPTH_LIMIT * width {
        return Err(DefectError::TooDeepForWidth { depth: shape.depth, width });
    }
    Ok(width)
}

/// Length and rim against the race.
///
/// # Errors
/// [`DefectError`]: longer than a quarter of the race; a rim radius out of range.
pub(super) fn sizes(outline: &Outline) -> Result<(), DefectError> {
    let length = 2.0 * outline.half_length;
    let limit = FRAC_PI_2 * outline.circles.carrier;
    if length > limit {
        return Err(DefectError::TooLong { length, opened: length, limit });
    }
    depression::rim_rules(&outline.circles, outline.rim)
}
