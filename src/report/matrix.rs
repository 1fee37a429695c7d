//! A matrix of values from 0 to 1 in colours, such as the modal assurance criterion of two sets of modes.

use serde::{Deserialize, Serialize};

use super::{ReportError, fixed, svg};

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
        let length = |row, found| Err(ReportError::wrong_length(&self.title, row, [found, columns]));
        if self.values.len() != rows {
            return length(self.values.len().min(rows) + 1, 0);
        }
        for (row, values) in (1..).zip(&self.values) {
            if values.len() != columns || columns == 0 {
                return length(row, values.len());
            }
            // A criterion may pass 1 by rounding.
            let good = |value: f64| (-1e-9..=1.0 + 1e-9).contains(&value);
            ReportError::check_row(&self.title, row, values.iter().copied(), good)?;
        }
        if rows == 0 {
            return length(1, 0);
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
    let top = TITLE + if turned { longest(columns) + 10.0 } else { 20.0 };
    let (width, height) = (cell * columns.len() as f64, cell * rows.len() as f64);
    let full_width = (left + width + 90.0).round();
    let full_height = (top + height.max(150.0) + 12.0).round();
    let look = format!("class=\"matrix\" style=\"max-width:{full_width}px\"");
    let mut out = svg::opening(&look, [full_width, full_height], &matrix.title);
    svg::text(&mut out, svg::TITLE, [left + 0.5 * width, 14.0], &matrix.columns.0);
    svg::upward(&mut out, svg::TITLE, [14.0, top + 0.5 * height], &matrix.rows.0);
    // Labels closer than a line of text overlap: then each second, third ... one stands.
    let stride = (13.0 / cell).ceil().max(1.0) as usize;
    for (k, label) in columns.iter().enumerate().step_by(stride) {
        let (x, y) = (left + (k as f64 + 0.5) * cell, top - 7.0);
        if turned {
            svg::upward(&mut out, "", [x + 4.0, y], &short(label));
        } else {
            svg::text(&mut out, svg::MIDDLE, [x, y], &short(label));
        }
    }
    for (k, label) in rows.iter().enumerate().step_by(stride) {
        let y = top + (k as f64 + 0.5) * cell + 4.0;
        svg::text(&mut out, svg::END, [left - 7.0, y], &short(label));
    }
    cells(&mut out, matrix, [left, top, cell]);
    svg::rect(&mut out, "class=\"frame\"", [left, top, width, height], "");
    bar(&mut out, [left + width + 24.0, top]);
    Ok(out + "</svg>")
}

fn short(label: &str) -> String {
    if label.chars().count() <= LONGEST {
        return label.to_owned();
    }
    let start: String = label.chars().take(LONGEST - 1).collect();
    format!("{start}…")
}

fn cells(out: &mut String, matrix: &Matrix, [left, top, cell]: [f64; 3]) {
    for (i, row) in matrix.values.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            let (x, y) = (left + j as f64 * cell, top + i as f64 * cell);
            let labels = [&matrix.rows.1[i], &matrix.columns.1[j]];
            let tip = format!("{}, {}: {}", labels[0], labels[1], fixed(*value, 3));
            svg::rect(out, &fill(*value), [x, y, cell, cell], &tip);
            // Below one percent the colour says enough.
            if cell >= NUMBERED && *value >= 0.005 {
                let class = if *value > 0.5 { "light" } else { "dark" };
                let look = format!("class=\"{class}\" {}", svg::MIDDLE);
                let middle = [x + 0.5 * cell, y + 0.5 * cell + 4.0];
                svg::text(out, &look, middle, &fixed(*value, 2));
            }
        }
    }
}

fn fill(value: f64) -> String {
    format!("fill=\"{}\"", svg::hex(svg::blues(value)))
}

/// What the colours mean, at the right.
fn bar(out: &mut String, [x, top]: [f64; 2]) {
    const STEPS: usize = 20;
    let height = 140.0 / STEPS as f64;
    for k in 0..STEPS {
        let value = 1.0 - (k as f64 + 0.5) / STEPS as f64;
        let y = top + k as f64 * height;
        svg::rect(out, &fill(value), [x, y, 14.0, height + 0.3], "");
    }
    svg::rect(out, "class=\"frame\"", [x, top, 14.0, 140.0], "");
    for (value, text) in [(1.0, "1"), (0.5, "0.5"), (0.0, "0")] {
        let y = top + 140.0 * (1.0 - value) + 4.0;
        svg::text(out, "", [x + 20.0, y], text);
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
        for text in ["<title>MAC</title>", ">0.25</text>", "class=\"light\"", "class=\"dark\""] {
            assert!(svg.contains(text), "{text}");
        }
        let dark = |cell: &str| {
            let named = cell.contains("><title>&lt;1&gt;, &lt;1&gt;: 1.000</title>");
            named && cell.starts_with("fill=\"#143d6e\"")
        };
        assert_eq!(svg.split("<rect ").filter(|cell| dark(cell)).count(), 1);
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
        assert_eq!(message(&matrix(&[[0.0, 1.2]])), "\"MAC\": value 2 of row 1 is 1.2");
        let mut ragged = matrix(&[[0.0, 1.0], [0.0, 1.0]]);
        ragged.values[1].pop();
        assert_eq!(message(&ragged), "\"MAC\": row 2 has 1 values for 2 labels");
        ragged.values.pop();
        assert_eq!(message(&ragged), "\"MAC\": row 2 has 0 values for 2 labels");
        assert_eq!(message(&matrix(&[])), "\"MAC\": row 1 has 0 values for 2 labels");
    }
}
