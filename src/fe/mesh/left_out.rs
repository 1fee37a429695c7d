//! Elements below the body that have no part in it: degenerate ones, and those on nodes that the body does not have.

use super::{Mesh, PhysicalGroup};

impl Mesh {
    /// The first surface element of a group that was left out.
    pub(crate) fn left_out_of(&self, group: &PhysicalGroup) -> Option<u64> {
        let on_entity = |entity| group.elements.iter().any(|id| self.blocks[id.block].entity.tag == entity);
        let own = self.left_out.iter().filter(|left| left.dimension == 2 && group.dimension == 2);
        let mut own = own.filter(|left| match left.physical {
            0 => on_entity(left.entity),
            physical => physical == group.tag || (group.tag == 0 && on_entity(left.entity)),
        });
        own.next().map(|left| left.tag)
    }

    /// What of the file was changed or left out, a sentence each.
    pub(crate) fn told(&self) -> Vec<String> {
        let mut found = self.notes.told.clone();
        let counted = |count: usize, one: &str, many: &str| match count {
            1 => format!("1 element {one}"),
            _ => format!("{count} elements {many}"),
        };
        if let Some(first) = self.left_out.first() {
            let told = counted(self.left_out.len(), "has a node twice and is", "have a node twice and are");
            found.push(format!("{told} left out (the first is element {})", first.tag));
        }
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
            found
                .push(format!("{told} left out (the first is element {})", self.blocks[first.block].tags[first.index]));
        }
        found
    }
}
