//! Reading gmsh's MSH 4.1, ASCII and binary.
//!
//! Two passes. The first, our own, walks through the file number by number: it checks what the format
//! and a mesh ask for and knows the line of everything it objects to. The second, mshio, reads the
//! values from the sections that have passed; it alone would drop node tags where their range is dense
//! (wrong coordinates if they are not in order), overflow on a section that announces no
//! items, and accept coordinates that are no numbers and tags that lead nowhere.

mod build;
mod cursor;
mod error;
mod header;
mod names;
mod sections;
#[cfg(test)]
mod tests;
mod walk;

use std::path::Path;

use super::{Mesh, MeshError};
use crate::units::LengthUnit;

pub use error::{MshError, Place};

impl Mesh {
    /// Reads a gmsh mesh, MSH 4.1, ASCII or binary; `unit` is that of its coordinates.
    ///
    /// Sections that are not needed (`$Periodic`, `$NodeData`, comments, unknown ones) are passed over.
    /// An entity may belong to several physical groups; a group without a name is called by its tag.
    ///
    /// # Errors
    /// [`MeshError::Read`] if the file cannot be read, [`MeshError::Gmsh`] with section, place, what was
    /// found and what was expected if its content cannot be used.
    pub fn read_gmsh(path: &Path, unit: LengthUnit) -> Result<Self, MeshError> {
        let bytes = std::fs::read(path).map_err(|cause| MeshError::Read {
            path: path.to_path_buf(),
            cause,
        })?;
        parse(&bytes, path, unit).map_err(|fault| MeshError::Gmsh {
            path: path.to_path_buf(),
            fault,
        })
    }
}

fn parse(bytes: &[u8], path: &Path, unit: LengthUnit) -> Result<Mesh, MshError> {
    build::mesh(sections::scan(bytes)?, path, unit)
}
