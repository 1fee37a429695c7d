//! The floor in the plane z = 0, where a ball touches it if it touches it at all.
//!
//! Across the rolling direction the floor at t (`s = a sin t`) is more concave than the groove by `β = b / (c² cos t)`.
//! Where that reaches κ_t the ball cannot touch it: it rests on the edges, for which half of that is enough. So the
//! contact fades by β as it does by the curvature in the rolling direction, and where the floor runs under the rim.

use super::super::circles::Circles;
use super::super::contacts::{DefectContact, Feature};
use super::super::curve::bisect;
use super::super::ellipse::Ellipse;
use super::super::floor::Reach;
use super::super::rim::smoothstep;
use super::super::stiffness::{CurvatureStiffness, FLOOR_FADE, Fade};
use super::super::vector::Vector;
use super::minima::to_tube;
use super::outline::Outline;

/// The floor's section in the plane, as far as a ball can touch it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bottom {
    pub(super) ellipse: Ellipse,
    circles: Circles,
    fade: Fade,
    /// b/c², 1/m.
    spread: f64,
    /// Relative curvature from which the ellipse's is taken for the stiffness, 1/m, and what it lacks of the race's.
    pub(super) base: f64,
    shortfall: f64,
    /// Where the floor meets the rim, rad.
    corner: f64,
    /// Where a ball can touch it, if anywhere.
    pub(super) reach: Option<Reach>,
}

impl Bottom {
    /// The floor of `outline`; `base` (1/m) as [`super::super::depression::Depression::new`] takes it.
    pub(super) fn new(outline: &Outline, base: f64) -> Self {
        let circles = outline.circles;
        let ellipse = Ellipse {
            carrier: circles.carrier,
            side: circles.side,
            half_length: outline.half_length,
            depth: outline.depth,
        };
        let clear = |t: f64| {
            let point = ellipse.at(t).point;
            to_tube(outline, point.length(), point.along.atan2(point.outward)) > outline.rim
        };
        let corner = if clear(0.0) { bisect(0.0, Ellipse::WALL, clear) } else { 0.0 };
        let mut floor = Self {
            ellipse,
            circles,
            fade: Fade::new(&circles, 0.0),
            spread: outline.depth / (outline.half_width * outline.half_width),
            base,
            shortfall: (circles.relative - base).max(0.0),
            corner,
            reach: None,
        };
        let touchable = |t: f64| {
            t < corner
                && ellipse.at(t).concavity(circles.side) < circles.roller_curvature()
                && floor.across_left(t) > 0.0
        };
        if touchable(0.0) {
            let limit = bisect(0.0, corner, touchable);
            floor.reach = Some(Reach::new(limit, ellipse.at(limit), false));
        }
        floor
    }

    /// Relative curvature across the rolling direction, 1/m.
    #[inline]
    fn across_left(&self, t: f64) -> f64 {
        self.circles.across - self.spread / t.cos()
    }

    /// Contact of a ball at `centre`, in `direction` from the race's centre.
    #[inline]
    pub(super) fn contact(
        &self,
        centre: Vector,
        direction: Vector,
        stiffness: &CurvatureStiffness,
    ) -> Option<DefectContact> {
        let reach = self.reach.as_ref()?;
        if !(reach.holds(centre, 1.0) && reach.holds(centre.mirrored(), 1.0)) {
            return None;
        }
        let circles = &self.circles;
        let (t, foot) = self.ellipse.foot(centre, reach.parameter);
        let inward = foot.inward(circles.side);
        let delta = circles.roller - foot.point.minus(centre).dot(inward);
        let left = self.across_left(t);
        let fading = 1.0 - FLOOR_FADE;
        let weight = self.fade.weight(foot.concavity(circles.side) + self.shortfall)
            * smoothstep(left / (fading * circles.across))
            * smoothstep((t.cos() / self.corner.cos() - 1.0) / fading);
        let k = stiffness.of_pair([self.base - self.ellipse.curvature(t), left]);
        Some(circles.contact(Feature::Floor, delta, inward, direction, weight * k))
    }
}
