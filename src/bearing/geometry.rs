//! Dimensions of a radial ball bearing, checked once at the door.

use std::f64::consts::PI;

use crate::bearing::error::{BearingError, positive, refused};
use crate::bearing::hertz::PrincipalCurvatures;
use crate::bearing::kinematics::{BallRow, DefectOrders};

/// Largest radial play, either sign, as a fraction of the ball radius. Catalogue clearances stay below
/// a few percent; more than this means that a radius is wrong or in another unit.
pub const PLAY_LIMIT: f64 = 0.1;

/// Fewest and most balls that are accepted.
pub const BALL_COUNTS: std::ops::RangeInclusive<u32> = 3..=40;

/// What a drawing gives; unchecked. Lengths in m, all positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BearingDimensions {
    /// Number of balls, 3 to 40.
    pub balls: u32,
    /// Ball radius ρ_b, m.
    pub ball_radius: f64,
    /// Mass of one ball m_b, kg.
    pub ball_mass: f64,
    /// Radius r of the inner raceway at the groove's bottom, m.
    pub inner_race_radius: f64,
    /// Radius R_0 of the outer raceway at the groove's bottom, m.
    pub outer_race_radius: f64,
    /// Radius of the inner groove across the rolling direction, m; above the ball radius.
    pub inner_groove_radius: f64,
    /// Radius of the outer groove across the rolling direction, m; above the ball radius.
    pub outer_groove_radius: f64,
}

/// A radial ball bearing whose dimensions have passed every rule.
///
/// Radial play is `c = R_0 − r − 2 ρ_b` (half the diametral clearance), negative when the bearing is
/// preloaded. [`Self::with_radial_play`] moves the inner contact only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BearingGeometry {
    dimensions: BearingDimensions,
    radial_play: f64,
    orders: DefectOrders,
}

impl BearingGeometry {
    /// Checks `dimensions`.
    ///
    /// # Errors
    /// [`BearingError`]: ball count outside 3..=40; a value not positive and finite; a groove not
    /// wider than the ball; play beyond a tenth of the ball radius; balls that overlap.
    pub fn new(dimensions: BearingDimensions) -> Result<Self, BearingError> {
        let d = &dimensions;
        if !BALL_COUNTS.contains(&d.balls) {
            return Err(BearingError(format!("balls = {} must be 3 to 40", d.balls)));
        }
        for (key, value) in [
            ("ball_radius", d.ball_radius),
            ("ball_mass", d.ball_mass),
            ("inner_race_radius", d.inner_race_radius),
            ("outer_race_radius", d.outer_race_radius),
            ("inner_groove_radius", d.inner_groove_radius),
            ("outer_groove_radius", d.outer_groove_radius),
        ] {
            positive(key, value)?;
        }
        for (key, value) in
            [("inner_groove_radius", d.inner_groove_radius), ("outer_groove_radius", d.outer_groove_radius)]
        {
            if value <= d.ball_radius {
                return refused(key, value, "must be greater than ball_radius");
            }
        }
        let radial_play = checked_play(d.outer_race_radius - d.inner_race_radius - 2.0 * d.ball_radius, d.ball_radius)?;
        let pitch_radius = 0.5 * (d.outer_race_radius + d.inner_race_radius);
        let most = (PI / (d.ball_radius / pitch_radius).asin()).floor();
        if f64::from(d.balls) > most {
            let BearingDimensions { balls, ball_radius, .. } = d;
            let most = most as u32;
            return Err(BearingError(format!(
                "balls = {balls} of radius {ball_radius} m do not fit on a pitch radius of {pitch_radius} m: at most {most}"
            )));
        }
        let row = BallRow::new(d.balls, 2.0 * d.ball_radius, 2.0 * pitch_radius, 0.0)?;
        Ok(Self { dimensions, radial_play, orders: row.orders() })
    }

    /// The same bearing with radial play `play` (m; negative: preload) in place of what the radii give.
    ///
    /// Only the effective inner raceway radius `r_eff = R_0 − 2 ρ_b − c`, the one in
    /// `δ_i = r_eff + ρ_b − χ`, changes. The nominal r stays in the curvatures, the pitch radius and
    /// the orders: microns of fit do not change those, and R_0 stays where the ring and its dents are.
    ///
    /// # Errors
    /// [`BearingError`] beyond a tenth of the ball radius or not finite.
    pub fn with_radial_play(self, play: f64) -> Result<Self, BearingError> {
        let radial_play = checked_play(play, self.dimensions.ball_radius)?;
        Ok(Self { radial_play, ..self })
    }

    /// The same bearing with the radial play that gives it this free contact angle (rad, above 0 and below π/2):
    /// `c = (f_i + f_o − 1) D_b (1 − cos α)`.
    ///
    /// # Errors
    /// [`BearingError`] for another angle, and as [`Self::with_radial_play`].
    pub fn with_free_contact_angle(self, angle: f64) -> Result<Self, BearingError> {
        if !(angle > 0.0 && angle < 0.5 * PI) {
            let degrees = angle.to_degrees();
            return Err(BearingError(format!(
                "free contact angle = {degrees:.4} degrees must be above 0 and below 90"
            )));
        }
        let between_centres =
            (self.inner_conformity() + self.outer_conformity() - 1.0) * 2.0 * self.dimensions.ball_radius;
        self.with_radial_play(2.0 * between_centres * (0.5 * angle).sin().powi(2))
    }

