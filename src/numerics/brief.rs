//! Numbers in messages: as many digits as somebody reads.

use std::fmt::{Display, Formatter, Result};

/// A number with at most seven significant digits: the seventh is below a part in a million of it, and round-off of a computed limit
/// ("25599.999839999375") stands behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Brief(pub f64);

impl Brief {
    /// A number with at most so many significant digits, 1 to 7.
    pub(crate) fn rounded(number: f64, digits: usize) -> Self {
        Self(format!("{number:.*e}", digits.saturating_sub(1)).parse().unwrap_or(number))
    }
}

impl Display for Brief {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        // the text of a number always reads back
        let number: f64 = format!("{:.6e}", self.0).parse().unwrap_or(self.0);
        let size = number.abs();
        if size > 0.0 && !(1e-3..1e6).contains(&size) { write!(f, "{number:e}") } else { write!(f, "{number}") }
    }
}

#[cfg(test)]
mod tests {
    use super::Brief;

    #[test]
    fn round_off_is_not_shown() {
        for (number, text) in [
            (25_599.999_839_999_375, "25600"),
            (5.000_000_031_250_122_5, "5"),
            (8000.0, "8000"),
            (0.1 + 0.2, "0.3"),
            (-2.5e-6, "-2.5e-6"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(Brief(number).to_string(), text);
        }
        // no power of ten that is one
        assert_eq!(Brief::rounded(1.570_42, 4).to_string(), "1.57");
        assert_eq!(Brief::rounded(0.0, 4).to_string(), "0");
    }
}
