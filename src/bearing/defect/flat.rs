//! A flat on a ball: the surface of a larger radius in the rolling direction, with rounded ends.

use std::f64::consts::PI;

use super::circles::Circles;
use super::contacts::{DefectContacts, offset_from, reduced, within};
use super::curve::Arc;
use super::dent::CurvatureReading;
use super::depression::Depression;
use super::floor::Floor;
use crate::bearing::error::{BearingError, positive, refused};
use crate::bearing::geometry::BearingGeometry;
use crate::bearing::materials::{ContactStiffness, Race};

/// Largest R_2 in ball radii: over 20° of a ball such a flat is a plane to 1.5e-5 of the ball's radius, and the
/// arc's distant centre would cost digits.
const FLATTEST: f64 = 1e3;

/// A flat on a ball (the source's Figure 8c).
///
/// Depth and R_2 determine the included angle: 2 mm and 0.01 mm on a ball of radius 1 mm give 22.9°, half of
/// the 46° that the source prints. [`BallFlat::included_angle`] says it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatShape {
    /// R_2, radius in the rolling direction, m, above the ball's and at most a thousand times as large.
    pub radius: f64,
    /// Depth at the middle below the ball's own circle, m, positive.
    pub depth: f64,
    /// Radius of the convex arc that rounds both ends, m, positive, at most half the ball's.
    pub rim_radius: f64,
    /// Curvature used for the stiffness on the flat.
    pub curvature: CurvatureReading,
}

/// A flat on a ball of one bearing, ready for contact queries with both races.
///
/// The `spin_angle` of all queries is the angle (rad, counter-clockwise, any turn) from the ball's radius vector
/// about the race's centre to the middle of the flat: 0 faces the outer race, π the inner one. Seen from the cage
/// a ball that rolls turns against the shaft, [`ball_spin`](crate::bearing::kinematics::DefectOrders::ball_spin)
/// times in one of its turns; at the inner race the radius vector starts from the displaced shaft.
///
/// `∂δ/∂spin_angle = −ρ n_t` at fixed position: what the spin adds to δ̇ and takes from its drive.
#[derive(Debug, Clone, PartialEq)]
pub struct BallFlat {
    shape: FlatShape,
    included_angle: f64,
    inner: Depression,
    outer: Depression,
}

impl BallFlat {
    /// Solves the contour of `shape` on a ball of `bearing`; `stiffness` is that of the healthy contacts.
    ///
    /// A flat flatter than the outer race (R_2 > R_0) is not touched there: the ball rests on its rims.
    ///
    /// # Errors
    /// [`BearingError`]: values that are not positive or R_2 out of range; a flat longer than a quarter of the
    /// ball, or nearly taken away by its rims.
    pub fn new(bearing: &BearingGeometry, shape: FlatShape, stiffness: ContactStiffness) -> Result<Self, BearingError> {
        positive("defect flat_radius", shape.radius)?;
        positive("defect depth", shape.depth)?;
        positive("defect rim_radius", shape.rim_radius)?;
        let ball = bearing.ball_radius();
        let refused = |rule| refused("defect flat_radius", shape.radius, rule);
        if shape.radius <= ball {
            return refused("must be greater than ball_radius");
        }
        if shape.radius > FLATTEST * ball {
            return refused("must be at most 1000 times ball_radius, which is flat");
        }
        let loss = match shape.curvature {
            CurvatureReading::Total => 1.0 / ball - 1.0 / shape.radius,
            CurvatureReading::Paper => 0.0,
        };
        let arc = Arc::new(ball, shape.radius, shape.depth, loss);
        let solve = |race| {
            let circles = Circles::ball(bearing, race, stiffness);
            let length = 2.0 * arc.half_angle * circles.carrier;
            Depression::new(circles, Floor::Arc(arc), length, shape.rim_radius, circles.relative)
        };
        Ok(Self { shape, included_angle: 2.0 * arc.half_angle, inner: solve(Race::Inner)?, outer: solve(Race::Outer)? })
    }

    /// What was asked for.
    pub fn shape(&self) -> &FlatShape {
        &self.shape
    }

    /// Angle (rad) that the flat takes of the ball, seen from its centre, without rims.
    pub fn included_angle(&self) -> f64 {
        self.included_angle
    }

    /// Half the arc that is not the ball's circle any more, rims included, rad.
    pub fn half_angle(&self) -> f64 {
        self.inner.rim.angle
    }

    /// Half the range of spin angle within which `race` can feel the flat, rad; [`Self::half_angle`] or more.
    pub fn contact_half_angle(&self, race: Race) -> f64 {
        self.on(race).contact_angle
    }

    /// How far, m, the ball moves towards `race` when the flat faces it: the depth, or less when its rims
    /// hold it.
    pub fn ball_drop(&self, race: Race) -> f64 {
        self.on(race).ball_drop()
    }

    /// Distance (m) from the ball's centre to its contour at `angle` (rad, any turn) from the flat's middle.
    #[cfg(test)]
    pub(crate) fn contour_radius(&self, angle: f64) -> f64 {
        self.inner.polar_radius(reduced(angle))
    }

    /// Whether `race` can feel the flat at this spin angle; outside, the plain contact alone holds.
    #[inline]
    pub fn contains(&self, race: Race, spin_angle: f64) -> bool {
        within(offset(race, spin_angle), self.on(race).contact_angle)
    }

    /// All contacts of the ball with `race`, gaps included, for a ball centre at `radius` (m) from that race's
    /// centre. No allocation; a few tenths of a microsecond over the flat.
    #[inline]
    pub fn contacts(&self, race: Race, spin_angle: f64, radius: f64) -> DefectContacts {
        let mut found = DefectContacts::none();
        self.contacts_into(race, spin_angle, radius, &mut found);
        found
    }

    /// [`Self::contacts`] in the place of what was found before.
    #[inline]
    pub fn contacts_into(&self, race: Race, spin_angle: f64, radius: f64, found: &mut DefectContacts) {
        let offset = offset(race, spin_angle);
        self.on(race).contacts_into(radius, offset, found);
    }

    #[inline]
    fn on(&self, race: Race) -> &Depression {
        match race {
            Race::Inner => &self.inner,
            Race::Outer => &self.outer,
        }
    }
}

/// Angle from the flat's middle to the direction in which the ball's circle would touch `race`, within ±π.
#[inline]
fn offset(race: Race, spin_angle: f64) -> f64 {
    match race {
        Race::Inner => -offset_from(spin_angle, PI),
        Race::Outer => -reduced(spin_angle),
    }
}
