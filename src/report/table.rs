//! Tables with a verdict per cell.

use serde::{Deserialize, Serialize};

use super::words::wrapped;
use super::{ReportError, significant, with_unit};

/// Characters of a column that is not made narrower.
const NARROWEST: usize = 12;

/// Whether something came out as it should. Shown by a mark as well as by colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// As it should be.
    Ok,
    /// Not as it should be.
    Bad,
    /// Not judged.
    #[default]
    None,
}

impl Verdict {
    /// `Ok` if the condition holds, `Bad` if not.
    pub fn of(good: bool) -> Self {
        if good { Self::Ok } else { Self::Bad }
    }

    /// "pass", "fail", or nothing where nothing was judged.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Ok => "pass",
            Self::Bad => "fail",
            Self::None => "",
        }
    }
}

/// On which side a column's cells stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Align {
    /// Text.
    Left,
    /// Numbers.
    Right,
}

/// Head of a column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// What the column holds.
    pub title: String,
    /// Unit of its numbers, printed under the title.
    pub unit: Option<String>,
    /// Side on which its cells stand.
    pub align: Align,
}

/// One cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// What it says.
    pub text: String,
    /// Whether it is as it should be.
    pub verdict: Verdict,
    /// Footnote that belongs to it, counted from 1.
    pub footnote: Option<usize>,
    /// The number that it shows, in the column's unit, for files; `None`: its text is all there is.
    pub value: Option<f64>,
    /// How it looks.
    pub look: CellLook,
}

/// How a cell looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CellLook {
    /// As text; a verdict colours the cell.
    #[default]
    Plain,
    /// As a badge in the verdict's colour.
    Badge,
}

/// A table. Every row has one cell a column.
#[must_use]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Table {
    /// What the table shows.
    pub caption: String,
    /// Heads of its columns.
    pub columns: Vec<Column>,
    /// Its rows.
    pub rows: Vec<Vec<Cell>>,
    /// Remarks under it, numbered from 1.
    pub footnotes: Vec<String>,
    /// Mode that each row speaks of, an index into the modes of the report's shapes: the row then shows that mode.
    /// Rows beyond the list speak of none.
    pub modes: Vec<Option<usize>>,
}

impl Column {
    /// A column of text.
    pub fn text(title: impl Into<String>) -> Self {
        Self { title: title.into(), unit: None, align: Align::Left }
    }

    /// A column of numbers in a unit ("" for none).
    pub fn number(title: impl Into<String>, unit: &str) -> Self {
        Self { title: title.into(), unit: (!unit.is_empty()).then(|| unit.to_owned()), align: Align::Right }
    }
}

impl Cell {
    /// A cell with text, not judged.
    pub fn text(text: impl Into<String>) -> Self {
        Self { text: text.into(), verdict: Verdict::None, footnote: None, value: None, look: CellLook::Plain }
    }

    /// A cell with a number, written with so many significant digits (1 to 17), not judged. Files get all of them.
    pub fn number(value: f64, digits: usize) -> Self {
        Self::text(significant(value, digits)).value(value)
    }

    /// The same, or a text where there is no number.
    pub(crate) fn number_or(value: Option<f64>, digits: usize, otherwise: &str) -> Self {
        value.map_or_else(|| Self::text(otherwise), |value| Self::number(value, digits))
    }

    /// A badge: "pass", "fail", or a dash where nothing was judged.
    pub fn badge(verdict: Verdict) -> Self {
        let text = if verdict == Verdict::None { "–" } else { verdict.word() };
        Self { verdict, look: CellLook::Badge, ..Self::text(text) }
    }

    /// The cell with the number that its text shows, in the column's unit, as files get it.
    #[must_use]
    pub fn value(mut self, value: f64) -> Self {
        self.value = Some(value);
        self
    }

    /// The cell with a verdict.
    pub(crate) fn judged(mut self, verdict: Verdict) -> Self {
        self.verdict = verdict;
        self
    }

    /// The cell with a reference to footnote `number`, counted from 1.
    #[must_use]
    pub fn footnote(mut self, number: usize) -> Self {
        self.footnote = Some(number);
        self
    }
}

impl Table {
    /// A table without rows.
    pub fn new(caption: impl Into<String>, columns: impl IntoIterator<Item = Column>) -> Self {
        Self { caption: caption.into(), columns: columns.into_iter().collect(), ..Self::default() }
    }

    /// The table with each row tied to the mode that it speaks of, in the order of the report's shapes.
    pub fn showing_modes(mut self, modes: impl IntoIterator<Item = Option<usize>>) -> Self {
        self.modes = modes.into_iter().collect();
        self
    }

    /// The table with a row more.
    pub fn row(mut self, cells: impl IntoIterator<Item = Cell>) -> Self {
        self.rows.push(cells.into_iter().collect());
        self
    }

    /// The table with rows more.
    pub(crate) fn rows<R: IntoIterator<Item = Cell>>(self, rows: impl IntoIterator<Item = R>) -> Self {
        rows.into_iter().fold(self, Self::row)
    }

