//! Parquet tables: one group of rows, plain encoding, no compression, which every reader knows.
//!
//! The file is the magic, a page for each column, and a description in Thrift's compact protocol (apache/parquet-format, version 2.10:
//! `parquet.thrift`, `Encodings.md`). The crates for it build much more than a writer of plain pages.
//!
//! **Limitations**: a column's page is below 2 GB; lists are of numbers and not empty.

use super::FormatError;
use crate::files::write_atomic;
use std::io::Write;
use std::path::Path;

const MAGIC: &[u8] = b"PAR1";

/// The values of a column; texts and numbers may be missing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ParquetValues {
    Texts(Vec<Option<String>>),
    Numbers(Vec<Option<f64>>),
    Whole(Vec<Option<i64>>),
    /// A list of numbers a row, all as long.
    Lists(Vec<Vec<f32>>),
}

/// A named column.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ParquetColumn {
    pub(crate) name: String,
    pub(crate) values: ParquetValues,
}

/// Thrift's compact protocol: fields by the difference of their numbers, whole numbers in zigzag.
#[derive(Default)]
struct Compact {
    bytes: Vec<u8>,
    /// Number of the last field, of each open struct.
    last: Vec<u8>,
}

const I32: u8 = 5;
const I64: u8 = 6;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

impl Compact {
    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }

    fn zigzag(&mut self, value: i64) {
        self.varint(((value << 1) ^ (value >> 63)) as u64);
    }

    fn field(&mut self, number: u8, kind: u8) {
        if let Some(last) = self.last.last_mut() {
            self.bytes.push((number - *last) << 4 | kind);
            *last = number;
        }
    }

    fn i32(&mut self, number: u8, value: i64) {
        self.field(number, I32);
        self.zigzag(value);
    }

    fn i64(&mut self, number: u8, value: usize) {
        self.field(number, I64);
        self.zigzag(value as i64);
    }

    fn text(&mut self, value: &str) {
        self.varint(value.len() as u64);
        self.bytes.extend(value.as_bytes());
    }

    fn list(&mut self, number: u8, kind: u8, length: usize) {
        self.field(number, LIST);
        match length {
            0..15 => self.bytes.push((length as u8) << 4 | kind),
            _ => {
                self.bytes.push(0xf0 | kind);
                self.varint(length as u64);
            }
        }
    }

    fn open(&mut self) {
        self.last.push(0);
    }

    fn close(&mut self) {
        self.bytes.push(0);
        self.last.pop();
    }
}

/// Levels of one bit as runs of equal ones.
fn levels(runs: impl IntoIterator<Item = (usize, u8)>) -> Vec<u8> {
    let mut coded = Compact::default();
    for (length, level) in runs {
        coded.varint((length as u64) << 1);
        coded.bytes.push(level);
    }
    let mut bytes = (coded.bytes.len() as u32).to_le_bytes().to_vec();
    bytes.extend(coded.bytes);
    bytes
}

/// Which values are there, and the bytes of those.
fn optional<T>(values: &[Option<T>], mut write: impl FnMut(&T, &mut Vec<u8>)) -> Vec<u8> {
    let runs = values.chunk_by(|a, b| a.is_some() == b.is_some());
    let mut bytes = levels(runs.map(|run| (run.len(), u8::from(run[0].is_some()))));
    values.iter().flatten().for_each(|value| write(value, &mut bytes));
    bytes
}

impl ParquetValues {
    fn rows(&self) -> usize {
        match self {
            Self::Texts(values) => values.len(),
            Self::Numbers(values) => values.len(),
            Self::Whole(values) => values.len(),
            Self::Lists(values) => values.len(),
        }
    }

    /// Number of values with those that are missing.
    fn count(&self) -> usize {
        match self {
            Self::Lists(rows) => rows.iter().map(Vec::len).sum(),
            other => other.rows(),
        }
    }

    /// Levels and values.
    fn page(&self) -> Vec<u8> {
        match self {
            Self::Texts(values) => optional(values, |text, bytes| {
                bytes.extend((text.len() as u32).to_le_bytes());
                bytes.extend(text.as_bytes());
            }),
            Self::Numbers(values) => optional(values, |number, bytes| bytes.extend(number.to_le_bytes())),
            Self::Whole(values) => optional(values, |number, bytes| bytes.extend(number.to_le_bytes())),
            Self::Lists(rows) => {
                // a row begins at level 0 and goes on at 1; all values are there
                let begun = rows.iter().flat_map(|row| [(1, 0), (row.len() - 1, 1)]);
                let mut bytes = levels(begun.filter(|(length, _)| *length > 0));
                bytes.extend(levels([(self.count(), 1)]));
                rows.iter().flatten().for_each(|number| bytes.extend(number.to_le_bytes()));
                bytes
            }
        }
    }

    /// Parquet's number of the type.
    fn kind(&self) -> i64 {
        match self {
            Self::Whole(_) => 2,
            Self::Lists(_) => 4,
            Self::Numbers(_) => 5,
            Self::Texts(_) => 6,
        }
    }
}

impl ParquetColumn {
    fn path(&self) -> Vec<&str> {
        match self.values {
            ParquetValues::Lists(_) => vec![&self.name, "list", "element"],
            _ => vec![&self.name],
        }
    }

