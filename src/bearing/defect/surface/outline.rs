//! The outline of a dent on the groove, and its distance from a ball's centre.
//!
//! With `ρ` and θ the ball's place about the race's centre, `G = R − σ r_g` the radius of the groove's centre line,
//! `e = σ (ρ − G)`, `q = r_g + r` and `x = φ − θ`, the distance to the tube's centre curve Q(v) is
//!
//! ```text
//! d² = (q − e)² + 2 F(v)      F = w E + K (1 − cos x)      E = q (e − σ ρ (1 − cos x))      K = ρ (R + σ r)
//! φ = (a/R) v      w = 1 − cos ψ = 1 − sqrt(1 − k² (1 − v²))      k = c/r_g
//! ```
//!
//! F is smooth in v on −1..1; both halves of the outline (±z) have one v.
//!
//! Contact of a ball with the rim's tube at one place of the outline.
//!
//! In the groove's frame at that place, along the race and across it, n has the components `ρ sin x / d` and
//! `sin ψ E / (q d)`. Its part along the outward normal of the outline is the sine of the contact angle, S: 0 where the
//! race goes over into the tube. k is Hertz's with the eigenvalues of
//!
//! ```text
//! H = (1 − w) diag(κ_l, κ_t) + w ((1/ρ_b + 1/r) b bᵀ + κ_T T Tᵀ)       w = smoothstep(S / RIM_BLEND)
//! ```
//!
//! T along the outline, b across it, κ_T the race's own relative curvature along T: the outline's bend within the
//! surface, which with the slope of the tube would make the two nearly conform at a vertex, is left out, since a patch
//! is longer than what of the outline bends.
//!
//! The tube ends where it meets the floor. S tells how far below the race the contact lies, `r (1 − cos)`, and how far
//! inside the outline, r S; the ratio of the squares of that depth and the floor's there is
//!
//! ```text
//! y = S³ r / ((1 + C)² b² (2 h/(a c) − r S g²))      h² = c² v² + a² (1 − v²)      g² = (c⁴ v² + a⁴ (1 − v²)) / (a c h)²
//! ```

use super::super::circles::Circles;
use super::super::rim::{RIM_BLEND, smoothstep};
use super::super::stiffness::FLOOR_FADE;

/// A dent's outline, rim and depth on a groove.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) struct Outline {
    pub circles: Circles,
    /// a, m.
    pub half_length: f64,
    /// c, m.
    pub half_width: f64,
    /// b, m.
    pub depth: f64,
    /// r, m.
    pub rim: f64,
    /// r_g, m.
    pub groove: f64,
}

impl Outline {
    /// Half the angle of the outline, rad.
    #[inline]
    pub(crate) fn angle(&self) -> f64 {
        self.half_length / self.circles.carrier
    }

    /// k: sine of the transverse angle at the outline's side.
    #[inline]
    pub(crate) fn side_sine(&self) -> f64 {
        self.half_width / self.groove
    }

    /// q, m: transverse radius of the torus on which the tube's centre curve lies.
    #[inline]
    pub(crate) fn tube(&self) -> f64 {
        self.groove + self.rim
    }

    /// `R + σ r`, m: distance of that torus from the axis in the plane.
    #[inline]
    pub(crate) fn level(&self) -> f64 {
        self.circles.carrier + self.circles.side * self.rim
    }

    /// Change of F over v that the race's own rolling curvature makes, `K (a/R)²` for a ball that touches the race, m².
    #[inline]
    pub(crate) fn scale(&self) -> f64 {
        let Circles { carrier, side, roller, .. } = self.circles;
        (carrier - side * roller) * self.level() * self.angle() * self.angle()
    }
}

/// One ball's place relative to an outline.
#[derive(Debug, Clone, Copy)]
pub(super) struct Over<'o> {
    pub outline: &'o Outline,
    /// ρ, m.
    pub distance: f64,
    /// θ, rad from the dent's middle.
    pub offset: f64,
    /// Overlap with the undamaged race, m.
    pub sunk: f64,
    /// e, m.
    pub excess: f64,
    /// a/R.
    pub angle: f64,
    /// k².
    side_square: f64,
    /// `σ q ρ` and K, m².
    turn: f64,
    roll: f64,
}

impl<'o> Over<'o> {
    #[inline]
    pub(super) fn new(outline: &'o Outline, distance: f64, offset: f64) -> Self {
        let Circles { carrier, side, roller, .. } = outline.circles;
        let sunk = side * (distance - carrier) + roller;
        Self {
            outline,
            distance,
            offset,
            sunk,
            excess: outline.groove - roller + sunk,
            angle: outline.angle(),
            side_square: outline.side_sine() * outline.side_sine(),
            turn: side * outline.tube() * distance,
            roll: distance * outline.level(),
        }
    }

