//! Puts the page together: checks the contents, draws, fills the template.
//!
//! The content of a report as a file, from which its page, tables and figures are drawn again.

use super::blocks::Numbers;
use super::{Report, ReportError, blocks, pretty_unit, raised_powers, shapes};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use minijinja::syntax::SyntaxConfig;
use minijinja::value::{Serde, Value};
use minijinja::{Environment, UndefinedBehavior, context};
use std::io::{BufReader, BufWriter, Read};

const TEMPLATE: &str = include_str!("templates/report.html");
const BLOCKS: &str = include_str!("templates/blocks.html");
const SHAPES: &str = include_str!("templates/shapes.html");
const STYLE: &str = include_str!("templates/report.css");
const SHAPES_STYLE: &str = include_str!("templates/shapes.css");
const PLOT_SCRIPT: &str = include_str!("templates/plot.js");
const CURSORS_SCRIPT: &str = include_str!("templates/cursors.js");
const SHAPES_SCRIPT: &str = include_str!("templates/shapes.js");
/// three.js r170 as published (npm package `three` 0.170.0, `build/three.module.min.js`), the last release whose module
/// is one file.
const LIBRARY: &str = include_str!("assets/three.module.min.js");
const LIBRARY_LICENCE: &str = include_str!("assets/three.LICENSE");

impl Report {
    /// The report as one HTML file, complete in itself: styles, drawings, data and script are inside, nothing is
    /// fetched. The plots' data take at most 3.8 MB together; longer curves are thinned such that spikes survive. Shapes
    /// in space take 7.5 MB together; what is left out is said under them.
    ///
    /// # Errors
    /// [`ReportError`] for contents that do not fit together; nothing that depends on the machine.
    pub fn to_html(&self) -> Result<String, ReportError> {
        let mut numbers = Numbers::new(&self.sections, self.table_files.as_ref());
        let sections = self.sections.iter().map(|section| blocks::section(section, &mut numbers));
        let sections: Vec<Value> = sections.collect::<Result<_, _>>()?;
        let live = self.sections.iter().any(|section| section.blocks.iter().any(blocks::is_live));
        let page = context! {
            title => &self.title,
            subtitle => &self.subtitle,
            command => &self.command,
            version => &self.version,
            date => &self.date,
            document => Serde(&self.document),
            judgement => Serde(&self.judgement),
            headlines => Serde(&self.headlines),
            sections,
            tables => Serde(&self.table_files),
            assumptions => &self.assumptions,
            warnings => &self.warnings,
            style => format!("{STYLE}{SHAPES_STYLE}{}", page_rule(self)),
            script => [PLOT_SCRIPT, CURSORS_SCRIPT, if live { SHAPES_SCRIPT } else { "" }].map(lean).concat(),
            // the library of others with its licence, as zlib, then base64
            library => live.then(|| {
                let packed = STANDARD.encode(shapes::compressed(LIBRARY.as_bytes()));
                context! { licence => LIBRARY_LICENCE, packed }
            }),
        };
        let mut environment = Environment::new();
        environment.add_filter("unit", |unit: String| pretty_unit(&unit));
        environment.add_filter("powers", |text: String| raised_powers(&text));
        environment.set_undefined_behavior(UndefinedBehavior::Strict);
        let syntax = SyntaxConfig::builder().trim_blocks(true).build()?;
        environment.set_syntax(syntax);
        // The name's ending turns escaping on.
        environment.add_template("report.html", TEMPLATE)?;
        environment.add_template("blocks.html", BLOCKS)?;
        environment.add_template("shapes.html", SHAPES)?;
        Ok(environment.get_template("report.html")?.render(page)?)
    }
}

/// Margins of a printed page with what stands in them: title, program, date and the page's number. A browser that does
/// not know margin boxes leaves them empty.
fn page_rule(report: &Report) -> String {
    let program = css_string(&format!("plummer {}", report.version));
    let date = css_string(report.date.as_deref().unwrap_or(""));
    format!(
        "@page {{ @top-left {{ content: {}; }} @top-right {{ content: {program}; }} @bottom-left {{ content: {date}; }} \
         @bottom-right {{ content: \"Page \" counter(page) \" of \" counter(pages); }} }}",
        css_string(&report.title)
    )
}

/// Text as a CSS string; only letters and digits are written as they are, so that it can end neither the string nor
/// the style element.
fn css_string(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        if c.is_ascii_alphanumeric() || c == ' ' {
            out.push(c);
        } else {
            out.push_str(&format!("\\{:x} ", u32::from(c)));
        }
    }
    out.push('"');
    out
}

