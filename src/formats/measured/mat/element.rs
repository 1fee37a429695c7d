//! Data elements: a tag with type and size, and the bytes that it speaks of.

use std::borrow::Cow;
use std::fmt::Display;
use std::ops::Range;

use crate::files::{Fault, Place};
use crate::formats::bytes::ByteOrder;

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
