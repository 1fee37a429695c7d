//! Grids come back through an independent reader, the crate `vtkio`.

use std::fs;
use std::path::Path;

use vtkio::IOBuffer;
use vtkio::model::{Attribute, DataSet, Piece, UnstructuredGridPiece, VertexNumbers, Vtk};

use super::super::FormatError;
use super::*;
use crate::fe::mesh::{ElementId, Mesh};
use crate::files::FileError;
use crate::numerics::units::LengthUnit;

fn mesh(name: &str) -> Mesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    Mesh::read_gmsh(&path, LengthUnit::Millimetre).unwrap()
}

/// Elements of the highest dimension.
fn housing(mesh: &Mesh) -> Vec<ElementId> {
    let dimension = mesh.blocks.iter().map(|b| b.kind.dimension()).max();
    let blocks = mesh.blocks.iter().enumerate();
    blocks
        .filter(|(_, block)| Some(block.kind.dimension()) == dimension)
        .flat_map(|(block, own)| (0..own.len()).map(move |index| ElementId { block, index }))
        .collect()
}

fn import(path: &Path) -> UnstructuredGridPiece {
    let vtk = Vtk::import(path).unwrap();
    let DataSet::UnstructuredGrid { mut pieces, .. } = vtk.data else {
        panic!("no unstructured grid");
    };
    let Piece::Inline(piece) = pieces.remove(0) else {
        panic!("no inline piece");
    };
    *piece
}

fn floats(buffer: &IOBuffer) -> Vec<u64> {
    let IOBuffer::F64(values) = buffer else {
        panic!("no f64: {buffer:?}");
    };
    values.iter().map(|value| value.to_bits()).collect()
}

fn array<'a>(attributes: &'a [Attribute], name: &str) -> &'a IOBuffer {
    let found = attributes.iter().find_map(|attribute| match attribute {
        Attribute::DataArray(array) if array.name == name => Some(&array.data),
        _ => None,
    });
    found.unwrap()
}

#[test]
fn grids_come_back_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grid.vtu");
    let meshes = [
        "tests/data/cube_tet10_msh41.msh",
        "tests/data/cube_hex20_msh41.msh",
        "tests/data/cube_wedge15_msh41.msh",
        "tests/data/ring3d_hex8.msh",
        "tests/data/ring2d_quad8.msh",
        "meshes/ring_6_9_tri.msh",
    ];
    for name in meshes {
        let mesh = mesh(name);
        let elements = housing(&mesh);
        let count = mesh.nodes.len();
        let shape: Vec<f64> = (0..3 * count).map(|k| (k as f64 * 0.37).sin() / 3.0).collect();
        let mut scalars: Vec<f64> = (0..count).map(|k| 1e-300 * k as f64).collect();
        scalars[0] = -0.0;
        let parts: Vec<i64> = (0..elements.len() as i64).map(|k| k * k - 5).collect();
        let point_fields = [
            Field { name: "mode 07 1234.5 Hz", values: FieldValues::Vectors(&shape) },
            Field { name: "strain <energy> & \"more\"", values: FieldValues::Scalars(&scalars) },
        ];
        let cell_fields = [Field { name: "part", values: FieldValues::Integers(&parts) }];
        write_vtu(&path, &mesh, elements.clone(), &point_fields, &cell_fields).unwrap();
        let piece = import(&path);

        let mut used: Vec<usize> =
            elements.iter().flat_map(|id| mesh.blocks[id.block].element(id.index).unwrap()).copied().collect();
        used.sort_unstable();
        used.dedup();
        let points: Vec<u64> = used.iter().flat_map(|&node| mesh.nodes[node].map(f64::to_bits)).collect();
        assert_eq!(floats(&piece.points), points, "{name}");
        let VertexNumbers::XML { connectivity, offsets } = &piece.cells.cell_verts else {
            panic!("no XML cells");
        };
        let mut begin = 0;
        for (index, id) in elements.iter().enumerate() {
            let block = &mesh.blocks[id.block];
            let nodes = block.element(id.index).unwrap();
            let end = offsets[index] as usize;
            let found: Vec<usize> = connectivity[begin..end].iter().map(|&place| used[place as usize]).collect();
            let expected: Vec<usize> = node_order(block.kind).iter().map(|&k| nodes[k]).collect();
            assert_eq!(found, expected, "{name}");
            assert_eq!(piece.cells.types[index] as u8, cell_type(block.kind));
            begin = end;
        }
        assert_eq!((begin, offsets.len()), (connectivity.len(), elements.len()));
        let vectors: Vec<u64> =
            used.iter().flat_map(|&node| &shape[3 * node..][..3]).map(|value| value.to_bits()).collect();
        let found = array(&piece.data.point, "mode 07 1234.5 Hz");
        assert_eq!(floats(found), vectors, "{name}");
        let scalars: Vec<u64> = used.iter().map(|&node| scalars[node].to_bits()).collect();
        let found = array(&piece.data.point, "strain <energy> & \"more\"");
        assert_eq!(floats(found), scalars, "{name}");
        assert_eq!(array(&piece.data.cell, "part"), &IOBuffer::I64(parts));
    }
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grid.vtu");
    let mesh = mesh("tests/data/cube_hex20_msh41.msh");
    let elements = housing(&mesh);
    let write = |elements: Vec<ElementId>, fields: &[Field], cells: &[Field]| {
        let error = write_vtu(&path, &mesh, elements, fields, cells).unwrap_err();
        error.to_string()
    };
    let field = |name: &'static str| Field { name, values: FieldValues::Scalars(&[1.0; 8]) };
    let wrong = ElementId { block: 0, index: 99 };
    assert_eq!(write(vec![wrong], &[], &[]), "the mesh has no element 99 in block 0");
    assert_eq!(write(vec![], &[], &[]), "expected at least one element to write, found none");
    assert_eq!(write(elements.clone(), &[], &[field("a"), field("a")]), "two fields are called \"a\"");
    assert_eq!(
        write(elements.clone(), &[], &[field("a\nb")]),
        "expected a field's name without control characters, found \"a\\nb\""
    );
    let expected =
        format!("field \"a\" takes {} values (a fixed number for each node of the mesh), found 8", mesh.nodes.len());
    assert_eq!(write(elements.clone(), &[field("a")], &[]), expected);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    let nowhere = folder.path().join("no/grid.vtu");
    let error = write_vtu(&nowhere, &mesh, elements, &[], &[]).unwrap_err();
    assert!(matches!(error, FormatError::File(FileError::Write { path, .. }) if path == nowhere));
}
