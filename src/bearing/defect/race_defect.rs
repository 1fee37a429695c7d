//! A defect of either race, of any kind.

use super::contacts::DefectContacts;
use super::dent::Dent;
use super::measured::MeasuredProfile;
use super::race_profile::{PolarPosition, RaceProfile};
use super::surface::SurfaceDent;
use crate::bearing::materials::Race;

/// What is wrong with a race at one place; its methods are those of [`RaceProfile`].
#[derive(Debug, Clone, PartialEq)]
pub enum RaceDefect {
    /// Elliptical dent in the plane.
    Dent(Dent),
    /// Elliptical dent in three dimensions.
    SurfaceDent(SurfaceDent),
    /// Measured profile.
    Measured(MeasuredProfile),
}

impl RaceDefect {
    /// Whichever it is.
    #[must_use]
    pub(crate) fn profile(&self) -> &dyn RaceProfile {
        match self {
            Self::Dent(dent) => dent,
            Self::SurfaceDent(dent) => dent,
            Self::Measured(profile) => profile,
        }
    }

    /// See [`RaceProfile::race`].
    #[must_use]
    pub(crate) fn race(&self) -> Race {
        self.profile().race()
    }

    /// See [`RaceProfile::angle`].
    #[must_use]
    pub(crate) fn angle(&self) -> f64 {
        self.profile().angle()
    }

    /// See [`RaceProfile::half_angle`].
    #[must_use]
    pub(crate) fn half_angle(&self) -> f64 {
        self.profile().half_angle()
    }

    /// See [`RaceProfile::contact_half_angle`].
    #[must_use]
    pub(crate) fn contact_half_angle(&self) -> f64 {
        self.profile().contact_half_angle()
    }

    /// See [`RaceProfile::profile_radius`].
    #[must_use]
    pub(crate) fn profile_radius(&self, angle: f64) -> f64 {
        self.profile().profile_radius(angle)
    }

    /// See [`RaceProfile::ball_drop`].
    #[must_use]
    pub(crate) fn ball_drop(&self) -> f64 {
        self.profile().ball_drop()
    }

    /// See [`RaceProfile::rise`].
    #[must_use]
    pub(crate) fn rise(&self) -> f64 {
        self.profile().rise()
    }

    /// See [`RaceProfile::contains`].
    #[must_use]
    pub fn contains(&self, angle: f64) -> bool {
        self.profile().contains(angle)
    }

    /// See [`RaceProfile::contacts_into`].
    #[inline]
    pub(crate) fn contacts_into(&self, ball: PolarPosition, found: &mut DefectContacts) {
        // no table of functions in the hot loop
        match self {
            Self::Dent(dent) => dent.contacts_into(ball, found),
            Self::SurfaceDent(dent) => dent.contacts_into(ball, found),
            Self::Measured(profile) => profile.contacts_into(ball, found),
        }
    }
}
