//! From the elements of MSH 2.2, listed one by one, to blocks and groups.
//!
//! Blocks come in the order that gmsh gives them in MSH 4.1: by dimension, entity, type.
//!
//! Elements that MSH 2.2 repeats, once for every physical group of their entity,
//! differ in number and group only (and in orientation, where the group holds the entity
//! reversed). Each must become one element of several groups: counted twice, it would be twice as stiff.

use super::MshError;
use super::build::{Allowance, Members, Membership};
use super::elements::{Label, Listed, Piece};
use crate::fe::mesh::{ElementBlock, Entity};
use std::collections::BTreeSet;

pub(super) fn blocks(
    mut listed: Listed,
    allowance: &mut Allowance,
) -> Result<(Vec<ElementBlock>, Vec<Membership>), MshError> {
    let mut pieces = std::mem::take(&mut listed.pieces);
    pieces.shrink_to_fit();
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
            several => merge(&listed, pieces, several),
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
    let physical: BTreeSet<i32> = pieces.iter().map(|piece| piece.label.physical).collect();
    physical.into_iter().collect()
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

/// Positions of the elements to keep (all if none are given), and the members of each group.
type Merged = (Option<Vec<u32>>, Vec<(i32, Members)>);

/// Merges the elements of one kind on one entity that occur in several groups, given sorted.
fn merge(listed: &Listed, pieces: &[Piece], physical: &[i32]) -> Merged {
    let nodes_of = |tag: i32| {
        let own = pieces.iter().filter(move |piece| piece.label.physical == tag);
        own.flat_map(|piece| piece.nodes(listed))
    };
    let first = pieces[0].label.physical;
    // what gmsh writes: the same list for every group
    if physical.len() <= SEVERAL && physical.iter().all(|&tag| nodes_of(tag).eq(nodes_of(first))) {
        let members = physical.iter().map(|&tag| (tag, Members::All)).collect();
        return (Some(positions(pieces, first)), members);
    }
    one_by_one(listed, pieces)
}

/// Beyond this many groups the lists are not compared one with another, which takes a pass for each.
const SEVERAL: usize = 64;

/// Positions of the elements of one group.
fn positions(pieces: &[Piece], physical: i32) -> Vec<u32> {
    let mut next = 0;
    let own = pieces.iter().flat_map(|piece| {
        let first = next;
        next += piece.count as u32;
        if piece.label.physical == physical { first..next } else { 0..0 }
    });
    own.collect()
}

/// Any mixture of groups: elements on the same set of nodes are one. If a group itself holds several
/// of them, they stay several, and the n-th of one group is the n-th of another.
fn one_by_one(listed: &Listed, pieces: &[Piece]) -> Merged {
    let node_count = pieces[0].label.kind.nodes();
    let mut sets: Vec<u32> = Vec::with_capacity(node_count * pieces.iter().map(|piece| piece.count).sum::<usize>());
    let mut physical = Vec::with_capacity(sets.capacity() / node_count);
    for piece in pieces {
        sets.extend_from_slice(piece.nodes(listed));
        physical.extend(std::iter::repeat_n(piece.label.physical, piece.count));
    }
    sets.chunks_exact_mut(node_count).for_each(<[u32]>::sort_unstable);
    let set = |element: u32| &sets[element as usize * node_count..][..node_count];
    let mut order: Vec<u32> = (0..physical.len() as u32).collect();
    let in_group = |element: u32| (set(element), physical[element as usize]);
    order.sort_unstable_by(|&a, &b| in_group(a).cmp(&in_group(b)).then(a.cmp(&b)));
    // how many of its group stand on the same nodes before it
    let mut occurrences = vec![0_u32; physical.len()];
    for group in order.chunk_by(|&a, &b| in_group(a) == in_group(b)) {
        (0..).zip(group).for_each(|(occurrence, &element)| occurrences[element as usize] = occurrence);
    }
    let place = |element: u32| (set(element), occurrences[element as usize]);
    order.sort_unstable_by(|&a, &b| place(a).cmp(&place(b)).then(a.cmp(&b)));
    // the first of the elements that each one is the same as
    let mut same_as = vec![0_u32; physical.len()];
    for same in order.chunk_by(|&a, &b| place(a) == place(b)) {
        same.iter().for_each(|&element| same_as[element as usize] = same[0]);
    }
    let kept: Vec<u32> = (0..physical.len() as u32).filter(|&element| same_as[element as usize] == element).collect();
    drop(sets);
    let index = |first: u32| kept.partition_point(|&kept| kept < first) as u32;
    let pairs = physical.iter().zip(same_as);
    let mut pairs: Vec<(i32, u32)> = pairs.map(|(&tag, first)| (tag, index(first))).collect();
    pairs.sort_unstable();
    let groups = pairs.chunk_by(|a, b| a.0 == b.0);
    let members = groups.map(|group| {
        let list = group.iter().map(|&(_, index)| index).collect();
        (group[0].0, Members::Some(list))
    });
    let members = members.collect();
    (Some(kept), members)
}
