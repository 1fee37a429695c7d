//! `[[modes.compare]]` and `[modes.convergence]`: what the computed modes are checked against.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Modes of another program, or measured ones, that this case must have too.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ComparedModes {
    /// File of mode shapes (`.npz`, `.csv`, `.uff`, `.unv`). Relative paths in a case file are relative to that file; here
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
