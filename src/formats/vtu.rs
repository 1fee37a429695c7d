//! VTK XML unstructured grids (`.vtu`), as ParaView and PyVista open them.
//!
//! The grid has the nodes that the given elements use, in the order of the mesh, and the elements in the given order.
//! Numbers are appended after the XML in base64 (little-endian, each array preceded by its length in bytes as UInt64):
//! every bit arrives, and the file stays well-formed XML. Source: VTK file formats, section "XML file formats", unstructured grid and appended data.
//!
//! Writes a grid: nodes, elements and fields.
//!
//! Numbers go straight from the mesh to the file. The crate `vtkio` 0.7.0-rc2 copies and encodes all of them in memory first:
//! 400 MiB for a file of 132 MiB.
//!
//! VTK's cell types and its node order.
//!
//! Source: VTK file formats, "The VTK user's guide" appendix, and the class pages of `vtkQuadraticTetra`,
//! `vtkQuadraticHexahedron`, `vtkQuadraticWedge`: corners first, then the middle nodes edge by edge. The corners and the
//! edges of triangles and quadrilaterals are numbered as by gmsh. Middle nodes of solids lie on the edges
//! - tetrahedron: (0,1) (1,2) (2,0) (0,3) (1,3) (2,3), the last two swapped against gmsh,
//! - hexahedron: (0,1) (1,2) (2,3) (3,0), (4,5) (5,6) (6,7) (7,4), (0,4) (1,5) (2,6) (3,7),
//! - wedge: (0,1) (1,2) (2,0), (3,4) (4,5) (5,3), (0,3) (1,4) (2,5).

use super::FormatError;
use crate::fe::mesh::{ElementId, ElementKind, Mesh};
use crate::files::{Fault, write_atomic};
use base64::engine::GeneralPurpose;
use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use std::fmt::Write as _;
use std::io;
use std::io::Write;
use std::path::Path;

/// Values of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FieldValues<'a> {
    /// One number each.
    Scalars(&'a [f64]),
    /// Three numbers each (x, y, z), such as a mode shape.
    Vectors(&'a [f64]),
    /// One whole number each, such as the number of a part.
    Integers(&'a [i64]),
}

/// A named field: on all nodes of the mesh, or on the elements that are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field<'a> {
    /// Name as ParaView shows it, unique among the fields of its place, without control characters.
    pub name: &'a str,
    /// Values; a vector has its three components together.
    pub values: FieldValues<'a>,
}

/// Nodes and elements that are written.
struct Grid<'a> {
    mesh: &'a Mesh,
    elements: Vec<(ElementKind, &'a [usize])>,
    /// Indices of the nodes used, sorted.
    nodes: Vec<usize>,
    /// For each node of the mesh its place in `nodes`.
    place: Vec<i64>,
}

impl<'a> Grid<'a> {
    fn new(mesh: &'a Mesh, ids: impl IntoIterator<Item = ElementId>) -> Result<Self, FormatError> {
        let mut elements = Vec::new();
        let mut place = vec![-1; mesh.nodes.len()];
        for id in ids {
            let block = mesh.blocks.get(id.block);
            let found = block.and_then(|block| Some((block.kind, block.element(id.index)?)));
            let (kind, nodes) = found.ok_or_else(|| FormatError::no_element(id))?;
            nodes.iter().for_each(|&node| place[node] = 0);
            elements.push((kind, nodes));
        }
        Fault::unless(!elements.is_empty(), "at least one element to write", "none")?;
        let nodes: Vec<usize> = (0..mesh.nodes.len()).filter(|&node| place[node] == 0).collect();
        (0..).zip(&nodes).for_each(|(new, &node)| place[node] = new);
        Ok(Self { mesh, elements, nodes, place })
    }

    /// Checks a place's fields.
    fn check(fields: &[Field], count: usize, what: &'static str) -> Result<(), FormatError> {
        for (index, field) in fields.iter().enumerate() {
            let name = field.name;
            let fits = !name.is_empty() && !name.chars().any(char::is_control);
            Fault::unless(fits, "a field's name without control characters", format_args!("{name:?}"))?;
            if fields[..index].iter().any(|other| other.name == name) {
                return Err(FormatError::Refused(format!("two fields are called \"{name}\"")));
            }
            let (expected, found) = (field.values.components() * count, field.values.len());
            if found != expected {
                return Err(FormatError::Refused(format!(
                    "field \"{name}\" takes {expected} values (a fixed number for each {what}), found {found}"
                )));
            }
        }
        Ok(())
    }
}

impl FieldValues<'_> {
    fn components(&self) -> usize {
        if matches!(self, Self::Vectors(_)) { 3 } else { 1 }
    }

    fn len(&self) -> usize {
        match self {
            Self::Vectors(values) | Self::Scalars(values) => values.len(),
            Self::Integers(values) => values.len(),
        }
    }

    fn type_name(&self) -> &'static str {
        if matches!(self, Self::Integers(_)) { "Int64" } else { "Float64" }
    }

    /// Writes the values of one node or element.
    fn write(&self, to: &mut impl Write, index: usize) -> io::Result<()> {
        match self {
            Self::Scalars(values) => to.write_all(&values[index].to_le_bytes()),
            Self::Integers(values) => to.write_all(&values[index].to_le_bytes()),
            Self::Vectors(values) => {
                values[3 * index..][..3].iter().try_for_each(|value| to.write_all(&value.to_le_bytes()))
            }
        }
    }
}

