//! `plummer init`: from a mesh to a case file that is ready to be edited.
//!
//! The bore is the group that lies on a cylinder with the housing outside of it; parts and supports go by dimension and name; the
//! rest is from the catalogue, usual values and guesses. The file says of every value which of these it is, and what could not be
//! told is there as a template, commented out. The same mesh gives the same file.
//!
//! **Limitations**: one bore, one bearing; links between parts that share no nodes are left to the user.

mod bore;
mod cylinder;
mod error;
mod frame;
mod groups;
mod page;
mod run_text;
mod scene;
mod sensor;
#[cfg(test)]
mod tests;
mod text;
mod unit;

use std::path::Path;

use serde::Serialize;

pub use error::DraftError;
pub use unit::UnitFrom;

use self::bore::{Candidate, Cylinders, Rim, TOLERANCE, cylinders};
use self::frame::Directions;
use self::groups::{Groups, usable};
use self::scene::{BearingNumbers, RingNumbers};
use super::Inspection;
use crate::bearing::catalogue::CatalogueBearing;
use crate::fe::mesh::{Mesh, MeshError};
use crate::numerics::units::LengthUnit;

/// What is asked for.
#[derive(Debug, Clone, Copy)]
pub struct DraftRequest<'a> {
    /// The mesh file.
    pub mesh: &'a Path,
    /// How the case file names it.
    pub mesh_in_case: &'a str,
    /// The case's title.
    pub title: &'a str,
    /// Unit of the mesh's coordinates, if it is known.
    pub length_unit: Option<LengthUnit>,
    /// The bearing, if it is known.
    pub bearing: Option<&'static CatalogueBearing>,
}

/// A group that lies on a cylinder, in m.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoundCylinder {
    /// Name of the group.
    pub group: String,
    /// Unit vector along the axis.
    pub axis: [f64; 3],
    /// Point on the axis in the middle of its length.
    pub centre_m: [f64; 3],
    /// Radius.
    pub radius_m: f64,
    /// Extent along the axis.
    pub length_m: f64,
    /// Root of the mean squared distance of the faces' corners from it.
    pub rms_m: f64,
    /// Largest distance of a node from it.
    pub farthest_m: f64,
    /// Share of the full turn that it covers, 0 to 1.
    pub turn: f64,
}

/// A case file, and what it was made from.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Draft {
    /// Unit that the file says.
    pub length_unit: LengthUnit,
    /// Where it comes from.
    #[serde(skip)]
    pub unit_from: UnitFrom,
    /// The bore that the ring is tied to; `None`: none was found.
    pub bore: Option<FoundCylinder>,
    /// Other round holes, best first.
    pub other_holes: Vec<FoundCylinder>,
    /// Designation of the bearing; `None`: none of the catalogue fits.
    pub bearing: Option<&'static str>,
    /// Groups that are parts, with their materials.
    pub parts: Vec<[String; 2]>,
    /// Groups that are held.
    pub supports: Vec<String>,
    /// What was found and guessed, in sentences.
    pub findings: Vec<String>,
    /// The case file.
    #[serde(skip)]
    pub text: String,
}

/// Everything that the text is written from; lengths in m.
struct Found<'a> {
    request: DraftRequest<'a>,
    plane: bool,
    /// Sides of the mesh's box, in the mesh's unit.
    extent: [f64; 3],
    unit: LengthUnit,
    unit_from: UnitFrom,
    groups: Groups,
    bore: Option<FoundCylinder>,
    holes: Vec<FoundCylinder>,
    outside: Vec<FoundCylinder>,
    directions: Directions,
    /// Place of a sensor.
    spot: Option<[f64; 3]>,
    /// The bearing that fits, and others of its outer diameter.
    bearing: Option<BearingNumbers>,
    same_size: Vec<&'static str>,
    ring: RingNumbers,
    /// Connected parts of the mesh.
    bodies: usize,
}

impl Draft {
    /// Writes a case file for a mesh. The inspection is that of the same mesh in its own unit, as if that were the metre.
    ///
    /// # Errors
    /// [`DraftError`] when the mesh cannot be read, has no group for a part, or its bore is not as large as the bearing asked for.
    pub fn of_mesh(request: DraftRequest<'_>) -> Result<(Self, Inspection), DraftError> {
        let mesh = Mesh::read_gmsh(request.mesh, LengthUnit::Metre)?;
        let inspection = Inspection::of_mesh(&mesh, None);
        let found = find(request, &mesh, &inspection)?;
        Ok((text::write(&found), inspection))
    }
}

