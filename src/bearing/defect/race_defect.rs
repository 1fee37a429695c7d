//! A defect of either race, of any kind.

use super::contacts::DefectContacts;
use super::dent::{Dent, PolarPosition};
use super::measured::MeasuredProfile;
use super::surface::SurfaceDent;
use crate::bearing::materials::Race;

/// What is wrong with a race at one place; each answers for its own arc.
///
/// Angles and positions are in the race's own frame: on the inner race they are relative to the shaft's centre,
/// and angles less the shaft's angle.
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
    /// The race that carries it.
    #[must_use]
    pub fn race(&self) -> Race {
        match self {
            Self::Dent(dent) => dent.race(),
            Self::SurfaceDent(dent) => dent.race(),
            Self::Measured(profile) => profile.race(),
        }
    }

    /// Angle of its middle, rad.
    #[must_use]
    pub fn angle(&self) -> f64 {
        match self {
            Self::Dent(dent) => dent.shape().angle,
            Self::SurfaceDent(dent) => dent.shape().angle,
            Self::Measured(profile) => profile.angle(),
        }
    }

    /// Half the arc that is not race any more, rad.
    #[must_use]
    pub fn half_angle(&self) -> f64 {
        match self {
            Self::Dent(dent) => dent.half_angle(),
            Self::SurfaceDent(dent) => dent.half_angle(),
            Self::Measured(profile) => profile.half_angle(),
        }
    }

    /// Half the arc within which a ball can press on it, rad; [`Self::half_angle`] or more.
    #[must_use]
    pub fn contact_half_angle(&self) -> f64 {
        match self {
            Self::Dent(dent) => dent.contact_half_angle(),
            Self::SurfaceDent(dent) => dent.contact_half_angle(),
            Self::Measured(profile) => profile.contact_half_angle(),
        }
    }

    /// Distance (m) from the race's centre to the profile at `angle` (rad, any turn).
    #[must_use]
    pub fn profile_radius(&self, angle: f64) -> f64 {
        match self {
            Self::Dent(dent) => dent.profile_radius(angle),
            Self::SurfaceDent(dent) => dent.profile_radius(angle),
            Self::Measured(profile) => profile.profile_radius(angle),
        }
    }

    /// How far, m, a ball sinks beyond its place on the race where it sinks deepest.
    #[must_use]
    pub fn ball_drop(&self) -> f64 {
        match self {
            Self::Dent(dent) => dent.ball_drop(),
            Self::SurfaceDent(dent) => dent.ball_drop(),
            Self::Measured(profile) => profile.ball_drop(),
        }
    }

    /// How far, m, it rises above the race at most.
    #[must_use]
    pub fn rise(&self) -> f64 {
        match self {
            Self::Dent(_) | Self::SurfaceDent(_) => 0.0,
            Self::Measured(profile) => profile.rise(),
        }
    }

    /// Whether a ball at `angle` (rad, any turn) can touch anything but the race.
    #[must_use]
    #[inline]
    pub fn contains(&self, angle: f64) -> bool {
        match self {
            Self::Dent(dent) => dent.contains(angle),
            Self::SurfaceDent(dent) => dent.contains(angle),
            Self::Measured(profile) => profile.contains(angle),
        }
    }

    /// All contacts of a ball; see [`Dent::contacts`], [`SurfaceDent::contacts`] and [`MeasuredProfile::contacts`].
    #[must_use]
    #[inline]
    pub fn contacts(&self, ball: PolarPosition) -> DefectContacts {
        let mut found = DefectContacts::none();
        self.contacts_into(ball, &mut found);
        found
    }

    /// [`Self::contacts`] in the place of what was found before.
    #[inline]
    pub fn contacts_into(&self, ball: PolarPosition, found: &mut DefectContacts) {
        match self {
            Self::Dent(dent) => dent.contacts_into(ball, found),
            Self::SurfaceDent(dent) => dent.contacts_into(ball, found),
            Self::Measured(profile) => profile.contacts_into(ball, found),
        }
    }
}
