//! What a mesh shows of a case: bore, parts, supports, unit and bearing.

use super::{bore, page};
use std::path::Path;

use serde::Serialize;

use super::bore::{Candidate, Cylinders};
use super::entities::{Offered, offer};
use super::groups::{Groups, PartGuess};
use super::partly::PartlyHole;
use super::scene::{BearingNumbers, Directions, RingNumbers, UnitFrom, unit_of};
use super::seat::{FoundCylinder, Seat, common_axis, further_bores, scaled};
use crate::app::case::{BUILT_IN_MATERIALS, FIT, other_size};
use crate::app::commands::Inspection;
use crate::app::commands::inspect::size;
use crate::app::error::ComputeError;
use crate::bearing::catalogue::CatalogueBearing;
use crate::fe::mesh::{ConsistentUnits, DeckMaterial, Mesh, MeshError, Rim};
use crate::numerics::units::LengthUnit;
use nalgebra::Vector3;

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
    /// The first bore with its bearing, and the others on its axis.
    pub(crate) seat: Seat,
    pub(crate) further: Vec<Seat>,
    pub(crate) holes: Vec<FoundCylinder>,
    pub(crate) outside: Vec<FoundCylinder>,
    /// Groups of which a part is a hole: that hole, its share of the group, and whether the rest is a shoulder.
    pub(crate) partly: Vec<(FoundCylinder, f64, bool)>,
    /// Flat faces of CAD surfaces with the whole body behind them.
    pub(crate) flat: Vec<String>,
    /// CAD surfaces that were looked at for a bore.
    pub(crate) surfaces: usize,
    pub(crate) directions: Directions,
    /// Connected parts of the mesh.
    pub(crate) bodies: usize,
    /// Materials of the mesh's file.
    pub(crate) deck_materials: Vec<DeckMaterial>,
    /// Mass of the parts by their materials, kg; of a plane mesh, as thick as the file says.
    pub(crate) mass: f64,
}

impl Found<'_> {
    /// Every bore with its bearing; the template where no bore was found.
    pub(crate) fn seats(&self) -> impl Iterator<Item = &Seat> {
        std::iter::once(&self.seat).chain(&self.further)
    }
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
    let (Cylinders { bore, mut holes, outside, partly }, Offered { flat, surfaces }) = offer(mesh, dimension, &rim);
    let longest = extent.into_iter().fold(0.0, f64::max);
    let radius = bore.as_ref().map(|bore| bore.cylinder.radius);
    let units = ConsistentUnits::of(&mesh.notes.materials);
    let (unit, unit_from) = unit_of(request.length_unit, longest, radius, request.bearing, units);
    let metres = unit.to_metres();
    let further = bore.as_ref().map_or_else(Vec::new, |bore| further_bores(bore, &mut holes, metres));
    let bores: Vec<&str> = bore.iter().chain(&further).map(|bore| bore.group.as_str()).collect();
    let mut groups = Groups::of(mesh, dimension, &bores);
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
    let axis = bore.as_ref().map_or([0.0, 0.0, 1.0], |bore| match further.as_slice() {
        [] => bore.cylinder.axis,
        further => common_axis(&bore.cylinder, further),
    });
    let directions = Directions::of(axis, bore::stands_along(mesh, &rim, &groups.supports));
    let middle = inventory.bounding_box;
    let middle = [0, 1, 2].map(|axis| 0.5 * (middle.min[axis] + middle.max[axis]));
    let seen = [directions.up, directions.axis];
    let spot = |bore: Option<&Candidate>| {
        let (centre, radius) = bore.map_or((middle, 0.0), |bore| (bore.cylinder.centre, bore.cylinder.radius));
        let point = bore::spot(mesh, &rim, centre, radius, seen, &groups.supports);
        point.map(|point| point.map(|part| part * metres))
    };
    let spots: Vec<_> = match &bore {
        Some(first) => [first].into_iter().chain(&further).map(|bore| spot(Some(bore))).collect(),
        None => vec![spot(None)],
    };
    let in_metres = |list: Vec<Candidate>| list.into_iter().map(|found| scaled(found, metres)).collect();
    let bores: Vec<FoundCylinder> = in_metres(bore.into_iter().chain(further).collect());
    refuse_other_size(&request, &bores)?;
    let mut bores = bores.into_iter();
    let mut spots = spots.into_iter();
    let seat = seat(&request, bores.next(), spots.next().flatten());
    let (start, axis) = (Vector3::from(seat.centre), Vector3::from(directions.axis));
    let further = bores.zip(spots).map(|(bore, spot)| {
        let found = self::seat(&request, Some(bore), spot);
        let place = axis.dot(&(Vector3::from(found.centre) - start));
        Seat { centre: (start + axis * place).into(), place, ..found }
    });
    let further: Vec<Seat> = further.collect();
    let thickness = if plane { seat.ring.of.width * seat.ring.scale } else { 1.0 };
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
        seat,
        further,
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
        bodies: inventory.parts.len(),
    })
}

/// Refuses a bearing that was asked for and fits no bore.
fn refuse_other_size(request: &DraftRequest<'_>, bores: &[FoundCylinder]) -> Result<(), ComputeError> {
    let Some(bearing) = request.bearing else { return Ok(()) };
    let rules = bores.iter().map(|bore| {
        let named = format!("the bore {}", page::quoted(&bore.group));
        other_size(bearing, &named, [bore.radius_m; 2], "--length-unit")
    });
    let rules: Option<Vec<_>> = rules.collect();
    match rules.and_then(|rules| rules.into_iter().next()) {
        None => Ok(()),
        Some(rule) => Err(ComputeError::Input { what: format!("--bearing: {rule}"), help: rule.help() }),
    }
}

/// A bore with the bearing asked for, else the nearest of the catalogue if one fits, of several of one outer diameter that of the
/// series 62; and with the names of all of that diameter. Without a bore it is a template for the smallest bearing.
fn seat(request: &DraftRequest<'_>, bore: Option<FoundCylinder>, spot: Option<[f64; 3]>) -> Seat {
    let diameter = bore.as_ref().map_or(0.0, |bore| 2.0 * bore.radius_m);
    let nearest = CatalogueBearing::nearest(diameter);
    let usual = nearest.first().map(|(bearing, _)| *bearing);
    let asked = request.bearing.filter(|bearing| other_size(bearing, "", [0.5 * diameter; 2], "").is_none());
    let all: Vec<&CatalogueBearing> =
        nearest.into_iter().filter(|(_, off)| off.abs() <= FIT).map(|(bearing, _)| bearing).collect();
    let all = if bore.is_some() && asked.is_none() { all } else { Vec::new() };
    let common = |bearing: &&&CatalogueBearing| bearing.name.len() == 4 && bearing.name.starts_with("62");
    let bearing = asked.or(all.iter().find(common).or(all.first()).copied());
    let of = bearing.or(request.bearing).or(usual).unwrap_or(&CatalogueBearing::all()[0]);
    Seat {
        centre: bore.as_ref().map_or([0.0; 3], |bore| bore.centre_m),
        place: 0.0,
        bearing: bearing.map(BearingNumbers::of),
        same_size: all.iter().map(|bearing| bearing.name).collect(),
        ring: RingNumbers::of(of, if diameter > 0.0 { diameter } else { of.outer_diameter }),
        spot,
        bore,
    }
}
