//! `[frf]`: transfer paths from where forces act to sensors.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::modes::Variant;
use super::schema::one_of;
use super::sensor::SensorSpot;
use super::union::{exactly_one, read_as};

/// Transfer paths: from every force to every sensor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Frf {
    /// Where unit forces act, one at a time; at least one.
    pub from: Vec<Push>,
    /// Names of sensors; empty: all of the case.
    #[serde(default)]
    pub to: Vec<String>,
    /// Lowest and highest frequency in Hz, 0 <= lowest < highest; default: that of `[accuracy]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub band_hz: Option<[f64; 2]>,
    /// Frequencies in Hz at which the reduced response is compared with that of the full model; default: a few of the
    /// band and its highest peaks. An empty list compares nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub check_hz: Option<Vec<f64>>,
    /// The same case with other keys set, ranked by what they transmit; may be empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<Variant>,
}

/// A unit force.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Push {
    /// Its name in results.
    pub name: String,
    /// Where it acts; on a group it is shared evenly by the nodes.
    #[serde(flatten)]
    pub spot: SensorSpot,
    /// Direction in the mesh's frame, any length but zero.
    pub direction: [f64; 3],
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["group", "ring_deg", "node", "point"])))]
/// A unit force at exactly one of `group`, `ring_deg`, `node`, `point`.
struct PushForm {
    /// Its name in results.
    name: Option<String>,
    /// Shared evenly by the nodes of this physical group of the mesh.
    group: Option<String>,
    /// On the ring, at an angle in degrees.
    ring_deg: Option<f64>,
    /// A node of the mesh, by gmsh's tag.
    node: Option<u64>,
    /// The mesh's node nearest to this point, in m.
    point: Option<[f64; 3]>,
    /// Direction in the mesh's frame, any length but zero.
    direction: [f64; 3],
}

read_as!(Push, PushForm, |form| {
    const ONE: &str = "exactly one of `group`, `ring_deg`, `node`, `point`";
    let spots = [
        form.group.map(SensorSpot::Group),
        form.ring_deg.map(SensorSpot::RingDeg),
        form.node.map(SensorSpot::Node),
        form.point.map(SensorSpot::Point),
    ];
    let spot = exactly_one(spots, ONE)?;
    let name = form.name.unwrap_or_else(|| match &spot {
        SensorSpot::Group(group) => group.clone(),
        SensorSpot::RingDeg(degrees) => format!("ring at {degrees} degrees"),
        SensorSpot::Node(tag) => format!("node {tag}"),
        SensorSpot::Point([x, y, z]) => format!("point ({x}, {y}, {z})"),
        SensorSpot::Recovered(row) => row.clone(),
    });
    Ok(Self { name, spot, direction: form.direction })
});
