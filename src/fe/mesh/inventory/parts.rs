//! Connected parts: which elements hang together through common nodes.

use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

use super::nodes::BoundingBox;
use crate::fe::mesh::Mesh;

/// Elements joined by common nodes, and joined to no others.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Part {
    /// Number of elements.
    pub elements: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Tag of its first node.
    pub node_tag: u64,
    /// Its extent.
    pub bounding_box: BoundingBox,
}

/// Sets of nodes or elements, each a tree that leads to its root (union-find with path halving).
pub(crate) struct Sets(Vec<u32>);

impl Sets {
    /// Each by itself; fewer than 2^32.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..).take(count).collect())
    }

    /// The lowest of the set.
    pub(crate) fn root(&mut self, mut node: usize) -> usize {
        while self.0[node] as usize != node {
            let above = self.0[node] as usize;
            self.0[node] = self.0[above];
            node = self.0[node] as usize;
        }
        node
    }

    /// Makes one set of two; its root is the lower of theirs.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}

/// Parts made of the elements of a dimension, largest first.
pub(super) fn parts(mesh: &Mesh, dimension: usize) -> Vec<Part> {
    let own = || mesh.blocks.iter().filter(|block| block.kind.dimension() == dimension);
    let mut sets = Sets::new(mesh.nodes.len());
    let mut used = vec![false; mesh.nodes.len()];
    for element in own().flat_map(|block| block.elements()) {
        for &node in element {
            used[node] = true;
            sets.join(element[0], node);
        }
    }
    // by their roots, which are their first nodes
    let mut parts: BTreeMap<usize, Part> = BTreeMap::new();
    for node in (0..mesh.nodes.len()).filter(|&node| used[node]) {
        let point = mesh.nodes[node];
        let part = parts.entry(sets.root(node)).or_insert_with(|| Part {
            elements: 0,
            nodes: 0,
            node_tag: mesh.node_tags[node],
            bounding_box: BoundingBox::of([point].into_iter()),
        });
        part.nodes += 1;
        part.bounding_box.add(point);
    }
    for element in own().flat_map(|block| block.elements()) {
        parts.entry(sets.root(element[0])).and_modify(|part| part.elements += 1);
    }
    let mut parts: Vec<Part> = parts.into_values().collect();
    parts.sort_by_key(|part| std::cmp::Reverse(part.elements));
    parts
}
