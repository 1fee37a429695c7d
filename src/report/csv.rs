//! Tables as CSV files (RFC 4180): commas, CR LF, units in the header row, numbers whole.

use std::iter::once;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::{Align, Block, Cell, CellLook, Column, Report, Table, TableFiles, Verdict, pretty_unit, with_unit};

/// Longest file name without its ending.
const LONGEST_NAME: usize = 60;

impl Table {
    /// The table as CSV: a header row of titles with units ("Found \[Hz\]"), then the rows. Cells that know their number
    /// give it in full, with a decimal point. A column in which a cell is judged is followed by one that says "pass" or
    /// "fail". Text that a spreadsheet would take for a formula gets an apostrophe in front.
    ///
    /// ```
    /// use plummer::report::{Cell, Column, Table};
    /// let table = Table::new("Lines", [Column::text("Line"), Column::number("Found", "Hz")])
    ///     .row([Cell::text("outer, 1x"), Cell::number(55.0213, 3)]);
    /// assert_eq!(table.to_csv(), "Line,Found [Hz]\r\n\"outer, 1x\",55.0213\r\n");
    /// ```
    #[must_use]
    pub fn to_csv(&self) -> String {
        let is_judged = |k: usize| self.rows.iter().filter_map(|row| row.get(k)).any(is_judged);
        let judged: Vec<bool> = (0..self.columns.len()).map(is_judged).collect();
        let columns = || self.columns.iter().zip(&judged);
        let line = |fields: Vec<String>| fields.join(",") + "\r\n";
        let header = columns().flat_map(|(column, judged)| {
            let verdict = judged.then(|| match column.title.as_str() {
                "Verdict" => "Pass or fail".to_owned(),
                title => format!("{title}: verdict"),
            });
            once(title(column)).chain(verdict).map(|text| quoted(&guarded(&text)))
        });
        let mut out = line(header.collect());
        for row in &self.rows {
            let fields = row.iter().zip(columns()).flat_map(|(cell, (column, judged))| {
                let verdict = judged.then(|| cell.verdict.word().to_owned());
                once(quoted(&field(cell, column))).chain(verdict)
            });
            out += &line(fields.collect());
        }
        out
    }

    /// A file name for the table, from its caption: small letters, digits and hyphens, ending in ".csv".
    pub(crate) fn csv_name(&self) -> String {
        format!("{}.csv", plain_name(&self.caption, "table"))
    }
}

/// Small letters, digits and hyphens of a text, for the name of a file; `or` if there are none.
pub(super) fn plain_name(text: &str, or: &str) -> String {
    let mut name = String::new();
    for c in text.chars().flat_map(char::to_lowercase) {
        if name.len() >= LONGEST_NAME {
            break;
        }
        if c.is_ascii_alphanumeric() {
            name.push(c);
        } else if !name.is_empty() && !name.ends_with('-') {
            name.push('-');
        }
    }
    let name = name.trim_end_matches('-');
    if name.is_empty() { or } else { name }.to_owned()
}

impl Report {
    /// Name and content ([`Table::to_csv`]) of each table's file, in the order and with the numbers of the page; names
    /// begin with the folder of [`Report::tables_in`].
    pub(crate) fn csv_files(&self) -> Vec<(String, String)> {
        let blocks = self.sections.iter().flat_map(|section| &section.blocks);
        let tables = blocks.filter_map(|block| match block {
            Block::Table(table) => Some(table),
            _ => None,
        });
        let files = self.table_files.as_ref();
        let name = |(number, table): (usize, &Table)| {
            let name = file_name(files, number, table);
            let name = match files {
                Some(files) => format!("{}/{name}", files.folder),
                None => name,
            };
            (name, table.to_csv())
        };
        (1..).zip(tables).map(name).collect()
    }
}

/// Name of a table's file without its folder.
pub(super) fn file_name(files: Option<&TableFiles>, number: usize, table: &Table) -> String {
    let prefix = files.map_or("table", |files| &files.prefix);
    format!("{prefix}-{number}-{}", table.csv_name())
}

/// The table as an address that a browser saves; with a byte order mark, by which spreadsheets know UTF-8.
pub(super) fn address(table: &Table) -> String {
    let text = format!("\u{feff}{}", table.to_csv());
    format!("data:text/csv;charset=utf-8;base64,{}", STANDARD.encode(text))
}

/// A badge is its own verdict.
fn is_judged(cell: &Cell) -> bool {
    cell.verdict != Verdict::None && cell.look != CellLook::Badge
}

fn title(column: &Column) -> String {
    let unit = column.unit.as_deref().unwrap_or_default();
    with_unit(&column.title, &pretty_unit(unit))
}

fn field(cell: &Cell, column: &Column) -> String {
    match cell.value {
        Some(value) if value.is_finite() => number(value),
        Some(_) => String::new(),
        // "–" stands for no number.
        None if column.align == Align::Right && cell.text == "–" => String::new(),
        None => guarded(&cell.text),
    }
}