/// The XML text before the numbers, and where each array will begin.
struct Head {
    text: String,
    /// Characters of the arrays so far, with the lengths before them.
    offset: usize,
}

impl Head {
    fn array(&mut self, name: &str, type_name: &str, components: usize, bytes: usize) {
        // Writing to a String cannot fail.
        let _ = writeln!(
            self.text,
            "<DataArray type=\"{type_name}\" Name=\"{}\" NumberOfComponents=\"{components}\" format=\"appended\" \
             offset=\"{}\"/>",
            escaped(name),
            self.offset
        );
        self.offset += (8 + bytes).div_ceil(3) * 4;
    }

    fn fields(&mut self, tag: &str, fields: &[Field], count: usize) {
        let _ = writeln!(self.text, "<{tag}>");
        for field in fields {
            let components = field.values.components();
            let bytes = 8 * components * count;
            self.array(field.name, field.values.type_name(), components, bytes);
        }
        let _ = writeln!(self.text, "</{tag}>");
    }
}

/// Text as it may stand in an XML attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Writes elements of a mesh with fields, whole or not at all.
///
/// `point_fields` have a value for every node of the mesh (in its order); only those of nodes that the elements use are
/// written. `cell_fields` have a value for every element given, in the order given.
///
/// # Errors
/// [`FormatError`] for an element that the mesh does not have, none at all, fields of the wrong length or without a proper
/// name of their own, and when the file cannot be written.
pub fn write_vtu(
    path: &Path,
    mesh: &Mesh,
    elements: impl IntoIterator<Item = ElementId>,
    point_fields: &[Field],
    cell_fields: &[Field],
) -> Result<(), FormatError> {
    let grid = Grid::new(mesh, elements)?;
    Grid::check(point_fields, mesh.nodes.len(), "node of the mesh")?;
    Grid::check(cell_fields, grid.elements.len(), "element written")?;
    Ok(write_atomic(path, |to| write_grid(to, &grid, point_fields, cell_fields))?)
}

fn write_grid(to: &mut impl Write, grid: &Grid, point_fields: &[Field], cell_fields: &[Field]) -> io::Result<()> {
    let (points, cells) = (grid.nodes.len(), grid.elements.len());
    let corners: usize = grid.elements.iter().map(|&(kind, _)| node_order(kind).len()).sum();
    let mut head = Head {
        text: format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" \
             NumberOfCells=\"{cells}\">\n"
        ),
        offset: 0,
    };
    head.text += "<Points>\n";
    head.array("Points", "Float64", 3, 24 * points);
    head.text += "</Points>\n<Cells>\n";
    head.array("connectivity", "Int64", 1, 8 * corners);
    head.array("offsets", "Int64", 1, 8 * cells);
    head.array("types", "UInt8", 1, cells);
    head.text += "</Cells>\n";
    head.fields("PointData", point_fields, points);
    head.fields("CellData", cell_fields, cells);
    head.text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"base64\">\n_";
    to.write_all(head.text.as_bytes())?;

    array(to, 24 * points, |to| {
        let mut values = grid.nodes.iter().flat_map(|&node| grid.mesh.nodes[node]);
        values.try_for_each(|value| to.write_all(&value.to_le_bytes()))
    })?;
    array(to, 8 * corners, |to| {
        let elements = grid.elements.iter();
        let mut places = elements.flat_map(|&(kind, nodes)| node_order(kind).iter().map(|&own| grid.place[nodes[own]]));
        places.try_for_each(|place| to.write_all(&place.to_le_bytes()))
    })?;
    array(to, 8 * cells, |to| {
        let mut end = 0;
        grid.elements.iter().try_for_each(|&(kind, _)| {
            end += node_order(kind).len() as i64;
            to.write_all(&end.to_le_bytes())
        })
    })?;
    array(to, cells, |to| grid.elements.iter().try_for_each(|&(kind, _)| to.write_all(&[cell_type(kind)])))?;
    for Field { values, .. } in point_fields {
        array(to, 8 * values.components() * points, |to| {
            grid.nodes.iter().try_for_each(|&node| values.write(to, node))
        })?;
    }
    for Field { values, .. } in cell_fields {
        array(to, 8 * values.components() * cells, |to| (0..cells).try_for_each(|index| values.write(to, index)))?;
    }
    to.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}

/// Writes one array: its length in bytes and what `write` gives, encoded as one.
fn array<W: Write>(
    to: &mut W,
    bytes: usize,
    write: impl FnOnce(&mut EncoderWriter<GeneralPurpose, &mut W>) -> io::Result<()>,
) -> io::Result<()> {
    let mut encoder = EncoderWriter::new(to, &STANDARD);
    encoder.write_all(&(bytes as u64).to_le_bytes())?;
    write(&mut encoder)?;
    encoder.finish().map(|_| ())
}

