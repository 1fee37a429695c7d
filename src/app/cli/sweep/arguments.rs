//! What `plummer sweep` takes.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::super::share::{Share, share};

use crate::app::studies::sweep::SweptCommand;

/// What is varied, what is computed at each point, and by whom.
#[derive(Debug, Clone, Args)]
pub struct SweepArguments {
    /// Case file (TOML); with --task or --merge the folder with the sweep
    #[arg(value_name = "CASE|DIR")]
    pub from: PathBuf,
    /// Key and its values: KEY=A,B,C, KEY=FROM:TO:COUNT or KEY=FROM:TO:COUNT:log; several keys make a grid of all their values
    #[arg(long, value_name = "KEY=VALUES", required_unless_present_any = ["task", "merge"])]
    pub vary: Vec<String>,
    /// What is computed at each point
    #[arg(long, value_enum, default_value_t, hide_default_value = true)]
    pub command: SweptCommand,
    /// Go on with the sweep in the folder for the results: finished points stay, unfinished runs go on
    #[arg(long, conflicts_with = "slurm")]
    pub resume: bool,
    /// Only write job scripts for Slurm, an array of so many tasks (default: one for each point, at most 1000)
    #[arg(long, value_name = "TASKS", num_args = 0..=1, require_equals = true)]
    pub slurm: Option<Option<NonZeroUsize>>,
    /// Compute the points K, K+N, K+2N, ... of the sweep in the folder, as a task of the job array does
    #[arg(long, value_name = "K/N", value_parser = share, conflicts_with_all = ["vary", "command", "resume", "slurm", "merge"])]
    pub task: Option<Share>,
    /// Only make the table of the sweep in the folder, from the points that are there
    #[arg(long, conflicts_with_all = ["vary", "command", "resume", "slurm"])]
    pub merge: bool,
}

impl ValueEnum for SweptCommand {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self::Run, Self::Modes]
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        let help = match self {
            Self::Run => "Run-up transient, as `plummer run` (default)",
            Self::Modes => "Eigenfrequencies, as `plummer modes`",
        };
        Some(clap::builder::PossibleValue::new(self.name()).help(help))
    }
}
