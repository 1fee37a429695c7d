//! The dent's floor as a curve, and the foot of a ball's centre on it.
//!
//! The curve parameter is `t` with `s = a sin t`, so that `D = b cos t` and nothing is singular at the
//! ends. With `φ = a sin t / R_0` and `R = R_0 + b cos t`:
//!
//! ```text
//! P = R e(φ)     P' = R' e + R φ' e_φ     P'' = (R'' − R φ'²) e + (2 R' φ' + R φ'') e_φ
//! ```

use super::vector::Vector;

/// Newton steps after which the bracket is halved instead. With the linear start three to five steps suffice.
const NEWTON_STEPS: usize = 12;

/// Steps in all: halving alone reaches rounding in 60.
const MOST_STEPS: usize = 72;

/// Last step, rad, at which the iteration ends: Newton's next error is its square.
const STEP_TOLERANCE: f64 = 1e-9;

/// Halvings when the constructor looks for a parameter between two ends.
const HALVINGS: usize = 64;

/// Elliptical floor pressed into a circular race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Floor {
    /// R_0, m.
    pub race_radius: f64,
    /// a, m.
    pub half_length: f64,
    /// b, m.
    pub depth: f64,
}

/// The curve and its derivatives with respect to `t`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FloorPoint {
    pub point: Vector,
    pub first: Vector,
    pub second: Vector,
}

impl FloorPoint {
    /// Curvature of the floor, 1/m, concave towards the ball positive.
    #[inline]
    pub fn curvature(&self) -> f64 {
        let speed_squared = self.first.dot(self.first);
        -self.second.dot(self.first.normal()) / (speed_squared * speed_squared.sqrt())
    }

    /// Unit tangent, counter-clockwise.
    #[inline]
    pub fn tangent(&self) -> Vector {
        self.first.scaled(1.0 / self.first.length())
    }
}

impl Floor {
    #[inline]
    pub fn at(&self, t: f64) -> FloorPoint {
        let (sin_t, cos_t) = t.sin_cos();
        let along = self.half_length / self.race_radius;
        let (phi_1, phi_2) = (along * cos_t, -along * sin_t);
        let radius_1 = -self.depth * sin_t;
        let sag = self.depth * cos_t;
        let radius = self.race_radius + sag;
        let e = Vector::radial(along * sin_t);
        let e_phi = e.tangent();
        FloorPoint {
            point: e.scaled(radius),
            first: e.scaled(radius_1).plus(e_phi.scaled(radius * phi_1)),
            second: e
                .scaled(-sag - radius * phi_1 * phi_1)
                .plus(e_phi.scaled(2.0 * radius_1 * phi_1 + radius * phi_2)),
        }
    }

    /// κ_D of the ellipse, 1/m, the source's (24): `a b / (a² cos² t + b² sin² t)^{3/2}`; b/a² at the middle.
    #[inline]
    pub fn elliptic_curvature(&self, t: f64) -> f64 {
        let (sin_t, cos_t) = t.sin_cos();
        let (a, b) = (self.half_length, self.depth);
        let sum = (a * cos_t) * (a * cos_t) + (b * sin_t) * (b * sin_t);
        a * b / (sum * sum.sqrt())
    }

    /// Parameter in `[−limit, limit]` at which the floor is perpendicular to the line from `ball`.
    ///
    /// Requires the half squared distance to fall into the interval at both ends, which makes its
    /// derivative `g(t) = (P − ball)·P'` change sign; Newton on g, kept inside the shrinking bracket.
    #[inline]
    pub fn foot(&self, ball: Vector, limit: f64) -> (f64, FloorPoint) {
        let (mut low, mut high) = (-limit, limit);
        let bottom = self.race_radius + self.depth;
        let curvature = 1.0 / self.race_radius + self.depth / (self.half_length * self.half_length);
        // Linear about the middle: the foot moves 1/(1 − κ d) times as far as the ball.
        let stretch = 1.0 - curvature * (bottom - ball.outward);
        let start = ball.along / (self.half_length * stretch.max(0.2));
        let mut t = start.clamp(-0.9 * limit, 0.9 * limit);
        let mut at = self.at(t);
        for step in 0..MOST_STEPS {
            let gap = at.point.minus(ball);
            let g = gap.dot(at.first);
            if g < 0.0 {
                low = t;
            } else {
                high = t;
            }
            let newton = t - g / (at.first.dot(at.first) + gap.dot(at.second));
            let inside = newton > low && newton < high && step < NEWTON_STEPS;
            let next = if inside { newton } else { 0.5 * (low + high) };
            let moved = (next - t).abs();
            t = next;
            at = self.at(t);
            if moved <= STEP_TOLERANCE && inside || high - low <= f64::EPSILON {
                break;
            }
        }
        (t, at)
    }

