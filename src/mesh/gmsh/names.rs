//! `$PhysicalNames`, always text, in binary files too.

use std::collections::BTreeMap;

use super::MshError;
use super::cursor::Cursor;

/// Names by dimension and tag of the physical group.
pub(super) type Names = BTreeMap<(usize, i32), String>;

/// Reads the lines `dimension tag "name"` after their number; a name may hold blanks and quotes.
pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<Names, MshError> {
    const LINE: &str = "dimension, tag and \"name\" of a physical group";
    cursor.skip_blanks();
    let line = cursor.take_line();
    if line.is_empty() {
        return Err(cursor.truncated("the number of physical names"));
    }
    let count = std::str::from_utf8(line).ok();
    let count: usize = count
        .and_then(|text| text.trim().parse().ok())
        .ok_or_else(|| cursor.malformed("the number of physical names", line))?;
    let mut names = Names::new();
    for _ in 0..count {
        cursor.skip_blanks();
        let line = cursor.take_line();
        if line.is_empty() {
            return Err(cursor.truncated(LINE));
        }
        let (key, name) = parse(line).ok_or_else(|| cursor.malformed(LINE, line))?;
        if names.insert(key, name).is_some() {
            let expected = format!("one name for group {} of dimension {}", key.1, key.0);
            return Err(cursor.malformed(expected, line));
        }
    }
    Ok(names)
}

fn parse(line: &[u8]) -> Option<((usize, i32), String)> {
    let text = String::from_utf8_lossy(line);
    let (numbers, quoted) = text.split_once('"')?;
    let name = quoted.strip_suffix('"')?;
    let mut numbers = numbers.split_ascii_whitespace();
    let dimension = numbers.next()?.parse().ok().filter(|&d: &usize| d <= 3)?;
    let tag = numbers.next()?.parse().ok().filter(|&tag: &i32| tag > 0)?;
    match numbers.next() {
        None => Some(((dimension, tag), name.to_owned())),
        Some(_) => None,
    }
}
