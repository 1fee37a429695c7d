//! Command lines that are shown to be typed again: each argument one word for the shell, whatever is in it.

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
