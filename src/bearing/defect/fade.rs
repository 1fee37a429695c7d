//! How a contact fades where the profile comes to be curved like the roller.

use super::circles::Circles;
use super::rim::smoothstep;

/// Fraction of the way from the race's curvature to the ball's at which the contact begins to
/// fade; at the ball's curvature it is gone. A choice: a ball rests on rim and floor together where the
/// floor has covered less than half of that way, so that the fade is met only when the rim carries more.
pub const FLOOR_FADE: f64 = 0.7;

/// Weight of a contact by the profile's concave curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fade {
    /// Concave curvature at which the contact is gone, 1/m.
    gone: f64,
    /// Range of curvature over which it fades, 1/m.
    width: f64,
}

impl Fade {
    /// Gone `early` (1/m) before the roller's own curvature.
    pub(super) fn new(circles: &Circles, early: f64) -> Self {
        let roller = circles.roller_curvature();
        Self { gone: roller - early, width: (1.0 - FLOOR_FADE) * (roller - circles.carrier_concavity()) }
    }

    /// Whether a profile of this concave curvature is touched at all.
    pub(super) fn touchable(&self, concavity: f64) -> bool {
        concavity < self.gone
    }

    /// 1 where the profile is flat enough, 0 where it is curved like the roller.
    #[inline]
    pub(super) fn weight(&self, concavity: f64) -> f64 {
        smoothstep((self.gone - concavity) / self.width)
    }
}
