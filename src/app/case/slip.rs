//! Slip of the cage: a number, or a table over time or speed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::schema::{any_of, number, table};
use super::union::{Loose, Mismatch, written_as};

/// Share of the cage's rolling speed that is lost, >= 0 and < 1; straight lines between points, constant beyond them.
#[derive(Debug, Clone, PartialEq)]
pub enum Slip {
    /// Always the same.
    Constant(f64),
    /// Over time, at least one point, times increasing.
    OverTime(Vec<SlipAtTime>),
    /// Over the magnitude of the shaft's speed, at least one point, speeds not below 0 and increasing.
    OverSpeed(Vec<SlipAtSpeed>),
}

impl Default for Slip {
    fn default() -> Self {
        Self::Constant(0.0)
    }
}

/// Slip at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlipAtTime {
    /// In s.
    pub time: f64,
    /// Share of the rolling speed that is lost.
    pub slip: f64,
}

/// Slip at a speed of the shaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlipAtSpeed {
    /// Revolutions per second, either way.
    pub hz: f64,
    /// Share of the rolling speed that is lost.
    pub slip: f64,
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("anyOf" = one_axis()))]
struct SlipForm {
    /// Straight lines between points, constant before the first and after the last; at least one, in increasing order.
    profile: Vec<SlipPoint>,
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SlipPoint {
    /// In s; in every point, or in none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    time: Option<f64>,
    /// Speed of the shaft in Hz, >= 0; in every point, or in none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    hz: Option<f64>,
    /// Share of the cage's rolling speed that is lost, >= 0 and < 1.
    slip: f64,
}

written_as!(Slip, Loose<SlipForm>, |generator| any_of(&[
    number(),
    table::<SlipForm>(generator)
]));

/// Every point over time, or every point over speed.
fn one_axis() -> Value {
    let over = |key, other| {
        let point = json!({ "required": [key], "not": { "required": [other] } });
        json!({ "properties": { "profile": { "items": point } } })
    };
    json!([over("time", "hz"), over("hz", "time")])
}

impl TryFrom<Loose<SlipForm>> for Slip {
    type Error = Mismatch;

    fn try_from(form: Loose<SlipForm>) -> Result<Self, Mismatch> {
        let form = match form {
            Loose::Number(slip) => return Ok(Self::Constant(slip)),
            Loose::Whole(slip) => return Ok(Self::Constant(slip as f64)),
            Loose::Table(form) => form,
            other => {
                return Err(
                    other.mismatch("a number, or { profile = [{ time or hz, slip }, ...] }")
                );
            }
        };
        let over_time = form
            .profile
            .iter()
            .map(|point| match (point.time, point.hz) {
                (Some(time), None) => Some(SlipAtTime {
                    time,
                    slip: point.slip,
                }),
                _ => None,
            });
        if let Some(points) = over_time.collect() {
            return Ok(Self::OverTime(points));
        }
        let over_speed = form
            .profile
            .iter()
            .map(|point| match (point.time, point.hz) {
                (None, Some(hz)) => Some(SlipAtSpeed {
                    hz,
                    slip: point.slip,
                }),
                _ => None,
            });
        if let Some(points) = over_speed.collect() {
            return Ok(Self::OverSpeed(points));
        }
        Err(Mismatch::form(
            "points with neither, both, or now the one and now the other",
            "`time` in every point, or `hz` in every point",
        ))
    }
}

impl From<Slip> for Loose<SlipForm> {
    fn from(slip: Slip) -> Self {
        let profile = match slip {
            Slip::Constant(slip) => return Self::Number(slip),
            Slip::OverTime(points) => points
                .into_iter()
                .map(|point| SlipPoint {
                    time: Some(point.time),
                    hz: None,
                    slip: point.slip,
                })
                .collect(),
            Slip::OverSpeed(points) => points
                .into_iter()
                .map(|point| SlipPoint {
                    time: None,
                    hz: Some(point.hz),
                    slip: point.slip,
                })
                .collect(),
        };
        Self::Table(SlipForm { profile })
    }
}
