//! What a mesh contains, for reports and for a look before computing.

use super::{ElementKind, Mesh};

/// Smallest box with sides along the axes that holds all nodes, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingBox {
    /// Lower corner, m.
    pub min: [f64; 3],
    /// Upper corner, m.
    pub max: [f64; 3],
}

/// How many elements of a kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct KindCount {
    /// The kind.
    pub kind: ElementKind,
    /// Elements of it, > 0.
    pub count: usize,
}

/// A physical group in numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GroupSummary {
    /// Name, or the tag in digits.
    pub name: String,
    /// 0 points, 1 curves, 2 surfaces, 3 volumes.
    pub dimension: usize,
    /// gmsh's tag.
    pub tag: i32,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of elements.
    pub elements: usize,
}

/// Contents of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Inventory {
    /// Number of nodes.
    pub nodes: usize,
    /// Nodes that no element uses: harmless, but a sign of a mesh saved with `Mesh.SaveAll`.
    pub unused_nodes: usize,
    /// Extent of the nodes.
    pub bounding_box: BoundingBox,
    /// Elements by kind, in the order of [`ElementKind`], kinds that occur only.
    pub elements: Vec<KindCount>,
    /// Physical groups in the order of the mesh.
    pub groups: Vec<GroupSummary>,
}

impl BoundingBox {
    /// Lengths of the sides, m, >= 0.
    pub fn extent(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.max[axis] - self.min[axis])
    }
}

impl Mesh {
    /// Counts and extent of this mesh.
    pub fn inventory(&self) -> Inventory {
        let mut used = vec![false; self.nodes.len()];
        for &node in self.blocks.iter().flat_map(|block| &block.connectivity) {
            used[node] = true;
        }
        let count = |kind: ElementKind| {
            let blocks = self.blocks.iter().filter(|block| block.kind == kind);
            blocks.map(|block| block.len()).sum::<usize>()
        };
        Inventory {
            nodes: self.nodes.len(),
            unused_nodes: used.iter().filter(|&&used| !used).count(),
            bounding_box: bounding_box(&self.nodes),
            elements: ElementKind::all()
                .map(|kind| KindCount {
                    kind,
                    count: count(kind),
                })
                .filter(|entry| entry.count > 0)
                .collect(),
            groups: self
                .groups
                .iter()
                .map(|group| GroupSummary {
                    name: group.name.clone(),
                    dimension: group.dimension,
                    tag: group.tag,
                    nodes: group.nodes.len(),
                    elements: group.elements.len(),
                })
                .collect(),
        }
    }
}

/// Extent of the points; the origin if there are none.
fn bounding_box(points: &[[f64; 3]]) -> BoundingBox {
    let first = points.first().copied().unwrap_or_default();
    let mut found = BoundingBox {
        min: first,
        max: first,
    };
    for point in points {
        for (axis, &value) in point.iter().enumerate() {
            found.min[axis] = found.min[axis].min(value);
            found.max[axis] = found.max[axis].max(value);
        }
    }
    found
}
