//! What is wrong with any file that is read as lines: the file itself, or a line of it.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::read;

/// Why a file of lines cannot be read.
#[derive(Debug, Error)]
pub enum FileError {
    /// The file cannot be opened or read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Something in the file is not what the format has there.
    #[error("{}:{line}: expected {expected}, found {found}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: u64,
        /// What the format has there.
        expected: String,
        /// What stands there.
        found: String,
    },
}

/// All of a file.
///
/// # Errors
/// [`FileError::Read`].
pub(crate) fn bytes_of(path: &Path) -> Result<Vec<u8>, FileError> {
    read(path).map_err(|source| FileError::Read {
        path: path.to_owned(),
        source,
    })
}
