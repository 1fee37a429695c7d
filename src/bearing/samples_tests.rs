//! The source paper's bearing, for tests.

use super::{BearingDimensions, BearingGeometry, ContactMaterial, ContactStiffness, RaceContacts};

/// Table 1 of the source, SI.
pub(crate) fn source_dimensions() -> BearingDimensions {
    BearingDimensions {
        balls: 7,
        ball_radius: 1e-3,
        ball_mass: 3.29e-5,
        inner_race_radius: 2.754e-3,
        outer_race_radius: 4.7565e-3,
        inner_groove_radius: 1.04e-3,
        outer_groove_radius: 1.07e-3,
    }
}

/// The source's bearing, checked.
pub(crate) fn source_bearing() -> BearingGeometry {
    BearingGeometry::new(source_dimensions()).unwrap()
}

/// Bearing steel, 206 GPa.
pub(crate) fn steel() -> ContactMaterial {
    ContactMaterial { young: 206e9, poisson: 0.3 }
}

/// Hertz stiffness of the source's bearing in steel.
pub(crate) fn source_stiffness() -> ContactStiffness {
    RaceContacts::new(&source_bearing(), steel(), steel(), steel()).unwrap().stiffness()
}
