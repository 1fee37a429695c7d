//! `[[sensors]]`: where acceleration is recorded.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::schema::{one_of, together};
use super::union::{exactly_one, mismatch, missing, read_as};

/// An accelerometer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sensor {
    /// Name of its signal; unique.
    pub name: String,
    /// Where it stands.
    #[serde(flatten)]
    pub spot: SensorSpot,
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
    /// The mean over a physical group of the mesh.
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
    /// The mean over this physical group of the mesh.
    group: Option<String>,
    /// On the ring, at an angle in degrees.
    ring_deg: Option<f64>,
    /// A node of the mesh, by gmsh's tag.
    node: Option<u64>,
    /// The mesh's node nearest to this point, in m.
    point: Option<[f64; 3]>,
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
    Ok(Self { name: form.name, spot, direction })
});
