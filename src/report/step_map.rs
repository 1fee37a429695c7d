//! What steps do: a row a condition, a panel a method, a cell a step, with the limits that were predicted and measured.

use std::fmt::Write;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ReportError;
use super::number::significant;
use super::svg::escape;
use super::ticks;

const WIDTH: f64 = 920.0;
/// Where the first panel begins: the names of the rows stand left of it.
const LEFT: f64 = 172.0;
const RIGHT: f64 = 12.0;
/// Room for the names of the panels, and between two of them.
const TOP: f64 = 24.0;
const GAP: f64 = 10.0;
/// Room for the axis and the legend.
const BOTTOM: f64 = 78.0;
const ROW: f64 = 16.0;
/// Between rows.
const SPACE: f64 = 2.0;

/// What a method does in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum StepState {
    /// Small motions do not grow.
    Stable,
    /// They grow in a mode whose phase in the step is near a multiple of pi.
    Resonant,
    /// They grow.
    Unstable,
}

impl StepState {
    /// In results and reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Resonant => "resonant",
            Self::Unstable => "unstable",
        }
    }

    /// Light, middle and dark, so that they differ in grey too.
    fn colour(self) -> &'static str {
        match self {
            Self::Stable => "#d3e3f1",
            Self::Resonant => "#f0b03c",
            Self::Unstable => "#9c3328",
        }
    }
}

/// One method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StepPanel {
    /// Its name.
    pub name: String,
    /// (rows) x (steps); none where nothing was tried.
    pub cells: Vec<Vec<Option<StepState>>>,
    /// Of each row the predicted and the measured limit, in the steps' unit.
    pub limits: Vec<[Option<f64>; 2]>,
}

/// States over steps, conditions and methods.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StepMap {
    /// What it shows.
    pub title: String,
    /// Caption; `None`: the title.
    pub caption: Option<String>,
    /// What the axis shows.
    pub axis: String,
    /// Unit of steps and limits.
    pub unit: String,
    /// The steps, ascending, > 0, each at a constant ratio to the one before; at least two.
    pub steps: Vec<f64>,
    /// The conditions, from top to bottom.
    pub rows: Vec<String>,
    /// The methods, from left to right; at least one.
    pub panels: Vec<StepPanel>,
}

impl StepMap {
    fn check(&self) -> Result<(), ReportError> {
        let length = |row, found, expected| ReportError::ChartLength {
            chart: self.title.clone(),
            row,
            found,
            expected,
        };
        let bad = |step: &f64| !(*step > 0.0 && step.is_finite());
        if let Some(column) = self.steps.iter().position(bad) {
            return Err(ReportError::ChartValue {
                chart: self.title.clone(),
                row: 1,
                column: column + 1,
                value: self.steps[column],
            });
        }
        if self.steps.len() < 2 || self.panels.is_empty() || self.rows.is_empty() {
            return Err(length(1, self.steps.len().min(1), 2));
        }
        for panel in &self.panels {
            let rows = panel.cells.len().min(panel.limits.len());
            if rows != self.rows.len() || panel.cells.len() != panel.limits.len() {
                return Err(length(rows + 1, 0, self.steps.len()));
            }
            for (row, cells) in (1..).zip(&panel.cells) {
                if cells.len() != self.steps.len() {
                    return Err(length(row, cells.len(), self.steps.len()));
                }
            }
        }
        Ok(())
    }

    pub(super) fn height(&self) -> f64 {
        TOP + ROW * self.rows.len() as f64 + BOTTOM
    }
}

/// The SVG element of a map.
pub(super) fn draw(map: &StepMap) -> Result<String, ReportError> {
    map.check()?;
    let height = map.height();
    let title = escape(&map.title);
    let mut out = format!(
        "<svg class=\"bars\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>"
    );
    for (number, name) in map.rows.iter().enumerate() {
        // Writing to a string cannot fail, here and below.
        let _ = write!(
            out,
            "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\" style=\"font-size:11px\">{}</text>",
            LEFT - 7.0,
            TOP + ROW * number as f64 + 12.0,
            escape(name)
        );
    }
    let count = map.panels.len() as f64;
    let width = (WIDTH - LEFT - RIGHT - GAP * (count - 1.0)) / count;
    for (number, panel) in map.panels.iter().enumerate() {
        let left = LEFT + number as f64 * (width + GAP);
        draw_panel(&mut out, map, panel, [left, width]);
    }
    let _ = write!(
        out,
        "<text class=\"title\" x=\"{}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
        0.5 * (LEFT + WIDTH - RIGHT),
        height - BOTTOM + 36.0,
        escape(&format!("{} [{}]", map.axis, map.unit))
    );
    legend(&mut out, height - 16.0);
    out.push_str("</svg>");
    Ok(out)
}