    /// Parameter at which `too_low` turns false, between `low` (where it holds) and `high`.
    pub fn bisect(low: f64, high: f64, too_low: impl Fn(f64) -> bool) -> f64 {
        let (mut low, mut high) = (low, high);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if too_low(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    const FLOOR: Floor = Floor {
        race_radius: 4.7565e-3,
        half_length: 0.375e-3,
        depth: 15e-6,
    };

    #[test]
    fn bottom_of_the_source_dent() {
        let at = FLOOR.at(0.0);
        assert_relative_eq!(at.point.outward, 4.7715e-3, max_relative = 1e-14);
        // Radius 3.16 mm where depth is measured from the race; the exact polar curve differs by b/R_0.
        assert_relative_eq!(1.0 / at.curvature(), 3.16e-3, max_relative = 5e-3);
        let total = 1.0 / FLOOR.race_radius + FLOOR.elliptic_curvature(0.0);
        assert_relative_eq!(1.0 / total, 3.16e-3, max_relative = 2e-3);
        assert_relative_eq!(at.curvature(), total, max_relative = 5e-3);
    }

    proptest! {
        #[test]
        fn derivatives_and_curvature_by_differences(t in -1.5..1.5_f64) {
            let h = 1e-5;
            let (before, at, after) = (FLOOR.at(t - h), FLOOR.at(t), FLOOR.at(t + h));
            let first = after.point.minus(before.point).scaled(0.5 / h);
            let second = after.first.minus(before.first).scaled(0.5 / h);
            prop_assert!(first.minus(at.first).length() < 1e-9 * FLOOR.half_length + 1e-12);
            prop_assert!(second.minus(at.second).length() < 1e-9 * FLOOR.half_length + 1e-12);
            // turning of the tangent over arc length
            let turned = after.tangent().minus(before.tangent()).length();
            let moved = after.point.minus(before.point).length();
            prop_assert!((turned / moved / at.curvature() - 1.0).abs() < 1e-4);
        }

        /// The source's (24) in the depth direction agrees with the second derivative of D(s).
        #[test]
        fn elliptic_curvature_by_differences(t in -1.3..1.3_f64) {
            let (a, b) = (FLOOR.half_length, FLOOR.depth);
            let depth = |s: f64| b * (1.0 - (s / a) * (s / a)).sqrt();
            let (s, h) = (a * t.sin(), 1e-3 * a * t.cos() * t.cos());
            let slope = (depth(s + h) - depth(s - h)) / (2.0 * h);
            let bend = (depth(s + h) - 2.0 * depth(s) + depth(s - h)) / (h * h);
            let curvature = -bend / (1.0 + slope * slope).powf(1.5);
            prop_assert!((curvature / FLOOR.elliptic_curvature(t) - 1.0).abs() < 1e-4);
        }

        /// A ball centre placed on the normal at t finds t again.
        #[test]
        fn foot_of_a_point_on_the_normal(t in -1.0..1.0_f64, distance in 0.95e-3..1.0e-3_f64) {
            let at = FLOOR.at(t);
            let ball = at.point.minus(at.tangent().normal().scaled(distance));
            let (found, _) = FLOOR.foot(ball, 1.02);
            prop_assert!((found - t).abs() < 1e-12, "{found} for {t}");
        }
    }
}
