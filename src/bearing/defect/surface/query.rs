//! Contact queries of the hot loop: no allocation, no elliptic integral, no error.

use super::super::angle::within;
use super::super::contacts::{DefectContact, DefectContacts, Feature};
use super::dent::SurfaceDent;
use super::edge::Edge;
use super::minima::{Minimum, inner_minima};
use super::outline::Over;
use super::weight;

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
        let vertex =
            [weight::vertex(outline, ends[0][1], ends[0][2]), weight::vertex(outline, -ends[1][1], ends[1][2])];
        let mut sum = 0.0;
        for (beside, vertex) in beside.into_iter().zip(vertex) {
            sum += if beside { 1.0 } else { vertex };
        }
        for minimum in inner.clone() {
            sum += weight::pair(outline, minimum.bend);
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
            let share = gain * weight::pair(outline, bend) * weight::patches(outline, edge.height);
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
