//! Meshes that Python has in memory, or that a file holds.

use crate::{arrays, errors};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use plummer::fe::mesh::{
    Cells, ElementBlock, ElementKind, Entity, EntityGroup, Mesh as Library, MeshError, MeshParts, MshError,
};
use plummer::formats::vtu;
use plummer::prelude::LengthUnit;
use pyo3::prelude::*;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Dimension and tag of an entity; type of its elements; their tags; tags of their nodes.
type GivenBlock<'py> = (usize, i32, i32, PyReadonlyArray1<'py, u64>, PyReadonlyArray1<'py, u64>);
/// Dimension, tag, name and entities.
type GivenGroup = (usize, i32, String, Vec<i32>);
/// Type; nodes of each element; groups with their elements.
type GivenCells<'py> = (i32, PyReadonlyArray1<'py, i64>, Vec<(String, Vec<usize>)>);

/// A mesh: what its file holds or would hold, read once.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Mesh {
    pub(crate) content: Arc<[u8]>,
    mesh: Library,
}

impl Mesh {
    fn of(py: Python<'_>, content: Vec<u8>, name: &Path) -> PyResult<Self> {
        // the case says the unit; here coordinates stay as they are
        let mesh = py.detach(|| Library::from_bytes(&content, name, LengthUnit::Metre));
        Ok(Self { mesh: mesh.map_err(|error| errors::of(py, error))?, content: content.into() })
    }

    /// The mesh of a content that was read before.
    pub(crate) fn again(py: Python<'_>, content: &Arc<[u8]>, name: &str) -> PyResult<Self> {
        Self::of(py, content.to_vec(), name.as_ref())
    }

    fn of_parts(py: Python<'_>, parts: Result<MeshParts, MshError>, name: &Path) -> PyResult<Self> {
        let wrong = |fault| errors::of(py, MeshError::Gmsh { path: name.to_owned(), fault });
        let content = parts.and_then(|parts| parts.to_msh()).map_err(wrong)?;
        Self::of(py, content, name)
    }
}

/// A kind of elements by gmsh's number.
fn kind(gmsh_type: i32) -> Result<ElementKind, MshError> {
    ElementKind::from_gmsh_type(gmsh_type).ok_or_else(|| {
        let known: Vec<String> =
            ElementKind::all().map(|kind| format!("{} ({})", kind.gmsh_type(), kind.name())).collect();
        MshError(format!("elements of gmsh's type {gmsh_type}: expected one of {}", known.join(", ")))
    })
}

/// Number of nodes of an element of gmsh's type; for each place of a node in VTK's order its place in gmsh's.
#[pyfunction]
pub(crate) fn node_order(py: Python<'_>, gmsh_type: i32) -> PyResult<(usize, Vec<usize>)> {
    let wrong = |fault| errors::of(py, MeshError::Gmsh { path: PathBuf::from("cells"), fault });
    let kind = kind(gmsh_type).map_err(wrong)?;
    Ok((kind.nodes(), vtu::node_order(kind).to_vec()))
}

fn points(nodes: &PyReadonlyArray2<'_, f64>) -> Result<Vec<[f64; 3]>, MshError> {
    let nodes = nodes.as_array();
    match nodes.shape() {
        [_, 3] => Ok(nodes.rows().into_iter().map(|row| [row[0], row[1], row[2]]).collect()),
        [_, 2] => Ok(nodes.rows().into_iter().map(|row| [row[0], row[1], 0.0]).collect()),
        other => Err(MshError(format!("points of shape {other:?}: expected [nodes, 3] or [nodes, 2]"))),
    }
}

fn of_entities(
    nodes: &PyReadonlyArray2<'_, f64>,
    tags: &PyReadonlyArray1<'_, u64>,
    blocks: &[GivenBlock<'_>],
    groups: Vec<GivenGroup>,
) -> Result<MeshParts, MshError> {
    let node_tags = tags.as_array().to_vec();
    let places: HashMap<u64, usize> = node_tags.iter().enumerate().map(|(place, &tag)| (tag, place)).collect();
    let block = |(dimension, tag, gmsh_type, tags, nodes): &GivenBlock<'_>| {
        let place = |tag: &u64| {
            places.get(tag).copied().ok_or_else(|| MshError(format!("an element has node {tag}, which is not there")))
        };
        Ok(ElementBlock {
            kind: kind(*gmsh_type)?,
            tags: tags.as_array().to_vec(),
            connectivity: nodes.as_array().iter().map(place).collect::<Result<_, _>>()?,
            entity: Entity { dimension: *dimension, tag: *tag },
        })
    };
    let group = |(dimension, tag, name, entities)| EntityGroup { name, dimension, tag, entities };
    Ok(MeshParts {
        nodes: points(nodes)?,
        node_tags,
        blocks: blocks.iter().map(block).collect::<Result<_, _>>()?,
        groups: groups.into_iter().map(group).collect(),
    })
}

fn of_cells(nodes: &PyReadonlyArray2<'_, f64>, cells: Vec<GivenCells<'_>>) -> Result<MeshParts, MshError> {
    let cell = |(gmsh_type, nodes, groups): GivenCells<'_>| {
        let index = |&node: &i64| {
            usize::try_from(node).map_err(|_| MshError(format!("an element has node {node}: expected an index from 0")))
        };
        let connectivity = nodes.as_array().iter().map(index).collect::<Result<_, _>>()?;
        Ok(Cells { kind: kind(gmsh_type)?, connectivity, groups })
    };
    MeshParts::of_cells(points(nodes)?, &cells.into_iter().map(cell).collect::<Result<Vec<_>, _>>()?)
}

#[pymethods]
impl Mesh {
    /// The content of a mesh file.
    #[staticmethod]
    fn of_bytes(py: Python<'_>, content: Vec<u8>, name: PathBuf) -> PyResult<Self> {
        Self::of(py, content, &name)
    }

    /// A mesh by gmsh's entities.
    #[staticmethod]
    #[pyo3(name = "of_entities")]
    fn of_gmsh(
        py: Python<'_>,
        nodes: PyReadonlyArray2<'_, f64>,
        tags: PyReadonlyArray1<'_, u64>,
        blocks: Vec<GivenBlock<'_>>,
        groups: Vec<GivenGroup>,
    ) -> PyResult<Self> {
        Self::of_parts(py, of_entities(&nodes, &tags, &blocks, groups), "the model of gmsh".as_ref())
    }

    /// A mesh of arrays.
    #[staticmethod]
    #[pyo3(name = "of_cells")]
    fn of_arrays(py: Python<'_>, nodes: PyReadonlyArray2<'_, f64>, cells: Vec<GivenCells<'_>>) -> PyResult<Self> {
        Self::of_parts(py, of_cells(&nodes, cells), "the arrays".as_ref())
    }

    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::points(py, self.mesh.nodes.clone())
    }

    fn node_tags<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        arrays::vector(py, self.mesh.node_tags.clone())
    }

    /// Name, dimension and number of elements of each group.
    fn groups(&self) -> Vec<(String, usize, usize)> {
        let groups = self.mesh.groups.iter();
        groups.map(|group| (group.name.clone(), group.dimension, group.elements.len())).collect()
    }

    /// Name of each kind of elements, and their number.
    fn kinds(&self) -> Vec<(&'static str, usize)> {
        let count = |kind| self.mesh.blocks.iter().filter(|block| block.kind == kind).map(ElementBlock::len).sum();
        ElementKind::all().map(|kind| (kind.name(), count(kind))).filter(|&(_, count)| count > 0).collect()
    }

    /// The content of a file of it.
    fn content(&self) -> &[u8] {
        &self.content
    }
}
