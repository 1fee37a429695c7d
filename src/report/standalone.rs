//! A chart as an SVG file of its own, for pages that are not reports.

use std::fmt::Write;

use super::csv::plain_name;
use super::layout::{Layout, WIDTH};
use super::svg::{SERIES, escape};
use super::{Block, Curve, CurveStyle, Plot, Report, ReportError, Spans, StepMap, spans, step_map, svg, svg_plot};

/// Height of the title's line and of the legend's, pixels.
const HEAD: [f64; 2] = [30.0, 22.0];

impl Plot {
    /// The plot as an SVG file with title, legend and styles.
    ///
    /// # Errors
    /// [`ReportError`] for curves that do not fit together.
    pub fn to_svg(&self) -> Result<String, ReportError> {
        let layout = Layout::of(self)?;
        let inner = svg_plot::draw(self, &layout, "plot")?;
        let named = self.curves.iter().enumerate();
        let named = named.filter(|(_, curve)| !curve.name.is_empty());
        let entries: Vec<(&str, String)> = named.map(|(k, curve)| (&*curve.name, sign(curve, k))).collect();
        Ok(file(&self.title, &entries, &inner, layout.height))
    }
}

impl Report {
    /// Name and plot of each plot's file, in the order of the page: `PREFIX-NUMBER-TITLE.svg`, to be drawn by [`Plot::to_svg`].
    pub(crate) fn svg_files(&self, prefix: &str) -> impl Iterator<Item = (String, &Plot)> {
        let plots = self.sections.iter().flat_map(|section| &section.blocks).filter_map(Block::plot);
        (1..).zip(plots).map(move |(number, plot)| {
            let name = plain_name(&plot.title, "plot");
            (format!("{prefix}-{number}-{name}.svg"), plot)
        })
    }
}

impl Spans {
    /// The chart as an SVG file with title and styles.
    ///
    /// # Errors
    /// [`ReportError`] for values that cannot be shown.
    pub fn to_svg(&self) -> Result<String, ReportError> {
        let inner = spans::draw(self)?;
        Ok(file(&self.title, &[], &inner, self.height()))
    }
}

impl StepMap {
    /// The map as an SVG file with title and styles.
    ///
    /// # Errors
    /// [`ReportError`] for values that cannot be shown.
    pub(crate) fn to_svg(&self) -> Result<String, ReportError> {
        let inner = step_map::draw(self)?;
        Ok(file(&self.title, &[], &inner, self.height()))
    }
}

/// What stands before the name of a curve in the legend.
fn sign(curve: &Curve, number: usize) -> String {
    let colour = SERIES[svg_plot::colour(curve, number)];
    let stroke = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"");
    let at = "transform=\"translate(9 0)";
    let dashes = "stroke-dasharray=\"6 4\"";
    let (look, data) = match curve.style {
        CurveStyle::Line => (stroke, "M0 0H18".to_owned()),
        CurveStyle::Dashed => (format!("{stroke} {dashes}"), "M0 0H18".to_owned()),
        CurveStyle::Points if curve.symbol.is_open() => (format!("{at} scale(.8)\" {stroke}"), curve.symbol.path()),
        CurveStyle::Points => (format!("{at}\" fill=\"{colour}\""), curve.symbol.path()),
    };
    let mut sign = String::new();
    svg::path(&mut sign, &look, &data, "");
    sign
}

/// A drawing of the page in a file: title and legend above it.
fn file(title: &str, names: &[(&str, String)], inner: &str, height: f64) -> String {
    let (mut legend, mut rows, mut x) = (String::new(), 0.0, WIDTH);
    for (name, sign) in names {
        // width with its sign; generous, for the fonts that a reader may have
        let width = 44.0 + 6.6 * name.chars().count() as f64;
        if x + width > WIDTH {
            x = 14.0;
            rows += 1.0;
        }
        let y = HEAD[0] + HEAD[1] * (rows - 1.0);
        let below = y + 8.0;
        // Writing to a string cannot fail, here and below.
        let _ = write!(legend, "<g transform=\"translate({x:.0} {below:.0})\">{sign}</g>");
        svg::text(&mut legend, "", [x + 24.0, y + 12.0], name);
        legend.push('\n');
        x += width;
    }
    let head = HEAD[0] + HEAD[1] * rows;
    let whole = head + height;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {whole}\" width=\"{WIDTH}\" height=\"{whole}\">\n<style>{}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"14\" y=\"21\" style=\"font-size:15px;font-weight:600\">{}</text>\n{legend}",
        style(),
        escape(title)
    );
    let placed = inner.replacen("<svg ", &format!("<svg y=\"{head}\" width=\"{WIDTH}\" height=\"{height}\" "), 1);
    let _ = writeln!(out, "{placed}\n</svg>");
    out
}

fn style() -> String {
    let mut style = String::from(
        "text{font:12px \"Segoe UI\",\"Helvetica Neue\",Arial,\"DejaVu Sans\",sans-serif;fill:#1b242d}\
         .area{fill:#fff}.frame{fill:none;stroke:#8794a0}.grid{stroke:#dde3e8}.fine{stroke:#eef1f4}\
         .title{font-size:12.5px;fill:#5a6672}.curve{fill:none;stroke-width:1.25}.dashed{stroke-dasharray:6 4}\
         .dots{fill-opacity:.85}.marker line,.level line{stroke:#8794a0;stroke-dasharray:4 3}\
         .level text{font-size:11px;fill:#5a6672;paint-order:stroke;stroke:#fff;stroke-width:3px}",
    );
    for (number, colour) in SERIES.iter().enumerate() {
        let _ = write!(
            style,
            ".c{number}{{stroke:{colour}}}.dots.c{number}{{fill:{colour};stroke:#fff;stroke-width:.6}}.dots.open.c{number}{{fill:none;stroke:{colour};stroke-width:1.8}}.b{number}{{fill:{colour}}}.marker.m{number} line{{stroke:{colour}}}"
        );
    }
    style
}

#[cfg(test)]
mod tests {
    use super::super::curve::Abscissa;
    use super::super::plot::Axis;
    use super::super::spans::{SpanPoint, SpanRow};
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
        let wide = Curve { name: "a".repeat(120), ..plot.curves[0].clone() };
        // a name that does not fit beside the first one goes below it: 22 more
        let two = plot.clone().curve(wide).to_svg().expect("a valid plot");
        let height = |svg: &str| -> f64 {
            let rest = svg.split("viewBox=\"0 0 920 ").nth(1).expect("a size");
            let number = rest.split('"').next().expect("a height");
            number.parse().expect("a number")
        };
        assert!((height(&two) - height(&svg) - 22.0).abs() < 1e-9);
        let spans = Spans {
            title: "S".to_owned(),
            caption: None,
            axis: "x".to_owned(),
            base: 1.0,
            rows: vec![SpanRow { name: "a".to_owned(), points: vec![SpanPoint { label: "b".to_owned(), at: 2.0 }] }],
        };
        // one row of 30 between 12 and 50, under a title of 30
        let svg = spans.to_svg().expect("a valid chart");
        assert!(svg.contains("viewBox=\"0 0 920 122\""), "{svg}");
    }
}
