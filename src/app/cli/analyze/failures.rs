//! What could not be analysed among many files.

use crate::app::cli::CliError;
use crate::app::commands::analyze::FailureSummary;

/// Most files that a message names.
const LISTED: usize = 20;

/// Why an input, or a channel of it, was not analysed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Failure {
    pub(super) input: String,
    /// Empty: the whole input.
    pub(super) channel: String,
    pub(super) message: String,
    help: Option<String>,
    is_input: bool,
}

impl Failure {
    pub(super) fn of(input: &str, channel: &str, error: &CliError) -> Self {
        Self {
            input: input.to_owned(),
            channel: channel.to_owned(),
            message: error.to_string(),
            help: error.help(),
            is_input: error.exit_code() == 2,
        }
    }

    /// What a result says of it.
    pub(super) fn summary(&self) -> FailureSummary {
        FailureSummary { input: self.input.clone(), channel: self.channel.clone(), error: self.message.clone() }
    }

    /// The message, with the file in front if it does not say it.
    fn line(&self) -> String {
        let channel = match self.channel.as_str() {
            "" => String::new(),
            channel => format!(", channel \"{channel}\""),
        };
        let named = self.message.starts_with(&self.input) || self.message.contains(&format!(" {}:", self.input));
        if channel.is_empty() && named {
            self.message.clone()
        } else {
            format!("{}{channel}: {}", self.input, self.message)
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
    for line in failures.iter().filter_map(|failure| failure.help.as_deref()).flat_map(str::lines) {
        if !helps.contains(&line) && helps.len() < LISTED {
            helps.push(line);
        }
    }
    let help = (!helps.is_empty()).then(|| helps.join("\n"));
    if failures.iter().any(|failure| failure.is_input) {
        CliError::WrongInput { what, help }
    } else {
        CliError::BadAnswer { what, help }
    }
}
