//! Reads arrays out of an archive.
//!
//! Bytes of an array to numbers and text.

use super::super::FormatError;
use super::super::bytes::{ByteOrder, NumberType};
use super::header::{Header, parse};
use crate::files;
use crate::files::{Fault, FileError};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::{fmt, io};
use zip::ZipArchive;

/// An array that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct NpzValues<T> {
    /// Length in each dimension.
    pub shape: Vec<usize>,
    /// Values, last index fastest (C order) however the file had them.
    pub values: Vec<T>,
}

/// Reads arrays of up to three dimensions from an archive, stored or deflated, in C or Fortran order.
///
/// An array's values are read as they arrive, whatever the file says of their number: memory stays below 8 times the file's
/// size where arrays are stored, and 4200 times where they are deflated (which packs 1032 to 1 at best), and 1 MiB. For
/// [`real`](Self::real) and [`whole`](Self::whole), which make 8 bytes of 4, the factors are twice as large; for
/// [`texts`](Self::texts), whose entries have an address and a length each, 20 times.
#[derive(Debug)]
pub struct NpzReader {
    path: PathBuf,
    archive: ZipArchive<BufReader<File>>,
}

/// Longest header that is believed, bytes.
const LONGEST_HEADER: usize = 1 << 16;
/// Bytes that are read at once.
const BUFFER: usize = 1 << 16;

impl NpzReader {
    /// Opens an archive.
    ///
    /// # Errors
    /// [`FormatError::File`].
    pub fn open(path: &Path) -> Result<Self, FormatError> {
        let file = files::open(path).map_err(FileError::read(path))?;
        let archive = ZipArchive::new(BufReader::new(file))
            .map_err(|error| Fault::new("a NumPy archive (.npz)", error).of(path))?;
        Ok(Self { path: path.to_owned(), archive })
    }

    /// Names of the arrays.
    pub fn names(&self) -> Vec<String> {
        let names = self.archive.file_names().flatten();
        names.filter_map(|name| Some(name.strip_suffix(".npy")?.to_owned())).collect()
    }

    /// Whether there is an array of this name.
    pub fn has(&self, name: &str) -> bool {
        let mut names = self.archive.file_names().flatten();
        names.any(|own| own.strip_suffix(".npy") == Some(name))
    }

    /// Reads an array of f64 (`<f8`).
    ///
    /// # Errors
    /// [`FormatError`] if there is none of this name, it is damaged, of another type, or has more than three dimensions.
    pub fn f64(&mut self, name: &str) -> Result<NpzValues<f64>, FormatError> {
        self.values(name, "numbers of type '<f8'", |type_name| real(type_name).filter(|_| type_name == "<f8"))
    }

    /// Reads an array of i64 (`<i8`).
    ///
    /// # Errors
    /// As [`f64`](Self::f64).
    pub fn i64(&mut self, name: &str) -> Result<NpzValues<i64>, FormatError> {
        self.values(name, "numbers of type '<i8'", |type_name| whole(type_name).filter(|_| type_name == "<i8"))
    }

    /// Reads an array of real numbers as other programs may have it: f8, f4, i1 to i8, u1 to u4, in either byte order.
    ///
    /// # Errors
    /// As [`f64`](Self::f64).
    pub fn real(&mut self, name: &str) -> Result<NpzValues<f64>, FormatError> {
        self.values(name, "real numbers (f8, f4, i1 to i8, u1 to u4)", real)
    }

    /// Reads an array of whole numbers as other programs may have it: i8, i4, u4, in either byte order.
    ///
    /// # Errors
    /// As [`f64`](Self::f64).
    pub fn whole(&mut self, name: &str) -> Result<NpzValues<i64>, FormatError> {
        self.values(name, "whole numbers (i8, i4 or u4)", whole)
    }

    /// Reads an array of text (`U`, in either byte order, or `S`) of up to 16384 characters each; what is no character is
    /// read as U+FFFD.
    ///
    /// # Errors
    /// As [`f64`](Self::f64).
    pub fn texts(&mut self, name: &str) -> Result<NpzValues<String>, FormatError> {
        self.values(name, "text (U or S) of 1 to 16384 characters", text)
    }

    /// An array that is not what it should be.
    pub(in crate::formats) fn wrong(
        &self,
        name: &str,
        expected: &'static str,
        found: impl fmt::Display,
    ) -> FormatError {
        array_fault(&self.path, name, expected, found)
    }

    /// An array whose shape is not what it should be.
    pub(in crate::formats) fn wrong_shape(&self, name: &str, expected: &'static str, shape: &[usize]) -> FormatError {
        self.wrong(name, expected, format!("shape {shape:?}"))
    }

    /// An array that is not there.
    pub(in crate::formats) fn missing(&self, name: &str) -> FormatError {
        let names = self.names();
        let known: Vec<String> = names.iter().take(20).map(|name| format!("\"{name}\"")).collect();
        let known = if known.is_empty() { "no arrays".to_owned() } else { known.join(", ") };
        Fault::new(format!("an array \"{name}\""), known).of(&self.path).into()
    }

