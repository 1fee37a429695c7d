//! Binary files: Fortran records in either byte order, words of 32 or 64 bits.

use super::Op4Matrix;
use super::builder::{Builder, Column, Header};
use crate::files::Fault;

/// Byte order and length of words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Words {
    big_endian: bool,
    /// Bytes of a whole number, 4 or 8.
    bytes: usize,
}

impl Words {
    /// What the length of the first record says, four whole numbers and two words of text.
    pub(super) fn of_first_record(first: [u8; 4]) -> Option<Self> {
        let (little, big) = (u32::from_le_bytes(first), u32::from_be_bytes(first));
        let (big_endian, length) = match (little, big) {
            (24 | 48, _) => (false, little),
            (_, 24 | 48) => (true, big),
            _ => return None,
        };
        let bytes = if length == 24 { 4 } else { 8 };
        Some(Self { big_endian, bytes })
    }

    fn chunk<const N: usize>(self, bytes: &[u8]) -> Option<[u8; N]> {
        let mut own = *bytes.first_chunk::<N>()?;
        if self.big_endian {
            own.reverse();
        }
        Some(own)
    }

    /// The whole number at the beginning.
    fn whole(self, bytes: &[u8]) -> Option<i64> {
        match self.bytes {
            4 => Some(i64::from(i32::from_le_bytes(self.chunk(bytes)?))),
            _ => Some(i64::from_le_bytes(self.chunk(bytes)?)),
        }
    }

    /// Bytes of a real number. With words of 64 bits single precision has them too.
    fn bytes_of_real(self, single: bool) -> usize {
        if single && self.bytes == 4 { 4 } else { 8 }
    }

    fn real(self, bytes: &[u8]) -> f64 {
        let read = match bytes.len() {
            4 => self.chunk(bytes).map(|own| f64::from(f32::from_le_bytes(own))),
            _ => self.chunk(bytes).map(f64::from_le_bytes),
        };
        read.unwrap_or(f64::NAN)
    }
}

/// Where reading is.
struct Records<'a> {
    bytes: &'a [u8],
    place: usize,
    words: Words,
}

/// One record's content and where it begins.
struct Record<'a> {
    place: usize,
    content: &'a [u8],
    words: Words,
}

pub(super) fn read_binary(bytes: &[u8], words: Words) -> Result<Vec<Op4Matrix>, Fault> {
    let mut records = Records { bytes, place: 0, words };
    let mut matrices = Vec::new();
    while records.place < bytes.len() {
        matrices.push(matrix(&mut records)?);
    }
    Ok(matrices)
}

fn matrix(records: &mut Records) -> Result<Op4Matrix, Fault> {
    const HEADER: &str = "columns, rows, form, type and name of a matrix";
    let mut record = records.next(HEADER)?;
    let place = record.place;
    let mut numbers = [0; 4];
    for number in &mut numbers {
        *number = record.whole(HEADER)?;
    }
    if record.content.len() != 2 * records.words.bytes {
        return Err(record.fault(HEADER, format!("a record of {} bytes", record.content.len())));
    }
    let [columns, rows, form, kind] = numbers;
    let header = Header { columns, rows, form, kind };
    let name = String::from_utf8_lossy(record.content);
    let mut builder = Builder::new(header, &name).map_err(|expected| {
        Fault::new(expected, format!("{columns} columns, {rows} rows, type {kind}")).at(format_args!("byte {place}"))
    })?;
    const COLUMN: &str = "column, first row and length of a column";
    loop {
        let mut record = records.next(COLUMN)?;
        let (column, row) = (record.whole(COLUMN)?, record.whole(COLUMN)?);
        let length = record.whole(COLUMN)?;
        let found = format!("column {column} from row {row} with {length} words");
        let begun = builder.column(column, row);
        match begun.map_err(|expected| record.fault(expected, found.clone()))? {
            Column::End => return Ok(builder.finish()),
            // a record may be longer than its column: what follows is left out
            kind => {
                let bytes = usize::try_from(length).ok().and_then(|length| length.checked_mul(records.words.bytes));
                let content = bytes.and_then(|bytes| record.content.get(..bytes));
                let Some(content) = content else {
                    return Err(record.fault("as many words as the record has", found));
                };
                record.content = content;
                match kind {
                    Column::Dense(row) => {
                        let bytes = record.content.len();
                        run(&mut builder, &mut record, row, bytes)?;
                    }
                    _ => sparse(&mut builder, &mut record)?,
                }
            }
        }
    }
}