/// A script without its indentation and lines of comment; the only texts in it that go over lines are shaders, to which that is nothing.
fn lean(script: &str) -> String {
    let lines = script.lines().map(str::trim_start);
    let lines = lines.filter(|line| !line.starts_with("//"));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// Bytes that an unpacked record may have; more is no report but an attempt on the memory.
const LARGEST: u64 = 4 << 30;

impl Report {
    /// The content as CBOR (RFC 8949) packed by gzip (RFC 1952): every number to the bit.
    ///
    /// # Errors
    /// [`ReportError`]; nothing that depends on the machine.
    pub fn to_record(&self) -> Result<Vec<u8>, ReportError> {
        let failed = |reason: String| ReportError(format!("the report's content cannot be kept: {reason}"));
        // most of it is packed already: level 6 makes it smaller by half a percent and takes twice as long
        let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
        ciborium::into_writer(self, BufWriter::new(&mut packed)).map_err(|error| failed(error.to_string()))?;
        packed.finish().map_err(|error| failed(error.to_string()))
    }

    /// The report whose [`to_record`](Self::to_record) this is.
    ///
    /// # Errors
    /// [`ReportError`] for bytes that are damaged, cut off, or of another version's making.
    pub(crate) fn from_record(bytes: &[u8]) -> Result<Self, ReportError> {
        let failed = |reason: String| {
            ReportError(format!("not the content of a report, or not one of this version's: {reason}"))
        };
        let mut unpacked = BufReader::new(GzDecoder::new(bytes).take(LARGEST));
        let report = ciborium::from_reader(&mut unpacked).map_err(|error| failed(error.to_string()))?;
        // the checksum stands at the end
        match unpacked.read(&mut [0]) {
            Ok(0) => Ok(report),
            Ok(_) => Err(failed("more than a report".to_owned())),
            Err(error) => Err(failed(error.to_string())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::css_string;
    use crate::report::{
        Abscissa, Axis, Cell, Circle, Column, Curve, Drawing, Fact, Marker, Plot, Point, Report, Section, Table,
        Verdict,
    };

    fn plot(points: usize) -> Plot {
        let even = Abscissa::Even { start: 0.0, step: 1e-5 };
        let y = (0..points).map(|k| (k as f64 * 0.37).sin() * 1234.5).collect();
        Plot::new("Acceleration <P1>", Axis::new("Time", "s"), Axis::new("Acceleration", "m/s^2"))
            .curve(Curve::new("P1 & P2", even, y))
            .marker(Marker::new(1e-5, "\"1×\""))
    }

    fn table() -> Table {
        Table::new("Lines", [Column::text("Line"), Column::number("Found", "Hz")])
            .row([Cell::text("outer <1>"), Cell::number(55.02, 4).judged(Verdict::Ok).footnote(1)])
            .row([Cell::text("inner"), Cell::number(95.3, 4).judged(Verdict::Bad)])
            .footnote("5 < 6")
    }

    fn report() -> Report {
        let ball = Circle { centre: Point { x: 0.0, y: 0.0 }, radius: 1e-3 };
        let drawing = Drawing { title: "Bearing".to_owned(), balls: vec![ball], ..Drawing::default() };
        Report::new("Dent & run-up", "plummer run \"a<b>.toml\"", "0.1.0")
            .subtitle("O'Neill")
            .headline("Kurtosis", "38", Verdict::Bad)
            .section(
                Section::new("Model")
                    .paragraph("a < b")
                    .facts([Fact::new("Balls", "7").note("R & r, m/s^2")])
                    .drawing(drawing),
            )
            .section(Section::new("Signal").plot(plot(100)).table(table()).plot(plot(50)))
            .assumption("No slip <script>alert(1)</script>.")
            .warning("k > 1")
    }

    #[test]
    fn structure_and_numbering() {
        let html = report().to_html().expect("a valid report");
        let count = |what: &str| html.matches(what).count();
        assert!(html.starts_with("<!DOCTYPE html>"));
        assert_eq!(count("<section id=\"section-"), 2);
        assert_eq!(count("<figure class=\"plot\">"), 2);
        assert_eq!(count("<figure class=\"picture drawing\">"), 1);
        assert_eq!(count("<script type=\"application/json\">"), 2);
        assert_eq!(count("class=\"curve c0\""), 2);
        for text in [
            "<b>Figure 1.</b> Bearing",
            "<b>Figure 2.</b> Acceleration &lt;P1&gt;",
            "<b>Figure 3.</b>",
            "<b>Table 1.</b> Lines",
            "<td class=\"right ok\">55.02<sup>1</sup></td>",
            "<td class=\"right bad\">95.30</td>",
            "<li>5 &lt; 6</li>",
            "<th class=\"right\">Found<span class=\"unit\">Hz</span></th>",
            "<dt>Balls</dt><dd>7<span class=\"note\">R &amp; r, m&#x2f;s²</span></dd>",
            "<h2><span class=\"number\">3</span>Assumptions</h2>",
            "<h2><span class=\"number\">4</span>How to reproduce</h2>",
            "<h2>Warnings</h2>",
            "<div class=\"headline bad\">",
            "id=\"figure-3-clip\"",
        ] {
            assert!(html.contains(text), "{text}");
        }
    }

    #[test]
    fn all_text_is_escaped() {
        let html = report().to_html().expect("a valid report");
        for raw in ["a < b", "<P1>", "outer <1>", "R & r", "<script>alert", "a<b>.toml", "P1 & P2</button>", "O'Neill"]
        {
            assert!(!html.contains(raw), "{raw}");
        }
        assert!(html.contains("Dent &amp; run-up") && html.contains("No slip &lt;script&gt;"));
    }

    #[test]
    fn nothing_is_fetched() {
        let html = report().to_html().expect("a valid report");
        for fetch in [" src=", "<link", "@import", "url(http", "href=\"http", "fetch(", "XMLHttpRequest", "import("] {
            assert!(!html.contains(fetch), "{fetch}");
        }
        // The one address is a name: the SVG namespace.
        let addresses = html.matches("http").count();
        assert_eq!(addresses, html.matches("http://www.w3.org/2000/svg").count());
    }

    #[test]
    fn long_signals_stay_below_five_megabytes() {
        let section = (0..4).fold(Section::new("Signals"), |s, _| s.plot(plot(300_000)));
        let html = Report::new("t", "c", "0").section(section).to_html().expect("a valid report");
        assert!(html.len() < 5_000_000, "{} bytes", html.len());
        assert!(html.len() > 3_000_000, "the budget is used: {} bytes", html.len());
        let again = Report::new("t", "c", "0").section(Section::new("S").plot(plot(300_000)));
        assert!(again.to_html().expect("a valid report").len() > 1_600_000, "one signal stays whole");
    }

    #[test]
    fn errors_come_through() {
        let html = |section| Report::new("t", "c", "0").section(section).to_html();
        let bad_table = table().row([Cell::text("one cell")]);
        assert!(html(Section::new("S").table(bad_table)).is_err());
        assert!(html(Section::new("S").plot(plot(0))).is_err());
        assert!(html(Section::new("S").drawing(Drawing::default())).is_err());
    }

    #[test]
    fn css_strings_hold_what_is_in_them() {
        assert_eq!(css_string("Fan 2"), "\"Fan 2\"");
        assert_eq!(css_string("a\"}</style>"), "\"a\\22 \\7d \\3c \\2f style\\3e \"");
    }
}

#[cfg(test)]
mod record_tests {
    use super::super::shapes::samples::cube;
    use super::super::{Abscissa, Axis, Bars, Cell, Column, Curve, Fact, Plot, Section, Table, Verdict};
    use super::*;

    fn report() -> Report {
        // no value where nothing was measured, a number without a short decimal form, a zero with a sign
        let curve =
            Curve::new("P1", Abscissa::Points(vec![1.0, f64::MIN_POSITIVE, 3.0]), vec![f64::NAN, 0.1 + 0.2, -0.0]);
        let mut plot = Plot::new("Signal", Axis::new("t", "s"), Axis::new("a", "m/s^2"));
        plot.curves.push(curve);
        let bars = Bars::new("Mass", "mode", ["1".to_owned()], Axis::new("m", "kg"));
        let table = Table::new("Lines", [Column::text("Part")]).row([Cell::number(0.1, 3)]);
        Report::new("Dent", "plummer run a.toml", "0.1.0").headline("Kurtosis", "38", Verdict::Bad).section(
            Section::new("S")
                .facts([Fact::new("Balls", "7")])
                .plot(plot)
                .bars(bars.series("x", vec![0.5]))
                .table(table)
                .shapes(cube(3, 2)),
        )
    }

    #[test]
    fn a_report_comes_back_to_the_bit() {
        let report = report();
        let bytes = report.to_record().expect("a record");
        let back = Report::from_record(&bytes).expect("the report");
        // NaN is not equal to itself: compared by what is written of them
        assert_eq!(back.to_record().expect("a record"), bytes);
        assert_eq!(format!("{back:?}"), format!("{report:?}"));
    }

    #[test]
    fn a_table_without_rows_says_so() {
        let empty = Table::new("Lines", [Column::text("Line"), Column::number("Found", "Hz")]);
        let page = Report::new("t", "c", "0").section(Section::new("s").table(empty)).to_html().unwrap();
        assert!(page.contains("<td colspan=\"2\">none</td>"));
    }

    #[test]
    fn damage_is_an_error() {
        let bytes = report().to_record().expect("a record");
        for cut in [0, 1, 10, bytes.len() / 2, bytes.len() - 1] {
            let error = Report::from_record(&bytes[..cut]).expect_err("cut off");
            assert!(error.to_string().starts_with("not the content of a report"), "{cut}: {error}");
        }
        assert!(Report::from_record(b"<!DOCTYPE html>").is_err());
        // a bit anywhere: by the packing or by the checksum
        for at in (0..bytes.len()).step_by(37) {
            let mut damaged = bytes.clone();
            damaged[at] ^= 16;
            assert!(Report::from_record(&damaged).is_err(), "{at}");
        }
    }
}