    /// `q − e`, m: distance to the tube's centre curve if it ran right under the ball.
    #[inline]
    pub(super) fn least(&self) -> f64 {
        self.outline.circles.roller + self.outline.rim - self.sunk
    }

    /// F and its first three derivatives at v, m².
    #[inline]
    pub(super) fn squares(&self, v: f64) -> [f64; 4] {
        let (p, k2, turn, roll) = (self.angle, self.side_square, self.turn, self.roll);
        let (half_sin, half_cos) = (0.5 * (p * v - self.offset)).sin_cos();
        let one_less = 2.0 * half_sin * half_sin;
        let (sin, cos) = (2.0 * half_sin * half_cos, 1.0 - one_less);
        let rest = k2 * (1.0 - v) * (1.0 + v);
        let c = (1.0 - rest).sqrt();
        let per_c = 1.0 / c;
        let rise = k2 * (1.0 - k2) * (per_c * per_c * per_c);
        let w = [rest / (1.0 + c), -k2 * v * per_c, -rise, 3.0 * k2 * v * rise * (per_c * per_c)];
        let e = [
            self.outline.tube() * self.excess - turn * one_less,
            -turn * p * sin,
            -turn * p * p * cos,
            turn * p * p * p * sin,
        ];
        [
            w[0] * e[0] + roll * one_less,
            w[1] * e[0] + w[0] * e[1] + roll * p * sin,
            w[2] * e[0] + 2.0 * w[1] * e[1] + w[0] * e[2] + roll * p * p * cos,
            w[3] * e[0] + 3.0 * (w[2] * e[1] + w[1] * e[2]) + w[0] * e[3] - roll * p * p * p * sin,
        ]
    }

    /// Lower bound of F'' over the whole outline, m², from the largest of every term of it.
    #[inline]
    pub(super) fn least_bend(&self) -> f64 {
        let (p, k2, turn) = (self.angle, self.side_square, self.turn.abs());
        let c = (1.0 - k2).sqrt();
        // farthest angle between ball and outline; its cosine from below, and its sine from above
        let far = p + self.offset.abs();
        let one_less = 0.5 * far * far;
        let e = (self.outline.tube() * self.excess).max(0.0) + turn * one_less;
        let less = k2 / c * e + 2.0 * k2 * turn * p * far + (1.0 - c) * turn * p * p;
        self.roll * p * p * (1.0 - one_less) - less
    }
}

/// Overlap, direction and shape at one place of the outline.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// m.
    pub delta: f64,
    /// Components of n outwards along the ball's radius vector and along increasing angle; without the third, z.
    pub normal: [f64; 2],
    /// Height above the plane, m.
    pub height: f64,
    /// S.
    pub sine: f64,
    /// b along the race; the other component is across it, both zero or positive but for the sign of v.
    outward: [f64; 2],
    /// y.
    ratio: f64,
}

impl Edge {
    /// At v, where F is `f` (m²).
    #[inline]
    pub(super) fn at(over: &Over<'_>, v: f64, f: f64) -> Self {
        let o = over.outline;
        let (p, k, q, side) = (over.angle, o.side_sine(), o.tube(), o.circles.side);
        let width = ((1.0 - v) * (1.0 + v)).max(0.0).sqrt();
        let sin_psi = k * width;
        let cos_psi = (1.0 - sin_psi * sin_psi).sqrt();
        let radius = o.circles.carrier - side * o.groove + side * q * cos_psi;
        let (half_sin, half_cos) = (0.5 * (p * v - over.offset)).sin_cos();
        let one_less = 2.0 * half_sin * half_sin;
        let sin = 2.0 * half_sin * half_cos;
        let least = over.least();
        let d = (least * least + 2.0 * f).max(0.0).sqrt();
        let reach = o.circles.roller + o.rim;
        // the first form has no cancellation, the second is for a ball sunk to the tube's middle
        let delta = if least > 0.0 { over.sunk - 2.0 * f / (d + least) } else { reach - d };
        let outward = {
            let across = [q * k * v / cos_psi, radius * p * width];
            let square = across[0] * across[0] + across[1] * across[1];
            let length = square.sqrt().max(f64::MIN_POSITIVE);
            across.map(|part| part / length)
        };
        let (normal, sine) = if d > 0.0 {
            let e = over.excess - side * over.distance * one_less;
            (
                [(radius * (1.0 - one_less) - over.distance) / d, radius * sin / d],
                (over.distance * sin * outward[0] + sin_psi * e * outward[1]) / d,
            )
        } else {
            ([side, 0.0], 0.0)
        };
        Self { delta, normal, height: o.half_width * width, sine, outward, ratio: ratio(o, v, sine) }
    }

