//! Elements that stand on the corners of another one, and elements of first order beside those of second order on the same
//! edges, which come apart between the corners.

use super::bodies::{Bodies, Solid, at, both, counted};
use crate::fe::mesh::{ElementKind, Mesh, PhysicalGroup};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Elements that stand on the corners of one before them: their mass and stiffness would count twice.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Doubled {
    /// How many, > 0.
    pub elements: usize,
    /// Tags of the first of them, in the order of the mesh, and of the element before it.
    pub tags: [u64; 2],
    /// Names of the parts of these two.
    pub parts: [String; 2],
    /// Mean of their corners, m.
    pub place: [f64; 3],
}

impl Doubled {
    /// What they are, in words.
    pub fn sentence(&self) -> String {
        let [first, second] = self.tags;
        format!(
            "{} on the corners of another element, the first are elements {first} and {second} of {} at {}",
            counted(self.elements, "element stands", "elements stand"),
            both(&self.parts),
            at(self.place)
        )
    }
}

/// No middle node of an edge. A mesh has fewer than 2^32 - 1 nodes, which the reader sees to.
const NO_NODE: u32 = u32::MAX;

/// Edges on which elements do not have the same middle node.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MixedOrders {
    /// How many, > 0.
    pub edges: usize,
    /// Tags of two elements with the first of these edges.
    pub tags: [u64; 2],
    /// Names of the parts of these two.
    pub parts: [String; 2],
    /// Centre of that edge, m.
    pub place: [f64; 3],
}

impl MixedOrders {
    /// What they are, in words.
    pub fn sentence(&self) -> String {
        let [first, second] = self.tags;
        format!(
            "{} without a middle node that all elements there have in common, the first is that of elements {first} and {second} of {} at {}",
            counted(self.edges, "edge is", "edges are"),
            both(&self.parts),
            at(self.place)
        )
    }
}

/// Edges of an element: the corners in order, and the middle node.
fn edges(kind: ElementKind, nodes: &[usize]) -> impl Iterator<Item = [u32; 3]> {
    (kind.corners()..).zip(kind.corner_edges()).map(|(middle, ends)| {
        let [a, b] = ends.map(|local| nodes[local] as u32);
        [a.min(b), a.max(b), nodes.get(middle).map_or(NO_NODE, |&node| node as u32)]
    })
}

impl Bodies<'_> {
    /// The elements on the corners of one before them; `None` if there are none. Order and kind do not matter: Hex8 and
    /// Hex20 on the same corners fill the same space.
    pub(crate) fn doubled(&self) -> Option<Doubled> {
        let solids = self.solids.par_iter().enumerate();
        let mut keys: Vec<([u32; 8], u32)> =
            solids.map(|(index, solid)| (solid.sorted_corners(), index as u32)).collect();
        keys.par_sort_unstable();
        let mut elements = 0;
        let mut first: Option<[u32; 2]> = None;
        for pair in keys.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            elements += 1;
            let pair = [pair[0].1, pair[1].1];
            if first.is_none_or(|first| pair[1] < first[1]) {
                first = Some(pair);
            }
        }
        let pair = first?.map(|index| &self.solids[index as usize]);
        Some(Doubled {
            elements,
            tags: pair.map(|solid| solid.tag),
            parts: self.names(pair.map(|solid| solid.part)),
            place: self.mean(pair[0].corners()),
        })
    }

    /// Mean of some nodes, m.
    pub(super) fn mean(&self, nodes: &[usize]) -> [f64; 3] {
        [0, 1, 2].map(|axis| {
            let sum: f64 = nodes.iter().map(|&node| self.points[node][axis]).sum();
            sum / nodes.len() as f64
        })
    }

    fn has_middle_nodes(&self) -> bool {
        self.solids.iter().any(|solid| solid.kind.order() == 2)
    }

    /// The edges on which elements do not have the same middle node; `None` if there are none.
    pub(crate) fn mixed_orders(&self) -> Option<MixedOrders> {
        if !self.has_middle_nodes() {
            return None;
        }
        let solids = self.solids.par_iter().enumerate();
        let mut all: Vec<([u32; 3], u32)> = solids
            .flat_map_iter(|(index, solid)| edges(solid.kind, solid.nodes).map(move |edge| (edge, index as u32)))
            .collect();
        all.par_sort_unstable();
        let apart = all.chunk_by(|a, b| a.0[..2] == b.0[..2]).filter(|same| same[0].0[2] != same[same.len() - 1].0[2]);
        let same = apart.clone().next()?;
        let pair = [same[0].1, same[same.len() - 1].1];
        let mut pair = pair.map(|index| &self.solids[index as usize]);
        pair.sort_unstable_by_key(|solid| solid.tag);
        Some(MixedOrders {
            edges: apart.count(),
            tags: pair.map(|solid| solid.tag),
            parts: self.names(pair.map(|solid| solid.part)),
            place: self.mean(&[same[0].0[0] as usize, same[0].0[1] as usize]),
        })
    }

    /// The edges of a group of curves or faces that lack the middle node of the elements there; the first tag is that of the
    /// group's element, and both parts are that of the other.
    pub(in crate::fe::model) fn without_middle_nodes(&self, mesh: &Mesh, group: &PhysicalGroup) -> Option<MixedOrders> {
        if !self.has_middle_nodes() {
            return None;
        }
        let mut of_group: BTreeMap<[u32; 2], (u32, u64)> = BTreeMap::new();
        for id in &group.elements {
            let block = &mesh.blocks[id.block];
            for [a, b, middle] in edges(block.kind, block.nodes_of(id.index)) {
                let entry = of_group.entry([a, b]).or_insert((middle, block.tags[id.index]));
                if middle == NO_NODE {
                    *entry = (middle, block.tags[id.index]);
                }
            }
        }
        let mut found: BTreeMap<[u32; 2], (u64, &Solid)> = BTreeMap::new();
        for solid in self.solids.iter().filter(|solid| solid.kind.order() == 2) {
            for [a, b, middle] in edges(solid.kind, solid.nodes) {
                if let Some(&(own, tag)) = of_group.get(&[a, b])
                    && own != middle
                {
                    found.entry([a, b]).or_insert((tag, solid));
                }
            }
        }
        let (ends, (tag, solid)) = found.first_key_value()?;
        Some(MixedOrders {
            edges: found.len(),
            tags: [*tag, solid.tag],
            parts: self.names([solid.part; 2]),
            place: self.mean(&ends.map(|node| node as usize)),
        })
    }
}
