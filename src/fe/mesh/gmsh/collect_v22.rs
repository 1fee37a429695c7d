//! From the elements of MSH 2.2, listed one by one, to blocks and groups.
//!
//! Blocks come in the order that gmsh gives them in MSH 4.1: by dimension, entity, type.

use super::MshError;
use super::elements_v22::{Label, Listed, Piece, Run};
use super::membership::{Allowance, Members, Membership};
use super::repeated;
use crate::fe::mesh::{ElementBlock, Entity};

pub(super) fn blocks(
    mut listed: Listed,
    allowance: &mut Allowance,
) -> Result<(Vec<ElementBlock>, Vec<Membership>), MshError> {
    let mut pieces = pieces(std::mem::take(&mut listed.runs));
    pieces.sort_unstable_by_key(Piece::order);
    let together = |a: &Piece, b: &Piece| (a.label.kind, a.label.entity) == (b.label.kind, b.label.entity);
    let (mut count, mut membership_count) = (0, 0);
    for pieces in pieces.chunk_by(together) {
        let named = groups(pieces).into_iter().filter(|&tag| tag > 0).count();
        allowance.take_memberships(named)?;
        count += 1;
        membership_count += named;
    }
    let mut blocks = Vec::with_capacity(count);
    let mut memberships = Vec::with_capacity(membership_count);
    for pieces in pieces.chunk_by(together) {
        let physical = groups(pieces);
        let block = blocks.len();
        let (kept, members) = match physical.as_slice() {
            &[single] => (None, vec![(single, Members::All)]),
            several => repeated::merge(&listed, pieces, several),
        };
        blocks.push(self::block(&listed, pieces, kept.as_deref()));
        let named = members.into_iter().filter(|(physical, _)| *physical > 0);
        memberships.extend(named.map(|(physical, members)| Membership {
            dimension: pieces[0].label.kind.dimension(),
            physical,
            block,
            members,
        }));
    }
    Ok((blocks, memberships))
}

/// Groups of some pieces, sorted, each once.
fn groups(pieces: &[Piece]) -> Vec<i32> {
    let mut physical: Vec<i32> = pieces.iter().map(|piece| piece.label.physical).collect();
    physical.sort_unstable();
    physical.dedup();
    physical
}

fn pieces(runs: Vec<Run>) -> Vec<Piece> {
    let (mut first, mut first_node) = (0, 0);
    let place = |Run { label, count }| {
        let count = count as usize;
        let piece = Piece { label, first, first_node, count };
        first += count;
        first_node += count * label.kind.nodes();
        piece
    };
    runs.into_iter().map(place).collect()
}

/// The pieces as one block: all elements, or those kept, given by their position in the pieces.
fn block(listed: &Listed, pieces: &[Piece], kept: Option<&[u32]>) -> ElementBlock {
    let Label { kind, entity, .. } = pieces[0].label;
    let all = pieces.iter().map(|piece| piece.count).sum();
    let count = kept.map_or(all, <[u32]>::len);
    let mut block = ElementBlock {
        kind,
        tags: Vec::with_capacity(count),
        connectivity: Vec::with_capacity(count * kind.nodes()),
        entity: Entity { dimension: kind.dimension(), tag: entity },
    };
    let (mut position, mut kept) = (0, kept.map(|kept| kept.iter().copied().peekable()));
    for piece in pieces {
        let tags = &listed.tags[piece.first..piece.first + piece.count];
        for (tag, nodes) in tags.iter().zip(piece.nodes(listed).chunks_exact(kind.nodes())) {
            let keep = kept.as_mut().is_none_or(|kept| kept.next_if_eq(&position).is_some());
            if keep {
                block.tags.push(*tag);
                block.connectivity.extend(nodes.iter().map(|&node| node as usize));
            }
            position += 1;
        }
    }
    block
}
