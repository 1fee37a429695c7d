//! A case file as text and arguments; from there to values and to places.

use super::check::BrokenRule;
use super::decode::Fault;
use super::error::CaseError;
use super::tree::{Mark, Node, Step, Value, parse_path};
use super::{named_bearing, set};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

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

/// A source read into a tree, arguments applied and a named bearing filled in.
pub(in crate::app) struct Document<'a> {
    source: &'a Source,
    pub(super) root: Node,
}

impl<'a> Document<'a> {
    /// Reads the text of a case and applies the arguments in order.
    pub(super) fn read(source: &'a Source) -> Result<Self, CaseError> {
        let mut document = Self::changed(source, named_bearing::as_table)?;
        let filled = named_bearing::fill(&mut document.root);
        filled.map_err(|fault| document.error(fault))?;
        Ok(document)
    }

    /// The same of a file that is no case, which has no named bearings.
    ///
    /// # Errors
    /// [`CaseError`] for text that is no TOML and arguments that are none.
    pub(in crate::app) fn of_other(source: &'a Source) -> Result<Self, CaseError> {
        Self::changed(source, |_| ())
    }

    fn changed(source: &'a Source, after_each: impl Fn(&mut Node)) -> Result<Self, CaseError> {
        let mut root = Node::read(&source.text).map_err(|fault| {
            let place = format!("{}:{}", source.path.display(), fault.line);
            CaseError::at(place, format!("not valid TOML: {}", fault.message))
        })?;
        after_each(&mut root);
        for (index, argument) in source.set.iter().enumerate() {
            set::apply(&mut root, argument, Mark::Set(index))
                .map_err(|rule| CaseError::at(set::told_argument(argument), &rule).with_help(rule.help()))?;
            after_each(&mut root);
        }
        Ok(Self { source, root })
    }

    /// Its values as a type.
    ///
    /// # Errors
    /// [`CaseError`] with the place and the key of the first that does not fit.
    pub(in crate::app) fn decode<T: DeserializeOwned>(&self) -> Result<T, CaseError> {
        T::deserialize(&self.root).map_err(|fault| self.error(fault))
    }

    /// A rule that a value breaks, with its place.
    pub(in crate::app) fn broken(&self, broken: &BrokenRule) -> CaseError {
        CaseError::broken(self.place(&broken.key), broken)
    }

    /// Returns where the value at a key path was written, or where the nearest table around it was.
    pub(super) fn place(&self, key: &str) -> String {
        let steps = parse_path(key).unwrap_or_default();
        self.marked(self.root.nearest_mark(&steps))
    }

    fn marked(&self, mark: Option<Mark>) -> String {
        let file = self.source.path.display();
        match mark {
            Some(Mark::Line(line)) => format!("{file}:{line}"),
            Some(Mark::Set(index)) => set::told_argument(self.source.set.get(index).map_or("", String::as_str)),
            None => file.to_string(),
        }
    }

    /// Turns the decoder's fault into an error with its place.
    pub(super) fn error(&self, fault: Fault) -> CaseError {
        let key = fault.key();
        let instead = self.instead(&key).filter(|_| fault.after.starts_with(": found several,"));
        // a case requires no key of its root
        let key = if key.is_empty() { "the specification".to_owned() } else { format!("`{key}`") };
        let what = format!("{}{key}{}", fault.before, fault.after);
        CaseError::at(self.marked(fault.mark), what).with_help(fault.help.or(instead)).with_valid(fault.valid)
    }

    /// What to set where an argument adds a key to a table of the file.
    fn instead(&self, key: &str) -> Option<String> {
        let steps = parse_path(key)?;
        let table = steps.iter().try_fold(&self.root, Node::child)?;
        let Value::Table(entries) = &table.value else { return None };
        entries.iter().find_map(|(name, entry)| {
            let Mark::Set(index) = entry.mark else { return None };
            let (set, typed) = set::split_argument(self.source.set.get(index)?)?;
            let added = parse_path(set)? == [&steps[..], &[Step::Key(name.clone())]].concat();
            added.then(|| format!("to replace the whole table: --set '{key}={{ {name} = {typed} }}'"))
        })
    }
}