    fn values<T: Clone>(
        &mut self,
        name: &str,
        expected_type: &'static str,
        decoder: impl Fn(&str) -> Option<Decoder<T>>,
    ) -> Result<NpzValues<T>, FormatError> {
        if !self.has(name) {
            return Err(self.missing(name));
        }
        let path = &self.path;
        let wrong = |expected: &'static str, found: String| array_fault(path, name, expected, found);
        let damaged = |source| FormatError::Damaged { path: path.clone(), name: name.to_owned(), source };
        let entry = self.archive.by_name(&format!("{name}.npy"));
        let mut entry = entry.map_err(|source| damaged(source.into()))?;
        let text = header_text(&mut entry).map_err(damaged)?;
        let Some(header) = text.as_deref().and_then(parse) else {
            return Err(wrong("a NumPy array", "a damaged header".to_owned()));
        };
        let Some(decoder) = decoder(&header.type_name) else {
            return Err(wrong(expected_type, format!("'{}'", header.type_name)));
        };
        let shape = &header.shape;
        if shape.len() > 3 {
            return Err(wrong("up to three dimensions", shape.len().to_string()));
        }
        let Some(count) = shape.iter().try_fold(1_usize, |n, &m| n.checked_mul(m)) else {
            return Err(wrong("a shape that memory can hold", format!("{shape:?}")));
        };
        let (values, more) = numbers(&mut entry, count, &decoder).map_err(damaged)?;
        if values.len() != count || more {
            let amount = if more { "more" } else { "fewer" };
            return Err(wrong("as many values as the shape has", format!("{amount} values than shape {shape:?} has")));
        }
        Ok(header.in_c_order(values))
    }
}

fn array_fault(path: &Path, name: &str, expected: &'static str, found: impl fmt::Display) -> FormatError {
    Fault::new(expected, found).within(format!("array \"{name}\"")).of(path).into()
}

/// Text of the header; none if it does not begin as one or is too long.
fn header_text(from: &mut impl Read) -> io::Result<Option<Vec<u8>>> {
    let (mut start, mut length) = ([0; 8], [0; 4]);
    from.read_exact(&mut start)?;
    let width = match start {
        [0x93, b'N', b'U', b'M', b'P', b'Y', 1, _] => 2,
        [0x93, b'N', b'U', b'M', b'P', b'Y', 2 | 3, _] => 4,
        _ => return Ok(None),
    };
    from.read_exact(&mut length[..width])?;
    let length = u32::from_le_bytes(length) as usize;
    if length > LONGEST_HEADER {
        return Ok(None);
    }
    let mut text = vec![0; length];
    from.read_exact(&mut text)?;
    Ok(Some(text))
}

/// Up to `count` values, and whether anything follows them.
fn numbers<T>(from: &mut impl Read, count: usize, decoder: &Decoder<T>) -> io::Result<(Vec<T>, bool)> {
    let size = decoder.bytes;
    let most = (BUFFER / size).max(1) * size;
    let (mut values, mut bytes) = (Vec::new(), Vec::new());
    let mut read = |bytes: &mut Vec<u8>, wanted: usize| {
        bytes.clear();
        from.by_ref().take(wanted as u64).read_to_end(bytes)
    };
    while values.len() < count {
        let wanted = (count - values.len()).saturating_mul(size).min(most);
        let found = read(&mut bytes, wanted)?;
        values.extend(bytes.chunks_exact(size).map(&decoder.decode));
        if found < wanted {
            return Ok((values, false));
        }
    }
    // reading on to the end also compares the checksum
    let more = read(&mut bytes, 1)? > 0;
    Ok((values, more))
}

impl Header {
    /// Puts values in the order of the file into C order.
    fn in_c_order<T: Clone>(self, values: Vec<T>) -> NpzValues<T> {
        let shape = self.shape;
        // without values a size may be anything
        if !self.fortran_order || shape.len() < 2 || values.is_empty() {
            return NpzValues { shape, values };
        }
        let mut sizes = [1; 3];
        sizes[..shape.len()].copy_from_slice(&shape);
        let [a, b, c] = sizes;
        let places = (0..a).flat_map(|i| (0..b).flat_map(move |j| (0..c).map(move |k| (i, j, k))));
        let values = places.map(|(i, j, k)| values[i + a * (j + b * k)].clone()).collect();
        NpzValues { shape, values }
    }
}

/// Reads a value from its bytes.
type Decode<T> = dyn Fn(&[u8]) -> T;

/// How one value is read.
pub(super) struct Decoder<T> {
    /// Bytes a value, at least 1.
    pub(super) bytes: usize,
    /// Reads one from that many bytes.
    pub(super) decode: Box<Decode<T>>,
}

/// Most characters a text that are believed.
const LONGEST_TEXT: usize = 1 << 14;

/// Byte order and name of NumPy's type.
fn order(type_name: &str) -> Option<(ByteOrder, &str)> {
    let order = if type_name.starts_with('>') { ByteOrder::Big } else { ByteOrder::Little };
    let name = type_name.strip_prefix(['<', '>']);
    // a single byte has no order
    let single = || type_name.strip_prefix('|').filter(|name| name.ends_with('1'));
    Some((order, name.or_else(single)?))
}

