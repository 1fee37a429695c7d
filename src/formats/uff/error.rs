//! What can go wrong with a universal file.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::super::ModeShapesError;
use super::response::ResponseFault;
use crate::fe::mesh::{ElementId, ElementKind};

/// Why a universal file cannot be written or read.
#[derive(Debug, Error)]
pub enum UffError {
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
    /// An element that is neither surface nor solid.
    #[error("expected surface and solid elements, found a {}", kind.name())]
    Kind {
        /// Its kind.
        kind: ElementKind,
    },
    /// A label too long for its column.
    #[error("expected labels of at most 10 digits, found {label}")]
    Label {
        /// The label.
        label: u64,
    },
    /// A node of the mode shapes that no element written uses.
    #[error("expected mode shapes at nodes of the elements, found node {tag}")]
    UnknownNode {
        /// Its label.
        tag: u64,
    },
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
        line: usize,
        /// What the format has there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A file without modes.
    #[error(
        "{}: expected mode shapes (dataset 55 of analysis type 2, 3 or 7 with displacements in space), found none",
        path.display()
    )]
    NoModes {
        /// The file.
        path: PathBuf,
    },
    /// Mode shapes that contradict themselves.
    #[error("{}: {fault}", path.display())]
    Modes {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        fault: ModeShapesError,
    },
    /// A frequency response that contradicts itself.
    #[error("frequency response {index}: {fault}")]
    Response {
        /// Which one, counted from 0.
        index: usize,
        /// What is wrong.
        fault: ResponseFault,
    },
    /// Uneven frequencies that the format cannot tell apart.
    #[error(
        "frequency response {index}: expected uneven frequencies that differ in six digits, found two like {found} Hz"
    )]
    CloseFrequencies {
        /// Which one, counted from 0.
        index: usize,
        /// The lower one of them, Hz.
        found: f64,
    },
    /// A file without frequency responses.
    #[error(
        "{}: expected frequency responses (dataset 58, function type 4, of displacement, velocity or acceleration by force), \
         found none",
        path.display()
    )]
    NoResponses {
        /// The file.
        path: PathBuf,
    },
    /// A file without signals over time.
    #[error(
        "{}: expected signals over time (dataset 58 or 58b, function type 1, abscissa 17), found none",
        path.display()
    )]
    NoTimes {
        /// The file.
        path: PathBuf,
    },
}
