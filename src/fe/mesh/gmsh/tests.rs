//! Every rule of the reader on one small mesh, and damaged files by the thousand.

use std::path::Path;

use crate::fe::mesh::{ElementBlock, ElementId, ElementKind, Entity, Mesh, MeshError};
use crate::numerics::units::LengthUnit;

mod damage;
mod encode;
mod mshio_agrees;
mod repeats;
mod rules;
mod versions;
mod write;

/// gmsh's own hexahedra, pyramids and tetrahedra of second order, complete and not: as many as it made, and the volume of
/// the box of 20 x 10 x 10 mm by their own node order.
#[test]
fn gmshs_mixed_meshes_fill_their_box() -> Result<(), Box<dyn std::error::Error>> {
    use ElementKind::{Hex20, Hex27, Pyramid13, Pyramid14, Tet10};
    for (name, hexahedron, pyramid) in [("hex27", Hex27, Pyramid14), ("hex20", Hex20, Pyramid13)] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/mixed_{name}.msh"));
        let mesh = Mesh::read_gmsh(&path, LengthUnit::Metre)?;
        let count = |kind: ElementKind| -> usize {
            mesh.blocks.iter().filter(|block| block.kind == kind).map(ElementBlock::len).sum()
        };
        assert_eq!([count(hexahedron), count(pyramid), count(Tet10)], [8, 4, 58]);
        let mut volume = 0.0;
        for block in &mesh.blocks {
            for element in block.elements() {
                let coords: Vec<[f64; 3]> = element.iter().map(|&node| mesh.nodes[node]).collect();
                let quality = crate::fe::element::continuum::quality(block.kind, &coords)?;
                // a cell of 5 mm, a pyramid on one, and straight tetrahedra have a constant Jacobian
                assert!((quality.scaled_jacobian - 1.0).abs() < 1e-9, "{:?}: {quality:?}", block.kind);
                volume += crate::fe::element::continuum::measure(block.kind, &coords)?;
            }
        }
        assert!((volume / 2e-6 - 1.0).abs() < 1e-12, "{volume}");
    }
    Ok(())
}

/// Two quadrilaterals side by side, 2 x 1. Node tags are dense but not in order; the left edge is in two
/// groups, one of them without a name; names hold blanks and quotes.
const SMALL: &str = r#"$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
0 7 "corner point"
1 1 "the "left" edge"
1 9 "nothing there"
2 10 "plate"
$EndPhysicalNames
$Entities
1 1 1 0
1 0 0 0 1 7
1 0 0 0 0 1 0 2 -1 5 2 1 -2
1 0 0 0 2 1 0 1 10 1 1
$EndEntities
$Nodes
3 6 1 6
0 1 0 1
1
0 0 0
1 1 0 1
6
0 1 0
2 1 0 4
3
2
5
4
2 0 0
1 0 0
1 1 0
2 1 0
$EndNodes
$Elements
3 4 1 4
0 1 15 1
1 1
1 1 1 1
2 6 1
2 1 3 2
3 1 2 5 6
4 2 3 4 5
$EndElements
"#;

fn read(bytes: &[u8]) -> Result<Mesh, String> {
    let path = Path::new("small.msh");
    match Mesh::from_gmsh_bytes(bytes, path, LengthUnit::Millimetre) {
        Err(MeshError::Gmsh { fault, .. }) => Err(fault.to_string()),
        other => other.map_err(|error| error.to_string()),
    }
}

#[test]
fn small_mesh_is_read_whole() -> Result<(), String> {
    let mesh = read(SMALL.as_bytes())?;
    assert_eq!(mesh.node_tags, [1, 6, 3, 2, 5, 4]);
    let mm: Vec<[i64; 3]> = mesh.nodes.iter().map(|node| node.map(|x| (x * 1e3).round() as i64)).collect();
    let expected = [[0, 0, 0], [0, 1, 0], [2, 0, 0], [1, 0, 0], [1, 1, 0], [2, 1, 0]];
    assert_eq!(mm, expected);
    assert!((mesh.nodes[2][0] - 2e-3).abs() < 1e-18);
    let kinds: Vec<ElementKind> = mesh.blocks.iter().map(|block| block.kind).collect();
    assert_eq!(kinds, [ElementKind::Point, ElementKind::Line2, ElementKind::Quad4]);
    let quads = &mesh.blocks[2];
    assert_eq!(quads.tags, [3, 4]);
    assert_eq!(quads.connectivity, [0, 3, 4, 1, 3, 2, 5, 4]);
    assert_eq!(quads.element(1), Some([3, 2, 5, 4].as_slice()));
    assert_eq!(quads.element(2), None);
    assert_eq!(quads.entity, Entity { dimension: 2, tag: 1 });
    assert_eq!(mesh.source, Path::new("small.msh"));
    Ok(())
}

