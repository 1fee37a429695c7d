//! Reading gmsh's MSH 4.1 and 2.2, ASCII and binary.
//!
//! One pass over the bytes reads the values and checks them where they stand; the line of what it objects to
//! is counted when a message needs it. mshio reads the entities of MSH 4.1 (which physical groups each
//! belongs to); the tests hold it against all values of the meshes, as an independent reader. Alone it
//! would read 4.1 only, drop node tags where their range is dense (wrong coordinates if they are not in
//! order), accept coordinates that are no numbers and tags that lead nowhere, and take several times as long.
//!
//! No file, damaged or not, takes more memory than ten times its length and a fixed 64 KiB: nothing is
//! allocated on the word of a count that the rest of the file cannot hold.

mod build;
mod collect_v22;
mod cursor;
mod elements;
mod elements_v22;
mod entities;
mod error;
mod header;
mod membership;
mod names;
mod nodes;
mod numbers;
mod repeated;
mod sections;
mod tags;
#[cfg(test)]
mod tests;

use std::path::Path;

use super::{Mesh, MeshError, MshFormat};
use crate::numerics::units::LengthUnit;

pub use error::{MshError, Place};

impl Mesh {
    /// Reads a gmsh mesh, MSH 4.1 or 2.2, ASCII or binary; `unit` is that of its coordinates.
    ///
    /// Sections that are not needed (`$Periodic`, `$NodeData`, comments, unknown ones) are passed over.
    /// An entity may belong to several physical groups; a group without a name is called by its tag.
    /// Elements that MSH 2.2 repeats for every group of their entity become one element of all of them.
    /// Groups of a plane mesh whose elements all run clockwise are turned.
    ///
    /// # Errors
    /// [`MeshError::Read`] if the file cannot be read, [`MeshError::Gmsh`] with section, place, what was
    /// found and what was expected if its content cannot be used.
    pub fn read_gmsh(path: &Path, unit: LengthUnit) -> Result<Self, MeshError> {
        let bytes = crate::files::read(path).map_err(|cause| MeshError::Read { path: path.to_path_buf(), cause })?;
        Self::from_gmsh_bytes(bytes, path, unit)
    }

    /// The same from the content of a file; `path` is what messages call it.
    ///
    /// # Errors
    /// [`MeshError::Gmsh`], as from [`Self::read_gmsh`].
    pub fn from_gmsh_bytes(bytes: impl AsRef<[u8]>, path: &Path, unit: LengthUnit) -> Result<Self, MeshError> {
        let found = sections::read(bytes.as_ref(), unit.to_metres());
        // blocks and groups can have this room
        drop(bytes);
        mesh(found, path)
    }
}

fn mesh(found: Result<(MshFormat, sections::Found), MshError>, path: &Path) -> Result<Mesh, MeshError> {
    let mut mesh = found
        .and_then(|(format, found)| build::mesh(found.complete(format)?, path))
        .map_err(|fault| MeshError::Gmsh { path: path.to_path_buf(), fault })?;
    mesh.turn_clockwise();
    Ok(mesh)
}
