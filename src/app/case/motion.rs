//! `[shaft]`, `[damping]`, `[speed]`: what moves and what slows it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::schema::one_of;
use super::union::{mismatch, read_as};
use crate::bearing::SpeedKnot;

/// The rigid shaft with the inner ring. x to the right, y up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shaft {
    /// Mass in kg, > 0.
    pub mass: f64,
    /// Unbalance, mass times eccentricity, in kg m, >= 0.
    #[serde(default)]
    pub unbalance: f64,
    /// Gravity along x and y in m/s^2.
    #[serde(default = "downwards")]
    pub gravity: [f64; 2],
    /// Forces on the shaft, added up; may be empty.
    #[serde(default)]
    pub loads: Vec<Load>,
}

fn downwards() -> [f64; 2] {
    [0.0, -9.81]
}

/// A force.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub enum Load {
    /// Always the same, along x and y in N.
    #[serde(rename = "force")]
    Constant([f64; 2]),
    /// Straight lines between points, constant before the first and after the last; at least one, times increasing.
    #[serde(rename = "profile")]
    Profile(Vec<LoadPoint>),
    /// Always the same, in space: for `plummer bearing` alone.
    #[serde(untagged)]
    Spatial {
        /// Along x, y and z in N.
        force: [f64; 3],
        /// About x and y in N m, about the bearing's centre.
        moment: [f64; 2],
    },
}

/// A force in the plane, or in space.
struct ForceForm(Vec<f64>);

read_as!(ForceForm, Vec<f64>, |_generator| two_or_three(), |form| {
    match form.len() {
        2 | 3 => Ok(Self(form)),
        found => Err(mismatch(format!("an array of {found}"), "an array of 2, or of 3 in space")),
    }
});

fn two_or_three() -> schemars::Schema {
    schemars::json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 3 })
}

/// A force at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadPoint {
    /// In s.
    pub time: f64,
    /// Along x and y in N.
    pub force: [f64; 2],
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["force", "profile"])))]
/// A force on the shaft: constant, or over time.
struct LoadForm {
    /// Always the same, along x and y, and in space along z, in N.
    force: Option<ForceForm>,
    /// Beside `force`: moment about x and y through the bearing's centre, in N m.
    moment: Option<[f64; 2]>,
    /// Straight lines between points, constant before the first and after the last; at least one, times increasing.
    profile: Option<Vec<LoadPoint>>,
}

read_as!(Load, LoadForm, |form| {
    const ONE: &str = "`force` = [x, y], or `profile` = [{ time, force }, ...]";
    let moment = form.moment.unwrap_or_default();
    match (form.force, form.profile) {
        (Some(ForceForm(force)), None) => {
            let at = |axis: usize| force.get(axis).copied().unwrap_or(0.0);
            let in_plane = at(2).abs() <= 0.0 && moment.iter().all(|part| part.abs() <= 0.0);
            Ok(match in_plane {
                true => Self::Constant([at(0), at(1)]),
                false => Self::Spatial { force: [at(0), at(1), at(2)], moment },
            })
        }
        (_, Some(_)) | (None, None) if form.moment.is_some() => Err(mismatch("`moment` without `force`", ONE)),
        (None, Some(points)) => Ok(Self::Profile(points)),
        (None, None) => Err(mismatch("neither", ONE)),
        (Some(_), Some(_)) => Err(mismatch("both", ONE)),
    }
});

/// Damping of housing and ring.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Damping {
    /// C = alpha M + beta K through two points of the damping ratio over frequency.
    Ratios([RatioAt; 2]),
    /// The same damping ratio for every mode, >= 0 and < 1.
    Modal(f64),
    /// C = alpha M + beta K.
    #[serde(untagged)]
    Rayleigh {
        /// In 1/s, >= 0.
        alpha: f64,
        /// In s, >= 0.
        beta: f64,
    },
}

/// A damping ratio at a frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RatioAt {
    /// In Hz, > 0.
    pub frequency_hz: f64,
    /// Share of critical damping, >= 0 and < 1.
    pub ratio: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "oneOf" = one_of(&["ratios", "alpha", "modal"]),
    "dependencies" = json!({ "alpha": ["beta"], "beta": ["alpha"] })
))]
/// Damping of housing and ring: exactly one of `ratios`, `alpha` with `beta`, `modal`.
struct DampingForm {
    /// Proportional damping through two points of the damping ratio over frequency.
    ratios: Option<[RatioAt; 2]>,
    /// Damping proportional to mass in 1/s, >= 0.
    alpha: Option<f64>,
    /// Damping proportional to stiffness in s, >= 0.
    beta: Option<f64>,
    /// The same damping ratio for every mode, >= 0 and < 1.
    modal: Option<f64>,
}

read_as!(Damping, DampingForm, |form| {
    const ONE: &str = "exactly one of `ratios`, `alpha` with `beta`, `modal`";
    match (form.ratios, (form.alpha, form.beta), form.modal) {
        (Some(ratios), (None, None), None) => Ok(Self::Ratios(ratios)),
        (None, (None, None), Some(ratio)) => Ok(Self::Modal(ratio)),
        (None, (Some(alpha), Some(beta)), None) => Ok(Self::Rayleigh { alpha, beta }),
        (None, (Some(_), None), None) => Err(mismatch("`alpha` without `beta`", ONE)),
        (None, (None, Some(_)), None) => Err(mismatch("`beta` without `alpha`", ONE)),
        (None, (None, None), None) => Err(mismatch("none of them", ONE)),
        _ => Err(mismatch("several", ONE)),
    }
});

/// Shaft speed over time: straight lines between points, constant before the first and after the last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Speed {
    /// At least one point, times increasing.
    pub profile: Vec<SpeedKnot>,
}
