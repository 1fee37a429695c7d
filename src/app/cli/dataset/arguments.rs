//! What `plummer dataset` takes.

use super::super::share::{Share, share};
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// What is computed, how much of it, and by whom.
#[derive(Debug, Clone, Args)]
pub struct DatasetArguments {
    /// Specification (TOML); with --task or --merge the folder with the data set
    #[arg(value_name = "SPEC|DIR")]
    pub from: PathBuf,
    /// Number of signals (default: that of the specification)
    #[arg(long, value_name = "N")]
    pub count: Option<NonZeroUsize>,
    /// Go on with the data set in the folder for the results; a larger --count makes it larger
    #[arg(long, conflicts_with = "slurm")]
    pub resume: bool,
    /// Only write job scripts for Slurm, an array of so many tasks (default: one for each file, at most 1000)
    #[arg(long, value_name = "TASKS", num_args = 0..=1, require_equals = true)]
    pub slurm: Option<Option<NonZeroUsize>>,
    /// Compute the files K, K+N, K+2N, ... of the data set in the folder, as a task of the job array does
    #[arg(long, value_name = "K/N", value_parser = share, conflicts_with_all = ["count", "resume", "slurm", "merge"])]
    pub task: Option<Share>,
    /// Only write the manifest of the data set in the folder
    #[arg(long, conflicts_with_all = ["count", "resume", "slurm"])]
    pub merge: bool,
}
