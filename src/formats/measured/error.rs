//! What can be wrong with a file of measured signals.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::super::FormatError;
use crate::files::FileError;

/// Why a signal cannot be read.
#[derive(Debug, Error)]
pub enum MeasuredError {
    /// The file cannot be read, or something in it is not what should stand there.
    #[error(transparent)]
    File(#[from] FileError),
    /// An archive or a universal file that cannot be read, or has no signals.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// A file of another format or version, or one that contradicts itself.
    #[error("{message}")]
    Refused {
        /// The file, what was expected and what was found.
        message: String,
        /// What to do about it.
        help: Option<String>,
    },
    /// Arrays that do not fit together.
    #[error("{}: array \"{name}\": expected {expected}, found {found}", path.display())]
    Array {
        /// The file.
        path: PathBuf,
        /// The array.
        name: String,
        /// What was expected.
        expected: String,
        /// What the array has.
        found: String,
    },
    /// Nothing says when the samples were taken.
    #[error("{}: expected a time or a sampling rate, found neither", path.display())]
    NoTime {
        /// The file.
        path: PathBuf,
    },
    /// Several channels, and none was named.
    #[error("{}: expected one signal or the name of one, found {}", path.display(), quoted(known))]
    Choose {
        /// The file.
        path: PathBuf,
        /// Channels of the file.
        known: Vec<String>,
    },
    /// No channel of this name.
    #[error("{}: expected a channel \"{wanted}\", found {}", path.display(), quoted(known))]
    NoChannel {
        /// The file.
        path: PathBuf,
        /// Name asked for.
        wanted: String,
        /// Channels of the file.
        known: Vec<String>,
    },
}

/// Most names that are listed.
const LISTED: usize = 20;

fn quoted(names: &[String]) -> String {
    let listed = names.iter().take(LISTED).map(|n| format!("\"{n}\"")).collect::<Vec<_>>().join(", ");
    match names.len() {
        0 => "no signals".to_owned(),
        count if count > LISTED => format!("{listed} and {} more", count - LISTED),
        _ => listed,
    }
}

impl MeasuredError {
    /// A file that is none of a format's.
    pub(super) fn refused(message: String) -> Self {
        Self::Refused { message, help: None }
    }

    /// The same with what to do about it.
    pub(super) fn refused_with(message: String, help: &str) -> Self {
        Self::Refused { message, help: Some(help.to_owned()) }
    }

    /// An array that does not fit.
    pub(super) fn array(path: &Path, name: &str, expected: impl Into<String>, found: impl Into<String>) -> Self {
        let (path, name) = (path.to_owned(), name.to_owned());
        Self::Array { path, name, expected: expected.into(), found: found.into() }
    }

    /// What to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::NoTime { .. } => Some("give the sampling rate with --rate HZ".to_owned()),
            Self::Choose { .. } => Some("name it with --channel NAME (repeatable)".to_owned()),
            Self::NoChannel { wanted, known, .. } => {
                let nearest = known.iter().map(|name| (strsim::damerau_levenshtein(wanted, name), name)).min();
                nearest.map(|(_, name)| format!("did you mean --channel '{name}'?"))
            }
            Self::Refused { help, .. } => help.clone(),
            _ => None,
        }
    }
}
