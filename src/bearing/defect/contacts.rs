//! What a ball at a defect touches: a few contacts, without allocation.

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
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds a contact behind the others; of more than [`MOST_CONTACTS`] the one with the least overlap goes.
    #[inline]
    pub(super) fn push(&mut self, contact: DefectContact) {
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
