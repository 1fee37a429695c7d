//! Which tags have occurred, and which index they have: tables where tags are dense, hashing where not.
//!
//! gmsh numbers nodes and elements from 1 without gaps unless told otherwise, and a table is then a
//! tenth of the time of a hash map. The limits keep a table within a few bytes an item, whatever the tags.

use std::collections::{HashMap, HashSet};

/// Index of each node tag.
pub(super) enum NodeIndex {
    /// Index + 1 at the place of the tag, 0 for a tag that does not occur.
    Dense { table: Vec<u32>, longest: usize },
    /// Any tags.
    Sparse(HashMap<u64, u32>),
}

impl NodeIndex {
    /// For this many nodes.
    pub(super) fn for_count(count: usize) -> Self {
        Self::Dense { table: vec![0; count + 1], longest: count.saturating_mul(4).saturating_add(1024) }
    }

    /// Gives a tag its index, below `u32::MAX`; false if it has one already.
    #[inline]
    pub(super) fn insert(&mut self, tag: u64, index: u32) -> bool {
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
    pub(super) fn get(&self, tag: u64) -> Option<usize> {
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
