//! Contact queries of the hot loop: no allocation, no elliptic integral, no error.

use std::f64::consts::{PI, TAU};

use super::angle::reduced;
use super::contacts::{DentContact, DentContacts, DentFeature};
use super::outer::{FLOOR_FADE, OuterDent, PolarPosition};
use super::rim::{RimContact, smoothstep};
use super::shape::DentCurvature;
use super::vector::Vector;

impl OuterDent {
    /// Whether a ball at `angle` (rad, any turn) can touch anything but the race: half-open arc
    /// `[φ_D − φ, φ_D + φ)` with φ the [`Self::contact_half_angle`].
    ///
    /// Outside it the race contact alone holds, and [`Self::contacts`] need not be asked.
    #[must_use]
    #[inline]
    pub fn contains(&self, angle: f64) -> bool {
        within(self.offset(angle), self.contact_angle)
    }

    /// All contacts of a ball with the profile, in order of angle, gaps included (δ < 0).
    ///
    /// One on the race if the ball is not over the dent; beside it on the far rim if that is within reach.
    /// Gaps are reported where a contact may come to press; the list of pressing contacts is complete, and
    /// empty for `ρ + ρ_b ≤ R_0`: the whole profile lies at R_0 or beyond.
    /// No allocation; a few tenths of a microsecond over the dent.
    #[must_use]
    #[inline]
    pub fn contacts(&self, ball: PolarPosition) -> DentContacts {
        let offset = self.offset(ball.angle);
        let mut found = DentContacts::none();
        if !within(offset, self.contact_angle) {
            found.push(self.race_contact(ball.radius));
            return found;
        }
        let radial = Vector::radial(offset);
        let centre = radial.scaled(ball.radius);
        let mirrored = centre.mirrored();
        let polar = |feature, delta, direction: Vector, stiffness| DentContact {
            feature,
            delta,
            normal_radial: direction.dot(radial),
            normal_tangential: direction.dot(radial.tangent()),
            stiffness,
        };
        let (before, after) = (offset < -self.rim.angle, offset >= self.rim.angle);
        if before {
            found.push(self.race_contact(ball.radius));
        } else if let Some(rim) = self.rim.contact(mirrored, self.ball_radius) {
            let stiffness = self.rim_stiffness(&rim);
            let direction = rim.direction.mirrored();
            found.push(polar(
                DentFeature::RimBefore,
                rim.delta,
                direction,
                stiffness,
            ));
        }
        if !before
            && !after
            && let Some((delta, direction, stiffness)) = self.floor_contact(centre, mirrored)
        {
            found.push(polar(DentFeature::Floor, delta, direction, stiffness));
        }
        if after {
            found.push(self.race_contact(ball.radius));
        } else if let Some(rim) = self.rim.contact(centre, self.ball_radius) {
            let stiffness = self.rim_stiffness(&rim);
            found.push(polar(
                DentFeature::RimAfter,
                rim.delta,
                rim.direction,
                stiffness,
            ));
        }
        found
    }

    /// Contact with the undamaged race.
    #[inline]
    fn race_contact(&self, radius: f64) -> DentContact {
        DentContact {
            feature: DentFeature::Race,
            delta: radius + self.ball_radius - self.race_radius,
            normal_radial: 1.0,
            normal_tangential: 0.0,
            stiffness: self.race_stiffness,
        }
    }

    /// Angle from the dent's middle, within ±π.
    #[inline]
    pub(super) fn offset(&self, angle: f64) -> f64 {
        let offset = reduced(angle) - self.middle;
        if offset > PI {
            offset - TAU
        } else if offset < -PI {
            offset + TAU
        } else {
            offset
        }
    }

    /// Overlap, direction and stiffness on the floor, if the ball's foot lies where it can touch.
    #[inline]
    fn floor_contact(&self, ball: Vector, mirrored: Vector) -> Option<(f64, Vector, f64)> {
        let reach = self.reach.as_ref()?;
        let inside = |ball: Vector| {
            if reach.meets_rim {
                self.rim.beyond_joint(ball)
            } else {
                reach.end_point.minus(ball).dot(reach.end_tangent) > 0.0
            }
        };
        if !(inside(ball) && inside(mirrored)) {
            return None;
        }
        let (t, foot) = self.floor.foot(ball, reach.parameter);
        let direction = foot.tangent().normal();
        let distance = foot.point.minus(ball).dot(direction);
        let weight = if reach.meets_rim {
            1.0
        } else {
            self.floor_weight(foot.curvature())
        };
        let stiffness = weight * self.stiffness.at(self.floor_relative_curvature(t));
        Some((self.ball_radius - distance, direction, stiffness))
    }

    /// 1 on a floor flat enough, 0 where it is curved like the ball.
    #[inline]
    fn floor_weight(&self, curvature: f64) -> f64 {
        let (race, ball) = (1.0 / self.race_radius, 1.0 / self.ball_radius);
        let width = (1.0 - FLOOR_FADE) * (ball - race);
        smoothstep((ball - curvature) / width)
    }

    /// Relative curvature of ball and floor in the rolling plane, 1/m, in the chosen reading.
    #[inline]
    pub(super) fn floor_relative_curvature(&self, t: f64) -> f64 {
        let race = match self.shape.curvature {
            DentCurvature::Total => 1.0 / self.race_radius,
            DentCurvature::Paper => 0.0,
        };
        1.0 / self.ball_radius - race - self.floor.elliptic_curvature(t)
    }

    /// Stiffness on a rim: race curvature at its outer end; at its inner end zero, or the floor's where a
    /// contact passes on to it.
    #[inline]
    fn rim_stiffness(&self, contact: &RimContact) -> f64 {
        let ball = 1.0 / self.ball_radius;
        let race = ball - 1.0 / self.race_radius;
        let arc = race + (1.0 / self.rim.radius + 1.0 / self.race_radius) * contact.from_race;
        if self.reach.as_ref().is_some_and(|reach| reach.meets_rim) {
            let joint = self.joint_curvature;
            self.stiffness
                .at(joint + (arc - joint) * contact.from_joint)
        } else {
            self.stiffness.at(arc) * contact.from_joint
        }
    }
}

/// `offset` in the half-open arc `[−half, half)`; false for NaN.
#[inline]
fn within(offset: f64, half: f64) -> bool {
    -half <= offset && offset < half
}
