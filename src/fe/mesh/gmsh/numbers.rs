//! Numbers one after the other, ASCII or binary.
//!
//! This is where an import spends its time: nothing is allocated and no message is built unless a number
//! is wrong. Decimal fractions go through `str::parse`, which rounds correctly and is as quick as the
//! libraries made for it.
//!
//! Which tags have occurred, and which index they have: tables where tags are dense, hashing where not.
//!
//! gmsh numbers nodes and elements from 1 without gaps unless told otherwise, and a table is then a
//! tenth of the time of a hash map. The limits keep a table within a few bytes an item, whatever the tags.

use super::MshError;
use super::cursor::{Cursor, Encoding};
use std::collections::{HashMap, HashSet};

/// Numbers that an item of a list takes at least.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    pub(super) sizes: usize,
    pub(super) ints: usize,
    pub(super) floats: usize,
}

impl Item {
    pub(super) const fn new(sizes: usize, ints: usize, floats: usize) -> Self {
        Self { sizes, ints, floats }
    }

    /// Bytes of one item: a number in ASCII takes a digit and a blank.
    fn bytes(self, encoding: Encoding) -> usize {
        match encoding {
            Encoding::Ascii => 2 * (self.sizes + self.ints + self.floats),
            Encoding::Binary { size_bytes, .. } => size_bytes * self.sizes + 4 * self.ints + 8 * self.floats,
        }
    }
}

/// Unsigned integer made of these bytes, `N` 4 or 8.
fn unsigned<const N: usize>(mut bytes: [u8; N], big_endian: bool) -> u64 {
    if big_endian {
        bytes.reverse();
    }
    let mut whole = [0; 8];
    whole[..N].copy_from_slice(&bytes);
    u64::from_le_bytes(whole)
}

