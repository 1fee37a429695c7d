//! What can be wrong with an archive.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::super::{ModeShapesError, SuperelementError};

/// Why an archive or one of its arrays cannot be read.
#[derive(Debug, Error)]
pub enum NpzReadError {
    /// The file cannot be opened.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file is no archive, or a damaged one.
    #[error("{}: expected a NumPy archive (.npz), found {source}", path.display())]
    Archive {
        /// The file.
        path: PathBuf,
        /// What the archive library said.
        source: zip::result::ZipError,
    },
    /// No array of this name.
    #[error("{}: expected an array \"{name}\", found {}", path.display(), names_or_none(known))]
    Missing {
        /// The file.
        path: PathBuf,
        /// Name asked for.
        name: String,
        /// Names that the archive has.
        known: Vec<String>,
    },
    /// An array that is damaged.
    #[error("{}: array \"{name}\": {source}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Name of the array.
        name: String,
        /// What the archive library said.
        source: io::Error,
    },
    /// An array that is not what was expected.
    #[error("{}: array \"{name}\": expected {expected}, found {found}", path.display())]
    Array {
        /// The file.
        path: PathBuf,
        /// Name of the array.
        name: String,
        /// What was expected.
        expected: &'static str,
        /// What the array has.
        found: String,
    },
    /// Mode shapes that contradict themselves.
    #[error("{}: {fault}", path.display())]
    Modes {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        fault: ModeShapesError,
    },
    /// A superelement that contradicts itself.
    #[error("{}: {fault}", path.display())]
    Superelement {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        fault: Box<SuperelementError>,
    },
}

fn names_or_none(names: &[String]) -> String {
    if names.is_empty() {
        return "no arrays".to_owned();
    }
    let names: Vec<String> = names
        .iter()
        .take(20)
        .map(|name| format!("\"{name}\""))
        .collect();
    names.join(", ")
}