/// Real numbers: f8, f4, and whole ones of one to eight bytes.
pub(super) fn real(type_name: &str) -> Option<Decoder<f64>> {
    let (order, name) = order(type_name)?;
    let number = match name {
        "f8" => NumberType::F64,
        "f4" => NumberType::F32,
        "i8" => NumberType::I64,
        "i4" => NumberType::I32,
        "i2" => NumberType::I16,
        "i1" => NumberType::I8,
        "u4" => NumberType::U32,
        "u2" => NumberType::U16,
        "u1" => NumberType::U8,
        _ => return None,
    };
    Some(Decoder { bytes: number.width(), decode: Box::new(move |bytes| number.value(bytes, order)) })
}

/// Whole numbers: i8, i4, u4.
pub(super) fn whole(type_name: &str) -> Option<Decoder<i64>> {
    let (order, name) = order(type_name)?;
    let (bytes, decode): (_, Box<Decode<i64>>) = match name {
        "i8" => (8, Box::new(move |bytes| i64::from_le_bytes(order.lowest_first(bytes)))),
        "i4" => (4, Box::new(move |bytes| i64::from(i32::from_le_bytes(order.lowest_first(bytes))))),
        "u4" => (4, Box::new(move |bytes| i64::from(order.u32(bytes)))),
        _ => return None,
    };
    Some(Decoder { bytes, decode })
}

/// Text: U (four bytes a character) and S (one), padded with zeros.
pub(super) fn text(type_name: &str) -> Option<Decoder<String>> {
    let length = |digits: &str| digits.parse().ok().filter(|length: &usize| (1..=LONGEST_TEXT).contains(length));
    if let Some(digits) = type_name.strip_prefix("|S") {
        let decode = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim_end_matches('\0').to_owned();
        return Some(Decoder { bytes: length(digits)?, decode: Box::new(decode) });
    }
    let (order, name) = order(type_name)?;
    let decode = move |bytes: &[u8]| {
        let codes = bytes.chunks_exact(4).map(|code| order.u32(code));
        let padded: String = codes.map(|code| char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        padded.trim_end_matches('\0').to_owned()
    };
    Some(Decoder { bytes: 4 * length(name.strip_prefix('U')?)?, decode: Box::new(decode) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(clippy::float_cmp)] // numbers that both types hold
    fn numbers_of_every_width_and_order() {
        let read = |name: &str, bytes: &[u8]| real(name).map(|own| (own.decode)(bytes));
        assert_eq!(read("<f8", &1.25_f64.to_le_bytes()), Some(1.25));
        assert_eq!(read(">f8", &1.25_f64.to_be_bytes()), Some(1.25));
        assert_eq!(read("<f4", &(-2.5_f32).to_le_bytes()), Some(-2.5));
        assert_eq!(read(">i4", &(-7_i32).to_be_bytes()), Some(-7.0));
        assert_eq!(read("<i8", &9_i64.to_le_bytes()), Some(9.0));
        assert_eq!(read("<i2", &(-300_i16).to_le_bytes()), Some(-300.0));
        assert_eq!(read(">u2", &60_000_u16.to_be_bytes()), Some(60_000.0));
        assert_eq!(read("<u4", &u32::MAX.to_le_bytes()), Some(4_294_967_295.0));
        assert_eq!(read("|i1", &[0x80]), Some(-128.0));
        assert_eq!(read("|u1", &[0x80]), Some(128.0));
        for other in ["<c16", "f8", "|O", "|b1", "|S1", "|i2", "<f2", "<u8", ""] {
            assert_eq!(read(other, &[0; 16]), None, "{other}");
        }
        let read = |name: &str, bytes: &[u8]| whole(name).map(|own| (own.decode)(bytes));
        assert_eq!(read(">i8", &(-3_i64).to_be_bytes()), Some(-3));
        assert_eq!(read("<i4", &(-3_i32).to_le_bytes()), Some(-3));
        assert_eq!(read("<u4", &u32::MAX.to_le_bytes()), Some(4_294_967_295));
        assert_eq!(read("<f8", &[0; 8]), None);
    }

    #[test]
    fn text_loses_its_padding() {
        let read = |name: &str, bytes: &[u8]| text(name).map(|own| (own.decode)(bytes));
        let codes = ['b', 'ä', '\0'].map(u32::from);
        let little: Vec<u8> = codes.iter().flat_map(|code| code.to_le_bytes()).collect();
        let big: Vec<u8> = codes.iter().flat_map(|code| code.to_be_bytes()).collect();
        assert_eq!(read("<U3", &little).as_deref(), Some("bä"));
        assert_eq!(read(">U3", &big).as_deref(), Some("bä"));
        assert_eq!(read("|S3", b"ab\0").as_deref(), Some("ab"));
        assert_eq!(read("|S2", &[0, 0]).as_deref(), Some(""));
        assert_eq!(read("<U1", &[0xff; 4]).as_deref(), Some("\u{fffd}"));
        for other in ["<U0", "|S0", "<U16385", "<f8", "U3"] {
            assert_eq!(read(other, &[]), None, "{other}");
        }
    }
}
