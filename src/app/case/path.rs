//! Key paths such as `bearing.defects[0].depth`: reading and writing them.

use std::fmt::Write as _;

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
