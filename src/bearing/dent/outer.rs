//! The solved dent: profile, rules and what the report says of it.

use std::f64::consts::FRAC_PI_4;

use super::angle::reduced;
use super::floor::Floor;
use super::rim::Rim;
use super::shape::{DentError, DentShape, OPENING_LIMIT};
use super::stiffness::CurvatureStiffness;
use super::vector::Vector;
use crate::bearing::geometry::BearingGeometry;
use crate::bearing::materials::ContactStiffness;

/// Fraction of the way from the race's curvature to the ball's at which the floor's contact begins to
/// fade; at the ball's curvature it is gone. A choice: a ball rests on rim and floor together where the
/// floor has covered less than half of that way, so that the fade is met only when the rim carries more.
pub const FLOOR_FADE: f64 = 0.7;

/// Least in-plane relative curvature in the stiffness table, as a fraction of the race's: close to
/// conformity Hertz theory would give a patch of any length. The faded weight is 0.003 there.
const LEAST_RELATIVE: f64 = 0.01;

/// Position of a ball's centre relative to the race's (displaced) centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolarPosition {
    /// Distance ρ from the race's centre, m.
    pub radius: f64,
    /// Angle θ from x, counter-clockwise, rad; any number of turns.
    pub angle: f64,
}

/// Part of the floor that a ball can touch: `|t| < parameter`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reach {
    pub(super) parameter: f64,
    pub(super) end_point: Vector,
    pub(super) end_tangent: Vector,
    /// The floor is touchable up to the joint: a contact passes on to the rim there.
    pub(super) meets_rim: bool,
}

/// A dent in the outer race of one bearing, ready for contact queries.
#[derive(Debug, Clone, PartialEq)]
pub struct OuterDent {
    pub(super) shape: DentShape,
    /// φ_D within ±π, rad.
    pub(super) middle: f64,
    pub(super) race_radius: f64,
    pub(super) ball_radius: f64,
    pub(super) race_stiffness: f64,
    pub(super) stiffness: CurvatureStiffness,
    pub(super) floor: Floor,
    pub(super) rim: Rim,
    pub(super) reach: Option<Reach>,
    /// Half the arc within which a ball can press on a rim or the floor, rad; φ_c or more.
    pub(super) contact_angle: f64,
    /// Relative curvature of ball and floor at the joint, 1/m, as the stiffness takes it.
    pub(super) joint_curvature: f64,
}

impl OuterDent {
    /// Solves the profile of `shape` in the outer race of `bearing`; `stiffness` is that of the healthy
    /// races, computed or given: on the dent it changes in the ratio of Hertz theory.
    ///
    /// # Errors
    /// [`DentError`]: values that are not positive; a dent too deep for its length, too long for the
    /// race, or nearly taken away by its rims, with what to change.
    pub fn new(
        bearing: &BearingGeometry,
        shape: DentShape,
        stiffness: ContactStiffness,
    ) -> Result<Self, DentError> {
        shape.check()?;
        let race_radius = bearing.outer_race_radius();
        let ball_curvature = 1.0 / bearing.ball_radius();
        let floor = Floor {
            race_radius,
            half_length: 0.5 * shape.length,
            depth: shape.depth,
        };
        let limit = 2.0 * FRAC_PI_4 * race_radius;
        if shape.length > limit {
            return Err(DentError::TooLong {
                length: shape.length,
                opened: shape.length,
                limit,
            });
        }
        let rim = Rim::new(&floor, shape.rim_radius);
        let opened = 2.0 * rim.angle * race_radius;
        if opened > OPENING_LIMIT * shape.length {
            return Err(DentError::RimTooLarge {
                rim_radius: shape.rim_radius,
                length: shape.length,
                opened,
                limit: OPENING_LIMIT,
            });
        }
        if opened > limit {
            return Err(DentError::TooLong {
                length: shape.length,
                opened,
                limit,
            });
        }
        let race_relative = ball_curvature - 1.0 / race_radius;
        let table = CurvatureStiffness::new(
            bearing,
            stiffness.outer(),
            LEAST_RELATIVE * race_relative,
            ball_curvature + 1.0 / shape.rim_radius,
        )?;
        let mut dent = Self {
            shape,
            middle: reduced(shape.angle),
            race_radius,
            ball_radius: bearing.ball_radius(),
            race_stiffness: stiffness.outer(),
            stiffness: table,
            floor,
            rim,
            reach: floor_reach(&floor, &rim, ball_curvature),
            contact_angle: rim
                .farthest_ball(bearing.ball_radius(), race_radius)
                .max(rim.angle),
            joint_curvature: 0.0,
        };
        dent.joint_curvature = dent.floor_relative_curvature(rim.joint);
        Ok(dent)
    }

    /// What was asked for.
    #[must_use]
    pub fn shape(&self) -> &DentShape {
        &self.shape
    }

    /// Half the arc that is not race any more, rims included, rad.
    #[must_use]
    pub fn half_angle(&self) -> f64 {
        self.rim.angle
    }

    /// Radius of the floor at its middle, concave, m: `1 / (1/R_0 + b/a²)`.
    #[must_use]
    pub fn bottom_radius(&self) -> f64 {
        1.0 / (1.0 / self.race_radius + self.floor.elliptic_curvature(0.0))
    }

    /// How far, m, a ball at the dent's middle sinks beyond its place on the race: the depth, or less
    /// when the rims hold it.
    #[must_use]
    pub fn drop(&self) -> f64 {
        let on_race = self.race_radius - self.ball_radius;
        let bridged = self
            .rim
            .bridged(self.ball_radius)
            .map(|radius| radius - on_race);
        bridged.map_or(self.shape.depth, |held| held.min(self.shape.depth))
    }

    /// Distance (m) from the race's centre to the profile at `angle` (rad, any turn).
    #[must_use]
    pub fn profile_radius(&self, angle: f64) -> f64 {
        let offset = self.offset(angle).abs();
        let s = self.race_radius * offset;
        if offset >= self.rim.angle {
            self.race_radius
        } else if s > self.floor.half_length * self.rim.joint.sin() {
            self.rim.profile_radius(offset)
        } else {
            let x = s / self.floor.half_length;
            self.race_radius + self.floor.depth * (1.0 - x * x).max(0.0).sqrt()
        }
    }

    /// Half the arc within which a ball can press on a rim or the floor, rad: [`Self::half_angle`], or more
    /// when a dent is so short that a ball beside it, pressed into the race, overlaps the far rim.
    #[must_use]
    pub fn contact_half_angle(&self) -> f64 {
        self.contact_angle
    }
}

/// The part of the floor flatter than the ball: up to the joint, up to some parameter, or none.
fn floor_reach(floor: &Floor, rim: &Rim, ball_curvature: f64) -> Option<Reach> {
    let touchable = |t: f64| floor.at(t).curvature() < ball_curvature;
    if !touchable(0.0) {
        return None;
    }
    let meets_rim = touchable(rim.joint);
    let parameter = if meets_rim {
        rim.joint
    } else {
        Floor::bisect(0.0, rim.joint, touchable)
    };
    let end = floor.at(parameter);
    Some(Reach {
        parameter,
        end_point: end.point,
        end_tangent: end.tangent(),
        meets_rim,
    })
}

#[cfg(test)]
#[path = "outer_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "search_tests.rs"]
mod search_tests;
