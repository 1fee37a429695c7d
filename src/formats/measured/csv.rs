//! Signals in a table.
//!
//! Numbers have a decimal point or, where a semicolon or a tab separates the columns or quotes stand around, a decimal comma:
//! the same in all of the table, and no sign between thousands.

use std::cell::Cell;
use std::path::Path;
use std::rc::Rc;

use ::csv::{Position, StringRecord};

use super::super::csv::{first_line, line_of, table_of};
use super::channel::{Channel, Clock, choose};
use super::names::{name_and_unit, time_unit};
use super::{MeasuredError, SignalRequest};
use crate::files::{Fault, bytes_of};

/// What is read of each line.
struct Columns {
    /// How many columns there are.
    count: usize,
    /// Place of the time and seconds in its unit.
    time: Option<(usize, f64)>,
    /// Place, name and unit of the channels that are wanted.
    wanted: Vec<(usize, String, String)>,
}

/// Text of a table with its path, for messages.
struct Table<'a> {
    path: &'a Path,
    text: &'a str,
    /// The decimal sign of the first number that has one, and its line.
    sign: Cell<Option<(char, u64)>>,
}

pub(super) fn read(path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    from_bytes(&bytes_of(path)?, path, request)
}

pub(super) fn from_bytes(bytes: &[u8], path: &Path, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
    // comments may be in any encoding; header and numbers are text
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    Table { path, text, sign: Cell::new(None) }.channels(request)
}

impl Table<'_> {
    fn channels(&self, request: &SignalRequest) -> Result<Vec<Channel>, MeasuredError> {
        let mut table = table_of(self.text, self.separator());
        let mut record = StringRecord::new();
        let mut columns: Option<Columns> = None;
        let (mut times, mut first_row) = (Vec::new(), 0);
        let mut values: Vec<Vec<f64>> = Vec::new();
        loop {
            let more = table.read_record(&mut record);
            let damaged = |error: ::csv::Error| {
                let line = error.position().map_or(0, Position::line);
                self.content(line, "a line of the table", &error.to_string())
            };
            if !more.map_err(damaged)? {
                break;
            }
            if record.iter().all(str::is_empty) {
                continue;
            }
            let Some(found) = &mut columns else {
                let found = columns.insert(self.header(&record, request)?);
                values = vec![Vec::new(); found.wanted.len()];
                if numbers(&record) {
                    first_row = line_of(self.text, &record);
                    self.row(&record, found, &mut times, &mut values)?;
                }
                continue;
            };
            // a row of units below the names
            if first_row == 0 && record.iter().all(|cell| real(cell).is_none()) {
                self.units(&record, found)?;
                continue;
            }
            if first_row == 0 {
                first_row = line_of(self.text, &record);
            }
            self.row(&record, found, &mut times, &mut values)?;
        }
        let Some(columns) = columns.filter(|_| first_row > 0) else {
            return Err(self.content(1, "a header and rows of numbers", "none"));
        };
        let clock = Rc::new(match columns.time {
            Some(_) => Clock::Times { times, first_row },
            None => Clock::Unknown,
        });
        let channel =
            |((_, name, unit), values)| Channel { name, unit, values, clock: Rc::clone(&clock), speed_hz: None };
        Ok(columns.wanted.into_iter().zip(values).map(channel).collect())
    }

    /// What separates the columns: the first of tab, semicolon and comma that the first line has.
    fn separator(&self) -> u8 {
        let first = first_line(self.text).as_bytes();
        [b'\t', b';'].into_iter().find(|separator| first.contains(separator)).unwrap_or(b',')
    }

    fn header(&self, record: &StringRecord, request: &SignalRequest) -> Result<Columns, MeasuredError> {
        let count = record.len();
        let (names, time): (Vec<(usize, String, String)>, _) = if numbers(record) {
            // without names the first column is the time, unless a rate is given
            let time = (request.rate_hz.is_none() && count > 1).then_some((0, 1.0));
            let first = usize::from(time.is_some());
            let name = |place: usize| (place, format!("column {}", place + 1), String::new());
            ((first..count).map(name).collect(), time)
        } else {
            let place = record.iter().position(|cell| time_unit(cell).is_some());
            let time = place.and_then(|place| Some((place, time_unit(record.get(place)?)?)));
            let named = |(own, cell): (usize, &str)| {
                let (name, unit) = name_and_unit(cell);
                (Some(own) != place).then_some((own, name, unit))
            };
            (record.iter().enumerate().filter_map(named).collect(), time)
        };
        if time.is_none() && request.rate_hz.is_none() {
            return Err(MeasuredError::NoTime { path: self.path.to_owned() });
        }
        let only: Vec<String> = names.iter().map(|(_, name, _)| name.clone()).collect();
        let wanted = choose(self.path, &only, request)?;
        Ok(Columns { count, time, wanted: wanted.into_iter().map(|place| names[place].clone()).collect() })
    }

    /// Takes units from a row below the names.
    fn units(&self, record: &StringRecord, columns: &mut Columns) -> Result<(), MeasuredError> {
        let text = |place: usize| {
            let cell = record.get(place).unwrap_or_default();
            cell.trim_matches(['(', ')', '[', ']']).to_owned()
        };
        if let Some((place, unit)) = &mut columns.time {
            let found = text(*place);
            *unit = time_unit(&format!("time ({found})"))
                .ok_or_else(|| self.content(line_of(self.text, record), "s, ms or us as unit of the time", &found))?;
        }
        for (place, _, unit) in &mut columns.wanted {
            if unit.is_empty() {
                *unit = text(*place);
            }
        }
        Ok(())
    }

    fn row(
        &self,
        record: &StringRecord,
        columns: &Columns,
        times: &mut Vec<f64>,
        values: &mut [Vec<f64>],
    ) -> Result<(), MeasuredError> {
        if record.len() != columns.count {
            return Err(self.other_columns(record, columns.count));
        }
        if let Some((place, unit)) = columns.time {
            times.push(self.number(record, place, "the time")? * unit);
        }
        for ((place, name, _), values) in columns.wanted.iter().zip(values) {
            values.push(self.number(record, *place, name)?);
        }
        Ok(())
    }

    fn number(&self, record: &StringRecord, place: usize, what: &str) -> Result<f64, MeasuredError> {
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
        Ok(value)
    }

    /// A line of more or fewer columns than the first; twice as many may be decimal commas.
    fn other_columns(&self, record: &StringRecord, count: usize) -> MeasuredError {
        let (line, found) = (line_of(self.text, record), record.len());
        let expected = format!("{count} columns, as in the first line");
        if self.separator() == b',' && found == 2 * count && numbers(record) {
            let path = self.path.display();
            return MeasuredError::refused_with(
                format!(
                    "{path}:{line}: expected {expected}, found \"{found}\": are commas both separators and decimal signs?"
                ),
                "write the table with semicolons between the columns: decimal commas are read then",
            );
        }
        self.content(line, &expected, &found.to_string())
    }

    fn content(&self, line: u64, expected: &str, found: &str) -> MeasuredError {
        let short: String = found.chars().take(40).collect();
        let fault = Fault::new(expected.to_owned(), format!("\"{short}\""));
        fault.line(line).of(self.path).into()
    }
}

/// Whether a line has numbers alone.
fn numbers(record: &StringRecord) -> bool {
    record.iter().all(|cell| real(cell).is_some())
}

/// A number with a decimal point, or with one decimal comma in its place.
fn real(cell: &str) -> Option<f64> {
    match cell.contains(',') {
        false => cell.parse().ok(),
        true if cell.contains('.') => None,
        true => cell.replacen(',', ".", 1).parse().ok(),
    }
}
