//! Why a superelement cannot be written for MBDyn.

use thiserror::Error;

use crate::files::{Fault, FileError};
use crate::numerics::linalg::LinalgError;

/// Why a superelement cannot be written for MBDyn.
#[derive(Debug, Error)]
pub enum MbdynError {
    /// The file system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// A superelement that contradicts itself, or lacks what the format asks for: modes, nodes, a node to hold.
    #[error(transparent)]
    Data(#[from] Fault),
    /// Matrices without eigenvectors.
    #[error("the superelement's eigenvalue problem failed: {source}")]
    Eigen {
        /// What the solver said.
        source: LinalgError,
    },
    /// A mechanism, or a plane.
    #[error("expected a body that is free (6 rigid motions) or held (none), found {found} rigid motions")]
    RigidMotions {
        /// Eigenvalues that are zero.
        found: usize,
    },
    /// A free body of which the rigid motions cannot be told.
    #[error(
        "expected node, direction, position and axis of every interface coordinate of a free body, not known for coordinate \
         {coordinate}"
    )]
    Place {
        /// The interface coordinate, counted from 0.
        coordinate: usize,
    },
}
