//! The flat on a ball: an arc of larger radius than the ball's, and the foot of a race's centre on it.
//!
//! The arc's radius is R_2, its centre at `c = R_2 − ρ_b + h` behind the ball's centre, h the depth at the
//! middle. It meets the ball's circle at ±ψ as seen from the ball's centre, at ±β from its own:
//!
//! ```text
//! sin²(ψ/2) = h (2 R_2 + h) / (4 ρ_b c)        R_2 sin β = ρ_b sin ψ
//! ```
//!
//! The curve parameter is the angle about the arc's centre.

use super::curve::CurvePoint;
use super::vector::Vector;

/// An arc that takes a cap off a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    /// R_2, m.
    pub radius: f64,
    /// c, m.
    centre_depth: f64,
    /// ψ, rad.
    pub half_angle: f64,
    /// β, rad.
    pub wall: f64,
    /// By how much the stiffness takes the flat to be less convex than the ball, 1/m.
    pub loss: f64,
}

impl Arc {
    /// Arc of `radius`, larger than `carrier`, `depth` below it at the middle; a flat that would take more than
    /// half of the circle has ψ = π/2 or more.
    pub(super) fn new(carrier: f64, radius: f64, depth: f64, loss: f64) -> Self {
        let centre_depth = radius - carrier + depth;
        let square = depth * (2.0 * radius + depth) / (4.0 * carrier * centre_depth);
        let half_angle = 2.0 * square.clamp(0.0, 1.0).sqrt().asin();
        Self { radius, centre_depth, half_angle, wall: (carrier * half_angle.sin() / radius).asin(), loss }
    }

    #[inline]
    pub(super) fn at(&self, t: f64) -> CurvePoint {
        let out = Vector::radial(t).scaled(self.radius);
        CurvePoint {
            point: Vector { along: out.along, outward: out.outward - self.centre_depth },
            first: out.tangent(),
            second: out.scaled(-1.0),
        }
    }

    /// Parameter of the foot of `centre` and the point there, for a convex (`sign` +1) or concave (−1) roller.
    #[inline]
    pub(super) fn foot(&self, centre: Vector, sign: f64) -> (f64, CurvePoint) {
        let along = sign * centre.along;
        let t = along.atan2(sign * (centre.outward + self.centre_depth));
        (t, self.at(t))
    }

    /// Distance (m) from the ball's centre at `offset` (rad) from the middle.
    pub(super) fn polar_radius(&self, offset: f64) -> f64 {
        let (sin, cos) = offset.sin_cos();
        let across = self.centre_depth * sin;
        (self.radius * self.radius - across * across).max(0.0).sqrt() - self.centre_depth * cos
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    /// Depth and radius of the source's flat give half of its 46 degrees.
    #[test]
    fn the_source_flat_includes_23_degrees() {
        let arc = Arc::new(1e-3, 2e-3, 10e-6, 0.0);
        assert_relative_eq!(2.0 * arc.half_angle.to_degrees(), 22.9, epsilon = 0.05);
    }

    proptest! {
        #[test]
        fn ends_on_the_circle_and_is_deepest_at_the_middle(radius in 1.1e-3..1.0_f64, depth in 1e-7..40e-6_f64) {
            let arc = Arc::new(1e-3, radius, depth, 0.0);
            // the distance to the arc's own centre is lost to rounding of R_2
            let rounding = 4e-16 * radius;
            prop_assert!((arc.at(0.0).point.outward - (1e-3 - depth)).abs() < rounding);
            prop_assert!((arc.polar_radius(0.0) - (1e-3 - depth)).abs() < rounding);
            let end = arc.at(arc.wall).point;
            prop_assert!((end.length() - 1e-3).abs() < 4.0 * rounding);
            prop_assert!((end.along.atan2(end.outward) - arc.half_angle).abs() < 1e-9);
            prop_assert!((arc.polar_radius(arc.half_angle) - 1e-3).abs() < 4.0 * rounding);
        }

        #[test]
        fn foot_of_a_point_on_the_normal(t in -0.2..0.2_f64, outside: bool) {
            let arc = Arc::new(1e-3, 2e-3, 10e-6, 0.0);
            let at = arc.at(t);
            prop_assert!((at.concavity(-1.0) + 500.0).abs() < 1e-9);
            let (distance, sign) = if outside { (2.75e-3, 1.0) } else { (-4.75e-3, -1.0) };
            let centre = at.point.minus(at.inward(-1.0).scaled(distance));
            prop_assert!((arc.foot(centre, sign).0 - t).abs() < 1e-12);
        }
    }
}
