//! Why a command did not end well: exit code, message, what to do.
//!
//! Signals: Ctrl-C and an end asked for by the system, the first of which asks a run to keep a checkpoint and stop, the second ends the
//! program, as does the first where nobody listens, not without saying what is on disk; memory and file sizes that run out, which are
//! failures like any other.

use super::heap;
use crate::app::case::CaseError;
use crate::app::commands::run::unfinished::StopRequest;
use crate::app::error::ComputeError;
use crate::app::shell_word::{cut, printable};
use crate::files::FileError;
use crate::formats::FormatError;
use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::flag;
use signal_hook::iterator::Signals;
use std::io;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use thiserror::Error;

/// Why a command did not end well: a message, what to do about it, and the exit code.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{what}")]
pub struct CliError {
    /// Whether the input is wrong, rather than the computation or the writing failed or its answer is bad.
    pub is_input: bool,
    /// What is wrong, where and when.
    pub what: String,
    /// What to do about it, a line for each thing.
    pub help: Option<String>,
}

impl CliError {
    /// Wrong input, exit code 2.
    pub(crate) fn input(what: impl Into<String>) -> Self {
        Self { is_input: true, what: what.into(), help: None }
    }

    /// A computation or a file that failed, or a bad answer: exit code 1.
    pub(crate) fn failed(what: impl Into<String>) -> Self {
        Self { is_input: false, what: what.into(), help: None }
    }

    /// The same with what to do about it.
    pub(crate) fn with_help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The folder for the results cannot be made.
    pub(crate) fn folder(path: &Path, source: &io::Error) -> Self {
        Self::input(format!("cannot make the folder {}: {source}", path.display()))
            .with_help("choose another folder with --out")
    }

    /// `--resume` beside `--force`.
    pub(crate) fn resume_anew() -> Self {
        Self::input("--resume goes on with a run, --force begins it anew: expected one of them, found both")
    }

    /// The command was asked to stop after `what`, left `kept` (words with a verb) in a folder, and goes on by a command line.
    pub(crate) fn interrupted(what: &str, kept: &str, folder: &Path, command: &str) -> Self {
        Self::failed(format!("{what}; {kept} in {}", folder.display())).with_help(format!("go on with: {command}"))
    }

    /// The program's exit code: 2 when the input is wrong, else 1.
    #[must_use]
    pub(crate) fn exit_code(&self) -> u8 {
        if self.is_input { 2 } else { 1 }
    }

    /// Writes the lines `error: ...` and, for each thing that can be done, `help: ...`. Nothing can be done about a failure
    /// to write them.
    pub(crate) fn report(&self, to: &mut impl Write) {
        let _ = writeln!(to, "error: {}", cut(&printable(&self.what)));
        for line in self.help.iter().flat_map(|help| help.lines()) {
            let _ = writeln!(to, "help: {}", cut(&printable(line)));
        }
    }
}

impl From<CaseError> for CliError {
    fn from(error: CaseError) -> Self {
        Self { is_input: true, what: error.to_string(), help: error.help() }
    }
}

impl From<ComputeError> for CliError {
    fn from(error: ComputeError) -> Self {
        Self { is_input: error.is_input(), what: error.to_string(), help: error.help() }
    }
}

impl From<FileError> for CliError {
    fn from(error: FileError) -> Self {
        Self::failed(error.to_string())
    }
}

/// Of an export: data that a format does not hold are wrong input.
impl From<FormatError> for CliError {
    fn from(error: FormatError) -> Self {
        let is_input = !matches!(error, FormatError::File(FileError::Write { .. }));
        Self { is_input, what: error.to_string(), help: None }
    }
}

fn not_caught(error: io::Error) -> CliError {
    CliError::failed(format!("cannot catch interrupts: {error}"))
}

/// What the signals ask for; nobody listens yet.
static STOP: LazyLock<StopRequest> = LazyLock::new(|| {
    let stop = StopRequest::default();
    stop.deaf.store(true, Ordering::SeqCst);
    stop
});

/// What is on disk, and how to go on.
type Left = Box<dyn Fn() -> CliError + Send>;
static LEFT: Mutex<Option<Left>> = Mutex::new(None);

/// The request that signals set. As long as nobody listens to it, a signal ends the program.
pub(super) fn stop_request() -> StopRequest {
    STOP.clone()
}

/// What the program says from now on when a signal ends it.
pub(super) fn on_interrupt(left: impl Fn() -> CliError + Send + 'static) {
    *LEFT.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(left));
}