    /// 1 on the tube, falling to 0 where it meets the floor.
    #[inline]
    pub(super) fn on_tube(&self) -> f64 {
        smoothstep((1.0 - self.ratio) / (1.0 - FLOOR_FADE))
    }

    /// Relative principal curvatures, 1/m, the greater first.
    #[inline]
    pub(super) fn curvatures(&self, outline: &Outline) -> [f64; 2] {
        let share = smoothstep(self.sine / RIM_BLEND);
        let (rolling, across) = (outline.circles.relative, outline.circles.across);
        let [b_s, b_z] = self.outward;
        let along_outline = rolling * b_z * b_z + across * b_s * b_s;
        let edge = outline.circles.roller_curvature() + 1.0 / outline.rim;
        let more = edge - along_outline;
        let mix = |race: f64, tube: f64| race + share * (tube - race);
        let h_ss = mix(rolling, along_outline + more * b_s * b_s);
        let h_zz = mix(across, along_outline + more * b_z * b_z);
        let h_sz = share * more * b_s * b_z;
        let (mean, half) = (0.5 * (h_ss + h_zz), 0.5 * (h_ss - h_zz));
        let root = (half * half + h_sz * h_sz).sqrt();
        [mean + root, mean - root]
    }
}

/// y; infinite where the tube would reach beyond the other side of the outline.
#[inline]
pub(super) fn ratio(outline: &Outline, v: f64, sine: f64) -> f64 {
    let (a, b, c, r) = (outline.half_length, outline.depth, outline.half_width, outline.rim);
    let s = sine.clamp(0.0, 1.0);
    let (v2, w2) = (v * v, (1.0 - v) * (1.0 + v));
    let h2 = c * c * v2 + a * a * w2;
    let curl = (c * c * c * c * v2 + a * a * a * a * w2) / (a * a * c * c * h2);
    let opening = 2.0 * h2.sqrt() / (a * c) - r * s * curl;
    let rest = 1.0 + (1.0 - s * s).sqrt();
    if opening > 0.0 { s * s * s * r / (rest * rest * b * b * opening) } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::super::super::tests::source_outline;
    use super::*;
    use crate::bearing::Race;
    use proptest::prelude::*;

    proptest! {
        /// Against the two points in space, and each derivative against differences of the one before.
        #[test]
        fn distance_and_derivatives(v in -0.99..0.99_f64, offset in -0.2..0.2_f64, sunk in -5e-6..40e-6_f64,
            wide in 0.1..0.9_f64, inner: bool) {
            let race = if inner { Race::Inner } else { Race::Outer };
            let outline = Outline { half_width: wide * 1e-3, ..source_outline(race) };
            let circles = outline.circles;
            let over = Over::new(&outline, circles.carrier + circles.side * (sunk - circles.roller), offset);
            let z = outline.half_width * (1.0 - v * v).sqrt();
            let psi = (z / outline.groove).asin();
            let phi = outline.half_length * v / circles.carrier;
            let radius = circles.carrier - circles.side * outline.groove
                + circles.side * outline.tube() * psi.cos();
            let gap = [
                radius * phi.cos() - over.distance * offset.cos(),
                radius * phi.sin() - over.distance * offset.sin(),
                outline.tube() * psi.sin(),
            ];
            let square = gap.iter().map(|part| part * part).sum::<f64>();
            let [f, f_1, f_2, f_3] = over.squares(v);
            prop_assert!((over.least() * over.least() + 2.0 * f - square).abs() < 1e-13 * square);
            let h = 1e-4;
            let (before, after) = (over.squares(v - h), over.squares(v + h));
            for (i, derivative) in [f_1, f_2, f_3].into_iter().enumerate() {
                // the differences' own error: h² of the next but one derivative, which near k = 1 is large
                let difference = (after[i] - before[i]) / (2.0 * h);
                prop_assert!((difference - derivative).abs() < 1e-5 * outline.scale() / (1.0 - wide),
                    "{i}: {difference} {derivative}");
            }
            prop_assert!(over.least_bend() <= f_2);
        }
    }
}
