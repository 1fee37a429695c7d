//! The results of an earlier command: what another one reads, files that belong together and the case that they are of;
//! and what of them the same command may replace.

use std::path::{Path, PathBuf};

use serde_json::Value;
use std::collections::BTreeMap;
use std::{fs, io};

use super::{CliError, typed};
use crate::app::case::Case;
use crate::app::scene::mesh_digests;
use crate::app::shell_word::shell_word;
use crate::files::{self, FileDigest, FileError};
use crate::report::Report;

/// Where a result has the digests of the files beside it.
pub(super) const ARRAYS: &str = "arrays";
/// Where a result has the digest of its case, [`Case::digest`].
pub(super) const CASE_DIGEST: &str = "case_digest";

/// The results that commands write into a folder: of each the word W of W.json, what is there before it, and files beside its page,
/// tables and figures.
pub(super) const RESULTS: [(&str, &str, &[&str]); 11] = [
    ("run", PARTIAL, &["signals.npz", "scalogram.npz"]),
    ("modes", "", &["modes.npz"]),
    ("condense", "", &["superelement.npz"]),
    ("frf", "", &["frf.uff"]),
    ("bearing", "", &[]),
    ("chart", "chart.csv.partial", &["chart.svg", "stability.svg", "resonance.svg"]),
    ("stability", "", &["stability.svg", "resonance.svg"]),
    ("analysis", "", &["analysis.csv"]),
    ("sweep", "sweep/plan.json", &["sweep.csv", "sweep.npz"]),
    ("manifest", "dataset/plan.json", &["manifest.csv", "manifest.parquet"]),
    ("verify", "", &[]),
];

/// Folder of an unfinished run, in that of the results.
pub(super) const PARTIAL: &str = ".run.partial";

/// Folders of the tables and of the figures, in that of the results.
pub(super) const TABLES: &str = "tables";
pub(super) const FIGURES: &str = "figures";

/// Endings of a page and of its content.
const PAGE: &str = ".html";
const RECORD: &str = ".cbor.gz";

/// What to do about damaged results.
const AGAIN: &str = "compute the results again with --force";

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
/// [`CliError`] for a file that is gone.
pub(super) fn digests(files: &[PathBuf]) -> Result<BTreeMap<String, String>, CliError> {
    let of_file = |path: &PathBuf| {
        let digest = FileDigest::of_file(path).map_err(FileError::write(path))?;
        Ok((path.file_name().unwrap_or_default().to_string_lossy().into_owned(), digest.sha256))
    };
    files.iter().map(of_file).collect()
}

/// The case of the results in a folder, which are whole and belong together; `set` is applied after what they were computed with.
///
/// # Errors
/// [`CliError`]: results that are not there, damaged or of other values than the case has now; a case that is wrong.
pub(super) fn case_of_results(folder: &Path, wanted: Wanted, set: &[String]) -> Result<Case, CliError> {
    let Wanted { command, arrays, instead } = wanted;
    let path = folder.join(format!("{command}.json"));
    let beside = folder.join(arrays);
    if !path.is_file() || !beside.is_file() {
        return Err(CliError::input(format!(
            "{} has no {command}.json and {arrays}: expected a folder with results of `plummer {command}`, or {instead}",
            folder.display()
        ))
        .with_help(format!(
            "run `plummer {command} CASE.toml --out {}` first",
            shell_word(&folder.to_string_lossy())
        )));
    }
    let damaged = |expected: &str, found: String| {
        CliError::input(format!("{}: expected {expected}, found {found}", path.display())).with_help(AGAIN)
    };
    let result = files::read(&path).map_err(|error| error.to_string());
    let result = result.and_then(|text| serde_json::from_slice(&text).map_err(|e| e.to_string()));
    let result: Value = result.map_err(|found| damaged("a result of this command", found))?;
    let file = result["case"].as_str().map(PathBuf::from);
    let file = file.ok_or_else(|| damaged("the case file's name under \"case\"", result["case"].to_string()))?;
    let own: Vec<String> = match &result["set"] {
        Value::Null => Vec::new(),
        set => serde_json::from_value(set.clone())
            .map_err(|_| damaged("a list of texts under \"set\"", set.to_string()))?,
    };
    if !file.exists() {
        return Err(CliError::input(format!(
            "{} names the case file {}, which is not there",
            path.display(),
            file.display()
        ))
        .with_help("go to the folder in which the results were computed, or compute them again"));
    }
    let case = Case::load(&file, &own)?;
    let digest = result[CASE_DIGEST].as_str();
    if digest.is_some_and(|digest| case.digest(command).is_some_and(|now| now != digest)) {
        return Err(CliError::input(format!(
            "{} was computed with values that differ from those in {} now",
            path.display(),
            file.display()
        ))
        .with_help(
            "compute the results again with --force, or restore the values in the case file; [analysis], and tables that they do not depend on, may change",
        ));
    }
    if let Some(expected) = result[ARRAYS][arrays].as_str() {
        let found = FileDigest::of_file(&beside);
        let found = found.map_err(|error| damaged("a file that can be read", error.to_string()))?;
        if found.sha256 != expected {
            return Err(other_file(&path, &beside, expected, &found.sha256));
        }
    }
    if set.is_empty() {
        return Ok(case);
    }
    let all: Vec<String> = own.into_iter().chain(set.iter().cloned()).collect();
    let looked_at = Case::load(&file, &all)?;
    if looked_at.digest(command) != case.digest(command) {
        return Err(CliError::input(format!(
            "{} was computed with values that differ from those of --set",
            path.display()
        ))
        .with_help("--set can change only [analysis] of earlier results; compute new results with these values"));
    }
    Ok(looked_at)
}

