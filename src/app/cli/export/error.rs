//! What can go wrong with an export, and whose fault it is.

use std::path::PathBuf;

use thiserror::Error;

use crate::files::{Fault, FileError};
use crate::formats::FormatError;

/// Why something was not exported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// A case with nothing to condense.
    #[error(
        "--to {format} writes a condensed housing: expected [housing] with a mesh, and ring.tie or condense.interface, found \
         {found}"
    )]
    NothingCondensed {
        /// The format.
        format: &'static str,
        /// What the case has instead.
        found: &'static str,
    },
    /// A case that puts modes in the place of an interface.
    #[error(
        "--to {format} writes the displacements of an interface, by which others attach it: expected \
         condense.interface_modes = \"none\", found modes in their place"
    )]
    InterfaceModes {
        /// The format.
        format: &'static str,
    },
    /// Keys set for results that are computed already.
    #[error("--set changes the case, but {} holds results of it as it was", folder.display())]
    SetForResults {
        /// The folder.
        folder: PathBuf,
    },
    /// Mode shapes of another model.
    #[error("{} does not fit the case: expected {expected}, found {found}", path.display())]
    DoesNotFit {
        /// The file with the shapes.
        path: PathBuf,
        /// What the case has.
        expected: String,
        /// What the file has.
        found: String,
    },
    /// No modes, or some that contradict themselves.
    #[error("mode shapes: {0}")]
    Shapes(#[from] Fault),
    /// Mode shapes that cannot be read.
    #[error(transparent)]
    Read(FormatError),
    /// A file that cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Data that a format does not hold, or a file of it that cannot be written.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The data of a modal element.
    #[error("--to mbdyn: {0}")]
    Mbdyn(FormatError),
}

impl ExportError {
    /// Whether the input is wrong, rather than writing failed.
    #[must_use]
    pub(crate) fn is_input(&self) -> bool {
        !matches!(
            self,
            Self::File(_)
                | Self::Format(FormatError::File(FileError::Write { .. }))
                | Self::Mbdyn(FormatError::File(_) | FormatError::Eigen(_))
        )
    }

    /// What to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        let text = match self {
            Self::SetForResults { .. } => "name the case file to compute it again".to_owned(),
            Self::DoesNotFit { .. } | Self::Read(_) => {
                "run `plummer modes` again with --force, or name the case file".to_owned()
            }
            Self::NothingCondensed { .. } => "--to mtx and --to npz write matrices that are not condensed".to_owned(),
            Self::InterfaceModes { .. } => {
                "--set 'condense.interface_modes=\"none\"'; superelement.npz of `plummer condense` has the modes"
                    .to_owned()
            }
            Self::Mbdyn(FormatError::RigidMotions { .. }) => {
                "MBDyn's bodies are solid: a housing that is free in space, or held by its supports".to_owned()
            }
            Self::Shapes(_) => "ask for more modes in [modes]".to_owned(),
            _ => return None,
        };
        Some(text)
    }
}