/// The runs of a sparse column.
fn sparse(builder: &mut Builder, record: &mut Record) -> Result<(), Fault> {
    const RUN: &str = "length and first row of a run of numbers";
    while !record.content.is_empty() {
        let key = record.whole(RUN)?;
        let (length, row) = if builder.big { (key, record.whole(RUN)?) } else { (key >> 16, key & 0xffff) };
        // the key counts one more word than the numbers have
        let words = usize::try_from(length.saturating_sub(1)).ok();
        let bytes = words.and_then(|words| words.checked_mul(record.words.bytes));
        let bytes = bytes.ok_or_else(|| record.fault(RUN, format!("length {length}")))?;
        run(builder, record, row, bytes)?;
    }
    Ok(())
}

/// Numbers of so many bytes, from a row on.
fn run(builder: &mut Builder, record: &mut Record, row: i64, bytes: usize) -> Result<(), Fault> {
    const NUMBERS: &str = "whole real numbers that the column has";
    let size = record.words.bytes_of_real(builder.is_single());
    let rest = record.content.split_at_checked(bytes);
    let Some((numbers, rest)) = rest.filter(|_| bytes.is_multiple_of(size)) else {
        return Err(record.fault(NUMBERS, format!("{bytes} bytes from row {row}")));
    };
    let words = record.words;
    let values = numbers.chunks_exact(size).map(|bytes| words.real(bytes));
    let count = bytes / size;
    let taken = builder.run(row, count, values);
    taken.map_err(|expected| record.fault(expected, format!("{count} from row {row}")))?;
    record.content = rest;
    Ok(())
}

impl<'a> Records<'a> {
    /// The next record, both of whose lengths fit.
    fn next(&mut self, expected: &'static str) -> Result<Record<'a>, Fault> {
        let place = self.place;
        let fault = |found: String| Fault::new(expected, found).at(format_args!("byte {place}"));
        let rest = self.bytes.get(place..).unwrap_or_default();
        let length = |bytes: &[u8]| self.words.chunk(bytes).map(u32::from_le_bytes);
        let Some(first) = length(rest) else {
            return Err(fault("the end of the file".to_owned()));
        };
        // on machines of fewer bits than a length has, nothing is that long
        let size = usize::try_from(first).unwrap_or(usize::MAX);
        let content = rest.get(4..).and_then(|rest| rest.split_at_checked(size));
        let Some((content, after)) = content else {
            return Err(fault(format!("a record of {first} bytes, which the file has not")));
        };
        match length(after) {
            Some(last) if last == first => {}
            Some(last) => {
                return Err(fault(format!("a record of {first} bytes that ends as one of {last}")));
            }
            None => return Err(fault("the end of the file".to_owned())),
        }
        self.place = place + 8 + size;
        Ok(Record { place: place + 4, content, words: self.words })
    }
}

impl Record<'_> {
    /// Takes a whole number.
    fn whole(&mut self, expected: &'static str) -> Result<i64, Fault> {
        let number = self.words.whole(self.content);
        let rest = self.content.get(self.words.bytes..);
        let (Some(number), Some(rest)) = (number, rest) else {
            return Err(self.fault(expected, "the end of the record".to_owned()));
        };
        self.content = rest;
        Ok(number)
    }

    fn fault(&self, expected: &'static str, found: String) -> Fault {
        Fault::new(expected, found).at(format_args!("byte {}", self.place))
    }
}
