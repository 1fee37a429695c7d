//! `plummer report`: the pages of earlier results, drawn again from their content.
//!
//! A command's report with its tables and figures beside it.

use super::earlier_results::{FIGURES, TABLES, read, record_of, records, refuse_foreign, report_name, unreadable};
use super::output::{extend_new, json};
use super::{CliError, Options, Outcome, OutputFolder, Progress};
use crate::app::case::Case;
use crate::app::commands::parts::with_details;
use crate::app::commands::result::VERSION;
use crate::app::error::ComputeError;
use crate::app::scene::mesh_digests;
use crate::files::FileDigest;
use crate::report::{MeshFile, Report, ReportError};
use schemars::JsonSchema;
use serde::Serialize;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

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
    let names: Vec<String> = reports.iter().map(|(page, ..)| record_of(page)).collect();
    let same = |path: &Path| fs::read(path).ok() == fs::read(from.join(path.file_name().unwrap_or_default())).ok();
    folder.claim_unless(&names, options.force, |path| (!same(path)).then_some(""))?;
    if !options.force {
        let files = reports.iter().flat_map(|(page, command, report)| files_of(page, command, report));
        refuse_foreign(&folder.path, files.collect())?;
    }
    let (mut written, mut summary, mut pages) = (Vec::new(), Vec::new(), Vec::new());
    for (page, command, report) in reports {
        if options.out.is_some() {
            let record = from.join(record_of(&page));
            folder.write(&record_of(&page), &fs::read(&record).map_err(|source| unreadable(&record, source))?)?;
        }
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

/// Writes what a command writes of its report into a folder that is there: the page, its content, tables and figures.
///
/// # Errors
/// [`CliError`] when its contents do not fit together or a file cannot be written.
pub fn write_report(folder: &Path, command: &str, case: &Case, report: Report) -> Result<(), CliError> {
    ReportFiles::without_case(&OutputFolder::at(folder), command, with_details(report, case)).map(|_| ())
}

/// What was written of a report, and what it rests on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ReportFiles {
    /// The meshes behind the results.
    pub(super) meshes: Vec<FileDigest>,
    /// Names of the tables' files in the folder of the results.
    pub(super) tables: Vec<String>,
    /// What to name to the reader: the folders of tables and figures, the report.
    pub(super) paths: Vec<PathBuf>,
}

impl ReportFiles {
    /// Writes the report of a command, its content, each of its tables as `tables/COMMAND-NUMBER-CAPTION.csv` and each of its plots as
    /// `figures/COMMAND-NUMBER-TITLE.svg`; the meshes go into the report's head. Those of an earlier report of this command are removed.
    ///
    /// # Errors
    /// [`CliError`] when a mesh cannot be read or has changed since it was, the report's contents do not fit together or a file cannot be written.
    pub(super) fn write(
        folder: &OutputFolder,
        command: &str,
        case: &Case,
        report: Report,
        progress: &Progress,
    ) -> Result<Self, CliError> {
        let meshes = mesh_digests(case)?;
        unchanged(&meshes, &progress.files())?;
        let mut report = with_details(report, case);
        if let Some(head) = &mut report.document {
            head.meshes = meshes.iter().map(MeshFile::from).collect();
        }
        let files = Self::without_case(folder, command, report)?;
        Ok(Self { meshes, ..files })
    }

    /// The same for a command that reads no case.
    ///
    /// # Errors
    /// As [`ReportFiles::write`].
    pub(super) fn without_case(folder: &OutputFolder, command: &str, report: Report) -> Result<Self, CliError> {
        let page = report_name(&folder.path, command);
        let date = report.date.clone().unwrap_or_else(today);
        let report = report.date(date).tables_in(TABLES, command);
        let (record, html) = rayon::join(|| report.to_record(), || report.to_html());
        let (record, html) = (record.map_err(ComputeError::from)?, html.map_err(ComputeError::from)?);
        remove_earlier(folder, &record_of(&page), command)?;
        folder.write(&record_of(&page), &record)?;
        Self::put(folder, &page, command, &report, &html)
    }

    /// Draws a report: its page under this name, its tables and figures beside it.
    ///
    /// # Errors
    /// [`CliError`] when its contents do not fit together or a file cannot be written.
    pub(super) fn draw(folder: &OutputFolder, page: &str, command: &str, report: &Report) -> Result<Self, CliError> {
        let html = report.to_html().map_err(ComputeError::from)?;
        Self::put(folder, page, command, report, &html)
    }

    fn put(folder: &OutputFolder, page: &str, command: &str, report: &Report, html: &str) -> Result<Self, CliError> {
        let figures = report.svg_files(command).map(|(name, plot)| Ok((format!("{FIGURES}/{name}"), plot.to_svg()?)));
        let figures = figures.collect::<Result<_, _>>().map_err(|error: ReportError| ComputeError::from(error))?;
        let tables = report.csv_files();
        let named: Vec<String> = tables.iter().map(|(name, _)| name.clone()).collect();
        let mut paths = Vec::new();
        for (of, files) in [(TABLES, tables), (FIGURES, figures)] {
            let path = folder.path.join(of);
            if !files.is_empty() {
                folder.make_below(Path::new(of))?;
            }
            for (name, text) in &files {
                folder.write(name, text.as_bytes())?;
            }
            paths.extend(Some(path).filter(|_| !files.is_empty()));
        }
        paths.push(folder.write(page, html.as_bytes())?);
        Ok(Self { meshes: Vec::new(), tables: named, paths })
    }
}

