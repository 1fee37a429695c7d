//! `plummer report`: the pages of earlier results, drawn again from their content.

use std::fs;
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::Serialize;

use super::output::json;
use super::report_files::{ReportFiles, page_of};
use super::results_error::{ResultsError, WITH_REPORT};
use super::{CliError, Options, Outcome, OutputFolder, Verdict};
use crate::app::commands::result::VERSION;
use crate::files::FileError;
use crate::report::Report;

/// The pages that were drawn.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ReportResult {
    /// Version of the program.
    plummer: &'static str,
    /// "report".
    command: &'static str,
    /// The pages, by name.
    reports: Vec<PageSummary>,
}

/// A page.
#[derive(Debug, Serialize, JsonSchema)]
struct PageSummary {
    /// The file.
    page: PathBuf,
    /// The command that it is of.
    command: String,
    /// Version of the program that computed what it shows.
    computed_by: String,
    /// Files of its tables in the folder of the results.
    tables: Vec<String>,
}

/// Draws every report in a folder again, page, tables and figures, there or in `--out`. Nothing is computed; the results stay.
///
/// # Errors
/// [`CliError`] when the folder has no content of a report, one is damaged, or a file cannot be written.
pub(crate) fn report(from: &Path, options: &Options) -> Result<Outcome, CliError> {
    let folder = OutputFolder::at(options.out.as_deref().unwrap_or(from));
    let mut reports = Vec::new();
    for (path, page) in records(from)? {
        let (command, report) = read(&path)?;
        reports.push((page, command, report));
    }
    folder.claim_files(&[], true)?;
    let (mut written, mut summary, mut pages) = (Vec::new(), Vec::new(), Vec::new());
    for (page, command, report) in reports {
        let files = ReportFiles::draw(&folder, &page, &command, &report)?;
        let version = &report.version;
        summary.push(format!("{command}: {}, computed by {version}", report.title));
        pages.push(PageSummary {
            page: folder.path().join(&page),
            command,
            computed_by: version.clone(),
            tables: files.tables,
        });
        written.extend(files.paths);
    }
    // two reports share the folders of tables and figures
    let mut seen = Vec::new();
    written.retain(|path: &PathBuf| {
        let new = !seen.contains(path);
        seen.push(path.clone());
        new
    });
    Ok(Outcome {
        summary: summary.join("\n"),
        result: json(&ReportResult { plummer: VERSION, command: "report", reports: pages })?,
        written,
        verdict: Verdict::Good,
    })
}

/// The contents of reports in a folder, in order of their names, each with the name of its page.
fn records(folder: &Path) -> Result<Vec<(PathBuf, String)>, ResultsError> {
    let failed = |source| FileError::read(folder)(source);
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if let Some(page) = page_of(&entry.file_name().to_string_lossy()) {
            found.push((entry.path(), page));
        }
    }
    if found.is_empty() {
        return Err(ResultsError::NoReport { folder: folder.to_owned() });
    }
    found.sort();
    Ok(found)
}

/// The report that a file holds, and the command that it is of.
fn read(path: &Path) -> Result<(String, Report), ResultsError> {
    let bytes = fs::read(path).map_err(FileError::read(path))?;
    let report =
        Report::from_record(&bytes).map_err(|source| ResultsError::BrokenReport { path: path.to_owned(), source })?;
    // names of files are made of it: nothing is written beside the folder
    let command = report.table_files.as_ref().map(|files| &files.prefix);
    match command.filter(|command| WITH_REPORT.contains(&command.as_str())) {
        Some(command) => Ok((command.clone(), report)),
        None => Err(ResultsError::OtherReport { path: path.to_owned(), command: command.cloned().unwrap_or_default() }),
    }
}
