//! The results of an earlier command that another one reads: files that belong together, and the case that they are of.

use std::path::{Path, PathBuf};

use serde_json::Value;
use std::collections::BTreeMap;

use super::{CliError, ResultsError};
use crate::app::case::Case;
use crate::files::{self, FileDigest, FileError};

/// Where a result has the digests of the files beside it.
pub(super) const ARRAYS: &str = "arrays";
/// Where a result has the digest of its case, [`Source::digest`](crate::app::case::Source::digest).
pub(super) const CASE_DIGEST: &str = "case_digest";

/// What is read of the results of a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Wanted {
    /// The command; `COMMAND.json` is its result.
    pub(super) command: &'static str,
    /// The file with its arrays.
    pub(super) arrays: &'static str,
    /// What could have been named instead of a folder.
    pub(super) instead: &'static str,
}

/// SHA-256 of files by their names, for the result that speaks of them.
///
/// # Errors
/// [`CliError::File`] for a file that is gone.
pub(super) fn digests(files: &[PathBuf]) -> Result<BTreeMap<String, String>, CliError> {
    let mut digests = BTreeMap::new();
    for path in files {
        let digest = FileDigest::of_file(path).map_err(FileError::write(path))?;
        let name = path.file_name().unwrap_or_default();
        digests.insert(name.to_string_lossy().into_owned(), digest.sha256);
    }
    Ok(digests)
}

/// The case of the results in a folder, which are whole and belong together; `set` is applied after what they were computed with.
///
/// # Errors
/// [`CliError::Results`], [`CliError::Case`].
pub(super) fn case_of_results(folder: &Path, wanted: Wanted, set: &[String]) -> Result<Case, CliError> {
    let Wanted { command, arrays, instead } = wanted;
    let path = folder.join(format!("{command}.json"));
    let beside = folder.join(arrays);
    if !path.is_file() || !beside.is_file() {
        return Err(ResultsError::Missing { folder: folder.to_owned(), command, arrays, instead }.into());
    }
    let damaged = |expected, found: String| ResultsError::Damaged { path: path.clone(), expected, found };
    let result = files::read(&path).map_err(|error| error.to_string());
    let result = result.and_then(|text| serde_json::from_slice(&text).map_err(|e| e.to_string()));
    let result: Value = result.map_err(|found| damaged("a result of this command", found))?;
    let Some(file) = result["case"].as_str().map(PathBuf::from) else {
        let found = result["case"].to_string();
        return Err(damaged("the case file's name under \"case\"", found).into());
    };
    let own: Vec<String> = match &result["set"] {
        Value::Null => Vec::new(),
        set => serde_json::from_value(set.clone())
            .map_err(|_| damaged("a list of texts under \"set\"", set.to_string()))?,
    };
    if !file.exists() {
        return Err(ResultsError::CaseGone { path, case: file }.into());
    }
    let case = Case::load(&file, &own)?;
    let digest = result[CASE_DIGEST].as_str();
    if digest.is_some_and(|digest| case.source.digest().is_ok_and(|now| now != digest)) {
        return Err(ResultsError::CaseChanged { path, case: file }.into());
    }
    if let Some(expected) = result[ARRAYS][arrays].as_str() {
        let found = FileDigest::of_file(&beside);
        let found = found.map_err(|error| damaged("a file that can be read", error.to_string()))?;
        if found.sha256 != expected {
            return Err(ResultsError::OtherFile {
                path,
                arrays: beside,
                expected: expected.to_owned(),
                found: found.sha256,
            }
            .into());
        }
    }
    if set.is_empty() {
        return Ok(case);
    }
    let all: Vec<String> = own.into_iter().chain(set.iter().cloned()).collect();
    let looked_at = Case::load(&file, &all)?;
    if looked_at.source.digest().ok() != case.source.digest().ok() {
        return Err(ResultsError::SetChanges { path }.into());
    }
    Ok(looked_at)
}
