//! Pieces of SVG text. Places and lengths are in pixels, right and down, and are written to a tenth of a pixel.

use std::fmt::Write;

use super::number::{display_unit, significant};

/// Attributes of a chart.
pub(super) const CHART: &str = "class=\"bars\"";
/// Attributes of the title of an axis, and of a text that is centred at its place or ends there.
pub(super) const TITLE: &str = "class=\"title\" text-anchor=\"middle\"";
pub(super) const MIDDLE: &str = "text-anchor=\"middle\"";
pub(super) const END: &str = "text-anchor=\"end\"";

/// Text with the characters that mean something in HTML and SVG replaced.
pub(super) fn escape(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;").replace('\'', "&#39;")
}

/// The start of a picture with its title, which screen readers tell and browsers show under the pointer.
pub(super) fn opening(look: &str, [width, height]: [f64; 2], title: &str) -> String {
    let title = escape(title);
    format!("<svg {look} viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>")
}

/// A text; `look` are its attributes, here and below.
pub(super) fn text(out: &mut String, look: &str, [x, y]: [f64; 2], text: &str) {
    let text = escape(text);
    begin(out, "text", look);
    // Writing to a string cannot fail, here and below.
    let _ = write!(out, " x=\"{x:.1}\" y=\"{y:.1}\">{text}</text>");
}

/// A text that reads upwards, from its place or about it.
pub(super) fn upward(out: &mut String, look: &str, [x, y]: [f64; 2], text: &str) {
    let text = escape(text);
    begin(out, "text", look);
    let _ = write!(out, " transform=\"translate({x:.1} {y:.1}) rotate(-90)\">{text}</text>");
}

/// A line from one point to another.
pub(super) fn line(out: &mut String, look: &str, [x1, y1, x2, y2]: [f64; 4]) {
    begin(out, "line", look);
    let _ = write!(out, " x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>");
}

/// A rectangle by its upper left corner, width and height; `tip` is what the reader is told who points at it, if it is
/// not empty.
pub(super) fn rect(out: &mut String, look: &str, [x, y, width, height]: [f64; 4], tip: &str) {
    begin(out, "rect", look);
    let _ = write!(out, " x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"");
    close(out, "rect", tip);
}

/// A circle with a tip as a rectangle has.
pub(super) fn circle(out: &mut String, look: &str, [x, y]: [f64; 2], radius: f64, tip: &str) {
    begin(out, "circle", look);
    let _ = write!(out, " cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"");
    close(out, "circle", tip);
}

/// A path with a tip as a rectangle has.
pub(super) fn path(out: &mut String, look: &str, data: &str, tip: &str) {
    begin(out, "path", look);
    let _ = write!(out, " d=\"{data}\"");
    close(out, "path", tip);
}

fn begin(out: &mut String, name: &str, look: &str) {
    let gap = if look.is_empty() { "" } else { " " };
    let _ = write!(out, "<{name}{gap}{look}");
}

fn close(out: &mut String, name: &str, tip: &str) {
    if tip.is_empty() {
        out.push_str("/>");
    } else {
        let _ = write!(out, "><title>{}</title></{name}>", escape(tip));
    }
}

/// A bar of a round length in a picture to scale.
pub(super) struct ScaleBar {
    pub(super) pixels: f64,
    /// Its length with the unit: "5 mm".
    pub(super) label: String,
}

impl ScaleBar {
    /// A bar of about 110 pixels.
    pub(super) fn of(pixels_a_metre: f64) -> Self {
        let metres = round_length(110.0 / pixels_a_metre);
        let unit = display_unit("m", metres);
        Self {
            pixels: metres * pixels_a_metre,
            label: format!("{} {}", significant(metres / unit.factor, 1), unit.text),
        }
    }

    /// Draws it from its left end on.
    pub(super) fn draw(&self, out: &mut String, [left, y]: [f64; 2]) {
        let (right, top) = (left + self.pixels, y - 5.0);
        let data = format!("M{left:.1} {top}V{y}H{right:.1}V{top}");
        path(out, "", &data, "");
    }
}

/// The nearest of 1, 2 or 5 times a power of ten.
fn round_length(wanted: f64) -> f64 {
    let power = 10_f64.powf(wanted.log10().floor());
    let far = |nice: f64| (nice * power / wanted).ln().abs();
    let nearest = [1.0, 2.0, 5.0, 10.0].into_iter().min_by(|a, b| far(*a).total_cmp(&far(*b)));
    nearest.unwrap_or(1.0) * power
}

/// Path data under construction: lines through points in pixels, written to a tenth of a pixel.
#[derive(Debug, Default)]
pub(super) struct Path {
    /// For the attribute `d`.
    pub(super) data: String,
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

    /// A line of its own through points.
    pub(super) fn line(&mut self, points: impl IntoIterator<Item = [f64; 2]>) {
        self.gap();
        for [x, y] in points {
            self.to(x, y);
        }
    }

    /// Ends the line.
    pub(super) fn gap(&mut self) {
        self.last = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_that_means_something_is_escaped() {
        assert_eq!(escape("<b a='1'>\"x\" & y</b>"), "&lt;b a=&#39;1&#39;&gt;&quot;x&quot; &amp; y&lt;/b&gt;");
    }

    #[test]
    fn paths_have_gaps_and_no_standstill() {
        let mut path = Path::default();
        path.to(1.0, 2.04);
        path.to(1.01, 2.0);
        path.to(3.25, -4.0);
        path.gap();
        path.to(5.0, 6.0);
        assert_eq!(path.data, "M1 2L3.3 -4M5 6");
    }
}
