//! Meshes with named parts: read from gmsh, Abaqus or CalculiX, checked, in metres.
//!
//! [`Mesh::read`] is the way in. It refuses what later stages could not survive (coordinates
//! that are no numbers, tags used twice, elements on nodes that do not exist) and says in which file,
//! section and line, what was found and what was expected. Nodes and elements are indices from 0 into
//! the mesh's own lists; gmsh's tags are kept beside for messages and for export.
//!
//! # Limitations
//! MSH 2.0 to 2.2, 4.0 and 4.1 (others are refused with gmsh's command for converting them); elements of first and
//! second order without nodes inside faces and volumes, no pyramids.

mod contents;
pub(crate) mod cylinder;
mod error;
mod faces;
mod gmsh;
mod inp;
mod inventory;
mod kind;

pub use contents::{ElementBlock, ElementId, Entity, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup};
pub use error::{MeshError, MshError};
pub use faces::{BoundaryFace, Face};
pub(crate) use faces::{sorted_corners, sorted_faces};
pub(crate) use inp::{inp_face, inp_nodes};
pub(crate) use inventory::Sets;
pub use inventory::{BoundingBox, DuplicateNodes, GroupOverlap, GroupSummary, Inventory, KindCount, Part, UnusedNodes};
pub use kind::ElementKind;
