//! A point of a profile with two derivatives, and the foot of a roller's centre on a curve.

use super::vector::Vector;

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
    curve: impl Fn(f64) -> CurvePoint,
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
        let newton = t - g / (at.first.dot(at.first) + gap.dot(at.second));
        let inside = newton > low && newton < high && step < NEWTON_STEPS;
        let next = if inside { newton } else { 0.5 * (low + high) };
        let moved = (next - t).abs();
        t = next;
        at = curve(t);
        if moved <= STEP_TOLERANCE && inside || high - low <= f64::EPSILON {
            break;
        }
    }
    (t, at)
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
