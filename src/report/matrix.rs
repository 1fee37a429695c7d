//! A matrix of values from 0 to 1 in colours, such as the modal assurance criterion of two sets of modes.

use std::fmt::Write;

use serde::{Deserialize, Serialize};

use super::ReportError;
use super::number::fixed;
use super::svg::escape;

/// Side of a cell, pixels, at least and at most.
const CELL: [f64; 2] = [9.0, 46.0];
/// Width that the cells may take together, pixels.
const WIDTH: f64 = 560.0;
/// Smallest cell with its number in it.
const NUMBERED: f64 = 26.0;
/// Width of a character of a label, pixels.
const CHARACTER: f64 = 6.6;
/// Longest label, characters.
const LONGEST: usize = 24;
/// Room for the title of the columns and that of the rows.
const TITLE: f64 = 24.0;

/// A matrix in colours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Matrix {
    /// What it shows.
    pub title: String,
    /// Caption; `None`: the title.
    pub caption: Option<String>,
    /// What the rows are, and the label of each.
    pub rows: (String, Vec<String>),
    /// What the columns are, and the label of each.
    pub columns: (String, Vec<String>),
    /// Values, 0 to 1, (rows) x (columns).
    pub values: Vec<Vec<f64>>,
}

impl Matrix {
    /// A matrix without a caption of its own.
    pub fn new(
        title: impl Into<String>,
        rows: (impl Into<String>, Vec<String>),
        columns: (impl Into<String>, Vec<String>),
        values: Vec<Vec<f64>>,
    ) -> Self {
        Self {
            title: title.into(),
            caption: None,
            rows: (rows.0.into(), rows.1),
            columns: (columns.0.into(), columns.1),
            values,
        }
    }

    fn check(&self) -> Result<(), ReportError> {
        let (rows, columns) = (self.rows.1.len(), self.columns.1.len());
        let length = |row, found, expected| ReportError::ChartLength {
            chart: self.title.clone(),
            row,
            found,
            expected,
        };
        if self.values.len() != rows {
            return Err(length(self.values.len().min(rows) + 1, 0, columns));
        }
        for (row, values) in (1..).zip(&self.values) {
            if values.len() != columns || columns == 0 {
                return Err(length(row, values.len(), columns));
            }
            // A criterion may pass 1 by rounding.
            let bad = |v: &f64| !(-1e-9..=1.0 + 1e-9).contains(v);
            if let Some(column) = values.iter().position(bad) {
                return Err(ReportError::ChartValue {
                    chart: self.title.clone(),
                    row,
                    column: column + 1,
                    value: values[column],
                });
            }
        }
        if rows == 0 {
            return Err(length(1, 0, columns));
        }
        Ok(())
    }
}

/// The SVG element of a matrix.
pub(super) fn draw(matrix: &Matrix) -> Result<String, ReportError> {
    matrix.check()?;
    let (rows, columns) = (&matrix.rows.1, &matrix.columns.1);
    let cell = (WIDTH / columns.len() as f64).clamp(CELL[0], CELL[1]);
    let longest = |labels: &[String]| {
        let lengths = labels.iter().map(|l| l.chars().count().min(LONGEST));
        lengths.max().unwrap_or(0) as f64 * CHARACTER
    };
    // Labels of columns are turned where they are wider than their column.
    let turned = longest(columns) > cell - 4.0;
    let left = TITLE + longest(rows) + 12.0;
    let top = TITLE
        + if turned {
            longest(columns) + 10.0
        } else {
            20.0
        };
    let (width, height) = (cell * columns.len() as f64, cell * rows.len() as f64);
    let (full_width, full_height) = (left + width + 90.0, top + height.max(150.0) + 12.0);
    let title = escape(&matrix.title);
    let mut out = format!(
        "<svg class=\"matrix\" viewBox=\"0 0 {full_width:.0} {full_height:.0}\" style=\"max-width:{full_width:.0}px\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>"
    );
    let middle = top + 0.5 * height;
    // Writing to a string cannot fail, here and below.
    let _ = write!(
        out,
        "<text class=\"title\" x=\"{:.1}\" y=\"14\" text-anchor=\"middle\">{}</text>\
         <text class=\"title\" transform=\"translate(14 {middle:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        left + 0.5 * width,
        escape(&matrix.columns.0),
        escape(&matrix.rows.0)
    );
    // Labels closer than a line of text overlap: then each second, third ... one stands.
    let stride = (13.0 / cell).ceil().max(1.0) as usize;
    for (k, label) in columns.iter().enumerate().step_by(stride) {
        let (x, y) = (left + (k as f64 + 0.5) * cell, top - 7.0);
        let place = if turned {
            format!("transform=\"translate({:.1} {y:.1}) rotate(-90)\"", x + 4.0)
        } else {
            format!("x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\"")
        };
        let _ = write!(out, "<text {place}>{}</text>", short(label));
    }
    for (k, label) in rows.iter().enumerate().step_by(stride) {
        let y = top + (k as f64 + 0.5) * cell + 4.0;
        let x = left - 7.0;
        let _ = write!(
            out,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"end\">{}</text>",
            short(label)
        );
    }
    cells(&mut out, matrix, [left, top, cell]);
    let _ = write!(
        out,
        "<rect class=\"frame\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/>"
    );
    bar(&mut out, [left + width + 24.0, top]);
    out.push_str("</svg>");
    Ok(out)
}

