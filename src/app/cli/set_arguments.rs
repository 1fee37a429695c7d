//! Which `--set` arguments a command takes.

use super::{Arguments, CliError, Command};
use crate::app::case::replaced_argument;

/// Refuses `--set` where nothing would come of it: in a command that reads no case, and where a later argument replaces it.
///
/// # Errors
/// [`CliError`] that names the arguments.
pub(super) fn check_set(arguments: &Arguments) -> Result<(), CliError> {
    let set = &arguments.options.set;
    let Some(argument) = set.first() else {
        return Ok(());
    };
    if let Some(command) = without_case(&arguments.command) {
        return Err(CliError::input(format!(
            "--set {argument}: `plummer {command}` reads no case that it could change"
        ))
        .with_help("leave it out; the command has options of its own, which --help lists"));
    }
    match replaced_argument(set) {
        Some([earlier, later]) => {
            Err(CliError::input(format!("--set {later} replaces --set {earlier}: expected each key once"))
                .with_help("leave one of the two out"))
        }
        None => Ok(()),
    }
}

/// The command, if it reads no case of its own.
fn without_case(command: &Command) -> Option<&'static str> {
    match command {
        Command::Completions { .. } => Some("completions"),
        Command::Man => Some("man"),
        Command::Schema { .. } => Some("schema"),
        Command::Init(_) => Some("init"),
        Command::Inspect { .. } => Some("inspect"),
        Command::Verify { .. } => Some("verify"),
        Command::Report { .. } => Some("report"),
        Command::Analyze(asked) if asked.inputs.iter().all(|input| !input.is_dir()) => Some("analyze FILE"),
        Command::Sweep(asked) if asked.task.is_some() => Some("sweep --task"),
        Command::Sweep(asked) if asked.merge => Some("sweep --merge"),
        Command::Run { .. }
        | Command::Modes { .. }
        | Command::Condense { .. }
        | Command::Frf { .. }
        | Command::Chart { .. }
        | Command::Export { .. }
        | Command::Analyze(_)
        | Command::Sweep(_) => None,
    }
}
