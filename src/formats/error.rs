//! Why data cannot be written to a file of a format, or read from one.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::fe::mesh::ElementId;
use crate::files::{Fault, FileError};
use crate::numerics::linalg::LinalgError;

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
    /// A run's column that lacks rows which a checkpoint counts on.
    #[error("{} has {found} bytes: expected at least {expected} of the rows that the checkpoint counts", path.display())]
    CutColumn {
        /// The file.
        path: PathBuf,
        /// Bytes that it must have.
        expected: u64,
        /// Bytes that it has.
        found: u64,
    },
    /// A superelement's matrices without eigenvectors.
    #[error("the superelement's eigenvalue problem failed: {0}")]
    Eigen(LinalgError),
    /// A superelement that is a mechanism, or a plane.
    #[error("expected a body that is free (6 rigid motions) or held (none), found {found} rigid motions")]
    RigidMotions {
        /// Eigenvalues that are zero.
        found: usize,
    },
    /// What the caller asked to write is none of the format's: an element that the mesh does not have, a second field or array of
    /// a name, an array without a proper name or with more or fewer values than its shape.
    #[error("{0}")]
    Refused(String),
}

impl FormatError {
    /// An element that the mesh does not have.
    pub(super) fn no_element(ElementId { block, index }: ElementId) -> Self {
        Self::Refused(format!("the mesh has no element {index} in block {block}"))
    }
}