/// The date in UTC, or that of the environment's `SOURCE_DATE_EPOCH` (reproducible-builds.org), by which pages are the same again.
fn today() -> String {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    date_of(given.unwrap_or_else(now))
}

/// Year, month and day (ISO 8601) of so many seconds after 1970 began, by H. Hinnant, "chrono-compatible low-level date algorithms"
/// (2013): years begin in March, and 400 of them have 146 097 days.
fn date_of(seconds: u64) -> String {
    let day = seconds / 86_400 + 719_468;
    let (era, day) = (day / 146_097, day % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    format!("{}-{:02}-{day:02}", year + 400 * era + month / 10, (month + 2) % 12 + 1)
}

/// Names of the tables and figures of a report in the folder of the results.
fn files_beside(command: &str, report: &Report) -> impl Iterator<Item = String> {
    let figures = report.svg_files(command).map(|(name, _)| format!("{FIGURES}/{name}"));
    report.csv_files().into_iter().map(|(name, _)| name).chain(figures)
}

/// Names of all files of a report in the folder of the results.
pub(super) fn files_of(page: &str, command: &str, report: &Report) -> impl Iterator<Item = String> {
    [page.to_owned(), record_of(page)].into_iter().chain(files_beside(command, report))
}

/// Checks that the meshes are still those that were read: the report names their content.
///
/// # Errors
/// [`ComputeError::Failed`].
fn unchanged(now: &[FileDigest], read: &[FileDigest]) -> Result<(), ComputeError> {
    let other = |file: &&FileDigest| {
        let same_path = now.iter().find(|now| now.path == file.path);
        same_path.is_some_and(|now| now.sha256 != file.sha256)
    };
    match read.iter().find(other) {
        Some(file) => Err(ComputeError::failed(
            format!("{} was changed while it was used: the result belongs to what it was before", file.path.display()),
            "run the command again when the mesh is complete",
        )),
        None => Ok(()),
    }
}

/// Removes the tables and figures of the report whose content is in the file `record` of a folder, and nothing else.
fn remove_earlier(folder: &OutputFolder, record: &str, command: &str) -> Result<(), CliError> {
    let earlier = fs::read(folder.path.join(record)).ok().and_then(|bytes| Report::from_record(&bytes).ok());
    // a link there is refused before anything is removed through it
    for of in [TABLES, FIGURES] {
        if folder.path.join(of).exists() {
            folder.make_below(Path::new(of))?;
        }
    }
    for name in earlier.iter().flat_map(|earlier| files_beside(command, earlier)) {
        let path = folder.path.join(name);
        if path.is_file() {
            fs::remove_file(&path)
                .map_err(|error| CliError::failed(format!("cannot remove {}: {error}", path.display())))?;
        }
    }
    Ok(())
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

#[cfg(test)]
mod report_files_tests {
    use super::{OutputFolder, ReportFiles, date_of, unchanged};
    use crate::files::FileDigest;
    use crate::report::{Cell, Column, Report, Section, Table};

    /// By `date -u -d @SECONDS +%F`.
    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, date) in [
            (0, "1970-01-01"),
            (951_782_399, "2000-02-28"),
            (951_782_400, "2000-02-29"),
            (1_735_689_599, "2024-12-31"),
            (1_735_689_600, "2025-01-01"),
            (4_107_542_400, "2100-03-01"),
            (16_725_225_600, "2500-01-01"),
        ] {
            assert_eq!(date_of(seconds), date);
        }
    }

    #[test]
    fn a_mesh_that_changed_is_named() {
        let file = |path: &str, content: &[u8]| FileDigest::of_bytes(path.as_ref(), content);
        let now = [file("a.msh", b"1"), file("b.msh", b"2")];
        assert!(unchanged(&now, &now[..1]).is_ok());
        let error = unchanged(&now, &[file("a.msh", b"1"), file("b.msh", b"1")]).unwrap_err();
        assert!(error.to_string().starts_with("b.msh was changed while it was used"));
        assert!(!error.is_input());
    }

    /// A report takes the tables and figures of the one before away, and leaves what others put beside them.
    #[test]
    fn files_of_others_stay_beside_a_report() {
        let at = tempfile::tempdir().unwrap();
        let folder = OutputFolder { path: at.path().to_owned() };
        let report = |captions: &[&str]| {
            let tables =
                captions.iter().map(|caption| Table::new(*caption, [Column::text("a")]).row([Cell::text("b")]));
            let section = tables.fold(Section::new("s"), Section::table);
            Report::new("t", "plummer modes", "1").section(section)
        };
        let first = ReportFiles::without_case(&folder, "modes", report(&["one", "two"])).unwrap();
        assert_eq!(first.tables, ["tables/modes-1-one.csv", "tables/modes-2-two.csv"]);
        let own = at.path().join("tables/modes-3-mine.csv");
        std::fs::write(&own, "mine").unwrap();
        let second = ReportFiles::without_case(&folder, "modes", report(&["one"])).unwrap();
        assert_eq!(second.tables, ["tables/modes-1-one.csv"]);
        assert!(own.exists() && at.path().join("tables/modes-1-one.csv").exists());
        assert!(!at.path().join("tables/modes-2-two.csv").exists());
    }
}