impl Cursor<'_> {
    /// gmsh's size_t.
    #[inline]
    pub(super) fn size(&mut self, what: &'static str) -> Result<u64, MshError> {
        let found = match self.encoding {
            Encoding::Ascii => {
                self.skip_blanks();
                self.digits_here()
            }
            Encoding::Binary { big_endian, size_bytes: 4 } => {
                self.chunk::<4>().map(|bytes| unsigned(bytes, big_endian))
            }
            Encoding::Binary { big_endian, .. } => self.chunk::<8>().map(|bytes| unsigned(bytes, big_endian)),
        };
        found.ok_or_else(|| self.no_number(what, Some(u64::MAX)))
    }

    /// gmsh's int.
    #[inline]
    pub(super) fn int(&mut self, what: &'static str) -> Result<i32, MshError> {
        let found = match self.encoding {
            Encoding::Ascii => self.signed_digits(),
            Encoding::Binary { big_endian, .. } => {
                self.chunk::<4>().map(|bytes| unsigned(bytes, big_endian) as u32 as i32)
            }
        };
        found.ok_or_else(|| self.no_number(what, Some(i32::MAX as u64)))
    }

    /// An int that is not negative; messages about one that is say what was expected.
    #[inline]
    pub(super) fn unsigned_int(&mut self, what: &'static str, expected: &str) -> Result<u64, MshError> {
        let found = self.int(what)?;
        u64::try_from(found).map_err(|_| self.malformed(expected, found.to_string().as_bytes()))
    }

    /// gmsh's double; may be infinite or not a number.
    #[inline]
    pub(super) fn float(&mut self, what: &'static str) -> Result<f64, MshError> {
        let found = match self.encoding {
            Encoding::Ascii => self.fraction(),
            Encoding::Binary { big_endian, .. } => {
                self.chunk::<8>().map(|bytes| f64::from_bits(unsigned(bytes, big_endian)))
            }
        };
        found.ok_or_else(|| self.no_number(what, None))
    }

    /// A count of items, checked against what is left of the file: nothing is allocated for a count that
    /// cannot be true.
    pub(super) fn count(&mut self, what: &'static str, item: Item) -> Result<usize, MshError> {
        let declared = self.size(what)?;
        self.check_count(what, declared, item.bytes(self.encoding))
    }

    /// The same for a count that was read by other means, of items of so many bytes.
    pub(super) fn check_count(&self, what: &'static str, declared: u64, item_bytes: usize) -> Result<usize, MshError> {
        let remaining = self.rest().len();
        // one more: nothing need follow the last number
        let most = remaining / item_bytes.max(1) + 1;
        usize::try_from(declared).ok().filter(|&count| count <= most).ok_or_else(|| {
            self.fault(format_args!(
                "{declared} announced as {what}, but only {remaining} bytes follow; is the file complete?"
            ))
        })
    }

    /// A count that is text in binary files too, on a line of its own (MSH 2.2).
    pub(super) fn text_count(&mut self, what: &'static str, item: Item) -> Result<usize, MshError> {
        let word = self.take_word();
        if word.is_empty() {
            return Err(self.truncated(what));
        }
        let declared = std::str::from_utf8(word).ok();
        let declared = declared.and_then(|text| text.parse().ok()).ok_or_else(|| self.malformed(what, word))?;
        let count = self.check_count(what, declared, item.bytes(self.encoding))?;
        match self.is_binary().then(|| self.take_line()) {
            None | Some(b"") => Ok(count),
            Some(after) => Err(self.malformed(format!("nothing after {what}"), after)),
        }
    }

    /// The next bytes, if there are as many.
    #[inline]
    pub(super) fn chunk<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.set_mark();
        let bytes = self.rest().first_chunk().copied()?;
        self.position += N;
        Some(bytes)
    }

    /// The digits at the position, up to a blank or the end.
    #[inline]
    fn digits_here(&mut self) -> Option<u64> {
        let start = self.position;
        let (mut at, mut value) = (start, 0_u64);
        while let Some(byte) = self.bytes.get(at) {
            let digit = byte.wrapping_sub(b'0');
            if digit > 9 {
                if !byte.is_ascii_whitespace() {
                    return None;
                }
                break;
            }
            value = value.checked_mul(10)?.checked_add(u64::from(digit))?;
            at += 1;
        }
        self.position = at;
        (at > start).then_some(value)
    }

    fn signed_digits(&mut self) -> Option<i32> {
        self.skip_blanks();
        let negative = self.bytes.get(self.position) == Some(&b'-');
        self.position += usize::from(negative);
        let size = i64::try_from(self.digits_here()?).ok()?;
        i32::try_from(if negative { -size } else { size }).ok()
    }

    #[inline]
    fn fraction(&mut self) -> Option<f64> {
        self.skip_blanks();
        let rest = self.rest();
        let length = rest.iter().position(u8::is_ascii_whitespace);
        let word = &rest[..length.unwrap_or(rest.len())];
        let value = std::str::from_utf8(word).ok()?.parse().ok()?;
        self.position += word.len();
        Some(value)
    }

    /// Why there is no number at the mark, or no whole number up to `most`.
    #[cold]
    #[inline(never)]
    fn no_number(&mut self, what: &'static str, most: Option<u64>) -> MshError {
        self.position = self.mark;
        if self.is_binary() {
            return self.truncated(what);
        }
        match (self.take_word(), most) {
            ([], _) => self.truncated(what),
            (word, Some(most)) if word.iter().all(u8::is_ascii_digit) => {
                self.malformed(format!("{what}, at most {most}"), word)
            }
            (word, _) => self.malformed(what, word),
        }
    }
}

/// Index of each node tag.
pub(in crate::fe::mesh) enum NodeIndex {
    /// Index + 1 at the place of the tag, 0 for a tag that does not occur.
    Dense { table: Vec<u32>, longest: usize },
    /// Any tags.
    Sparse(HashMap<u64, u32>),
}

impl NodeIndex {
    /// For this many nodes.
    pub(in crate::fe::mesh) fn for_count(count: usize) -> Self {
        Self::Dense { table: vec![0; count + 1], longest: count.saturating_mul(4).saturating_add(1024) }
    }

