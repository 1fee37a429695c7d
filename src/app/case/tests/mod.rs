//! Reading a case.

mod refusals;
mod relations;
mod values;

use std::path::PathBuf;

use super::{Case, CaseError, Source};

/// A case with every table and every form of value.
pub(super) const FULL: &str = include_str!("../full.toml");

pub(super) fn read(text: &str, set: &[&str]) -> Result<Case, CaseError> {
    Case::from_source(Source {
        path: PathBuf::from("folder/case.toml"),
        text: text.to_owned(),
        set: set.iter().map(|&argument| argument.to_owned()).collect(),
    })
}

/// Message and help of the error that `FULL` gives with these keys set.
pub(super) fn refusal(set: &[&str]) -> (String, Option<String>) {
    let error = read(FULL, set).unwrap_err();
    (error.to_string(), error.help())
}

pub(super) fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

impl Case {
    /// The case of that name under `examples`, with these keys set.
    pub(crate) fn example(name: &str, set: &[&str]) -> Self {
        let path = format!("{}/examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let set: Vec<String> = set.iter().map(|&key| key.to_owned()).collect();
        Self::load(path, &set).unwrap()
    }
}
