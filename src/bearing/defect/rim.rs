//! The convex arc that rounds one end of a floor (the counter-clockwise one; the other is its mirror image).
//!
//! The centre lies r inside the material of the carrier's circle, so that the arc touches it: at radius
//! `R_0 + r` on an outer race, `R − r` on an inner race or a ball. It also lies r beyond the floor along the
//! floor's normal m at the joint: one equation for the joint,
//!
//! ```text
//! |P(t) + r m(t)| = R ± r
//! ```
//!
//! whose left side changes monotonically from `R ± (b + r)` at the middle to beyond `R ± r` at the wall.

use super::circles::Circles;
use super::curve::{Vector, bisect};
use super::floor::Floor;

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
    /// Angle φ_c of the arc's centre, and of its end on the circle, from the defect's middle, rad.
    pub angle: f64,
    centre: Vector,
    circle_tangent: Vector,
    /// Floor parameter of the joint.
    pub joint: f64,
    /// Angle of the joint from the defect's middle, rad.
    joint_angle: f64,
    joint_point: Vector,
    joint_tangent: Vector,
    /// Sine of the contact angle at the joint.
    sine_end: f64,
    /// Width of both blends in the sine.
    blend: f64,
}

/// A roller's contact with a rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RimContact {
    /// Overlap, m.
    pub delta: f64,
    /// Unit normal into the material.
    pub inward: Vector,
    /// 0 at the circle, 1 past the outer blend: how much of the rim's curvature counts.
    pub from_circle: f64,
    /// 0 at the joint, 1 before the inner blend.
    pub from_joint: f64,
}

impl Rim {
    /// Solves the arc between circle and floor.
    pub(super) fn new(circles: &Circles, floor: &Floor, radius: f64) -> Self {
        let side = circles.side;
        let centre = |t: f64| {
            let at = floor.at(t);
            at.point.plus(at.inward(side).scaled(radius))
        };
        let level = circles.carrier + side * radius;
        let joint = bisect(0.0, floor.wall(), |t| side * (centre(t).length() - level) > 0.0);
        let at = floor.at(joint);
        let found = centre(joint);
        let angle = found.along.atan2(found.outward);
        let radial = Vector::radial(angle);
        let sine_end = at.inward(side).dot(radial.tangent());
        Self {
            radius,
            angle,
            centre: radial.scaled(level),
            circle_tangent: radial.tangent(),
            joint,
            joint_angle: at.point.along.atan2(at.point.outward),
            joint_point: at.point,
            joint_tangent: at.tangent(),
            sine_end,
            // an arc that rounding has taken away must not be divided by
            blend: RIM_BLEND.min(sine_end / 3.0).max(f64::MIN_POSITIVE),
        }
    }

    /// Contact of a roller whose angle is not beyond φ_c, if its foot lies on the arc.
    #[inline]
    pub(super) fn contact(&self, circles: &Circles, centre: Vector) -> Option<RimContact> {
        let sign = circles.sign();
        // the foot on the profile near the joint lies on the floor's side of it
        if sign * self.joint_point.minus(centre).dot(self.joint_tangent) > 0.0 {
            return None;
        }
        let gap = self.centre.minus(centre);
        let distance = gap.length();
        let inward = if distance > 0.0 {
            gap.scaled(sign / distance)
        } else {
            self.circle_tangent.normal().scaled(circles.side)
        };
        let sine = inward.dot(self.circle_tangent);
        Some(RimContact {
            delta: circles.roller + self.radius - sign * distance,
            inward,
            from_circle: smoothstep(sine / self.blend),
            from_joint: smoothstep((self.sine_end - sine) / self.blend),
        })
    }

    /// Angle from the defect's middle, on the other side of it, beyond which no roller presses on this arc, rad.
    pub(super) fn farthest_centre(&self, circles: &Circles) -> f64 {
        farthest_centre(circles, self.radius, self.sine_end) - self.angle
    }

