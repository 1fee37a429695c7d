//! Cases told apart by the values in them.

use std::fmt::Write;

use sha2::{Digest, Sha256};

use super::document::{Document, Source};
use super::error::CaseError;
use super::tree::{Node, Value};
use crate::files;

/// Tables that say how results are looked at, not what they are.
const VIEWS: [&str; 1] = ["analysis"];

impl Source {
    /// SHA-256 of the case's values with the arguments applied, 64 hexadecimal digits. The order of keys, comments and the form of
    /// numbers play no part, nor does `[analysis]`, which says how signals are looked at.
    ///
    /// # Errors
    /// [`CaseError`] for a text that is no TOML, or arguments that cannot be applied.
    pub(crate) fn digest(&self) -> Result<String, CaseError> {
        let document = Document::read(self)?;
        let mut text = String::new();
        if let Value::Table(keys) = &document.root.value {
            let keys = keys.iter().filter(|(key, _)| !VIEWS.contains(&key.as_str()));
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
        source.digest().unwrap()
    }

    #[test]
    fn values_tell_cases_apart_and_their_form_does_not() {
        let case = "[shaft]\nmass = 2.0\n[ring]\nnodes = 24\nname = \"a\"\n";
        let same = "# words\n[ring]\nname = 'a'\nnodes = 2_4\n[shaft]\nmass = 0.2e1\n[analysis]\nenergy = true\n";
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
