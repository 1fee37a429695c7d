//! Contact queries of the hot loop: no allocation, no elliptic integral, no error.
//!
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

use super::super::contacts::{DefectContact, DefectContacts, Feature, within};
use super::super::rim::smoothstep;
use super::super::stiffness::FLOOR_FADE;
use super::dent::SurfaceDent;
use super::minima::{Minimum, inner_minima};
use super::outline::{Edge, Outline, Over};

impl SurfaceDent {
    /// The contacts of a ball at `distance` (m) from the race's centre and `offset` (rad, within ±π) from the middle.
    #[inline]
    pub(super) fn contacts_at(&self, distance: f64, offset: f64, found: &mut DefectContacts) {
        let outline = &self.outline;
        found.clear();
        let plain = outline.circles.plain(distance);
        let reached = plain.delta > 0.0;
        if !reached || !within(offset, self.contact_angle) {
            found.push(plain);
            return;
        }
        let over = Over::new(outline, distance, offset);
        let ends = [-1.0, 1.0].map(|v| over.squares(v));
        let inner = inner_minima(&over, ends);
        let angle = outline.angle();
        let beside = [offset < -angle, offset >= angle];
        let vertex = [vertex(outline, ends[0][1], ends[0][2]), vertex(outline, -ends[1][1], ends[1][2])];
        let mut sum = 0.0;
        for (beside, vertex) in beside.into_iter().zip(vertex) {
            sum += if beside { 1.0 } else { vertex };
        }
        for minimum in inner.clone() {
            sum += pair(outline, minimum.bend);
        }
        let gain = if sum > 0.0 && sum < 1.0 { 1.0 / sum } else { 1.0 };
        if beside[0] {
            found.push(plain);
        } else if vertex[0] > 0.0 {
            let edge = Edge::at(&over, -1.0, ends[0][0]);
            found.push_some(self.on_edge(Feature::RimBefore, &edge, gain * vertex[0]));
        }
        for Minimum { v, square, bend } in inner {
            let edge = Edge::at(&over, v, square);
            let share = gain * pair(outline, bend) * patches(outline, edge.height);
            found.push_some(self.on_edge(Feature::SideEdges, &edge, share));
        }
        if !(beside[0] || beside[1]) {
            let (direction, centre) = outline.circles.centre(distance, offset);
            found.push_some(self.bottom.contact(centre, direction, &self.stiffness));
        }
        if beside[1] {
            found.push(plain);
        } else if vertex[1] > 0.0 {
            let edge = Edge::at(&over, 1.0, ends[1][0]);
            found.push_some(self.on_edge(Feature::RimAfter, &edge, gain * vertex[1]));
        }
    }

    /// Contact with the tube, `share` of its stiffness; none beyond where it meets the floor.
    #[inline]
    fn on_edge(&self, feature: Feature, edge: &Edge, share: f64) -> Option<DefectContact> {
        let left = edge.on_tube();
        (left > 0.0).then(|| DefectContact {
            feature,
            delta: edge.delta,
            normal_radial: edge.normal[0],
            normal_tangential: edge.normal[1],
            stiffness: share * left * self.stiffness.of_pair(edge.curvatures(&self.outline)),
        })
    }
}

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
