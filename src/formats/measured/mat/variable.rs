//! The variables of a file, packed or not.

use std::borrow::Cow;
use std::io::{self, Read};
use std::ops::Range;

use flate2::read::ZlibDecoder;

use super::element::{COMPRESSED, Elements, MATRIX, fault};
use super::header::HEAD;
use crate::files::Fault;
use crate::formats::bytes::ByteOrder;

/// Most bytes a variable, as of MATLAB itself: "2 GB per variable" (The MathWorks, "MAT-file versions", version 7).
const LARGEST: usize = 1 << 31;
/// Most bytes that deflate packs into one.
const PACKING: usize = 1032;
/// Bytes of the tag before what was packed.
const TAG: usize = 8;

/// Where a variable is in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Variable {
    data: Range<usize>,
    packed: bool,
}

/// All variables, none of them unpacked.
pub(super) fn variables(file: &[u8], order: ByteOrder) -> Result<Vec<Variable>, Fault> {
    let mut elements = Elements::new(file, HEAD..file.len(), order);
    let mut found = Vec::new();
    while !elements.is_empty() {
        let at = elements.place();
        let element = elements.take("a variable")?;
        let packed = match element.kind {
            MATRIX => false,
            COMPRESSED => true,
            other => {
                let found = format!("an element of type {other}");
                return Err(fault(at, "a variable", found));
            }
        };
        found.push(Variable { data: element.data, packed });
    }
    Ok(found)
}

impl Variable {
    /// First byte in the file, if it is packed.
    pub(super) fn packed_at(&self) -> Option<usize> {
        self.packed.then_some(self.data.start)
    }

    /// The bytes that the variable lies in, and where: all of the file, or what was unpacked.
    pub(super) fn open<'a>(&self, file: &'a [u8], order: ByteOrder) -> Result<(Cow<'a, [u8]>, Range<usize>), Fault> {
        if !self.packed {
            return Ok((Cow::Borrowed(file), self.data.clone()));
        }
        let packed = file.get(self.data.clone()).unwrap_or_default();
        let bytes = unpack(packed, order)?;
        let all = 0..bytes.len();
        Ok((Cow::Owned(bytes), all))
    }
}

/// What was packed, without its tag. Neither the size in the tag nor the length of the stream is believed alone.
fn unpack(packed: &[u8], order: ByteOrder) -> Result<Vec<u8>, Fault> {
    let damaged = |error: io::Error| fault(0, "a compressed variable", error.to_string());
    let mut from = ZlibDecoder::new(packed);
    let mut tag = [0; TAG];
    from.read_exact(&mut tag).map_err(damaged)?;
    if order.u32(&tag) != MATRIX {
        let found = format!("an element of type {}", order.u32(&tag));
        return Err(fault(0, "a compressed variable", found));
    }
    let size = order.u32(&tag[4..]) as usize;
    if size > LARGEST || size / PACKING > packed.len() {
        let most = LARGEST.min(PACKING.saturating_mul(packed.len()));
        return Err(fault(0, format!("a compressed variable of at most {most} bytes"), format!("{size} bytes")));
    }
    // no more is taken at once than this; the rest comes as it is unpacked
    let mut bytes = Vec::with_capacity(size.min(1 << 16));
    let part = from.by_ref().take(size as u64).read_to_end(&mut bytes);
    part.map_err(damaged)?;
    if bytes.len() < size {
        let found = format!("{size} bytes, of which {} are there", bytes.len());
        return Err(fault(0, "a compressed variable", found));
    }
    // reading on to the end also compares the checksum
    if from.read(&mut tag).map_err(damaged)? > 0 {
        let found = "more than its size".to_owned();
        return Err(fault(size, "the end of a compressed variable", found));
    }
    Ok(bytes)
}
