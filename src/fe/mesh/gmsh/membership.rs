//! Which elements belong to which physical group, and how much memory lists of them may take.

use super::MshError;
use super::entities::Physical;
use crate::fe::mesh::{ElementBlock, ElementId};

/// Elements of a block that belong to a physical group of its dimension.
pub(super) struct Membership {
    pub(super) dimension: usize,
    pub(super) physical: i32,
    pub(super) block: usize,
    pub(super) members: Members,
}

/// Which elements of a block.
pub(super) enum Members {
    All,
    /// These, sorted.
    Some(Vec<u32>),
}

impl Membership {
    pub(super) fn key(&self) -> (usize, i32) {
        (self.dimension, self.physical)
    }

    pub(super) fn len(&self, blocks: &[ElementBlock]) -> usize {
        match &self.members {
            Members::All => blocks[self.block].len(),
            Members::Some(list) => list.len(),
        }
    }

    pub(super) fn elements<'a>(&'a self, blocks: &'a [ElementBlock]) -> impl Iterator<Item = ElementId> + 'a {
        let (all, some): (_, &[u32]) = match &self.members {
            Members::All => (0..blocks[self.block].len(), &[]),
            Members::Some(list) => (0..0, list),
        };
        let indices = all.chain(some.iter().map(|&index| index as usize));
        indices.map(|index| ElementId { block: self.block, index })
    }
}

/// The memory that groups may take: entities in many groups multiply what a file holds, without limit.
pub(super) struct Allowance {
    file_bytes: usize,
    listed: u64,
}

impl Allowance {
    /// Bytes for every byte of the file. An element in a group takes 16 bytes and a volume element of a
    /// file about 100: twenty groups that all hold the whole mesh are within it.
    const FACTOR: u64 = 4;
    /// Bytes that any file may have.
    const FIXED: u64 = 1 << 15;
    /// What a group takes besides its list, with its name, in items of a list.
    pub(super) const GROUP: usize = 10;
    /// What a membership takes, in items of a list.
    const MEMBERSHIP: usize = 8;

    pub(super) fn new(file_bytes: usize) -> Self {
        Self { file_bytes, listed: 0 }
    }

    /// Asks for room for so many more memberships.
    pub(super) fn take_memberships(&mut self, count: usize) -> Result<(), MshError> {
        self.take(Self::MEMBERSHIP.saturating_mul(count))
    }

    /// Asks for room to list so many more items.
    pub(super) fn take(&mut self, items: usize) -> Result<(), MshError> {
        self.listed += items as u64;
        let bytes = self.listed.saturating_mul(size_of::<ElementId>() as u64);
        if bytes > Self::FIXED + Self::FACTOR * self.file_bytes as u64 {
            return Err(MshError::TooManyMembers { needed: bytes, file_bytes: self.file_bytes });
        }
        Ok(())
    }
}

/// Memberships by entity, as MSH 4.1 has them.
pub(super) fn by_entity(
    blocks: &[ElementBlock],
    physical: &Physical,
    allowance: &mut Allowance,
) -> Result<Vec<Membership>, MshError> {
    let own = |block: &ElementBlock| physical.of(block.entity);
    let mut count = 0;
    for block in blocks {
        let of_block = own(block).count();
        allowance.take_memberships(of_block)?;
        count += of_block;
    }
    let mut found = Vec::with_capacity(count);
    for (number, block) in blocks.iter().enumerate() {
        found.extend(own(block).map(|physical| Membership {
            dimension: block.entity.dimension,
            physical,
            block: number,
            members: Members::All,
        }));
    }
    // a group that an entity names twice
    found.sort_unstable_by_key(|own| (own.key(), own.block));
    found.dedup_by_key(|own| (own.key(), own.block));
    Ok(found)
}
