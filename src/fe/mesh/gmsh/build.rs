//! From what has been read to a [`Mesh`]: the physical groups.

use std::path::Path;

use super::MshError;
use super::membership::{Allowance, Membership};
use super::names::Name;
use super::nodes::NodeTable;
use crate::fe::mesh::{ElementBlock, ElementId, Mesh, MshFormat, PhysicalGroup};

/// What a file holds, checked.
pub(super) struct Content {
    pub(super) format: MshFormat,
    pub(super) nodes: NodeTable,
    pub(super) blocks: Vec<ElementBlock>,
    pub(super) memberships: Vec<Membership>,
    pub(super) names: Vec<Name>,
    pub(super) allowance: Allowance,
}

/// The mesh with its groups by dimension and tag: those that elements belong to and those that only
/// have a name.
pub(super) fn mesh(content: Content, path: &Path) -> Result<Mesh, MshError> {
    let Content { format, nodes, blocks, mut memberships, mut names, mut allowance } = content;
    drop(nodes.index);
    memberships.sort_unstable_by_key(|own| (own.key(), own.block));
    names.sort_unstable_by_key(|name| (name.dimension, name.tag));
    let mut marks = Marks::new(nodes.tags.len());
    let together = |a: &Membership, b: &Membership| a.key() == b.key();
    // those with and without elements, counted twice where they have a name too
    let count = names.len() + memberships.chunk_by(together).count();
    allowance.take(Allowance::GROUP.saturating_mul(count))?;
    let mut groups = Vec::with_capacity(count);
    let mut names = names.into_iter().peekable();
    let mut unnamed = memberships.chunk_by(together).peekable();
    loop {
        let name_key = names.peek().map(Name::key);
        let own_key = unnamed.peek().map(|own| own[0].key());
        let Some((dimension, tag)) = name_key.into_iter().chain(own_key).min() else {
            break;
        };
        let name = names.next_if(|name| name.key() == (dimension, tag));
        let own = unnamed.next_if(|own| own[0].key() == (dimension, tag));
        let own = own.unwrap_or_default();
        let elements = elements(own, &blocks, &mut allowance)?;
        groups.push(PhysicalGroup {
            name: name.map_or_else(|| tag.to_string(), |name| name.name),
            dimension,
            tag,
            nodes: marks.nodes(&elements, &blocks, &mut allowance)?,
            elements,
        });
    }
    groups.shrink_to_fit();
    Ok(Mesh { nodes: nodes.coordinates, node_tags: nodes.tags, blocks, groups, format, source: path.to_path_buf() })
}

fn elements(
    own: &[Membership],
    blocks: &[ElementBlock],
    allowance: &mut Allowance,
) -> Result<Vec<ElementId>, MshError> {
    let count = own.iter().map(|own| own.len(blocks)).sum();
    allowance.take(count)?;
    let mut elements = Vec::with_capacity(count);
    for own in own {
        elements.extend(own.elements(blocks));
    }
    Ok(elements)
}

/// Which node was seen last in which round.
struct Marks {
    round: Vec<u32>,
    now: u32,
}

impl Marks {
    fn new(nodes: usize) -> Self {
        Self { round: vec![0; nodes], now: 0 }
    }

    /// The nodes of these elements, sorted, each once.
    fn nodes(
        &mut self,
        elements: &[ElementId],
        blocks: &[ElementBlock],
        allowance: &mut Allowance,
    ) -> Result<Vec<usize>, MshError> {
        self.now += 2;
        let mut count = 0;
        visit(elements, blocks, |node| {
            count += usize::from(self.round[node] != self.now);
            self.round[node] = self.now;
        });
        // a node takes half of what an element takes
        allowance.take(count / 2)?;
        let mut found = Vec::with_capacity(count);
        if count > self.round.len() / 16 {
            let marked = self.round.iter().enumerate();
            found.extend(marked.filter(|(_, round)| **round == self.now).map(|(node, _)| node));
        } else {
            visit(elements, blocks, |node| {
                if self.round[node] == self.now {
                    self.round[node] -= 1;
                    found.push(node);
                }
            });
            found.sort_unstable();
        }
        Ok(found)
    }
}

fn visit(elements: &[ElementId], blocks: &[ElementBlock], mut each: impl FnMut(usize)) {
    for of_block in elements.chunk_by(|a, b| a.block == b.block) {
        let block = &blocks[of_block[0].block];
        for id in of_block {
            block.nodes_of(id.index).iter().for_each(|&node| each(node));
        }
    }
}
