//! Lines of a case file: values, notes about them, and what is commented out.

/// Widest line of a note.
const WIDTH: usize = 118;

/// Mark between a value and where it comes from. Names of a mesh are quoted and do not have it.
pub(crate) const ORIGIN: &str = "\u{1f}";

/// The text of a case file from its lines in short: `~ words` is a note over as many lines as it takes; [`ORIGIN`] stands between
/// `key = value`, or a row of a list, and where the value comes from. What is between `@template` and `@end` is commented out, by a mark
/// without a blank, which notes have: a value to switch on.
pub(crate) fn page(lines: &str) -> String {
    let mut text = String::new();
    let mut mark = "";
    for line in lines.lines() {
        match (line, line.split_once(ORIGIN)) {
            ("@template", _) => mark = "#",
            ("@end", _) => mark = "",
            ("", _) => text.push('\n'),
            (row, Some((item, origin))) if row.starts_with(' ') => text += &format!("{mark}{item:<58} # {origin}\n"),
            (_, Some((pair, origin))) => {
                let width = pair.chars().count() + origin.chars().count() + 44 - pair.len().min(42);
                if width > WIDTH {
                    text += &format!("{}{mark}{pair}\n", note(origin));
                } else {
                    text += &format!("{mark}{pair:<42} # {origin}\n");
                }
            }
            (line, None) => match line.strip_prefix("~ ") {
                Some(words) => text += &note(words),
                None => text += &format!("{mark}{line}\n"),
            },
        }
    }
    text
}

/// A comment over as many lines as it takes.
fn note(words: &str) -> String {
    let (mut text, mut line) = (String::new(), String::from("#"));
    for word in words.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            text += &format!("{line}\n");
            line = String::from("#");
        }
        line.push(' ');
        line.push_str(word);
    }
    format!("{text}{line}\n")
}

/// A text as TOML writes it.
pub(crate) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            // line ends of any kind and what else TOML does not take as it is; they must not end a comment either
            letter if letter.is_control() || letter == '\u{2028}' || letter == '\u{2029}' => {
                quoted.push_str(&format!("\\u{:04X}", u32::from(letter)));
            }
            letter => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}

/// A number with so many significant digits, as short as TOML takes it.
pub(crate) fn number(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{:.*e}", digits.saturating_sub(1), value).parse().unwrap_or(value);
    if rounded.abs() < f64::MIN_POSITIVE {
        return "0".to_owned();
    }
    if (1e-2..1e6).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// Numbers in an array; what is below `floor` is 0.
pub(crate) fn numbers(values: &[f64], digits: usize, floor: f64) -> String {
    let parts = values.iter().map(|&value| {
        let value = if value.abs() < floor { 0.0 } else { value };
        number(value, digits)
    });
    format!("[{}]", parts.collect::<Vec<_>>().join(", "))
}

/// "a", "a and b", "a, b and c".
pub(crate) fn list(words: &[String]) -> String {
    match words {
        [] => "none".to_owned(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::{ORIGIN, list, number, numbers, page, quoted};

    #[test]
    fn numbers_are_short_and_valid() {
        for (value, digits, text) in [
            (0.0, 6, "0"),
            (-0.0, 6, "0"),
            (6e-3, 9, "6e-3"),
            (0.012_000_000_000_1, 9, "0.012"),
            (5.370_123_4e-6, 4, "5.37e-6"),
            (-2.5, 3, "-2.5"),
            (50_000.0, 6, "50000"),
            (2.06e11, 4, "2.06e11"),
            (1.0 / 3.0, 3, "0.333"),
        ] {
            assert_eq!(number(value, digits), text);
            let read: toml::Table = toml::from_str(&format!("a = {text}")).unwrap();
            assert!(read["a"].is_float() || read["a"].is_integer(), "{text}");
        }
        assert_eq!(numbers(&[1e-12, -1.0, 0.5], 6, 1e-9), "[0, -1, 0.5]");
    }

    #[test]
    fn every_name_reads_back_and_stays_on_its_line() {
        for name in ["bore", "a \"b\"", "c:\\d", "two\nlines", "tab\tr\r", "é \u{2028}", "#"] {
            let quoted = quoted(name);
            assert!(!quoted.contains(['\n', '\r', '\u{2028}']), "{quoted}");
            let read: toml::Table = toml::from_str(&format!("a = {quoted}")).unwrap();
            assert_eq!(read["a"].as_str(), Some(name));
        }
    }

    #[test]
    fn a_template_is_a_comment_that_can_be_taken_away() {
        let lines = "@template\n\n[a]\nb = 1 ## why\n\n@end\nc = 2";
        let text = page(&lines.replace(" ## ", ORIGIN));
        assert_eq!(text, "\n#[a]\n#b = 1                                      # why\n\nc = 2\n");
        let read: toml::Table = toml::from_str(&text).unwrap();
        assert_eq!(read.len(), 1);
        let bare = text.replace("\n#", "\n");
        let read: toml::Table = toml::from_str(&bare).unwrap();
        assert_eq!(read["a"]["b"].as_integer(), Some(1));
    }

    #[test]
    fn long_notes_are_folded() {
        let text = page(&format!("~ {}\na = 1{ORIGIN}{}", "word ".repeat(60), "word ".repeat(30)));
        assert!(text.lines().all(|line| line.chars().count() <= 118), "{text}");
        assert!(text.lines().last() == Some("a = 1"), "{text}");
        assert_eq!(list(&[]), "none");
        assert_eq!(list(&["a".into(), "b".into(), "c".into()]), "a, b and c");
    }
}