    /// Distance from the carrier's centre to the arc at `offset` from the defect's middle, m; `None` where
    /// the profile is floor.
    pub(super) fn polar_radius(&self, circles: &Circles, offset: f64) -> Option<f64> {
        if offset < self.joint_angle {
            return None;
        }
        let ray = Vector::radial(offset);
        let across = self.centre.dot(ray.tangent());
        let half_chord = (self.radius * self.radius - across * across).max(0.0).sqrt();
        Some(self.centre.dot(ray) - circles.side * half_chord)
    }

    /// How far, m, a roller at the defect's middle that just touches both rims is beyond its place on the
    /// undamaged circle, if they are near enough to hold it.
    pub(super) fn bridged(&self, circles: &Circles) -> Option<f64> {
        let side = circles.side;
        let reach = circles.roller + self.radius;
        let along = self.centre.along;
        let rest = reach * reach - along * along;
        (rest > 0.0).then(|| {
            let held = self.centre.outward - side * circles.sign() * rest.sqrt();
            side * (held - (circles.carrier - side * circles.roller))
        })
    }
}

/// Angle, rad, from a rim's centre to the farthest roller's centre that presses on its arc, of `radius` (m) and contact
/// angles up to that of `sine_end`.
///
/// The roller's centre is `C = c − G m`, c the arc's centre and `G = roller + r` at first touch. Seen from
/// the carrier's centre it is farthest from c for the steepest contact, at the joint, unless the line of
/// sight touches the circle of radius G about c before; and for δ = 0, since an overlap moves it back.
pub(super) fn farthest_centre(circles: &Circles, radius: f64, sine_end: f64) -> f64 {
    let (side, sign) = (circles.side, circles.sign());
    let level = circles.carrier + side * radius;
    let reach = circles.roller + radius;
    let mut cosine = (1.0 - sine_end * sine_end).max(0.0).sqrt();
    let turning = side * reach / level;
    if turning < 1.0 {
        cosine = cosine.max(turning);
    }
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let across = sign * reach * sine;
    across.atan2(sign * (level - side * reach * cosine))
}

