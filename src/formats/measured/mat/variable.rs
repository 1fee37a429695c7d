//! The variables of a file, packed or not.

use std::borrow::Cow;
use std::io;
use std::io::Read;
use std::ops::Range;

use flate2::read::ZlibDecoder;

use super::element::{COMPRESSED, Element, Elements, HEAD, MATRIX, fault};
use crate::files::Fault;
use crate::formats::bytes::ByteOrder;

/// Most bytes a variable, as of MATLAB itself: "2 GB per variable" (The MathWorks, "MAT-file versions", version 7).
const LARGEST: usize = 1 << 31;
/// Most bytes that deflate packs into one.
const PACKING: usize = 1032;
/// Bytes of the tag before what was packed.
const TAG: usize = 8;

/// All variables, none of them unpacked: [`MATRIX`] or [`COMPRESSED`].
pub(super) fn variables(file: &[u8], order: ByteOrder) -> Result<Vec<Element>, Fault> {
    let mut elements = Elements::new(file, HEAD..file.len(), order);
    let mut found = Vec::new();
    while !elements.is_empty() {
        let at = elements.place();
        let element = elements.take("a variable")?;
        if !matches!(element.kind, MATRIX | COMPRESSED) {
            return Err(fault(at, "a variable", format_args!("an element of type {}", element.kind)));
        }
        found.push(element);
    }
    Ok(found)
}

/// The bytes that a variable lies in, and where: all of the file, or what was unpacked.
pub(super) fn open<'a>(
    variable: &Element,
    file: &'a [u8],
    order: ByteOrder,
) -> Result<(Cow<'a, [u8]>, Range<usize>), Fault> {
    if variable.kind == MATRIX {
        return Ok((Cow::Borrowed(file), variable.data.clone()));
    }
    let bytes = unpack(file.get(variable.data.clone()).unwrap_or_default(), order)?;
    let all = 0..bytes.len();
    Ok((Cow::Owned(bytes), all))
}

/// What was packed, without its tag. Neither the size in the tag nor the length of the stream is believed alone.
fn unpack(packed: &[u8], order: ByteOrder) -> Result<Vec<u8>, Fault> {
    let wrong = |found: String| fault(0, "a compressed variable", found);
    let damaged = |error: io::Error| wrong(error.to_string());
    let mut from = ZlibDecoder::new(packed);
    let mut tag = [0; TAG];
    from.read_exact(&mut tag).map_err(damaged)?;
    if order.u32(&tag) != MATRIX {
        return Err(wrong(format!("an element of type {}", order.u32(&tag))));
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
        return Err(wrong(format!("{size} bytes, of which {} are there", bytes.len())));
    }
    // reading on to the end also compares the checksum
    if from.read(&mut tag).map_err(damaged)? > 0 {
        return Err(fault(size, "the end of a compressed variable", "more than its size"));
    }
    Ok(bytes)
}
