//! `[[bearing.defects]]`: localised damage of a race or a ball.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::schema::{one_of, or_table, words};
use super::union::{Loose, given, mismatch, missing, none_beside, read_as};
use crate::bearing::Race;
use crate::bearing::defect::CurvatureReading;

/// Damage in the plane of the bearing. Lengths in m.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Defect {
    /// Elliptic dent in a race.
    Dent(DentDefect),
    /// Measured profile of a race.
    Measured(MeasuredDefect),
    /// Flat on a ball.
    Flat(FlatDefect),
}

/// Elliptic dent in a race; lengths > 0.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DentDefect {
    /// The race that carries it.
    pub on: Race,
    /// Angle of its middle in degrees, counted like the ring's; on the inner race when the shaft's angle is zero.
    pub angle_deg: f64,
    /// Extent along the rolling direction, below the race's circumference.
    pub length: f64,
    /// Extent across the rolling direction; not felt in the plane, and there with [`DentProfile::Surface`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Place of its middle across the groove: arc from the groove's bottom, towards +z; with `width`. `None`: under the balls, whatever
    /// their contact angle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub across: Option<f64>,
    /// Greatest depth below the undeformed race, below half the ball's radius.
    pub depth: f64,
    /// What of the dent is felt.
    pub profile: DentProfile,
    /// Radius by which the edge is rounded, below half the length.
    pub rim_radius: f64,
    /// Curvature of the contact at its bottom.
    pub curvature: CurvatureReading,
}

/// Measured profile of a race.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredDefect {
    /// The race that carries it.
    pub on: Race,
    /// Angle of its middle in degrees, counted like a dent's.
    pub angle_deg: f64,
    /// The file of its shape.
    pub profile: ProfileFile,
}

/// Flat on a ball; lengths > 0.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "on", rename = "ball")]
pub struct FlatDefect {
    /// The ball, from 0.
    pub ball: usize,
    /// Angle of its middle from the ball's outward radius vector in degrees, when the shaft's angle is zero.
    pub angle_deg: f64,
    /// Radius of the flat in the rolling direction, above the ball's.
    pub flat_radius: f64,
    /// Depth at its middle, below the ball's radius.
    pub depth: f64,
    /// Radius by which its ends are rounded.
    pub rim_radius: f64,
    /// Curvature of the contact on it.
    pub curvature: CurvatureReading,
}

/// What of a dent's shape a ball feels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DentProfile {
    /// Its section in the plane of the bearing, as if it were as wide as the groove.
    #[default]
    InPlane,
    /// The depression in three dimensions, over which the ball may bridge.
    Surface,
}

impl Defect {
    /// The file that it names.
    pub(super) fn path_mut(&mut self) -> Option<&mut PathBuf> {
        match self {
            Self::Measured(measured) => Some(&mut measured.profile.csv),
            Self::Dent(_) | Self::Flat(_) => None,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum Place {
    /// The inner race: turns with the shaft.
    Inner,
    /// The outer race: fixed in space.
    Outer,
    /// A ball.
    Ball,
}

/// The file of a measured profile.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProfileFile {
    /// Table of arc length and depth, with the header `arc_length_m,depth_m`.
    pub csv: PathBuf,
}

/// `"in-plane"`, `"surface"`, or a file.
#[derive(Clone, PartialEq)]
enum Profile {
    Dent(DentProfile),
    File(ProfileFile),
}

const IN_PLANE: &str = "in-plane";
const SURFACE: &str = "surface";

read_as!(Profile, Loose<ProfileFile>, or_table::<ProfileFile>(vec![words(&[IN_PLANE, SURFACE])]), |form| match form {
    Loose::Word(word) if word == IN_PLANE => Ok(Self::Dent(DentProfile::InPlane)),
    Loose::Word(word) if word == SURFACE => Ok(Self::Dent(DentProfile::Surface)),
    Loose::Table(file) => Ok(Self::File(file)),
    other => Err(other.mismatch(&[IN_PLANE, SURFACE], "\"in-plane\", \"surface\", or { csv = \"FILE\" }")),
});

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = kinds()))]
/// Damage: a dent in a race, a measured profile of a race, or a flat on a ball. Lengths in m.
struct DefectForm {
    /// What carries it.
    on: Place,
    /// Angle of its middle in degrees, counted like the ring's; on the inner race when the shaft's angle is zero; of a flat from
    /// the ball's outward radius vector, 0 unless given.
    angle_deg: Option<f64>,
    /// Of a dent: extent along the rolling direction, > 0.
    length: Option<f64>,
    /// Of a dent: extent across the rolling direction, > 0; needed by `profile = "surface"`.
    width: Option<f64>,
    /// Of a dent: place of its middle across the groove, an arc from the groove's bottom towards +z; needs `width`. Absent: under the
    /// balls, whatever their contact angle.
    across: Option<f64>,
    /// Greatest depth, > 0; of a dent below half the ball's radius, of a flat below the radius.
    depth: Option<f64>,
    /// What of a dent is felt, or the file of a measured profile.
    profile: Option<Profile>,
    /// Radius by which the edge is rounded; 0.05e-3 unless given.
    rim_radius: Option<f64>,
    /// Curvature of the contact on it.
    curvature: Option<CurvatureReading>,
    /// Of a flat: the ball, from 0.
    ball: Option<usize>,
    /// Of a flat: its radius in the rolling direction, above the ball's.
    flat_radius: Option<f64>,
}

