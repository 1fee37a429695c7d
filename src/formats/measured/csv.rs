//! Signals in a table.
//!
//! Numbers have a decimal point or, where a semicolon or a tab separates the columns or quotes stand around, a decimal comma:
//! the same in all of the table, and no sign between thousands. A sign before three digits may be either, `4,744`: that is said
//! where no other number of the table shows what it is, and refused beside whole numbers.
//!
//! Recorders write what they were set to above the names of the columns, a row of units below these, and some a column of remarks.

mod columns;
mod layout;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::cell::Cell;
use std::path::Path;
use std::rc::Rc;

use ::csv::{Position, StringRecord};

use super::super::csv::{first_line, line_of, table_of};
use super::channel::{Channel, Clock};
use super::{MeasuredError, SignalRequest};
use crate::files::bytes_of;
use columns::{Columns, Timing, Wanted};
use layout::{Layout, Read, Table, is_blank, real};

pub(super) fn read(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    from_bytes(&bytes_of(path)?, path, request)
}

pub(super) fn from_bytes(bytes: &[u8], path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    let text = text_of(bytes);
    let first = first_line(&text);
    let parts: Vec<&str> = first.split_whitespace().collect();
    // blanks separate the columns, any number of them
    let blanks = !first.contains(['\t', ';', ',']) && parts.len() > 1 && parts.iter().all(|part| real(part).is_some());
    let table = |line: &str| line.split_whitespace().collect::<Vec<_>>().join("\t");
    let text = if blanks { text.lines().map(table).collect::<Vec<_>>().join("\n").into() } else { text };
    Table { path, text: &text, sign: Cell::new(None), shown: Cell::new([false; 2]) }.channels(request)
}

/// The text of a file: UTF-16 by its byte-order mark, UTF-8, or else Latin-1, in which instruments write units.
fn text_of(bytes: &[u8]) -> Cow<'_, str> {
    let wide = |order: fn([u8; 2]) -> u16| {
        let units = bytes.as_chunks::<2>().0.iter().skip(1).map(|pair| order(*pair));
        let letters = char::decode_utf16(units).map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER));
        Cow::Owned(letters.collect())
    };
    match (bytes, std::str::from_utf8(bytes)) {
        ([0xff, 0xfe, ..], _) => wide(u16::from_le_bytes),
        ([0xfe, 0xff, ..], _) => wide(u16::from_be_bytes),
        (_, Ok(text)) => Cow::Borrowed(text.trim_start_matches('\u{feff}')),
        (_, Err(_)) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect()),
    }
}

/// Sampling rate, Hz, below which a time without a unit is told: vibration of bearings is recorded faster, and times in ms or
/// numbers of samples look as slow as this.
const SLOW_HZ: f64 = 1e3;

/// What to do about decimal commas that may be separators.
const WRITE: &str = "write decimal points, semicolons between the columns, or quotes about each number (\"0,12\"): decimal commas are read then; name every column";

