//! What the decoder can find wrong, in the words of a case file.

use std::fmt;

use serde::de::{self, Expected, Unexpected};

use super::error::one_of;
use super::nearest::names_help;
use super::path::{Step, format_path};
use super::tree::Mark;

/// What does not fit, and where on the way down from the root.
#[derive(Debug, Default)]
pub(super) struct Fault {
    /// From the value up to the root.
    upward: Vec<Step>,
    pub(super) mark: Option<Mark>,
    /// What is said before the key's path.
    pub(super) before: &'static str,
    /// What is said after it.
    pub(super) after: String,
    pub(super) help: Option<String>,
    /// The keys or names that are valid in the place of an unknown one.
    pub(super) valid: &'static [&'static str],
}

impl Fault {
    pub(super) fn wrong(found: String, expected: &dyn Expected) -> Self {
        Self { after: format!(": found {found}, expected {}", plain(&expected.to_string())), ..Self::default() }
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

    /// Returns the path from the root down.
    pub(super) fn key(&self) -> String {
        let steps: Vec<Step> = self.upward.iter().rev().cloned().collect();
        format_path(&steps)
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

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}`{}`{}", self.before, self.key(), self.after)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::wrong(message.to_string(), &"a value of this key")
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
        let after = format!(" is \"{found}\", expected {}", one_of(valid));
        Self { after, help: Some(names_help(found, valid, "names")), valid, ..Self::default() }
    }

    fn unknown_field(found: &str, valid: &'static [&'static str]) -> Self {
        Self { before: "unknown key ", help: Some(names_help(found, valid, "keys")), valid, ..Self::default() }
    }

    fn missing_field(key: &'static str) -> Self {
        Self { after: format!(" lacks the required key `{key}`"), ..Self::default() }
    }
}
