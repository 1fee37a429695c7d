//! What can be wrong with a case file.

use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::check::Rule;
use super::nearest::Choices;
use super::set::SetProblem;

/// Where the offending value was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// In the case file, at a line counted from 1.
    Line {
        /// The case file as given by the caller.
        path: PathBuf,
        /// Line of the key or of the array's item, from 1.
        line: usize,
    },
    /// In a `KEY=VALUE` argument.
    Set {
        /// The whole argument.
        argument: String,
    },
    /// Nowhere in particular: something the case file lacks.
    File {
        /// The case file as given by the caller.
        path: PathBuf,
    },
}

impl fmt::Display for Place {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line { path, line } => write!(formatter, "{}:{line}", path.display()),
            Self::Set { argument } => write!(formatter, "--set {argument}"),
            Self::File { path } => write!(formatter, "{}", path.display()),
        }
    }
}

/// Why a case could not be read. Display gives the place, the key, what was found and what was expected;
/// `CaseError::help` the nearest valid name and what to do.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The file cannot be read at all.
    #[error("cannot read the case file {}: {source}", path.display())]
    Read {
        /// The case file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The text is not TOML.
    #[error("{place}: not valid TOML: {message}")]
    Syntax {
        /// Where the parser stopped.
        place: Place,
        /// The parser's reason.
        message: String,
    },
    /// A `KEY=VALUE` argument cannot be applied.
    #[error("--set {argument}: {problem}")]
    Set {
        /// The whole argument.
        argument: String,
        /// What is wrong with it.
        problem: SetProblem,
    },
    /// A key that no table of this kind has.
    #[error("{place}: unknown key `{key}`")]
    UnknownKey {
        /// Where it was written.
        place: Place,
        /// Full path of the key.
        key: String,
        /// The keys that the table takes.
        keys: Box<Choices>,
    },
    /// A name that is none of those that exist: an option of a key, a mesh group.
    #[error("{place}: `{key}` is \"{found}\", expected {}", one_of(&names.valid))]
    UnknownName {
        /// Where it was written.
        place: Place,
        /// Full path of the key.
        key: String,
        /// The name as written.
        found: String,
        /// The names that are valid here.
        names: Box<Choices>,
    },
    /// A required key is absent.
    #[error("{place}: `{table}` lacks the required key `{key}`")]
    MissingKey {
        /// Where the table was written.
        place: Place,
        /// Full path of the table.
        table: String,
        /// The key that it lacks.
        key: String,
    },
    /// A value of another kind than the key takes.
    #[error("{place}: `{key}`: found {found}, expected {expected}")]
    WrongValue {
        /// Where it was written.
        place: Place,
        /// Full path of the key.
        key: String,
        /// The value, named.
        found: String,
        /// What the key takes.
        expected: String,
    },
    /// A value outside its range, or one that contradicts another.
    #[error("{place}: `{key}`: {rule}")]
    Rule {
        /// Where it was written.
        place: Place,
        /// Full path of the key.
        key: String,
        /// The rule that it breaks, with the values.
        rule: Rule,
    },
    /// A table that the requested computation needs is absent.
    #[error("{place}: {needed_by} needs {table}, which the case file lacks")]
    MissingTable {
        /// The case file.
        place: Place,
        /// The table as it would be written, brackets included.
        table: &'static str,
        /// The computation, or the key, that needs it.
        needed_by: &'static str,
    },
    /// One of the variants under `modes.variants` is not a valid case.
    #[error("{place}: variant \"{what}\": {source}")]
    Variant {
        /// Where the variant was written.
        place: Place,
        /// The variant's name.
        what: String,
        /// What is wrong with the case that it makes.
        source: Box<CaseError>,
    },
}

impl CaseError {
    /// Returns what to do about it: the nearest valid name, the names there are, or what to write instead.
    #[must_use]
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Read { .. } | Self::Syntax { .. } | Self::WrongValue { .. } | Self::MissingKey { .. } => None,
            Self::Set { problem, .. } => Some(problem.help().to_owned()),
            Self::UnknownKey { keys, .. } => Some(keys.help("keys")),
            Self::UnknownName { names, .. } => Some(names.help("names")),
            Self::Rule { rule, .. } => rule.help(),
            Self::MissingTable { table, .. } => Some(format!("add {table} to the case file")),
            Self::Variant { source, .. } => source.help(),
        }
    }
}

/// "one of `a`, `b`", "`a`" or "no name at all".
pub(super) fn one_of(names: &[String]) -> String {
    let ticked: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match ticked.as_slice() {
        [] => "no name at all".to_owned(),
        [only] => only.clone(),
        several => format!("one of {}", several.join(", ")),
    }
}
