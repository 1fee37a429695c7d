//! Meshes with named parts: read from gmsh, checked, in metres.
//!
//! [`Mesh::read_gmsh`] is the only way in. It refuses what later stages could not survive (coordinates
//! that are no numbers, tags used twice, elements on nodes that do not exist) and says in which file,
//! section and line, what was found and what was expected. Nodes and elements are indices from 0 into
//! the mesh's own lists; gmsh's tags are kept beside for messages and for export.
//!
//! # Limitations
//! MSH 4.1 and 2.2 only (others are refused with gmsh's command for converting them); elements of first and
//! second order without nodes inside faces and volumes, no pyramids; no partitioned meshes.

mod block;
mod boundary;
pub(crate) mod cylinder;
mod error;
mod faces;
mod format;
mod gmsh;
mod group;
mod inventory;
mod kind;
mod turn;

use std::path::PathBuf;

pub use block::{ElementBlock, ElementId, Entity};
pub use boundary::BoundaryFace;
pub use error::MeshError;
pub use faces::Face;
pub use format::{MshFormat, MshVersion};
pub use gmsh::{MshError, Place};
pub use group::PhysicalGroup;
pub(crate) use inventory::Sets;
pub use inventory::{BoundingBox, DuplicateNodes, GroupOverlap, GroupSummary, Inventory, KindCount, Part, UnusedNodes};
pub use kind::ElementKind;

/// A checked mesh in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Coordinates (x, y, z) of each node, m.
    pub nodes: Vec<[f64; 3]>,
    /// gmsh's tag of each node, unique, > 0.
    pub node_tags: Vec<u64>,
    /// Elements, one kind and one geometrical entity a block, in the order of the file.
    pub blocks: Vec<ElementBlock>,
    /// Physical groups, by dimension, then by tag.
    pub groups: Vec<PhysicalGroup>,
    /// How the file was written.
    pub format: MshFormat,
    /// The file that it was read from.
    pub source: PathBuf,
}