fn draw_panel(out: &mut String, map: &StepMap, panel: &StepPanel, [left, width]: [f64; 2]) {
    let steps = &map.steps;
    // half a ratio beyond the first and the last
    let half = 0.5 * (steps[steps.len() - 1] / steps[0]).ln() / (steps.len() - 1) as f64;
    let (low, high) = (steps[0].ln() - half, steps[steps.len() - 1].ln() + half);
    let x_of = |step: f64| left + (step.ln() - low) / (high - low) * width;
    let bottom = TOP + ROW * map.rows.len() as f64;
    let _ = write!(
        out,
        "<text x=\"{:.1}\" y=\"15\" text-anchor=\"middle\" style=\"font-size:11.5px;font-weight:600\">{}</text>",
        left + 0.5 * width,
        escape(&panel.name)
    );
    for (row, cells) in panel.cells.iter().enumerate() {
        let (y, tall) = (TOP + ROW * row as f64, ROW - SPACE);
        for (step, state) in steps.iter().zip(cells) {
            let Some(state) = state else { continue };
            let x = x_of(step * (-half).exp());
            let _ = write!(
                out,
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{tall}\" shape-rendering=\"crispEdges\" fill=\"{}\"><title>{}, {}: {} {} {}</title></rect>",
                2.0 * half / (high - low) * width + 0.15,
                state.colour(),
                escape(&panel.name),
                escape(&map.rows[row]),
                significant(*step, 3),
                escape(&map.unit),
                state.name()
            );
        }
        let inside = |limit: &f64| (low..=high).contains(&limit.ln());
        let [predicted, measured] = panel.limits[row];
        if let Some(limit) = predicted.filter(inside) {
            let _ = write!(
                out,
                "<path d=\"M{:.1} {y:.1}v{tall}\" stroke=\"#10161c\" stroke-width=\"2\"><title>predicted limit {} {}</title></path>",
                x_of(limit),
                significant(limit, 3),
                escape(&map.unit)
            );
        }
        if let Some(limit) = measured.filter(inside) {
            let _ = write!(
                out,
                "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.4\" fill=\"#fff\" stroke=\"#10161c\" stroke-width=\"1.4\"><title>measured limit {} {}</title></circle>",
                x_of(limit),
                y + 0.5 * tall,
                significant(limit, 3),
                escape(&map.unit)
            );
        }
    }
    for tick in ticks::log(low.exp(), high.exp(), 4) {
        let is_power = (tick.at.log10() - tick.at.log10().round()).abs() < 1e-6;
        let (x, Some(label), true) = (x_of(tick.at), tick.label, is_power) else {
            continue;
        };
        let _ = write!(
            out,
            "<path d=\"M{x:.1} {bottom:.1}v4\" class=\"frame\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" style=\"font-size:10.5px\">{label}</text>",
            bottom + 16.0
        );
    }
}

fn legend(out: &mut String, y: f64) {
    let mut x = LEFT;
    for state in [StepState::Stable, StepState::Resonant, StepState::Unstable] {
        let _ = write!(
            out,
            "<rect x=\"{x}\" y=\"{}\" width=\"16\" height=\"12\" fill=\"{}\"/><text x=\"{}\" y=\"{y}\">{}</text>",
            y - 10.0,
            state.colour(),
            x + 22.0,
            state.name()
        );
        x += 100.0;
    }
    let _ = write!(
        out,
        "<path d=\"M{} {}v14\" stroke=\"#10161c\" stroke-width=\"2\"/><text x=\"{}\" y=\"{y}\">predicted limit</text>\
         <circle cx=\"{}\" cy=\"{}\" r=\"3.4\" fill=\"#fff\" stroke=\"#10161c\" stroke-width=\"1.4\"/><text x=\"{}\" y=\"{y}\">measured limit</text>",
        x + 8.0,
        y - 11.0,
        x + 18.0,
        x + 148.0,
        y - 4.0,
        x + 160.0
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> StepMap {
        StepMap {
            title: "Map".to_owned(),
            caption: None,
            axis: "Step".to_owned(),
            unit: "µs".to_owned(),
            steps: vec![0.1, 1.0, 10.0],
            rows: vec!["load <1>".to_owned()],
            panels: vec![StepPanel {
                name: "splitting".to_owned(),
                cells: vec![vec![
                    Some(StepState::Stable),
                    None,
                    Some(StepState::Unstable),
                ]],
                limits: vec![[Some(1.0), None]],
            }],
        }
    }

    #[test]
    fn cells_and_limits_stand_at_their_steps() {
        let svg = draw(&map()).expect("a valid map");
        // three decades of 736 pixels from 172 on: the middle of the second is the middle of the panel
        assert!(svg.contains("M540.0 24.0v14"), "{svg}");
        assert!(
            svg.contains("x=\"172.0\" y=\"24.0\" width=\"245.5\""),
            "{svg}"
        );
        assert_eq!(svg.matches("splitting, load &lt;1&gt;").count(), 2);
        assert!(svg.contains(": 10.0 µs unstable"), "{svg}");
        assert!(!svg.contains("<title>measured limit"));
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |map: &StepMap| draw(map).expect_err("must fail").to_string();
        let mut bad = map();
        bad.panels[0].cells[0].pop();
        assert_eq!(message(&bad), "\"Map\": row 1 has 2 values for 3 labels");
        bad = map();
        bad.steps[1] = f64::NAN;
        assert_eq!(message(&bad), "\"Map\": value 2 of row 1 is NaN");
    }
}