/// The shortest text that reads back as the same number.
fn number(value: f64) -> String {
    if value.abs() > 0.0 && !(1e-5..1e15).contains(&value.abs()) { format!("{value:e}") } else { format!("{value}") }
}

/// Text with an apostrophe in front if a spreadsheet would compute it (OWASP, "CSV Injection"); plain numbers are left.
fn guarded(text: &str) -> String {
    let starts = text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n', '＝', '＋', '－', '＠']);
    if starts && text.parse::<f64>().is_err() { format!("'{text}") } else { text.to_owned() }
}

fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r', ';']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::super::Section;
    use super::*;

    #[test]
    fn numbers_are_whole_and_units_stand_in_the_header() {
        let columns = [Column::text("What"), Column::number("Stiffness", "N/m^(3/2)"), Column::number("Area", "m^2")];
        let table = Table::new("t", columns)
            .row([
                Cell::text("a"),
                Cell::number(3.828_123_456_789e9, 3),
                Cell::number(5.37e-16, 2).judged(Verdict::Bad),
            ])
            .row([Cell::text("b"), Cell::text("–"), Cell::text("0.1 mm²").value(0.1 + 0.2)])
            .row([Cell::text("c"), Cell::number(f64::NAN, 3), Cell::number(-0.25, 2).judged(Verdict::Ok)]);
        assert_eq!(
            table.to_csv(),
            "What,Stiffness [N/m^(3/2)],Area [m²],Area: verdict\r\n\
             a,3828123456.789,5.37e-16,fail\r\n\
             b,,0.30000000000000004,\r\n\
             c,,-0.25,pass\r\n"
        );
    }

    #[test]
    fn text_is_quoted_and_formulas_are_text() {
        let table = |text: &str| {
            let csv = Table::new("t", [Column::text("x")]).row([Cell::text(text)]).to_csv();
            csv.strip_prefix("x\r\n").map(|row| row.trim_end_matches("\r\n").to_owned())
        };
        for (text, expected) in [
            ("=1+2", "'=1+2"),
            ("+49 30", "'+49 30"),
            ("-cmd|' /C calc'!A0", "'-cmd|' /C calc'!A0"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("\t=1", "'\t=1"),
            ("=HYPERLINK(\"a\",\"b\")", "\"'=HYPERLINK(\"\"a\"\",\"\"b\"\")\""),
            ("-5", "-5"),
            ("+0.5", "+0.5"),
            ("+0.5 %", "'+0.5 %"),
            ("a, b", "\"a, b\""),
            ("say \"x\"", "\"say \"\"x\"\"\""),
            ("two\nlines", "\"two\nlines\""),
            ("a;b", "\"a;b\""),
            ("−3 µm", "−3 µm"),
        ] {
            assert_eq!(table(text).as_deref(), Some(expected), "{text}");
        }
        let header = Table::new("t", [Column::text("=A1"), Column::number("-b", "Hz")]).to_csv();
        assert_eq!(header, "'=A1,'-b [Hz]\r\n");
    }

    #[test]
    fn file_names_are_plain() {
        let name = |caption: &str| Table::new(caption, []).csv_name();
        assert_eq!(name("Expected / found: modes"), "expected-found-modes.csv");
        assert_eq!(name("../../etc"), "etc.csv");
        assert_eq!(name("Modes (all)"), "modes-all.csv");
        assert_eq!(name("„µ“"), "table.csv");
        assert!(name(&"long ".repeat(50)).len() <= LONGEST_NAME + 4);
    }

    #[test]
    fn files_are_numbered_as_on_the_page() {
        let table = |caption| Table::new(caption, [Column::text("x")]).row([Cell::text("1")]);
        let report = Report::new("t", "c", "v")
            .section(Section::new("a").table(table("Modes")).paragraph("p"))
            .section(Section::new("b").table(table("Modes")));
        let names = |report: &Report| -> Vec<String> { report.csv_files().into_iter().map(|file| file.0).collect() };
        assert_eq!(names(&report), ["table-1-modes.csv", "table-2-modes.csv"]);
        assert!(!report.to_html().unwrap().contains("beside this report"));
        let report = report.tables_in("tables", "run");
        assert_eq!(names(&report), ["tables/run-1-modes.csv", "tables/run-2-modes.csv"]);
        assert_eq!(report.csv_files()[1].1, "x\r\n1\r\n");
        let html = report.to_html().unwrap();
        for name in ["run-1-modes.csv", "run-2-modes.csv"] {
            assert!(html.contains(&format!("download=\"{name}\"")), "{name}");
            assert!(html.contains(&format!("tables/{name}")), "{name}");
        }
    }

    #[test]
    fn badges_are_their_own_verdict() {
        let table = Table::new("t", [Column::text("Verdict")]).row([Cell::badge(Verdict::Ok)]);
        assert_eq!(table.to_csv(), "Verdict\r\npass\r\n");
        let words = Table::new("t", [Column::text("Verdict")]).row([Cell::text("not seen").judged(Verdict::Ok)]);
        assert_eq!(words.to_csv(), "Verdict,Pass or fail\r\nnot seen,pass\r\n");
    }
}
