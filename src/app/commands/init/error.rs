//! Why a mesh makes no case file.

use std::path::PathBuf;

use thiserror::Error;

use crate::fe::mesh::MeshError;

/// Why a mesh makes no case file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DraftError {
    /// The mesh cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// No group that could be a part.
    #[error("{}: found no physical group of {what} that a part could be made of", path.display())]
    NoPart {
        /// The mesh file.
        path: PathBuf,
        /// "volumes" or "surfaces".
        what: &'static str,
    },
    /// A mesh of curves or points.
    #[error("{}: found a mesh of curves or points, expected surfaces or volumes", path.display())]
    NoHousing {
        /// The mesh file.
        path: PathBuf,
    },
    /// A plane mesh that is not in the plane of x and y.
    #[error("{}: found a mesh of surfaces over {height:e} units of z, expected one in a plane z = const, or volumes", path.display())]
    Shell {
        /// The mesh file.
        path: PathBuf,
        /// Its extent along z, in the mesh's unit.
        height: f64,
    },
    /// A bearing that does not sit in the bore.
    #[error(
        "bearing {bearing}: found an outer diameter of {outer_mm:.4} mm, expected that of the bore \"{group}\", {bore_mm:.4} mm, within 1 %"
    )]
    BearingSize {
        /// Its designation.
        bearing: &'static str,
        /// Its outer diameter, mm.
        outer_mm: f64,
        /// Group of the bore.
        group: String,
        /// The bore's diameter, mm.
        bore_mm: f64,
        /// What the catalogue has for this bore, in words.
        nearest: String,
    },
}

impl DraftError {
    /// What to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Mesh(_) => None,
            Self::NoPart { what, .. } => {
                let word = if *what == "volumes" { "Volume" } else { "Surface" };
                Some(format!(
                    "name it in gmsh, Physical {word}(\"housing\") = {{...}};, and save the mesh again; plummer inspect shows what is there"
                ))
            }
            Self::NoHousing { .. } => Some("mesh the volume in gmsh (Mesh 3;) and save it again".to_owned()),
            Self::Shell { .. } => Some("shells are not modelled: mesh the volume in gmsh (Mesh 3;)".to_owned()),
            Self::BearingSize { nearest, .. } => {
                Some(format!("{nearest}; is --length-unit right? plummer init --list-bearings lists the catalogue"))
            }
        }
    }
}
