//! Reading the mesh of an input file of Abaqus or CalculiX (`.inp`; cgx calls the same `.msh`).
//!
//! Read are nodes, elements, sets and surfaces of the model data, those of one instance in a file of Abaqus/CAE. Of what
//! follows `*STEP` the first step's `*BOUNDARY` is looked at alone. Materials and supports are notes for the case. A
//! surface, or a node set that covers whole faces, becomes a group of faces; any other node set a group of points; an
//! element set a group of its elements.
//!
//! A first pass cuts the file at its keywords; nodes, elements, sets and surfaces are read after one another, in
//! whatever order they stand. As in the reader of gmsh's files, memory is bounded by the length of the file.

mod block;
mod boundaries;
mod build;
mod deck;
mod kinds;
mod materials;
mod numbers;
mod read;
mod scope;
mod sets;
mod surfaces;
#[cfg(test)]
mod tests;

pub(crate) use kinds::{inp_face, inp_nodes};

use super::{Mesh, MeshError, MshError};
use crate::numerics::units::LengthUnit;
use std::path::Path;

impl Mesh {
    /// Reads a mesh: gmsh's MSH as [`Self::read_gmsh`], or an input file of Abaqus or CalculiX. The content says which,
    /// not the ending. `unit` is that of the coordinates.
    ///
    /// # Errors
    /// [`MeshError::Read`] if the file cannot be read; [`MeshError::Gmsh`] or [`MeshError::Inp`] with place, what was
    /// found and what was expected.
    pub fn read(path: &Path, unit: LengthUnit) -> Result<Self, MeshError> {
        let bytes = crate::files::read(path).map_err(|cause| MeshError::Read { path: path.to_path_buf(), cause })?;
        Self::from_bytes(bytes, path, unit)
    }

    /// The same from the content of a file; `path` is what messages call it.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn from_bytes(bytes: impl AsRef<[u8]>, path: &Path, unit: LengthUnit) -> Result<Self, MeshError> {
        let by_ending = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("inp"));
        let text = bytes.as_ref();
        // some editors begin a file with UTF-8's mark
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        let is_inp = match text.trim_ascii_start().first() {
            Some(b'*') => true,
            Some(b'$') => false,
            _ => by_ending,
        };
        if !is_inp {
            return Self::from_gmsh_bytes(bytes, path, unit).map_err(|error| with_converter(error, path));
        }
        let mesh = build::mesh(text, path, unit.to_metres());
        let mut mesh = mesh.map_err(|fault| MeshError::Inp { path: path.to_path_buf(), fault })?;
        mesh.turn_clockwise();
        mesh.tell_what_is_beside();
        Ok(mesh)
    }
}

/// Adds the command of gmsh to the error of a mesh in a format that gmsh converts (tried with 4.8.4).
fn with_converter(error: MeshError, path: &Path) -> MeshError {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match error {
        MeshError::Gmsh { path, fault } if ["unv", "bdf", "nas", "vtk"].contains(&ending.as_str()) => {
            let advice = format!("convert it: gmsh IN.{ending} -save -format msh22 -o OUT.msh");
            MeshError::Gmsh { path, fault: MshError(format!("{fault}; {advice}")) }
        }
        error => error,
    }
}
