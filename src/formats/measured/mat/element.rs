//! Data elements: a tag with type and size, and the bytes that it speaks of.

use std::ops::Range;

use crate::formats::bytes::ByteOrder;

/// Types of elements that hold others.
pub(super) const MATRIX: u32 = 14;
pub(super) const COMPRESSED: u32 = 15;

/// Bytes of a tag, and what elements are padded to.
const TAG: usize = 8;
/// Most bytes that stand in the tag itself.
const SMALL: usize = 4;

/// Something that is not what the format has there.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fault {
    /// Byte, counted from 0 in the file or in what was unpacked.
    pub(super) at: usize,
    /// The array, if its name is known.
    pub(super) array: Option<String>,
    pub(super) expected: String,
    pub(super) found: String,
}

impl Fault {
    pub(super) fn new(at: usize, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self { at, array: None, expected: expected.into(), found: found.into() }
    }

    /// The same, of an array; the innermost one stays.
    pub(super) fn of(mut self, array: &str) -> Self {
        self.array.get_or_insert_with(|| array.to_owned());
        self
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
    pub(super) fn take(&mut self, expected: &str) -> Result<Element, Fault> {
        let at = self.at;
        let left = self.left();
        let Some(tag) = self.whole[at..].get(..TAG) else {
            return Err(Fault::new(at, expected, format!("{left} bytes")));
        };
        let word = self.order.u32(tag);
        // a size in the upper half: type, size and data share the eight bytes
        let small = word >> 16;
        if small != 0 {
            let size = small as usize;
            if size > SMALL {
                let found = format!("{size} bytes in four");
                return Err(Fault::new(at, expected, found));
            }
            self.at += TAG;
            let start = at + TAG - SMALL;
            return Ok(Element { kind: word & 0xffff, data: start..start + size });
        }
        let size = self.order.u32(&tag[SMALL..]) as usize;
        let start = at + TAG;
        if size > left - TAG {
            let found = format!("{size} bytes, of which {} are there", left - TAG);
            return Err(Fault::new(at, expected, found));
        }
        let end = start + size;
        // elements that hold others are as long as they say; the last one may lack its padding
        let padded = match word {
            MATRIX | COMPRESSED => size,
            _ => size.next_multiple_of(TAG).min(left - TAG),
        };
        self.at = start + padded;
        Ok(Element { kind: word, data: start..end })
    }
}
