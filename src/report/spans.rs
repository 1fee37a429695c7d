//! Spans beside each other: what each of several causes does to one quantity.

use serde::{Deserialize, Serialize};

use super::{ReportError, significant, svg, ticks};

const WIDTH: f64 = 920.0;
/// Where the axis begins: the names of the rows stand left of it.
const LEFT: f64 = 190.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 50.0;
/// Height of a row, and of the bar in it.
const ROW: [f64; 2] = [30.0, 12.0];
/// Part of the range left free on both sides.
const HEADROOM: f64 = 0.06;
/// Look of a label, and the width of a character of it, pixels.
const SMALL: &str = "text-anchor=\"middle\" style=\"font-size:10.5px\"";
const CHARACTER: f64 = 5.6;

/// One value that a cause can take, and where the quantity then is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpanPoint {
    /// The value, in a word or two.
    pub label: String,
    /// Where the quantity is.
    pub at: f64,
}

/// A cause with its values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpanRow {
    /// The cause.
    pub name: String,
    /// Its values.
    pub points: Vec<SpanPoint>,
}

/// A chart with a row for each cause: a bar from the lowest to the highest place of the quantity, a dot for each value, and a
/// line through all rows where the quantity is without a change.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Spans {
    /// What it shows.
    pub title: String,
    /// Caption; `None`: the title.
    pub caption: Option<String>,
    /// What the axis shows, with its unit.
    pub axis: String,
    /// Where the quantity is without a change.
    pub base: f64,
    /// Rows from top to bottom.
    pub rows: Vec<SpanRow>,
}

impl Spans {
    fn check(&self) -> Result<(), ReportError> {
        if self.rows.is_empty() || !self.base.is_finite() {
            return Err(ReportError::wrong_length(&self.title, 1, [0, 1]));
        }
        for (row, span) in (1..).zip(&self.rows) {
            let places = span.points.iter().map(|point| point.at);
            ReportError::check_row(&self.title, row, places, f64::is_finite)?;
        }
        Ok(())
    }

    pub(super) fn height(&self) -> f64 {
        TOP + ROW[0] * self.rows.len() as f64 + BOTTOM
    }

    /// Lowest and highest value shown.
    fn range(&self) -> [f64; 2] {
        let points = self.rows.iter().flat_map(|row| &row.points);
        let [low, high] = points.fold([self.base; 2], |[low, high], point| [low.min(point.at), high.max(point.at)]);
        let room = match HEADROOM * (high - low) {
            room if room > 0.0 => room,
            _ => 1.0,
        };
        [low - room, high + room]
    }
}

/// The SVG element of a chart.
pub(super) fn draw(spans: &Spans) -> Result<String, ReportError> {
    spans.check()?;
    let [low, high] = spans.range();
    let height = spans.height();
    let (right, bottom) = (WIDTH - RIGHT, height - BOTTOM);
    let x_of = |value: f64| LEFT + (value - low) / (high - low) * (right - LEFT);
    let mut out = svg::opening(svg::CHART, [WIDTH, height], &spans.title);
    for tick in ticks::linear(low, high, 9) {
        let x = x_of(tick.at);
        svg::line(&mut out, "class=\"grid\"", [x, TOP, x, bottom]);
        svg::text(&mut out, svg::MIDDLE, [x, bottom + 16.0], &tick.label.unwrap_or_default());
    }
    for (number, row) in spans.rows.iter().enumerate() {
        let top = TOP + ROW[0] * number as f64;
        draw_row(&mut out, row, spans.base, top, &x_of);
    }
    let base = x_of(spans.base);
    let frame = format!("M{LEFT} {TOP}V{bottom}H{right}M{base:.1} {TOP}V{bottom}");
    svg::path(&mut out, "class=\"frame\"", &frame, "");
    svg::text(&mut out, svg::TITLE, [0.5 * (LEFT + right), height - 8.0], &spans.axis);
    Ok(out + "</svg>")
}

fn draw_row(out: &mut String, row: &SpanRow, base: f64, top: f64, x_of: &impl Fn(f64) -> f64) {
    let at = || row.points.iter().map(|point| point.at);
    let (low, high) = (at().fold(base, f64::min), at().fold(base, f64::max));
    let (left, right) = (x_of(low), x_of(high));
    let bar = top + ROW[0] - ROW[1] - 3.0;
    svg::text(out, svg::END, [LEFT - 8.0, bar + 10.0], &row.name);
    let whole = [left, bar, (right - left).max(1.0), ROW[1]];
    svg::rect(out, "class=\"b0\" fill-opacity=\"0.35\"", whole, "");
    // labels from the left; one that would cover another is left to the tool tip
    let mut points: Vec<&SpanPoint> = row.points.iter().collect();
    points.sort_by(|a, b| a.at.total_cmp(&b.at));
    let mut free = f64::NEG_INFINITY;
    for SpanPoint { label, at } in points {
        let x = x_of(*at);
        let tip = format!("{}, {label}: {}", row.name, significant(*at, 4));
        svg::rect(out, "class=\"b1\"", [x - 1.5, bar, 3.0, ROW[1]], &tip);
        let half = 0.5 * CHARACTER * label.chars().count() as f64;
        let centre = x.clamp(LEFT + half, WIDTH - half);
        if centre - half > free {
            free = centre + half + 4.0;
            svg::text(out, SMALL, [centre, bar - 2.5], label);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Spans {
        let point = |label: &str, at| SpanPoint { label: label.to_owned(), at };
        Spans {
            title: "What moves it".to_owned(),
            caption: None,
            axis: "Frequency [kHz]".to_owned(),
            base: 8.0,
            rows: vec![
                SpanRow { name: "Width".to_owned(), points: vec![point("3 mm", 9.0), point("5 mm", 7.0)] },
                SpanRow { name: "Shear & more".to_owned(), points: vec![point("on", 7.9)] },
            ],
        }
    }

    #[test]
    fn bars_reach_from_the_lowest_to_the_highest_and_to_the_base() {
        let svg = draw(&chart()).expect("a valid chart");
        // 6.88 to 9.12 on 712 pixels from 190: 7 at 228.1, 8 at 546.0, 9 at 863.9, 7.9 at 514.2
        assert!(svg.contains("x=\"228.1\" y=\"27.0\" width=\"635.7\""), "{svg}");
        assert!(svg.contains("x=\"514.2\" y=\"57.0\" width=\"31.8\""), "{svg}");
        assert!(svg.contains("M546.0 12V72"), "{svg}");
        assert!(svg.contains(">Shear &amp; more</text>") && svg.contains(">5 mm</text>"));
    }

    #[test]
    fn labels_that_would_cover_another_are_left_out() {
        let mut close = chart();
        close.rows[0].points[1].at = 8.999;
        let svg = draw(&close).expect("a valid chart");
        assert!(svg.contains("Width, 3 mm: 9.000") && !svg.contains(">3 mm</text>"));
        assert!(svg.contains(">5 mm</text>"));
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let mut bad = chart();
        bad.rows[1].points[0].at = f64::NAN;
        let message = |spans: &Spans| draw(spans).expect_err("must fail").to_string();
        assert_eq!(message(&bad), "\"What moves it\": value 1 of row 2 is NaN");
        bad.rows.clear();
        assert_eq!(message(&bad), "\"What moves it\": row 1 has 0 values for 1 labels");
    }
}
