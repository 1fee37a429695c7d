//! Elements that MSH 2.2 repeats, once for every physical group of their entity.
//!
//! The repeats differ in number and group only (and in orientation, where the group holds the entity
//! reversed). Each must become one element of several groups: counted twice, it would be twice as stiff.

use super::elements_v22::{Listed, Piece};
use super::membership::Members;

/// Positions of the elements to keep (all if none are given), and the members of each group.
pub(super) type Merged = (Option<Vec<u32>>, Vec<(i32, Members)>);

/// Merges the elements of one kind on one entity that occur in several groups, given sorted.
pub(super) fn merge(listed: &Listed, pieces: &[Piece], physical: &[i32]) -> Merged {
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
    let mut found = Vec::new();
    for piece in pieces {
        let range = next..next + piece.count as u32;
        next = range.end;
        if piece.label.physical == physical {
            found.extend(range);
        }
    }
    found
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
    order.sort_unstable_by(|&a, &b| {
        let key = |element: u32| (physical[element as usize], element);
        set(a).cmp(set(b)).then(key(a).cmp(&key(b)))
    });
    // the first of the elements that each one is the same as
    let mut same_as: Vec<u32> = (0..physical.len() as u32).collect();
    for equal in order.chunk_by(|&a, &b| set(a) == set(b)) {
        let mut occurrences: Vec<u32> = Vec::new();
        for group in equal.chunk_by(|&a, &b| physical[a as usize] == physical[b as usize]) {
            for (occurrence, &element) in group.iter().enumerate() {
                match occurrences.get_mut(occurrence) {
                    Some(first) => *first = element.min(*first),
                    None => occurrences.push(element),
                }
            }
        }
        for group in equal.chunk_by(|&a, &b| physical[a as usize] == physical[b as usize]) {
            for (&element, &first) in group.iter().zip(&occurrences) {
                same_as[element as usize] = first;
            }
        }
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
