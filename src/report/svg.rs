//! Pieces of SVG text.

use std::fmt::Write;

/// Text with the characters that mean something in HTML and SVG replaced.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    out
}

/// Path data under construction: lines through points in pixels, written to a tenth of a pixel.
#[derive(Debug, Default)]
pub(super) struct Path {
    data: String,
    last: Option<(i64, i64)>,
}

impl Path {
    /// Goes on to a point, or starts a new line there after a gap. A step below a tenth of a pixel is not written.
    pub(super) fn to(&mut self, x: f64, y: f64) {
        let tenths = ((x * 10.0).round() as i64, (y * 10.0).round() as i64);
        if self.last == Some(tenths) {
            return;
        }
        let letter = if self.last.is_some() { 'L' } else { 'M' };
        let (x, y) = (tenths.0 as f64 / 10.0, tenths.1 as f64 / 10.0);
        // Writing to a string cannot fail.
        let _ = write!(self.data, "{letter}{x} {y}");
        self.last = Some(tenths);
    }

    /// Ends the line.
    pub(super) fn gap(&mut self) {
        self.last = None;
    }

    /// The path data for the attribute `d`.
    pub(super) fn data(self) -> String {
        self.data
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_that_means_something_is_escaped() {
        assert_eq!(
            escape("<b a='1'>\"x\" & y</b>"),
            "&lt;b a=&#39;1&#39;&gt;&quot;x&quot; &amp; y&lt;/b&gt;"
        );
    }

    #[test]
    fn paths_have_gaps_and_no_standstill() {
        let mut path = Path::default();
        path.to(1.0, 2.04);
        path.to(1.01, 2.0);
        path.to(3.25, -4.0);
        path.gap();
        path.to(5.0, 6.0);
        assert_eq!(path.data(), "M1 2L3.3 -4M5 6");
    }
}
