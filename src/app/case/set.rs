//! `--set KEY=VALUE`: changing single values of a case file from outside.

use std::collections::BTreeMap;

use super::check::Rule;
use super::tree::{Mark, Node, Step, Value, format_path, parse_path};

/// What to write where an argument has no key that can be read.
const EXAMPLES: &str = "for example: --set bearing.formulation=printed, or --set 'bearing.defects[0].depth=2e-5'";

/// Changes `root` as the argument says; what is set carries `mark`.
///
/// A table that is not there is made; whether the keys mean anything is for the decoder to say. An item of an array
/// is reached by `[0]` or `.0`.
///
/// # Errors
/// A [`Rule`] when the argument is malformed or leads through a value without parts.
pub(super) fn apply(root: &mut Node, argument: &str, mark: Mark) -> Result<(), Rule> {
    let (key, typed) =
        split_argument(argument).ok_or_else(|| Rule::found("no `=`", "KEY=VALUE").with_help(EXAMPLES))?;
    let steps = parse_path(key).ok_or_else(|| {
        let expected = "names joined by dots, e.g. `bearing.defects[0].depth`";
        Rule::found(format!("the key path `{key}`"), expected).with_help(EXAMPLES)
    })?;
    let mut value = read_value(typed, mark)?;
    // a customer whose name is a numeral is called as it was typed
    let named = matches!(&steps[..], [Step::Key(table), Step::Key(_)] if table == "report");
    if named && !matches!(value.value, Value::Text(_) | Value::List(_) | Value::Table(_)) {
        value.value = Value::Text(typed.to_owned());
    }
    let mut node = root;
    for (depth, step) in steps.iter().enumerate() {
        if let (Value::Table(entries), Step::Key(key), true) = (&mut node.value, step, depth + 1 == steps.len())
            && let Some(other) = in_place_of(key)
        {
            entries.remove(other);
        }
        node = descend(node, &steps[..depth], step, mark)?;
    }
    *node = value;
    Ok(())
}

/// The key that says the same in another unit: of the two a table has one, and what is set takes the place of what is there.
fn in_place_of(key: &str) -> Option<&'static str> {
    match key {
        "hz" => Some("rpm"),
        "rpm" => Some("hz"),
        _ => None,
    }
}

/// The first argument of which a later one leaves nothing, and that one: it sets the same key, or a table or array around it.
///
/// ```
/// use plummer::app::case::replaced_argument;
///
/// let set = ["shaft.mass=1", "modes={count=3}", "modes.count=4"].map(str::to_owned);
/// assert_eq!(replaced_argument(&set), None);
/// let set = ["modes.count=4", "modes={up_to_hz=1e4}"].map(str::to_owned);
/// assert_eq!(replaced_argument(&set), Some(set));
/// ```
#[must_use]
pub fn replaced_argument(arguments: &[String]) -> Option<[String; 2]> {
    let names = |argument: &String| -> Option<Vec<String>> {
        let (key, _) = split_argument(argument)?;
        let name = |step: Step| match step {
            Step::Key(key) if key == "rpm" => "hz".to_owned(),
            Step::Key(key) => key,
            Step::Index(index) => index.to_string(),
        };
        Some(parse_path(key)?.into_iter().map(name).collect())
    };
    let keys: Vec<_> = arguments.iter().map(names).collect();
    for (place, later) in keys.iter().enumerate() {
        let Some(later) = later else { continue };
        let earlier = keys[..place]
            .iter()
            .position(|earlier| (earlier.as_ref()).is_some_and(|earlier| earlier.starts_with(later)));
        if let Some(earlier) = earlier {
            return Some([arguments[earlier].clone(), arguments[place].clone()]);
        }
    }
    None
}

/// An argument as messages show it.
pub(super) fn told_argument(argument: &str) -> String {
    format!("--set {}", on_one_line(argument))
}

/// A text with its line breaks as `\n`.
fn on_one_line(text: &str) -> String {
    text.replace('\r', "\\r").replace('\n', "\\n")
}

/// Splits `KEY=VALUE` at the first `=` outside quotes, spaces around both left out; `None` without one.
#[must_use]
pub(crate) fn split_argument(argument: &str) -> Option<(&str, &str)> {
    let mut quote = None;
    let at = argument.char_indices().find_map(|(at, letter)| {
        match (quote, letter) {
            (None, '=') => return Some(at),
            (None, '"' | '\'') => quote = Some(letter),
            (Some(open), _) if open == letter => quote = None,
            _ => {}
        }
        None
    })?;
    Some((argument[..at].trim(), argument[at + 1..].trim()))
}

/// Reads TOML; a text without quotes, brackets or braces that is not TOML stands for itself.
fn read_value(text: &str, mark: Mark) -> Result<Node, Rule> {
    let fault = match Node::read_value(text, mark) {
        Ok(node) => return Ok(node),
        Err(fault) => fault,
    };
    if text.is_empty() || text.contains(['"', '\'', '[', ']', '{', '}', '\n']) {
        let expected = format!("a TOML value or a bare word: {}", fault.message);
        return Err(Rule::found(format!("the value `{}`", on_one_line(text)), &expected)
            .with_help("quote it twice: --set 'title=\"with {braces}\"'"));
    }
    Ok(Node { mark, value: Value::Text(text.to_owned()) })
}

