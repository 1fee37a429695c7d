//! What a mesh shows of a case: bore, parts, supports, unit and bearing.

use super::{bore, page};
use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use super::bore::{Candidate, Cylinders};
use super::entities::{Offered, offer};
use super::groups::{Groups, PartGuess};
use super::partly::PartlyHole;
use super::scene::{BearingNumbers, Directions, RingNumbers, UnitFrom, unit_of};
use crate::app::case::{BUILT_IN_MATERIALS, FIT, other_size};
use crate::app::commands::Inspection;
use crate::app::commands::inspect::size;
use crate::app::error::ComputeError;
use crate::bearing::catalogue::CatalogueBearing;
use crate::fe::mesh::{DeckMaterial, Mesh, MeshError, Rim};
use crate::numerics::units::LengthUnit;

/// What is asked for.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct DraftRequest<'a> {
    /// The mesh file.
    #[serde(skip)]
    pub mesh: &'a Path,
    /// How the case file names it.
    pub mesh_in_case: &'a str,
    /// The case's title.
    pub title: &'a str,
    /// Unit of the mesh's coordinates, if it is known.
    pub length_unit: Option<LengthUnit>,
    /// The bearing, if it is known.
    pub bearing: Option<&'static CatalogueBearing>,
    /// Whether folded elements of second order are mended.
    pub straighten: bool,
}

/// A group that lies on a cylinder, in m.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
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

/// Everything that the text is written from; lengths in m.
#[derive(Serialize)]
pub(crate) struct Found<'a> {
    pub(crate) request: DraftRequest<'a>,
    pub(crate) plane: bool,
    /// Sides of the mesh's box, in the mesh's unit.
    pub(crate) extent: [f64; 3],
    pub(crate) unit: LengthUnit,
    pub(crate) unit_from: UnitFrom,
    pub(crate) groups: Groups,
    pub(crate) bore: Option<FoundCylinder>,
    pub(crate) holes: Vec<FoundCylinder>,
    pub(crate) outside: Vec<FoundCylinder>,
    /// Groups of which a part is a hole: that hole, its share of the group, and whether the rest is a shoulder.
    pub(crate) partly: Vec<(FoundCylinder, f64, bool)>,
    /// Flat faces of CAD surfaces with the whole body behind them.
    pub(crate) flat: Vec<String>,
    /// CAD surfaces that were looked at for a bore.
    pub(crate) surfaces: usize,
    pub(crate) directions: Directions,
    /// Place of a sensor.
    pub(crate) spot: Option<[f64; 3]>,
    /// The bearing that fits, and others of its outer diameter.
    pub(crate) bearing: Option<BearingNumbers>,
    pub(crate) same_size: Vec<&'static str>,
    pub(crate) ring: RingNumbers,
    /// Connected parts of the mesh.
    pub(crate) bodies: usize,
    /// Materials of the mesh's file.
    pub(crate) deck_materials: Vec<DeckMaterial>,
    /// Mass of the parts by their materials, kg; of a plane mesh, as thick as the file says.
    pub(crate) mass: f64,
}

