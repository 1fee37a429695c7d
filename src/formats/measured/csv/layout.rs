//! Where the numbers of a table begin, and which line above them has the names.
//!
//! Recorders write their settings first, a line each: LabVIEW, catman, oscilloscopes. Tektronix writes them left of the first
//! samples. The table begins where two lines in a row have numbers in the same columns. Beside these numbers may stand words, as
//! LabVIEW's remarks, but not in the first column, where settings have their names.

use std::cell::Cell;
use std::path::Path;

use ::csv::StringRecord;

use super::super::super::csv::{first_line, line_of, table_of};
use super::super::MeasuredError;
use super::super::names::{bracketless, is_unit, seconds, time_unit};
use crate::files::Fault;

/// Most lines that the beginning of the numbers is looked for in.
const MOST_TITLES: usize = 300;

/// A column as it is read: its numbers, whether one shows that their sign is a decimal one, the first that may have a sign between
/// thousands, and the first without any sign.
#[derive(Clone, Default)]
pub(super) struct Read {
    pub(super) values: Vec<f64>,
    pub(super) shown: bool,
    pub(super) grouped: Option<(u64, String)>,
    pub(super) whole: Option<(u64, String)>,
}

/// Text of a table with its path, for messages.
pub(super) struct Table<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
    /// The decimal sign of the first number that has one, and its line.
    pub(super) sign: Cell<Option<(char, u64)>>,
    /// Whether a number shows that the point, and the comma, is a decimal sign.
    pub(super) shown: Cell<[bool; 2]>,
}

impl Table<'_> {
    /// A fault in a line, with a part of what was found.
    pub(super) fn content(&self, line: u64, expected: &str, found: &str) -> MeasuredError {
        let short: String = found.chars().take(40).collect();
        let fault = Fault::new(expected.to_owned(), format!("\"{short}\""));
        fault.line(line).of(self.path).into()
    }
}

/// Where a table is in a file.
#[derive(Debug, Default)]
pub(super) struct Layout {
    /// What separates the columns.
    pub(super) separator: u8,
    /// The first lines that have something in them.
    pub(super) rows: Vec<StringRecord>,
    /// How many of them stand above the numbers.
    pub(super) start: usize,
    /// Which of them has the names; `None`: none.
    pub(super) names: Option<usize>,
    /// Columns of the first line of numbers.
    pub(super) own: Vec<usize>,
    /// A line that shows that commas between two columns without names are decimal ones, and its number.
    pub(super) decimals: Option<(u64, String)>,
}

impl Layout {
    /// Of the text of a table.
    pub(super) fn of(text: &str) -> Self {
        let last = text.trim_end().lines().next_back().unwrap_or_default();
        let ends = [first_line(text), last];
        let plain = ['\t', ';'].into_iter().find(|sign| ends.iter().any(|line| line.contains(*sign)));
        let plain = plain.map_or(b',', |sign| sign as u8);
        let several = |places| [b'\t', b';', b','].into_iter().find_map(|sign| Self::under(text, sign, 2, places));
        let found = several(numbers).or_else(|| several(samples)).or_else(|| Self::under(text, plain, 1, numbers));
        found.unwrap_or_else(|| {
            let rows: Vec<StringRecord> = rows(text, plain).take(2).collect();
            let has_names = rows.first().is_some_and(|row| row.iter().any(|cell| real(cell).is_none()));
            let own = rows.first().map_or_else(Vec::new, |row| (0..row.len()).collect());
            let names = has_names.then_some(0);
            Self { separator: plain, start: usize::from(has_names), rows, names, own, decimals: None }
        })
    }

