//! An elliptical dent in a race.

use super::circles::Circles;
use super::contacts::{DefectContacts, PolarPosition, RaceProfile, finite_angle, offset_from, reduced};
use super::curve::Ellipse;
use super::depression::Depression;
use super::floor::Floor;
use crate::bearing::error::{BearingError, positive};
use crate::bearing::geometry::BearingGeometry;
use crate::bearing::materials::{ContactStiffness, Race};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Rim radius when none is given, m: the order of the radius left by a hard particle's edge.
pub const DEFAULT_RIM_RADIUS: f64 = 0.05e-3;

/// A dent may not be deeper than this fraction of its length or width: steeper is a hole, not an impression.
pub(super) const DEPTH_LIMIT: f64 = 0.25;

/// Curvature in the plane that enters the Hertz stiffness of the contact on a defect.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CurvatureReading {
    /// That of the floor as it is: of race and dent together, `±1/R − κ_D`, or of the flat itself, `1/R_2`.
    #[default]
    #[serde(rename = "profile")]
    Total,
    /// As the source paper prints it: of the dent alone, `−κ_D` of its equations (23) and (24), depth measured from a
    /// flat; on a ball's flat that of the ball, `1/ρ_b` of (31).
    Paper,
}

impl CurvatureReading {
    /// Relative curvature (1/m) from which a dent's own is taken.
    pub(super) fn base(self, circles: &Circles) -> f64 {
        match self {
            Self::Total => circles.relative,
            Self::Paper => circles.roller_curvature(),
        }
    }
}

/// Elliptical dent in a race (the source's Figure 8); its width matters to [`SurfaceDent`](super::SurfaceDent) alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DentShape {
    /// Angle of the dent's middle, counter-clockwise, rad; any turn. On the outer race from x, on the inner
    /// race from the direction that is x when the shaft's angle is zero.
    pub angle: f64,
    /// Length 2a along the undeformed race, m, positive.
    pub length: f64,
    /// Extent 2c across the race, m, which [`SurfaceDent`](super::SurfaceDent) needs and [`Dent`] does not feel.
    pub width: Option<f64>,
    /// Depth b at the middle, measured radially from the undeformed race, m, positive, at most a quarter of the length.
    pub depth: f64,
    /// Radius of the convex arc that rounds both ends, m, positive; [`DEFAULT_RIM_RADIUS`].
    pub rim_radius: f64,
    /// Curvature used for the stiffness on the floor.
    pub curvature: CurvatureReading,
}

impl DentShape {
    /// Checks what can be said without the bearing.
    pub(super) fn check(&self) -> Result<(), BearingError> {
        finite_angle(self.angle)?;
        positive("defect length", self.length)?;
        positive("defect depth", self.depth)?;
        positive("defect rim_radius", self.rim_radius)?;
        if self.depth > DEPTH_LIMIT * self.length {
            let Self { depth, length, .. } = self;
            return Err(BearingError(format!(
                "defect depth {depth} m is more than a quarter of its length {length} m: take a shallower or a longer dent"
            )));
        }
        Ok(())
    }
}

/// A dent in one race of one bearing, ready for contact queries.
#[derive(Debug, Clone, PartialEq)]
pub struct Dent {
    shape: DentShape,
    race: Race,
    /// Angle of the middle within ±π, rad.
    middle: f64,
    pub(super) profile: Depression,
}

impl Dent {
    /// Solves the profile of `shape` in a race of `bearing`; `stiffness` is that of the healthy races, computed
    /// or given: on the dent it changes in the ratio of Hertz theory.
    ///
    /// # Errors
    /// [`BearingError`]: values that are not positive; a dent too deep for its length, too long for the race, or
    /// nearly taken away by its rims, with what to change; with [`CurvatureReading::Paper`] on the inner race a
    /// floor that the ball touches although the ellipse alone is as tight as the ball.
    pub fn new(
        bearing: &BearingGeometry,
        race: Race,
        shape: DentShape,
        stiffness: ContactStiffness,
    ) -> Result<Self, BearingError> {
        shape.check()?;
        let circles = Circles::race(bearing, race, stiffness);
        let floor = Floor::Ellipse(Ellipse {
            carrier: circles.carrier,
            side: circles.side,
            half_length: 0.5 * shape.length,
            depth: shape.depth,
        });
        let base = shape.curvature.base(&circles);
        Ok(Self {
            shape,
            race,
            middle: reduced(shape.angle),
            profile: Depression::new(circles, floor, shape.length, shape.rim_radius, base)?,
        })
    }

    /// What was asked for.
    pub fn shape(&self) -> &DentShape {
        &self.shape
    }

    /// Curvature of the floor at its middle, 1/m, convex positive: `±1/R − b/a²`, whichever reading the
    /// stiffness takes.
    #[cfg(test)]
    pub(crate) fn bottom_curvature(&self) -> f64 {
        -self.profile.circles.carrier_concavity() - self.profile.floor.loss(0.0)
    }
}

impl RaceProfile for Dent {
    fn race(&self) -> Race {
        self.race
    }

    fn angle(&self) -> f64 {
        self.shape.angle
    }

    /// Rims included.
    fn half_angle(&self) -> f64 {
        self.profile.rim.angle
    }

    /// More than [`Self::half_angle`] for a dent so short that a ball beside it, pressed into the race, overlaps the far rim.
    fn contact_half_angle(&self) -> f64 {
        self.profile.contact_angle
    }

    fn profile_radius(&self, angle: f64) -> f64 {
        self.profile.polar_radius(self.offset(angle))
    }

    fn ball_drop(&self) -> f64 {
        self.profile.ball_drop()
    }

    #[inline]
    fn offset(&self, angle: f64) -> f64 {
        offset_from(angle, self.middle)
    }

    /// A few tenths of a microsecond over the dent.
    #[inline]
    fn contacts_into(&self, ball: PolarPosition, found: &mut DefectContacts) {
        let offset = self.offset(ball.angle);
        self.profile.contacts_into(ball.radius, offset, found);
    }
}
