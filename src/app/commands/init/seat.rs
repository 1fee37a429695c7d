//! The seats of bearings: bores on one axis, each with the bearing that fits it and the ring that is tied to it.

use super::bore::{Candidate, NAMES};
use super::groups::says;
use super::scene::{BearingNumbers, RingNumbers};
use crate::app::case::FIT;
use crate::bearing::catalogue::CatalogueBearing;
use crate::fe::mesh::cylinder::Cylinder;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Serialize;

/// How far beside the first bore's axis another one's centre may lie, and how far their axes may part over a radius, over its radius.
const BESIDE: f64 = 1e-2;

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

/// A bore with its bearing and ring; lengths in m.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Seat {
    /// The bore; `None`: none was found.
    pub bore: Option<FoundCylinder>,
    /// Where the ring's centre goes: that of the bore, on the axis of all.
    pub centre: [f64; 3],
    /// Place along the axis from the first bore's centre.
    pub place: f64,
    /// The bearing that fits, and others of its outer diameter.
    pub bearing: Option<BearingNumbers>,
    pub same_size: Vec<&'static str>,
    pub ring: RingNumbers,
    /// Place of a sensor.
    pub spot: Option<[f64; 3]>,
}

impl Seat {
    /// The bearing that fits, else that of the template.
    pub(crate) fn numbers(&self) -> BearingNumbers {
        self.bearing.unwrap_or_else(|| BearingNumbers::of(self.ring.of))
    }

    /// What its bearing's lengths are multiplied by.
    pub(crate) fn scale(&self) -> f64 {
        if self.bearing.is_some() { 1.0 } else { self.ring.scale }
    }

    /// Bore of its bearing, m.
    pub(crate) fn shaft_bore(&self) -> f64 {
        self.scale() * self.numbers().bearing.bore
    }
}

/// Takes the other bores on the first one's axis out of the holes, nearest first. A group says by its name that it is one; a CAD
/// surface is one where a bearing of the catalogue fits both, for a shaft passes through holes too. `metres` are those of the mesh's unit.
pub(crate) fn further_bores(bore: &Candidate, holes: &mut Vec<Candidate>, metres: f64) -> Vec<Candidate> {
    let fits = |hole: &Candidate| {
        let nearest = CatalogueBearing::nearest(2.0 * hole.cylinder.radius * metres);
        nearest.first().is_some_and(|(_, off)| off.abs() <= FIT)
    };
    let is_seat = |hole: &Candidate| {
        if bore.entity { fits(bore) && fits(hole) } else { !hole.entity && says(&hole.group, &NAMES) }
    };
    let named = bore.entity || says(&bore.group, &NAMES);
    let place = |hole: &Candidate| along(&bore.cylinder, &hole.cylinder);
    let mut taken: Vec<Candidate> = Vec::new();
    for index in (0..holes.len()).rev() {
        let hole = &holes[index];
        let apart = taken.iter().chain([bore]).all(|other| {
            let reach = 0.5 * (hole.cylinder.length + other.cylinder.length);
            (place(hole) - place(other)).abs() > reach
        });
        if named && is_seat(hole) && apart && is_coaxial(&bore.cylinder, &hole.cylinder) {
            taken.push(holes.remove(index));
        }
    }
    taken.sort_by(|a, b| place(a).abs().total_cmp(&place(b).abs()));
    taken
}

/// Place of a cylinder's middle along another one's axis, from its middle.
pub(crate) fn along(first: &Cylinder, other: &Cylinder) -> f64 {
    Vector3::from(first.axis).dot(&(Vector3::from(other.centre) - Vector3::from(first.centre)))
}

fn is_coaxial(first: &Cylinder, other: &Cylinder) -> bool {
    let (axis, arm) = (Vector3::from(first.axis), Vector3::from(other.centre) - Vector3::from(first.centre));
    let beside = (arm - axis * axis.dot(&arm)).norm();
    let skew = axis.cross(&Vector3::from(other.axis)).norm();
    beside <= BESIDE * first.radius && skew <= BESIDE
}

/// The axis of bores on one line, through the two that lie farthest apart, in the first one's direction: a short bore in a coarse
/// mesh tells its own axis less well.
pub(crate) fn common_axis(bore: &Cylinder, further: &[Candidate]) -> [f64; 3] {
    let all = || further.iter().map(|own| &own.cylinder).chain([bore]);
    let by_place = |a: &&Cylinder, b: &&Cylinder| along(bore, a).total_cmp(&along(bore, b));
    let (low, high) = (all().min_by(by_place), all().max_by(by_place));
    let line = low.zip(high).map(|(low, high)| Vector3::from(high.centre) - Vector3::from(low.centre));
    line.and_then(|line| line.try_normalize(f64::MIN_POSITIVE)).map_or(bore.axis, Into::into)
}

/// In m, by the metres of the mesh's unit.
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