pub(crate) fn find<'a>(
    request: DraftRequest<'a>,
    mesh: &mut Mesh,
    inspection: &Inspection,
) -> Result<Found<'a>, ComputeError> {
    let inventory = &inspection.inventory;
    let dimension = inventory.dimension;
    let wrong = |what: String, help: String| ComputeError::input(format!("{}: {what}", request.mesh.display()), help);
    if dimension < 2 {
        return Err(wrong(
            "found a mesh of curves or points, expected surfaces or volumes".to_owned(),
            "mesh the volume: gmsh PART.step -3 -order 2 -o PART.msh".to_owned(),
        ));
    }
    let extent = inventory.bounding_box.extent();
    let plane = dimension == 2;
    if inspection.shells {
        return Err(wrong(
            format!(
                "found a mesh of surfaces that reach over {} units of length along z, expected one in a plane z = const, or volumes",
                page::number(extent[2], 4)
            ),
            "shells are not modelled: mesh the volume, gmsh PART.step -3 -order 2 -o PART.msh, with -algo hxt or smaller elements where gmsh makes no volumes".to_owned(),
        ));
    }
    let rim = Rim::of(mesh, dimension);
    let (Cylinders { bore, holes, outside, partly }, Offered { flat, surfaces }) = offer(mesh, dimension, &rim);
    let mut groups = Groups::of(mesh, dimension, bore.as_ref().map(|bore| bore.group.as_str()));
    if bore.is_some() {
        groups.hold_flat(&flat, dimension);
    }
    if groups.parts.is_empty() {
        // a name that two groups share is no name
        let solids = mesh.groups.iter().filter(|group| group.dimension == dimension);
        let named = solids.map(|group| mesh.body(&group.name));
        let mut errors = named.filter_map(Result::err);
        if let Some(shared) = errors.find(|error| matches!(error, MeshError::AmbiguousGroup(_))) {
            return Err(shared.into());
        }
        let (what, word) = if plane { ("surfaces", "Surface") } else { ("volumes", "Volume") };
        return Err(wrong(
            format!("found no physical group of {what} that a part could be made of"),
            format!(
                "name it in gmsh, Physical {word}(\"housing\") = {{...}};, and save the mesh again; plummer inspect shows what is there"
            ),
        ));
    }
    let longest = extent.into_iter().fold(0.0, f64::max);
    let radius = bore.as_ref().map(|bore| bore.cylinder.radius);
    let (unit, unit_from) = unit_of(request.length_unit, longest, radius, request.bearing, groups.units);
    let metres = unit.to_metres();
    let directions = Directions::of(bore.as_ref().map_or([0.0, 0.0, 1.0], |bore| bore.cylinder.axis));
    let middle = inventory.bounding_box;
    let middle = [0, 1, 2].map(|axis| 0.5 * (middle.min[axis] + middle.max[axis]));
    let centre = bore.as_ref().map_or(middle, |bore| bore.cylinder.centre);
    let seen = [directions.up, directions.axis];
    let spot = bore::spot(mesh, &rim, centre, radius.unwrap_or(0.0), seen, &groups.supports);
    let in_metres = |list: Vec<Candidate>| list.into_iter().map(|found| scaled(found, metres)).collect();
    let bore = bore.map(|bore| scaled(bore, metres));
    // no bore: a template for the smallest bearing
    let diameter = bore.as_ref().map_or(0.0, |bore| 2.0 * bore.radius_m);
    let (bearing, same_size) = fitting(&request, bore.as_ref())?;
    let usual = CatalogueBearing::nearest(diameter).first().map(|(bearing, _)| *bearing);
    let of = bearing.or(request.bearing).or(usual).unwrap_or(&CatalogueBearing::all()[0]);
    let diameter = if diameter > 0.0 { diameter } else { of.outer_diameter };
    let ring = RingNumbers::of(of, diameter);
    let thickness = if plane { ring.of.width * ring.scale } else { 1.0 };
    let of_part = |part: &PartGuess| {
        let size = size(mesh, mesh.body(&part.group).ok()?.elements.iter().copied());
        let known = BUILT_IN_MATERIALS.iter().find(|known| known.name == part.material);
        let of_file = groups.materials.iter().find(|own| own.name == part.material).map(|own| own.density[1]);
        let density = of_file.or(known.map(|known| known.material.density))?;
        Some(size * metres.powi(dimension as i32) * thickness * density)
    };
    let mass = groups.parts.iter().filter_map(of_part).sum();
    Ok(Found {
        deck_materials: mesh.notes.materials.clone(),
        mass,
        request,
        plane,
        extent,
        unit,
        unit_from,
        groups,
        bore,
        holes: in_metres(holes),
        outside: in_metres(outside),
        partly: partly
            .into_iter()
            .map(|(group, PartlyHole { cylinder, share, shoulder })| {
                (scaled(Candidate { group, entity: false, cylinder }, metres), share, shoulder)
            })
            .collect(),
        flat,
        surfaces,
        directions,
        spot: spot.map(|point| point.map(|part| part * metres)),
        bearing: bearing.map(BearingNumbers::of),
        same_size,
        ring,
        bodies: inventory.parts.len(),
    })
}

pub(crate) fn scaled(found: Candidate, metres: f64) -> FoundCylinder {
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
pub(crate) fn fitting(
    request: &DraftRequest<'_>,
    bore: Option<&FoundCylinder>,
) -> Result<(Option<&'static CatalogueBearing>, Vec<&'static str>), ComputeError> {
    let Some(bore) = bore else {
        return Ok((None, Vec::new()));
    };
    if let Some(bearing) = request.bearing {
        let named = format!("the bore {}", page::quoted(&bore.group));
        return match other_size(bearing, &named, [bore.radius_m; 2], "--length-unit") {
            None => Ok((Some(bearing), Vec::new())),
            Some(rule) => Err(ComputeError::Input { what: format!("--bearing: {rule}"), help: rule.help() }),
        };
    }
    let fits: Vec<&CatalogueBearing> = CatalogueBearing::nearest(2.0 * bore.radius_m)
        .into_iter()
        .filter(|(_, off)| off.abs() <= FIT)
        .map(|(bearing, _)| bearing)
        .collect();
    let common = |bearing: &&&CatalogueBearing| bearing.name.len() == 4 && bearing.name.starts_with("62");
    let chosen = fits.iter().find(common).or(fits.first()).copied();
    Ok((chosen, fits.iter().map(|bearing| bearing.name).collect()))
}
