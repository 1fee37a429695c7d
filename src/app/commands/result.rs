//! What the results of all commands have in common; what each says by itself is in its folder, as `summary()` of what it computed.

use crate::files::FileDigest;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Version of the program, as results have it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What a result says of its computation.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct ResultHead {
    /// Version of the program.
    pub plummer: &'static str,
    /// The command.
    pub command: &'static str,
    /// Wall time, s.
    pub wall_s: f64,
    /// Wall time of each stage by its name, s.
    pub stages_s: BTreeMap<String, f64>,
    /// Number of threads.
    pub threads: usize,
    /// What was taken from the cache instead of computed, or could not be, a sentence each; absent where nothing was.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reused: Vec<String>,
    /// Files of the report's tables in the folder of the results; absent where the result has no report of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tables: Option<Vec<String>>,
}

/// The result of a case: `COMMAND.json`.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct CaseResult<'a, T> {
    /// What all results have.
    #[serde(flatten)]
    pub head: ResultHead,
    /// The case file.
    pub case: &'a Path,
    /// `KEY=VALUE` arguments, in order.
    pub set: &'a [String],
    /// SHA-256 of the case with these arguments, 64 hexadecimal digits.
    pub case_digest: Option<String>,
    /// Meshes and superelements that the case rests on.
    pub meshes: &'a [FileDigest],
    /// SHA-256 of the files with arrays beside the result, by their names; absent where it has none.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub arrays: BTreeMap<String, String>,
    /// What the command found.
    #[serde(flatten)]
    pub result: T,
}
