//! A case file as a tree of values, each with the place where it was written.
//!
//! Key paths such as `bearing.defects[0].depth`: reading and writing them.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Where a value was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    /// Line of the case file, from 1.
    Line(usize),
    /// Position among the `--set` arguments, from 0.
    Set(usize),
}

/// A value and its place.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) mark: Mark,
    pub(super) value: Value,
}

/// What TOML can hold, numbers read.
#[derive(Debug, Clone)]
pub(super) enum Value {
    Text(String),
    Integer(i64),
    Float(f64),
    Flag(bool),
    /// A date or time, which no key takes; kept to be named in the error.
    Moment(String),
    List(Vec<Node>),
    Table(BTreeMap<String, Node>),
}

/// A text that TOML refuses: the line, and the parser's reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct SyntaxFault {
    pub(super) line: usize,
    pub(super) message: String,
}

impl Node {
    /// Reads a whole case file.
    pub(super) fn read(text: &str) -> Result<Self, SyntaxFault> {
        let lines = Lines::of(text, None);
        let table = DeTable::parse(text).map_err(|error| lines.fault(&error))?;
        Ok(Self { mark: Mark::Line(1), value: lines.table(table.get_ref())? })
    }

    /// Reads one TOML value given as an argument; every part of it carries `mark`.
    pub(super) fn read_value(text: &str, mark: Mark) -> Result<Self, SyntaxFault> {
        let lines = Lines::of(text, Some(mark));
        let value = DeValue::parse(text).map_err(|error| lines.fault(&error))?;
        Ok(Self { mark, value: lines.value(value.get_ref(), 1)? })
    }

    /// Returns the node one step down, if it is there.
    pub(super) fn child(&self, step: &Step) -> Option<&Self> {
        match (&self.value, step) {
            (Value::Table(entries), Step::Key(key)) => entries.get(key),
            (Value::List(items), Step::Index(index)) => items.get(*index),
            _ => None,
        }
    }

    /// Returns the mark of the deepest node along `steps`; `None` if not even the first step is there.
    pub(super) fn nearest_mark(&self, steps: &[Step]) -> Option<Mark> {
        let mut node = self;
        let mut mark = None;
        for step in steps {
            let Some(child) = node.child(step) else { break };
            node = child;
            mark = Some(node.mark);
        }
        mark
    }

    /// Names the value for an error message.
    pub(super) fn describe(&self) -> String {
        match &self.value {
            Value::Text(text) => format!("\"{text}\""),
            Value::Integer(number) => number.to_string(),
            Value::Float(number) => number.to_string(),
            Value::Flag(flag) => flag.to_string(),
            Value::Moment(text) => format!("the date {text}"),
            Value::List(items) => format!("an array of {}", items.len()),
            Value::Table(_) => "a table".to_owned(),
        }
    }
}

/// Offsets at which lines start, to turn a span into a line number; the mark of all nodes where it is not their line.
struct Lines {
    starts: Vec<usize>,
    mark: Option<Mark>,
}

impl Lines {
    fn of(text: &str, mark: Option<Mark>) -> Self {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        Self { starts, mark }
    }

    fn line(&self, span: &Range<usize>) -> usize {
        self.starts.partition_point(|&start| start <= span.start)
    }

    fn fault(&self, error: &toml::de::Error) -> SyntaxFault {
        SyntaxFault {
            line: error.span().map_or(1, |span| self.line(&span)),
            message: error.message().replace('\n', ", "),
        }
    }

    fn node(&self, value: &Spanned<DeValue<'_>>, line: usize) -> Result<Node, SyntaxFault> {
        Ok(Node { mark: self.mark.unwrap_or(Mark::Line(line)), value: self.value(value.get_ref(), line)? })
    }

    fn table(&self, table: &DeTable<'_>) -> Result<Value, SyntaxFault> {
        let mut entries = BTreeMap::new();
        for (key, value) in table {
            let node = self.node(value, self.line(&key.span()))?;
            entries.insert(key.get_ref().to_string(), node);
        }
        Ok(Value::Table(entries))
    }

    fn value(&self, value: &DeValue<'_>, line: usize) -> Result<Value, SyntaxFault> {
        let unreadable =
            |number: &dyn std::fmt::Display| SyntaxFault { line, message: format!("the number {number} does not fit") };
        Ok(match value {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix())
                .map(Value::Integer)
                .map_err(|_| unreadable(number))?,
            DeValue::Float(number) => number.as_str().parse().map(Value::Float).map_err(|_| unreadable(number))?,
            DeValue::Boolean(flag) => Value::Flag(*flag),
            DeValue::Datetime(moment) => Value::Moment(moment.to_string()),
            DeValue::Array(items) => Value::List(
                items.iter().map(|item| self.node(item, self.line(&item.span()))).collect::<Result<_, _>>()?,
            ),
            DeValue::Table(table) => self.table(table)?,
        })
    }
}

/// One step down a case file's tree.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Step {
    /// Into a table, by key.
    Key(String),
    /// Into an array, by position from 0.
    Index(usize),
}

