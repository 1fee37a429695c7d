//! Binary files: Fortran records in either byte order, words of 32 or 64 bits.

use super::Op4Matrix;
use super::matrix::{Builder, Column};
use crate::files::Fault;
use crate::formats::bytes::{ByteOrder, NumberType};

/// Byte order and length of words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Words {
    order: ByteOrder,
    /// Bytes of a whole number, 4 or 8.
    bytes: usize,
}

impl Words {
    /// What the length of the first record says, four whole numbers and two words of text.
    pub(super) fn of_first_record(first: [u8; 4]) -> Option<Self> {
        let (little, big) = (u32::from_le_bytes(first), u32::from_be_bytes(first));
        let (order, length) = match (little, big) {
            (24 | 48, _) => (ByteOrder::Little, little),
            (_, 24 | 48) => (ByteOrder::Big, big),
            _ => return None,
        };
        let bytes = if length == 24 { 4 } else { 8 };
        Some(Self { order, bytes })
    }

    /// The whole number of these bytes.
    fn whole(self, bytes: &[u8]) -> i64 {
        match self.bytes {
            4 => i64::from(i32::from_le_bytes(self.order.lowest_first(bytes))),
            _ => i64::from_le_bytes(self.order.lowest_first(bytes)),
        }
    }

    /// Type of real numbers. With words of 64 bits single precision has as many bytes as double.
    fn real(self, single: bool) -> NumberType {
        if single && self.bytes == 4 { NumberType::F32 } else { NumberType::F64 }
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
    let mut number = || record.whole(HEADER);
    let header @ [columns, rows, _, kind] = [number()?, number()?, number()?, number()?];
    if record.content.len() != 2 * records.words.bytes {
        return Err(record.fault(HEADER, format!("a record of {} bytes", record.content.len())));
    }
    let mut builder = Builder::new(header, &String::from_utf8_lossy(record.content))
        .map_err(|expected| record.fault(expected, format!("{columns} columns, {rows} rows, type {kind}")))?;
    const COLUMN: &str = "column, first row and length of a column";
    loop {
        let mut record = records.next(COLUMN)?;
        let (column, row, length) = (record.whole(COLUMN)?, record.whole(COLUMN)?, record.whole(COLUMN)?);
        let found = || format!("column {column} from row {row} with {length} words");
        let kind = builder.column(column, row).map_err(|expected| record.fault(expected, found()))?;
        if kind == Column::End {
            return Ok(builder.matrix);
        }
        // a record may be longer than its column: what follows is left out
        let bytes = usize::try_from(length).ok().and_then(|length| length.checked_mul(records.words.bytes));
        let content = bytes.and_then(|bytes| record.content.get(..bytes));
        record.content = content.ok_or_else(|| record.fault("as many words as the record has", found()))?;
        match kind {
            Column::Dense(row) => {
                let bytes = record.content.len();
                run(&mut builder, &mut record, row, bytes)?;
            }
            _ => sparse(&mut builder, &mut record)?,
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
    let (real, order) = (record.words.real(builder.is_single()), record.words.order);
    let size = real.width();
    let rest = record.content.split_at_checked(bytes);
    let Some((numbers, rest)) = rest.filter(|_| bytes.is_multiple_of(size)) else {
        return Err(record.fault(NUMBERS, format!("{bytes} bytes from row {row}")));
    };
    let values = numbers.chunks_exact(size).map(|bytes| real.value(bytes, order));
    let count = bytes / size;
    builder.run(row, count, values).map_err(|expected| record.fault(expected, format!("{count} from row {row}")))?;
    record.content = rest;
    Ok(())
}

impl<'a> Records<'a> {
    /// The next record, both of whose lengths fit.
    fn next(&mut self, expected: &'static str) -> Result<Record<'a>, Fault> {
        let place = self.place;
        let fault = |found: String| Fault::new(expected, found).at(format_args!("byte {place}"));
        let rest = self.bytes.get(place..).unwrap_or_default();
        let length = |bytes: &[u8]| {
            let bytes = bytes.get(..4).ok_or_else(|| fault("the end of the file".to_owned()))?;
            Ok(self.words.order.u32(bytes))
        };
        let first = length(rest)?;
        // on machines of fewer bits than a length has, nothing is that long
        let size = usize::try_from(first).unwrap_or(usize::MAX);
        let content = rest.get(4..).and_then(|rest| rest.split_at_checked(size));
        let (content, after) =
            content.ok_or_else(|| fault(format!("a record of {first} bytes, which the file has not")))?;
        let last = length(after)?;
        if last != first {
            return Err(fault(format!("a record of {first} bytes that ends as one of {last}")));
        }
        self.place = place + 8 + size;
        Ok(Record { place: place + 4, content, words: self.words })
    }
}

impl Record<'_> {
    /// Takes a whole number.
    fn whole(&mut self, expected: &'static str) -> Result<i64, Fault> {
        let (number, rest) = self
            .content
            .split_at_checked(self.words.bytes)
            .ok_or_else(|| self.fault(expected, "the end of the record".to_owned()))?;
        self.content = rest;
        Ok(self.words.whole(number))
    }

    fn fault(&self, expected: &'static str, found: String) -> Fault {
        Fault::new(expected, found).at(format_args!("byte {}", self.place))
    }
}
