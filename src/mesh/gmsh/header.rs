//! `$MeshFormat`: is it an MSH file, of which version, in which encoding.

use super::cursor::{Cursor, Encoding, quoted};
use super::{MshError, sections};

/// Reads from the start of the file to the end of `$MeshFormat`, and sets the cursor's encoding.
/// Returns where the section begins (gmsh allows `$Comments` before it).
pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<usize, MshError> {
    let start = loop {
        cursor.skip_blanks();
        let start = cursor.position();
        match cursor.take_line() {
            b"$MeshFormat" => break start,
            b"$Comments" => sections::skip(cursor, "Comments")?,
            b"$NOD" | b"$PARA" => {
                return Err(MshError::Version {
                    found: "1.0".to_owned(),
                });
            }
            line => {
                return Err(MshError::NotMsh {
                    found: quoted(line),
                });
            }
        }
    };
    cursor.section = "MeshFormat".to_owned();
    let version = cursor.take_word();
    if version.is_empty() {
        return Err(cursor.truncated("the version"));
    }
    if version != b"4.1" {
        let known = version.iter().all(|b| b.is_ascii_digit() || *b == b'.');
        return Err(if known {
            MshError::Version {
                found: String::from_utf8_lossy(version).into_owned(),
            }
        } else {
            cursor.malformed("the version", version)
        });
    }
    let binary = flag(
        cursor,
        "the file type, 0 (ASCII) or 1 (binary)",
        [b"0", b"1"],
    )?;
    let eight = flag(cursor, "the size of size_t, 4 or 8", [b"4", b"8"])?;
    cursor.take_line();
    if binary {
        cursor.mark();
        let one: Option<[u8; 4]> = cursor.rest().first_chunk().copied();
        let one = one.ok_or_else(|| cursor.truncated("the integer 1 that shows the byte order"))?;
        let big_endian = match (i32::from_le_bytes(one), i32::from_be_bytes(one)) {
            (1, _) => false,
            (_, 1) => true,
            _ => return Err(cursor.malformed("the integer 1 that shows the byte order", &one)),
        };
        cursor.advance(one.len());
        cursor.encoding = Encoding::Binary {
            big_endian,
            size_bytes: if eight { 8 } else { 4 },
        };
    }
    sections::close(cursor)?;
    Ok(start)
}

/// One of two words: false for the first, true for the second.
fn flag(cursor: &mut Cursor<'_>, what: &str, words: [&[u8]; 2]) -> Result<bool, MshError> {
    let word = cursor.take_word();
    if word.is_empty() {
        return Err(cursor.truncated(what));
    }
    let found = words.iter().position(|&known| known == word);
    found
        .map(|index| index == 1)
        .ok_or_else(|| cursor.malformed(what, word))
}
