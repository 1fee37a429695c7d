//! `[modes]`: which eigenfrequencies.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::mode_checks::{ComparedModes, ConvergenceMeshes};
use super::schema::together;
use super::union::{Mismatch, read_as};
use crate::fe::modal::ModeRange;

/// What the `modes` command computes and checks.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Modes {
    /// How many modes.
    #[serde(flatten)]
    pub extent: ModeRange,
    /// Frequencies to be found among them; may be empty.
    pub expected: Vec<Expected>,
    /// Whether the bearing's contacts act.
    pub linearise: Linearise,
    /// The same case with other keys set, shown beside; may be empty.
    pub variants: Vec<Variant>,
    /// Modes from elsewhere that these are compared with; may be empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub compare: Vec<ComparedModes>,
    /// Other meshes of the housing that tell the discretisation's error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub convergence: Option<ConvergenceMeshes>,
    /// Whether loaded modes are followed over a ball pass and over the load.
    pub ball_pass: bool,
}

/// Modes computed where the case says nothing, or all of a model that has fewer.
const DEFAULT_COUNT: usize = 20;

impl Default for Modes {
    fn default() -> Self {
        Self {
            extent: ModeRange::AtMost(DEFAULT_COUNT),
            expected: Vec::new(),
            linearise: Linearise::None,
            variants: Vec::new(),
            compare: Vec::new(),
            convergence: None,
            ball_pass: false,
        }
    }
}

/// A frequency that must be found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// In Hz, > 0.
    pub hz: f64,
    /// Allowed relative difference, > 0 and < 1.
    pub within: f64,
    /// What moves.
    #[serde(default)]
    pub what: String,
}

/// Whether the bearing's contacts act on the modes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Linearise {
    /// Housing and ring alone.
    #[default]
    None,
    /// Shaft, balls and contacts at the static equilibrium included.
    Static,
}

/// The same case with some keys set to other values.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// What differs, in words.
    pub what: String,
    /// `KEY=VALUE`, as for the command line's `--set`; at least one.
    pub set: Vec<String>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("not" = json!({ "anyOf": [
    together(&["count", "up_to_hz"]),
    together(&["count", "band_hz"]),
    together(&["up_to_hz", "band_hz"]),
] })))]
/// What `plummer modes` computes and checks: `count` modes (20 unless given), those below `up_to_hz` or those in `band_hz`.
struct ModesForm {
    /// The lowest so many, at least 1; 20 unless given.
    count: Option<usize>,
    /// All below this frequency in Hz, > 0.
    up_to_hz: Option<f64>,
    /// All between two frequencies in Hz, 0 <= low < high.
    band_hz: Option<[f64; 2]>,
    /// Frequencies to be found among them; may be empty.
    #[serde(default)]
    expected: Vec<Expected>,
    /// Whether the bearing's contacts act.
    #[serde(default)]
    linearise: Linearise,
    /// The same case with other keys set, shown beside; may be empty.
    #[serde(default)]
    variants: Vec<Variant>,
    /// Modes from elsewhere that these are compared with; may be empty.
    #[serde(default)]
    compare: Vec<ComparedModes>,
    /// Other meshes of the housing that tell the discretisation's error.
    convergence: Option<ConvergenceMeshes>,
    /// Whether loaded modes are followed over a ball pass and over the load; with `linearise = "static"`.
    #[serde(default)]
    ball_pass: bool,
}

read_as!(Modes, ModesForm);

impl TryFrom<ModesForm> for Modes {
    type Error = Mismatch;

    fn try_from(form: ModesForm) -> Result<Self, Mismatch> {
        let extent = match (form.count, form.up_to_hz, form.band_hz) {
            // the default, written down, is the default
            (Some(DEFAULT_COUNT), None, None) => ModeRange::AtMost(DEFAULT_COUNT),
            (Some(count), None, None) => ModeRange::Count(count),
            (None, Some(limit), None) => ModeRange::UpToHz(limit),
            (None, None, Some(band)) => ModeRange::BandHz(band),
            (None, None, None) => Self::default().extent,
            _ => {
                let expected = "one of `count`, `up_to_hz`, `band_hz`";
                return Err(Mismatch::form("several", expected));
            }
        };
        Ok(Self {
            extent,
            expected: form.expected,
            linearise: form.linearise,
            variants: form.variants,
            compare: form.compare,
            convergence: form.convergence,
            ball_pass: form.ball_pass,
        })
    }
}
