//! `[[sensors]]`: where acceleration is recorded.

use serde::{Deserialize, Serialize};

use super::union::{Mismatch, written_as};

/// An accelerometer.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Name of its signal; unique.
    pub name: String,
    /// Where it stands.
    pub spot: SensorSpot,
    /// Direction in the mesh's frame (the ring's where there is no mesh), any length but zero.
    pub direction: [f64; 3],
}

/// Where a sensor stands.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorSpot {
    /// The mean over a physical group of the mesh.
    Group(String),
    /// On the ring, at an angle in degrees.
    RingDeg(f64),
    /// A node of the mesh, by gmsh's tag.
    Node(u64),
    /// The mesh's node nearest to this point, in m.
    Point([f64; 3]),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SensorForm {
    name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    group: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ring_deg: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    node: Option<u64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    point: Option<[f64; 3]>,
    direction: [f64; 3],
}

written_as!(Sensor, SensorForm);

impl TryFrom<SensorForm> for Sensor {
    type Error = Mismatch;

    fn try_from(form: SensorForm) -> Result<Self, Mismatch> {
        let spot = one_spot(form.group, form.ring_deg, form.node, form.point)?;
        Ok(Self {
            name: form.name,
            spot,
            direction: form.direction,
        })
    }
}

impl From<Sensor> for SensorForm {
    fn from(sensor: Sensor) -> Self {
        let mut form = Self {
            name: sensor.name,
            group: None,
            ring_deg: None,
            node: None,
            point: None,
            direction: sensor.direction,
        };
        match sensor.spot {
            SensorSpot::Group(group) => form.group = Some(group),
            SensorSpot::RingDeg(angle) => form.ring_deg = Some(angle),
            SensorSpot::Node(tag) => form.node = Some(tag),
            SensorSpot::Point(point) => form.point = Some(point),
        }
        form
    }
}

/// The one place that was given.
pub(super) fn one_spot(
    group: Option<String>,
    ring_deg: Option<f64>,
    node: Option<u64>,
    point: Option<[f64; 3]>,
) -> Result<SensorSpot, Mismatch> {
    const ONE: &str = "exactly one of `group`, `ring_deg`, `node`, `point`";
    let spots = [
        group.map(SensorSpot::Group),
        ring_deg.map(SensorSpot::RingDeg),
        node.map(SensorSpot::Node),
        point.map(SensorSpot::Point),
    ];
    let mut given = spots.into_iter().flatten();
    match (given.next(), given.next()) {
        (Some(spot), None) => Ok(spot),
        (None, _) => Err(Mismatch::form("none of them", ONE)),
        _ => Err(Mismatch::form("several", ONE)),
    }
}
