//! Slip of the cage: a number, or a table over time or speed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::schema::{number, or_table};
use super::union::{Loose, mismatch, written_as};

/// Share of the cage's rolling speed that is lost, >= 0 and < 1; straight lines between points, constant beyond them.
#[derive(Debug, Clone, PartialEq)]
pub enum Slip {
    /// Always the same.
    Constant(f64),
    /// Time (s) and slip, at least one point, times increasing.
    OverTime(Vec<(f64, f64)>),
    /// Magnitude of the shaft's speed (Hz) and slip, at least one point, speeds not below 0 and increasing.
    OverSpeed(Vec<(f64, f64)>),
}

impl Default for Slip {
    fn default() -> Self {
        Self::Constant(0.0)
    }
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

/// Every point over time, or every point over speed.
fn one_axis() -> Value {
    let over = |key, other| {
        let point = json!({ "required": [key], "not": { "required": [other] } });
        json!({ "properties": { "profile": { "items": point } } })
    };
    json!([over("time", "hz"), over("hz", "time")])
}

written_as!(Slip, Loose<SlipForm>, or_table::<SlipForm>(vec![number()]), |form| {
    let form = match form {
        Loose::Number(slip) => return Ok(Self::Constant(slip)),
        Loose::Whole(slip) => return Ok(Self::Constant(slip as f64)),
        Loose::Table(form) => form,
        other => {
            return Err(other.mismatch(&[], "a number, or { profile = [{ time or hz, slip }, ...] }"));
        }
    };
    let points = form.profile.iter();
    let over_time = points.clone().map(|point| match (point.time, point.hz) {
        (Some(time), None) => Some((time, point.slip)),
        _ => None,
    });
    if let Some(points) = over_time.collect() {
        return Ok(Self::OverTime(points));
    }
    let over_speed = points.map(|point| match (point.time, point.hz) {
        (None, Some(hz)) => Some((hz, point.slip)),
        _ => None,
    });
    if let Some(points) = over_speed.collect() {
        return Ok(Self::OverSpeed(points));
    }
    Err(mismatch(
        "points with neither, both, or now the one and now the other",
        "`time` in every point, or `hz` in every point",
    ))
});

impl From<Slip> for Loose<SlipForm> {
    fn from(slip: Slip) -> Self {
        let profile = match slip {
            Slip::Constant(slip) => return Self::Number(slip),
            Slip::OverTime(points) => {
                points.into_iter().map(|(time, slip)| SlipPoint { time: Some(time), hz: None, slip }).collect()
            }
            Slip::OverSpeed(points) => {
                points.into_iter().map(|(hz, slip)| SlipPoint { time: None, hz: Some(hz), slip }).collect()
            }
        };
        Self::Table(SlipForm { profile })
    }
}