    /// Its elements of the schema.
    fn schema(&self, meta: &mut Compact) {
        let [required, optional, repeated] = [0, 1, 2];
        let mut element = |kind: Option<i64>, repetition, name: &str, children: bool, converted: Option<i64>| {
            meta.open();
            if let Some(kind) = kind {
                meta.i32(1, kind);
            }
            meta.i32(3, repetition);
            meta.field(4, BINARY);
            meta.text(name);
            if children {
                meta.i32(5, 1);
            }
            if let Some(converted) = converted {
                meta.i32(6, converted);
            }
            meta.close();
        };
        let kind = Some(self.values.kind());
        match self.values {
            ParquetValues::Lists(_) => {
                element(None, required, &self.name, true, Some(3));
                element(None, repeated, "list", true, None);
                element(kind, required, "element", false, None);
            }
            ParquetValues::Texts(_) => element(kind, optional, &self.name, false, Some(0)),
            _ => element(kind, optional, &self.name, false, None),
        }
    }
}

/// The bytes of a table; all columns have as many rows.
fn parquet(columns: &[ParquetColumn], created_by: &str) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    let rows = columns.first().map_or(0, |column| column.values.rows());
    let mut chunks = Vec::new();
    for column in columns {
        let (page, begin) = (column.values.page(), bytes.len());
        let mut head = Compact::default();
        head.open();
        head.i32(1, 0);
        head.i32(2, page.len() as i64);
        head.i32(3, page.len() as i64);
        head.field(5, STRUCT);
        head.open();
        head.i32(1, column.values.count() as i64);
        // values plain, levels in runs
        head.i32(2, 0);
        head.i32(3, 3);
        head.i32(4, 3);
        head.close();
        head.close();
        bytes.extend(head.bytes);
        bytes.extend(page);
        chunks.push((begin, bytes.len() - begin));
    }
    let mut meta = Compact::default();
    meta.open();
    meta.i32(1, 1);
    let elements = columns.iter().map(|column| column.path().len()).sum::<usize>();
    meta.list(2, STRUCT, elements + 1);
    meta.open();
    meta.field(4, BINARY);
    meta.text("schema");
    meta.i32(5, columns.len() as i64);
    meta.close();
    columns.iter().for_each(|column| column.schema(&mut meta));
    meta.i64(3, rows);
    meta.list(4, STRUCT, 1);
    meta.open();
    meta.list(1, STRUCT, columns.len());
    for (column, (begin, length)) in columns.iter().zip(&chunks) {
        meta.open();
        meta.i64(2, *begin);
        meta.field(3, STRUCT);
        meta.open();
        meta.i32(1, column.values.kind());
        meta.list(2, I32, 2);
        meta.zigzag(0);
        meta.zigzag(3);
        let path = column.path();
        meta.list(3, BINARY, path.len());
        path.iter().for_each(|part| meta.text(part));
        meta.i32(4, 0);
        meta.i64(5, column.values.count());
        meta.i64(6, *length);
        meta.i64(7, *length);
        meta.i64(9, *begin);
        meta.close();
        meta.close();
    }
    meta.i64(2, chunks.iter().map(|(_, length)| length).sum());
    meta.i64(3, rows);
    meta.close();
    meta.field(6, BINARY);
    meta.text(created_by);
    meta.close();
    let length = meta.bytes.len() as u32;
    bytes.extend(meta.bytes);
    bytes.extend(length.to_le_bytes());
    bytes.extend(MAGIC);
    bytes
}

/// Writes a table, whole or not at all.
///
/// # Errors
/// [`FormatError::Refused`] for columns of different length, a column beyond 2 GB and an empty list; [`FormatError::File`].
pub(crate) fn write_parquet(path: &Path, columns: &[ParquetColumn]) -> Result<(), FormatError> {
    let rows = columns.first().map_or(0, |column| column.values.rows());
    for column in columns {
        let empty = matches!(&column.values, ParquetValues::Lists(lists) if lists.iter().any(Vec::is_empty));
        if column.values.rows() != rows || empty || column.values.count() > (1 << 28) {
            let expected = format!("{rows} rows, lists of one number at least and at most 2^28 values");
            return Err(FormatError::Refused(format!(
                "column \"{}\" of a Parquet table: expected {expected}",
                column.name
            )));
        }
    }
    let bytes = parquet(columns, concat!("plummer ", env!("CARGO_PKG_VERSION")));
    Ok(write_atomic(path, |file| file.write_all(&bytes))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// pyarrow 26.0.1 reads these bytes as `{"n": [1, None, -3], "t": ["a", "µ", None], "x": [0.5, 1.5, None], "s": [[1, 2], [3, 4], [5, 6]]}`.
    #[test]
    fn a_table_has_the_bytes_that_other_readers_know() {
        let column = |name: &str, values| ParquetColumn { name: name.to_owned(), values };
        let columns = [
            column("n", ParquetValues::Whole(vec![Some(1), None, Some(-3)])),
            column("t", ParquetValues::Texts(vec![Some("a".to_owned()), Some("µ".to_owned()), None])),
            column("x", ParquetValues::Numbers(vec![Some(0.5), Some(1.5), None])),
            column("s", ParquetValues::Lists(vec![vec![1.0, 2.0], vec![3.0, 4.0], vec![5.0, 6.0]])),
        ];
        let bytes = parquet(&columns, "plummer 0.1.0");
        let path = Path::new("a.parquet");
        let digest = crate::files::FileDigest::of_bytes(path, &bytes);
        assert_eq!(digest.sha256, "d65d837f01a1eb47dfcb76e4a23cec3a84ac2f771c0a016e3147465aad6fd4ce");
        let uneven = [columns[0].clone(), column("y", ParquetValues::Numbers(vec![None]))];
        let error = write_parquet(path, &uneven).unwrap_err().to_string();
        assert!(error.contains("column \"y\" of a Parquet table: expected 3 rows"), "{error}");
    }
}
