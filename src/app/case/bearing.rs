//! `[bearing]`: balls, races and contacts.
//!
//! Slip of the cage: a number, or a table over time or speed.

use super::defect::Defect;
use super::named_bearing::named_or_numbers;
use super::schema::{any_of, number, one_of, or_table, text, together, whole, words};
use super::union::{Loose, exactly_one, mismatch, read_as, written_as};
use crate::bearing::Race;
use crate::bearing::spatial::{RaceControl, Thrust};
use crate::system::{BallsInertia, Formulation};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// A deep-groove ball bearing, its outer ring fixed to the housing. Lengths in m.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("not" = together(&["ball_mass", "density"]), "required" = [], "anyOf" = named_or_numbers()))]
pub struct Bearing {
    /// Designation in the catalogue, which gives number and radii of balls, races and grooves and the play, as far as they are absent:
    /// `"6204"` (`plummer init --list-bearings`).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Number of balls, 3 to 40.
    pub balls: usize,
    /// Ball radius, > 0.
    pub ball_radius: f64,
    /// Mass of one ball in kg, > 0; excludes `density`. Without both: that of a full sphere of `ball_material`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ball_mass: Option<f64>,
    /// Density of the balls in kg/m^3, > 0; excludes `ball_mass`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
    /// Name of the balls' material, for the contact stiffness and, by default, for their mass.
    #[serde(default = "bearing_steel")]
    pub ball_material: String,
    /// Names of the races' materials, for the contact stiffness.
    #[serde(default)]
    pub race_material: RaceMaterial,
    /// Radial play from the centred position to first contact; negative: preload. `None`: what the radii give.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radial_play: Option<f64>,
    /// Free contact angle in degrees, above 0 and below 90, in the place of `radial_play`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_angle_deg: Option<f64>,
    /// Which way along the axis the shaft may push the inner ring. `None`: along +z with `contact_angle_deg`, either way without.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thrust: Option<Thrust>,
    /// Which race carries the friction of the balls' gyroscopic moment. `None`: the outer one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub race_control: Option<RaceControl>,
    /// Axial preload along `thrust`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preload: Option<Preload>,
    /// Hunt-Crossley contact damping in s/m, >= 0: F = k delta^(3/2) (1 + c delta').
    #[serde(default)]
    pub contact_damping: f64,
    /// How balls follow their radial motion; `None`: the program's choice by the accuracy asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub balls_inertia: Option<BallsInertia>,
    /// Radius of the inner race at the groove's bottom, > 0.
    pub inner_race_radius: f64,
    /// Radius of the outer race at the groove's bottom, above that of the inner one.
    pub outer_race_radius: f64,
    /// Radius of the inner groove across the rolling direction, above the ball's.
    pub inner_groove_radius: f64,
    /// Radius of the outer groove across the rolling direction, above the ball's.
    pub outer_groove_radius: f64,
    /// Contact stiffness.
    #[serde(default)]
    pub stiffness: ContactStiffness,
    /// Which equations of motion.
    #[serde(default)]
    pub formulation: Formulation,
    /// Angle of the first ball at t = 0 and for linearisation, in degrees; 270 puts a ball under the load.
    #[serde(default = "under_the_load")]
    pub first_ball_deg: f64,
    /// Share of the cage's rolling speed that is lost by slip; 0: pure rolling.
    #[serde(default)]
    pub slip: Slip,
    /// Waves round the races; may be empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waviness: Vec<Wave>,
    /// How much larger than `ball_radius` the radius of each ball is, one number a ball; empty: not at all.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ball_radius_differences: Vec<f64>,
    /// Localised defects; may be empty.
    #[serde(default)]
    pub defects: Vec<Defect>,
}

/// A wave round a race: h = amplitude cos(order angle + phase), outwards positive.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wave {
    /// The race that carries it.
    pub on: Race,
    /// Waves in one turn, at least 1.
    pub order: u32,
    /// In m, >= 0.
    pub amplitude: f64,
    /// In degrees; on the inner race when the shaft's angle is zero.
    #[serde(default)]
    pub phase_deg: f64,
}

