//! `[[sensors]]`: where acceleration is recorded.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::schema::{one_of, together};
use super::union::{Mismatch, read_as};

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

read_as!(Sensor, SensorForm);

impl TryFrom<SensorForm> for Sensor {
    type Error = Mismatch;

    fn try_from(form: SensorForm) -> Result<Self, Mismatch> {
        const ONE: &str = "exactly one of `group`, `ring_deg`, `node`, `point`, `recovered`";
        let keys = SpotKeys {
            group: form.group,
            ring_deg: form.ring_deg,
            node: form.node,
            point: form.point,
            recovered: form.recovered,
        };
        let spot = keys.spot(ONE)?;
        let direction = match (&spot, form.direction) {
            (SensorSpot::Recovered(_), None) => [0.0; 3],
            (SensorSpot::Recovered(_), Some(_)) => {
                return Err(Mismatch::form(
                    "`direction` beside `recovered`",
                    "`recovered` alone: its row has a direction",
                ));
            }
            (_, Some(direction)) => direction,
            (_, None) => return Err(Mismatch::Missing { key: "direction" }),
        };
        Ok(Self { name: form.name, spot, direction })
    }
}

/// A place by the key that it is written with: one of them has a value.
pub(super) struct SpotKeys {
    pub group: Option<String>,
    pub ring_deg: Option<f64>,
    pub node: Option<u64>,
    pub point: Option<[f64; 3]>,
    pub recovered: Option<String>,
}

impl SpotKeys {
    /// The one place that was given; `expected` says which keys there are.
    pub(super) fn spot(self, expected: &'static str) -> Result<SensorSpot, Mismatch> {
        let spots = [
            self.group.map(SensorSpot::Group),
            self.ring_deg.map(SensorSpot::RingDeg),
            self.node.map(SensorSpot::Node),
            self.point.map(SensorSpot::Point),
            self.recovered.map(SensorSpot::Recovered),
        ];
        let mut given = spots.into_iter().flatten();
        match (given.next(), given.next()) {
            (Some(spot), None) => Ok(spot),
            (None, _) => Err(Mismatch::form("none of them", expected)),
            _ => Err(Mismatch::form("several", expected)),
        }
    }
}
