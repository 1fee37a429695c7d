//! `[modes]`: which eigenfrequencies, and what they are checked against.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::schema::together;
use super::union::{mismatch, read_as};
use crate::fe::modal::ModeRange;
use crate::numerics::units::LengthUnit;

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

#[derive(Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
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
    expected: Vec<Expected>,
    /// Whether the bearing's contacts act.
    linearise: Linearise,
    /// The same case with other keys set, shown beside; may be empty.
    variants: Vec<Variant>,
    /// Modes from elsewhere that these are compared with; may be empty.
    compare: Vec<ComparedModes>,
    /// Other meshes of the housing that tell the discretisation's error.
    convergence: Option<ConvergenceMeshes>,
    /// Whether loaded modes are followed over a ball pass and over the load; with `linearise = "static"`.
    ball_pass: bool,
}

read_as!(Modes, ModesForm, |form| {
    let extent = match (form.count, form.up_to_hz, form.band_hz) {
        // the default, written down, is the default
        (Some(DEFAULT_COUNT), None, None) => ModeRange::AtMost(DEFAULT_COUNT),
        (Some(count), None, None) => ModeRange::Count(count),
        (None, Some(limit), None) => ModeRange::UpToHz(limit),
        (None, None, Some(band)) => ModeRange::BandHz(band),
        (None, None, None) => Self::default().extent,
        _ => {
            let expected = "one of `count`, `up_to_hz`, `band_hz`";
            return Err(mismatch("several", expected));
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
});

/// Modes of another program, or measured ones, that this case must have too.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ComparedModes {
    /// File of mode shapes (`.npz`, `.csv`, `.uff`, `.unv`, `.frd`). Relative paths in a case file are relative to that file; here
    /// they are resolved.
    pub file: PathBuf,
    /// Where they come from; empty: the file's name says it.
    #[serde(default)]
    pub what: String,
    /// Smallest MAC that passes, > 0 and <= 1; of repeated modes the squared cosine of the largest angle between the
    /// spaces that they span.
    #[serde(default = "default_mac")]
    pub mac: f64,
    /// Largest relative difference of frequencies that passes, > 0 and < 1.
    #[serde(default = "default_within")]
    pub within: f64,
    /// Distance in m up to which a point of the file is a node of this model, > 0; `None`: a thousandth of the model's size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points_within: Option<f64>,
    /// Unit of length of the coordinates in a `.frd` file, which does not say it; `None`: that of the housing's mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length_unit: Option<LengthUnit>,
}

fn default_mac() -> f64 {
    // two computations of one structure; measured shapes reach less
    0.95
}

fn default_within() -> f64 {
    0.01
}

impl ComparedModes {
    /// What the reader is told that these modes are: `what`, or else the file's name.
    pub fn name(&self) -> String {
        if self.what.is_empty() {
            let name = self.file.file_name().unwrap_or(self.file.as_os_str());
            name.to_string_lossy().into_owned()
        } else {
            self.what.clone()
        }
    }
}

/// Meshes of other element sizes that tell how far this case's mesh is from an infinitely fine one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConvergenceMeshes {
    /// The other meshes, coarser or finer, in any order, with the groups of the case's own; at least one. Relative paths in
    /// a case file are relative to that file; here they are resolved.
    pub meshes: Vec<PathBuf>,
    /// Order p of the frequencies' error `c h^p`, > 0; `None`: 2 for linear elements, 4 for quadratic ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub order: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::super::tests::{FULL, read};

    #[test]
    fn limits_have_defaults_and_a_file_its_name() {
        let modes = read(FULL, &["modes.compare=[{file='a/bench.uff'}]"]).expect("a case").modes;
        let compare = &modes.compare[0];
        assert_eq!((compare.name().as_str(), compare.points_within), ("bench.uff", None));
        // as the documentation says
        assert!((compare.mac - 0.95).abs() < 1e-15 && (compare.within - 0.01).abs() < 1e-15);
        let modes = read(FULL, &["modes.convergence={meshes=['a.msh']}"]);
        let convergence = modes.expect("a case").modes.convergence;
        assert!(convergence.is_some_and(|convergence| convergence.order.is_none()));
    }

    #[test]
    fn misspelt_keys_are_named() {
        for (argument, key, nearest) in [
            ("modes.compare=[{fle='a.csv'}]", "modes.compare[0].fle", "file"),
            ("modes.compare[0].withn=0.1", "modes.compare[0].withn", "within"),
            ("modes.convergence.mehses=[]", "modes.convergence.mehses", "meshes"),
            ("modes.convergance={}", "modes.convergance", "convergence"),
        ] {
            let error = read(FULL, &[argument]).expect_err(argument);
            let expected = format!("--set {argument}: unknown key `{key}`");
            assert_eq!(error.to_string(), expected);
            let help = error.help().expect("help");
            assert!(help.starts_with(&format!("did you mean `{nearest}`?")), "{help}");
        }
        let error = read(FULL, &["modes.compare=[{what='a'}]"]).expect_err("no file");
        assert_eq!(
            error.to_string(),
            "--set modes.compare=[{what='a'}]: `modes.compare[0]` lacks the required key `file`"
        );
    }
}
