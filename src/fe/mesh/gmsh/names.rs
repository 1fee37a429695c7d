//! `$PhysicalNames`, always text, in binary files too.

use std::collections::HashSet;

use super::MshError;
use super::cursor::Cursor;

/// Name of a physical group.
pub(super) struct Name {
    pub(super) dimension: u8,
    pub(super) tag: i32,
    pub(super) name: String,
}

/// Reads the lines `dimension tag "name"` after their number; a name may hold blanks and quotes.
pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<Vec<Name>, MshError> {
    const COUNT: &str = "the number of physical names";
    const LINE: &str = "dimension, tag and \"name\" of a physical group";
    cursor.skip_blanks();
    let line = cursor.take_line();
    if line.is_empty() {
        return Err(cursor.truncated(COUNT));
    }
    let declared = std::str::from_utf8(line).ok();
    let declared = declared.and_then(|text| text.trim().parse().ok()).ok_or_else(|| cursor.malformed(COUNT, line))?;
    const SHORTEST_LINE: &str = "0 1 \"\"\n";
    let count = cursor.check_count(COUNT, declared, SHORTEST_LINE.len())?;
    let mut names = Vec::with_capacity(count);
    let mut seen = HashSet::with_capacity(count);
    for _ in 0..count {
        cursor.skip_blanks();
        let line = cursor.take_line();
        if line.is_empty() {
            return Err(cursor.truncated(LINE));
        }
        let name = parse(line).ok_or_else(|| cursor.malformed(LINE, line))?;
        if !seen.insert((name.dimension, name.tag)) {
            let expected = format!("one name for group {} of dimension {}", name.tag, name.dimension);
            return Err(cursor.malformed(expected, line));
        }
        names.push(name);
    }
    Ok(names)
}

fn parse(line: &[u8]) -> Option<Name> {
    let text = std::str::from_utf8(line).ok()?;
    let (numbers, quoted) = text.split_once('"')?;
    let name = quoted.strip_suffix('"')?;
    let mut numbers = numbers.split_ascii_whitespace();
    let dimension = numbers.next()?.parse().ok().filter(|&d: &u8| d <= 3)?;
    let tag = numbers.next()?.parse().ok().filter(|&tag: &i32| tag > 0)?;
    match numbers.next() {
        None => Some(Name { dimension, tag, name: name.to_owned() }),
        Some(_) => None,
    }
}

impl Name {
    /// Dimension and tag.
    pub(super) fn key(&self) -> (usize, i32) {
        (usize::from(self.dimension), self.tag)
    }
}
