//! The circle that carries a defect and the circle that rolls over it.
//!
//! One description serves every planar defect, by signs:
//!
//! | defect on | carrier | side | roller |
//! |---|---|---|---|
//! | outer race | R_0 | +1 | ρ_b |
//! | inner race | r | −1 | ρ_b |
//! | ball, met by the inner race | ρ_b | −1 | r |
//! | ball, met by the outer race | ρ_b | −1 | −R_0 |
//!
//! `side` is where the carrier's material lies, outside or inside its circle. A roller's radius is positive
//! when it is convex. With m the unit normal into the carrier's material at a point P of the profile, C the
//! roller's centre and d its distance along m, negative for a concave roller:
//!
//! ```text
//! (P − C)·T = 0       d = (P − C)·m       δ = roller − d       a contact if 1/d > concave curvature of the profile
//! ```

use super::contacts::{DefectContact, Feature};
use super::curve::Vector;
use crate::bearing::geometry::BearingGeometry;
use crate::bearing::materials::{ContactStiffness, Race};

/// Carrier and roller, undamaged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Circles {
    /// Radius of the circle that carries the defect, m.
    pub carrier: f64,
    /// +1: material outside that circle; −1: inside it.
    pub side: f64,
    /// Radius of the circle that rolls over it, m; negative: concave.
    pub roller: f64,
    /// Relative curvature of ball and race in the rolling plane from their nominal radii, 1/m.
    pub relative: f64,
    /// The same across the rolling direction, of ball and groove.
    pub across: f64,
    /// k of the undamaged pair, N/m^{3/2}.
    pub stiffness: f64,
}

impl Circles {
    /// A race that carries the defect, and a ball.
    ///
    /// The inner race's radius is the effective one, which δ needs; curvatures for k take the nominal one.
    pub(super) fn race(bearing: &BearingGeometry, race: Race, stiffness: ContactStiffness) -> Self {
        let (carrier, side) = match race {
            Race::Inner => (bearing.effective_inner_race_radius(), -1.0),
            Race::Outer => (bearing.outer_race_radius(), 1.0),
        };
        Self::pair(bearing, race, stiffness, [carrier, side, bearing.ball_radius()])
    }

    /// A ball that carries the defect, and the race that meets it.
    pub(super) fn ball(bearing: &BearingGeometry, race: Race, stiffness: ContactStiffness) -> Self {
        let roller = match race {
            Race::Inner => bearing.effective_inner_race_radius(),
            Race::Outer => -bearing.outer_race_radius(),
        };
        Self::pair(bearing, race, stiffness, [bearing.ball_radius(), -1.0, roller])
    }

    fn pair(
        bearing: &BearingGeometry,
        race: Race,
        stiffness: ContactStiffness,
        [carrier, side, roller]: [f64; 3],
    ) -> Self {
        let ball = bearing.ball_curvatures();
        let groove = match race {
            Race::Inner => bearing.inner_curvatures(),
            Race::Outer => bearing.outer_curvatures(),
        };
        let (relative, across) = (ball.plane_2 + groove.plane_2, ball.plane_1 + groove.plane_1);
        Self { carrier, side, roller, relative, across, stiffness: stiffness.at(race) }
    }

    /// +1 for a convex roller, −1 for a concave one.
    #[inline]
    pub(super) fn sign(&self) -> f64 {
        self.roller.signum()
    }

    /// Curvature of the carrier, 1/m, concave positive.
    #[inline]
    pub(super) fn carrier_concavity(&self) -> f64 {
        self.side / self.carrier
    }

    /// Curvature of the roller, 1/m, convex positive: a profile more concave than this cannot be touched.
    #[inline]
    pub(super) fn roller_curvature(&self) -> f64 {
        1.0 / self.roller
    }

    /// Direction in which the undamaged carrier is touched at `offset` from the defect's middle, and the
    /// roller's centre at `distance` from the carrier's.
    #[inline]
    pub(super) fn centre(&self, distance: f64, offset: f64) -> (Vector, Vector) {
        let direction = Vector::radial(offset);
        (direction, direction.scaled(self.sign() * distance))
    }

    /// Contact beside the defect.
    #[inline]
    pub(super) fn plain(&self, distance: f64) -> DefectContact {
        let outward = self.side * self.sign();
        DefectContact {
            feature: Feature::Plain,
            delta: outward * distance + self.roller - self.side * self.carrier,
            normal_radial: outward,
            normal_tangential: 0.0,
            stiffness: self.stiffness,
        }
    }

    /// Contact with overlap `delta` whose normal into the carrier's material is `inward`, for a roller in
    /// `direction`.
    ///
    /// A ball that carries the defect is seen from the race's centre with both radius vector and normal
    /// turned round, which for a concave roller leaves one sign.
    #[inline]
    pub(super) fn contact(
        &self,
        feature: Feature,
        delta: f64,
        inward: Vector,
        direction: Vector,
        stiffness: f64,
    ) -> DefectContact {
        let sign = self.sign();
        DefectContact {
            feature,
            delta,
            normal_radial: sign * inward.dot(direction),
            normal_tangential: sign * inward.dot(direction.tangent()),
            stiffness,
        }
    }
}