fn descend<'a>(node: &'a mut Node, above: &[Step], step: &Step, mark: Mark) -> Result<&'a mut Node, Rule> {
    let found = node.describe();
    let key = format_path(above);
    let beyond = |index: usize, length: usize| {
        Rule::found(format!("position {index} of `{key}`"), &format!("one below {length}"))
            .with_help("positions count from 0; to add an item set the whole array: --set 'KEY=[...]'")
    };
    let no_table =
        || Rule::new(format!("`{key}` is {found}, it has no keys of its own")).with_help("set that key itself");
    match (&mut node.value, step) {
        (Value::Table(entries), Step::Key(key)) => {
            Ok(entries.entry(key.clone()).or_insert_with(|| Node { mark, value: Value::Table(BTreeMap::new()) }))
        }
        (Value::List(items), step) => {
            let index = match step {
                Step::Index(index) => Some(*index),
                Step::Key(key) => key.parse().ok(),
            };
            let length = items.len();
            match index {
                Some(index) => items.get_mut(index).ok_or_else(|| beyond(index, length)),
                None => Err(no_table()),
            }
        }
        (_, Step::Index(index)) => Err(beyond(*index, 0)),
        (_, Step::Key(_)) => Err(no_table()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::tree::{Mark, Node, parse_path};
    use super::apply;

    const TEXT: &str =
        "title = \"a\"\n[bearing]\nballs = 7\n[[bearing.defects]]\ndepth = 1\n[[bearing.defects]]\ndepth = 2\n";

    fn after(argument: &str, path: &str) -> (String, Mark) {
        let mut root = Node::read(TEXT).unwrap();
        apply(&mut root, argument, Mark::Set(4)).unwrap();
        let mut node = &root;
        for step in parse_path(path).unwrap() {
            node = node.child(&step).unwrap();
        }
        (node.describe(), node.mark)
    }

    fn problem(argument: &str) -> String {
        let mut root = Node::read(TEXT).unwrap();
        apply(&mut root, argument, Mark::Set(0)).unwrap_err().to_string()
    }

    #[test]
    fn values_are_toml_or_bare_words() {
        let set = Mark::Set(4);
        for (argument, path, value) in [
            ("bearing.balls=9", "bearing.balls", "9"),
            ("bearing.balls = 9 ", "bearing.balls", "9"),
            ("bearing.fit=sliding", "bearing.fit", "\"sliding\""),
            ("bearing.fit=\"a=b\"", "bearing.fit", "\"a=b\""),
            ("housing.mesh=../a b.msh", "housing.mesh", "\"../a b.msh\""),
            ("ring.shear=false", "ring.shear", "false"),
            ("bearing.defects[1].depth=3", "bearing.defects[1].depth", "3"),
            ("bearing.defects.1.depth=3", "bearing.defects[1].depth", "3"),
            ("bearing.defects=[]", "bearing.defects", "an array of 0"),
            ("report.customer=4711", "report.customer", "\"4711\""),
            ("report.project=1.10", "report.project", "\"1.10\""),
            ("report.project=2026-11-27", "report.project", "\"2026-11-27\""),
            ("a.b={c=[1,2]}", "a.b.c", "an array of 2"),
            ("materials.\"x=y\".young=1", "materials.\"x=y\".young", "1"),
        ] {
            assert_eq!(after(argument, path), (value.to_owned(), set), "{argument}");
        }
    }

    #[test]
    fn the_rest_of_a_table_keeps_its_place() {
        let (_, mark) = after("bearing.defects[1].depth=3", "bearing.defects[1]");
        assert_eq!(mark, Mark::Line(6));
        let (value, mark) = after("bearing.defects[1].depth=3", "bearing.defects[0].depth");
        assert_eq!((value.as_str(), mark), ("1", Mark::Line(5)));
    }

    #[test]
    fn a_malformed_argument_is_named() {
        assert_eq!(problem("bearing.balls"), "found no `=`, expected KEY=VALUE");
        assert_eq!(
            problem("bearing..balls=1"),
            "found the key path `bearing..balls`, expected names joined by dots, e.g. `bearing.defects[0].depth`"
        );
        assert_eq!(problem("title.x=1"), "`title` is \"a\", it has no keys of its own");
        assert_eq!(problem("bearing.defects.depth=1"), "`bearing.defects` is an array of 2, it has no keys of its own");
        assert_eq!(
            problem("bearing.defects[2].depth=1"),
            "found position 2 of `bearing.defects`, expected one below 2"
        );
        assert_eq!(problem("bearing[0]=1"), "found position 0 of `bearing`, expected one below 0");
        assert!(
            problem("bearing.defects=[1").starts_with("found the value `[1`, expected a TOML value or a bare word: ")
        );
        assert!(problem("title=").starts_with("found the value ``, expected a TOML value"));
    }
}
