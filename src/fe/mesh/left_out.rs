//! Elements below the body that have no part in it: degenerate ones, and those on nodes that the body does not have.

use super::{Mesh, MeshNote, PhysicalGroup};
use serde::{Serialize, Serializer};
use std::fmt;

impl fmt::Display for MeshNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sentence(sentence) => f.write_str(sentence),
            Self::NodeTwice(list) => {
                let told = counted(list.len(), "has a node twice and is", "have a node twice and are");
                write!(f, "{told} left out (the first is element {})", list.first().map_or(0, |left| left.tag))
            }
        }
    }
}

impl Serialize for MeshNote {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

fn counted(count: usize, one: &str, many: &str) -> String {
    match count {
        1 => format!("1 element {one}"),
        _ => format!("{count} elements {many}"),
    }
}

impl Mesh {
    /// The first surface element of a group that was left out.
    pub(crate) fn left_out_of(&self, group: &PhysicalGroup) -> Option<u64> {
        let on_entity = |entity| group.elements.iter().any(|id| self.blocks[id.block].entity.tag == entity);
        let left_out = self.notes.told.iter().flat_map(|note| match note {
            MeshNote::NodeTwice(list) => list.as_slice(),
            MeshNote::Sentence(_) => &[],
        });
        let own = left_out.filter(|left| left.dimension == 2 && group.dimension == 2);
        let mut own = own.filter(|left| match left.physical {
            0 => on_entity(left.entity),
            physical => physical == group.tag || (group.tag == 0 && on_entity(left.entity)),
        });
        own.next().map(|left| left.tag)
    }

    /// Tells of elements below the body on nodes that it does not have.
    pub(super) fn tell_what_is_beside(&mut self) {
        let dimension = self.dimension();
        let of_body = self.blocks.iter().filter(|block| block.kind.dimension() == dimension);
        let mut used = vec![false; self.nodes.len()];
        of_body.flat_map(|block| &block.connectivity).for_each(|&node| used[node] = true);
        let beside = (0..dimension).flat_map(|below| self.element_ids(below));
        let mut beside = beside.filter(|id| self.blocks[id.block].nodes_of(id.index).iter().any(|&node| !used[node]));
        if let Some(first) = beside.next() {
            let what = ["", "surface", "volume"][dimension.clamp(1, 3) - 1];
            let rest = format!("on nodes that no {what} element has and");
            let told = counted(1 + beside.count(), &format!("is {rest} is"), &format!("are {rest} are"));
            let first = self.blocks[first.block].tags[first.index];
            self.notes.told.push(MeshNote::Sentence(format!("{told} left out (the first is element {first})")));
        }
    }
}
