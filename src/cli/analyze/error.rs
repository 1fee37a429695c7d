//! What an analysis lacks.

use std::path::PathBuf;

use thiserror::Error;

use crate::cli::init::bearing_names;

/// Why there is nothing to analyse, or nothing to analyse it by.
#[derive(Debug, Error)]
pub enum AnalyzeError {
    /// A folder without a run.
    #[error("{} has no run.json and signals.npz: expected a folder with results of `plummer run`, or a file of signals", folder.display())]
    NoRun {
        /// The folder.
        folder: PathBuf,
    },
    /// A run's result that does not say its case.
    #[error("{}: expected the result of `plummer run`, with the path of its case, found {found}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What it has.
        found: String,
    },
    /// A case without a bearing.
    #[error("{}: expected a case with [bearing], found none", path.display())]
    CaseWithoutBearing {
        /// The case file.
        path: PathBuf,
    },
    /// A name that is neither a file's nor a bearing's.
    #[error("--bearing: found \"{found}\", expected a case file or a bearing of the catalogue")]
    UnknownBearing {
        /// As typed.
        found: String,
    },
    /// Nothing says how often parts strike.
    #[error("nothing says which bearing it is")]
    NoBearing,
    /// Nothing says how fast the shaft turns.
    #[error("nothing says how fast the shaft turns")]
    NoSpeed,
}

impl AnalyzeError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        match self {
            Self::NoBearing => Some(
                "--bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=..".to_owned(),
            ),
            Self::UnknownBearing { .. } => Some(format!("bearings: {}", bearing_names())),
            Self::NoSpeed => Some("--speed HZ, or --speed T:HZ,T:HZ,...".to_owned()),
            Self::Damaged { .. } => Some(
                "name the file of signals itself, with --bearing and --speed".to_owned(),
            ),
            Self::NoRun { .. } | Self::CaseWithoutBearing { .. } => None,
        }
    }
}