fn short(label: &str) -> String {
    if label.chars().count() <= LONGEST {
        return escape(label);
    }
    let start: String = label.chars().take(LONGEST - 1).collect();
    escape(&format!("{start}…"))
}

fn cells(out: &mut String, matrix: &Matrix, [left, top, cell]: [f64; 3]) {
    for (i, row) in matrix.values.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            let (x, y) = (left + j as f64 * cell, top + i as f64 * cell);
            let _ = write!(
                out,
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{cell:.1}\" height=\"{cell:.1}\" fill=\"{}\"><title>{}, {}: {}</title></rect>",
                colour(*value),
                escape(&matrix.rows.1[i]),
                escape(&matrix.columns.1[j]),
                fixed(*value, 3)
            );
            // Below one percent the colour says enough.
            if cell >= NUMBERED && *value >= 0.005 {
                let class = if *value > 0.5 { "light" } else { "dark" };
                let _ = write!(
                    out,
                    "<text class=\"{class}\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                    x + 0.5 * cell,
                    y + 0.5 * cell + 4.0,
                    fixed(*value, 2)
                );
            }
        }
    }
}

/// White to dark blue, by even steps of lightness.
fn colour(value: f64) -> String {
    const STOPS: [[f64; 3]; 5] = [
        [255.0, 255.0, 255.0],
        [206.0, 221.0, 236.0],
        [142.0, 178.0, 212.0],
        [75.0, 125.0, 175.0],
        [20.0, 61.0, 110.0],
    ];
    let place = value.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let low = (place.floor() as usize).min(STOPS.len() - 2);
    let part = place - low as f64;
    let mixed: [u8; 3] = std::array::from_fn(|k| {
        (STOPS[low][k] * (1.0 - part) + STOPS[low + 1][k] * part).round() as u8
    });
    format!("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2])
}

/// What the colours mean, at the right.
fn bar(out: &mut String, [x, top]: [f64; 2]) {
    const STEPS: usize = 20;
    let height = 140.0 / STEPS as f64;
    for k in 0..STEPS {
        let value = 1.0 - (k as f64 + 0.5) / STEPS as f64;
        let y = top + k as f64 * height;
        let _ = write!(
            out,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"14\" height=\"{:.1}\" fill=\"{}\"/>",
            height + 0.3,
            colour(value)
        );
    }
    let _ = write!(
        out,
        "<rect class=\"frame\" x=\"{x:.1}\" y=\"{top:.1}\" width=\"14\" height=\"140\"/>"
    );
    for (value, text) in [(1.0, "1"), (0.5, "0.5"), (0.0, "0")] {
        let y = top + 140.0 * (1.0 - value) + 4.0;
        let _ = write!(
            out,
            "<text x=\"{:.1}\" y=\"{y:.1}\">{text}</text>",
            x + 20.0
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(values: &[[f64; 2]]) -> Matrix {
        let labels = |n: usize| (1..=n).map(|k| format!("<{k}>")).collect::<Vec<_>>();
        Matrix::new(
            "MAC",
            ("found", labels(values.len())),
            ("expected", labels(2)),
            values.iter().map(|row| row.to_vec()).collect(),
        )
    }

    #[test]
    fn values_are_numbers_and_colours() {
        let svg = draw(&matrix(&[[1.0, 0.001], [0.25, 0.5]])).expect("a valid matrix");
        for text in [
            "<title>MAC</title>",
            "fill=\"#143d6e\"><title>&lt;1&gt;, &lt;1&gt;: 1.000</title>",
            ">0.25</text>",
            "class=\"light\"",
            "class=\"dark\"",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(!svg.contains(">0.00</text>"));
    }

    #[test]
    fn large_matrices_leave_out_numbers_and_some_labels() {
        let labels: Vec<String> = (1..=80).map(|k| k.to_string()).collect();
        let values = vec![vec![1.0; 80]; 80];
        let large = Matrix::new("MAC", ("a", labels.clone()), ("b", labels), values);
        let svg = draw(&large).expect("a valid matrix");
        assert!(!svg.contains(">1.00</text>"));
        assert!(svg.contains(">79</text>") && !svg.contains(">80</text>"));
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |m: &Matrix| draw(m).expect_err("must fail").to_string();
        assert_eq!(
            message(&matrix(&[[0.0, 1.2]])),
            "\"MAC\": value 2 of row 1 is 1.2"
        );
        let mut ragged = matrix(&[[0.0, 1.0], [0.0, 1.0]]);
        ragged.values[1].pop();
        assert_eq!(message(&ragged), "\"MAC\": row 2 has 1 values for 2 labels");
        ragged.values.pop();
        assert_eq!(message(&ragged), "\"MAC\": row 2 has 0 values for 2 labels");
        assert_eq!(
            message(&matrix(&[])),
            "\"MAC\": row 1 has 0 values for 2 labels"
        );
    }
}