#[test]
fn groups_have_their_names_nodes_and_elements() -> Result<(), String> {
    let mesh = read(SMALL.as_bytes())?;
    let group = |name: &str| mesh.group(name).map_err(|error| error.to_string());
    let left = group("the \"left\" edge")?;
    assert_eq!((left.dimension, left.tag), (1, 1));
    assert_eq!(left.nodes, [0, 1]);
    assert_eq!(left.elements, [ElementId { block: 1, index: 0 }]);
    assert_eq!(group("5")?.nodes, left.nodes);
    assert_eq!(group("corner point")?.nodes, [0]);
    let plate = group("plate")?;
    assert_eq!(plate.nodes, [0, 1, 2, 3, 4, 5]);
    assert_eq!(plate.elements.len(), 2);
    assert_eq!(
        group("Plat"),
        Err("small.msh has no physical group \"Plat\"; nearest is \"plate\", it has \"corner point\", \
             \"the \"left\" edge\", \"5\", \"nothing there\", \"plate\""
            .to_owned())
    );
    assert_eq!(
        group("nothing there"),
        Err("small.msh: the physical group \"nothing there\" has no elements: expected at least one".to_owned())
    );
    // a name of two dimensions: a part means the body, anything else what is below it
    let same = read(SMALL.replace("\"corner point\"", "\"plate\"").as_bytes())?;
    assert_eq!(same.body("plate").map(|group| group.dimension).ok(), Some(2));
    assert_eq!(same.group("plate").map(|group| group.dimension).ok(), Some(0));
    let same = read(SMALL.replace("\"the \"left\" edge\"", "\"5\"").as_bytes())?;
    assert_eq!(
        same.group("5").map_err(|error| error.to_string()),
        Err("small.msh has 2 physical groups \"5\" (dimension, tag: (1, 1), (1, 5)): rename all but one in gmsh"
            .to_owned())
    );
    Ok(())
}

#[test]
fn a_mesh_without_groups_says_so() -> Result<(), String> {
    let (before, rest) = SMALL.split_once("$PhysicalNames").ok_or("names")?;
    let (_, after) = rest.split_once("$EndEntities\n").ok_or("entities")?;
    let mesh = read(format!("{before}{after}").as_bytes())?;
    assert_eq!(
        mesh.group("plate").map_err(|error| error.to_string()),
        Err("small.msh has no physical group \"plate\"; it has none at all (plummer inspect lists \
             what a name such as \"surface 7\" may mean)"
            .to_owned())
    );
    Ok(())
}

#[test]
fn inventory_counts() -> Result<(), String> {
    let extra = SMALL.replace("3 6 1 6\n", "4 7 1 7\n2 2 0 1\n7\n-1 0.5 4\n");
    let mesh = read(extra.as_bytes())?;
    let inventory = mesh.inventory();
    assert_eq!((inventory.nodes, inventory.unused_nodes), (7, 1));
    let counts: Vec<usize> = inventory.elements.iter().map(|entry| entry.count).collect();
    assert_eq!(counts, [1, 1, 2]);
    let extent = inventory.bounding_box.extent();
    let expected = [3e-3, 1e-3, 4e-3];
    assert!(extent.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15));
    let names: Vec<&str> = inventory.groups.iter().map(|group| group.name.as_str()).collect();
    assert_eq!(names, ["corner point", "the \"left\" edge", "5", "nothing there", "plate"]);
    let sizes: Vec<usize> = inventory.groups.iter().map(|group| group.nodes).collect();
    assert_eq!(sizes, [1, 2, 2, 0, 6]);
    Ok(())
}

#[test]
fn other_sections_are_passed_over() -> Result<(), String> {
    let plain = read(SMALL.as_bytes())?;
    let comment = "$Comments\nfirst $EndComments is not at the start of a line\n$EndComments\n";
    let periodic = "$Periodic\n1\n1 3 1\n0\n1\n2 1\n$EndPeriodic\n";
    let unknown = "$My_Data 2\n$EndNodes\n$EndMy_Data 2\n$Empty\n$EndEmpty\n";
    let with_others = format!("{comment}{SMALL}{periodic}{unknown}");
    assert_eq!(read(with_others.as_bytes())?, plain);
    let name = SMALL.replace("\"plate\"", "\"a $EndPhysicalNames b\"");
    let names: Vec<String> = read(name.as_bytes())?.groups.into_iter().map(|g| g.name).collect();
    assert_eq!(names.last().map(String::as_str), Some("a $EndPhysicalNames b"));
    assert_eq!(read(SMALL.replace('\n', "\r\n").as_bytes())?, plain);
    Ok(())
}
