//! A chart as an SVG file of its own, for pages that are not reports.

use std::fmt::Write;

use super::layout::{Layout, WIDTH};
use super::svg::escape;
use super::svg_plot::COLOURS;
use super::{Plot, ReportError, Spans, spans, svg_plot};

/// The report's colours, written out: a file of its own has no style sheet to ask.
const PALETTE: [&str; COLOURS] = [
    "#1f5a99", "#c8511b", "#2e7d4f", "#7b4ea3", "#8c6d1f", "#4d5761",
];

/// Height of the title's line and of the legend's, pixels.
const HEAD: [f64; 2] = [30.0, 22.0];

impl Plot {
    /// The plot as an SVG file with title, legend and styles.
    ///
    /// # Errors
    /// [`ReportError`] for curves that do not fit together.
    pub fn to_svg(&self) -> Result<String, ReportError> {
        let layout = Layout::of(self)?;
        let inner = svg_plot::draw(self, &layout, "plot");
        let names: Vec<&str> = self
            .curves
            .iter()
            .map(|curve| curve.name.as_str())
            .collect();
        Ok(file(&self.title, &names, &inner, layout.height))
    }
}

impl Spans {
    /// The chart as an SVG file with title and styles.
    ///
    /// # Errors
    /// [`ReportError`] for values that cannot be shown.
    pub fn to_svg(&self) -> Result<String, ReportError> {
        let inner = spans::draw(self)?;
        let height = inner
            .split("viewBox=\"0 0 ")
            .nth(1)
            .and_then(|rest| rest.split('"').next()?.split(' ').nth(1)?.parse().ok());
        Ok(file(&self.title, &[], &inner, height.unwrap_or(WIDTH)))
    }
}

/// A drawing of the page in a file: title and legend above it.
fn file(title: &str, names: &[&str], inner: &str, height: f64) -> String {
    let head = HEAD[0] + if names.is_empty() { 0.0 } else { HEAD[1] };
    let whole = head + height;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {whole}\" width=\"{WIDTH}\" height=\"{whole}\">\n<style>{}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"14\" y=\"21\" style=\"font-size:15px;font-weight:600\">{}</text>\n",
        style(),
        escape(title)
    );
    let mut x = 14.0;
    for (number, name) in names.iter().enumerate() {
        let colour = PALETTE[number % COLOURS];
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<rect x=\"{x:.0}\" y=\"{:.0}\" width=\"12\" height=\"12\" fill=\"{colour}\"/><text x=\"{:.0}\" y=\"{:.0}\">{}</text>",
            HEAD[0] + 2.0,
            x + 17.0,
            HEAD[0] + 12.0,
            escape(name)
        );
        x += 40.0 + 6.6 * name.chars().count() as f64;
    }
    let placed = inner.replacen(
        "<svg ",
        &format!("<svg y=\"{head}\" width=\"{WIDTH}\" height=\"{height}\" "),
        1,
    );
    let _ = writeln!(out, "{placed}\n</svg>");
    out
}

fn style() -> String {
    let mut style = String::from(
        "text{font:12px \"Segoe UI\",\"Helvetica Neue\",Arial,\"DejaVu Sans\",sans-serif;fill:#1b242d}\
         .area{fill:#fff}.frame{fill:none;stroke:#8794a0}.grid{stroke:#dde3e8}.fine{stroke:#eef1f4}\
         .title{font-size:12.5px;fill:#5a6672}.curve{fill:none;stroke-width:1.25}.dashed{stroke-dasharray:6 4}\
         .dots{fill-opacity:.85}.marker line{stroke:#8794a0;stroke-dasharray:4 3}",
    );
    for (number, colour) in PALETTE.iter().enumerate() {
        let _ = write!(
            style,
            ".c{number}{{stroke:{colour}}}.dots.c{number}{{fill:{colour};stroke:#fff;stroke-width:.6}}.b{number}{{fill:{colour}}}.marker.m{number} line{{stroke:{colour}}}"
        );
    }
    style
}

#[cfg(test)]
mod tests {
    use super::super::{Abscissa, Axis, Curve, SpanPoint, SpanRow};
    use super::*;

    #[test]
    fn a_file_names_its_curves_and_asks_for_nothing() {
        let points = Abscissa::Points(vec![1.0, 2.0]);
        let plot = Plot::new("A < B", Axis::new("f", "Hz"), Axis::new("g", "")).curve(Curve::new(
            "one & all",
            points,
            vec![3.0, 4.0],
        ));
        let svg = plot.to_svg().expect("a valid plot");
        assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 920 "));
        assert!(svg.contains(">A &lt; B</text>") && svg.contains(">one &amp; all</text>"));
        assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
        assert!(!svg.contains("var(") && !svg.contains("href"));
        let spans = Spans {
            title: "S".to_owned(),
            caption: None,
            axis: "x".to_owned(),
            base: 1.0,
            rows: vec![SpanRow {
                name: "a".to_owned(),
                points: vec![SpanPoint {
                    label: "b".to_owned(),
                    at: 2.0,
                }],
            }],
        };
        // one row of 30 between 12 and 50, under a title of 30
        let svg = spans.to_svg().expect("a valid chart");
        assert!(svg.contains("viewBox=\"0 0 920 122\""), "{svg}");
    }
}
