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
    /// Moment of inertia about an axis across the shaft through its centre of mass in kg m^2, > 0: what a bearing in space needs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transverse_inertia: Option<f64>,
    /// Moment of inertia about the shaft's own axis in kg m^2, >= 0 and at most twice the transverse one; for a bearing in space alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polar_inertia: Option<f64>,
    /// Place of the centre of mass in m: from the first bearing's centre along its axis; for a bearing in space alone. `None`: 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centre: Option<f64>,
    /// Unbalances in planes of their own; for a bearing in space alone, in which `unbalance` acts at the centre of mass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unbalances: Vec<UnbalanceAt>,
    /// Gravity along x and y in m/s^2.
    #[serde(default = "downwards")]
    pub gravity: [f64; 2],
    /// Forces on the shaft, added up; may be empty.
    #[serde(default)]
    pub loads: Vec<Load>,
}

/// An unbalance in one plane of the shaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnbalanceAt {
    /// Mass times eccentricity in kg m, >= 0.
    pub moment: f64,
    /// Its angle in degrees when the shaft's angle is zero.
    #[serde(default)]
    pub angle_deg: f64,
    /// Place in m: from the first bearing's centre along its axis.
    pub at: f64,
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
    /// Always the same, in space.
    #[serde(untagged)]
    Spatial {
        /// Along x, y and z in N.
        force: [f64; 3],
        /// About x and y in N m, about the place of the force.
        moment: [f64; 2],
        /// Place in m: from the first bearing's centre along its axis.
        at: f64,
    },
    /// Straight lines between points in space, constant before the first and after the last; at least one, times increasing.
    #[serde(untagged)]
    SpatialProfile {
        /// The points.
        profile: Vec<SpatialLoadPoint>,
        /// Place in m: from the first bearing's centre along its axis.
        at: f64,
    },
}

impl Load {
    /// Whether it stays in the plane of the only bearing.
    pub(crate) fn is_in_plane(&self) -> bool {
        matches!(self, Self::Constant(_) | Self::Profile(_))
    }

    /// Its place along the axis (m), and at its points in time the force along x, y, z (N) and the moment about x and y (N m).
    pub(crate) fn in_space(&self) -> (f64, Vec<(f64, [f64; 5])>) {
        let of_point = |point: &SpatialLoadPoint| {
            let ([x, y, z], [a, b]) = (point.force, point.moment);
            (point.time, [x, y, z, a, b])
        };
        match self {
            Self::Constant([x, y]) => (0.0, vec![(0.0, [*x, *y, 0.0, 0.0, 0.0])]),
            Self::Profile(points) => {
                let points = points.iter().map(|&LoadPoint { time, force: [x, y] }| (time, [x, y, 0.0, 0.0, 0.0]));
                (0.0, points.collect())
            }
            Self::Spatial { force: [x, y, z], moment: [a, b], at } => (*at, vec![(0.0, [*x, *y, *z, *a, *b])]),
            Self::SpatialProfile { profile, at } => (*at, profile.iter().map(of_point).collect()),
        }
    }
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LoadPoint {
    /// In s.
    pub time: f64,
    /// Along x and y in N.
    pub force: [f64; 2],
}

/// A force in space at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpatialLoadPoint {
    /// In s.
    pub time: f64,
    /// Along x, y and z in N.
    pub force: [f64; 3],
    /// About x and y in N m, about the place of the force.
    pub moment: [f64; 2],
}

/// A force at a time, in the plane or in space.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PointForm {
    /// In s.
    time: f64,
    /// Along x and y, and in space along z, in N.
    force: ForceForm,
    /// About x and y in N m, about the place of the force.
    #[serde(default)]
    moment: [f64; 2],
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["force", "profile"])))]
/// A force on the shaft: constant, or over time.
struct LoadForm {
    /// Always the same, along x and y, and in space along z, in N.
    force: Option<ForceForm>,
    /// Beside `force`: moment about x and y, about the place of the force, in N m.
    moment: Option<[f64; 2]>,
    /// Straight lines between points, constant before the first and after the last; at least one, times increasing.
    profile: Option<Vec<PointForm>>,
    /// Place of the force in m: from the first bearing's centre along its axis. Absent: 0.
    at: Option<f64>,
}

/// Force along x, y and z (N).
fn three(ForceForm(force): &ForceForm) -> [f64; 3] {
    std::array::from_fn(|axis| force.get(axis).copied().unwrap_or(0.0))
}

read_as!(Load, LoadForm, |form| {
    const ONE: &str = "`force` = [x, y], or `profile` = [{ time, force }, ...]";
    let at = form.at.unwrap_or(0.0);
    let is_zero = |value: &f64| value.abs() <= 0.0;
    let in_plane =
        |force: &[f64; 3], moment: &[f64; 2]| is_zero(&at) && is_zero(&force[2]) && moment.iter().all(is_zero);
    match (form.force, form.profile) {
        (Some(force), None) => {
            let (force, moment) = (three(&force), form.moment.unwrap_or_default());
            Ok(match in_plane(&force, &moment) {
                true => Self::Constant([force[0], force[1]]),
                false => Self::Spatial { force, moment, at },
            })
        }
        (_, Some(_)) | (None, None) if form.moment.is_some() => Err(mismatch("`moment` without `force`", ONE)),
        (None, Some(points)) => {
            let points = points.iter().map(|point| (point.time, three(&point.force), point.moment));
            Ok(match points.clone().all(|(_, force, moment)| in_plane(&force, &moment)) {
                true => Self::Profile(points.map(|(time, [x, y, _], _)| LoadPoint { time, force: [x, y] }).collect()),
                false => Self::SpatialProfile {
                    profile: points.map(|(time, force, moment)| SpatialLoadPoint { time, force, moment }).collect(),
                    at,
                },
            })
        }
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
