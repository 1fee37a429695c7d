//! Why a sweep cannot be planned, or not go on.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::AxisProblem;
use crate::app::case::CaseError;
use crate::app::error::ComputeError;
use crate::formats::FormatError;

/// Why a sweep cannot be planned, or not go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// No key is varied.
    #[error("nothing is varied: expected at least one --vary KEY=VALUES")]
    NothingVaried,
    /// A `--vary` argument says nothing.
    #[error("--vary {argument}: {problem}")]
    Axis {
        /// As written.
        argument: String,
        /// What is wrong with it.
        problem: AxisProblem,
    },
    /// A key is varied twice.
    #[error("--vary {key}: the key is varied twice")]
    Twice {
        /// The key.
        key: String,
    },
    /// A key is varied whose value is given as well.
    #[error("--vary {key}: --set {set} gives the same key one value")]
    SetAndVaried {
        /// The key.
        key: String,
        /// The `KEY=VALUE` argument.
        set: String,
    },
    /// No point is a valid case.
    #[error("no point of the sweep is a valid case; point {number}: {source}")]
    NoCase {
        /// The first of them, from 1.
        number: usize,
        /// What is wrong with it.
        source: Box<CaseError>,
    },
    /// There are too many points.
    #[error("the product of all --vary has more than {most} points")]
    TooMany {
        /// How many there may be.
        most: usize,
    },
    /// The folder holds a sweep.
    #[error("{} holds a sweep", folder.display())]
    InTheWay {
        /// The folder for the results.
        folder: PathBuf,
    },
    /// The folder holds no sweep.
    #[error("{} holds no sweep: there is no plan {}", folder.display(), plan.display())]
    NoPlan {
        /// The folder.
        folder: PathBuf,
        /// The file that is missing.
        plan: PathBuf,
    },
    /// The plan cannot be understood.
    #[error("{} is no plan of a sweep: {message}", plan.display())]
    Plan {
        /// The file.
        plan: PathBuf,
        /// The parser's reason.
        message: String,
    },
    /// The sweep in the folder is another one.
    #[error("the sweep in {} was begun with something else: {}", folder.display(), changes.join("; "))]
    Changed {
        /// The folder for the results.
        folder: PathBuf,
        /// What is not the same now.
        changes: Vec<String>,
    },
    /// A point's folder holds the result of another one.
    #[error("{} is not the result of point {number}: expected {}, found {}", file.display(), sets(expected), sets(found))]
    OtherPoint {
        /// The result.
        file: PathBuf,
        /// The point, from 1.
        number: usize,
        /// Arguments of the point.
        expected: Vec<String>,
        /// Arguments of the result.
        found: Vec<String>,
    },
    /// A mesh of the case cannot be read, or the report's contents do not fit together.
    #[error(transparent)]
    Stage(Box<ComputeError>),
    /// The archive of the table cannot be written.
    #[error(transparent)]
    Npz(#[from] FormatError),
    /// A file or folder of the sweep cannot be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which one.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

fn sets(set: &[String]) -> String {
    set.iter().map(|set| format!("--set {set}")).collect::<Vec<_>>().join(" ")
}

impl From<ComputeError> for SweepError {
    fn from(error: ComputeError) -> Self {
        Self::Stage(Box::new(error))
    }
}

impl SweepError {
    /// Whether the input is to blame.
    #[must_use]
    pub(crate) fn is_input(&self) -> bool {
        match self {
            Self::Stage(error) => error.is_input(),
            Self::Io { .. } | Self::Npz(_) => false,
            _ => true,
        }
    }

    /// Returns what to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::NothingVaried | Self::Axis { .. } => Some(
                "for example: --vary bearing.radial_play=1e-6,2e-6, --vary 'bearing.defects[0].depth=5e-6:20e-6:4' or --vary ring.supports.0.spring.y=1e4:1e7:4:log"
                    .to_owned(),
            ),
            Self::Twice { .. } => Some("put all its values into one --vary".to_owned()),
            Self::SetAndVaried { .. } => Some("leave one of the two out".to_owned()),
            Self::NoCase { source, .. } => source.help(),
            Self::TooMany { .. } => Some("fewer values, or several sweeps".to_owned()),
            Self::InTheWay { .. } => Some(
                "go on with --resume, replace it with --force, or choose another folder with --out"
                    .to_owned(),
            ),
            Self::NoPlan { .. } => {
                Some("name the folder that `plummer sweep CASE.toml --vary ...` wrote".to_owned())
            }
            Self::Changed { .. } => Some(
                "go on with what it was begun with, or begin anew with --force".to_owned(),
            ),
            Self::OtherPoint { file, .. } => Some(format!(
                "remove the folder {} and compute the point again with --resume",
                file.parent().unwrap_or(file).display()
            )),
            Self::Stage(error) => error.help(),
            Self::Plan { .. } | Self::Npz(_) | Self::Io { .. } => None,
        }
    }
}
