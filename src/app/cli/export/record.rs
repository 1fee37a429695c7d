//! `export.json`: which files an export wrote. Exports to other formats in the same folder stay listed under `earlier`.

use std::fs;
use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

use super::CliError;
use crate::files::FileError;
/// What `export.json` says.
#[derive(Debug, Serialize, JsonSchema)]
pub(in crate::app::cli) struct ExportSummary<'a> {
    /// The format.
    pub(super) to: String,
    /// Folder of the results that were exported; `None` for a case.
    pub(super) results: Option<&'a Path>,
    /// What of the model may be meant otherwise, a sentence each.
    pub(super) warnings: &'a [String],
    /// The files.
    pub(super) files: Vec<WrittenFile>,
    /// What an earlier `export.json` says of other formats, without its own `earlier`.
    pub(super) earlier: Vec<Value>,
}

/// A file of an export.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub(in crate::app::cli) struct WrittenFile {
    /// Name in the folder.
    pub(super) file: String,
    /// Size, bytes.
    pub(super) bytes: u64,
    /// What it holds.
    pub(super) what: String,
}

impl WrittenFile {
    /// A file that was written into a folder.
    ///
    /// # Errors
    /// [`CliError`] if it is not there.
    pub(super) fn new(folder: &Path, name: &str, what: String) -> Result<Self, CliError> {
        let path = folder.join(name);
        let found = fs::metadata(&path).map_err(FileError::write(&path))?;
        Ok(Self { file: name.to_owned(), bytes: found.len(), what })
    }
}

/// Exports to other formats that a folder's `export.json` speaks of.
/// An earlier file that is no result of an export is left out.
pub(super) fn earlier(folder: &Path, to: &str) -> Vec<Value> {
    let text = fs::read_to_string(folder.join("export.json")).unwrap_or_default();
    let Ok(Value::Object(mut last)) = serde_json::from_str(&text) else {
        return Vec::new();
    };
    let mut all = match last.remove("earlier") {
        Some(Value::Array(earlier)) => earlier,
        _ => Vec::new(),
    };
    all.push(Value::Object(last));
    all.retain(|export| export.get("to").is_some_and(|other| *other != *to));
    all
}
