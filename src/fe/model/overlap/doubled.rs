//! Elements that stand on the corners of another one, and elements of first order beside those of second order on the same
//! edges, which come apart between the corners, and elements with a centre node beside those without on the same face.

use super::bodies::{Bodies, at, both, counted};
use crate::fe::mesh::{ElementKind, sorted_corners};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

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
    /// What they are, in words; `unit` is that of lengths.
    pub fn sentence(&self, unit: &str) -> String {
        let [first, second] = self.tags;
        format!(
            "{} on the corners of another element, the first are elements {first} and {second} of {} at {}",
            counted(self.elements, "element stands", "elements stand"),
            both(&self.parts),
            at(self.place, unit)
        )
    }
}

/// No middle node of an edge. A mesh has fewer than 2^32 - 1 nodes, which the reader sees to.
pub(super) const NO_NODE: u32 = u32::MAX;

/// Edges on which elements do not have the same middle node, or else faces on which they do not have the same centre node.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MixedOrders {
    /// How many edges.
    pub edges: usize,
    /// How many faces, > 0 if there are no such edges.
    pub faces: usize,
    /// Tags of two elements with the first of them.
    pub tags: [u64; 2],
    /// Names of the parts of these two.
    pub parts: [String; 2],
    /// Mean of its corners, m.
    pub place: [f64; 3],
}

impl MixedOrders {
    /// What they are, in words; `unit` is that of lengths.
    pub fn sentence(&self, unit: &str) -> String {
        let [first, second] = self.tags;
        let what = match self.edges {
            0 => counted(self.faces, "face is without a centre", "faces are without a centre"),
            edges => counted(edges, "edge is without a middle", "edges are without a middle"),
        };
        format!(
            "{what} node that all elements there have in common, the first is that of elements {first} and {second} of {} at {}",
            both(&self.parts),
            at(self.place, unit)
        )
    }
}

/// Edges of an element: the corners in order, and the middle node.
pub(super) fn edges(kind: ElementKind, nodes: &[usize]) -> impl Iterator<Item = [u32; 3]> {
    (kind.corners()..).zip(kind.corner_edges()).map(|(middle, ends)| {
        let [a, b] = ends.map(|local| nodes[local] as u32);
        [a.min(b), a.max(b), nodes.get(middle).map_or(NO_NODE, |&node| node as u32)]
    })
}

/// Quadrilateral faces of a solid: the corners in order, and the centre node.
pub(super) fn faces(kind: ElementKind, nodes: &[usize]) -> impl Iterator<Item = [u32; 5]> {
    let of_solid = if kind.dimension() == 3 { kind.faces() } else { &[] };
    of_solid
        .iter()
        .filter(|face| face.kind.corners() == 4)
        .map(|face| quadrilateral(|local| face.nodes.get(local).map(|&local| nodes[local])))
}

/// The corners in order of a quadrilateral of these nodes, and its centre node.
pub(super) fn quadrilateral(node: impl Fn(usize) -> Option<usize>) -> [u32; 5] {
    let [a, b, c, d] = sorted_corners((0..4).filter_map(&node));
    [a, b, c, d, node(8).map_or(NO_NODE, |centre| centre as u32)]
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

    /// The edges on which elements do not have the same middle node, or else the faces with different centres; `None` if
    /// there are none.
    pub(crate) fn mixed_orders(&self) -> Option<MixedOrders> {
        if !self.has_middle_nodes() {
            return None;
        }
        let mixed = |[edges, faces]: [usize; 2], pair: [u32; 2], corners: &[u32]| {
            let mut pair = pair.map(|index| &self.solids[index as usize]);
            pair.sort_unstable_by_key(|solid| solid.tag);
            let corners: Vec<usize> = corners.iter().map(|&node| node as usize).collect();
            let (tags, parts) = (pair.map(|solid| solid.tag), self.names(pair.map(|solid| solid.part)));
            MixedOrders { edges, faces, tags, parts, place: self.mean(&corners) }
        };
        if let Some((count, place, pair)) = self.differing(edges) {
            return Some(mixed([count, 0], pair, &place[..2]));
        }
        if self.solids.iter().all(|solid| solid.kind.centres().is_empty()) {
            return None;
        }
        self.differing(faces).map(|(count, place, pair)| mixed([0, count], pair, &place[..4]))
    }

    /// The edges or faces, given by their corners and the node between these, on which elements have different nodes: how
    /// many, the first, and two elements with it.
    fn differing<'s, const N: usize, I: Iterator<Item = [u32; N]> + 's>(
        &'s self,
        of_solid: impl Fn(ElementKind, &'s [usize]) -> I + Sync,
    ) -> Option<(usize, [u32; N], [u32; 2])> {
        let solids = self.solids.par_iter().enumerate();
        let mut all: Vec<([u32; N], u32)> = solids
            .flat_map_iter(|(index, solid)| of_solid(solid.kind, solid.nodes).map(move |edge| (edge, index as u32)))
            .collect();
        all.par_sort_unstable();
        let apart = all
            .chunk_by(|a, b| a.0[..N - 1] == b.0[..N - 1])
            .filter(|same| same[0].0[N - 1] != same[same.len() - 1].0[N - 1]);
        let same = apart.clone().next()?;
        Some((apart.count(), same[0].0, [same[0].1, same[same.len() - 1].1]))
    }
}