/// Dent, measured profile or flat, each with its keys.
fn kinds() -> Value {
    let race = json!({ "enum": ["inner", "outer"] });
    let dent = json!({ "enum": [IN_PLANE, SURFACE] });
    let none_of = |keys: &[&str]| json!({ "anyOf": one_of(keys) });
    json!([
        {
            "properties": { "on": race, "profile": dent },
            "required": ["angle_deg", "length", "depth"],
            "not": none_of(&["ball", "flat_radius"]),
            "anyOf": [{ "properties": { "profile": { "enum": [IN_PLANE] } } }, { "required": ["width"] }],
            "dependencies": { "across": ["width"] },
        },
        {
            "properties": { "on": race, "profile": { "type": "object" } },
            "required": ["angle_deg", "profile"],
            "not": none_of(&["ball", "flat_radius", "length", "width", "across", "depth", "rim_radius", "curvature"]),
        },
        {
            "properties": { "on": { "enum": ["ball"] }, "profile": { "enum": [IN_PLANE] } },
            "required": ["ball", "flat_radius", "depth"],
            "not": none_of(&["length", "width", "across"]),
        },
    ])
}

/// A choice of this program: the source paper's dents and flats end at an edge.
const RIM_RADIUS: f64 = 0.05e-3;

read_as!(Defect, DefectForm, |form| {
    let on = match form.on {
        Place::Inner => Race::Inner,
        Place::Outer => Race::Outer,
        Place::Ball => return flat(form).map(Self::Flat),
    };
    const RACE: &str = "keys of a race's defect";
    let of_flat = given!(form: ball, flat_radius);
    none_beside(&of_flat, "a race", RACE)?;
    let angle_deg = form.angle_deg.ok_or_else(|| missing("angle_deg"))?;
    let profile = match &form.profile {
        None => DentProfile::default(),
        Some(Profile::Dent(profile)) => *profile,
        Some(Profile::File(file)) => {
            let of_dent = given!(form: length, width, across, depth, rim_radius, curvature);
            none_beside(&of_dent, "a file", "the profile in the file alone")?;
            return Ok(Self::Measured(MeasuredDefect { on, angle_deg, profile: file.clone() }));
        }
    };
    const WIDTH: &str = "the dent's extent across the race as `width`, or profile = \"in-plane\"";
    if profile == DentProfile::Surface && form.width.is_none() {
        return Err(mismatch("profile = \"surface\" without `width`", WIDTH));
    }
    if form.across.is_some() && form.width.is_none() {
        return Err(mismatch("`across` without `width`", "the dent's extent across the race as `width`"));
    }
    Ok(Self::Dent(DentDefect {
        on,
        angle_deg,
        length: form.length.ok_or_else(|| missing("length"))?,
        width: form.width,
        across: form.across,
        depth: form.depth.ok_or_else(|| missing("depth"))?,
        profile,
        rim_radius: form.rim_radius.unwrap_or(RIM_RADIUS),
        curvature: form.curvature.unwrap_or_default(),
    }))
});

fn flat<E: Error>(form: DefectForm) -> Result<FlatDefect, E> {
    const BALL: &str = "keys of a ball's flat";
    none_beside(&given!(form: length, width, across), "a ball", BALL)?;
    match form.profile {
        Some(Profile::File(_)) => {
            return Err(mismatch("a measured `profile` beside a ball", BALL));
        }
        Some(Profile::Dent(DentProfile::Surface)) => {
            return Err(mismatch("profile = \"surface\" beside a ball", BALL));
        }
        Some(Profile::Dent(DentProfile::InPlane)) | None => {}
    }
    Ok(FlatDefect {
        ball: form.ball.ok_or_else(|| E::missing_field("ball"))?,
        angle_deg: form.angle_deg.unwrap_or(0.0),
        flat_radius: form.flat_radius.ok_or_else(|| E::missing_field("flat_radius"))?,
        depth: form.depth.ok_or_else(|| E::missing_field("depth"))?,
        rim_radius: form.rim_radius.unwrap_or(RIM_RADIUS),
        curvature: form.curvature.unwrap_or_default(),
    })
}
