//! Where the numbers of a table begin, and what stands above them.
//!
//! Recorders write their settings first, a line each: LabVIEW, catman, oscilloscopes. Tektronix writes them left of the first
//! samples. The table begins where two lines in a row have numbers in the same columns and nothing else; the names stand right above.

use ::csv::StringRecord;

use super::super::super::csv::{first_line, line_of, table_of};
use super::super::names::time_unit;

/// Most lines that the beginning of the numbers is looked for in.
const MOST_TITLES: usize = 300;

/// Where a table is in a file.
#[derive(Debug, Default)]
pub(super) struct Layout {
    /// What separates the columns.
    pub(super) separator: u8,
    /// Lines above the names; above the numbers where there are no names.
    pub(super) titles: usize,
    /// Columns of numbers, where there are no names.
    pub(super) nameless: Option<Vec<usize>>,
    /// Columns that the first line of numbers leaves out.
    pub(super) remarks: Vec<usize>,
    /// A line that shows that commas between two columns without names are decimal ones, and its number.
    pub(super) decimals: Option<(u64, String)>,
}

impl Layout {
    /// Of the text of a table.
    pub(super) fn of(text: &str) -> Self {
        let first = first_line(text).as_bytes();
        let plain = [b'\t', b';'].into_iter().find(|separator| first.contains(separator)).unwrap_or(b',');
        let several = [b'\t', b';', b','].into_iter().find_map(|separator| Self::under(text, separator, 2));
        several.or_else(|| Self::under(text, plain, 1)).unwrap_or_else(|| {
            let first = rows(text, plain).next();
            let numbers = first.filter(|row| row.iter().all(|cell| real(cell).is_some()));
            Self { separator: plain, nameless: numbers.map(|row| (0..row.len()).collect()), ..Self::default() }
        })
    }

    /// With this separator, if so many columns of numbers follow each other.
    fn under(text: &str, separator: u8, least: usize) -> Option<Self> {
        let rows: Vec<StringRecord> = rows(text, separator).take(MOST_TITLES).collect();
        let begins = |place: &usize| {
            let own = numbers(&rows[*place]);
            own.len() >= least && rows.get(place + 1).is_none_or(|next| numbers(next) == own)
        };
        let start = (0..rows.len()).find(begins)?;
        let (above, own) = (&rows[..start], numbers(&rows[start]));
        let is_number = |row: &StringRecord, place: usize| row.get(place).is_some_and(|cell| real(cell).is_some());
        let layout = Self { separator, ..Self::default() };
        let Some(last) = above.last() else {
            let two = separator == b',' && own.len() == 2;
            let decimals = rows.iter().find(|row| two && are_decimals(row));
            let decimals = decimals.map(|row| (line_of(text, row), row.iter().collect::<Vec<_>>().join(",")));
            return Some(Self { nameless: Some(own), decimals, ..layout });
        };
        // settings stand left of the first samples
        if above.iter().all(|row| own.iter().all(|&place| is_number(row, place))) {
            return Some(Self { nameless: Some(own), ..layout });
        }
        // a line of the table that is damaged
        if is_number(last, 0) {
            return None;
        }
        let named = |row: &StringRecord| own.last().is_some_and(|&place| row.len() > place);
        if !named(last) {
            // a title; of a table with commas perhaps the name of one column of decimal commas
            let title = separator != b',' && last.len() == 1;
            return title.then_some(Self { titles: start, nameless: Some(own), ..layout });
        }
        let remarks = (0..last.len()).filter(|place| !own.contains(place)).collect();
        let before = above.iter().rev().nth(1).filter(|row| row.len() == last.len());
        let words = last.iter().all(|cell| real(cell).is_none());
        let time_of = |row: &StringRecord| row.iter().position(|cell| time_unit(cell).is_some());
        let below_names = before.is_some_and(|names| {
            let of_time = time_of(names).and_then(|time| last.get(time));
            // where there are two lines above they are names and units
            of_time.is_some_and(is_time_unit) || start == 2 && time_of(last).is_none()
        });
        let titles = if below_names && words { start - 2 } else { start - 1 };
        Some(Self { titles, remarks, ..layout })
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
    let filled = || row.iter().enumerate().filter(|(_, cell)| !cell.is_empty());
    match filled().all(|(_, cell)| real(cell).is_some()) {
        true => filled().map(|(place, _)| place).collect(),
        false => Vec::new(),
    }
}

/// Whether a cell below the name of a time is its unit.
fn is_time_unit(cell: &str) -> bool {
    let unit = cell.trim_matches(['(', ')', '[', ']']);
    !unit.is_empty() && time_unit(&format!("time ({unit})")).is_some()
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
