//! Meshes with named parts: read from gmsh, Abaqus or CalculiX, checked, in metres.
//!
//! [`Mesh::read`] is the way in. It refuses what later stages could not survive (coordinates
//! that are no numbers, tags used twice, elements on nodes that do not exist) and says in which file,
//! section and line, what was found and what was expected. Nodes and elements are indices from 0 into
//! the mesh's own lists; gmsh's tags are kept beside for messages and for export.
//!
//! # Limitations
//! MSH 2.0 to 2.2, 4.0 and 4.1 (others are refused with gmsh's command for converting them); elements of first and
//! second order.

mod contents;
pub(crate) mod cylinder;
mod deck_case;
mod entity_groups;
mod error;
mod faces;
mod gmsh;
mod inp;
mod inventory;
mod kind;
mod left_out;
mod rim;
pub(crate) mod surfaces;

pub use contents::{
    ElementBlock, ElementId, Entity, LeftOut, Mesh, MeshNote, MeshNotes, MshFormat, MshVersion, PhysicalGroup,
};
pub(crate) use deck_case::ConsistentUnits;
pub use deck_case::{DeckMaterial, DeckSupport};
pub(crate) use entity_groups::entity_name;
pub use error::{MeshError, MshError};
pub use faces::{BoundaryFace, Face};
pub(crate) use faces::{sorted_corners, sorted_faces};
pub use gmsh::{Cells, EntityGroup, MeshParts};
pub(crate) use inp::{inp_face, inp_nodes};
pub(crate) use inventory::Sets;
pub use inventory::{BoundingBox, DuplicateNodes, GroupOverlap, GroupSummary, Inventory, KindCount, Part, UnusedNodes};
pub use kind::ElementKind;
pub(crate) use rim::Rim;
