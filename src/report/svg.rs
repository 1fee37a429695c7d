//! Pieces of SVG text. Places and lengths are in pixels, right and down, and are written to a tenth of a pixel.
//!
//! Colours of plots, charts and shapes, the same in the pictures and in the browser.

use super::number::{display_unit, significant};
use std::fmt::Write;

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

/// Red, green and blue, 0 to 255.
pub(super) type Rgb = [u8; 3];

/// Colours written as in CSS.
const fn colours<const N: usize>(hex: [u32; N]) -> [Rgb; N] {
    let mut colours = [[0; 3]; N];
    let mut k = 0;
    while k < N {
        let [_, r, g, b] = hex[k].to_be_bytes();
        colours[k] = [r, g, b];
        k += 1;
    }
    colours
}

/// Viridis at k / 15: perceptually uniform, readable in grey and by the colour-blind (S. van der Walt, N. Smith,
/// matplotlib 1.5, 2015, public domain).
pub(super) const VIRIDIS: [Rgb; 16] = colours([
    0x44_01_54, 0x48_1a_6c, 0x47_2f_7d, 0x41_44_87, 0x39_56_8c, 0x31_68_8e, 0x2a_78_8e, 0x23_88_8e, 0x1f_98_8b,
    0x22_a8_84, 0x35_b7_79, 0x54_c5_68, 0x7a_d1_51, 0xa5_db_36, 0xd2_e2_1b, 0xfd_e7_25,
]);

/// White to dark blue, by even steps of lightness.
const BLUES: [Rgb; 5] = [[255, 255, 255], [206, 221, 236], [142, 178, 212], [75, 125, 175], [20, 61, 110]];

/// Colours of curves, bars and markers as the style sheet has them on white; the next one begins again.
pub(super) const SERIES: [&str; 6] = ["#1f5a99", "#c8511b", "#2e7d4f", "#7b4ea3", "#8c6d1f", "#4d5761"];

/// How many colours curves, bars and markers have.
pub(super) const COLOURS: usize = SERIES.len();

/// Colours of groups: muted, of similar lightness, told apart in print.
const GROUPS: [Rgb; 10] = colours([
    0x8f_ae_cb, 0xe0_a0_6c, 0x9b_bf_8f, 0xc9_94_b5, 0xd6_c1_6b, 0x7f_bf_c0, 0xd9_8a_86, 0xa9_9f_d1, 0xb0_a0_8c,
    0xb4_bb_c2,
]);

/// Colour of thick lines.
pub(super) const LINE: Rgb = [0xc8, 0x3a, 0x1b];

/// Colour of a group.
pub(super) fn group(index: usize) -> Rgb {
    GROUPS[index % GROUPS.len()]
}

/// The colour at a part of a scale, 0 to 1, straight between its `N` supports, two at least; `at` is taken to 0..1.
fn between<const N: usize>(scale: [Rgb; N], at: f64) -> Rgb {
    let place = at.clamp(0.0, 1.0) * (N - 1) as f64;
    let low = (place.floor() as usize).min(N - 2);
    let part = place - low as f64;
    let (a, b) = (scale[low], scale[low + 1]);
    std::array::from_fn(|k| (f64::from(a[k]) * (1.0 - part) + f64::from(b[k]) * part).round() as u8)
}

/// Viridis between its supports; `at` is taken to 0..1.
pub(super) fn viridis(at: f64) -> Rgb {
    between(VIRIDIS, at)
}

/// White to dark blue; `at` is taken to 0..1.
pub(super) fn blues(at: f64) -> Rgb {
    between(BLUES, at)
}

/// A colour made darker: 1 leaves it, 0 makes it black.
pub(super) fn shaded(colour: Rgb, light: f64) -> Rgb {
    colour.map(|c| (f64::from(c) * light.clamp(0.0, 1.0)).round() as u8)
}

/// As CSS writes it.
pub(super) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
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

#[cfg(test)]
mod palette_tests {
    use super::*;

    #[test]
    fn the_map_gets_lighter_all_the_way() {
        // Relative luminance, ITU-R BT.709; the map is also right when printed in grey.
        let luminance = |[r, g, b]: Rgb| {
            let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
            0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
        };
        let steps: Vec<f64> = (0..=60).map(|k| luminance(viridis(f64::from(k) / 60.0))).collect();
        assert!(steps.windows(2).all(|w| w[1] > w[0]), "{steps:?}");
        assert_eq!(hex(viridis(-1.0)), "#440154");
        assert_eq!(hex(viridis(2.0)), "#fde725");
        assert_eq!(hex(viridis(7.0 / 15.0)), "#23888e");
    }

    #[test]
    fn shading_darkens_and_groups_begin_again() {
        assert_eq!(shaded([200, 100, 50], 0.5), [100, 50, 25]);
        assert_eq!(group(0), group(10));
        assert_ne!(group(0), group(1));
    }
}
