//! What can be wrong with a mesh.

use std::path::PathBuf;

use thiserror::Error;

/// Content of an MSH file that cannot be used: the section, the line (byte of a binary file), what was found and what was
/// expected.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct MshError(pub(super) String);

/// A mesh that cannot be read, or a name that it does not have.
#[derive(Debug, Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("cannot read the mesh {}: {cause}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// The file can be read, its content cannot be used.
    #[error("{}: {fault}", path.display())]
    Gmsh {
        /// The file.
        path: PathBuf,
        /// What is wrong, in which section and line.
        fault: MshError,
    },
    /// No physical group of this name.
    #[error("{} has no physical group \"{name}\"{}", path.display(), known_names(nearest.as_deref(), known))]
    UnknownGroup {
        /// The file.
        path: PathBuf,
        /// The name asked for.
        name: String,
        /// The most similar name, if there are any.
        nearest: Option<String>,
        /// All names, in the order of the mesh's groups.
        known: Vec<String>,
    },
    /// Several physical groups of this name.
    #[error(
        "{} has {} physical groups \"{name}\" (dimension, tag: {}): rename all but one in gmsh",
        path.display(), groups.len(), pairs(groups)
    )]
    AmbiguousGroup {
        /// The file.
        path: PathBuf,
        /// The name asked for.
        name: String,
        /// Dimension and tag of each of them.
        groups: Vec<[i32; 2]>,
    },
    /// A physical group without elements: whatever refers to it would have no effect.
    #[error("{}: the physical group \"{name}\" has no elements: expected at least one", path.display())]
    EmptyGroup {
        /// The file.
        path: PathBuf,
        /// Its name.
        name: String,
    },
}

fn known_names(nearest: Option<&str>, known: &[String]) -> String {
    match nearest {
        None => "; it has none at all (define Physical groups in gmsh)".to_owned(),
        Some(nearest) => {
            let names: Vec<String> = known.iter().map(|name| format!("\"{name}\"")).collect();
            format!("; nearest is \"{nearest}\", it has {}", names.join(", "))
        }
    }
}

fn pairs(groups: &[[i32; 2]]) -> String {
    let pairs: Vec<String> = groups.iter().map(|[d, t]| format!("({d}, {t})")).collect();
    pairs.join(", ")
}
