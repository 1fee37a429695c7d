//! What a ball at a defect touches: a few contacts, without allocation.
//!
//! What every profile on a race answers, and where a ball stands to it.
//!
//! Reduction of an angle that has grown over many turns, and its place relative to a defect's arc.

use crate::bearing::error::{BearingError, refused};
use crate::bearing::materials::Race;
use std::f64::consts::{PI, TAU};

/// Most contacts that an answer holds. A dent or a flat has up to three (rim, floor, rim), with a width up to six. On a measured profile
/// the ones with the largest overlaps are kept.
pub const MOST_CONTACTS: usize = 8;

/// Part of the profile on which a contact lies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Feature {
    /// Undamaged race or ball beside the defect.
    #[default]
    Plain,
    /// Rim at the clockwise end, passed first by a ball that moves counter-clockwise.
    RimBefore,
    /// Floor of a dent, or the flat itself.
    Floor,
    /// Rim at the counter-clockwise end.
    RimAfter,
    /// Measured profile.
    Measured,
    /// Both side edges of a dent with a width, at ±z: two contacts in one, or what is left of two where they merge.
    SideEdges,
}

/// One contact of one ball with one race.
///
/// The force on the race is `F n`, on the ball `−F n`, with `F = k δ^{3/2}` for δ > 0. n points from the ball
/// into the race and is given in the ball's polar frame about the race's centre: outwards along the ball's
/// radius vector, and counter-clockwise. On an undamaged outer race n is (1, 0), on an inner one (−1, 0).
/// At the side edges of a dent with a width these are the components in the plane of a pair's two normals, whose third
/// ones cancel: n is shorter than 1, and k is both contacts'.
/// `∂δ/∂ρ = n_radial` and `(1/ρ) ∂δ/∂θ = n_tangential`, with race and ball kept from turning.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DefectContact {
    /// Where on the profile.
    pub feature: Feature,
    /// Overlap δ, m; negative is a gap.
    pub delta: f64,
    /// Component of n outwards.
    pub normal_radial: f64,
    /// Component of n along increasing angle.
    pub normal_tangential: f64,
    /// k, N/m^{3/2}, zero or positive.
    pub stiffness: f64,
}

impl DefectContact {
    /// Rate of δ, m/s, when the ball moves at `radial` and `tangential` (m/s) relative to what carries the defect.
    ///
    /// On a race that turns at ω, tangential is `ρ (θ̇ − ω)`; for a flat on a ball that turns at the spin ω_b
    /// (in the fixed frame) it is `ρ (θ̇ − ω_b)`.
    #[inline]
    pub(crate) fn rate(&self, radial: f64, tangential: f64) -> f64 {
        self.normal_radial * radial + self.normal_tangential * tangential
    }
}

/// The contacts of one ball with one race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DefectContacts {
    items: [DefectContact; MOST_CONTACTS],
    count: usize,
}

impl DefectContacts {
    /// No contact: what a query `_into` starts from.
    #[inline]
    pub(crate) fn none() -> Self {
        Self { items: [DefectContact::default(); MOST_CONTACTS], count: 0 }
    }

    /// Takes all contacts out.
    #[inline]
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds a contact behind the others; of more than [`MOST_CONTACTS`] the one with the least overlap goes.
    #[inline]
    pub(crate) fn push(&mut self, contact: DefectContact) {
        if let Some(place) = self.items.get_mut(self.count) {
            *place = contact;
            self.count += 1;
        } else {
            self.push_beyond(contact);
        }
    }

    /// Adds a contact if there is one.
    #[inline]
    pub(super) fn push_some(&mut self, contact: Option<DefectContact>) {
        if let Some(contact) = contact {
            self.push(contact);
        }
    }

    #[cold]
    fn push_beyond(&mut self, contact: DefectContact) {
        let (mut least, mut delta) = (MOST_CONTACTS, contact.delta);
        for (place, item) in self.items.iter().enumerate() {
            if item.delta < delta {
                (least, delta) = (place, item.delta);
            }
        }
        if least < MOST_CONTACTS {
            self.items.copy_within(least + 1.., least);
            self.items[MOST_CONTACTS - 1] = contact;
        }
    }

