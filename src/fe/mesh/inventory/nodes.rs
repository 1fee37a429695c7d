//! Where the nodes are, nodes that no element uses, and nodes in the same place.

use schemars::JsonSchema;
use serde::Serialize;

use crate::fe::mesh::Mesh;

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
    let cubes = Cubes::new(mesh, extent, 2.0 * tolerance);
    let mut count = 0;
    let mut first_pairs = Vec::new();
    for node in 0..mesh.nodes.len() {
        if let Some(earlier) = cubes.earlier_neighbour(node, tolerance) {
            count += 1;
            if first_pairs.len() < EXAMPLES {
                first_pairs.push([earlier, node].map(|node| mesh.node_tags[node]));
            }
        }
    }
    DuplicateNodes { tolerance, count, first_pairs }
}

/// Nodes by the cube that they are in.
struct Cubes<'a> {
    mesh: &'a Mesh,
    origin: [f64; 3],
    side: f64,
    /// Cube and node, sorted.
    sorted: Vec<([u32; 3], u32)>,
}

impl<'a> Cubes<'a> {
    fn new(mesh: &'a Mesh, extent: &BoundingBox, side: f64) -> Self {
        let mut cubes = Self { mesh, origin: extent.min, side, sorted: Vec::new() };
        let nodes = (0..).zip(&mesh.nodes);
        cubes.sorted = nodes.map(|(node, &point)| (cubes.position(point).map(|x| x as u32), node)).collect();
        cubes.sorted.sort_unstable();
        cubes
    }

    /// Coordinates in sides of a cube, below 1 / (2 * TOLERANCE).
    fn position(&self, point: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| {
            let from_origin = point[axis] - self.origin[axis];
            // all nodes in one point: a cube without side
            if self.side > 0.0 { from_origin / self.side } else { 0.0 }
        })
    }

    /// The first node before this one that is within the tolerance.
    fn earlier_neighbour(&self, node: usize, tolerance: f64) -> Option<usize> {
        let point = self.mesh.nodes[node];
        let position = self.position(point);
        let own = position.map(|x| x as u32);
        // the cubes beyond the nearer wall in each direction
        let beside = [0, 1, 2]
            .map(|axis| if position[axis].fract() < 0.5 { own[axis].saturating_sub(1) } else { own[axis] + 1 });
        let corner = |choice: usize, axis: usize| {
            if choice >> axis & 1 == 0 { own[axis] } else { beside[axis] }
        };
        (0..8)
            .map(|choice| [0, 1, 2].map(|axis| corner(choice, axis)))
            .filter_map(|cube| self.first_in(cube, node, point, tolerance))
            .min()
    }

    fn first_in(&self, cube: [u32; 3], node: usize, point: [f64; 3], tolerance: f64) -> Option<usize> {
        let start = self.sorted.partition_point(|(other, _)| *other < cube);
        let earlier =
            self.sorted[start..].iter().take_while(|(other, earlier)| *other == cube && (*earlier as usize) < node);
        let mut earlier = earlier.map(|(_, earlier)| *earlier as usize);
        earlier.find(|&earlier| {
            let other = self.mesh.nodes[earlier];
            let [x, y, z] = [0, 1, 2].map(|axis| point[axis] - other[axis]);
            x.hypot(y).hypot(z) <= tolerance
        })
    }
}
