//! `$MeshFormat`: is it an MSH file, of which version, in which encoding.

use super::MshError;
use super::cursor::{Cursor, Encoding, quoted};
use crate::fe::mesh::{MshFormat, MshVersion};

/// Reads from the start of the file to the end of `$MeshFormat`, and sets the cursor's encoding.
pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<MshFormat, MshError> {
    loop {
        cursor.skip_blanks();
        match cursor.take_line() {
            b"$MeshFormat" => break,
            b"$Comments" => cursor.skip_section("Comments")?,
            b"$NOD" | b"$PARA" => {
                return Err(MshError::Version { found: "1.0".to_owned() });
            }
            line => {
                return Err(MshError::NotMsh { found: quoted(line) });
            }
        }
    }
    cursor.section = "MeshFormat".to_owned();
    let version = version(cursor)?;
    let binary = flag(cursor, "the file type, 0 (ASCII) or 1 (binary)", [b"0", b"1"])?;
    let size_bytes = match version {
        MshVersion::V41 => {
            if flag(cursor, "the size of size_t, 4 or 8", [b"4", b"8"])? {
                8
            } else {
                4
            }
        }
        // 2.2 counts with int and gives the size of a double here
        MshVersion::V22 => {
            flag(cursor, "the size of a double, 8", [b"8", b"8"])?;
            4
        }
    };
    cursor.take_line();
    if binary {
        cursor.encoding = Encoding::Binary { big_endian: big_endian(cursor)?, size_bytes };
    }
    cursor.close_section()?;
    Ok(MshFormat { version, binary })
}

fn version(cursor: &mut Cursor<'_>) -> Result<MshVersion, MshError> {
    match cursor.take_word() {
        b"" => Err(cursor.truncated("the version")),
        b"4.1" => Ok(MshVersion::V41),
        b"2.2" => Ok(MshVersion::V22),
        other if other.iter().all(|b| b.is_ascii_digit() || *b == b'.') => {
            Err(MshError::Version { found: String::from_utf8_lossy(&other[..other.len().min(20)]).into_owned() })
        }
        other => Err(cursor.malformed("the version", other)),
    }
}

/// Byte order from the integer 1 that begins the binary data.
fn big_endian(cursor: &mut Cursor<'_>) -> Result<bool, MshError> {
    const WHAT: &str = "the integer 1 that shows the byte order";
    cursor.set_mark();
    let one: Option<[u8; 4]> = cursor.rest().first_chunk().copied();
    let one = one.ok_or_else(|| cursor.truncated(WHAT))?;
    let big_endian = match (i32::from_le_bytes(one), i32::from_be_bytes(one)) {
        (1, _) => false,
        (_, 1) => true,
        _ => return Err(cursor.malformed(WHAT, &one)),
    };
    cursor.advance(one.len());
    Ok(big_endian)
}

/// One of two words: false for the first, true for the second.
fn flag(cursor: &mut Cursor<'_>, what: &str, words: [&[u8]; 2]) -> Result<bool, MshError> {
    let word = cursor.take_word();
    if word.is_empty() {
        return Err(cursor.truncated(what));
    }
    let found = words.iter().position(|&known| known == word);
    found.map(|index| index == 1).ok_or_else(|| cursor.malformed(what, word))
}
