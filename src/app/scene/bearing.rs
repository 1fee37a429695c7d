//! The bearing of a case.
//!
//! What drives a bearing: speed, slip and loads of a case.
//!
//! What of a case's bearing is not a perfect circle.

use crate::app::case;
use crate::app::case::{Case, Defect, DentProfile, Load, Slip};
use crate::app::error::ComputeError;
use crate::bearing::defect::{BallFlat, Dent, DentShape, FlatShape, MeasuredProfile, RaceDefect, SurfaceDent, reduced};
use crate::bearing::{
    BearingDimensions, BearingGeometry, Cage, ContactMaterial, ContactStiffness, RaceContacts, SlipProfile,
    SpeedProfile, Wave,
};
use crate::system::{BearingSetup, FlatOnBall, LoadProfile, Shaft};
use std::path::Path;

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
    let stiffness = stiffness(case, asked, &geometry)?;
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

/// Stiffness of the contacts in the plane: by Hertz, or given.
pub(super) fn stiffness(
    case: &Case,
    asked: &case::Bearing,
    geometry: &BearingGeometry,
) -> Result<ContactStiffness, ComputeError> {
    match asked.stiffness {
        case::ContactStiffness::Hertz => Ok(hertz(case, asked, geometry)?.stiffness()),
        case::ContactStiffness::Given { inner, outer } => {
            ContactStiffness::given(inner, outer).map_err(ComputeError::bearing("bearing.stiffness: "))
        }
    }
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

pub(super) fn geometry(case: &Case, asked: &case::Bearing) -> Result<BearingGeometry, ComputeError> {
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
    let geometry = match (asked.radial_play, asked.contact_angle_deg) {
        (Some(play), _) => geometry.and_then(|geometry| geometry.with_radial_play(play)),
        (None, Some(angle)) => geometry.and_then(|geometry| geometry.with_free_contact_angle(angle.to_radians())),
        (None, None) => geometry,
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

/// Shaft speed over time; at rest where the case says nothing.
///
/// # Errors
/// [`ComputeError::Input`].
pub(crate) fn speed(case: &Case) -> Result<SpeedProfile, ComputeError> {
    let profile = match &case.speed {
        Some(speed) => SpeedProfile::new(&speed.profile),
        None => SpeedProfile::constant(0.0),
    };
    profile.map_err(ComputeError::bearing("speed.profile: "))
}

/// Slip of the cage.
///
/// # Errors
/// [`ComputeError::Input`].
pub(crate) fn slip(asked: &Slip) -> Result<SlipProfile, ComputeError> {
    let profile = match asked {
        Slip::Constant(slip) => SlipProfile::constant(*slip),
        Slip::OverTime(points) => SlipProfile::over_time(points),
        Slip::OverSpeed(points) => SlipProfile::over_speed(points),
        Slip::OverRpm(points) => {
            let points: Vec<_> = points.iter().map(|(rpm, slip)| (rpm / 60.0, *slip)).collect();
            SlipProfile::over_speed(&points)
        }
    };
    profile.map_err(ComputeError::bearing(""))
}

/// The shaft and its loads.
pub(crate) fn shaft(asked: &case::Shaft) -> Shaft {
    // `Case::in_the_plane` refuses more than these two components
    let load = |load: &Load| match load {
        Load::Constant(force) => LoadProfile::constant(*force),
        other => {
            let points = other.in_space().1;
            LoadProfile::through(&points.iter().map(|(time, [x, y, ..])| (*time, [*x, *y])).collect::<Vec<_>>())
        }
    };
    Shaft { mass: asked.mass, unbalance: asked.unbalance, loads: asked.loads.iter().map(load).collect() }
}

/// Solves every defect of the case, of races and of balls; reads the profiles that are in files.
///
/// # Errors
/// [`ComputeError`] naming the defect.
pub(crate) fn defects(
    asked: &[Defect],
    geometry: &BearingGeometry,
    stiffness: ContactStiffness,
) -> Result<(Vec<RaceDefect>, Vec<FlatOnBall>), ComputeError> {
    let mut race_defects: Vec<(usize, RaceDefect)> = Vec::new();
    let mut flats = Vec::new();
    for (index, defect) in asked.iter().enumerate() {
        let refused = ComputeError::bearing(format!("bearing.defects[{index}]: "));
        match defect {
            Defect::Dent(dent) => {
                let shape = DentShape {
                    angle: dent.angle_deg.to_radians(),
                    length: dent.length,
                    width: dent.width,
                    depth: dent.depth,
                    rim_radius: dent.rim_radius,
                    curvature: dent.curvature,
                };
                let dent = match dent.profile {
                    DentProfile::InPlane => Dent::new(geometry, dent.on, shape, stiffness).map(RaceDefect::Dent),
                    DentProfile::Surface => {
                        SurfaceDent::new(geometry, dent.on, shape, stiffness).map(RaceDefect::SurfaceDent)
                    }
                };
                race_defects.push((index, dent.map_err(refused)?));
            }
            Defect::Measured(measured) => {
                let samples = read_profile(index, &measured.profile.csv)?;
                let profile =
                    MeasuredProfile::new(geometry, measured.on, measured.angle_deg.to_radians(), &samples, stiffness);
                let profile = RaceDefect::Measured(profile.map_err(refused)?);
                race_defects.push((index, profile));
            }
            Defect::Flat(flat) => {
                let shape = FlatShape {
                    radius: flat.flat_radius,
                    depth: flat.depth,
                    rim_radius: flat.rim_radius,
                    curvature: flat.curvature,
                };
                flats.push(FlatOnBall {
                    ball: flat.ball,
                    shape: BallFlat::new(geometry, shape, stiffness).map_err(refused)?,
                    angle: flat.angle_deg.to_radians(),
                });
            }
        }
    }
    check_apart(&race_defects)?;
    Ok((race_defects.into_iter().map(|(_, defect)| defect).collect(), flats))
}

/// Waves of the races.
///
/// # Errors
/// [`ComputeError::Input`] naming the wave.
pub(crate) fn waves(asked: &[case::Wave], geometry: &BearingGeometry) -> Result<Vec<Wave>, ComputeError> {
    let wave = |(index, wave): (usize, &case::Wave)| {
        let wave =
            Wave { race: wave.on, order: wave.order, amplitude: wave.amplitude, phase: wave.phase_deg.to_radians() };
        wave.checked(geometry).map_err(ComputeError::bearing(format!("bearing.waviness[{index}]: ")))
    };
    asked.iter().enumerate().map(wave).collect()
}

/// Two defects must not share a part of a race: a contact belongs to one of them.
fn check_apart(defects: &[(usize, RaceDefect)]) -> Result<(), ComputeError> {
    for (place, (second, b)) in defects.iter().enumerate() {
        for (first, a) in &defects[..place] {
            let apart = reduced(a.angle() - b.angle()).abs();
            let needed = a.contact_half_angle() + b.contact_half_angle();
            if a.race() == b.race() && apart < needed {
                return Err(ComputeError::wrong(format!(
                    "bearing.defects[{first}] and bearing.defects[{second}] overlap (arcs {:.2} degrees apart, {:.2} needed): move one or make it shorter",
                    apart.to_degrees(),
                    needed.to_degrees()
                )));
            }
        }
    }
    Ok(())
}

/// Columns of a profile's file.
const COLUMNS: [&str; 2] = ["arc_length_m", "depth_m"];

/// Arc length and depth (m) in the rows of a CSV file with the header `arc_length_m,depth_m`; lines that begin with # are
/// left out.
fn read_profile(index: usize, path: &Path) -> Result<Vec<(f64, f64)>, ComputeError> {
    let refused = |line: Option<u64>, what: String| {
        let line = line.map_or_else(String::new, |line| format!(":{line}"));
        ComputeError::wrong(format!("{}{line}: {what} (bearing.defects[{index}].profile)", path.display()))
    };
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_path(path)
        .map_err(|error| refused(None, error.to_string()))?;
    let header = reader.headers().map_err(|error| refused(Some(1), error.to_string()))?;
    if header.iter().ne(COLUMNS) {
        let found = header.iter().collect::<Vec<_>>().join(",");
        let what = format!("found the header \"{found}\", expected \"{}\"", COLUMNS.join(","));
        return Err(refused(Some(1), what));
    }
    let mut samples = Vec::new();
    for row in reader.records() {
        let row = row.map_err(|error| {
            let line = error.position().map(csv::Position::line);
            refused(line, error.to_string())
        })?;
        let line = row.position().map(csv::Position::line);
        let number = |place: usize| {
            let text = row.get(place).unwrap_or_default();
            let what = || format!("{}: found \"{text}\", expected a number", COLUMNS[place]);
            text.parse::<f64>().map_err(|_| refused(line, what()))
        };
        samples.push((number(0)?, number(1)?));
    }
    Ok(samples)
}