/// The table of a bearing, or a name in its place; designations such as 6204 are whole numbers for TOML.
pub(super) fn named_or_table(generator: &mut SchemaGenerator) -> Schema {
    any_of(&[text(), whole(), generator.subschema_for::<Bearing>()])
}

fn bearing_steel() -> String {
    "bearing steel".to_owned()
}

fn under_the_load() -> f64 {
    270.0
}

impl Bearing {
    /// Returns the radial play in m: the given one, else R - r - 2 rho_b from the radii.
    #[must_use]
    pub fn play(&self) -> f64 {
        let by_angle = |degrees: f64| {
            let between_centres = self.inner_groove_radius + self.outer_groove_radius - 2.0 * self.ball_radius;
            2.0 * between_centres * (0.5 * degrees.to_radians()).sin().powi(2)
        };
        let given = self.radial_play.or(self.contact_angle_deg.map(by_angle));
        given.unwrap_or_else(|| self.play_from_radii())
    }

    /// Which way along the axis the shaft may push the inner ring.
    pub(crate) fn thrust_or_default(&self) -> Thrust {
        let by_angle = if self.contact_angle_deg.is_some() { Thrust::Positive } else { Thrust::Both };
        self.thrust.unwrap_or(by_angle)
    }

    /// Returns the radial play that the radii give, R - r - 2 rho_b, in m.
    #[must_use]
    pub(crate) fn play_from_radii(&self) -> f64 {
        self.outer_race_radius - self.inner_race_radius - 2.0 * self.ball_radius
    }
}

/// Axial preload of a bearing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Preload {
    /// Constant axial force along `thrust` in N, as of a spring, > 0.
    Force(f64),
    /// Axial displacement along `thrust` in m at which the inner ring is held, > 0.
    Displacement(f64),
}

/// Axial preload: as a force, or as a displacement of the inner ring.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["force", "displacement"])))]
struct PreloadForm {
    /// Constant axial force along `thrust` in N, as of a spring, > 0.
    force: Option<f64>,
    /// Axial displacement along `thrust` in m at which the inner ring is held, > 0.
    displacement: Option<f64>,
}

read_as!(Preload, PreloadForm, |form| {
    let kinds = [form.force.map(Self::Force), form.displacement.map(Self::Displacement)];
    exactly_one(kinds, "exactly one of `force`, `displacement`")
});

/// The races' materials, by name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RaceMaterial {
    /// Of the inner race.
    pub inner: String,
    /// Of the outer race.
    pub outer: String,
}

