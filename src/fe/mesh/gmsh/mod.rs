//! Reading gmsh's MSH 2.0 to 2.2, 4.0 and 4.1, ASCII and binary.
//!
//! One pass over the bytes reads the values and checks them where they stand; the line of what it objects to
//! is counted when a message needs it. mshio reads the entities of MSH 4.1 (which physical groups each belongs to);
//! the tests hold it against all values of the meshes, as an independent reader. Alone it would read 4.1 only, drop
//! node tags where their range is dense (wrong coordinates if they are not in order), accept coordinates that are no
//! numbers and tags that lead nowhere, and take several times as long.
//!
//! No file, damaged or not, takes more memory than ten times its length and a fixed 64 KiB: nothing is
//! allocated on the word of a count that the rest of the file cannot hold.

mod build;
mod collect_v22;
mod cursor;
mod elements;
mod entities;
mod nodes;
mod numbers;
mod sections;
#[cfg(test)]
mod tests;
mod write;

pub(super) use build::Allowance;
pub(super) use cursor::{quoted, short};
pub(super) use numbers::NodeIndex;
pub use write::{Cells, EntityGroup, MeshParts};

use super::MshError;