/// A result of this command; null where the file holds none.
pub(super) fn result_of(command: &str, path: &Path) -> Value {
    let result = files::read(path).ok().and_then(|text| serde_json::from_slice(&text).ok());
    result.filter(|result: &Value| result["command"] == command).unwrap_or_default()
}

/// Name of a command's report in a folder: `report.html`, or `COMMAND-report.html` where another command had its results first.
pub(super) fn report_name(folder: &Path, command: &str) -> String {
    let own = format!("{command}-report.html");
    let has = |name: &str| folder.join(name).exists();
    if has(&format!("{command}.json")) && has("report.html") && !has(&own) {
        return "report.html".to_owned();
    }
    let others = |word: &str| word != command && (command, word) != ("chart", "stability");
    let shared = RESULTS.iter().any(|(word, ..)| others(word) && has(&format!("{word}.json")));
    if shared { own } else { "report.html".to_owned() }
}

/// The contents of reports in a folder, in order of their names, each with the name of its page.
pub(super) fn records(folder: &Path) -> Result<Vec<(PathBuf, String)>, CliError> {
    let failed = |source| unreadable(folder, source);
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if let Some(page) = page_of(&entry.file_name().to_string_lossy()) {
            found.push((entry.path(), page));
        }
    }
    if found.is_empty() {
        return Err(CliError::input(format!(
            "{} has no content of a report: expected report.cbor.gz or COMMAND-report.cbor.gz, as each command writes it beside its page",
            folder.display()
        ))
        .with_help("name the folder with the results of a command"));
    }
    found.sort();
    Ok(found)
}

/// The report that a file holds, and the command that it is of.
pub(super) fn read(path: &Path) -> Result<(String, Report), CliError> {
    let bytes = fs::read(path).map_err(|source| unreadable(path, source))?;
    let wrong = |what: &str| CliError::input(format!("{}: {what}", path.display())).with_help(AGAIN);
    let report = Report::from_record(&bytes).map_err(|error| wrong(&error.to_string()))?;
    // names of files are made of it: nothing is written beside the folder and its tables, whatever the content says
    let command = report.table_files.as_ref().map(|files| files.prefix.clone()).unwrap_or_default();
    match RESULTS.iter().any(|(word, ..)| *word == command) {
        true => {
            let report = report.tables_in(TABLES, &command);
            Ok((command, report))
        }
        false => {
            let words = RESULTS.map(|(word, ..)| word).join(", ");
            Err(wrong(&format!("a report of \"{command}\": expected one of {words}")))
        }
    }
}

/// A folder that was named, or a file in it, cannot be read.
pub(super) fn unreadable(path: &Path, source: io::Error) -> CliError {
    CliError::input(FileError::read(path)(source).to_string())
}

/// Name of the file with a page's content: `report.html` has `report.cbor.gz`.
pub(super) fn record_of(page: &str) -> String {
    format!("{}{RECORD}", page.strip_suffix(PAGE).unwrap_or(page))
}

/// Name of the page whose content a file has, if it is one.
pub(super) fn page_of(record: &str) -> Option<String> {
    let page = record.strip_suffix(RECORD)?;
    (page == "report" || page.ends_with("-report")).then(|| format!("{page}{PAGE}"))
}

/// Files in a folder that have names as the result W.json has them beside it.
pub(super) fn with_names_of(folder: &Path, word: &str) -> Vec<String> {
    let page = report_name(folder, word);
    let mut names = vec![record_of(&page), page];
    for (_, _, files) in RESULTS.iter().filter(|(other, ..)| *other == word) {
        names.extend(files.iter().map(|file| (*file).to_owned()));
    }
    for of in [TABLES, FIGURES] {
        let entries = fs::read_dir(folder.join(of)).into_iter().flatten().flatten();
        let entries = entries.filter_map(|entry| entry.file_name().into_string().ok());
        names.extend(entries.filter(|name| belongs(name, word)).map(|name| format!("{of}/{name}")));
    }
    names
}

