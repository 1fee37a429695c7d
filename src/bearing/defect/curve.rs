//! A point of a profile with two derivatives, and the foot of a roller's centre on a curve.
//!
//! Plane vectors in a defect's frame: origin at the centre of the circle that carries it, axes fixed to its middle.
//!
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
//!
//! Floor of a dent: an ellipse over the race, and the foot of a ball's centre on it.
//!
//! The curve parameter is `t` with `s = a sin t`, so that `D = b cos t` and nothing is singular at the
//! ends: `φ = a sin t / R_0`, `R = R_0 ± b cos t` with the sign of the material's side.

use std::f64::consts::FRAC_PI_2;

/// Newton steps after which the bracket is halved instead. From a linear start three to five suffice.
const NEWTON_STEPS: usize = 12;

/// Steps in all: halving alone reaches rounding in 60.
const MOST_STEPS: usize = 72;

/// Last step, rad, at which the iteration ends: Newton's next error is its square.
const STEP_TOLERANCE: f64 = 1e-9;

/// Halvings when a constructor looks for a parameter between two ends.
const HALVINGS: usize = 64;

/// A point of a curve that runs counter-clockwise, and its derivatives with respect to the parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CurvePoint {
    pub point: Vector,
    pub first: Vector,
    pub second: Vector,
}

impl CurvePoint {
    /// `P = R e(φ)` from e, `[R, R', R'']` and `[φ', φ'']`:
    /// `P' = R' e + R φ' e_φ`, `P'' = (R'' − R φ'²) e + (2 R' φ' + R φ'') e_φ`.
    #[inline]
    pub(super) fn polar(e: Vector, radius: [f64; 3], angle: [f64; 2]) -> Self {
        let [r, r_1, r_2] = radius;
        let [phi_1, phi_2] = angle;
        let e_phi = e.tangent();
        Self {
            point: e.scaled(r),
            first: e.scaled(r_1).plus(e_phi.scaled(r * phi_1)),
            second: e.scaled(r_2 - r * phi_1 * phi_1).plus(e_phi.scaled(2.0 * r_1 * phi_1 + r * phi_2)),
        }
    }

    /// Curvature, 1/m, positive where the material on `side` of the curve is concave.
    #[inline]
    pub(super) fn concavity(&self, side: f64) -> f64 {
        let speed_squared = self.first.dot(self.first);
        -side * self.second.dot(self.first.normal()) / (speed_squared * speed_squared.sqrt())
    }

    /// Unit tangent, counter-clockwise.
    #[inline]
    pub(super) fn tangent(&self) -> Vector {
        self.first.scaled(1.0 / self.first.length())
    }

    /// Unit normal m into the material on `side`.
    #[inline]
    pub(super) fn inward(&self, side: f64) -> Vector {
        self.tangent().normal().scaled(side)
    }
}

/// Parameter in `[low, high]` at which the curve is perpendicular to the line from `centre` (of a convex
/// roller), and the point there.
///
/// The half squared distance must fall into the interval at both ends, so that its derivative
/// `g(t) = (P − C)·P'` changes sign; Newton on g from `start`, kept inside the shrinking bracket.
#[inline]
pub(super) fn foot(
    centre: Vector,
    [low, high]: [f64; 2],
    start: f64,
    mut curve: impl FnMut(f64) -> CurvePoint,
) -> (f64, CurvePoint) {
    let (mut low, mut high) = (low, high);
    let mut t = start;
    let mut at = curve(t);
    for step in 0..MOST_STEPS {
        let gap = at.point.minus(centre);
        let g = gap.dot(at.first);
        if g < 0.0 {
            low = t;
        } else {
            high = t;
        }
        let bend = at.first.dot(at.first) + gap.dot(at.second);
        let newton = t - g / bend;
        let found = bend > 0.0 && (newton - t).abs() <= STEP_TOLERANCE;
        let inside = newton > low && newton < high && step < NEWTON_STEPS;
        // also where the step is lost to rounding, at an end of the bracket
        t = if found || inside { newton } else { 0.5 * (low + high) };
        at = curve(t);
        if found || high - low <= f64::EPSILON {
            break;
        }
    }
    (t, at)
}

/// Largest angle (rad) of which sine and cosine come from their series: the first terms left out are 3e-19 and 2e-21.
const SMALL: f64 = 0.1;

