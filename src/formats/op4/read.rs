//! Reads files: which kind it is, then its matrices.

use std::path::Path;

use super::super::FormatError;
use super::Op4Matrix;
use super::ascii::read_ascii;
use super::binary::{Words, read_binary};
use crate::files::{Fault, bytes_of};

/// Reads the matrices of a file, binary or ASCII, in their order. Names may be there twice. Memory stays below 16 times
/// the file's size and 1 MiB; [`Op4Matrix::dense`] has a bound of its own.
///
/// # Errors
/// [`FormatError::File`] with the place, what was found and what was expected.
pub fn read_op4(path: &Path) -> Result<Vec<Op4Matrix>, FormatError> {
    op4_from_bytes(&bytes_of(path)?, path)
}

/// As [`read_op4`], of a file that is in memory; `path` is for messages.
///
/// # Errors
/// As [`read_op4`].
pub fn op4_from_bytes(bytes: &[u8], path: &Path) -> Result<Vec<Op4Matrix>, FormatError> {
    let read = match bytes.first_chunk::<4>() {
        None => Err(Fault::new("a matrix", format!("{} bytes", bytes.len())).at("byte 0")),
        Some(&first) => match Words::of_first_record(first) {
            Some(words) => read_binary(bytes, words),
            None if first.contains(&0) => {
                Err(Fault::new("a record of 24 or 48 bytes, or text", format!("bytes {first:?}")).at("byte 0"))
            }
            None => read_ascii(bytes),
        },
    };
    Ok(read.map_err(|fault| fault.of(path))?)
}
