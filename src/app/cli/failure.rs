//! Why a command did not end well: exit code, message, what to do.

use std::io::{self, Write};
use std::path::PathBuf;

use thiserror::Error;

use super::{AnalyzeError, ExportError, InitError, ResultsError};
use crate::app::case::CaseError;
use crate::app::error::ComputeError;
use crate::app::shell_word::printable;
use crate::files::FileError;

/// Why a command did not end well.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CliError {
    /// The case file or a `--set` argument is wrong.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// `--set` beside a command that reads no case.
    #[error("--set {argument}: `plummer {command}` reads no case that it could change")]
    SetWithoutCase {
        /// The first argument.
        argument: String,
        /// The command.
        command: &'static str,
    },
    /// A `--set` argument that a later one replaces.
    #[error("--set {later} replaces --set {earlier}: expected each key once")]
    SetTwice {
        /// The argument of which nothing would be left.
        earlier: String,
        /// The one that replaces it.
        later: String,
    },
    /// The folder holds a result of the same command.
    #[error("{} is the result of an earlier run", path.display())]
    ResultExists {
        /// The result file.
        path: PathBuf,
    },
    /// Another process writes into the folder.
    #[error("another plummer writes into {}", path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// Earlier results that cannot be used.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// The run that is to go on has ended.
    #[error("{} is the result of a finished run: there is nothing to go on with", path.display())]
    Finished {
        /// The result file.
        path: PathBuf,
    },
    /// A run cannot go on and begin anew.
    #[error("--resume goes on with a run, --force begins it anew: expected one of them, found both")]
    ResumeAnew,
    /// The command was asked to stop and can go on.
    #[error("{what}; {kept} in {}", folder.display())]
    Interrupted {
        /// How far it came.
        what: String,
        /// What it left, with a verb.
        kept: &'static str,
        /// The folder with that.
        folder: PathBuf,
        /// The command line that goes on.
        command: String,
    },
    /// Signals of the system cannot be caught.
    #[error("cannot catch interrupts: {0}")]
    Signals(#[source] io::Error),
    /// The threads that compute cannot be started.
    #[error("the threads that compute cannot be started: {0}")]
    Threads(String),
    /// The folder for the results cannot be made.
    #[error("cannot make the folder {}: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A result cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Standard output cannot be written, for another reason than a closed pipe.
    #[error("cannot write to standard output: {0}")]
    StandardOutput(#[source] io::Error),
    /// The computation ended and its answer is bad; its results are written.
    #[error("{what}")]
    BadAnswer {
        /// What is bad, where and when.
        what: String,
        /// What to try.
        help: Option<String>,
    },
    /// Some of many inputs, or all of them, are wrong; the results of the others are written.
    #[error("{what}")]
    WrongInput {
        /// Which, and what is wrong with it.
        what: String,
        /// What to try.
        help: Option<String>,
    },
    /// A stage of the computation failed, by its input or by itself.
    #[error(transparent)]
    Stage(Box<ComputeError>),
    /// Something was not exported.
    #[error(transparent)]
    Export(Box<ExportError>),
    /// There is nothing to analyse, or nothing to analyse it by.
    #[error(transparent)]
    Analyze(#[from] AnalyzeError),
    /// No case file could be made.
    #[error(transparent)]
    Init(Box<InitError>),
    /// A built-in check could not be carried out.
    #[error(transparent)]
    Verification(Box<dyn std::error::Error + Send + Sync>),
}

impl From<InitError> for CliError {
    fn from(error: InitError) -> Self {
        Self::Init(Box::new(error))
    }
}

impl From<ExportError> for CliError {
    fn from(error: ExportError) -> Self {
        Self::Export(Box::new(error))
    }
}

impl From<ComputeError> for CliError {
    fn from(error: ComputeError) -> Self {
        Self::Stage(Box::new(error))
    }
}

impl CliError {
    /// Returns the program's exit code: 2 when the input is to blame, 1 otherwise.
    #[must_use]
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Case(_)
            | Self::Analyze(_)
            | Self::Init(_)
            | Self::WrongInput { .. }
            | Self::ResultExists { .. }
            | Self::Busy { .. }
            | Self::Results(_)
            | Self::Folder { .. }
            | Self::Finished { .. }
            | Self::SetWithoutCase { .. }
            | Self::SetTwice { .. }
            | Self::ResumeAnew => 2,
            Self::Stage(error) if error.is_input() => 2,
            Self::Export(error) if error.is_input() => 2,
            Self::File(_)
            | Self::StandardOutput(_)
            | Self::BadAnswer { .. }
            | Self::Interrupted { .. }
            | Self::Signals(_)
            | Self::Stage(_)
            | Self::Export(_)
            | Self::Threads(_)
            | Self::Verification(_) => 1,
        }
    }

    /// Returns what to do about it.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Case(error) => error.help(),
            Self::Stage(error) => error.help(),
            Self::Export(error) => error.help(),
            Self::Analyze(error) => error.help(),
            Self::Init(error) => error.help(),
            Self::Busy { .. } => Some("wait for its end, or choose another folder with --out".to_owned()),
            Self::Results(error) => error.help(),
            Self::ResultExists { .. } => {
                Some("replace it with --force, or choose another folder with --out".to_owned())
            }
            Self::Finished { .. } => Some("leave --resume out, and begin anew with --force".to_owned()),
            Self::Interrupted { command, .. } => Some(format!("go on with: {command}")),
            Self::Folder { .. } => Some("choose another folder with --out".to_owned()),
            Self::SetWithoutCase { .. } => {
                Some("leave it out; the command has options of its own, which --help lists".to_owned())
            }
            Self::SetTwice { .. } => Some("leave one of the two out".to_owned()),
            Self::BadAnswer { help, .. } | Self::WrongInput { help, .. } => help.clone(),
            Self::Threads(_) => Some(
                "use fewer with --threads, or raise the limits of memory and threads (ulimit -v, ulimit -u)".to_owned(),
            ),
            Self::File(_) | Self::StandardOutput(_) | Self::ResumeAnew | Self::Signals(_) | Self::Verification(_) => {
                None
            }
        }
    }

    /// Writes the lines `error: ...` and, for each thing that can be done, `help: ...`. Nothing can be done about a failure
    /// to write them.
    pub(crate) fn report(&self, to: &mut impl Write) {
        let _ = writeln!(to, "error: {}", printable(&self.to_string()));
        for line in self.help().iter().flat_map(|help| help.lines()) {
            let _ = writeln!(to, "help: {}", printable(line));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io;
    use std::path::PathBuf;

    use super::super::analyze::Missing;
    use super::{AnalyzeError, CliError, ExportError, InitError, ResultsError};
    use crate::app::case::Case;
    use crate::app::error::{ComputeError, UnfinishedError};
    use crate::files::FileError;

    fn every() -> Vec<(CliError, u8, &'static str)> {
        let path = || PathBuf::from("out/a");
        let source = || io::Error::other("full");
        vec![
            (
                CliError::Case(Case::load("no/such.toml", &[]).unwrap_err()),
                2,
                "error: cannot read the case file no/such.toml: No such file or directory (os error 2)\n",
            ),
            (
                CliError::ResultExists { path: path() },
                2,
                "error: out/a is the result of an earlier run\n\
                 help: replace it with --force, or choose another folder with --out\n",
            ),
            (
                CliError::Folder { path: path(), source: source() },
                2,
                "error: cannot make the folder out/a: full\nhelp: choose another folder with --out\n",
            ),
            (
                CliError::from(FileError::Write { path: path(), source: source() }),
                1,
                "error: cannot write out/a: full\n",
            ),
            (CliError::StandardOutput(source()), 1, "error: cannot write to standard output: full\n"),
            (
                CliError::BadAnswer { what: "blew up at 0.3 s".to_owned(), help: Some("halve the step".to_owned()) },
                1,
                "error: blew up at 0.3 s\nhelp: halve the step\n",
            ),
            (
                CliError::Finished { path: path() },
                2,
                "error: out/a is the result of a finished run: there is nothing to go on with\n\
                 help: leave --resume out, and begin anew with --force\n",
            ),
            (
                CliError::ResumeAnew,
                2,
                "error: --resume goes on with a run, --force begins it anew: expected one of them, found both\n",
            ),
            (
                CliError::Interrupted {
                    what: "interrupted at t = 1.25 s of 4 s".to_owned(),
                    kept: "the signals so far and a checkpoint are",
                    folder: path(),
                    command: "plummer run a.toml --resume".to_owned(),
                },
                1,
                "error: interrupted at t = 1.25 s of 4 s; the signals so far and a checkpoint are in out/a\n\
                 help: go on with: plummer run a.toml --resume\n",
            ),
            (CliError::Signals(source()), 1, "error: cannot catch interrupts: full\n"),
            (
                CliError::from(ComputeError::from(UnfinishedError::InTheWay { path: path() })),
                2,
                "error: out/a holds an unfinished run\n\
                 help: go on with --resume, or give it up and begin anew with --force\n",
            ),
            (
                CliError::from(ComputeError::from(UnfinishedError::Nothing { path: path() })),
                2,
                "error: out/a has no checkpoint: there is no unfinished run to go on with\n\
                 help: leave --resume out to begin a run\n",
            ),
            (
                CliError::from(ComputeError::from(UnfinishedError::Changed {
                    path: path(),
                    changes: vec!["no --set, now --set a=1".to_owned(), "another content of b".to_owned()],
                })),
                2,
                "error: the run in out/a was begun with something else: no --set, now --set a=1; another content of b\n\
                 help: go on with what it was begun with, or begin anew with --force\n",
            ),
            (
                CliError::from(ComputeError::TieFrame),
                2,
                "error: ring.tie: `zero_deg` lies along `axis`: expected a direction across it\n",
            ),
            (
                CliError::from(ExportError::NothingCondensed { format: "op4", found: "a ring alone" }),
                2,
                "error: --to op4 writes a condensed housing: expected [housing] with a mesh, and ring.tie or \
                 condense.interface, found a ring alone\n\
                 help: --to mtx and --to npz write matrices that are not condensed\n",
            ),
            (
                CliError::from(ResultsError::Missing {
                    folder: path(),
                    command: "modes",
                    arrays: "modes.npz",
                    instead: "a case file",
                }),
                2,
                "error: out/a has no modes.json and modes.npz: expected a folder with results of `plummer modes`, or a case file\n\
                 help: run `plummer modes CASE.toml --out out/a` first\n",
            ),
            (
                CliError::Busy { path: path() },
                2,
                "error: another plummer writes into out/a\n\
                 help: wait for its end, or choose another folder with --out\n",
            ),
            (
                CliError::from(InitError::Exists { path: PathBuf::from("a.toml") }),
                2,
                "error: a.toml exists\nhelp: replace it with --force, or name another file with --out\n",
            ),
            (
                CliError::from(ResultsError::NoReport { folder: path() }),
                2,
                "error: out/a has no content of a report: expected report.cbor.gz or COMMAND-report.cbor.gz, as each command writes it beside its page\n\
                 help: name the folder with the results of a command\n",
            ),
            (
                CliError::from(AnalyzeError::Missing {
                    input: path(),
                    missing: vec![
                        Missing::Channel { known: vec!["P1".to_owned(), "P2".to_owned()] },
                        Missing::Rate,
                        Missing::Speed,
                    ],
                }),
                2,
                "error: out/a: nothing says which channel is meant, how fast it was sampled and how fast the shaft turns\n\
                 help: --channel NAME (repeatable), of \"P1\", \"P2\"\n\
                 help: --rate HZ, the sampling rate\n\
                 help: --speed 29.95Hz or 1797rpm, or over time --speed T:SPEED,T:SPEED,...\n",
            ),
            (
                CliError::from(AnalyzeError::Missing { input: path(), missing: vec![Missing::Bearing] }),
                2,
                "error: out/a: nothing says which bearing it is\n\
                 help: --bearing CASE.toml or NAME (6205), or --balls N --pitch-diameter D --ball-diameter D [--contact-angle DEG], or --orders outer=..,inner=.. (or BPFO=.., BPFI=..)\n",
            ),
            (
                CliError::Verification("the built-in case has no bearing".into()),
                1,
                "error: the built-in case has no bearing\n",
            ),
            (
                CliError::from(ExportError::from(FileError::Write { path: path(), source: source() })),
                1,
                "error: cannot write out/a: full\n",
            ),
        ]
    }

    #[test]
    fn each_has_its_exit_code_and_its_lines() {
        for (error, code, lines) in every() {
            assert_eq!(error.exit_code(), code, "{error}");
            let mut written = Vec::new();
            error.report(&mut written);
            assert_eq!(String::from_utf8(written).unwrap(), lines);
        }
    }
}