    /// With this separator, if so many columns of numbers follow each other.
    fn under(text: &str, separator: u8, least: usize, places: fn(&StringRecord) -> Vec<usize>) -> Option<Self> {
        let rows: Vec<StringRecord> = rows(text, separator).take(MOST_TITLES).collect();
        let begins = |place: &usize| {
            let own = places(&rows[*place]);
            own.len() >= least && rows.get(place + 1).is_none_or(|next| places(next) == own)
        };
        let start = (0..rows.len()).find(begins)?;
        let own = places(&rows[start]);
        let first = text.lines().nth((line_of(text, &rows[start]) as usize).saturating_sub(1));
        if separator == b',' && first.is_some_and(|line| line.contains(['\t', ';'])) {
            return None;
        }
        let above = &rows[..start];
        let mut found = Self { separator, start, own, ..Self::default() };
        let is_number = |row: &StringRecord, place: usize| row.get(place).is_some_and(|cell| real(cell).is_some());
        match above.last() {
            // there are none, or settings left of the first samples
            _ if above.iter().all(|row| found.own.iter().all(|&place| is_number(row, place))) => {
                let decimal = rows.iter().find(|row| above.is_empty() && separator == b',' && are_decimals(row));
                let decimal = decimal.filter(|_| found.own.len() == 2);
                found.decimals = decimal.map(|row| (line_of(text, row), row.iter().collect::<Vec<_>>().join(",")));
                found.start = 0;
            }
            // a line of the table that is damaged
            Some(last) if is_number(last, 0) => return None,
            last => {
                found.names = found.names_in(above);
                // a title; of a table with commas perhaps the name of one column of decimal commas
                if found.names.is_none() && (separator == b',' || last.is_some_and(|last| last.len() != 1)) {
                    return None;
                }
            }
        }
        Some(Self { rows, ..found })
    }

    /// The line of names among those above the numbers: the last that names a time, below it words alone; else the last line, or
    /// of two lines the one that has no units.
    fn names_in(&self, above: &[StringRecord]) -> Option<usize> {
        let last = above.len() - 1;
        let cells = |place: usize| self.own.iter().map(move |&own| above[place].get(own).unwrap_or_default());
        let words = |place: usize| cells(place).all(|cell| real(cell).is_none());
        let named = |place: &usize| self.own.last().is_some_and(|&own| above[*place].len() > own);
        let near = (0..=last).rev().take_while(|&place| place == last || words(place + 1));
        let near = near.filter(|place| named(place) && cells(*place).all(|cell| !cell.is_empty() && !is_clock(cell)));
        let has = |place: usize, what: fn(&str) -> bool| above[place].iter().any(what);
        let is_name = |cell: &str| time_unit(cell).is_some() && seconds(bracketless(cell)).is_none();
        let with_time = near.clone().find(|&place| has(place, is_name));
        let units = |place: usize| cells(place).all(is_unit);
        let is_named = cells(0).zip(cells(last)).all(|(name, below)| !name.is_empty() || seconds(below).is_some());
        let two = last == 1 && named(&0) && words(1) && is_named && !units(0);
        with_time.or(two.then_some(0)).or_else(|| {
            near.clone().find(|&place| has(place, |cell| time_unit(cell).is_some())).or(named(&last).then_some(last))
        })
    }
}

/// The lines of a table that have something in them.
fn rows(text: &str, separator: u8) -> impl Iterator<Item = StringRecord> {
    table_of(text, separator).into_records().map_while(Result::ok).filter(|row| !is_blank(row))
}

pub(super) fn is_blank(row: &StringRecord) -> bool {
    row.iter().all(str::is_empty)
}

/// Columns of numbers of a line that has nothing else.
fn numbers(row: &StringRecord) -> Vec<usize> {
    let filled = row.iter().filter(|cell| !cell.is_empty()).count();
    Some(samples(row)).filter(|own| own.len() == filled).unwrap_or_default()
}

/// Columns of numbers of a line that may have words beside.
fn samples(row: &StringRecord) -> Vec<usize> {
    let is_setting = row.get(0).is_some_and(|first| !first.is_empty() && real(first).is_none() && !is_clock(first));
    let cells = row.iter().enumerate().filter(|(_, cell)| !is_setting && real(cell).is_some());
    cells.map(|(place, _)| place).collect()
}

/// Whether a cell is a date or a time of day.
fn is_clock(cell: &str) -> bool {
    let parts = cell.matches([':', '.', '/', '-']).count();
    cell.starts_with(|sign: char| sign.is_ascii_digit()) && (cell.contains(':') || parts > 1)
}

/// Whether two whole numbers can only be what stands before and after a decimal comma: `-0,12`, `0,05`.
fn are_decimals(row: &StringRecord) -> bool {
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let mut cells = row.iter();
    let (Some(before), Some(after)) = (cells.next(), cells.next()) else { return false };
    digits(after)
        && digits(before.trim_start_matches('-'))
        && (before == "-0" || after.len() > 1 && after.starts_with('0'))
}

/// A number with a decimal point, or with one decimal comma in its place.
pub(super) fn real(cell: &str) -> Option<f64> {
    match cell.contains(',') {
        false => cell.parse().ok(),
        true if cell.contains('.') => None,
        true => cell.replacen(',', ".", 1).parse().ok(),
    }
}
