//! What could not be analysed among many files.

use crate::app::cli::CliError;
use crate::app::cli::output::extend_new;
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
        let Self { input, channel, error } = self;
        let message = error.to_string();
        let named = message.starts_with(input) || message.contains(&format!(" {input}:"));
        match channel.as_str() {
            "" if named => message,
            "" => format!("{input}: {message}"),
            channel => format!("{input}, channel \"{channel}\": {message}"),
        }
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
    extend_new(&mut helps, failures.iter().filter_map(|failure| failure.error.help.as_deref()).flat_map(str::lines));
    helps.truncate(LISTED);
    let is_input = failures.iter().any(|failure| failure.error.is_input);
    CliError { is_input, what, help: Some(helps.join("\n")).filter(|help| !help.is_empty()) }
}
