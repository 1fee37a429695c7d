//! The bearing of a case.

use super::bearing_defects::{defects, waves};
use super::bearing_motion::{shaft, slip, speed};
use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::bearing::{BearingDimensions, BearingGeometry, Cage, ContactMaterial, ContactStiffness, RaceContacts};
use crate::system::BearingSetup;

/// The bearing with its loads and motion; `None` without `[bearing]` or `[shaft]`.
///
/// # Errors
/// [`ComputeError`] naming what is out of range.
pub fn bearing_setup(case: &Case) -> Result<Option<BearingSetup>, ComputeError> {
    let parts = case.bearing.as_ref().zip(case.shaft.as_ref());
    parts.map(|(asked, shaft)| setup_of(case, asked, shaft)).transpose()
}

/// The bearing that is asked for, with its loads and motion.
///
/// # Errors
/// [`ComputeError`] naming what is out of range.
pub(crate) fn setup_of(
    case: &Case,
    asked: &case::Bearing,
    asked_shaft: &case::Shaft,
) -> Result<BearingSetup, ComputeError> {
    let geometry = geometry(case, asked)?;
    let stiffness = match asked.stiffness {
        case::ContactStiffness::Hertz => hertz(case, asked, &geometry)?.stiffness(),
        case::ContactStiffness::Given { inner, outer } => {
            ContactStiffness::given(inner, outer).map_err(ComputeError::bearing("bearing.stiffness: "))?
        }
    };
    let (race_defects, flats) = defects(&asked.defects, &geometry, stiffness)?;
    Ok(BearingSetup {
        cage: Cage::new(&geometry, speed(case)?, slip(&asked.slip)?, asked.first_ball_deg.to_radians())
            .map_err(ComputeError::bearing("bearing: "))?,
        geometry,
        stiffness,
        contact_damping: asked.contact_damping,
        formulation: asked.formulation,
        // what is left to the program is chosen for a run, with the rest of its model
        balls_inertia: asked.balls_inertia.unwrap_or_default(),
        waves: waves(&asked.waviness, &geometry)?,
        oversizes: asked.ball_radius_differences.clone(),
        race_defects,
        flats,
        gravity: asked_shaft.gravity,
        shaft: shaft(asked_shaft),
    })
}

/// Hertz contacts of both races from geometry and materials, whichever stiffness the case uses; `None` without a bearing.
///
/// # Errors
/// [`ComputeError`] naming what is out of range.
pub(crate) fn race_contacts(case: &Case) -> Result<Option<RaceContacts>, ComputeError> {
    let asked = case.bearing.as_ref();
    asked.map(|asked| contacts_of(case, asked)).transpose()
}

/// Hertz contacts of the bearing that is asked for.
///
/// # Errors
/// [`ComputeError`] naming what is out of range.
pub(crate) fn contacts_of(case: &Case, asked: &case::Bearing) -> Result<RaceContacts, ComputeError> {
    hertz(case, asked, &geometry(case, asked)?)
}

/// Geometry of a case's bearing; `None` without one.
///
/// # Errors
/// [`ComputeError`] naming what is out of range.
pub(crate) fn bearing_geometry(case: &Case) -> Result<Option<BearingGeometry>, ComputeError> {
    let asked = case.bearing.as_ref();
    asked.map(|asked| geometry(case, asked)).transpose()
}

fn geometry(case: &Case, asked: &case::Bearing) -> Result<BearingGeometry, ComputeError> {
    let dimensions = BearingDimensions {
        balls: u32::try_from(asked.balls).unwrap_or(u32::MAX),
        ball_radius: asked.ball_radius,
        ball_mass: case.mass_of_ball(asked)?,
        inner_race_radius: asked.inner_race_radius,
        outer_race_radius: asked.outer_race_radius,
        inner_groove_radius: asked.inner_groove_radius,
        outer_groove_radius: asked.outer_groove_radius,
    };
    let geometry = BearingGeometry::new(dimensions);
    let geometry = match asked.radial_play {
        Some(play) => geometry.and_then(|geometry| geometry.with_radial_play(play)),
        None => geometry,
    };
    geometry.map_err(ComputeError::bearing("bearing: "))
}

fn hertz(case: &Case, asked: &case::Bearing, geometry: &BearingGeometry) -> Result<RaceContacts, ComputeError> {
    let contact = |key: &str, name: &str| -> Result<ContactMaterial, ComputeError> {
        let material = super::housing::material(case, key, name)?;
        Ok(ContactMaterial { young: material.young, poisson: material.poisson })
    };
    RaceContacts::new(
        geometry,
        contact("bearing.ball_material", &asked.ball_material)?,
        contact("bearing.race_material", &asked.race_material.inner)?,
        contact("bearing.race_material", &asked.race_material.outer)?,
    )
    .map_err(ComputeError::bearing("bearing.stiffness: "))
}