    /// The contacts, in order of angle.
    #[inline]
    pub(crate) fn as_slice(&self) -> &[DefectContact] {
        self.items.get(..self.count).unwrap_or(&self.items)
    }

    /// The contacts that press, δ > 0, in order of angle; a NaN overlap is passed on, to show itself in the force.
    #[inline]
    pub fn pressing(&self) -> impl Iterator<Item = &DefectContact> {
        self.as_slice().iter().filter(|contact| contact.delta > 0.0 || contact.delta.is_nan())
    }
}

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

/// Upper half of 2π: the last 26 bits are zero, so that its product with a turn count below 2²⁶ is exact.
const TAU_HIGH: f64 = f64::from_bits(TAU.to_bits() & !((1 << 26) - 1));

/// The rest of 2π: what `TAU` holds beyond `TAU_HIGH`, and what 2π holds beyond `TAU`.
const TAU_LOW: f64 = (TAU - TAU_HIGH) + 2.449_293_598_294_706_4e-16;

/// `angle` (rad) less a whole number of turns, within ±π (and rounding).
///
/// Accurate to rounding of the result for up to 6e7 turns, where the angle itself is known to 6e-8 rad.
#[inline]
pub(crate) fn reduced(angle: f64) -> f64 {
    if angle.abs() <= PI {
        return angle;
    }
    let turns = (angle * (1.0 / TAU)).round();
    (angle - turns * TAU_HIGH) - turns * TAU_LOW
}

/// `angle` (rad, any turn) less `middle` (within ±π), within ±π.
#[inline]
pub(super) fn offset_from(angle: f64, middle: f64) -> f64 {
    let offset = reduced(angle) - middle;
    if offset > PI {
        offset - TAU
    } else if offset < -PI {
        offset + TAU
    } else {
        offset
    }
}

/// `offset` in the half-open arc `[−half, half)`; false for NaN.
#[inline]
pub(super) fn within(offset: f64, half: f64) -> bool {
    -half <= offset && offset < half
}

/// Refuses the angle of a defect (rad) that is not finite.
pub(super) fn finite_angle(angle: f64) -> Result<(), BearingError> {
    if angle.is_finite() { Ok(()) } else { refused("defect angle_deg", angle.to_degrees(), "must be finite") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_too_many_the_least_overlap_goes_and_the_order_stays() {
        let mut found = DefectContacts::none();
        let overlaps = [5.0, 3.0, 9.0, 1.0, 7.0, 2.0, 8.0, 6.0];
        for delta in overlaps.into_iter().chain([4.0, 0.5, 10.0]) {
            found.push(DefectContact { delta, ..DefectContacts::none().items[0] });
        }
        let kept: Vec<f64> = found.pressing().map(|c| c.delta).collect();
        assert_eq!(kept, [5.0, 3.0, 9.0, 7.0, 8.0, 6.0, 4.0, 10.0]);
    }
}

#[cfg(test)]
mod angle_tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn multiples_of_a_turn_vanish() {
        for turns in [1.0, -3.0, 1e3, 1e6] {
            assert!((reduced(0.25 + turns * TAU) - 0.25).abs() < 4e-16 * turns.abs() * TAU + 1e-15);
        }
        assert!(reduced(f64::NAN).is_nan());
    }

    proptest! {
        /// The library's sine reduces its argument exactly: it must not notice ours.
        #[test]
        fn sine_and_cosine_do_not_notice(angle in -1e8..1e8_f64) {
            let small = reduced(angle);
            prop_assert!(small.abs() <= PI + 1e-12);
            prop_assert!((small.sin() - angle.sin()).abs() < 1e-15);
            prop_assert!((small.cos() - angle.cos()).abs() < 1e-15);
        }
    }
}
