//! A case file as text and arguments; from there to values and to places.
//!
//! Cases told apart by the values in them.

use super::decode::Fault;
use super::error::CaseError;
use super::tree::{Mark, Node, Value, parse_path};
use super::{named_bearing, set};
use crate::files;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write;
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
pub(super) struct Document<'a> {
    source: &'a Source,
    pub(super) root: Node,
}

impl<'a> Document<'a> {
    /// Reads the text and applies the arguments in order.
    pub(super) fn read(source: &'a Source) -> Result<Self, CaseError> {
        let mut root = Node::read(&source.text).map_err(|fault| {
            let place = format!("{}:{}", source.path.display(), fault.line);
            CaseError::at(place, format!("not valid TOML: {}", fault.message))
        })?;
        named_bearing::as_table(&mut root);
        for (index, argument) in source.set.iter().enumerate() {
            set::apply(&mut root, argument, Mark::Set(index))
                .map_err(|rule| CaseError::at(format!("--set {argument}"), &rule).with_help(rule.help()))?;
            named_bearing::as_table(&mut root);
        }
        let mut document = Self { source, root };
        let filled = named_bearing::fill(&mut document.root);
        filled.map_err(|fault| document.error(fault))?;
        Ok(document)
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
            Some(Mark::Set(index)) => format!("--set {}", self.source.set.get(index).map_or("", String::as_str)),
            None => file.to_string(),
        }
    }

    /// Turns the decoder's fault into an error with its place.
    pub(super) fn error(&self, fault: Fault) -> CaseError {
        let what = format!("{}`{}`{}", fault.before, fault.key(), fault.after);
        CaseError::at(self.marked(fault.mark), what).with_help(fault.help).with_valid(fault.valid)
    }
}

/// Tables that say how results are looked at, not what they are.
const VIEWS: [&str; 3] = ["analysis", "title", "report"];

impl Source {
    /// SHA-256 of the case's values with the arguments applied, 64 hexadecimal digits, without the tables `unread` and those that say how
    /// results are looked at. The order of keys, comments and the form of numbers play no part.
    ///
    /// # Errors
    /// [`CaseError`] for a text that is no TOML, or arguments that cannot be applied.
    pub(super) fn digest(&self, unread: &[&str]) -> Result<String, CaseError> {
        let document = Document::read(self)?;
        let mut text = String::new();
        if let Value::Table(keys) = &document.root.value {
            let keys = keys.iter().filter(|(key, _)| !VIEWS.contains(&key.as_str()) && !unread.contains(&key.as_str()));
            keys.for_each(|(key, node)| {
                let _ = write!(text, "{key:?}=");
                write_values(node, &mut text);
            });
        }
        Ok(files::hex(Sha256::new_with_prefix(text)))
    }
}

/// A value in one form, whatever its form in the file: whole numbers are numbers.
fn write_values(node: &Node, text: &mut String) {
    let _ = match &node.value {
        Value::Text(value) | Value::Moment(value) => write!(text, "{value:?},"),
        Value::Integer(value) => write!(text, "{:?},", *value as f64),
        Value::Float(value) => write!(text, "{value:?},"),
        Value::Flag(value) => write!(text, "{value},"),
        Value::List(items) => {
            text.push('[');
            items.iter().for_each(|item| write_values(item, text));
            write!(text, "],")
        }
        Value::Table(keys) => {
            text.push('{');
            for (key, value) in keys {
                let _ = write!(text, "{key:?}=");
                write_values(value, text);
            }
            write!(text, "}},")
        }
    };
}

#[cfg(test)]
mod tests {
    use super::Source;

    fn digest(text: &str, set: &[&str]) -> String {
        let source =
            Source { text: text.to_owned(), set: set.iter().map(|&set| set.to_owned()).collect(), ..Source::default() };
        source.digest(&[]).unwrap()
    }

    #[test]
    fn values_tell_cases_apart_and_their_form_does_not() {
        let case = "[shaft]\nmass = 2.0\n[ring]\nnodes = 24\nname = \"a\"\n";
        let same = "# words\n[ring]\nname = 'a'\nnodes = 2_4\n[shaft]\nmass = 0.2e1\n[analysis]\nenergy = true\n[report]\nauthor = 'A'\n";
        assert_eq!(digest(case, &[]), digest(same, &[]));
        assert_eq!(
            digest(case, &[]),
            digest("[shaft]\nmass = 3\n[ring]\nnodes = 24\nname = \"a\"\n", &["shaft.mass=2"])
        );
        assert_eq!(digest(case, &[]).len(), 64);
        for other in ["shaft.mass=2.0000000000000004", "ring.nodes=25", "ring.name=b", "ring.more=[1, 2]"] {
            assert_ne!(digest(case, &[]), digest(case, &[other]), "{other}");
        }
        // what stands in a list is not what stands in two
        assert_ne!(digest("a = [[1], [2]]\n", &[]), digest("a = [[1, 2]]\n", &[]));
        assert_ne!(digest("a = [\"1\"]\n", &[]), digest("a = [1]\n", &[]));
    }
}
