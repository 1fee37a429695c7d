//! A case file as text and arguments; from there to values and to places.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::check::BrokenRule;
use super::error::{CaseError, Place};
use super::fault::{Fault, FaultKind};
use super::nearest::Choices;
use super::path::{format_path, parse_path};
use super::set;
use super::tree::{Mark, Node};

/// Where a case came from: what is needed to read it again, or to read a variant of it.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Source {
    /// The case file as given by the caller; relative mesh paths are resolved against its folder.
    pub path: PathBuf,
    /// The file's text.
    #[serde(skip)]
    pub text: String,
    /// The `KEY=VALUE` arguments, in order.
    pub set: Vec<String>,
}

/// A source read into a tree, arguments applied.
pub(super) struct Document<'a> {
    source: &'a Source,
    pub(super) root: Node,
}

impl<'a> Document<'a> {
    /// Reads the text and applies the arguments in order.
    pub(super) fn read(source: &'a Source) -> Result<Self, CaseError> {
        let mut root = Node::read(&source.text).map_err(|fault| CaseError::Syntax {
            place: Place::Line { path: source.path.clone(), line: fault.line },
            message: fault.message,
        })?;
        for (index, argument) in source.set.iter().enumerate() {
            set::apply(&mut root, argument, Mark::Set(index))
                .map_err(|problem| CaseError::Set { argument: argument.clone(), problem })?;
        }
        Ok(Self { source, root })
    }

    /// Returns where the value at a key path was written, or where the nearest table around it was.
    pub(super) fn place(&self, key: &str) -> Place {
        let steps = parse_path(key).unwrap_or_default();
        self.marked(self.root.nearest_mark(&steps))
    }

    /// Says where the case breaks a rule.
    pub(super) fn broken(&self, BrokenRule { key, rule }: BrokenRule) -> CaseError {
        let place = self.place(&key);
        CaseError::Rule { place, key, rule }
    }

    pub(super) fn marked(&self, mark: Option<Mark>) -> Place {
        let path = self.source.path.clone();
        match mark {
            Some(Mark::Line(line)) => Place::Line { path, line },
            Some(Mark::Set(index)) => match self.source.set.get(index) {
                Some(argument) => Place::Set { argument: argument.clone() },
                None => Place::File { path },
            },
            None => Place::File { path },
        }
    }

    /// Turns the decoder's fault into an error with its place.
    pub(super) fn error(&self, fault: Fault) -> CaseError {
        let place = self.marked(fault.mark);
        let steps = fault.steps();
        let key = format_path(&steps);
        match fault.kind {
            FaultKind::UnknownKey { found, valid } => {
                CaseError::UnknownKey { place, key, keys: Box::new(Choices::new(&found, valid)) }
            }
            FaultKind::UnknownName { found, valid } => {
                CaseError::UnknownName { place, key, names: Box::new(Choices::new(&found, valid)), found }
            }
            FaultKind::MissingKey { key: missing } => CaseError::MissingKey { place, table: key, key: missing },
            FaultKind::Wrong { found, expected } => CaseError::WrongValue { place, key, found, expected },
        }
    }
}
