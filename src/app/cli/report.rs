//! `plummer report`: the pages of earlier results, drawn again from their content.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::Serialize;

use super::output::{extend_new, json};
use super::report_files::{ReportFiles, page_of};
use super::{CliError, Options, Outcome, OutputFolder};
use crate::app::commands::result::VERSION;
use crate::files::FileError;
use crate::report::Report;

/// The commands that write reports, by the names of their results.
const WITH_REPORT: [&str; 9] = ["run", "modes", "condense", "frf", "chart", "stability", "analysis", "sweep", "verify"];
/// What to do about a damaged report.
const AGAIN: &str = "run the command again with --force";

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
    folder.claim_files::<&str>(&[], true)?;
    let (mut written, mut summary, mut pages) = (Vec::new(), Vec::new(), Vec::new());
    for (page, command, report) in reports {
        let files = ReportFiles::draw(&folder, &page, &command, &report)?;
        let version = &report.version;
        summary.push(format!("{command}: {}, computed by {version}", report.title));
        pages.push(PageSummary {
            page: folder.path.join(&page),
            command,
            computed_by: version.clone(),
            tables: files.tables,
        });
        // two reports share the folders of tables and figures
        extend_new(&mut written, files.paths);
    }
    Ok(Outcome {
        summary: summary.join("\n"),
        result: json(&ReportResult { plummer: VERSION, command: "report", reports: pages })?,
        written,
        verdict: Ok(()),
    })
}

/// The contents of reports in a folder, in order of their names, each with the name of its page.
fn records(folder: &Path) -> Result<Vec<(PathBuf, String)>, CliError> {
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
fn read(path: &Path) -> Result<(String, Report), CliError> {
    let bytes = fs::read(path).map_err(|source| unreadable(path, source))?;
    let wrong = |what: &str| CliError::input(format!("{}: {what}", path.display())).with_help(AGAIN);
    let report = Report::from_record(&bytes).map_err(|error| wrong(&error.to_string()))?;
    // names of files are made of it: nothing is written beside the folder
    let command = report.table_files.as_ref().map(|files| files.prefix.clone()).unwrap_or_default();
    match WITH_REPORT.contains(&command.as_str()) {
        true => Ok((command, report)),
        false => Err(wrong(&format!("a report of \"{command}\": expected one of {}", WITH_REPORT.join(", ")))),
    }
}

/// A folder that was named, or a file in it, cannot be read.
fn unreadable(path: &Path, source: io::Error) -> CliError {
    CliError::input(FileError::read(path)(source).to_string())
}

#[cfg(test)]
mod tests {
    use super::records;

    #[test]
    fn a_folder_without_a_report_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let error = records(folder.path()).unwrap_err();
        assert_eq!(error.exit_code(), 2);
        let mut lines = Vec::new();
        error.report(&mut lines);
        let expected = format!(
            "error: {} has no content of a report: expected report.cbor.gz or COMMAND-report.cbor.gz, as each command writes it beside its page\n\
             help: name the folder with the results of a command\n",
            folder.path().display()
        );
        assert_eq!(String::from_utf8(lines).unwrap(), expected);
    }
}
