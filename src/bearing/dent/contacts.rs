//! What a ball in a dent touches: up to three contacts, without allocation.

/// A ball can touch both rims and the floor.
pub const MOST_CONTACTS: usize = 3;

/// Part of the profile on which a contact lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DentFeature {
    /// Undamaged race outside the dent.
    Race,
    /// Rim at the clockwise end, passed first by a ball that moves counter-clockwise.
    RimBefore,
    /// Floor of the dent.
    Floor,
    /// Rim at the counter-clockwise end.
    RimAfter,
}

/// One contact of one ball.
///
/// The force on the race is `F n`, on the ball `−F n`, with `F = k δ^{3/2}` for δ > 0; n is given in the
/// ball's polar frame. `∂δ/∂ρ = n_radial` and `(1/ρ) ∂δ/∂θ = n_tangential`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DentContact {
    /// Where on the profile.
    pub feature: DentFeature,
    /// Overlap δ, m; negative is a gap.
    pub delta: f64,
    /// Component outwards (along the ball's radius vector) of the unit vector from ball centre to contact.
    pub normal_radial: f64,
    /// Its component along increasing angle (counter-clockwise).
    pub normal_tangential: f64,
    /// k, N/m^{3/2}, zero or positive.
    pub stiffness: f64,
}

impl DentContact {
    /// Rate of δ, m/s, when the ball moves at `radial` and `tangential` (m/s) relative to the race.
    #[must_use]
    #[inline]
    pub fn rate(&self, radial: f64, tangential: f64) -> f64 {
        self.normal_radial * radial + self.normal_tangential * tangential
    }
}

/// All contacts of one ball, gaps included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DentContacts {
    items: [DentContact; MOST_CONTACTS],
    count: usize,
}

impl DentContacts {
    /// No contact yet.
    #[inline]
    pub(super) fn none() -> Self {
        let blank = DentContact {
            feature: DentFeature::Race,
            delta: 0.0,
            normal_radial: 1.0,
            normal_tangential: 0.0,
            stiffness: 0.0,
        };
        Self {
            items: [blank; MOST_CONTACTS],
            count: 0,
        }
    }

    /// Adds a contact; there are never more than the features in a dent.
    #[inline]
    pub(super) fn push(&mut self, contact: DentContact) {
        if let Some(place) = self.items.get_mut(self.count) {
            *place = contact;
            self.count += 1;
        }
    }

    /// The contacts, in order of angle.
    #[must_use]
    #[inline]
    pub fn as_slice(&self) -> &[DentContact] {
        self.items.get(..self.count).unwrap_or(&self.items)
    }

    /// The contacts that press, δ > 0, in order of angle; a NaN overlap is passed on, to show itself in the force.
    #[inline]
    pub fn pressing(&self) -> impl Iterator<Item = &DentContact> {
        self.as_slice()
            .iter()
            .filter(|contact| contact.delta > 0.0 || contact.delta.is_nan())
    }
}