/// Sine and cosine: of small angles, which most are here, in a quarter of the library's time.
#[inline]
fn sin_cos(angle: f64) -> (f64, f64) {
    let x = angle * angle;
    if x > SMALL * SMALL {
        return angle.sin_cos();
    }
    let sine = 1.0 - x * (1.0 / 6.0) * (1.0 - x * (1.0 / 20.0) * (1.0 - x * (1.0 / 42.0) * (1.0 - x * (1.0 / 72.0))));
    let bend = 1.0 - x * (1.0 / 12.0) * (1.0 - x * (1.0 / 30.0) * (1.0 - x * (1.0 / 56.0) * (1.0 - x * (1.0 / 90.0))));
    (angle * sine, 1.0 - 0.5 * x * bend)
}

/// Parameter at which `too_low` turns false, between `low` (where it holds) and `high`.
pub(super) fn bisect(low: f64, high: f64, too_low: impl Fn(f64) -> bool) -> f64 {
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

/// `along` the circle at the defect's middle (counter-clockwise), `outward` from its centre; m or 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vector {
    pub along: f64,
    pub outward: f64,
}

impl Vector {
    /// Unit vector from the centre at `angle` (rad) from the defect's middle.
    #[inline]
    pub(super) fn radial(angle: f64) -> Self {
        let (along, outward) = sin_cos(angle);
        Self { along, outward }
    }

    /// A quarter turn clockwise: the counter-clockwise tangent of a radial vector.
    #[inline]
    pub(super) fn tangent(self) -> Self {
        Self { along: self.outward, outward: -self.along }
    }

    /// A quarter turn counter-clockwise: the outward normal of a tangent.
    #[inline]
    pub(super) fn normal(self) -> Self {
        Self { along: -self.outward, outward: self.along }
    }

    #[inline]
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { along: factor * self.along, outward: factor * self.outward }
    }

    #[inline]
    pub(super) fn plus(self, other: Self) -> Self {
        Self { along: self.along + other.along, outward: self.outward + other.outward }
    }

    #[inline]
    pub(super) fn minus(self, other: Self) -> Self {
        Self { along: self.along - other.along, outward: self.outward - other.outward }
    }

    #[inline]
    pub(super) fn dot(self, other: Self) -> f64 {
        self.along * other.along + self.outward * other.outward
    }

    #[inline]
    pub(super) fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// Mirror image in the defect's middle.
    #[inline]
    pub(super) fn mirrored(self) -> Self {
        Self { along: -self.along, outward: self.outward }
    }
}

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
        self.at_turned(t.sin_cos())
    }

    /// The same from sine and cosine of the parameter.
    #[inline]
    fn at_turned(&self, (sin_t, cos_t): (f64, f64)) -> CurvePoint {
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

    /// Parameter in `[−limit, limit]` of the foot of `centre`, and the point there; see [`foot`].
    #[inline]
    pub(super) fn foot(&self, centre: Vector, limit: f64) -> (f64, CurvePoint) {
        let bottom = self.carrier + self.side * self.depth;
        let concavity = self.side / self.carrier + self.depth / (self.half_length * self.half_length);
        // Linear about the middle: the foot moves 1/(1 − κ d) times as far as the ball.
        let stretch = 1.0 - concavity * self.side * (bottom - centre.outward);
        let start = centre.along / (self.half_length * stretch.max(0.2));
        let start = start.clamp(-0.9 * limit, 0.9 * limit);
        // steps are small turns
        let (mut last, (mut sin_t, mut cos_t)) = (start, start.sin_cos());
        foot(centre, [-limit, limit], start, |t| {
            let (sin, cos) = sin_cos(t - last);
            (last, sin_t, cos_t) = (t, sin_t * cos + cos_t * sin, cos_t * cos - sin_t * sin);
            self.at_turned((sin_t, cos_t))
        })
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

    #[test]
    fn sine_and_cosine_of_small_and_large_angles_are_those_of_the_library() {
        for i in -4000..=4000 {
            let angle = f64::from(i) * 5e-5;
            let ((sin, cos), (own_sin, own_cos)) = (angle.sin_cos(), sin_cos(angle));
            assert!((sin - own_sin).abs() <= 4e-16 * sin.abs() && (cos - own_cos).abs() <= 3e-16, "{angle}");
        }
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::NAN).1.is_nan());
    }

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

#[cfg(test)]
mod ellipse_tests {
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

    /// A ball that rests in the middle of a dent: Newton's step from there is lost to rounding, and 50 halvings are not needed.
    #[test]
    fn a_start_that_is_the_foot_is_found_at_once() {
        for along in [0.0, 1e-22, -1e-22] {
            let mut asked = 0;
            let (t, _) = foot(Vector { along, outward: 3.77e-3 }, [-1.0, 1.0], 0.0, |t| {
                asked += 1;
                OUTER.at(t)
            });
            assert!(t.abs() < 1e-12 && asked <= 3, "{t}: {asked}");
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