/// Catches interrupts, in a thread of its own until the program ends.
///
/// # Errors
/// When the system does not let signals be caught.
pub(super) fn catch_interrupts() -> Result<(), CliError> {
    const ASKED: [i32; 2] = [SIGINT, SIGTERM];
    let ending = Arc::new(AtomicBool::new(false));
    for signal in ASKED {
        // ends the program should standard error take no words
        flag::register_conditional_default(signal, Arc::clone(&ending)).map_err(not_caught)?;
    }
    let mut signals = Signals::new(ASKED).map_err(not_caught)?;
    let listen = move || {
        for _ in signals.forever() {
            // the first signal leaves everybody deaf
            if !STOP.deaf.swap(true, Ordering::SeqCst) {
                STOP.asked.store(true, Ordering::SeqCst);
                continue;
            }
            ending.store(true, Ordering::SeqCst);
            let left = LEFT.lock().unwrap_or_else(PoisonError::into_inner);
            let nothing =
                || CliError::failed("interrupted before anything was written").with_help("give the command again");
            let error = left.as_ref().map_or_else(nothing, |left| left());
            let mut to = io::stderr().lock();
            if to.is_terminal() {
                // below the bar
                let _ = writeln!(to);
            }
            error.report(&mut to);
            #[cfg(feature = "mumps")]
            crate::numerics::linalg::abandon();
            signal_hook::low_level::exit(error.exit_code().into());
        }
    };
    std::thread::Builder::new().name("signals".to_owned()).spawn(listen).map_err(not_caught)?;
    Ok(())
}

/// Lets limits of the system end in exit code 1: an allocation that fails, which Rust answers by an abort after saying its size, and a
/// file that may not grow further, which then fails like any other writing.
///
/// # Errors
/// When the system does not let signals be caught.
pub(super) fn fail_at_limits() -> Result<(), CliError> {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        // matrices say so by a panic, whose backtrace would need memory too
        let payload = panic.payload();
        let text = payload.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
        let text = text.unwrap_or_default();
        if text.contains("AllocError") {
            let _ = io::stderr().write_all(b"\nerror: the memory does not suffice for a matrix\nhelp: raise its limit (ulimit -v), or use fewer --threads\n");
            signal_hook::low_level::exit(1);
        }
        usual(panic);
    }));
    heap::explain_aborts().map_err(not_caught)?;
    flag::register(SIGXFSZ, Arc::new(AtomicBool::new(true))).map_err(not_caught)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::io;
    use std::path::PathBuf;

    use super::{CliError, FormatError};
    use crate::app::case::Case;
    use crate::app::error::ComputeError;
    use crate::files::FileError;

    fn every() -> Vec<(CliError, u8, &'static str)> {
        let path = || PathBuf::from("out/a");
        let source = || io::Error::other("full");
        vec![
            (
                CliError::from(Case::load("no/such.toml", &[]).unwrap_err()),
                2,
                "error: cannot read the case file no/such.toml: No such file or directory (os error 2)\n",
            ),
            (
                CliError::folder(&path(), &source()),
                2,
                "error: cannot make the folder out/a: full\nhelp: choose another folder with --out\n",
            ),
            (
                CliError::from(FileError::Write { path: path(), source: source() }),
                1,
                "error: cannot write out/a: full\n",
            ),
            (
                CliError::resume_anew(),
                2,
                "error: --resume goes on with a run, --force begins it anew: expected one of them, found both\n",
            ),
            (
                CliError::interrupted(
                    "interrupted at t = 1.25 s of 4 s",
                    "the signals so far and a checkpoint are",
                    &path(),
                    "plummer run a.toml --resume",
                ),
                1,
                "error: interrupted at t = 1.25 s of 4 s; the signals so far and a checkpoint are in out/a\n\
                 help: go on with: plummer run a.toml --resume\n",
            ),
            (
                CliError::from(ComputeError::NothingToCondense),
                2,
                "error: nothing to condense the housing on: expected ring.tie, or condense.interface = { group = \"NAME\" }\n",
            ),
            (
                CliError::from(FormatError::from(FileError::Write { path: path(), source: source() })),
                1,
                "error: cannot write out/a: full\n",
            ),
            (
                CliError::failed("blew up at 0.3 s").with_help("halve the step"),
                1,
                "error: blew up at 0.3 s\nhelp: halve the step\n",
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
