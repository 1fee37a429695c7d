//! Why the results of an earlier command cannot be used.

use std::path::PathBuf;

use thiserror::Error;

use crate::app::shell_word::shell_word;
use crate::files::FileError;
use crate::report::ReportError;

/// The commands that write reports, by the names of their results.
pub(super) const WITH_REPORT: [&str; 9] =
    ["run", "modes", "condense", "frf", "chart", "stability", "analysis", "sweep", "verify"];

/// Why earlier results, or the reports beside them, cannot be used.
#[derive(Debug, Error)]
pub enum ResultsError {
    /// There are none.
    #[error("{} has no {command}.json and {arrays}: expected a folder with results of `plummer {command}`, or {instead}", folder.display())]
    Missing {
        /// The folder.
        folder: PathBuf,
        /// The command.
        command: &'static str,
        /// The file with its arrays.
        arrays: &'static str,
        /// What could have been named instead.
        instead: &'static str,
    },
    /// A `COMMAND.json` that cannot be read, or is none.
    #[error("{}: expected {expected}, found {found}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What should be there.
        expected: &'static str,
        /// What is there.
        found: String,
    },
    /// The case is elsewhere.
    #[error("{} names the case file {}, which is not there", path.display(), case.display())]
    CaseGone {
        /// The result file.
        path: PathBuf,
        /// The case file.
        case: PathBuf,
    },
    /// The case has other values now.
    #[error("{} is the result of other values than {} has now", path.display(), case.display())]
    CaseChanged {
        /// The result file.
        path: PathBuf,
        /// The case file.
        case: PathBuf,
    },
    /// `--set` gives the case other values than the results were computed with.
    #[error("{} is the result of other values than --set gives", path.display())]
    SetChanges {
        /// The result file.
        path: PathBuf,
    },
    /// A file that was replaced or damaged since.
    #[error("{} is not the file that {} speaks of: expected SHA-256 {expected}, found {found}", arrays.display(), path.display())]
    OtherFile {
        /// The result file.
        path: PathBuf,
        /// The file beside it.
        arrays: PathBuf,
        /// 64 hexadecimal digits.
        expected: String,
        /// 64 hexadecimal digits.
        found: String,
    },
    /// A folder with reports, or a file in it, cannot be read.
    #[error(transparent)]
    Unreadable(#[from] FileError),
    /// The folder has no content of a report.
    #[error("{} has no content of a report: expected report.cbor.gz or COMMAND-report.cbor.gz, as each command writes it beside its page", folder.display())]
    NoReport {
        /// The folder.
        folder: PathBuf,
    },
    /// A file is no content of a report.
    #[error("{}: {source}", path.display())]
    BrokenReport {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: ReportError,
    },
    /// A file is the content of a report that no command writes.
    #[error("{}: a report of \"{command}\": expected one of {}", path.display(), WITH_REPORT.join(", "))]
    OtherReport {
        /// The file.
        path: PathBuf,
        /// What it says of itself.
        command: String,
    },
}

impl ResultsError {
    /// What to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        let text = match self {
            Self::Missing { folder, command, .. } => {
                format!("run `plummer {command} CASE.toml --out {}` first", shell_word(&folder.to_string_lossy()))
            }
            Self::CaseGone { .. } => {
                "go to the folder in which the results were computed, or compute them again".to_owned()
            }
            Self::CaseChanged { .. } => {
                "compute the results again with --force, or give the case file its old values; [analysis] may change"
                    .to_owned()
            }
            Self::SetChanges { .. } => {
                "of results, --set changes [analysis] alone; compute others with these values".to_owned()
            }
            Self::Damaged { .. } | Self::OtherFile { .. } => "compute the results again with --force".to_owned(),
            Self::NoReport { .. } => "name the folder with the results of a command".to_owned(),
            Self::BrokenReport { .. } | Self::OtherReport { .. } => "run the command again with --force".to_owned(),
            Self::Unreadable(_) => return None,
        };
        Some(text)
    }
}