fn find<'a>(
    request: DraftRequest<'a>,
    mesh: &Mesh,
    inspection: &Inspection,
) -> Result<Found<'a>, DraftError> {
    let inventory = &inspection.inventory;
    let dimension = inventory.dimension;
    let path = || request.mesh.to_owned();
    if dimension < 2 {
        return Err(DraftError::NoHousing { path: path() });
    }
    let extent = inventory.bounding_box.extent();
    let plane = dimension == 2;
    if plane && extent[2] > 1e-9 * inventory.bounding_box.diagonal() {
        let height = extent[2];
        return Err(DraftError::Shell {
            path: path(),
            height,
        });
    }
    let rim = Rim::of(mesh, dimension);
    let Cylinders {
        bore,
        holes,
        outside,
    } = cylinders(mesh, dimension, &rim, |group| usable(mesh, group));
    let groups = Groups::of(
        mesh,
        dimension,
        bore.as_ref().map(|bore| bore.group.as_str()),
    );
    if groups.parts.is_empty() {
        // a name that two groups share is no name
        let solids = mesh
            .groups
            .iter()
            .filter(|group| group.dimension == dimension);
        let named = solids.map(|group| mesh.group(&group.name));
        if let Some(shared) = named
            .filter_map(Result::err)
            .find(|error| matches!(error, MeshError::AmbiguousGroup { .. }))
        {
            return Err(shared.into());
        }
        let what = if plane { "surfaces" } else { "volumes" };
        return Err(DraftError::NoPart { path: path(), what });
    }
    let longest = extent.into_iter().fold(0.0, f64::max);
    let radius = bore.as_ref().map(|bore| bore.cylinder.radius);
    let (unit, unit_from) = unit::unit(request.length_unit, longest, radius, request.bearing);
    let metres = unit.to_metres();
    let directions = Directions::of(
        bore.as_ref()
            .map_or([0.0, 0.0, 1.0], |bore| bore.cylinder.axis),
    );
    let middle = inventory.bounding_box;
    let middle = [0, 1, 2].map(|axis| 0.5 * (middle.min[axis] + middle.max[axis]));
    let centre = bore.as_ref().map_or(middle, |bore| bore.cylinder.centre);
    let seen = [directions.up, directions.axis];
    let spot = sensor::spot(mesh, &rim, centre, radius.unwrap_or(0.0), seen);
    let in_metres = |list: Vec<Candidate>| {
        list.into_iter()
            .map(|found| scaled(found, metres))
            .collect()
    };
    let bore = bore.map(|bore| scaled(bore, metres));
    // no bore: a template for the smallest bearing
    let diameter = bore.as_ref().map_or(0.0, |bore| 2.0 * bore.radius_m);
    let (bearing, same_size) = fitting(&request, bore.as_ref())?;
    let usual = CatalogueBearing::nearest(diameter)
        .first()
        .map(|(bearing, _)| *bearing);
    let of = bearing
        .or(request.bearing)
        .or(usual)
        .unwrap_or(&CatalogueBearing::all()[0]);
    let diameter = if diameter > 0.0 {
        diameter
    } else {
        of.outer_diameter
    };
    Ok(Found {
        request,
        plane,
        extent,
        unit,
        unit_from,
        groups,
        bore,
        holes: in_metres(holes),
        outside: in_metres(outside),
        directions,
        spot: spot.map(|point| point.map(|part| part * metres)),
        bearing: bearing.map(BearingNumbers::of),
        same_size,
        ring: RingNumbers::of(of, diameter),
        bodies: inventory.parts.len(),
    })
}

fn scaled(found: Candidate, metres: f64) -> FoundCylinder {
    let cylinder = found.cylinder;
    FoundCylinder {
        group: found.group,
        axis: cylinder.axis,
        centre_m: cylinder.centre.map(|part| part * metres),
        radius_m: cylinder.radius * metres,
        length_m: cylinder.length * metres,
        rms_m: cylinder.rms * metres,
        farthest_m: cylinder.farthest * metres,
        turn: cylinder.turn,
    }
}

/// The bearing asked for, which must fit, else the nearest of the catalogue if it does: of several of one outer diameter that of the
/// series 62. And the names of all of that diameter.
fn fitting(
    request: &DraftRequest<'_>,
    bore: Option<&FoundCylinder>,
) -> Result<(Option<&'static CatalogueBearing>, Vec<&'static str>), DraftError> {
    let Some(bore) = bore else {
        return Ok((None, Vec::new()));
    };
    let diameter = 2.0 * bore.radius_m;
    let nearest = CatalogueBearing::nearest(diameter);
    if let Some(bearing) = request.bearing {
        if (bearing.outer_diameter / diameter - 1.0).abs() <= TOLERANCE {
            return Ok((Some(bearing), Vec::new()));
        }
        let names = nearest.iter().map(|(bearing, _)| {
            format!(
                "{} ({} mm)",
                bearing.name,
                page::number(1e3 * bearing.outer_diameter, 6)
            )
        });
        return Err(DraftError::BearingSize {
            bearing: bearing.name,
            outer_mm: 1e3 * bearing.outer_diameter,
            group: bore.group.clone(),
            bore_mm: 1e3 * diameter,
            nearest: format!(
                "nearest of the catalogue: {}",
                names.collect::<Vec<_>>().join(", ")
            ),
        });
    }
    let fits: Vec<&CatalogueBearing> = nearest
        .into_iter()
        .filter(|(_, off)| off.abs() <= TOLERANCE)
        .map(|(bearing, _)| bearing)
        .collect();
    let common =
        |bearing: &&&CatalogueBearing| bearing.name.len() == 4 && bearing.name.starts_with("62");
    let chosen = fits.iter().find(common).or(fits.first()).copied();
    Ok((chosen, fits.iter().map(|bearing| bearing.name).collect()))
}

impl Found<'_> {
    /// A group one dimension below the housing that may be held, for a template.
    fn surface(&self) -> Option<&str> {
        let below = if self.plane { 1 } else { 2 };
        let mut others = self.groups.others.iter();
        let other = others.find(|other| other.dimension == below && other.note.is_none());
        other.map(|other| other.group.as_str())
    }
}
