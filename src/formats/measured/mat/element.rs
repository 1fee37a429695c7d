//! Data elements: a tag with type and size, and the bytes that it speaks of.
//!
//! The head of a file: which version it is, and which byte comes first.

use super::super::MeasuredError;
use crate::files::{Fault, Place};
use crate::formats::bytes::ByteOrder;
use std::borrow::Cow;
use std::fmt::Display;
use std::ops::Range;
use std::path::Path;

/// Types of elements that hold others.
pub(super) const MATRIX: u32 = 14;
pub(super) const COMPRESSED: u32 = 15;

/// Bytes of a tag, and what elements are padded to.
const TAG: usize = 8;
/// Most bytes that stand in the tag itself.
const SMALL: usize = 4;

/// What is wrong at a byte, counted from 0 in the file or in what was unpacked.
pub(super) fn fault(at: usize, expected: impl Into<Cow<'static, str>>, found: impl Display) -> Fault {
    Fault::new(expected, found).at(format_args!("byte {at}"))
}

/// The same, of an array; the innermost one stays.
pub(super) fn of_array(fault: Fault, array: &str) -> Fault {
    match &fault.place {
        Place::At(place) => Fault { place: Place::In(format!("array \"{array}\", {place}")), ..fault },
        _ => fault,
    }
}

/// One element.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Element {
    pub(super) kind: u32,
    /// Where its bytes are.
    pub(super) data: Range<usize>,
}

/// Elements one after another.
#[derive(Debug)]
pub(super) struct Elements<'a> {
    whole: &'a [u8],
    order: ByteOrder,
    at: usize,
}

impl<'a> Elements<'a> {
    /// The elements in a part of `whole`; places are counted in `whole`.
    pub(super) fn new(whole: &'a [u8], part: Range<usize>, order: ByteOrder) -> Self {
        let end = part.end.min(whole.len());
        Self { whole: &whole[..end], order, at: part.start.min(end) }
    }

    /// Whether there are no more.
    pub(super) fn is_empty(&self) -> bool {
        self.at == self.whole.len()
    }

    /// Where the next one begins.
    pub(super) fn place(&self) -> usize {
        self.at
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> usize {
        self.whole.len() - self.at
    }

    /// The next element.
    pub(super) fn take(&mut self, expected: &'static str) -> Result<Element, Fault> {
        let at = self.at;
        let left = self.left();
        let Some(tag) = self.whole[at..].get(..TAG) else {
            return Err(fault(at, expected, format!("{left} bytes")));
        };
        let word = self.order.u32(tag);
        // a size in the upper half: type, size and data share the eight bytes
        let small = word >> 16;
        if small != 0 {
            let size = small as usize;
            if size > SMALL {
                return Err(fault(at, expected, format_args!("{size} bytes in four")));
            }
            self.at += TAG;
            let start = at + TAG - SMALL;
            return Ok(Element { kind: word & 0xffff, data: start..start + size });
        }
        let size = self.order.u32(&tag[SMALL..]) as usize;
        let start = at + TAG;
        if size > left - TAG {
            return Err(fault(at, expected, format_args!("{size} bytes, of which {} are there", left - TAG)));
        }
        // elements that hold others are as long as they say; the last one may lack its padding
        let padded = match word {
            MATRIX | COMPRESSED => size,
            _ => size.next_multiple_of(TAG).min(left - TAG),
        };
        self.at = start + padded;
        Ok(Element { kind: word, data: start..start + size })
    }
}

/// Bytes of the head.
pub(super) const HEAD: usize = 128;
/// What an HDF5 file begins with, here or behind a head of MATLAB.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";
const HDF5_PLACES: [usize; 2] = [0, 512];

/// Byte order of a file of version 5 to 7, or why it is none.
pub(super) fn byte_order(bytes: &[u8], path: &Path) -> Result<ByteOrder, MeasuredError> {
    let version = |found: &str| {
        let (path, name) = (path.display(), path.file_stem().unwrap_or_default().to_string_lossy());
        let help = format!(
            "write it again as version 7: in MATLAB m = load('{name}.mat'); save('{name}-v7.mat', '-struct', 'm', '-v7'), \
             or in Python scipy.io.savemat('{name}-v7.mat', {{'x': x}})"
        );
        let message = format!("{path}: expected a MATLAB file of version 5 to 7, found version {found}");
        MeasuredError::refused_with(message, &help)
    };
    let hdf5 = |&place: &usize| bytes.get(place..).is_some_and(|at| at.starts_with(HDF5));
    if HDF5_PLACES.iter().any(hdf5) || bytes.starts_with(b"MATLAB 7.3") {
        return Err(version("7.3 (HDF5)"));
    }
    if is_version_4(bytes) {
        return Err(version("4"));
    }
    let (order, number) = match bytes.get(HEAD - 4..HEAD) {
        Some(&[low, high, b'I', b'M']) => (ByteOrder::Little, [high, low]),
        Some(&[high, low, b'M', b'I']) => (ByteOrder::Big, [high, low]),
        other => {
            let found = match other {
                Some(end) => format!("\"{}\"", end[2..].escape_ascii()),
                None => format!("a file of {} bytes", bytes.len()),
            };
            let fault = Fault::new("the head of a MATLAB file, which ends in IM or MI", found);
            return Err(fault.within(format!("byte {}", HEAD - 2)).of(path).into());
        }
    };
    match number {
        [1, _] => Ok(order),
        [2, _] => Err(version("7.3 (HDF5)")),
        _ => Err(version("unknown")),
    }
}

/// Whether a file begins as one of version 4: five whole numbers, of which the first has the decimal digits MOPT.
fn is_version_4(bytes: &[u8]) -> bool {
    [ByteOrder::Little, ByteOrder::Big].iter().any(|order| {
        let numbers: Vec<u32> = bytes.chunks_exact(4).take(5).map(|n| order.u32(n)).collect();
        let &[kind, rows, columns, complex, name] = numbers.as_slice() else {
            return false;
        };
        let [m, o, p, t] = [kind / 1000, kind / 100 % 10, kind / 10 % 10, kind % 10];
        // M: byte order or kind of machine, P: type of the numbers, T: full, text or sparse
        m <= 4
            && o == 0
            && p <= 5
            && t <= 2
            && rows <= i32::MAX as u32
            && columns <= i32::MAX as u32
            && complex <= 1
            && (1..=256).contains(&name)
    })
}
