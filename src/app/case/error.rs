//! What can be wrong with a case file.

use std::fmt::Display;

use thiserror::Error;

use super::check::BrokenRule;

/// Why a case could not be read. Display gives the place (`FILE:LINE`, `--set KEY=VALUE`, or the file where something is absent), the
/// key, what was found and what was expected; `CaseError::help` the nearest valid name and what to do.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct CaseError {
    message: String,
    help: Option<String>,
    /// The keys or names that are valid where an unknown one was written; empty for all other errors.
    pub valid: Vec<String>,
}

impl CaseError {
    pub(super) fn new(message: String) -> Self {
        Self { message, help: None, valid: Vec::new() }
    }

    /// What is wrong at a place: file and line, an argument, or the file.
    pub(super) fn at(place: impl Display, what: impl Display) -> Self {
        Self::new(format!("{place}: {what}"))
    }

    /// A rule that is broken at a place.
    pub(super) fn broken(place: impl Display, broken: &BrokenRule) -> Self {
        Self::at(place, broken).with_help(broken.rule.help())
    }

    /// The same error with what to do about it.
    pub(super) fn with_help(self, help: Option<String>) -> Self {
        Self { help, ..self }
    }

    /// The same error with the keys or names that are valid there.
    pub(super) fn with_valid(self, valid: &[&str]) -> Self {
        Self { valid: valid.iter().map(|&name| name.to_owned()).collect(), ..self }
    }

    /// Returns what to do about it: the nearest valid name, the names there are, or what to write instead.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        self.help.clone()
    }
}

/// "one of `a`, `b`", "`a`" or "no name at all".
pub(super) fn one_of(names: &[&str]) -> String {
    let ticked: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match ticked.as_slice() {
        [] => "no name at all".to_owned(),
        [only] => only.clone(),
        several => format!("one of {}", several.join(", ")),
    }
}