/// 0 below zero, 1 above one, `3 x² − 2 x³` between: continuous with its slope.
#[inline]
pub(super) fn smoothstep(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::super::curve::{Arc, Ellipse};
    use super::*;
    use crate::bearing::Race;
    use crate::bearing::samples::{source_bearing, source_stiffness};
    use approx::assert_relative_eq;

    fn source(race: Race) -> (Circles, Floor) {
        let circles = Circles::race(&source_bearing(), race, source_stiffness());
        let floor = Floor::Ellipse(Ellipse {
            carrier: circles.carrier,
            side: circles.side,
            half_length: 0.375e-3,
            depth: 15e-6,
        });
        (circles, floor)
    }

    #[test]
    fn arc_touches_race_and_floor() {
        for race in [Race::Outer, Race::Inner] {
            let (circles, floor) = source(race);
            for radius in [5e-6, 5e-5, 5e-4] {
                let rim = Rim::new(&circles, &floor, radius);
                assert_relative_eq!(
                    rim.polar_radius(&circles, rim.angle).unwrap(),
                    circles.carrier,
                    max_relative = 1e-14
                );
                let joint = floor.at(rim.joint);
                let gap = rim.centre.minus(joint.point);
                assert_relative_eq!(gap.length(), radius, max_relative = 1e-10);
                assert_relative_eq!(gap.dot(joint.tangent()) / radius, 0.0, epsilon = 1e-10);
                assert!(gap.dot(joint.inward(circles.side)) > 0.0);
                // on the ray through the joint the arc and the floor have one radius
                assert_relative_eq!(
                    rim.polar_radius(&circles, rim.joint_angle).unwrap(),
                    floor.polar_radius(rim.joint_angle),
                    max_relative = 1e-13
                );
                assert!(rim.joint_angle < rim.angle && rim.sine_end > 0.0 && rim.sine_end < 1.0);
            }
        }
    }

    #[test]
    fn source_rim_is_where_small_slopes_put_it() {
        // Flat race: r (1 − cos ψ) = b u, tan ψ = (b/a) sqrt(1 − u²)/u gives u = 0.1350, sin ψ = 0.2817;
        // the race's own curvature changes that by about the rim's length over R_0, 0.4 %.
        let (circles, floor) = source(Race::Outer);
        let rim = Rim::new(&circles, &floor, 5e-5);
        assert_relative_eq!(rim.joint.cos(), 0.1350, epsilon = 1e-3);
        assert_relative_eq!(rim.sine_end, 0.2817, epsilon = 2e-3);
    }

    /// Against all contacts on the arc by angle and overlap; a deep short dent has a rim that turns beyond the
    /// line of sight from the race's centre.
    #[test]
    fn no_centre_lies_farther_than_said() {
        let (bearing, stiffness) = (source_bearing(), source_stiffness());
        let steep = |race: Race| {
            let circles = Circles::race(&bearing, race, stiffness);
            let floor = Floor::Ellipse(Ellipse {
                carrier: circles.carrier,
                side: circles.side,
                half_length: 0.1e-3,
                depth: 50e-6,
            });
            (circles, floor, 1e-6)
        };
        let flat = |race: Race| {
            let circles = Circles::ball(&bearing, race, stiffness);
            (circles, Floor::Arc(Arc::new(1e-3, 2e-3, 10e-6, 0.0)), 5e-5)
        };
        let mut turning = 0;
        for (circles, floor, radius) in [steep(Race::Outer), steep(Race::Inner), flat(Race::Outer), flat(Race::Inner)] {
            let rim = Rim::new(&circles, &floor, radius);
            let end = rim.sine_end.asin();
            let mut farthest = f64::NEG_INFINITY;
            for i in 0..=2000 {
                let tilt = end * f64::from(i) / 2000.0;
                let inward = rim
                    .circle_tangent
                    .normal()
                    .scaled(circles.side * tilt.cos())
                    .plus(rim.circle_tangent.scaled(tilt.sin()));
                for overlap in [0.0, 5e-6, 50e-6] {
                    let arm = circles.roller + radius - overlap;
                    let centre = rim.centre.minus(inward.scaled(arm)).scaled(circles.sign());
                    let offset = centre.along.atan2(centre.outward);
                    turning += u32::from(i == 2000 && -offset < farthest - 1e-3);
                    farthest = farthest.max(-offset);
                }
            }
            assert_relative_eq!(rim.farthest_centre(&circles), farthest, epsilon = 1e-6);
        }
        assert!(turning > 0, "no rim turns beyond the line of sight");
    }

    /// Such a centre is on the edge of having its foot on the arc: rounding decides, and nothing is divided by zero.
    #[test]
    fn a_centre_on_that_of_the_arc_has_a_unit_normal() {
        let mut found = 0;
        for race in [Race::Outer, Race::Inner] {
            let (circles, floor) = source(race);
            for i in 1..40 {
                let radius = 5e-6 * f64::from(i);
                let rim = Rim::new(&circles, &floor, radius);
                if let Some(contact) = rim.contact(&circles, rim.centre) {
                    assert_relative_eq!(contact.inward.length(), 1.0, max_relative = 1e-14);
                    assert_relative_eq!(contact.delta, 1e-3 + radius, max_relative = 1e-14);
                    found += 1;
                }
            }
        }
        assert!(found > 0);
    }

    #[test]
    fn smoothstep_ends_flat() {
        for (x, y) in [(-1.0, 0.0), (0.0, 0.0), (0.5, 0.5), (1.0, 1.0), (7.0, 1.0)] {
            assert_relative_eq!(smoothstep(x), y);
        }
        assert!(smoothstep(1e-4) < 4e-8 && 1.0 - smoothstep(1.0 - 1e-4) < 4e-8);
    }
}
