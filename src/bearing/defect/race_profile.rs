//! What every profile on a race answers, and where a ball stands to it.

use super::angle::within;
use super::contacts::DefectContacts;
use crate::bearing::materials::Race;

/// Position of a ball's centre relative to a race's (displaced) centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolarPosition {
    /// Distance from the race's centre, m: ρ on the outer race, χ on the inner one.
    pub radius: f64,
    /// Angle in the race's own frame, counter-clockwise, rad; any number of turns. On the outer race from x,
    /// on the inner race less the shaft's angle.
    pub angle: f64,
}

/// A profile in one race of one bearing, ready for contact queries; it answers for its own arc.
///
/// Angles and positions are in the race's own frame: on the inner race they are relative to the shaft's centre, and angles less the
/// shaft's angle.
pub trait RaceProfile {
    /// The race that carries it.
    fn race(&self) -> Race;

    /// Angle of its middle, rad.
    fn angle(&self) -> f64;

    /// Half the arc that is not race any more, rad.
    fn half_angle(&self) -> f64;

    /// Half the arc within which a ball can press on it, rad: [`Self::half_angle`], or more where a ball beside it overlaps the far
    /// rim, or where it leans outwards.
    fn contact_half_angle(&self) -> f64;

    /// Distance (m) from the race's centre to the profile in the plane of the bearing at `angle` (rad, any turn).
    fn profile_radius(&self, angle: f64) -> f64;

    /// How far, m, a ball sinks beyond its place on the race, where it sinks deepest, before anything holds it.
    fn ball_drop(&self) -> f64;

    /// How far, m, it rises above the race at most.
    fn rise(&self) -> f64 {
        0.0
    }

    /// `angle` (rad, any turn) from the middle, within ±π.
    fn offset(&self, angle: f64) -> f64;

    /// [`Self::contacts`] in the place of what was found before. No allocation.
    fn contacts_into(&self, ball: PolarPosition, found: &mut DefectContacts);

    /// Whether a ball at `angle` (rad, any turn) can touch anything but the race: half-open arc `[φ_D − φ, φ_D + φ)` with φ the
    /// [`Self::contact_half_angle`]. Outside it the race contact alone holds, and [`Self::contacts`] need not be asked.
    fn contains(&self, angle: f64) -> bool {
        within(self.offset(angle), self.contact_half_angle())
    }

    /// All pressing contacts of a ball, in order of angle; a dent's gaps (δ < 0) too, where a contact may come to press.
    ///
    /// One on the race if the ball is not over the profile; beside it on a far rim if that is within reach. Of a ball that does not
    /// reach the undamaged race none presses: the whole profile lies there or beyond.
    fn contacts(&self, ball: PolarPosition) -> DefectContacts {
        let mut found = DefectContacts::none();
        self.contacts_into(ball, &mut found);
        found
    }
}
