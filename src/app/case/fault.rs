//! What the decoder can find wrong, in the words of a case file.

use std::fmt;

use serde::de::{self, Expected, Unexpected};

use super::path::Step;
use super::tree::Mark;

/// What does not fit, and where on the way down from the root.
#[derive(Debug)]
pub(super) struct Fault {
    /// From the value up to the root.
    upward: Vec<Step>,
    pub(super) mark: Option<Mark>,
    pub(super) kind: FaultKind,
}

/// What does not fit.
#[derive(Debug)]
pub(super) enum FaultKind {
    UnknownKey { found: String, valid: Vec<String> },
    UnknownName { found: String, valid: Vec<String> },
    MissingKey { key: String },
    Wrong { found: String, expected: String },
}

impl Fault {
    fn new(kind: FaultKind) -> Self {
        Self { upward: Vec::new(), mark: None, kind }
    }

    pub(super) fn wrong(found: String, expected: &dyn Expected) -> Self {
        Self::new(FaultKind::Wrong { found, expected: plain(&expected.to_string()) })
    }

    /// Notes the place, unless a deeper one is known.
    pub(super) fn at(mut self, mark: Mark) -> Self {
        self.mark.get_or_insert(mark);
        self
    }

    pub(super) fn under(mut self, step: Step) -> Self {
        self.upward.push(step);
        self
    }

    /// Returns the steps from the root down.
    pub(super) fn steps(&self) -> Vec<Step> {
        self.upward.iter().rev().cloned().collect()
    }
}

/// Puts serde's names of kinds into words of a case file.
fn plain(expected: &str) -> String {
    match expected {
        "f64" => "a number",
        "usize" | "u64" => "a whole number, 0 or more",
        "a boolean" => "true or false",
        "a sequence" => "an array",
        "a map" => "a table",
        "path string" => "a string",
        other if other.starts_with("struct ") => "a table",
        other => other,
    }
    .to_owned()
}

fn describe(found: &Unexpected<'_>) -> String {
    match found {
        Unexpected::Bool(flag) => flag.to_string(),
        Unexpected::Unsigned(number) => number.to_string(),
        Unexpected::Signed(number) => number.to_string(),
        Unexpected::Float(number) => number.to_string(),
        Unexpected::Str(text) => format!("\"{text}\""),
        Unexpected::Seq => "an array".to_owned(),
        Unexpected::Map => "a table".to_owned(),
        Unexpected::Other(text) => (*text).to_owned(),
        other => other.to_string(),
    }
}

pub(super) fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:?}", self.kind)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(FaultKind::Wrong { found: message.to_string(), expected: "a value of this key".to_owned() })
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::wrong(describe(&found), expected)
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::wrong(describe(&found), expected)
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Self::wrong(format!("an array of {length}"), expected)
    }

    fn unknown_variant(found: &str, valid: &'static [&'static str]) -> Self {
        Self::new(FaultKind::UnknownName { found: found.to_owned(), valid: owned(valid) })
    }

    fn unknown_field(found: &str, valid: &'static [&'static str]) -> Self {
        Self::new(FaultKind::UnknownKey { found: found.to_owned(), valid: owned(valid) })
    }

    fn missing_field(key: &'static str) -> Self {
        Self::new(FaultKind::MissingKey { key: key.to_owned() })
    }
}
