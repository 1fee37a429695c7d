//! What lies between the rims: the ellipse of a dent or the arc of a flat.

use super::circles::Circles;
use super::curve::{Arc, CurvePoint, Ellipse, Vector, bisect};

/// Floor of a defect, symmetric about its middle; the curve parameter grows counter-clockwise from zero there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Floor {
    /// Of a dent in a race.
    Ellipse(Ellipse),
    /// Of a flat on a ball.
    Arc(Arc),
}

/// Part of the floor that the roller can touch: `|t| < parameter`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reach {
    pub parameter: f64,
    end_point: Vector,
    end_tangent: Vector,
    /// The floor is touchable up to the joint: a contact passes on to the rim there.
    pub meets_rim: bool,
}

impl Reach {
    /// Ends at `parameter`, where the floor is at `end`.
    pub(super) fn new(parameter: f64, end: CurvePoint, meets_rim: bool) -> Self {
        Self { parameter, end_point: end.point, end_tangent: end.tangent(), meets_rim }
    }

    /// Whether the foot of the `centre` of a convex (`sign` +1) or concave (−1) roller lies before its end.
    #[inline]
    pub(super) fn holds(&self, centre: Vector, sign: f64) -> bool {
        sign * self.end_point.minus(centre).dot(self.end_tangent) > 0.0
    }
}

impl Floor {
    #[inline]
    pub(super) fn at(&self, t: f64) -> CurvePoint {
        match self {
            Self::Ellipse(ellipse) => ellipse.at(t),
            Self::Arc(arc) => arc.at(t),
        }
    }

    /// Parameter at which the floor would meet the carrier's circle if it had no rim.
    pub(super) fn wall(&self) -> f64 {
        match self {
            Self::Ellipse(_) => Ellipse::WALL,
            Self::Arc(arc) => arc.wall,
        }
    }

    /// By how much the floor is less convex (or more concave) than its carrier, as the stiffness takes it, 1/m.
    #[inline]
    pub(super) fn loss(&self, t: f64) -> f64 {
        match self {
            Self::Ellipse(ellipse) => ellipse.curvature(t),
            Self::Arc(arc) => arc.loss,
        }
    }

    /// Foot of the roller's `centre`, which lies within the reach `limit`.
    #[inline]
    pub(super) fn foot(&self, circles: &Circles, centre: Vector, limit: f64) -> (f64, CurvePoint) {
        match self {
            Self::Ellipse(ellipse) => ellipse.foot(centre, limit),
            Self::Arc(arc) => arc.foot(centre, circles.sign()),
        }
    }

    /// Distance (m) from the carrier's centre at `offset` (rad) from the middle.
    pub(super) fn polar_radius(&self, offset: f64) -> f64 {
        match self {
            Self::Ellipse(ellipse) => ellipse.polar_radius(offset),
            Self::Arc(arc) => arc.polar_radius(offset),
        }
    }

    /// The part less concave than the roller is convex: up to the joint, up to some parameter, or none.
    pub(super) fn reach(&self, circles: &Circles, joint: f64) -> Option<Reach> {
        let touchable = |t: f64| self.at(t).concavity(circles.side) < circles.roller_curvature();
        if !touchable(0.0) {
            return None;
        }
        let meets_rim = touchable(joint);
        let parameter = if meets_rim { joint } else { bisect(0.0, joint, touchable) };
        Some(Reach::new(parameter, self.at(parameter), meets_rim))
    }
}
