//! What can be wrong between a mesh and what is asked of it.

use crate::fe::element::ElementError;
use crate::fe::mesh::MeshError;
use thiserror::Error;

/// A housing model or a ring that cannot be built.
#[derive(Debug, Error)]
pub enum ModelError {
    /// A group that the mesh lacks, or that is empty or ambiguous.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// What the mesh, the ring or the description breaks: the file, the place and what to do about it.
    #[error("{0}")]
    Refused(String),
    /// One of several bores, by its place among them.
    #[error("{source}")]
    Bore {
        /// From 0.
        place: usize,
        /// What is wrong with it.
        source: Box<ModelError>,
    },
}

impl ModelError {
    /// An element whose matrices cannot be computed, by its mesh file and gmsh's tag.
    pub(crate) fn element(path: &str, tag: u64, source: &ElementError) -> Self {
        Self::Refused(format!("{path}: element {tag}: {source}"))
    }
}
