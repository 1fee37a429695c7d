//! What values of the right kind can still break.

use std::fmt::Display;

use thiserror::Error;

/// A rule that values of the right kind can still break. Display says what was found and what was expected.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct Rule {
    message: String,
    /// What to do about it, where the message does not say it all.
    help: Option<String>,
}

impl Rule {
    pub(in super::super) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), help: None }
    }

    pub(crate) fn found(found: impl Display, expected: &str) -> Self {
        Self::new(format!("found {found}, expected {expected}"))
    }

    /// A value beyond another, which limits it; numbers in the key's unit.
    pub(crate) fn beyond(found: f64, limit: &str, other: f64) -> Self {
        Self::found(short(found), &format!("{limit} ({})", short(other)))
    }

    /// Neither housing nor ring.
    pub(crate) fn nothing_to_model() -> Self {
        Self::found("neither [housing] nor [ring]", "at least one")
    }

    /// The same rule with what to do about it.
    pub(crate) fn with_help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// Returns what to do about it, where the message does not say it all.
    pub(crate) fn help(&self) -> Option<String> {
        self.help.clone()
    }

    /// Names the key that breaks it.
    pub(crate) fn at(self, key: impl Into<String>) -> BrokenRule {
        BrokenRule { key: key.into(), rule: self }
    }
}

/// A broken rule and the key that breaks it.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("`{key}`: {rule}")]
pub struct BrokenRule {
    /// Full path of the key, e.g. `bearing.defects[0].depth`; the table where a whole table breaks it.
    pub key: String,
    /// The rule.
    pub rule: Rule,
}

/// Writes a number briefly: twelve digits at most, plain where that is short, else with an exponent.
pub(crate) fn short(number: f64) -> String {
    // The text of a number always reads back.
    let number: f64 = format!("{number:.11e}").parse().unwrap_or(number);
    let size = number.abs();
    if size > 0.0 && !(1e-3..1e6).contains(&size) { format!("{number:e}") } else { number.to_string() }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_written_briefly() {
        for (number, text) in [
            (0.0, "0"),
            (7.5, "7.5"),
            (100_000.0, "100000"),
            (206e9, "2.06e11"),
            (-2.5e-6, "-2.5e-6"),
            (0.1 + 0.2, "0.3"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(short(number), text);
        }
    }
}
