//! Why data cannot be written to a file of a format, or read from one.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::fe::mesh::ElementId;
use crate::files::{Fault, FileError};

/// Why data cannot be written to a file of a format, or read from one.
#[derive(Debug, Error)]
pub enum FormatError {
    /// The file cannot be read or written, or its content is not what the format has there.
    #[error(transparent)]
    File(#[from] FileError),
    /// Data that contradict themselves, or that the format does not hold.
    #[error(transparent)]
    Data(#[from] Fault),
    /// An array of an archive that is damaged.
    #[error("{}: array \"{name}\": {source}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Name of the array.
        name: String,
        /// What the archive library said.
        source: io::Error,
    },
    /// An element that the mesh does not have.
    #[error("the mesh has no element {} in block {}", id.index, id.block)]
    Element {
        /// The element asked for.
        id: ElementId,
    },
    /// A name of two fields of a grid.
    #[error("two fields are called \"{name}\"")]
    DuplicateField {
        /// The name.
        name: String,
    },
    /// An array's name that is empty or would not come back as typed.
    #[error("array name must be letters, digits, '_', '-', '.' or spaces, found \"{name}\"")]
    ArrayName {
        /// Name as given.
        name: String,
    },
    /// A name that the archive already has.
    #[error("array \"{name}\" is already in the archive")]
    DuplicateArray {
        /// Name as given.
        name: String,
    },
    /// An array was begun and never completed: the archive would not be readable.
    #[error("array \"{name}\" was begun and not completed")]
    Incomplete {
        /// Name of the array.
        name: String,
    },
    /// More or fewer values than an array or a field takes.
    #[error("{what} takes {expected}, found {found}")]
    Count {
        /// The array or field, with its name.
        what: String,
        /// How many values it takes.
        expected: String,
        /// Values given, or given so far when they became too many.
        found: usize,
    },
}
