//! What is written from memory is read as the file that it came from.

use super::super::write::{Cells, EntityGroup, MeshParts};
use crate::fe::mesh::{ElementKind, Mesh, PhysicalGroup};
use crate::numerics::units::LengthUnit;
use std::path::Path;

fn parts(mesh: &Mesh) -> MeshParts {
    let entities = |group: &PhysicalGroup| {
        let mut own: Vec<i32> = group.elements.iter().map(|id| mesh.blocks[id.block].entity.tag).collect();
        own.sort_unstable();
        own.dedup();
        own
    };
    let groups = mesh.groups.iter().map(|group| EntityGroup {
        name: group.name.clone(),
        dimension: group.dimension,
        tag: group.tag,
        entities: entities(group),
    });
    MeshParts {
        nodes: mesh.nodes.clone(),
        node_tags: mesh.node_tags.clone(),
        blocks: mesh.blocks.clone(),
        groups: groups.collect(),
    }
}

#[test]
fn a_mesh_comes_back_as_it_was() {
    for name in ["cube_hex20_msh41", "cube_wedge15_msh41", "mixed_hex27", "pedestal_10k", "two_blocks", "fv32_quad8"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/{name}.msh"));
        let mesh = Mesh::read_gmsh(&path, LengthUnit::Metre).unwrap();
        assert!(!mesh.groups.is_empty(), "{name}");
        let bytes = parts(&mesh).to_msh().unwrap();
        let again = Mesh::from_gmsh_bytes(bytes, &path, LengthUnit::Metre).unwrap();
        assert_eq!((&again.nodes, &again.node_tags), (&mesh.nodes, &mesh.node_tags), "{name}");
        assert_eq!(again.blocks, mesh.blocks, "{name}");
        assert_eq!(again.groups, mesh.groups, "{name}");
    }
}

/// Two quadrilaterals side by side; the edge between them is in no group.
#[test]
fn cells_that_share_groups_share_an_entity() {
    let nodes = (0..6).map(|node| [f64::from(node % 3), f64::from(node / 3), 0.0]).collect();
    let group = |name: &str, members: &[usize]| (name.to_owned(), members.to_vec());
    let cells = [
        Cells {
            kind: ElementKind::Quad4,
            connectivity: vec![0, 1, 4, 3, 1, 2, 5, 4],
            groups: vec![group("plate", &[0, 1]), group("a \"right\" half", &[1])],
        },
        Cells {
            kind: ElementKind::Line2,
            connectivity: vec![0, 3, 2, 5],
            groups: vec![group("left", &[0]), group("plate", &[1])],
        },
    ];
    let parts = MeshParts::of_cells(nodes, &cells).unwrap();
    let mesh = Mesh::from_gmsh_bytes(parts.to_msh().unwrap(), Path::new("arrays"), LengthUnit::Millimetre).unwrap();
    assert!(mesh.nodes[4].iter().zip([1e-3, 1e-3, 0.0]).all(|(found, expected)| (found - expected).abs() < 1e-18));
    let found: Vec<(usize, &str, usize)> =
        mesh.groups.iter().map(|group| (group.dimension, group.name.as_str(), group.elements.len())).collect();
    assert_eq!(found, [(1, "left", 1), (1, "plate", 1), (2, "plate", 2), (2, "a \"right\" half", 1)]);
    assert_eq!(mesh.body("a \"right\" half").unwrap().nodes, [1, 2, 4, 5]);
}

#[test]
fn what_no_file_can_say_is_refused() {
    let cells = |connectivity: &[usize], members: &[usize]| {
        let groups = vec![("all".to_owned(), members.to_vec())];
        let cells = Cells { kind: ElementKind::Line2, connectivity: connectivity.to_vec(), groups };
        MeshParts::of_cells(vec![[0.0; 3], [1.0, 0.0, 0.0]], &[cells])
    };
    let message = cells(&[0, 1], &[1]).unwrap_err().to_string();
    assert_eq!(message, "group \"all\" has element 1 of the 1 Line2: expected one below 1");
    let message = cells(&[0, 1, 0], &[0]).unwrap_err().to_string();
    assert_eq!(message, "elements Line2 have 3 nodes: expected 2 each");
    let parts = cells(&[0, 2], &[0]).unwrap();
    assert_eq!(parts.to_msh().unwrap_err().to_string(), "an element Line2 has node 2: expected an index below 2");
    let mut parts = cells(&[0, 1], &[0]).unwrap();
    parts.groups[0].name = "two\nlines".to_owned();
    assert_eq!(parts.to_msh().unwrap_err().to_string(), "the group \"two\\nlines\" has a line break in its name");
    parts.groups.clear();
    parts.node_tags.pop();
    assert_eq!(parts.to_msh().unwrap_err().to_string(), "2 nodes have 1 tags: expected one each");
    parts.node_tags.push(2);
    parts.blocks[0].connectivity.pop();
    assert_eq!(parts.to_msh().unwrap_err().to_string(), "1 Line2 have 1 nodes: expected 2 each");
    parts.blocks[0].connectivity.push(1);
    parts.blocks[0].entity.dimension = 7;
    assert_eq!(parts.to_msh().unwrap_err().to_string(), "Line2 lie on an entity of dimension 7: expected 1");
    // two nodes of one tag are for the reader to refuse
    parts.blocks[0].entity.dimension = 1;
    parts.node_tags[1] = 1;
    let read = Mesh::from_gmsh_bytes(parts.to_msh().unwrap(), Path::new("arrays"), LengthUnit::Metre);
    assert!(read.unwrap_err().to_string().contains("occurs a second time"));
}
