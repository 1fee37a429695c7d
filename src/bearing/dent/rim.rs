//! The convex arc that rounds one end of the dent (the counter-clockwise one; the other is its mirror image).
//!
//! The centre lies in the material at radius `R_0 + r`, so that the arc touches the race. It also lies `r`
//! beyond the floor along the floor's outward normal n at the joint: one equation for the joint,
//!
//! ```text
//! |P(t) + r n(t)| = R_0 + r
//! ```
//!
//! whose left side falls monotonically from `R_0 + b + r` at the middle to below `R_0 + r` at the wall.

use std::f64::consts::FRAC_PI_2;

use super::floor::Floor;
use super::vector::Vector;

/// Sine of the contact angle (about the angle, rad) over which the curvature used for the stiffness goes
/// from the race's to the rim's, and from the rim's to what follows at its inner end; at most a third of
/// the arc each. A choice: under 10 N a ball's patch on the source's race is 0.055 mm long in the rolling
/// direction, four times the rim's whole arc (14 um), so the step in curvature is never felt as one.
pub const RIM_BLEND: f64 = 0.05;

/// One rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rim {
    /// Arc radius, m.
    pub radius: f64,
    /// Angle φ_c of the arc's centre, and of its end on the race, from the dent's middle, rad.
    pub angle: f64,
    centre: Vector,
    race_tangent: Vector,
    /// Floor parameter of the joint.
    pub joint: f64,
    joint_point: Vector,
    joint_tangent: Vector,
    /// Sine of the contact angle at the joint.
    sine_end: f64,
    /// Width of both blends in the sine.
    blend: f64,
}

/// A ball's contact with a rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RimContact {
    /// Overlap, m.
    pub delta: f64,
    /// Unit vector from the ball's centre to the contact.
    pub direction: Vector,
    /// 0 at the race, 1 past the outer blend: how much of the rim's curvature counts.
    pub from_race: f64,
    /// 0 at the joint, 1 before the inner blend.
    pub from_joint: f64,
}

impl Rim {
    /// Solves the arc between race and floor.
    pub fn new(floor: &Floor, radius: f64) -> Self {
        let centre = |t: f64| {
            let at = floor.at(t);
            at.point.plus(at.tangent().normal().scaled(radius))
        };
        let level = floor.race_radius + radius;
        let joint = Floor::bisect(0.0, FRAC_PI_2, |t| centre(t).length() > level);
        let at = floor.at(joint);
        let found = centre(joint);
        let angle = found.along.atan2(found.outward);
        let radial = Vector::radial(angle);
        let sine_end = at.tangent().normal().dot(radial.tangent());
        Self {
            radius,
            angle,
            centre: radial.scaled(level),
            race_tangent: radial.tangent(),
            joint,
            joint_point: at.point,
            joint_tangent: at.tangent(),
            sine_end,
            blend: RIM_BLEND.min(sine_end / 3.0),
        }
    }

    /// Whether the foot of `ball` on the profile near the joint lies on the floor's side of it.
    #[inline]
    pub fn beyond_joint(&self, ball: Vector) -> bool {
        self.joint_point.minus(ball).dot(self.joint_tangent) > 0.0
    }

    /// Contact of a ball whose angle is not beyond φ_c, if its foot lies on the arc.
    #[inline]
    pub fn contact(&self, ball: Vector, ball_radius: f64) -> Option<RimContact> {
        if self.beyond_joint(ball) {
            return None;
        }
        let gap = self.centre.minus(ball);
        let distance = gap.length();
        let direction = gap.scaled(1.0 / distance);
        let sine = direction.dot(self.race_tangent);
        Some(RimContact {
            delta: ball_radius + self.radius - distance,
            direction,
            from_race: smoothstep(sine / self.blend),
            from_joint: smoothstep((self.sine_end - sine) / self.blend),
        })
    }

    /// Angle from the dent's middle, on the other side of it, beyond which no ball presses on this arc, rad.
    ///
    /// The contact angle has `sin = ρ sin(φ_c + ψ) / distance`, at most that of the joint; a ball that presses
    /// anywhere has `ρ ≥ R_0 − ρ_b`, and on this arc `distance ≤ ρ_b + r`.
    pub fn farthest_ball(&self, ball_radius: f64, race_radius: f64) -> f64 {
        let sine = self.sine_end * (ball_radius + self.radius) / (race_radius - ball_radius);
        sine.min(1.0).asin() - self.angle
    }

    /// Distance from the race's centre to the arc at `angle` from the dent's middle, m (between joint and φ_c).
    pub fn profile_radius(&self, angle: f64) -> f64 {
        let ray = Vector::radial(angle);
        let across = self.centre.dot(ray.tangent());
        self.centre.dot(ray)
            - (self.radius * self.radius - across * across)
                .max(0.0)
                .sqrt()
    }

    /// Position (m from the race's centre) of a ball at the dent's middle that just touches both rims,
    /// if they are near enough to hold it.
    pub fn bridged(&self, ball_radius: f64) -> Option<f64> {
        let reach = ball_radius + self.radius;
        let along = self.centre.along;
        (along < reach).then(|| self.centre.outward - (reach * reach - along * along).sqrt())
    }
}

/// 0 below zero, 1 above one, `3 x² − 2 x³` between: continuous with its slope.
#[inline]
pub(super) fn smoothstep(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const FLOOR: Floor = Floor {
        race_radius: 4.7565e-3,
        half_length: 0.375e-3,
        depth: 15e-6,
    };

    #[test]
    fn arc_touches_race_and_floor() {
        for radius in [5e-6, 5e-5, 5e-4] {
            let rim = Rim::new(&FLOOR, radius);
            assert_relative_eq!(
                rim.profile_radius(rim.angle),
                FLOOR.race_radius,
                max_relative = 1e-14
            );
            let joint = FLOOR.at(rim.joint);
            let gap = rim.centre.minus(joint.point);
            assert_relative_eq!(gap.length(), radius, max_relative = 1e-10);
            assert_relative_eq!(gap.dot(joint.tangent()) / radius, 0.0, epsilon = 1e-10);
            // on the ray through the joint the arc and the floor have one radius
            let angle = joint.point.along.atan2(joint.point.outward);
            assert_relative_eq!(
                rim.profile_radius(angle),
                joint.point.length(),
                max_relative = 1e-13
            );
            assert!(angle < rim.angle && rim.sine_end > 0.0 && rim.sine_end < 1.0);
        }
    }

    #[test]
    fn source_rim_is_where_small_slopes_put_it() {
        // Flat race: r (1 − cos ψ) = b u, tan ψ = (b/a) sqrt(1 − u²)/u gives u = 0.1350, sin ψ = 0.2817;
        // the race's own curvature changes that by about the rim's length over R_0, 0.4 %.
        let rim = Rim::new(&FLOOR, 5e-5);
        assert_relative_eq!(rim.joint.cos(), 0.1350, epsilon = 1e-3);
        assert_relative_eq!(rim.sine_end, 0.2817, epsilon = 2e-3);
    }

    #[test]
    fn smoothstep_ends_flat() {
        for (x, y) in [(-1.0, 0.0), (0.0, 0.0), (0.5, 0.5), (1.0, 1.0), (7.0, 1.0)] {
            assert_relative_eq!(smoothstep(x), y);
        }
        assert!(smoothstep(1e-4) < 4e-8 && 1.0 - smoothstep(1.0 - 1e-4) < 4e-8);
    }
}
