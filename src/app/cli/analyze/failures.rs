//! What could not be analysed among many files.

use crate::app::cli::CliError;
use crate::app::commands::analyze::FailureSummary;

/// Most files that a message names.
const LISTED: usize = 20;

/// Why an input, or a channel of it, was not analysed.
#[derive(Debug)]
pub(super) struct Failure {
    pub(super) input: String,
    /// Empty: the whole input.
    pub(super) channel: String,
    pub(super) error: CliError,
}

impl Failure {
    /// What a result says of it.
    pub(super) fn summary(&self) -> FailureSummary {
        FailureSummary { input: self.input.clone(), channel: self.channel.clone(), error: self.error.to_string() }
    }

    /// The message, with the file in front if it does not say it.
    fn line(&self) -> String {
        let channel = match self.channel.as_str() {
            "" => String::new(),
            channel => format!(", channel \"{channel}\""),
        };
        let message = self.error.to_string();
        let named = message.starts_with(&self.input) || message.contains(&format!(" {}:", self.input));
        if channel.is_empty() && named { message } else { format!("{}{channel}: {message}", self.input) }
    }
}

/// All of them as one error, which names `failed` files of `inputs`; the input is to blame if it is for any of them.
pub(super) fn failure(failures: &[Failure], failed: usize, inputs: usize) -> CliError {
    let mut lines = vec![format!("{failed} of {inputs} inputs could not be analysed in full:")];
    lines.extend(failures.iter().take(LISTED).map(|failure| format!("  {}", failure.line())));
    if failures.len() > LISTED {
        lines.push(format!("  and {} more", failures.len() - LISTED));
    }
    let what = lines.join("\n");
    let mut helps: Vec<&str> = Vec::new();
    for line in failures.iter().filter_map(|failure| failure.error.help.as_deref()).flat_map(str::lines) {
        if !helps.contains(&line) && helps.len() < LISTED {
            helps.push(line);
        }
    }
    let is_input = failures.iter().any(|failure| failure.error.is_input);
    let error = if is_input { CliError::input(what) } else { CliError::failed(what) };
    if helps.is_empty() { error } else { error.with_help(helps.join("\n")) }
}
