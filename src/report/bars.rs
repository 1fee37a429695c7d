//! A bar chart, such as effective masses by mode.

use serde::{Deserialize, Serialize};

use super::svg::COLOURS;
use super::{Axis, ReportError, display_unit, significant, svg, ticks, with_unit};

const WIDTH: f64 = 920.0;
const HEIGHT: f64 = 280.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 50.0;
/// Part of the width of a label's place that its bars take.
const FILLED: f64 = 0.76;
/// Widest bar, pixels.
const WIDEST: f64 = 44.0;
/// Least distance of two labels, pixels, and of one character.
const LABEL: [f64; 2] = [12.0, 7.0];

/// Bars of one colour.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BarSeries {
    /// Name in the legend.
    pub name: String,
    /// A value for each label, in the chart's unit, 0 or more.
    pub values: Vec<f64>,
}

/// A bar chart: a group of bars, one of each series, over each label.
#[must_use]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Bars {
    /// What it shows.
    pub title: String,
    /// Caption; `None`: the title.
    pub caption: Option<String>,
    /// What the labels are ("Mode").
    pub across: String,
    /// Labels from left to right.
    pub labels: Vec<String>,
    /// The vertical axis; it starts at 0 and is linear. A range, if given, sets its upper end.
    pub axis: Axis,
    /// The series; 1 to 6 have colours of their own.
    pub series: Vec<BarSeries>,
}

impl Bars {
    /// A chart without bars.
    pub fn new(
        title: impl Into<String>,
        across: impl Into<String>,
        labels: impl IntoIterator<Item = String>,
        axis: Axis,
    ) -> Self {
        let labels = labels.into_iter().collect();
        Self { title: title.into(), across: across.into(), labels, axis, ..Self::default() }
    }

    /// The chart with a series more.
    pub fn series(mut self, name: impl Into<String>, values: Vec<f64>) -> Self {
        self.series.push(BarSeries { name: name.into(), values });
        self
    }

    fn check(&self) -> Result<(), ReportError> {
        let expected = self.labels.len();
        if self.series.is_empty() || expected == 0 {
            return Err(ReportError::wrong_length(&self.title, 1, [0, expected]));
        }
        for (row, BarSeries { values, .. }) in (1..).zip(&self.series) {
            if values.len() != expected {
                return Err(ReportError::wrong_length(&self.title, row, [values.len(), expected]));
            }
            let good = |value: f64| value.is_finite() && value >= 0.0;
            ReportError::check_row(&self.title, row, values.iter().copied(), good)?;
        }
        Ok(())
    }
}

/// The SVG element of a bar chart.
pub(super) fn draw(bars: &Bars) -> Result<String, ReportError> {
    bars.check()?;
    let values = bars.series.iter().flat_map(|s| &s.values);
    let largest = values.copied().fold(0.0, f64::max);
    let end = match bars.axis.range {
        Some([_, end]) if end.is_finite() && end > 0.0 => end,
        _ if largest > 0.0 => 1.05 * largest,
        _ => 1.0,
    };
    let unit = display_unit(&bars.axis.unit, end);
    let end = end / unit.factor;
    let mut out = svg::opening(svg::CHART, [WIDTH, HEIGHT], &bars.title);
    let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
    let y_of = |v: f64| bottom - (v / end).min(1.0) * (bottom - TOP);
    for tick in ticks::linear(0.0, end, 5) {
        let y = y_of(tick.at);
        svg::line(&mut out, "class=\"grid\"", [LEFT, y, right, y]);
        svg::text(&mut out, svg::END, [LEFT - 7.0, y + 4.0], &tick.label.unwrap_or_default());
    }
    let place = (right - LEFT) / bars.labels.len() as f64;
    let middle = |label: usize| LEFT + (label as f64 + 0.5) * place;
    let wide = (FILLED * place / bars.series.len() as f64).min(WIDEST);
    for (k, label) in bars.labels.iter().enumerate() {
        for (s, series) in bars.series.iter().enumerate() {
            let value = series.values[k] / unit.factor;
            let x = middle(k) + wide * (s as f64 - 0.5 * bars.series.len() as f64);
            let y = y_of(value);
            let bar = [x, y, (wide - 1.0).max(0.5), bottom - y];
            let (name, digits) = (&series.name, significant(value, 4));
            let tip = format!("{label}, {name}: {digits} {}", unit.text);
            svg::rect(&mut out, &format!("class=\"b{}\"", s % COLOURS), bar, &tip);
        }
    }
    let longest = bars.labels.iter().map(|l| l.chars().count()).max();
    let label_width = LABEL[0] + LABEL[1] * longest.unwrap_or(1) as f64;
    let stride = (label_width / place).ceil().max(1.0) as usize;
    for (k, label) in bars.labels.iter().enumerate().step_by(stride) {
        svg::text(&mut out, svg::MIDDLE, [middle(k), bottom + 17.0], label);
    }
    svg::path(&mut out, "class=\"frame\"", &format!("M{LEFT} {TOP}V{bottom}H{right}"), "");
    svg::text(&mut out, svg::TITLE, [0.5 * (LEFT + right), HEIGHT - 8.0], &bars.across);
    svg::upward(&mut out, svg::TITLE, [16.0, 0.5 * (TOP + bottom)], &with_unit(&bars.axis.label, &unit.text));
    Ok(out + "</svg>")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Bars {
        let labels = (1..=3).map(|k| k.to_string());
        Bars::new("Effective mass", "Mode", labels, Axis::new("Part of mass", "%"))
            .series("x & y", vec![62.0, 0.0, 3.5])
            .series("z", vec![1.0, 40.0, 0.25])
    }

    #[test]
    fn bars_stand_on_zero_and_reach_their_value() {
        let mut bars = chart();
        bars.axis = bars.axis.range(0.0, 100.0);
        let svg = draw(&bars).expect("a valid chart");
        assert_eq!(svg.matches("<rect").count(), 6);
        // 62 % of an area 218 high ending at 230
        assert!(
            svg.contains("y=\"94.8\" width=\"43.0\" height=\"135.2\"><title>1, x &amp; y: 62.00 %</title>"),
            "{svg}"
        );
        assert!(svg.contains(">Part of mass [%]</text>") && svg.contains(">Mode</text>"));
    }

    #[test]
    fn many_labels_are_thinned() {
        let labels = (1..=200).map(|k| k.to_string());
        let many = Bars::new("m", "Mode", labels, Axis::new("Mass", "kg")).series("x", vec![1.0; 200]);
        let svg = draw(&many).expect("a valid chart");
        assert!(svg.matches("<text").count() < 50);
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |b: &Bars| draw(b).expect_err("must fail").to_string();
        let mut bars = chart();
        bars.series[1].values.pop();
        assert_eq!(message(&bars), "\"Effective mass\": row 2 has 2 values for 3 labels");
        let mut bars = chart();
        bars.series[1].values[2] = -1.0;
        assert_eq!(message(&bars), "\"Effective mass\": value 3 of row 2 is -1");
        bars.series.clear();
        assert_eq!(message(&bars), "\"Effective mass\": row 1 has 0 values for 3 labels");
    }
}