/// Whether a table or figure has the name of one of the result W.json.
fn belongs(name: &str, word: &str) -> bool {
    name.strip_prefix(word).is_some_and(|rest| rest.starts_with('-'))
}

/// Refuses files in a folder that no result there speaks of: no W.json, no content of a report, and nothing that a command leaves
/// that did not come to its end.
///
/// # Errors
/// [`CliError`] that names them.
pub(super) fn refuse_foreign(folder: &Path, mut names: Vec<String>) -> Result<(), CliError> {
    /// Files that are listed.
    const LISTED: usize = 5;
    names.retain(|name| folder.join(name).symlink_metadata().is_ok());
    if names.is_empty() {
        return Ok(());
    }
    let (mut pages, mut words) = (Vec::new(), Vec::new());
    for (record, page) in records(folder).unwrap_or_default() {
        if let Ok((word, _)) = read(&record) {
            pages.extend([record_of(&page), page]);
            words.push(word);
        }
    }
    for (word, begun, _) in RESULTS {
        let result = files::read(&folder.join(format!("{word}.json"))).unwrap_or_default();
        let result: Value = serde_json::from_slice(&result).unwrap_or_default();
        let is_there = result["plummer"].is_string();
        pages.extend(is_there.then(|| report_name(folder, word)));
        let is_begun = !begun.is_empty() && folder.join(begun).exists();
        words.extend((is_there || is_begun).then(|| word.to_owned()));
    }
    let of_word = |name: &str, word: &str| {
        let of = RESULTS.iter().find(|(other, ..)| *other == word);
        let inside = name.split_once('/').filter(|(of, _)| [TABLES, FIGURES].contains(of));
        of.is_some_and(|(_, _, files)| files.contains(&name)) || inside.is_some_and(|(_, name)| belongs(name, word))
    };
    names.retain(|name| !pages.contains(name) && !words.iter().any(|word| of_word(name, word)));
    names.sort();
    let more = names.len().saturating_sub(LISTED);
    names.truncate(LISTED);
    names.extend((more > 0).then(|| format!("{more} more files")));
    if names.is_empty() {
        return Ok(());
    }
    let (at, names) = (folder.display(), names.join(", "));
    Err(CliError::input(format!("{at} has {names} by the names of results, which no result there speaks of"))
        .with_help("replace them with --force, or choose another folder with --out"))
}

/// What an interrupt leaves in a folder of the results of a command.
pub(super) fn left_in(folder: &Path, word: &str, force: bool) -> impl Fn() -> CliError + Send + use<> {
    let [result, so_far] = [format!("{word}.json"), format!("{word}.csv.partial")].map(|name| folder.join(name));
    let again = format!("begin again with: {}{}", typed(), if force { " --force" } else { "" });
    move || {
        let what = match (so_far.exists(), result.exists()) {
            (true, _) => format!("the points so far are in {}", so_far.display()),
            (_, true) => format!("{} is an earlier result", result.display()),
            _ => format!("there is no {} yet", result.display()),
        };
        CliError::failed(format!("interrupted; {what}")).with_help(&again)
    }
}

/// What a result of a command is of, behind "an earlier run"; `None`: of this case and of the meshes that are there now, so that
/// computing it again loses nothing. `[analysis]`, which says how signals are looked at, may differ.
pub(super) fn lost_with(result: &Value, case: &Case) -> Option<&'static str> {
    if result.is_null() {
        return Some("");
    }
    let digest = result["command"].as_str().and_then(|command| case.digest(command));
    if result[CASE_DIGEST].as_str() != digest.as_deref() {
        return Some(" of other values");
    }
    let then: Vec<FileDigest> = serde_json::from_value(result["meshes"].clone()).unwrap_or_default();
    let now = mesh_digests(case).unwrap_or_default();
    let same = then.iter().map(|mesh| &mesh.sha256).eq(now.iter().map(|mesh| &mesh.sha256));
    (!same).then_some(" of another mesh")
}

/// The error of a file that was replaced or damaged since a result speaks of it; `expected` and `found` are SHA-256.
pub(super) fn other_file(result: &Path, file: &Path, expected: &str, found: &str) -> CliError {
    let (file, result) = (file.display(), result.display());
    CliError::input(format!(
        "{file} is not the file that {result} speaks of: expected SHA-256 {expected}, found {found}"
    ))
    .with_help(AGAIN)
}

#[cfg(test)]
mod tests {
    use super::{page_of, record_of};

    #[test]
    fn a_page_and_its_content_know_each_other() {
        for page in ["report.html", "modes-report.html"] {
            assert_eq!(page_of(&record_of(page)).as_deref(), Some(page));
        }
        for other in ["report.html", "notes.cbor.gz", "reports.cbor.gz", ".cbor.gz"] {
            assert_eq!(page_of(other), None, "{other}");
        }
    }
}
