//! A defect of either race, of any kind.

use super::contacts::{DefectContacts, PolarPosition, RaceProfile};
use super::dent::Dent;
use super::measured::MeasuredProfile;
use super::surface::SurfaceDent;
use std::ops::Deref;

/// What is wrong with a race at one place; it stands for its [`RaceProfile`].
#[derive(Debug, Clone, PartialEq)]
pub enum RaceDefect {
    /// Elliptical dent in the plane.
    Dent(Dent),
    /// Elliptical dent in three dimensions.
    SurfaceDent(SurfaceDent),
    /// Measured profile.
    Measured(MeasuredProfile),
}

impl Deref for RaceDefect {
    type Target = dyn RaceProfile;

    fn deref(&self) -> &(dyn RaceProfile + 'static) {
        match self {
            Self::Dent(dent) => dent,
            Self::SurfaceDent(dent) => dent,
            Self::Measured(profile) => profile,
        }
    }
}

impl RaceDefect {
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
