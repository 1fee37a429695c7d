//! What can be wrong with a mesh.

use std::path::PathBuf;

use thiserror::Error;

/// Content of a mesh file that cannot be used: the section, the line (byte of a binary file), what was found and what was
/// expected.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct MshError(pub String);

/// A mesh that cannot be read, or a name that it does not have.
#[derive(Debug, Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("cannot read the mesh {}: {cause}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// The file can be read, its content cannot be used.
    #[error("{}: {fault}", path.display())]
    Gmsh {
        /// The file.
        path: PathBuf,
        /// What is wrong, in which section and line.
        fault: MshError,
    },
    /// The same of an input file of Abaqus or CalculiX.
    #[error("{}: {fault}", path.display())]
    Inp {
        /// The file.
        path: PathBuf,
        /// What is wrong, at which keyword and line.
        fault: MshError,
    },
    /// No physical group of this name: the nearest name, and all; or one without elements, so that whatever refers to it
    /// would have no effect.
    #[error("{0}")]
    Group(String),
    /// Several physical groups of this name: dimension and tag of each.
    #[error("{0}")]
    AmbiguousGroup(String),
}
