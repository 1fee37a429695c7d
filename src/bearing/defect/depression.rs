//! A floor with two rims in one circle, solved for one roller: what dents and flats have in common.

use std::f64::consts::FRAC_PI_4;

use super::circles::Circles;
use super::floor::{Floor, Reach};
use super::rim::Rim;
use super::stiffness::{self, CurvatureStiffness, Fade};
use crate::bearing::error::{BearingError, refused};

/// A rim may not open the defect to more than this multiple of its length.
pub(super) const OPENING_LIMIT: f64 = 1.5;

/// Least rim radius as a fraction of the circle's: nanometres.
const LEAST_RIM: f64 = 1e-6;

/// Largest rim radius on a convex circle, as a fraction of its radius: beyond it the arc is no edge any more.
const RIM_LIMIT: f64 = 0.5;

/// Refuses a rim radius (m) that is out of range for the circle that it rounds.
pub(super) fn rim_rules(circles: &Circles, rim_radius: f64) -> Result<(), BearingError> {
    let refused = |rule| refused("defect rim_radius", rim_radius, rule);
    if rim_radius < LEAST_RIM * circles.carrier {
        return refused("must be at least a millionth of the radius of the race or ball that it rounds");
    }
    if circles.side < 0.0 && rim_radius > RIM_LIMIT * circles.carrier {
        return refused("must be at most half the radius of the race or ball that it rounds");
    }
    Ok(())
}

/// The refusal of a defect of `length` (m), `opened` (m) with its rims, that is longer than `limit` (m).
pub(super) fn too_long(length: f64, opened: f64, limit: f64) -> BearingError {
    BearingError(format!(
        "defect length {length} m ({opened} m with its rims) is more than a quarter of the race, {limit} m"
    ))
}

/// The solved profile.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Depression {
    pub circles: Circles,
    pub floor: Floor,
    pub rim: Rim,
    pub reach: Option<Reach>,
    pub fade: Fade,
    pub stiffness: CurvatureStiffness,
    /// Half the arc within which the roller can press on a rim or the floor, rad; φ_c or more.
    pub contact_angle: f64,
    /// Relative curvature from which the floor's loss is taken, 1/m.
    floor_base: f64,
    /// By how much the chosen reading of a convex race's curvature falls short of what is touched, 1/m.
    pub shortfall: f64,
    /// Relative curvature at the joint, 1/m, as the stiffness takes it.
    pub joint_curvature: f64,
}

impl Depression {
    /// Solves `floor`, `length` (m) long without rims, in `circles` with rims of `rim_radius` (m); `floor_base` (1/m) is the relative
    /// curvature from which the floor's loss is taken for the stiffness.
    ///
    /// # Errors
    /// [`BearingError`]: rims too large; more than a quarter of the circle; a curvature that Hertz theory refuses.
    pub(super) fn new(
        circles: Circles,
        floor: Floor,
        length: f64,
        rim_radius: f64,
        floor_base: f64,
    ) -> Result<Self, BearingError> {
        let limit = 2.0 * FRAC_PI_4 * circles.carrier;
        if length > limit {
            return Err(too_long(length, length, limit));
        }
        rim_rules(&circles, rim_radius)?;
        let rim = Rim::new(&circles, &floor, rim_radius);
        let opened = 2.0 * rim.angle * circles.carrier;
        if opened > OPENING_LIMIT * length {
            return Err(BearingError(format!(
                "defect rim_radius {rim_radius} m opens a dent of length {length} m to {opened} m, more than \
                 {OPENING_LIMIT} times: take a smaller rim_radius, or a longer or shallower dent"
            )));
        }
        if opened > limit {
            return Err(too_long(length, opened, limit));
        }
        let reach = floor.reach(&circles, rim.joint);
        let shortfall = (circles.relative - floor_base).max(0.0);
        if shortfall > 0.0
            && let Some(reach) = &reach
        {
            let end = if reach.meets_rim { rim.joint } else { 0.0 };
            for t in [0.0, end] {
                stiffness::per_modulus(circles.across, floor_base - floor.loss(t))?;
            }
        }
        let most = circles.roller_curvature() + 1.0 / rim_radius;
        Ok(Self {
            stiffness: CurvatureStiffness::new(&circles, most)?,
            reach,
            fade: Fade::new(&circles, 0.0),
            contact_angle: rim.farthest_centre(&circles).max(rim.angle),
            joint_curvature: floor_base - floor.loss(rim.joint),
            floor_base,
            shortfall,
            rim,
            floor,
            circles,
        })
    }

    /// Relative curvature on the floor in the rolling plane, 1/m, in the chosen reading.
    #[inline]
    pub(super) fn floor_curvature(&self, t: f64) -> f64 {
        self.floor_base - self.floor.loss(t)
    }

    /// How far, m, a roller at the middle sinks beyond its place on the undamaged circle: the depth, or less
    /// when the rims hold it.
    pub(super) fn ball_drop(&self) -> f64 {
        let circles = &self.circles;
        let depth = circles.side * (self.floor.at(0.0).point.outward - circles.carrier);
        let bridged = self.rim.bridged(circles);
        bridged.map_or(depth, |held| held.min(depth))
    }

    /// Distance (m) from the carrier's centre to the profile at `offset` (rad) from the middle.
    pub(super) fn polar_radius(&self, offset: f64) -> f64 {
        let offset = offset.abs();
        if offset >= self.rim.angle {
            self.circles.carrier
        } else {
            self.rim.polar_radius(&self.circles, offset).unwrap_or_else(|| self.floor.polar_radius(offset))
        }
    }
}
