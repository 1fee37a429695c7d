//! Text that a shell reads again or that a terminal shows: nothing in it is taken for a command.

use std::borrow::Cow;

/// The text as one word of a POSIX shell: as it is where nothing in it means something to the shell, else in single quotes.
///
/// ```
/// use plummer::app::shell_word::shell_word;
/// assert_eq!(shell_word("cases/é.toml"), "cases/é.toml");
/// assert_eq!(shell_word("my case.toml"), "'my case.toml'");
/// assert_eq!(shell_word("it's"), r"'it'\''s'");
/// ```
#[must_use]
pub fn shell_word(text: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+:,@%".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

/// Text for a terminal: names of a case or a mesh may have control characters in them, which could rewrite what is shown. All but
/// the ends of lines and tabs become the replacement character.
pub(crate) fn printable(text: &str) -> Cow<'_, str> {
    let control = |c: char| c.is_control() && c != '\n' && c != '\t';
    if text.contains(control) { Cow::Owned(text.replace(control, "\u{fffd}")) } else { Cow::Borrowed(text) }
}

#[cfg(test)]
mod tests {
    use super::shell_word;

    #[test]
    fn nothing_is_left_to_the_shell() {
        for (text, word) in [
            ("", "''"),
            ("~/a", "'~/a'"),
            ("a=b", "'a=b'"),
            ("$(b)", "'$(b)'"),
            ("a\nb", "'a\nb'"),
            ("--out", "--out"),
            ("a*", "'a*'"),
        ] {
            assert_eq!(shell_word(text), word);
        }
    }
}