    /// The dimensions as given.
    pub fn dimensions(&self) -> &BearingDimensions {
        &self.dimensions
    }

    /// Number of balls.
    pub fn balls(&self) -> u32 {
        self.dimensions.balls
    }

    /// Ball radius ρ_b, m.
    #[inline]
    pub fn ball_radius(&self) -> f64 {
        self.dimensions.ball_radius
    }

    /// Mass of one ball, kg.
    #[inline]
    pub fn ball_mass(&self) -> f64 {
        self.dimensions.ball_mass
    }

    /// Radius R_0 of the undeformed outer raceway, m.
    #[inline]
    pub fn outer_race_radius(&self) -> f64 {
        self.dimensions.outer_race_radius
    }

    /// Inner raceway radius `R_0 − 2 ρ_b − c` that belongs in δ_i, m; the nominal r unless play was given.
    #[inline]
    pub fn effective_inner_race_radius(&self) -> f64 {
        self.dimensions.outer_race_radius - 2.0 * self.dimensions.ball_radius - self.radial_play
    }

    /// Pitch radius `(R_0 + r) / 2` from the nominal radii, m.
    pub fn pitch_radius(&self) -> f64 {
        0.5 * (self.dimensions.outer_race_radius + self.dimensions.inner_race_radius)
    }

    /// Ball over pitch diameter, below one.
    pub(crate) fn diameter_ratio(&self) -> f64 {
        self.dimensions.ball_radius / self.pitch_radius()
    }

    /// Radial play c, m: how far the shaft can move from the middle; negative is preload.
    pub fn radial_play(&self) -> f64 {
        self.radial_play
    }

    /// Diametral clearance 2 c, m: what catalogues list.
    pub fn diametral_clearance(&self) -> f64 {
        2.0 * self.radial_play
    }

    /// Inner groove radius over ball diameter, above 1/2 (catalogue: 0.51 to 0.54).
    pub(crate) fn inner_conformity(&self) -> f64 {
        0.5 * self.dimensions.inner_groove_radius / self.dimensions.ball_radius
    }

    /// Outer groove radius over ball diameter, above 1/2 (catalogue: 0.51 to 0.54).
    pub(crate) fn outer_conformity(&self) -> f64 {
        0.5 * self.dimensions.outer_groove_radius / self.dimensions.ball_radius
    }

    /// Contact angle that an axial load sets without other forces, rad; `None` for a preloaded bearing.
    ///
    /// `cos α = 1 − c / ((f_i + f_o − 1) D_b)` with c the radial play (T. A. Harris, *Rolling Bearing Analysis*, 4th
    /// edition, section 2.2). The model of this crate is loaded radially: its own contact angle is zero.
    pub fn free_contact_angle(&self) -> Option<f64> {
        let between_centres =
            (self.inner_conformity() + self.outer_conformity() - 1.0) * 2.0 * self.dimensions.ball_radius;
        let cosine = 1.0 - self.radial_play / between_centres;
        (self.radial_play >= 0.0 && cosine >= 0.0).then(|| cosine.acos())
    }

    /// Defect orders for pure rolling, per shaft turn.
    pub fn orders(&self) -> DefectOrders {
        self.orders
    }

    /// Curvatures of a ball, 1/m.
    pub(crate) fn ball_curvatures(&self) -> PrincipalCurvatures {
        PrincipalCurvatures::sphere(self.dimensions.ball_radius)
    }

    /// Curvatures of the inner race, 1/m: concave groove, convex along the rolling direction.
    pub(crate) fn inner_curvatures(&self) -> PrincipalCurvatures {
        let BearingDimensions { inner_groove_radius, inner_race_radius, .. } = self.dimensions;
        PrincipalCurvatures { plane_1: -1.0 / inner_groove_radius, plane_2: 1.0 / inner_race_radius }
    }

    /// Curvatures of the outer race, 1/m: concave both ways.
    pub(crate) fn outer_curvatures(&self) -> PrincipalCurvatures {
        let BearingDimensions { outer_groove_radius, outer_race_radius, .. } = self.dimensions;
        PrincipalCurvatures { plane_1: -1.0 / outer_groove_radius, plane_2: -1.0 / outer_race_radius }
    }
}

fn checked_play(play: f64, ball_radius: f64) -> Result<f64, BearingError> {
    let limit = PLAY_LIMIT * ball_radius;
    if play.abs() <= limit {
        return Ok(play);
    }
    Err(BearingError(format!(
        "radial_play = {play} m (outer_race_radius - inner_race_radius - 2 ball_radius unless given) \
         must be within +-{limit} m, a tenth of the ball radius"
    )))
}

#[cfg(test)]
#[path = "geometry_tests.rs"]
mod tests;