const SAME: [usize; 9] = [0, 1, 2, 3, 4, 5, 6, 7, 8];
const TET10: [usize; 10] = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8];
const HEX27: [usize; 27] =
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26];
const WEDGE18: [usize; 18] = [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16];
const PYRAMID13: [usize; 13] = [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12];

/// VTK's number of a cell type (`vtkCellType.h`). It has no pyramid of 14 nodes: that of 13 leaves the centre of the base out.
pub(super) fn cell_type(kind: ElementKind) -> u8 {
    match kind {
        ElementKind::Point => 1,
        ElementKind::Line2 => 3,
        ElementKind::Line3 => 21,
        ElementKind::Tri3 => 5,
        ElementKind::Tri6 => 22,
        ElementKind::Quad4 => 9,
        ElementKind::Quad8 => 23,
        ElementKind::Quad9 => 28,
        ElementKind::Tet4 => 10,
        ElementKind::Tet10 => 24,
        ElementKind::Hex8 => 12,
        ElementKind::Hex20 => 25,
        ElementKind::Hex27 => 29,
        ElementKind::Wedge6 => 13,
        ElementKind::Wedge15 => 26,
        ElementKind::Wedge18 => 32,
        ElementKind::Pyramid5 => 14,
        ElementKind::Pyramid13 | ElementKind::Pyramid14 => 27,
    }
}

/// For each place of an element's node in VTK's order, its place in gmsh's. Face centres are in the order of `vtkTriQuadraticHexahedron.cxx`:
/// low and high x, then y, then z.
pub fn node_order(kind: ElementKind) -> &'static [usize] {
    match kind {
        ElementKind::Tet10 => &TET10,
        ElementKind::Hex20 | ElementKind::Hex27 => &HEX27[..kind.nodes()],
        ElementKind::Wedge15 | ElementKind::Wedge18 => &WEDGE18[..kind.nodes()],
        ElementKind::Pyramid13 | ElementKind::Pyramid14 => &PYRAMID13,
        other => &SAME[..other.nodes()],
    }
}

#[cfg(test)]
mod cell_tests {
    use super::*;

    const TRIANGLE: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];
    const QUADRILATERAL: [[usize; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];
    const TETRAHEDRON: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
    const HEXAHEDRON: [[usize; 2]; 12] =
        [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
    const WEDGE: [[usize; 2]; 9] = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
    const PYRAMID: [[usize; 2]; 8] = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]];
    /// Faces in the order of their centres, by two opposite corners.
    const HEXAHEDRON_CENTRES: [[usize; 2]; 7] = [[0, 7], [1, 6], [0, 5], [3, 6], [0, 2], [4, 6], [0, 6]];
    /// A kind, the edges of its middle nodes, the faces of its centres.
    type Case = (ElementKind, &'static [[usize; 2]], &'static [[usize; 2]]);

    const WEDGE_CENTRES: [[usize; 2]; 3] = [[0, 4], [1, 5], [2, 3]];

    #[allow(clippy::float_cmp)] // halves of small integers are exact
    #[test]
    fn middle_nodes_lie_between_the_corners_of_their_edge() {
        let kinds: [Case; 16] = [
            (ElementKind::Tri3, &[], &[]),
            (ElementKind::Tri6, &TRIANGLE, &[]),
            (ElementKind::Quad4, &[], &[]),
            (ElementKind::Quad8, &QUADRILATERAL, &[]),
            (ElementKind::Quad9, &QUADRILATERAL, &[[0, 2]]),
            (ElementKind::Tet4, &[], &[]),
            (ElementKind::Tet10, &TETRAHEDRON, &[]),
            (ElementKind::Hex8, &[], &[]),
            (ElementKind::Hex20, &HEXAHEDRON, &[]),
            (ElementKind::Hex27, &HEXAHEDRON, &HEXAHEDRON_CENTRES),
            (ElementKind::Wedge6, &[], &[]),
            (ElementKind::Wedge15, &WEDGE, &[]),
            (ElementKind::Wedge18, &WEDGE, &WEDGE_CENTRES),
            (ElementKind::Pyramid5, &[], &[]),
            (ElementKind::Pyramid13, &PYRAMID, &[]),
            (ElementKind::Pyramid14, &PYRAMID, &[]), // without its last node
        ];
        for (kind, edges, centres) in kinds {
            let place = |vtk: usize| kind.natural_nodes()[node_order(kind)[vtk]];
            let edges = [edges, centres].concat();
            let corners = node_order(kind).len() - edges.len();
            assert_eq!(node_order(kind)[..corners], SAME[..corners], "{kind:?}");
            for (index, &[from, to]) in edges.iter().enumerate() {
                let (found, from, to) = (place(corners + index), place(from), place(to));
                let expected = [0, 1, 2].map(|axis| (from[axis] + to[axis]) / 2.0);
                assert_eq!(found, expected, "{kind:?} edge {index}");
            }
        }
    }
}

#[cfg(test)]
mod tests;
