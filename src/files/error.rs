//! What can be wrong with a file, and with data that a file holds or shall hold.

use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a file cannot be read or written.
#[derive(Debug, Error)]
pub enum FileError {
    /// The file cannot be opened or read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file cannot be made, written or renamed.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file that is read and written cannot be opened.
    #[error("cannot open {}: {source}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Something in the file is not what the format has there.
    #[error("{}{}: expected {}, found {}", path.display(), fault.place, fault.expected, fault.found)]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        fault: Fault,
    },
}

impl FileError {
    /// What a failure to read this file is.
    pub(crate) fn read(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        |source| Self::Read { path, source }
    }

    /// What a failure to write this file is.
    pub(crate) fn write(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        |source| Self::Write { path, source }
    }
}

/// Data that contradict themselves or their format: what was expected at a place, and what stands there.
#[derive(Debug, Clone, PartialEq, Error)]
pub struct Fault {
    /// Where it stands.
    pub place: Place,
    /// What should stand there.
    pub expected: Cow<'static, str>,
    /// What stands there.
    pub found: String,
}

/// A place in a file or in data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// The whole of it.
    Whole,
    /// A line, counted from 1.
    Line(u64),
    /// A position, such as "byte 24".
    At(String),
    /// A part with a name, such as `array "k"`.
    In(String),
}

impl Fault {
    /// A fault of the whole.
    pub(crate) fn new(expected: impl Into<Cow<'static, str>>, found: impl fmt::Display) -> Self {
        Self { place: Place::Whole, expected: expected.into(), found: found.to_string() }
    }

    /// The fault of data that are not as expected.
    pub(crate) fn unless(
        fits: bool,
        expected: impl Into<Cow<'static, str>>,
        found: impl fmt::Display,
    ) -> Result<(), Self> {
        if fits { Ok(()) } else { Err(Self::new(expected, found)) }
    }

    /// The same fault in a line, counted from 1.
    pub(crate) fn line(self, line: u64) -> Self {
        Self { place: Place::Line(line), ..self }
    }

    /// The same fault at a position.
    pub(crate) fn at(self, position: impl fmt::Display) -> Self {
        Self { place: Place::At(position.to_string()), ..self }
    }

    /// The same fault in a part with a name.
    pub(crate) fn within(self, part: impl Into<String>) -> Self {
        Self { place: Place::In(part.into()), ..self }
    }

    /// The same fault in a file.
    pub(crate) fn of(self, path: &Path) -> FileError {
        FileError::Content { path: path.to_owned(), fault: self }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Place::Whole => {}
            Place::Line(line) => write!(to, "line {line}: ")?,
            Place::At(place) | Place::In(place) => write!(to, "{place}: ")?,
        }
        write!(to, "expected {}, found {}", self.expected, self.found)
    }
}

/// As it follows the name of a file.
impl fmt::Display for Place {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => Ok(()),
            Self::Line(line) => write!(to, ":{line}"),
            Self::At(place) => write!(to, ", {place}"),
            Self::In(place) => write!(to, ": {place}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_is_told_with_its_place_and_its_file() {
        let fault = || Fault::new("a number", "\"x\"");
        let cases = [
            (fault(), "", ""),
            (fault().line(3), "line 3: ", ":3"),
            (fault().at("byte 24"), "byte 24: ", ", byte 24"),
            (fault().within("array \"k\""), "array \"k\": ", ": array \"k\""),
        ];
        for (fault, before, after_path) in cases {
            let expected = "expected a number, found \"x\"";
            assert_eq!(fault.to_string(), format!("{before}{expected}"));
            let told = fault.of(Path::new("a.txt")).to_string();
            assert_eq!(told, format!("a.txt{after_path}: {expected}"));
        }
    }
}
