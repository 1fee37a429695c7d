//! Element kinds: what gmsh calls them and what they are made of.

use schemars::JsonSchema;
use serde::Serialize;

/// Kind of a mesh element. Nodes are in gmsh's order.
///
/// A further kind is a variant here and a row in the table of this file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, JsonSchema)]
pub enum ElementKind {
    /// One node.
    Point,
    /// Straight line, two nodes.
    Line2,
    /// Second-order line: two ends, middle.
    Line3,
    /// Triangle, three nodes.
    Tri3,
    /// Second-order triangle: three corners, three edge middles.
    Tri6,
    /// Quadrilateral, four nodes.
    Quad4,
    /// Second-order quadrilateral without a centre node: four corners, four edge middles.
    Quad8,
    /// Second-order quadrilateral: four corners, four edge middles, centre.
    Quad9,
    /// Tetrahedron, four nodes.
    Tet4,
    /// Second-order tetrahedron: four corners, six edge middles.
    Tet10,
    /// Hexahedron, eight nodes.
    Hex8,
    /// Second-order hexahedron without nodes on faces and inside: eight corners, twelve edge middles.
    Hex20,
    /// Second-order hexahedron: eight corners, twelve edge middles, six face centres, centre.
    Hex27,
    /// Wedge, six nodes; gmsh's word is prism.
    Wedge6,
    /// Second-order wedge without nodes on faces: six corners, nine edge middles; gmsh's word is prism.
    Wedge15,
    /// Second-order wedge: six corners, nine edge middles, three centres of the quadrilateral faces.
    Wedge18,
    /// Pyramid, five nodes: the quadrilateral base, then the apex.
    Pyramid5,
    /// Second-order pyramid without a node on its base: five corners, eight edge middles.
    Pyramid13,
    /// Second-order pyramid: five corners, eight edge middles, centre of the base.
    Pyramid14,
}

/// One row of the table: gmsh's element type number, name, dimension, order, nodes, corners.
struct Row {
    kind: ElementKind,
    gmsh_type: i32,
    name: &'static str,
    dimension: usize,
    order: usize,
    nodes: usize,
    corners: usize,
}

const fn row(kind: ElementKind, gmsh_type: i32, name: &'static str, numbers: [usize; 4]) -> Row {
    let [dimension, order, nodes, corners] = numbers;
    Row { kind, gmsh_type, name, dimension, order, nodes, corners }
}

/// Source: gmsh reference manual, section "MSH file format", element types. In the order of the enum.
static TABLE: [Row; ElementKind::COUNT] = [
    row(ElementKind::Point, 15, "Point", [0, 1, 1, 1]),
    row(ElementKind::Line2, 1, "Line2", [1, 1, 2, 2]),
    row(ElementKind::Line3, 8, "Line3", [1, 2, 3, 2]),
    row(ElementKind::Tri3, 2, "Tri3", [2, 1, 3, 3]),
    row(ElementKind::Tri6, 9, "Tri6", [2, 2, 6, 3]),
    row(ElementKind::Quad4, 3, "Quad4", [2, 1, 4, 4]),
    row(ElementKind::Quad8, 16, "Quad8", [2, 2, 8, 4]),
    row(ElementKind::Quad9, 10, "Quad9", [2, 2, 9, 4]),
    row(ElementKind::Tet4, 4, "Tet4", [3, 1, 4, 4]),
    row(ElementKind::Tet10, 11, "Tet10", [3, 2, 10, 4]),
    row(ElementKind::Hex8, 5, "Hex8", [3, 1, 8, 8]),
    row(ElementKind::Hex20, 17, "Hex20", [3, 2, 20, 8]),
    row(ElementKind::Hex27, 12, "Hex27", [3, 2, 27, 8]),
    row(ElementKind::Wedge6, 6, "Wedge6", [3, 1, 6, 6]),
    row(ElementKind::Wedge15, 18, "Wedge15", [3, 2, 15, 6]),
    row(ElementKind::Wedge18, 13, "Wedge18", [3, 2, 18, 6]),
    row(ElementKind::Pyramid5, 7, "Pyramid5", [3, 1, 5, 5]),
    row(ElementKind::Pyramid13, 19, "Pyramid13", [3, 2, 13, 5]),
    row(ElementKind::Pyramid14, 14, "Pyramid14", [3, 2, 14, 5]),
];

impl ElementKind {
    /// Number of kinds.
    pub(crate) const COUNT: usize = 19;

    const fn row(self) -> &'static Row {
        &TABLE[self as usize]
    }

    /// Every kind, in the order of the enum.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|row| row.kind)
    }

    /// The kind with gmsh's element type number, if the program knows it.
    pub fn from_gmsh_type(gmsh_type: i32) -> Option<Self> {
        TABLE.iter().find(|row| row.gmsh_type == gmsh_type).map(|row| row.kind)
    }

    /// gmsh's element type number.
    pub fn gmsh_type(self) -> i32 {
        self.row().gmsh_type
    }

    /// Name as in reports and errors.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// 0 point, 1 line, 2 surface, 3 volume.
    pub const fn dimension(self) -> usize {
        self.row().dimension
    }

    /// 1 linear, 2 quadratic.
    pub const fn order(self) -> usize {
        self.row().order
    }

    /// Number of nodes.
    pub const fn nodes(self) -> usize {
        self.row().nodes
    }

    /// Number of corner nodes; they come first.
    pub const fn corners(self) -> usize {
        self.row().corners
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_follows_the_enum_and_gmsh_numbers_read_back() {
        for (position, kind) in ElementKind::all().enumerate() {
            assert_eq!(kind as usize, position, "{kind:?}");
            assert_eq!(ElementKind::from_gmsh_type(kind.gmsh_type()), Some(kind));
            assert_eq!(kind.name(), format!("{kind:?}"));
        }
        assert_eq!(ElementKind::from_gmsh_type(21), None);
    }
}
