//! Which group of a mesh is the bore: a cylindrical hole (in a plane mesh a round one).
//!
//! Where an accelerometer may stand: on the outside of the housing, above the bearing.

use super::groups::{SupportGuess, says};
use super::partly::{PartlyHole, partly_hole};
use crate::fe::mesh::cylinder::{Cylinder, Facet, fit};
use crate::fe::mesh::{Mesh, PhysicalGroup, Rim};
use nalgebra::Vector3;
use std::collections::HashSet;

/// Least share of the turn that a CAD surface covers which is taken for the bore: a fillet inside covers a quarter, the
/// end of a slot a half, and a keyway takes less than a quarter away.
const BORE_TURN: f64 = 0.75;

/// Parts of names that a bore has.
pub(super) const NAMES: [&str; 6] = ["bore", "bearing", "seat", "hub", "bohrung", "lager"];

/// A group that lies on a cylinder.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Candidate {
    /// Name of the group.
    pub group: String,
    /// Whether it is a CAD surface and no physical group.
    pub entity: bool,
    /// What it lies on, in the mesh's unit.
    pub cylinder: Cylinder,
}

/// What the surfaces of a mesh are.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cylinders {
    /// The bore, as far as one can tell.
    pub bore: Option<Candidate>,
    /// Other holes, best first.
    pub holes: Vec<Candidate>,
    /// Round surfaces with the housing inside of them.
    pub outside: Vec<Candidate>,
    /// Groups named like a bore, or any where no bore was found, of which a part alone is a hole; largest share first.
    pub partly: Vec<(String, PartlyHole)>,
}

/// Fits a cylinder to every group whose name `usable` accepts, one dimension below the housing.
pub(crate) fn cylinders(
    mesh: &Mesh,
    dimension: usize,
    rim: &Rim,
    usable: impl Fn(&PhysicalGroup) -> bool,
) -> Cylinders {
    let groups = mesh.groups.iter().filter(|group| group.dimension + 1 == dimension && usable(group));
    let mut rough = Vec::new();
    let mut found = Vec::new();
    for group in groups {
        let nodes: Vec<[f64; 3]> = group.nodes.iter().map(|&node| mesh.nodes[node]).collect();
        let facets = rim.facets_of(mesh, &group.elements);
        let cylinder = fit(&facets, &nodes);
        match cylinder.filter(Cylinder::is_round) {
            Some(cylinder) => found.push(Candidate { group: group.name.clone(), entity: group.tag == 0, cylinder }),
            None if group.tag == 0 => {}
            None => rough.push((group, facets)),
        }
    }
    let found = found.into_iter();
    let (mut holes, outside): (Vec<_>, Vec<_>) = found.partition(|candidate| candidate.cylinder.hole == Some(true));
    // a name before the surface itself: a bearing sits in one hole of many
    let named = |candidate: &Candidate| says(&candidate.group, &NAMES);
    let surface = |candidate: &Candidate| candidate.cylinder.radius * candidate.cylinder.turn;
    holes.sort_by(|a, b| named(b).cmp(&named(a)).then(surface(b).total_cmp(&surface(a))));
    let bore = holes.iter().position(|hole| !hole.entity || hole.cylinder.turn >= BORE_TURN);
    let bore = bore.map(|place| holes.remove(place));
    rough.retain(|(group, _)| bore.is_none() || says(&group.name, &NAMES));
    let partly = rough.iter().filter_map(|(group, facets)| {
        let elements = group.elements.iter();
        let corners = elements.map(|id| {
            let block = &mesh.blocks[id.block];
            let nodes = block.element(id.index).unwrap_or_default();
            nodes.iter().take(block.kind.corners()).copied().collect()
        });
        let part = partly_hole(facets, &corners.collect::<Vec<_>>())?;
        Some((group.name.clone(), part))
    });
    let mut partly: Vec<(String, PartlyHole)> = partly.collect();
    partly.sort_by(|(_, a), (_, b)| b.share.total_cmp(&a.share));
    Cylinders { bore, holes, outside, partly }
}

