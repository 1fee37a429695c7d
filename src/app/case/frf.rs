//! `[frf]`: transfer paths from where forces act to sensors.
//!
//! `[[sensors]]`: where acceleration is recorded.

use super::modes::Variant;
use super::schema::{one_of, together};
use super::union::{exactly_one, mismatch, missing, read_as};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize, de};

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
    /// Label of the bearing whose ring a [`SensorSpot::RingDeg`] is on, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bearing: Option<String>,
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
    /// Shared evenly by the nodes of this group of the mesh.
    group: Option<String>,
    /// On the ring, at an angle in degrees.
    ring_deg: Option<f64>,
    /// Label of the bearing whose ring `ring_deg` is on, where there are several.
    bearing: Option<String>,
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
        SensorSpot::RingDeg(degrees) => {
            let ring = form.bearing.as_ref().map_or_else(|| "ring".to_owned(), |label| format!("ring {label}"));
            format!("{ring} at {degrees} degrees")
        }
        SensorSpot::Node(tag) => format!("node {tag}"),
        SensorSpot::Point([x, y, z]) => format!("point ({x}, {y}, {z})"),
        SensorSpot::Recovered(row) => row.clone(),
    });
    let bearing = beside_ring(form.bearing, &spot)?;
    Ok(Self { name, spot, bearing, direction: form.direction })
});

/// The label of a bearing, which a place on its ring alone may have.
fn beside_ring<E: de::Error>(bearing: Option<String>, spot: &SensorSpot) -> Result<Option<String>, E> {
    match spot {
        SensorSpot::RingDeg(_) => Ok(bearing),
        _ if bearing.is_some() => Err(mismatch("`bearing` without `ring_deg`", "`bearing` beside `ring_deg` alone")),
        _ => Ok(None),
    }
}

/// An accelerometer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sensor {
    /// Name of its signal; unique.
    pub name: String,
    /// Where it stands.
    #[serde(flatten)]
    pub spot: SensorSpot,
    /// Label of the bearing whose ring a [`SensorSpot::RingDeg`] is on, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bearing: Option<String>,
    /// Direction in the mesh's frame (the ring's where there is no mesh), any length but zero; zero for
    /// [`SensorSpot::Recovered`], whose row has a direction of its own.
    #[serde(skip_serializing_if = "is_of_row")]
    pub direction: [f64; 3],
}

/// Whether a direction is that of a row.
fn is_of_row(direction: &[f64; 3]) -> bool {
    direction.iter().all(|&component| component == 0.0)
}

/// Where a sensor stands.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SensorSpot {
    /// The mean over a group of the mesh.
    Group(String),
    /// On the ring, at an angle in degrees.
    RingDeg(f64),
    /// A node of the mesh, by gmsh's tag.
    Node(u64),
    /// The mesh's node nearest to this point, in m.
    Point([f64; 3]),
    /// What a row of the superelement's sensors gives, by name.
    Recovered(String),
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "oneOf" = one_of(&["group", "ring_deg", "node", "point", "recovered"]),
    "anyOf" = one_of(&["recovered", "direction"]),
    "not" = together(&["recovered", "direction"])
))]
/// An accelerometer at exactly one of `group`, `ring_deg`, `node`, `point`, `recovered`.
struct SensorForm {
    /// Name of its signal; unique.
    name: String,
    /// The mean over this group of the mesh.
    group: Option<String>,
    /// On the ring, at an angle in degrees.
    ring_deg: Option<f64>,
    /// A node of the mesh, by gmsh's tag.
    node: Option<u64>,
    /// The mesh's node nearest to this point, in m.
    point: Option<[f64; 3]>,
    /// Label of the bearing whose ring `ring_deg` is on, where there are several.
    bearing: Option<String>,
    /// What this row of the superelement's sensors gives; without `direction`.
    recovered: Option<String>,
    /// Direction in the mesh's frame (the ring's where there is no mesh), any length but zero.
    direction: Option<[f64; 3]>,
}

read_as!(Sensor, SensorForm, |form| {
    const ONE: &str = "exactly one of `group`, `ring_deg`, `node`, `point`, `recovered`";
    let spots = [
        form.group.map(SensorSpot::Group),
        form.ring_deg.map(SensorSpot::RingDeg),
        form.node.map(SensorSpot::Node),
        form.point.map(SensorSpot::Point),
        form.recovered.map(SensorSpot::Recovered),
    ];
    let spot = exactly_one(spots, ONE)?;
    let direction = match (&spot, form.direction) {
        (SensorSpot::Recovered(_), None) => [0.0; 3],
        (SensorSpot::Recovered(_), Some(_)) => {
            let expected = "`recovered` alone: its row has a direction";
            return Err(mismatch("`direction` beside `recovered`", expected));
        }
        (_, Some(direction)) => direction,
        (_, None) => return Err(missing("direction")),
    };
    let bearing = beside_ring(form.bearing, &spot)?;
    Ok(Self { name: form.name, spot, bearing, direction })
});
