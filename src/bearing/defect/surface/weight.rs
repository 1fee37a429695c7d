//! How much of its stiffness a contact of the outline has.
//!
//! **One patch or two.** A pair at ±z counts once where it merges and twice where the two are a patch apart:
//! `1 + smoothstep(κ_t z² / δ_1)` with δ_1 = [`PATCH`] ρ_b, the overlap under which the ball's patch on the race is
//! about `2 sqrt(δ_1 / κ_t)` across. So a dent narrower than that patch is felt little by little.
//!
//! **Where the outline is as curved as the ball**, a minimum can vanish at full force, F'' = 0 on the pair or F' = 0 at
//! a vertex. With `B = F''` in the fraction 1 − [`FLOOR_FADE`] of what the race's curvature alone makes, and likewise
//! D the slope of F towards the inside of a vertex,
//!
//! ```text
//! pair       g = smoothstep(B)
//! vertex     h + (1 − h) g   for D ≥ 0,   h (1 − g)   for D < 0        h = smoothstep((1 + D)/2)
//! ```
//!
//! A convex F has one minimum of weight 1, pair or vertex; a concave one has both vertices, which are kept a little
//! beyond where they cease to be minima. In between the load is shared. Less than 1 in all is scaled up to 1: the ball
//! never falls through.

use super::super::rim::smoothstep;
use super::super::stiffness::FLOOR_FADE;
use super::outline::Outline;

/// Overlap in ball radii whose patch decides whether two contacts are one. A choice: under 10 N a ball of 1 mm is
/// pressed into the source's race by 1.2 um, and a bearing of another size is loaded in proportion.
pub(super) const PATCH: f64 = 1e-3;

/// Contacts that a pair at height `z` (m) above and below the plane counts as, 1 to 2.
#[inline]
pub(super) fn patches(outline: &Outline, z: f64) -> f64 {
    1.0 + smoothstep(outline.circles.across * z * z / (PATCH * outline.circles.roller))
}

/// g of F'' (m²).
#[inline]
pub(super) fn pair(outline: &Outline, bend: f64) -> f64 {
    smoothstep(bend / ((1.0 - FLOOR_FADE) * outline.scale()))
}

/// Weight of a vertex from the slope of F (m²) towards the inside and F'' there.
#[inline]
pub(super) fn vertex(outline: &Outline, inward_slope: f64, bend: f64) -> f64 {
    let slope = inward_slope / ((1.0 - FLOOR_FADE) * outline.scale());
    let (held, bent) = (smoothstep(0.5 * (1.0 + slope)), pair(outline, bend));
    if slope >= 0.0 { held + (1.0 - held) * bent } else { held * (1.0 - bent) }
}

#[cfg(test)]
mod tests {
    use super::super::super::tests::source_outline;
    use super::*;
    use crate::bearing::Race;
    use approx::assert_relative_eq;

    #[test]
    fn a_pair_counts_once_where_it_merges_and_twice_apart() {
        let outline = source_outline(Race::Outer);
        // sqrt(1e-6 / 65.4), as under 10 N
        let apart = 0.1237e-3;
        assert_relative_eq!(patches(&outline, 0.0), 1.0);
        assert_relative_eq!(patches(&outline, apart / 2f64.sqrt()), 1.5, max_relative = 1e-3);
        assert_relative_eq!(patches(&outline, 1.001 * apart), 2.0);
        assert!(patches(&outline, 0.99 * apart) < 2.0);
    }

    /// What merges at a vertex has one weight before and after, and a vertex that ceases to be a minimum has none left
    /// where F is convex.
    #[test]
    fn weights_pass_from_vertex_to_pair() {
        let outline = source_outline(Race::Inner);
        let scale = outline.scale();
        for i in -10..=10 {
            let bend = 0.05 * f64::from(i) * scale;
            let [before, after] = [1e-12, -1e-12].map(|slope| vertex(&outline, slope * scale, bend));
            assert_relative_eq!(before, after + pair(&outline, bend), epsilon = 1e-10);
            assert_relative_eq!(vertex(&outline, scale, bend), 1.0);
            assert_relative_eq!(vertex(&outline, -scale, bend), 0.0);
        }
        assert_relative_eq!(vertex(&outline, 0.0, scale), 1.0);
        assert_relative_eq!(vertex(&outline, -0.1 * scale, scale), 0.0);
        assert_relative_eq!(vertex(&outline, 0.0, -scale), 0.5);
    }
}
