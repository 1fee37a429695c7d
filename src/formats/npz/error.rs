//! What can go wrong while an archive is written.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::super::{ModeShapesError, SuperelementError};

/// Why an archive cannot be written.
#[derive(Debug, Error)]
pub enum NpzError {
    /// The file system refused.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// File that was being written or renamed.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The archive library refused.
    #[error("cannot write {}: {source}", path.display())]
    Archive {
        /// File that was being written.
        path: PathBuf,
        /// What the library said.
        source: zip::result::ZipError,
    },
    /// A name that is empty or would not come back as typed.
    #[error("array name must be letters, digits, '_', '-', '.' or spaces, found \"{name}\"")]
    Name {
        /// Name as given.
        name: String,
    },
    /// A name that the archive already has.
    #[error("array \"{name}\" is already in the archive")]
    Duplicate {
        /// Name as given.
        name: String,
    },
    /// An array was begun and never completed: the archive would not be readable.
    #[error("array \"{name}\" was begun and not completed")]
    Incomplete {
        /// Name of the array.
        name: String,
    },
    /// More or fewer values than the shape holds.
    #[error("array \"{name}\" of shape {shape:?} takes {expected} values, found {found}")]
    Shape {
        /// Name of the array.
        name: String,
        /// Shape as given.
        shape: Vec<usize>,
        /// Product of the shape.
        expected: usize,
        /// Values given, or given so far when they became too many.
        found: usize,
    },
    /// Mode shapes that contradict themselves.
    #[error("{fault}")]
    Modes {
        /// What is wrong.
        fault: ModeShapesError,
    },
    /// A superelement that contradicts itself.
    #[error("{fault}")]
    Superelement {
        /// What is wrong.
        fault: SuperelementError,
    },
    /// A label that the archive's whole numbers do not reach.
    #[error("expected labels up to {}, found {label}", i64::MAX)]
    Label {
        /// The label.
        label: u64,
    },
}
