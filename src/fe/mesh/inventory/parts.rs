//! Connected parts: which elements hang together through common nodes.
//!
//! Where the nodes are, nodes that no element uses, and nodes in the same place.

use crate::fe::mesh::Mesh;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

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

/// How many examples a list shows.
const EXAMPLES: usize = 5;

/// Smallest box with sides along the axes that holds all nodes, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct BoundingBox {
    /// Lower corner, m.
    pub min: [f64; 3],
    /// Upper corner, m.
    pub max: [f64; 3],
}

impl BoundingBox {
    /// Extent of the points; the origin if there are none.
    pub(crate) fn of(mut points: impl Iterator<Item = [f64; 3]>) -> Self {
        let first = points.next().unwrap_or_default();
        let mut found = Self { min: first, max: first };
        points.for_each(|point| found.add(point));
        found
    }

    /// Grows until it holds the point.
    pub(super) fn add(&mut self, point: [f64; 3]) {
        for (axis, value) in point.into_iter().enumerate() {
            self.min[axis] = self.min[axis].min(value);
            self.max[axis] = self.max[axis].max(value);
        }
    }

    /// Grown by `reach` (m) to all sides.
    pub(crate) fn grown(self, reach: f64) -> Self {
        Self { min: self.min.map(|x| x - reach), max: self.max.map(|x| x + reach) }
    }

    /// Length of the longest side, m, >= 0.
    pub(crate) fn longest_side(&self) -> f64 {
        self.extent().into_iter().fold(0.0, f64::max)
    }

    /// Lengths of the sides, m, >= 0.
    pub fn extent(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.max[axis] - self.min[axis])
    }

    /// Length of the diagonal, m, >= 0.
    pub(crate) fn diagonal(&self) -> f64 {
        let [x, y, z] = self.extent();
        x.hypot(y).hypot(z)
    }
}

/// Nodes that no element uses: harmless, but a sign of a mesh saved with `Mesh.SaveAll`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct UnusedNodes {
    /// How many.
    pub count: usize,
    /// Tags of the first five, in the order of the mesh.
    pub first_tags: Vec<u64>,
}

/// Nodes closer than a tolerance to one before them: parts that touch but are not joined, if not meant so.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DuplicateNodes {
    /// Distance below which nodes count as one, m.
    pub tolerance: f64,
    /// Number of nodes with an earlier one in the same place.
    pub count: usize,
    /// Tags of the first five pairs: the earlier node and the node.
    pub first_pairs: Vec<[u64; 2]>,
}

pub(super) fn unused(mesh: &Mesh) -> UnusedNodes {
    let mut used = vec![false; mesh.nodes.len()];
    for &node in mesh.blocks.iter().flat_map(|block| &block.connectivity) {
        used[node] = true;
    }
    let unused = || used.iter().zip(&mesh.node_tags).filter(|(used, _)| !**used);
    UnusedNodes { count: unused().count(), first_tags: unused().map(|(_, &tag)| tag).take(EXAMPLES).collect() }
}

/// Tolerance over the diagonal of the bounding box. gmsh writes 16 digits and places coincident
/// geometry within 1e-8 of its size (`Geometry.Tolerance`); a mesh of 1e7 elements still has edges of
/// 1e-3 of the diagonal: anything between the two tells them apart.
const TOLERANCE: f64 = 1e-7;

/// Nodes are put into cubes of twice the tolerance and sorted by cube; a node has its neighbours in its own
/// cube and in the up to seven that it is nearest to. O(n log n), unless a great many nodes crowd in one cube.
pub(super) fn duplicates(mesh: &Mesh, extent: &BoundingBox) -> DuplicateNodes {
    let tolerance = TOLERANCE * extent.diagonal();
    let side = 2.0 * tolerance;
    // in sides of a cube, below 1 / (2 * TOLERANCE)
    let position = |node: usize| {
        [0, 1, 2].map(|axis| {
            let from_origin = mesh.nodes[node][axis] - extent.min[axis];
            // all nodes in one point: a cube without side
            if side > 0.0 { from_origin / side } else { 0.0 }
        })
    };
    let nodes = 0..mesh.nodes.len();
    let cubes: BTreeSet<([u32; 3], usize)> =
        nodes.clone().map(|node| (position(node).map(|x| x as u32), node)).collect();
    let near = |a: usize, b: usize| {
        let [x, y, z] = [0, 1, 2].map(|axis| mesh.nodes[a][axis] - mesh.nodes[b][axis]);
        x.hypot(y).hypot(z) <= tolerance
    };
    let first_neighbour = |node: usize| {
        // its own cube, and that beyond the nearer wall, in each direction
        let choices = position(node).map(|x| {
            let own = x as u32;
            [own, if x.fract() < 0.5 { own.saturating_sub(1) } else { own + 1 }]
        });
        let earlier = (0..8_usize).filter_map(|choice| {
            let cube = [0, 1, 2].map(|axis| choices[axis][choice >> axis & 1]);
            cubes.range((cube, 0)..(cube, node)).map(|&(_, earlier)| earlier).find(|&earlier| near(earlier, node))
        });
        earlier.min()
    };
    let pairs: Vec<[usize; 2]> = nodes.filter_map(|node| Some([first_neighbour(node)?, node])).collect();
    let first_pairs = pairs.iter().take(EXAMPLES).map(|pair| pair.map(|node| mesh.node_tags[node]));
    DuplicateNodes { tolerance, count: pairs.len(), first_pairs: first_pairs.collect() }
}
