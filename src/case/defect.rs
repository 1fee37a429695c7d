//! `[[bearing.defects]]`: localised damage of a race.

use serde::{Deserialize, Serialize};

/// A dent in a race. Lengths in m, all > 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Defect {
    /// What carries it.
    pub on: DefectPlace,
    /// Angle of its middle in degrees, counted like the ring's.
    pub angle_deg: f64,
    /// Extent along the rolling direction, below the race's circumference.
    pub length: f64,
    /// Extent across the rolling direction.
    pub width: f64,
    /// Greatest depth below the undeformed race, below the ball's radius.
    pub depth: f64,
    /// Which of its dimensions a ball feels.
    #[serde(default)]
    pub profile: DefectProfile,
    /// Radius by which the edge is rounded, below half the length.
    #[serde(default = "default_rim_radius")]
    pub rim_radius: f64,
    /// Curvature of the contact at its bottom.
    #[serde(default)]
    pub curvature: DefectCurvature,
}

fn default_rim_radius() -> f64 {
    // A choice of this program: the source paper's ellipse meets the race with a vertical wall.
    0.05e-3
}

/// What carries a defect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DefectPlace {
    /// The outer race: fixed in space.
    Outer,
}

/// Which dimensions of a dent a ball feels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DefectProfile {
    /// Length and depth; the groove's radius stays the race's (the source paper's).
    #[default]
    InPlane,
}

/// Curvature of the contact at a dent's bottom.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DefectCurvature {
    /// That of the race and that of the dent's profile together.
    #[default]
    Profile,
    /// That of the dent alone, as the source paper prints it.
    Paper,
}