    /// The table with a footnote more.
    pub fn footnote(mut self, text: impl Into<String>) -> Self {
        self.footnotes.push(text.into());
        self
    }

    /// The table in columns of equal width, two spaces apart; caption first, no line end after the last row.
    pub fn plain(&self) -> String {
        self.plain_within(usize::MAX)
    }

    /// The same in lines of at most so many characters, as far as columns of [`NARROWEST`] let it: wide columns have several lines a
    /// row.
    pub(crate) fn plain_within(&self, most: usize) -> String {
        let heads = self.columns.iter().map(|column| {
            let unit = column.unit.as_deref().unwrap_or_default();
            with_unit(&column.title, unit)
        });
        let mut lines = vec![heads.collect::<Vec<_>>()];
        let texts = |row: &Vec<Cell>| row.iter().map(|cell| cell.text.clone()).collect();
        lines.extend(self.rows.iter().map(texts));
        let mut widths: Vec<usize> = (0..self.columns.len())
            .map(|place| lines.iter().filter_map(|line| Some(line.get(place)?.chars().count())).max().unwrap_or(0))
            .collect();
        while widths.iter().map(|width| width + 2).sum::<usize>() > most
            && let Some(widest) = widths.iter_mut().max().filter(|widest| **widest > NARROWEST)
        {
            *widest -= 1;
        }
        let mut text = self.caption.clone();
        for line in &lines {
            let parts: Vec<Vec<String>> = line
                .iter()
                .zip(&widths)
                .map(
                    |(cell, width)| {
                        if cell.chars().count() > *width { wrapped(cell, *width) } else { vec![cell.clone()] }
                    },
                )
                .collect();
            for place in 0..parts.iter().map(Vec::len).max().unwrap_or(1) {
                let mut cells = String::new();
                for ((part, width), column) in parts.iter().zip(&widths).zip(&self.columns) {
                    let cell = part.get(place).map_or("", String::as_str);
                    cells += &match column.align {
                        Align::Left => format!("  {cell:<width$}"),
                        Align::Right => format!("  {cell:>width$}"),
                    };
                }
                text.push('\n');
                text += cells.trim_end();
            }
        }
        text
    }

    /// Whether each row fits the columns and each reference its footnote.
    pub(super) fn check(&self) -> Result<(), ReportError> {
        for (row, cells) in (1..).zip(&self.rows) {
            let fail = |what: String| Err(ReportError(format!("table \"{}\": row {row} {what}", self.caption)));
            if cells.len() != self.columns.len() {
                return fail(format!("has {} cells, the table has {} columns", cells.len(), self.columns.len()));
            }
            let missing = |footnote: &usize| *footnote == 0 || *footnote > self.footnotes.len();
            if let Some(footnote) = cells.iter().filter_map(|c| c.footnote).find(missing) {
                return fail(format!("points to footnote {footnote}, the table has {}", self.footnotes.len()));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_footnotes_are_checked() {
        let table = Table::new("Lines", [Column::text("Line"), Column::number("Found", "Hz")]);
        let row = |n: usize| vec![Cell::text("outer"); n];
        assert!(table.clone().row(row(2)).check().is_ok());
        let error = table.clone().row(row(2)).row(row(3)).check().expect_err("must fail");
        assert_eq!(error.to_string(), "table \"Lines\": row 2 has 3 cells, the table has 2 columns");
        let noted = table.row([Cell::text("outer"), Cell::number(55.0, 3).footnote(2)]);
        let error = noted.clone().footnote("one").check().expect_err("must fail");
        assert_eq!(error.to_string(), "table \"Lines\": row 1 points to footnote 2, the table has 1");
        assert!(noted.footnote("one").footnote("two").check().is_ok());
    }

    #[test]
    fn wide_columns_have_several_lines_a_row() {
        let table = Table::new("Why", ["Part", "Reason", "Error"].map(Column::text));
        let row = |cells: [&str; 3]| cells.map(Cell::text);
        let table = table.row(row(["step", "eight while a ball passes the shortest defect", "0.01"]));
        let table = table.row(row(["together", "", "0.02"]));
        let expected = "Why
  Part      Reason                 Error
  step      eight while a ball     0.01
            passes the shortest
            defect
  together                         0.02";
        assert_eq!(table.plain_within(40), expected);
        assert_eq!(table.plain_within(10).lines().count(), 8, "as narrow as it becomes");
        assert_eq!(table.plain_within(100), table.plain());
    }

    #[test]
    fn columns_are_aligned_and_units_are_in_their_heads() {
        let columns = [Column::text("What"), Column::number("Value", "\u{b5}m")];
        let table = Table::new("Sizes", columns)
            .row([Cell::text("play"), Cell::number(2.5, 3)])
            .row([Cell::text("a longer name"), Cell::text("")]);
        let expected = "Sizes\n  What           Value [\u{b5}m]\n  play                 2.50\n  a longer name";
        assert_eq!(table.plain(), expected);
    }
}
