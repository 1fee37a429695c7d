//! What of a case's bearing is not a perfect circle.

use crate::app::case::{self, Defect, DentProfile};
use crate::app::error::ComputeError;
use crate::bearing::defect::{BallFlat, Dent, DentShape, FlatShape, MeasuredProfile, RaceDefect, SurfaceDent, reduced};
use crate::bearing::{BearingGeometry, ContactStiffness, Wave};
use crate::system::FlatOnBall;
use std::path::Path;

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