/// Cosine of the angle between a face and the direction of the sensor up to which it may stand there.
const FACING: f64 = 0.7;

/// How far beside the axis, over the bore's radius.
const BESIDE: f64 = 0.35;

/// Looks from `centre` along `up` (unit vectors; lengths in the mesh's unit): the corner of the first face beyond `radius` that
/// faces that way, beside the line and along `axis` by no more than a part of the radius. Without one the highest corner of all.
/// Nodes of the groups that are `held` are none.
pub(crate) fn spot(
    mesh: &Mesh,
    rim: &Rim,
    centre: [f64; 3],
    radius: f64,
    [up, axis]: [[f64; 3]; 2],
    held: &[SupportGuess],
) -> Option<[f64; 3]> {
    let groups = held.iter().filter_map(|support| mesh.group(&support.group).ok());
    let held: HashSet<_> =
        groups.flat_map(|group| &group.nodes).map(|&node| mesh.nodes[node].map(f64::to_bits)).collect();
    let (centre, up, axis) = (Vector3::from(centre), Vector3::from(up), Vector3::from(axis));
    let side = up.cross(&axis);
    let height = |point: &Vector3<f64>| up.dot(&(point - centre));
    let beside = |point: &Vector3<f64>| {
        let arm = point - centre;
        side.dot(&arm).hypot(axis.dot(&arm))
    };
    let mut best: Option<(f64, Vector3<f64>)> = None;
    let mut highest: Option<Vector3<f64>> = None;
    for facet in rim.facets(mesh) {
        let corners: Vec<Vector3<f64>> = facet.corners().iter().map(|&c| Vector3::from(c)).collect();
        let is_free = |corner: &&Vector3<f64>| !held.contains(&[corner.x, corner.y, corner.z].map(f64::to_bits));
        for corner in corners.iter().filter(is_free) {
            if highest.is_none_or(|other| height(corner) > height(&other)) {
                highest = Some(*corner);
            }
        }
        if outwards(&facet, &corners).is_none_or(|normal| normal.dot(&up) < FACING) {
            continue;
        }
        let near = corners.iter().filter(is_free).min_by(|a, b| beside(a).total_cmp(&beside(b)));
        let Some(corner) = near.filter(|corner| height(corner) > 1.001 * radius) else {
            continue;
        };
        let off = beside(corner);
        // the nearest face first, then the corner nearest to the line
        let cost = height(corner) + off;
        if off <= BESIDE * radius && best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, *corner));
        }
    }
    best.map(|(_, corner)| corner).or(highest).map(Into::into)
}

/// Parts of names of what a housing stands on.
const STANDS: [&str; 4] = ["foot", "feet", "base", "ground"];

/// Least length of the sum of a foot's normals, over its area: those of bolt holes cancel.
const FLAT: f64 = 0.5;

/// Unit vector from the supports named like feet into the housing; `None` without one, or where their faces look all ways.
pub(crate) fn stands_along(mesh: &Mesh, rim: &Rim, supports: &[SupportGuess]) -> Option<Vector3<f64>> {
    let feet = supports.iter().filter(|support| says(&support.group, &STANDS));
    let groups = feet.filter_map(|support| mesh.group(&support.group).ok());
    let (mut sum, mut area) = (Vector3::zeros(), 0.0);
    for facet in groups.flat_map(|group| rim.facets_of(mesh, &group.elements)) {
        let corners: Vec<Vector3<f64>> = facet.corners().iter().map(|&c| Vector3::from(c)).collect();
        if let Some(normal) = outwards(&facet, &corners) {
            let own = facet.area().norm();
            sum -= normal * own;
            area += own;
        }
    }
    if sum.norm() > FLAT * area { sum.try_normalize(0.0) } else { None }
}

/// Unit normal of a face away from its element; `None` for a face without area.
fn outwards(facet: &Facet, corners: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let normal = facet.area().try_normalize(f64::MIN_POSITIVE)?;
    let inside = Vector3::from(facet.inside?);
    let out = normal.dot(&(corners[0] - inside));
    Some(if out < 0.0 { -normal } else { normal })
}