impl Table<'_> {
    fn channels(&self, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
        let layout = Layout::of(self.text);
        if let Some((line, row)) = &layout.decimals {
            let path = self.path.display();
            return Err(MeasuredError::refused_with(
                format!(
                    "{path}:{line}: expected whole numbers between commas, found \"{row}\": are the commas decimal signs?"
                ),
                WRITE,
            ));
        }
        if layout.rows.len() <= layout.start {
            return Err(self.content(1, "a header and rows of numbers", "none"));
        }
        let mut columns = self.columns(&layout, request)?;
        let mut table = table_of(self.text, layout.separator);
        let mut record = StringRecord::new();
        let (mut rows, mut first_row) = (0, 0);
        let damaged = |error: ::csv::Error| {
            let line = error.position().map_or(0, Position::line);
            self.content(line, "a line of the table", &error.to_string())
        };
        while table.read_record(&mut record).map_err(damaged)? {
            rows += usize::from(!is_blank(&record));
            if rows <= layout.start || is_blank(&record) {
                continue;
            }
            if first_row == 0 {
                first_row = line_of(self.text, &record);
            }
            self.row(&record, &mut columns, layout.separator, request)?;
        }
        let mut clocks = Vec::new();
        for Timing { time, clock, read, .. } in columns.timings {
            let mut doubts: Vec<String> = self.thousands(&read, "the time")?.into_iter().collect();
            let clock = match read.values.is_empty() {
                true => clock,
                false => Clock::Times { times: read.values, first_row },
            };
            let unstated = request.rate_hz.is_none() && time.is_some_and(|(_, unit)| unit.is_none());
            doubts.extend(clock.rate_hz().filter(|hz| unstated && *hz < SLOW_HZ).map(|hz| {
                let hz = (1e3 * hz).round() / 1e3;
                format!(
                    "the time: nothing states its unit: it is read in s, which makes {hz} Hz; --rate HZ takes its place"
                )
            }));
            clocks.push((Rc::new(clock), doubts));
        }
        let channel = |Wanted { name, unit, timing, read, .. }| {
            let (clock, of_time) = &clocks[timing];
            let doubts = of_time.iter().cloned().chain(self.thousands(&read, &name)?).collect();
            Ok(Channel { name, unit, values: read.values, clock: Rc::clone(clock), speed_hz: None, doubts })
        };
        columns.wanted.into_iter().map(channel).collect()
    }

    /// Whether a number shows that the sign of the numbers is a decimal one.
    fn is_shown(&self) -> bool {
        self.sign.get().is_some_and(|(sign, _)| self.shown.get()[usize::from(sign == ',')])
    }

    /// What is to be said of numbers whose only sign may stand between thousands, where no number of the column shows that it does not.
    ///
    /// # Errors
    /// Where numbers without a sign stand beside, and no other column shows it either.
    fn thousands(&self, read: &Read, what: &str) -> Result<Option<String>, MeasuredError> {
        let Some((line, text)) = read.grouped.as_ref().filter(|_| !read.shown) else {
            return Ok(None);
        };
        let sign = if text.contains(',') { "comma" } else { "point" };
        let told = format!("{what}: \"{text}\" in line {line} is read as {}", text.replace(',', "."));
        match (&read.whole, self.is_shown()) {
            (None, true) => Ok(None),
            (None, false) => Ok(Some(format!(
                "{told}: nothing in the file shows whether its {sign} is a decimal sign or stands between thousands"
            ))),
            (Some((other, whole)), true) => Ok(Some(format!(
                "{told}, beside \"{whole}\" in line {other}: only another column shows that the {sign} does not stand between thousands"
            ))),
            (Some((other, whole)), false) => Err(MeasuredError::refused_with(
                format!(
                    "{}:{line}: expected numbers for {what} that show whether the {sign} is a decimal sign or stands between thousands, found \"{text}\", and \"{whole}\" in line {other}",
                    self.path.display()
                ),
                "write them without a sign between thousands, or all with the same number of decimals",
            )),
        }
    }

    fn row(
        &self,
        record: &StringRecord,
        columns: &mut Columns,
        separator: u8,
        request: &SignalRequest,
    ) -> Result<(), MeasuredError> {
        if record.iter().skip(columns.count).any(|cell| !cell.is_empty()) {
            return Err(self.other_columns(record, columns.count, separator));
        }
        if !self.is_shown() {
            let mut shown = self.shown.get();
            record.iter().filter_map(decimal_sign).for_each(|sign| shown[usize::from(sign == ',')] = true);
            self.shown.set(shown);
        }
        let cell = |place: usize| record.get(place).unwrap_or_default();
        for (own, timing) in columns.timings.iter_mut().enumerate() {
            let mut wanted = columns.wanted.iter_mut().filter(|wanted| wanted.timing == own);
            let Some((place, unit)) = timing.time else { continue };
            let empty = cell(place).is_empty() && wanted.all(|wanted| cell(wanted.place).is_empty());
            if timing.ended && !empty {
                return Err(self.content(
                    line_of(self.text, record),
                    "no numbers below the end of a channel",
                    cell(place),
                ));
            }
            timing.ended |= columns.blocks && empty;
            // a rate takes the place of times that are no numbers
            if !timing.ended && (request.rate_hz.is_none() || real(cell(place)).is_some()) {
                let time = self.number(record, place, "the time", &mut timing.read)?;
                timing.read.values.push(time * unit.unwrap_or(1.0));
            }
        }
        for wanted in columns.wanted.iter_mut().filter(|wanted| !columns.timings[wanted.timing].ended) {
            let value = self.number(record, wanted.place, &wanted.name, &mut wanted.read)?;
            wanted.read.values.push(value);
        }
        Ok(())
    }

    fn number(&self, record: &StringRecord, place: usize, what: &str, read: &mut Read) -> Result<f64, MeasuredError> {
        let cell = record.get(place).unwrap_or_default();
        let value = real(cell).filter(|value| value.is_finite());
        let line = || line_of(self.text, record);
        let Some(value) = value else {
            return Err(if cell.contains(',') && cell.contains('.') {
                self.content(line(), &format!("a number for {what} without a sign between thousands"), cell)
            } else {
                self.content(line(), &format!("a finite number for {what}"), cell)
            });
        };
        let sign = cell.chars().find(|sign| matches!(sign, ',' | '.'));
        match (sign, self.sign.get()) {
            (Some(sign), None) => self.sign.set(Some((sign, line()))),
            (Some(sign), Some((first, of))) if sign != first => {
                let name = |sign| if sign == ',' { "comma" } else { "point" };
                let expected = format!("a decimal {} for {what}, as in line {of}", name(first));
                return Err(self.content(line(), &expected, cell));
            }
            _ => {}
        }
        read.shown |= decimal_sign(cell).is_some();
        if !read.shown {
            let first = if sign.is_some() { &mut read.grouped } else { &mut read.whole };
            first.get_or_insert_with(|| (line(), cell.to_owned()));
        }
        Ok(value)
    }

    /// A line of more or fewer columns than the first; twice as many may be decimal commas.
    fn other_columns(&self, record: &StringRecord, count: usize, separator: u8) -> MeasuredError {
        let (line, found) = (line_of(self.text, record), record.len());
        let expected = format!("{count} column{}, as in the first line", if count == 1 { "" } else { "s" });
        if separator == b',' && found == 2 * count && record.iter().all(|cell| real(cell).is_some()) {
            let path = self.path.display();
            let question = "are commas both separators and decimal signs?";
            let message = format!("{path}:{line}: expected {expected}, found \"{found}\": {question}");
            return MeasuredError::refused_with(message, WRITE);
        }
        self.content(line, &expected, &found.to_string())
    }
}

/// The sign of a number that stands between no thousands: these are three digits each, after one to three of which the first is no zero.
fn decimal_sign(cell: &str) -> Option<char> {
    let place = cell.find([',', '.']).filter(|_| real(cell).is_some())?;
    let (before, after) = (cell[..place].trim_start_matches(['+', '-']), &cell[place + 1..]);
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let grouped = (1..=3).contains(&before.len()) && !before.starts_with('0') && after.len() == 3;
    (!(grouped && digits(before) && digits(after))).then(|| if cell[place..].starts_with(',') { ',' } else { '.' })
}
