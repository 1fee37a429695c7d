//! What can go wrong while a grid is written.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::fe::mesh::ElementId;

/// Why a grid cannot be written.
#[derive(Debug, Error)]
pub enum VtuError {
    /// The file system refused.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// An element that the mesh does not have.
    #[error("the mesh has no element {} in block {}", id.index, id.block)]
    Element {
        /// The element asked for.
        id: ElementId,
    },
    /// A grid without cells.
    #[error("expected at least one element to write, found none")]
    NoElements,
    /// A name that is empty or has control characters.
    #[error("expected a field's name without control characters, found {name:?}")]
    Name {
        /// Name as given.
        name: String,
    },
    /// A name of two fields.
    #[error("two fields are called \"{name}\"")]
    DuplicateField {
        /// The name.
        name: String,
    },
    /// More or fewer values than nodes or elements.
    #[error(
        "field \"{name}\" takes {expected} values (a fixed number for each {what}), found {found}"
    )]
    Length {
        /// Name of the field.
        name: String,
        /// What the values belong to.
        what: &'static str,
        /// Components times nodes or elements.
        expected: usize,
        /// Values given.
        found: usize,
    },
}