    /// Gives a tag its index, below `u32::MAX`; false if it has one already.
    #[inline]
    pub(in crate::fe::mesh) fn insert(&mut self, tag: u64, index: u32) -> bool {
        loop {
            match self {
                Self::Dense { table, longest } => {
                    let at = usize::try_from(tag).unwrap_or(usize::MAX);
                    if let Some(slot) = table.get_mut(at) {
                        let is_new = *slot == 0;
                        *slot = index + 1;
                        return is_new;
                    }
                    if at < *longest {
                        table.reserve_exact(*longest - table.len());
                        table.resize(*longest, 0);
                    } else {
                        *self = Self::Sparse(sparse(table, *longest / 4));
                    }
                }
                Self::Sparse(map) => return map.insert(tag, index).is_none(),
            }
        }
    }

    /// The index of a tag.
    #[inline]
    pub(in crate::fe::mesh) fn get(&self, tag: u64) -> Option<usize> {
        match self {
            Self::Dense { table, .. } => {
                let slot = *table.get(usize::try_from(tag).ok()?)?;
                (slot as usize).checked_sub(1)
            }
            Self::Sparse(map) => map.get(&tag).map(|&index| index as usize),
        }
    }
}

#[cold]
fn sparse(table: &[u32], count: usize) -> HashMap<u64, u32> {
    let mut map = HashMap::with_capacity(count);
    let occurring = (0..).zip(table).filter(|(_, slot)| **slot > 0);
    map.extend(occurring.map(|(tag, &slot)| (tag, slot - 1)));
    map
}

/// Element tags that have occurred.
pub(super) enum TagSet {
    /// One bit a tag.
    Dense { bits: Vec<u64>, longest: usize },
    /// Any tags.
    Sparse(HashSet<u64>),
}

impl TagSet {
    /// For this many tags.
    pub(super) fn for_count(count: usize) -> Self {
        Self::Dense { bits: vec![0; count / 64 + 1], longest: count / 4 + 128 }
    }

    /// Adds a tag; false if it is there already.
    #[inline]
    pub(super) fn insert(&mut self, tag: u64) -> bool {
        loop {
            match self {
                Self::Dense { bits, longest } => {
                    let at = usize::try_from(tag / 64).unwrap_or(usize::MAX);
                    if let Some(word) = bits.get_mut(at) {
                        let bit = 1 << (tag % 64);
                        let is_new = *word & bit == 0;
                        *word |= bit;
                        return is_new;
                    }
                    if at < *longest {
                        bits.reserve_exact(*longest - bits.len());
                        bits.resize(*longest, 0);
                    } else {
                        *self = Self::Sparse(listed(bits, *longest * 4));
                    }
                }
                Self::Sparse(set) => return set.insert(tag),
            }
        }
    }
}

#[cold]
fn listed(bits: &[u64], count: usize) -> HashSet<u64> {
    let mut set = HashSet::with_capacity(count);
    for (at, &word) in (0_u64..).zip(bits) {
        set.extend((0..64).filter(|bit| word >> bit & 1 == 1).map(|bit| 64 * at + bit));
    }
    set
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tags that stay inside the table, that make it longer, and that leave it.
    #[test]
    fn dense_and_sparse_tags_are_found_again() {
        let lists: [&[u64]; 4] = [&[1, 2, 3], &[3, 1, 900], &[1, 2, 1_000_000_000_000, 3, u64::MAX], &[u64::MAX, 0, 7]];
        for tags in lists {
            let mut index = NodeIndex::for_count(tags.len());
            let mut set = TagSet::for_count(tags.len());
            for (position, &tag) in (0..).zip(tags) {
                assert!(index.insert(tag, position) && set.insert(tag), "{tag}");
            }
            for (position, &tag) in tags.iter().enumerate() {
                assert_eq!(index.get(tag), Some(position), "{tag}");
                assert!(!set.insert(tag), "{tag}");
            }
            assert_eq!(index.get(4), None);
            assert!(!index.insert(tags[0], 9) && set.insert(5));
        }
    }
}
