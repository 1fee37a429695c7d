//! Why an unfinished run is in the way or cannot go on.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::files::FileError;

/// An unfinished run that is in the way or cannot go on.
#[derive(Debug, Error)]
pub enum UnfinishedError {
    /// There is none.
    #[error("{} has no checkpoint: there is no unfinished run to go on with", path.display())]
    Nothing {
        /// Folder in which it would be.
        path: PathBuf,
    },
    /// There is one, and another is to begin.
    #[error("{} holds an unfinished run", path.display())]
    InTheWay {
        /// Its folder.
        path: PathBuf,
    },
    /// It was begun with something else.
    #[error("the run in {} was begun with something else: {}", path.display(), changes.join("; "))]
    Changed {
        /// Its folder.
        path: PathBuf,
        /// What was and what is.
        changes: Vec<String>,
    },
    /// Everything that was read is the same, and what was computed from it is not.
    #[error(
        "the model is not to the last bit that of the unfinished run: expected the same program and linear algebra libraries on the same kind of processor"
    )]
    Model,
    /// A file that is no whole checkpoint.
    #[error("{} is no whole checkpoint: {what}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What was found.
        what: String,
    },
    /// The checkpoint cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The folder cannot be made or removed.
    #[error("cannot make or remove the folder {}: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

impl UnfinishedError {
    /// What to do with a run that cannot go on.
    pub(crate) const ANEW: &'static str = "begin anew with --force";

    /// What to do about it.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Nothing { .. } => Some("leave --resume out to begin a run".to_owned()),
            Self::InTheWay { .. } => Some("go on with --resume, or give it up and begin anew with --force".to_owned()),
            Self::Changed { .. } => Some(format!("go on with what it was begun with, or {}", Self::ANEW)),
            Self::Model | Self::Damaged { .. } => Some(Self::ANEW.to_owned()),
            Self::File(_) | Self::Folder { .. } => None,
        }
    }

    /// Whether the input is to blame, rather than the file system.
    pub(crate) fn is_input(&self) -> bool {
        !matches!(self, Self::File(_) | Self::Folder { .. })
    }
}
