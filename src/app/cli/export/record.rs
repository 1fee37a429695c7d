//! `export.json`: which files an export wrote. Exports to other formats in the same folder stay listed under `earlier`.

use std::fs;
use std::path::Path;

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::CliError;
use crate::app::cli::OutputFolder;
use crate::files::FileError;

/// A file of an export.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(super) struct WrittenFile {
    /// Name in the folder.
    pub(super) file: String,
    /// Size.
    pub(super) bytes: u64,
    /// What it holds.
    pub(super) what: String,
}

impl WrittenFile {
    /// A file that was written into a folder.
    ///
    /// # Errors
    /// [`CliError::File`] if it is not there.
    pub(super) fn new(folder: &Path, name: &str, what: &str) -> Result<Self, CliError> {
        let path = folder.join(name);
        let found = fs::metadata(&path).map_err(FileError::write(&path))?;
        Ok(Self {
            file: name.to_owned(),
            bytes: found.len(),
            what: what.to_owned(),
        })
    }
}

/// The content of `export.json`: the given fields, the files, and what an earlier `export.json` says of other formats.
/// An earlier file that is no result of an export is left out.
pub(super) fn record(
    mut fields: Map<String, Value>,
    files: &[WrittenFile],
    folder: &OutputFolder,
) -> Value {
    let earlier = earlier(folder.path(), fields.get("to"));
    fields.insert("files".to_owned(), json!(files));
    fields.insert("earlier".to_owned(), Value::Array(earlier));
    Value::Object(fields)
}

/// Exports to other formats that a folder's `export.json` speaks of.
fn earlier(folder: &Path, to: Option<&Value>) -> Vec<Value> {
    let text = fs::read_to_string(folder.join("export.json")).unwrap_or_default();
    let Ok(Value::Object(mut last)) = serde_json::from_str(&text) else {
        return Vec::new();
    };
    let mut all = match last.remove("earlier") {
        Some(Value::Array(earlier)) => earlier,
        _ => Vec::new(),
    };
    all.push(Value::Object(last));
    all.retain(|export| export.get("to").is_some() && export.get("to") != to);
    all
}
