//! What `plummer sweep` takes.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

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

/// One of several equal shares of the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Share {
    /// Which one, from 1.
    pub number: usize,
    /// Of how many.
    pub of: usize,
}

impl Share {
    /// All points.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Whether a point belongs to it.
    #[must_use]
    pub(crate) fn has(self, point: usize) -> bool {
        point % self.of == self.number % self.of
    }
}

/// K/N with K from 1 to N.
fn share(text: &str) -> Result<Share, String> {
    let parts = text.split_once('/');
    let numbers = parts.map(|(number, of)| (number.parse(), of.parse()));
    match numbers {
        Some((Ok(number), Ok(of))) if 1 <= number && number <= of => Ok(Share { number, of }),
        _ => Err(format!("expected K/N with K from 1 to N, found \"{text}\"")),
    }
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

#[cfg(test)]
mod tests {
    use super::{Share, share};

    #[test]
    fn shares_have_every_point_once() {
        for of in 1..5 {
            for point in 1..20 {
                let has = (1..=of).filter(|&number| Share { number, of }.has(point));
                assert_eq!(has.count(), 1, "{point} of {of}");
            }
        }
        assert!(Share { number: 2, of: 3 }.has(2) && Share { number: 3, of: 3 }.has(6));
        for wrong in ["0/2", "3/2", "1", "1/", "a/b", "1/0", "-1/2"] {
            let message = share(wrong).unwrap_err();
            assert!(message.contains("expected K/N with K from 1 to N"), "{message}");
        }
    }
}