/// Writes steps as one key path; keys that TOML would have to quote are quoted.
pub(super) fn format_path(steps: &[Step]) -> String {
    let mut text = String::new();
    for step in steps {
        match step {
            Step::Key(key) => {
                if !text.is_empty() {
                    text.push('.');
                }
                text.push_str(&quoted(key));
            }
            Step::Index(index) => {
                // Writing to a `String` cannot fail.
                let _ = write!(text, "[{index}]");
            }
        }
    }
    text
}

/// Returns a key as it must be written in a path: bare where possible, else in double quotes.
pub(super) fn quoted(key: &str) -> String {
    if !key.is_empty() && key.chars().all(is_bare) { key.to_owned() } else { format!("\"{key}\"") }
}

/// Reads a key path; `None` when it is malformed (empty step, open quote or bracket, stray character).
///
/// An index is `[0]` or, when the tree holds an array there, a bare `.0`, which this function returns as a key.
pub(super) fn parse_path(text: &str) -> Option<Vec<Step>> {
    let mut steps = Vec::new();
    let mut rest = text;
    loop {
        let (key, after) = take_key(rest)?;
        steps.push(Step::Key(key));
        rest = after;
        while let Some(inner) = rest.strip_prefix('[') {
            let (index, after) = inner.split_once(']')?;
            steps.push(Step::Index(index.trim().parse().ok()?));
            rest = after;
        }
        if rest.is_empty() {
            return Some(steps);
        }
        rest = rest.strip_prefix('.')?;
    }
}

fn is_bare(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_' || letter == '-'
}

fn take_key(text: &str) -> Option<(String, &str)> {
    for quote in ['"', '\''] {
        if let Some(inner) = text.strip_prefix(quote) {
            return inner.split_once(quote).map(|(key, rest)| (key.to_owned(), rest));
        }
    }
    let end = text.find(|letter| !is_bare(letter)).unwrap_or(text.len());
    (end > 0).then(|| (text[..end].to_owned(), &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::super::tree::parse_path;
    use super::{Mark, Node, Value};

    const TEXT: &str = "title = \"a\"\n\n[bearing]\nballs = 7\nplay = -2.5e-6\n\n[[bearing.defects]]\ndepth = 1\n\n[[bearing.defects]]\ndepth = 0x1_0\nlist = [\n  1,\n  { on = true },\n]\n";

    fn mark(node: &Node, path: &str) -> Option<Mark> {
        node.nearest_mark(&parse_path(path).unwrap())
    }

    #[test]
    fn every_value_knows_its_line() {
        let node = Node::read(TEXT).unwrap();
        for (path, line) in [
            ("title", 1),
            ("bearing", 3),
            ("bearing.balls", 4),
            ("bearing.defects[0]", 7),
            ("bearing.defects[0].depth", 8),
            ("bearing.defects[1]", 10),
            ("bearing.defects[1].depth", 11),
            ("bearing.defects[1].list[0]", 13),
            ("bearing.defects[1].list[1].on", 14),
            ("bearing.missing", 3),
        ] {
            assert_eq!(mark(&node, path), Some(Mark::Line(line)), "{path}");
        }
        assert_eq!(mark(&node, "missing.key"), None);
    }

    #[test]
    fn numbers_are_read_in_every_notation_of_toml() {
        let number = |text| Node::read_value(text, Mark::Set(0)).unwrap().value;
        assert!(matches!(number("0x1_0"), Value::Integer(16)));
        assert!(matches!(number("-7"), Value::Integer(-7)));
        assert!(matches!(number("1_000.5"), Value::Float(x) if (x - 1000.5).abs() < 1e-12));
        assert!(matches!(number("-2.5e-6"), Value::Float(x) if (x + 2.5e-6).abs() < 1e-20));
        assert!(matches!(number("+1e3"), Value::Float(x) if (x - 1e3).abs() < 1e-12));
    }

    #[test]
    fn a_syntax_error_names_its_line() {
        let fault = Node::read("title = \"a\"\nballs = = 7\n").unwrap_err();
        assert_eq!(fault.line, 2);
        let fault = Node::read("a = 1\nb = 2\na = 3\n").unwrap_err();
        assert_eq!((fault.line, fault.message.as_str()), (3, "duplicate key"));
        let fault = Node::read("a = 99999999999999999999\n").unwrap_err();
        assert_eq!(fault.message, "the number 99999999999999999999 does not fit");
    }
}

#[cfg(test)]
mod path_tests {
    use super::{Step, format_path, parse_path};

    fn key(text: &str) -> Step {
        Step::Key(text.to_owned())
    }

    #[test]
    fn a_path_survives_reading_and_writing() {
        for text in ["title", "bearing.defects[0].depth", "materials.\"bearing steel\".young", "a[1][2].b"] {
            let steps = parse_path(text).unwrap();
            assert_eq!(format_path(&steps), text);
        }
        assert_eq!(parse_path("defects[3].on").unwrap(), [key("defects"), Step::Index(3), key("on")]);
        assert_eq!(parse_path("materials.'bearing steel'").unwrap(), [key("materials"), key("bearing steel")]);
    }

    #[test]
    fn a_malformed_path_is_refused() {
        for text in ["", ".", "a.", ".a", "a..b", "a[", "a[x]", "a[0", "a b", "\"a", "a]"] {
            assert_eq!(parse_path(text), None, "{text}");
        }
    }
}
