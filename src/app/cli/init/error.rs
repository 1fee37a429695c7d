//! Why no case file was made.

use std::path::PathBuf;

use thiserror::Error;

use crate::app::commands::init::DraftError;
use crate::bearing::catalogue::CatalogueBearing;

/// Why no case file was made.
#[derive(Debug, Error)]
pub enum InitError {
    /// Nothing to make it from.
    #[error(transparent)]
    Draft(#[from] DraftError),
    /// A mesh that no command computes.
    #[error("{}: {what}; no case file was written", path.display())]
    Mesh {
        /// The mesh file.
        path: PathBuf,
        /// What is wrong with it.
        what: String,
        /// What to do about it.
        help: Option<String>,
    },
    /// A bearing that the catalogue lacks.
    #[error("--bearing: found \"{found}\", expected a bearing of the catalogue")]
    UnknownBearing {
        /// The designation as typed.
        found: String,
    },
    /// A file is in the way.
    #[error("{} exists", path.display())]
    Exists {
        /// The case file.
        path: PathBuf,
    },
    /// No name for the case file.
    #[error("{}: found no file name, expected that of a case file (--out FILE.toml)", path.display())]
    NoName {
        /// What was to be the case file.
        path: PathBuf,
    },
}

impl InitError {
    /// What to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Draft(error) => error.help(),
            Self::Mesh { help, .. } => help.clone(),
            Self::UnknownBearing { .. } => {
                Some(format!("names: {}; plummer init --list-bearings says their dimensions", bearing_names()))
            }
            Self::Exists { .. } => Some("replace it with --force, or name another file with --out".to_owned()),
            Self::NoName { .. } => None,
        }
    }
}

/// Every designation of the catalogue.
pub(in crate::app::cli) fn bearing_names() -> String {
    let names = CatalogueBearing::all().iter().map(|bearing| bearing.name);
    names.collect::<Vec<_>>().join(", ")
}
