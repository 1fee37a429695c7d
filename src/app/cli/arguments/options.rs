//! Options of every command, and the command line as it was typed.

use crate::app::program;
use crate::app::shell_word::shell_word;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Most threads: more than any machine that the program is for has cores.
const MOST_THREADS: usize = 1024;

fn number_of_threads(text: &str) -> Result<NonZeroUsize, String> {
    let number = text.parse().ok().filter(|number: &NonZeroUsize| number.get() <= MOST_THREADS);
    number.ok_or_else(|| format!("expected a whole number from 1 to {MOST_THREADS}"))
}

/// Options that every command takes.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Options of every command")]
pub struct Options {
    /// Folder for the results (default: one of its own in out/)
    #[arg(long, global = true, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads (default, and at most: all cores)
    #[arg(long, global = true, allow_hyphen_values = true, value_name = "N", value_parser = number_of_threads)]
    pub threads: Option<NonZeroUsize>,
    /// Print errors only, no progress and no summary
    #[arg(long, global = true)]
    pub quiet: bool,
    /// Print the result as JSON instead of the summary
    #[arg(long, global = true)]
    pub json: bool,
    /// Replace results of another case, and give up an unfinished run
    #[arg(long, global = true)]
    pub force: bool,
    /// Folder that keeps condensed housings for the next command (default: cache/ in the folder for the results)
    #[arg(long, global = true, value_name = "DIR", conflicts_with = "no_cache")]
    pub cache: Option<PathBuf>,
    /// Condense anew, and keep nothing
    #[arg(long, global = true)]
    pub no_cache: bool,
    /// Set a key of the case, as bearing.balls=8 or bearing.defects.0.depth=2e-5; can be repeated. `analyze` takes report.title,
    /// .customer, .project, .author and .remark without a case too
    #[arg(long, global = true, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl Options {
    /// Number of threads that compute: as many as asked for, no more than cores that this process may use; by default those.
    #[must_use]
    pub(crate) fn cores(&self) -> usize {
        let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.threads.map_or(cores, |asked| asked.get().min(cores))
    }

    /// Returns whether progress may be shown at all.
    #[must_use]
    pub(crate) fn shows_progress(&self) -> bool {
        !self.quiet && !self.json
    }

    /// The folder that keeps condensed housings beside results in `folder`; `None`: nothing is kept.
    pub(crate) fn cache_in(&self, folder: &Path) -> Option<PathBuf> {
        let beside = || folder.join("cache");
        (!self.no_cache).then(|| self.cache.clone().unwrap_or_else(beside))
    }
}

/// The command line as it was typed, without options that the result does not depend on.
pub(crate) fn typed() -> String {
    let words = program::arguments().into_iter().map(|word| word.to_string_lossy().into_owned());
    without_manner(words)
}

pub(super) fn without_manner(mut words: impl Iterator<Item = String>) -> String {
    let mut line = "plummer".to_owned();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--force" | "--resume" | "--quiet" | "--json" | "--no-cache" => {}
            "--threads" | "--cache" | "--checkpoint-every" => drop(words.next()),
            other if ["--threads=", "--cache=", "--checkpoint-every="].iter().any(|name| other.starts_with(name)) => {}
            other => line = format!("{line} {}", shell_word(other)),
        }
    }
    line
}
