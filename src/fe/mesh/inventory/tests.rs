//! What the inventory finds, on meshes with known faults.

use std::path::Path;

use crate::fe::mesh::{Inventory, Mesh, MeshError};
use crate::numerics::units::LengthUnit;

/// Two squares of side 1 that touch at x = 1 but share no node there (5 on 2, 8 on 3); a third, alone, of
/// two triangles. Node 13 is used by nothing. Groups: 1 both squares, 2 the left one, none the triangles.
const PARTS: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"squares\"\n$EndPhysicalNames
$Entities\n0 0 3 0
1 0 0 0 1 1 0 2 1 2 0
2 1 0 0 2 1 0 1 1 0
3 5 0 0 6 1 0 0 0\n$EndEntities
$Nodes\n1 13 1 13\n2 1 0 13\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n13
0 0 0\n1 0 0\n1 1 0\n0 1 0
1.00000001 0 0\n2 0 0\n2 1 0\n1 0.99999998 1e-8
5 0 0\n6 0 0\n6 1 0\n5 1 0\n9 9 9\n$EndNodes
$Elements\n3 4 1 4\n2 1 3 1\n1 1 2 3 4\n2 2 3 1\n2 5 6 7 8\n2 3 2 2\n3 9 10 11\n4 9 11 12\n$EndElements\n";

fn inventory() -> Result<Inventory, MeshError> {
    let mesh = Mesh::from_gmsh_bytes(PARTS.as_bytes(), Path::new("parts.msh"), LengthUnit::Metre)?;
    Ok(mesh.inventory())
}

#[test]
fn parts_that_hang_in_the_air_are_found() -> Result<(), MeshError> {
    let parts = inventory()?.parts;
    let counts: Vec<(usize, usize, u64)> =
        parts.iter().map(|part| (part.elements, part.nodes, part.node_tag)).collect();
    assert_eq!(counts, [(2, 4, 9), (1, 4, 1), (1, 4, 5)]);
    assert!((parts[0].bounding_box.min[0] - 5.0).abs() < 1e-15);
    assert!((parts[0].bounding_box.diagonal() - 2.0_f64.sqrt()).abs() < 1e-15);
    Ok(())
}

/// Pairs 2.2e-8 and 1e-8 apart, tolerance 1e-7 of the diagonal of 16 m; across a wall between cubes too.
#[test]
fn nodes_in_one_place_are_found() -> Result<(), MeshError> {
    let inventory = inventory()?;
    assert_eq!(inventory.duplicates.count, 2);
    assert_eq!(inventory.duplicates.first_pairs, [[2, 5], [3, 8]]);
    assert!((inventory.duplicates.tolerance / 1.559e-6 - 1.0).abs() < 1e-3);
    assert_eq!((inventory.unused.count, inventory.unused.first_tags), (1, vec![13]));
    Ok(())
}

/// Against the distance of every pair, with nodes at random offsets up to three tolerances from a lattice.
#[test]
fn duplicates_are_those_of_every_pair() -> Result<(), MeshError> {
    let mut mesh = Mesh::from_gmsh_bytes(PARTS.as_bytes(), Path::new("parts.msh"), LengthUnit::Metre)?;
    mesh.nodes = vec![[0.0; 3], [1.0; 3]];
    let tolerance = 1e-7 * 3.0_f64.sqrt();
    let mut state = 1_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX)
    };
    for point in 0..600 {
        let lattice = 0.1 + 0.1 * f64::from(point % 5);
        mesh.nodes.push([0, 1, 2].map(|_| lattice + 3.0 * tolerance * random()));
    }
    mesh.node_tags = (1..=mesh.nodes.len() as u64).collect();
    let near = |a: [f64; 3], b: [f64; 3]| {
        let [x, y, z] = [0, 1, 2].map(|axis| a[axis] - b[axis]);
        x.hypot(y).hypot(z) <= tolerance
    };
    let has_earlier = |&node: &usize| mesh.nodes[..node].iter().any(|&other| near(other, mesh.nodes[node]));
    let expected = (0..mesh.nodes.len()).filter(has_earlier).count();
    assert!(expected > 100);
    assert_eq!(mesh.inventory().duplicates.count, expected);
    Ok(())
}

#[test]
fn groups_that_share_elements_and_elements_without_group() -> Result<(), MeshError> {
    let inventory = inventory()?;
    assert_eq!(inventory.overlaps.len(), 1);
    let overlap = &inventory.overlaps[0];
    assert_eq!((overlap.dimension, overlap.tags, overlap.elements), (2, [1, 2], 1));
    assert_eq!(overlap.names, ["squares", "2"]);
    assert_eq!((inventory.dimension, inventory.ungrouped_elements), (2, 2));
    assert_eq!(inventory.groups[0].kinds.len(), 1);
    Ok(())
}

#[test]
fn inventory_as_json() -> Result<(), Box<dyn std::error::Error>> {
    let json = serde_json::to_value(inventory()?)?;
    assert_eq!(json["format"]["version"], "4.1");
    assert_eq!(json["elements"][1]["kind"], "Quad4");
    assert_eq!(json["overlaps"][0]["names"][0], "squares");
    Ok(())
}
