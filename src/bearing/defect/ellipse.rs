//! Floor of a dent: an ellipse over the race, and the foot of a ball's centre on it.
//!
//! The curve parameter is `t` with `s = a sin t`, so that `D = b cos t` and nothing is singular at the
//! ends: `φ = a sin t / R_0`, `R = R_0 ± b cos t` with the sign of the material's side.

use std::f64::consts::FRAC_PI_2;

use super::curve::{self, CurvePoint};
use super::vector::Vector;

/// Elliptical floor pressed into a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ellipse {
    /// Radius of the circle, m.
    pub carrier: f64,
    /// +1: pressed outwards; −1: inwards.
    pub side: f64,
    /// a, m.
    pub half_length: f64,
    /// b, m.
    pub depth: f64,
}

impl Ellipse {
    /// Parameter at which the floor ends in a wall.
    pub(super) const WALL: f64 = FRAC_PI_2;

    #[inline]
    pub(super) fn at(&self, t: f64) -> CurvePoint {
        let (sin_t, cos_t) = t.sin_cos();
        let along = self.half_length / self.carrier;
        let sag = self.side * self.depth * cos_t;
        let radius = [self.carrier + sag, -self.side * self.depth * sin_t, -sag];
        let angle = [along * cos_t, -along * sin_t];
        CurvePoint::polar(Vector::radial(along * sin_t), radius, angle)
    }

    /// κ_D of the ellipse, 1/m, the source's (24): `a b / (a² cos² t + b² sin² t)^{3/2}`; b/a² at the middle.
    #[inline]
    pub(super) fn curvature(&self, t: f64) -> f64 {
        let (sin_t, cos_t) = t.sin_cos();
        let (a, b) = (self.half_length, self.depth);
        let sum = (a * cos_t) * (a * cos_t) + (b * sin_t) * (b * sin_t);
        a * b / (sum * sum.sqrt())
    }

    /// Parameter in `[−limit, limit]` of the foot of `centre`, and the point there; see [`curve::foot`].
    #[inline]
    pub(super) fn foot(&self, centre: Vector, limit: f64) -> (f64, CurvePoint) {
        let bottom = self.carrier + self.side * self.depth;
        let concavity = self.side / self.carrier + self.depth / (self.half_length * self.half_length);
        // Linear about the middle: the foot moves 1/(1 − κ d) times as far as the ball.
        let stretch = 1.0 - concavity * self.side * (bottom - centre.outward);
        let start = centre.along / (self.half_length * stretch.max(0.2));
        let start = start.clamp(-0.9 * limit, 0.9 * limit);
        curve::foot(centre, [-limit, limit], start, |t| self.at(t))
    }

    /// Distance (m) from the circle's centre at `offset` (rad) from the middle.
    pub(super) fn polar_radius(&self, offset: f64) -> f64 {
        let x = self.carrier * offset / self.half_length;
        self.carrier + self.side * self.depth * (1.0 - x * x).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    const OUTER: Ellipse = Ellipse { carrier: 4.7565e-3, side: 1.0, half_length: 0.375e-3, depth: 15e-6 };
    const INNER: Ellipse = Ellipse { carrier: 2.754e-3, side: -1.0, half_length: 0.4e-3, depth: 15e-6 };

    /// Radii 3.16 mm (concave) and 3.71 mm (convex) where depth is measured from the race. The exact polar
    /// curve differs by twice b/R_0 where the race's curvature is larger than the ellipse's: 1 % for the inner race.
    #[test]
    fn bottoms_of_the_source_dents() {
        for (floor, bottom, radius, concavity) in [(OUTER, 4.7715e-3, 3.16e-3, 1.0), (INNER, 2.739e-3, 3.71e-3, -1.0)] {
            let at = floor.at(0.0);
            assert_relative_eq!(at.point.outward, bottom, max_relative = 1e-14);
            let total = floor.side / floor.carrier + floor.curvature(0.0);
            assert_relative_eq!(concavity / total, radius, max_relative = 2e-3);
            assert_relative_eq!(at.concavity(floor.side), total, max_relative = 1.2e-2);
        }
    }

    proptest! {
        #[test]
        fn derivatives_and_curvature_by_differences(t in -1.5..1.5_f64, inner: bool) {
            let floor = if inner { INNER } else { OUTER };
            let h = 1e-5;
            let (before, at, after) = (floor.at(t - h), floor.at(t), floor.at(t + h));
            let first = after.point.minus(before.point).scaled(0.5 / h);
            let second = after.first.minus(before.first).scaled(0.5 / h);
            prop_assert!(first.minus(at.first).length() < 1e-9 * floor.half_length + 1e-12);
            prop_assert!(second.minus(at.second).length() < 1e-9 * floor.half_length + 1e-12);
            // turning of the tangent towards the ball's side over arc length
            let turned = after.tangent().minus(before.tangent()).dot(at.inward(floor.side));
            let moved = after.point.minus(before.point).length();
            let concavity = at.concavity(floor.side);
            prop_assert!((-turned / moved - concavity).abs() < 1e-4 * concavity.abs() + 0.01);
        }

        /// The source's (24) in the depth direction agrees with the second derivative of D(s).
        #[test]
        fn elliptic_curvature_by_differences(t in -1.3..1.3_f64) {
            let (a, b) = (OUTER.half_length, OUTER.depth);
            let depth = |s: f64| b * (1.0 - (s / a) * (s / a)).sqrt();
            let (s, h) = (a * t.sin(), 1e-3 * a * t.cos() * t.cos());
            let slope = (depth(s + h) - depth(s - h)) / (2.0 * h);
            let bend = (depth(s + h) - 2.0 * depth(s) + depth(s - h)) / (h * h);
            let curvature = -bend / (1.0 + slope * slope).powf(1.5);
            prop_assert!((curvature / OUTER.curvature(t) - 1.0).abs() < 1e-4);
        }

        /// A ball centre placed on the normal at t finds t again.
        #[test]
        fn foot_of_a_point_on_the_normal(t in -1.0..1.0_f64, distance in 0.95e-3..1.0e-3_f64, inner: bool) {
            let floor = if inner { INNER } else { OUTER };
            let at = floor.at(t);
            let ball = at.point.minus(at.inward(floor.side).scaled(distance));
            let (found, _) = floor.foot(ball, 1.02);
            prop_assert!((found - t).abs() < 1e-12, "{found} for {t}");
        }
    }
}
