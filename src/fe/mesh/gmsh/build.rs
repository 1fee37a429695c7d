//! From what has been read to a [`Mesh`]: which elements belong to which physical group, and how much memory lists of them
//! may take.

use super::MshError;
use super::entities::Physical;
use crate::fe::mesh::{ElementBlock, ElementId, PhysicalGroup};

/// Name of a physical group.
pub(super) struct Name {
    /// `None`: that of the elements with the tag.
    pub(super) dimension: Option<usize>,
    pub(super) tag: i32,
    pub(super) name: String,
}

/// The names by dimension and tag, sorted; one without a dimension has those in which elements carry its tag and that
/// have no name.
fn by_key(names: Vec<Name>, memberships: &[Membership]) -> Vec<((usize, i32), String)> {
    let is_known = |names: &[Name], key: (usize, i32)| {
        names.binary_search_by_key(&(Some(key.0), key.1), |name| (name.dimension, name.tag)).is_ok()
    };
    let mut names = names;
    names.sort_unstable_by_key(|name| (name.dimension, name.tag));
    let carried = |key: (usize, i32)| memberships.binary_search_by_key(&key, Membership::key).is_ok();
    let without = names.partition_point(|name| name.dimension.is_none());
    let mut found = Vec::with_capacity(names.len());
    for name in &names[..without] {
        for dimension in 0..=3 {
            let key = (dimension, name.tag);
            if carried(key) && !is_known(&names, key) {
                found.push((key, name.name.clone()));
            }
        }
    }
    let given = names.into_iter().filter_map(|name| Some(((name.dimension?, name.tag), name.name)));
    found.extend(given);
    found.sort_unstable();
    found
}

/// The groups by dimension and tag: those that elements belong to and those that only have a name.
pub(super) fn groups(
    node_count: usize,
    blocks: &[ElementBlock],
    mut memberships: Vec<Membership>,
    names: Vec<Name>,
    allowance: &mut Allowance,
) -> Result<Vec<PhysicalGroup>, MshError> {
    memberships.sort_unstable_by_key(|own| (own.key(), own.block));
    let names = by_key(names, &memberships);
    let mut marks = Marks { round: vec![0; node_count], now: 0 };
    let together = |a: &Membership, b: &Membership| a.key() == b.key();
    // those with and without elements, counted twice where they have a name too
    let count = names.len() + memberships.chunk_by(together).count();
    allowance.take(Allowance::GROUP.saturating_mul(count))?;
    let mut groups = Vec::with_capacity(count);
    let mut names = names.into_iter().peekable();
    let mut unnamed = memberships.chunk_by(together).peekable();
    loop {
        let name_key = names.peek().map(|(key, _)| *key);
        let own_key = unnamed.peek().map(|own| own[0].key());
        let Some((dimension, tag)) = name_key.into_iter().chain(own_key).min() else {
            break;
        };
        let name = names.next_if(|(key, _)| *key == (dimension, tag));
        let own = unnamed.next_if(|own| own[0].key() == (dimension, tag));
        let own = own.unwrap_or_default();
        let count = own.iter().map(|own| own.len(blocks)).sum();
        allowance.take(count)?;
        let mut elements = Vec::with_capacity(count);
        own.iter().for_each(|own| elements.extend(own.elements(blocks)));
        groups.push(PhysicalGroup {
            name: name.map_or_else(|| tag.to_string(), |(_, name)| name),
            dimension,
            tag,
            nodes: marks.nodes(&elements, blocks, allowance)?,
            elements,
        });
    }
    groups.shrink_to_fit();
    Ok(groups)
}

/// Which node was seen last in which round.
struct Marks {
    round: Vec<u32>,
    now: u32,
}

impl Marks {
    /// The nodes of these elements, sorted, each once.
    fn nodes(
        &mut self,
        elements: &[ElementId],
        blocks: &[ElementBlock],
        allowance: &mut Allowance,
    ) -> Result<Vec<usize>, MshError> {
        self.now += 2;
        let mut count = 0;
        let listed = || elements.iter().flat_map(|id| blocks[id.block].nodes_of(id.index));
        for &node in listed() {
            count += usize::from(self.round[node] != self.now);
            self.round[node] = self.now;
        }
        // a node takes half of what an element takes
        allowance.take(count / 2)?;
        let mut found = Vec::with_capacity(count);
        if count > self.round.len() / 16 {
            let marked = self.round.iter().enumerate();
            found.extend(marked.filter(|(_, round)| **round == self.now).map(|(node, _)| node));
        } else {
            for &node in listed() {
                if self.round[node] == self.now {
                    self.round[node] -= 1;
                    found.push(node);
                }
            }
            found.sort_unstable();
        }
        Ok(found)
    }
}

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
pub(in crate::fe::mesh) struct Allowance {
    pub(in crate::fe::mesh) file_bytes: usize,
    pub(in crate::fe::mesh) listed: u64,
}

impl Allowance {
    /// Bytes for every byte of the file. An element in a group takes 16 bytes and a volume element of a
    /// file about 100: twenty groups that all hold the whole mesh are within it.
    const FACTOR: u64 = 4;
    /// Bytes that any file may have.
    const FIXED: u64 = 1 << 15;
    /// What a group takes besides its list, with its name, in items of a list.
    const GROUP: usize = 10;
    /// What a membership takes, in items of a list.
    const MEMBERSHIP: usize = 8;

    /// Asks for room for so many more memberships.
    pub(super) fn take_memberships(&mut self, count: usize) -> Result<(), MshError> {
        self.take(Self::MEMBERSHIP.saturating_mul(count))
    }

    /// Asks for room to list so many more items.
    pub(in crate::fe::mesh) fn take(&mut self, items: usize) -> Result<(), MshError> {
        self.listed += items as u64;
        let bytes = self.listed.saturating_mul(size_of::<ElementId>() as u64);
        if bytes > Self::FIXED + Self::FACTOR * self.file_bytes as u64 {
            let file_bytes = self.file_bytes;
            return Err(MshError(format!(
                "the physical groups would take {bytes} bytes of memory or more, too many for a file of {file_bytes} bytes: expected each entity in a few groups"
            )));
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