impl Default for RaceMaterial {
    fn default() -> Self {
        Self { inner: bearing_steel(), outer: bearing_steel() }
    }
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct InnerAndOuter<T> {
    /// Of the inner race.
    inner: T,
    /// Of the outer race.
    outer: T,
}

written_as!(RaceMaterial, Loose<InnerAndOuter<String>>, or_table::<InnerAndOuter<String>>(vec![text()]), |form| {
    match form {
        Loose::Word(name) => Ok(Self { inner: name.clone(), outer: name }),
        Loose::Table(InnerAndOuter { inner, outer }) => Ok(Self { inner, outer }),
        other => Err(other.mismatch(&[], "a material's name, or { inner = NAME, outer = NAME }")),
    }
});

impl From<RaceMaterial> for Loose<InnerAndOuter<String>> {
    fn from(races: RaceMaterial) -> Self {
        let RaceMaterial { inner, outer } = races;
        if inner == outer { Self::Word(inner) } else { Self::Table(InnerAndOuter { inner, outer }) }
    }
}

/// Contact stiffness k of F = k delta^(3/2).
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ContactStiffness {
    /// From the geometry and the materials.
    #[default]
    Hertz,
    /// Given, in N/m^(3/2), each > 0.
    #[serde(untagged)]
    Given {
        /// Between ball and inner race.
        inner: f64,
        /// Between ball and outer race.
        outer: f64,
    },
}

read_as!(
    ContactStiffness,
    Loose<InnerAndOuter<f64>>,
    or_table::<InnerAndOuter<f64>>(vec![words(&["hertz"])]),
    |form| {
        match form {
            Loose::Word(word) if word == "hertz" => Ok(Self::Hertz),
            Loose::Table(InnerAndOuter { inner, outer }) => Ok(Self::Given { inner, outer }),
            other => Err(other.mismatch(&["hertz"], "\"hertz\", or { inner = NUMBER, outer = NUMBER }")),
        }
    }
);

/// Share of the cage's rolling speed that is lost, >= 0 and < 1; straight lines between points, constant beyond them.
#[derive(Debug, Clone, PartialEq)]
pub enum Slip {
    /// Always the same.
    Constant(f64),
    /// Time (s) and slip, at least one point, times increasing.
    OverTime(Vec<(f64, f64)>),
    /// Magnitude of the shaft's speed (Hz) and slip, at least one point, speeds not below 0 and increasing.
    OverSpeed(Vec<(f64, f64)>),
    /// The same with speeds in revolutions per minute.
    OverRpm(Vec<(f64, f64)>),
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
    /// Speed of the shaft in revolutions per minute, >= 0; in every point, or in none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rpm: Option<f64>,
    /// Share of the cage's rolling speed that is lost, >= 0 and < 1.
    slip: f64,
}

/// Every point over time, or every point over speed in the same unit.
fn one_axis() -> Value {
    let over = |key, others: [&str; 2]| {
        let other = others.map(|other| json!({ "required": [other] }));
        let point = json!({ "required": [key], "not": { "anyOf": other } });
        json!({ "properties": { "profile": { "items": point } } })
    };
    json!([over("time", ["hz", "rpm"]), over("hz", ["time", "rpm"]), over("rpm", ["time", "hz"])])
}

written_as!(Slip, Loose<SlipForm>, or_table::<SlipForm>(vec![number()]), |form| {
    let form = match form {
        Loose::Number(slip) => return Ok(Self::Constant(slip)),
        Loose::Whole(slip) => return Ok(Self::Constant(slip as f64)),
        Loose::Table(form) => form,
        other => {
            return Err(other.mismatch(&[], "a number, or { profile = [{ time, hz or rpm, slip }, ...] }"));
        }
    };
    let over = |key: fn(&SlipPoint) -> [Option<f64>; 3]| -> Option<Vec<(f64, f64)>> {
        let point = |point: &SlipPoint| match key(point) {
            [Some(place), None, None] => Some((place, point.slip)),
            _ => None,
        };
        form.profile.iter().map(point).collect()
    };
    let over_time = over(|point| [point.time, point.hz, point.rpm]).map(Self::OverTime);
    let over_speed = over(|point| [point.hz, point.time, point.rpm]).map(Self::OverSpeed);
    let over_rpm = over(|point| [point.rpm, point.time, point.hz]).map(Self::OverRpm);
    over_time.or(over_speed).or(over_rpm).ok_or_else(|| {
        mismatch(
            "points with none, several, or now the one and now the other",
            "`time` in every point, or `hz` in every point, or `rpm` in every point",
        )
    })
});

impl From<Slip> for Loose<SlipForm> {
    fn from(slip: Slip) -> Self {
        let none = |slip| SlipPoint { time: None, hz: None, rpm: None, slip };
        let profile = match slip {
            Slip::Constant(slip) => return Self::Number(slip),
            Slip::OverTime(points) => {
                points.into_iter().map(|(time, slip)| SlipPoint { time: Some(time), ..none(slip) }).collect()
            }
            Slip::OverSpeed(points) => {
                points.into_iter().map(|(hz, slip)| SlipPoint { hz: Some(hz), ..none(slip) }).collect()
            }
            Slip::OverRpm(points) => {
                points.into_iter().map(|(rpm, slip)| SlipPoint { rpm: Some(rpm), ..none(slip) }).collect()
            }
        };
        Self::Table(SlipForm { profile })
    }
}
