//! A number as it is typed.

/// A number that fits, else what was expected.
pub(super) fn number(text: &str, fits: fn(f64) -> bool, expected: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|&value| fits(value));
    value.ok_or_else(|| format!("expected {expected}, found \"{text}\""))
}
