//! What can be wrong with a case file.
//!
//! The names that are valid somewhere, and the one nearest to a misspelt one.

use super::check::BrokenRule;
use std::fmt::Display;
use thiserror::Error;

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

    /// A file that could not be read.
    pub(in crate::app) fn unread(message: String) -> Self {
        Self::new(message)
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

/// "did you mean `x`? keys here: a, b", without the question when nothing is near; `what` is their kind in the plural.
pub(super) fn names_help(found: &str, valid: &[&str], what: &str) -> String {
    let list = match valid {
        [] => format!("there are no {what} here"),
        valid => format!("{what} here: {}", valid.join(", ")),
    };
    match nearest(found, valid.iter().copied()) {
        Some(name) => format!("did you mean `{name}`? {list}"),
        None => list,
    }
}

/// Returns the candidate that differs from `found` by the fewest edits, if any is near enough to be meant.
///
/// Edits are insertions, deletions, substitutions and swaps of neighbours, letter case ignored. Near enough: at most
/// one edit and one more for every three letters of `found`. Equal distances: the first candidate.
fn nearest<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let wanted = found.to_lowercase();
    let limit = 1 + wanted.chars().count() / 3;
    candidates
        .into_iter()
        .map(|candidate| {
            let edits = strsim::damerau_levenshtein(&wanted, &candidate.to_lowercase());
            (edits, candidate)
        })
        .filter(|&(edits, _)| edits <= limit)
        .min_by_key(|&(edits, _)| edits)
        .map(|(_, candidate)| candidate.to_owned())
}

#[cfg(test)]
mod tests {
    use super::nearest;

    const KEYS: [&str; 4] = ["balls", "ball_radius", "ball_mass", "first_ball_deg"];

    #[test]
    fn a_swap_a_gap_and_a_case_are_forgiven() {
        assert_eq!(nearest("ball_raduis", KEYS).as_deref(), Some("ball_radius"));
        assert_eq!(nearest("Ball", KEYS).as_deref(), Some("balls"));
        assert_eq!(nearest("BALL_MASS", KEYS).as_deref(), Some("ball_mass"));
    }

    #[test]
    fn a_far_name_has_no_neighbour() {
        assert_eq!(nearest("temperature", KEYS), None);
        assert_eq!(nearest("", KEYS), None);
    }
}
