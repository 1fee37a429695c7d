//! A command's report with its tables beside it.

use std::fs;
use std::path::PathBuf;

use super::{CliError, OutputFolder};
use crate::case::Case;
use crate::report::{Document, MeshFile, Report};
use crate::stages::{MeshDigest, StageError, mesh_digests};

/// Folder of the tables, in that of the results.
const TABLES: &str = "tables";

/// What was written of a report, and what it rests on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ReportFiles {
    /// The meshes behind the results.
    pub(super) meshes: Vec<MeshDigest>,
    /// Names of the tables' files in the folder of the results.
    pub(super) tables: Vec<String>,
    /// What to name to the reader: the tables' folder, the report.
    pub(super) paths: Vec<PathBuf>,
}

impl ReportFiles {
    /// Writes the report of a command and each of its tables as `tables/COMMAND-NUMBER-CAPTION.csv`; the meshes go into
    /// the report's head. Tables of an earlier report of this command are removed.
    ///
    /// # Errors
    /// [`CliError`] when a mesh cannot be read, the report's contents do not fit together or a file cannot be written.
    pub(super) fn write(
        folder: &OutputFolder,
        command: &str,
        case: &Case,
        report: Report,
    ) -> Result<Self, CliError> {
        let meshes = mesh_digests(case)?;
        let mut report = report;
        let head = report
            .document
            .get_or_insert_with(|| Document::new().case(case.source.path.display().to_string()));
        head.meshes = meshes.iter().map(MeshFile::from).collect();
        let files = Self::without_case(folder, command, report)?;
        Ok(Self { meshes, ..files })
    }

    /// The same for a command that reads no case.
    ///
    /// # Errors
    /// As [`ReportFiles::write`].
    pub(super) fn without_case(
        folder: &OutputFolder,
        command: &str,
        report: Report,
    ) -> Result<Self, CliError> {
        let report = report.tables_in(TABLES, command);
        let html = report.to_html().map_err(StageError::from)?;
        remove_earlier(folder, command)?;
        let mut tables = Vec::new();
        let mut paths = Vec::new();
        for (name, text) in report.csv_files() {
            folder.write(&name, text.as_bytes())?;
            tables.push(name);
        }
        if !tables.is_empty() {
            paths.push(folder.path().join(TABLES));
        }
        paths.push(folder.write(&folder.report_name(command), html.as_bytes())?);
        Ok(Self {
            meshes: Vec::new(),
            tables,
            paths,
        })
    }
}

/// Makes the tables' folder and removes what an earlier report of the command left there, and nothing else.
fn remove_earlier(folder: &OutputFolder, command: &str) -> Result<(), CliError> {
    let path = folder.path().join(TABLES);
    let failed = |source| CliError::Folder {
        path: path.clone(),
        source,
    };
    fs::create_dir_all(&path).map_err(failed)?;
    for entry in fs::read_dir(&path).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if is_table_of(command, &entry.file_name().to_string_lossy()) {
            fs::remove_file(entry.path()).map_err(failed)?;
        }
    }
    Ok(())
}

/// Whether a file's name is `COMMAND-NUMBER-CAPTION.csv`.
fn is_table_of(command: &str, name: &str) -> bool {
    let rest = name
        .strip_prefix(command)
        .and_then(|rest| rest.strip_prefix('-'));
    let number = rest
        .and_then(|rest| rest.strip_suffix(".csv"))
        .and_then(|rest| rest.split_once('-'));
    number
        .is_some_and(|(number, _)| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::is_table_of;

    #[test]
    fn only_tables_of_the_command_are_told() {
        for (name, expected) in [
            ("modes-1-eigenfrequencies.csv", true),
            ("modes-12-a-b.csv", true),
            ("run-1-eigenfrequencies.csv", false),
            ("modes-eigenfrequencies.csv", false),
            ("modes-1.csv", false),
            ("modes--a.csv", false),
            ("modes-1-notes.txt", false),
            ("my-modes-1-a.csv", false),
        ] {
            assert_eq!(is_table_of("modes", name), expected, "{name}");
        }
    }
}
