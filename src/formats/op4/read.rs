//! Reads files: which kind it is, then its matrices.

use std::path::Path;

use super::ascii::read_ascii;
use super::binary::{Words, read_binary};
use super::error::Fault;
use super::{Op4Error, Op4Matrix, Op4Place};
use crate::files;

/// Reads the matrices of a file, binary or ASCII, in their order. Names may be there twice. Memory stays below 16 times
/// the file's size and 1 MiB; [`Op4Matrix::dense`] has a bound of its own.
///
/// # Errors
/// [`Op4Error::Read`]; [`Op4Error::Content`] with the place, what was found and what was expected.
pub fn read_op4(path: &Path) -> Result<Vec<Op4Matrix>, Op4Error> {
    let bytes = files::read(path).map_err(|source| Op4Error::Read {
        path: path.to_owned(),
        source,
    })?;
    op4_from_bytes(&bytes, path)
}

/// As [`read_op4`], of a file that is in memory; `path` is for messages.
///
/// # Errors
/// As [`read_op4`].
pub fn op4_from_bytes(bytes: &[u8], path: &Path) -> Result<Vec<Op4Matrix>, Op4Error> {
    let read = match bytes.first_chunk::<4>() {
        None => Err(Fault {
            place: Op4Place::Byte(0),
            expected: "a matrix",
            found: format!("{} bytes", bytes.len()),
        }),
        Some(&first) => match Words::of_first_record(first) {
            Some(words) => read_binary(bytes, words),
            None if first.contains(&0) => Err(Fault {
                place: Op4Place::Byte(0),
                expected: "a record of 24 or 48 bytes, or text",
                found: format!("bytes {first:?}"),
            }),
            None => read_ascii(bytes),
        },
    };
    read.map_err(|fault| Op4Error::Content {
        path: path.to_owned(),
        place: fault.place,
        expected: fault.expected,
        found: fault.found,
    })
}
