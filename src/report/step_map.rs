//! What steps do: a row a condition, a panel a method, a cell a step, with the limits that were predicted and measured.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ReportError, significant, svg, ticks, with_unit};

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

/// Looks of the names of rows and of panels, and of the numbers of the axis.
const ROW_NAME: &str = "text-anchor=\"end\" style=\"font-size:11px\"";
const PANEL_NAME: &str = "text-anchor=\"middle\" style=\"font-size:11.5px;font-weight:600\"";
const TICK: &str = "text-anchor=\"middle\" style=\"font-size:10.5px\"";

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
    /// As in results and reports; colours are light, middle and dark, so that they differ in grey too.
    fn name_and_colour(self) -> [&'static str; 2] {
        match self {
            Self::Stable => ["stable", "#d3e3f1"],
            Self::Resonant => ["resonant", "#f0b03c"],
            Self::Unstable => ["unstable", "#9c3328"],
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
        let length = |row, found, expected| Err(ReportError::wrong_length(&self.title, row, [found, expected]));
        let good = |step: f64| step > 0.0 && step.is_finite();
        ReportError::check_row(&self.title, 1, self.steps.iter().copied(), good)?;
        if self.steps.len() < 2 || self.panels.is_empty() || self.rows.is_empty() {
            return length(1, self.steps.len().min(1), 2);
        }
        for panel in &self.panels {
            let rows = panel.cells.len().min(panel.limits.len());
            if rows != self.rows.len() || panel.cells.len() != panel.limits.len() {
                return length(rows + 1, 0, self.steps.len());
            }
            for (row, cells) in (1..).zip(&panel.cells) {
                if cells.len() != self.steps.len() {
                    return length(row, cells.len(), self.steps.len());
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
    let mut out = svg::opening(svg::CHART, [WIDTH, height], &map.title);
    for (number, name) in map.rows.iter().enumerate() {
        let at = [LEFT - 7.0, TOP + ROW * number as f64 + 12.0];
        svg::text(&mut out, ROW_NAME, at, name);
    }
    let count = map.panels.len() as f64;
    let width = (WIDTH - LEFT - RIGHT - GAP * (count - 1.0)) / count;
    for (number, panel) in map.panels.iter().enumerate() {
        let left = LEFT + number as f64 * (width + GAP);
        draw_panel(&mut out, map, panel, [left, width]);
    }
    let below = [0.5 * (LEFT + WIDTH - RIGHT), height - BOTTOM + 36.0];
    svg::text(&mut out, svg::TITLE, below, &with_unit(&map.axis, &map.unit));
    legend(&mut out, height - 16.0);
    Ok(out + "</svg>")
}

fn draw_panel(out: &mut String, map: &StepMap, panel: &StepPanel, [left, width]: [f64; 2]) {
    let steps = &map.steps;
    // half a ratio beyond the first and the last
    let half = 0.5 * (steps[steps.len() - 1] / steps[0]).ln() / (steps.len() - 1) as f64;
    let (low, high) = (steps[0].ln() - half, steps[steps.len() - 1].ln() + half);
    let x_of = |step: f64| left + (step.ln() - low) / (high - low) * width;
    let cell_width = 2.0 * half / (high - low) * width + 0.15;
    let in_unit = |step: f64| format!("{} {}", significant(step, 3), map.unit);
    svg::text(out, PANEL_NAME, [left + 0.5 * width, 15.0], &panel.name);
    for (row, cells) in panel.cells.iter().enumerate() {
        let (y, tall) = (TOP + ROW * row as f64, ROW - SPACE);
        for (&step, state) in steps.iter().zip(cells) {
            let Some(state) = state else { continue };
            let (name, condition) = (&panel.name, &map.rows[row]);
            let [what, colour] = state.name_and_colour();
            let tip = format!("{name}, {condition}: {} {what}", in_unit(step));
            let cell = [x_of(step * (-half).exp()), y, cell_width, tall];
            svg::rect(out, &format!("shape-rendering=\"crispEdges\" fill=\"{colour}\""), cell, &tip);
        }
        let inside = |limit: &f64| (low..=high).contains(&limit.ln());
        let [predicted, measured] = panel.limits[row];
        if let Some(limit) = predicted.filter(inside) {
            let tip = format!("predicted limit {}", in_unit(limit));
            predicted_mark(out, [x_of(limit), y], &tip);
        }
        if let Some(limit) = measured.filter(inside) {
            let tip = format!("measured limit {}", in_unit(limit));
            measured_mark(out, [x_of(limit), y + 0.5 * tall], &tip);
        }
    }
    let bottom = TOP + ROW * map.rows.len() as f64;
    for tick in ticks::log(low.exp(), high.exp(), 4) {
        let is_power = (tick.at.log10() - tick.at.log10().round()).abs() < 1e-6;
        let (x, Some(label), true) = (x_of(tick.at), tick.label, is_power) else {
            continue;
        };
        svg::line(out, "class=\"frame\"", [x, bottom, x, bottom + 4.0]);
        svg::text(out, TICK, [x, bottom + 16.0], &label);
    }
}

/// The sign of a predicted limit, downwards from a place; that of a measured one, round a place.
fn predicted_mark(out: &mut String, [x, y]: [f64; 2], tip: &str) {
    let data = format!("M{x:.1} {y:.1}v{}", ROW - SPACE);
    svg::path(out, "stroke=\"#10161c\" stroke-width=\"2\"", &data, tip);
}

fn measured_mark(out: &mut String, at: [f64; 2], tip: &str) {
    let look = "fill=\"#fff\" stroke=\"#10161c\" stroke-width=\"1.4\"";
    svg::circle(out, look, at, 3.4, tip);
}

fn legend(out: &mut String, y: f64) {
    let mut x = LEFT;
    for state in [StepState::Stable, StepState::Resonant, StepState::Unstable] {
        let [name, colour] = state.name_and_colour();
        svg::rect(out, &format!("fill=\"{colour}\""), [x, y - 10.0, 16.0, 12.0], "");
        svg::text(out, "", [x + 22.0, y], name);
        x += 100.0;
    }
    predicted_mark(out, [x + 8.0, y - 11.0], "");
    svg::text(out, "", [x + 18.0, y], "predicted limit");
    measured_mark(out, [x + 148.0, y - 4.0], "");
    svg::text(out, "", [x + 160.0, y], "measured limit");
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
                cells: vec![vec![Some(StepState::Stable), None, Some(StepState::Unstable)]],
                limits: vec![[Some(1.0), None]],
            }],
        }
    }

    #[test]
    fn cells_and_limits_stand_at_their_steps() {
        let svg = draw(&map()).expect("a valid map");
        // three decades of 736 pixels from 172 on: the middle of the second is the middle of the panel
        assert!(svg.contains("M540.0 24.0v14"), "{svg}");
        assert!(svg.contains("x=\"172.0\" y=\"24.0\" width=\"245.5\""), "{svg}");
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
