//! The chart: a coloured table a panel, as text and as SVG.

use std::fmt::{self, Display, Write};

/// Errors of every element over one parameter.
pub struct Panel {
    /// What is computed.
    pub title: String,
    /// What the columns are.
    pub axis: &'static str,
    /// Values of the parameter.
    pub columns: Vec<f64>,
    /// Element and its error in every column, per cent.
    pub rows: Vec<(&'static str, Vec<f64>)>,
}

impl Display for Panel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}; error of the deflection [%]", self.title)?;
        write!(f, "{:<30}", self.axis)?;
        for column in &self.columns {
            write!(f, "{column:>9}")?;
        }
        for (name, errors) in &self.rows {
            write!(f, "\n{name:<30}")?;
            for error in errors {
                write!(f, "{error:>9.2}")?;
            }
        }
        writeln!(f)
    }
}

/// Magnitude below which a colour is used, per cent, and the colour; the text is white on the last two.
const COLOURS: [(f64, &str, &str); 6] = [
    (1.0, "#e3f1e6", "below 1 %"),
    (3.0, "#fff5d6", "1 to 3 %"),
    (10.0, "#fddc9a", "3 to 10 %"),
    (30.0, "#f7a35c", "10 to 30 %"),
    (60.0, "#d1552f", "30 to 60 %"),
    (f64::INFINITY, "#7f1d1d", "above 60 %"),
];

const CELL: [f64; 2] = [45.0, 24.0];
const NAMES: f64 = 92.0;
const PANEL: [f64; 2] = [NAMES + 6.0 * CELL[0] + 24.0, 364.0];
const TOP: f64 = 96.0;
const ACROSS: usize = 2;

/// All panels, two a row, with a legend.
pub fn svg(panels: &[Panel]) -> String {
    let rows = panels.len().div_ceil(ACROSS);
    let (width, height) = (PANEL[0] * ACROSS as f64 + 24.0, TOP + PANEL[1] * rows as f64 + 8.0);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#222\">\n\
         <style>.t{{font-weight:bold;font-size:13px}}.c{{text-anchor:middle}}.r{{text-anchor:end}}\
         .w{{text-anchor:middle;fill:#fff}}.g{{fill:#666;font-size:11px}}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    text(
        &mut out,
        "\" font-size=\"17\" font-weight=\"bold",
        24.0,
        30.0,
        "Cantilever with one layer of elements: error of the end's deflection, %",
    );
    text(
        &mut out,
        "g",
        24.0,
        50.0,
        "Negative: the mesh is too stiff. Section 10 x 10 mm, one element high and wide; 10 elements along it unless stated.",
    );
    for (place, (_, colour, label)) in COLOURS.iter().enumerate() {
        let x = 24.0 + 104.0 * place as f64;
        rectangle(&mut out, [x, 62.0, 18.0, 14.0], colour);
        text(&mut out, "", x + 24.0, 73.5, label);
    }
    for (place, panel) in panels.iter().enumerate() {
        let x = 24.0 + PANEL[0] * (place % ACROSS) as f64;
        draw(&mut out, panel, [x, TOP + PANEL[1] * (place / ACROSS) as f64]);
    }
    out.push_str("</svg>\n");
    out
}

fn draw(out: &mut String, panel: &Panel, [left, top]: [f64; 2]) {
    text(out, "t", left, top + 16.0, &panel.title);
    let middle = |column: usize| left + NAMES + CELL[0] * (column as f64 + 0.5);
    for (row, (name, errors)) in panel.rows.iter().enumerate() {
        let y = top + 26.0 + CELL[1] * row as f64;
        text(out, "r", left + NAMES - 8.0, y + 16.0, name);
        for (column, &error) in errors.iter().enumerate() {
            let level = COLOURS.iter().position(|colour| error.abs() < colour.0).unwrap_or(5);
            rectangle(out, [middle(column) - 0.5 * CELL[0], y, CELL[0] - 1.0, CELL[1] - 1.0], COLOURS[level].1);
            text(out, if level > 3 { "w" } else { "c" }, middle(column), y + 16.0, &number(error));
        }
    }
    let below = top + 26.0 + CELL[1] * panel.rows.len() as f64;
    for (column, value) in panel.columns.iter().enumerate() {
        text(out, "c", middle(column), below + 15.0, &value.to_string());
    }
    text(out, "g", left + NAMES, below + 32.0, panel.axis);
}

/// Two digits or so, with a minus sign in type.
fn number(error: f64) -> String {
    let digits = if error.abs() < 9.95 { 1 } else { 0 };
    let plain = format!("{:.digits$}", error.abs());
    let sign = if error < 0.0 && plain != "0.0" { "\u{2212}" } else { "" };
    sign.to_owned() + &plain
}

fn rectangle(out: &mut String, [x, y, width, height]: [f64; 4], colour: &str) {
    let _ = writeln!(out, "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{colour}\"/>");
}

fn text(out: &mut String, class: &str, x: f64, y: f64, content: &str) {
    let _ = writeln!(out, "<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{content}</text>");
}
