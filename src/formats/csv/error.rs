//! What can go wrong with a table of mode shapes.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::super::ModeShapesError;
use crate::files::FileError;

/// Why a table of mode shapes cannot be written or read.
#[derive(Debug, Error)]
pub enum CsvError {
    /// The file system refused.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Nothing says where the displacements are.
    #[error("expected mode shapes with node labels or points, found neither")]
    NoPlaces,
    /// The file cannot be read, or a line of it is not what the format has there.
    #[error(transparent)]
    File(#[from] FileError),
    /// Mode shapes that contradict themselves.
    #[error("{}: {fault}", path.display())]
    Modes {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        fault: ModeShapesError,
    },
}
