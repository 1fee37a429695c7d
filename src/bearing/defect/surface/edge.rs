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

use super::super::rim::{RIM_BLEND, smoothstep};
use super::super::stiffness::FLOOR_FADE;
use super::outline::{Outline, Over};

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
