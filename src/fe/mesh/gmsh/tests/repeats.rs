//! MSH 2.2: elements repeated for several groups, in every way that gmsh and others write them.

use super::{SMALL, read};
use crate::fe::mesh::{Mesh, MshVersion};

/// The small mesh in 2.2 with these lines of elements.
fn small_v22(elements: &[&str]) -> Result<Mesh, String> {
    let (_, names) = SMALL.split_once("$PhysicalNames").ok_or("names")?;
    let (names, _) = names.split_once("$Entities").ok_or("names")?;
    read(
        format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames{names}$Nodes\n6\n1 0 0 0\n6 0 1 0\n3 2 0 0\n\
             2 1 0 0\n5 1 1 0\n4 2 1 0\n$EndNodes\n$Elements\n{}\n{}\n$EndElements\n",
            elements.len(),
            elements.join("\n")
        )
        .as_bytes(),
    )
}

const POINT: &str = "1 15 2 7 1 1";

/// The left edge in two groups (reversed in the second), the elements in the order of gmsh.
#[test]
fn is_the_mesh_of_4_1() -> Result<(), String> {
    let quads = ["4 3 2 10 1 1 2 5 6", "5 3 2 10 1 2 3 4 5"];
    for edges in [["2 1 2 1 1 6 1", "3 1 2 5 1 6 1"], ["2 1 2 1 1 6 1", "3 1 3 -5 1 0 1 6"]] {
        let mut mesh = small_v22(&[POINT, edges[0], edges[1], quads[0], quads[1]])?;
        let mut expected = read(SMALL.as_bytes())?;
        assert_eq!(mesh.format.version, MshVersion::V22);
        assert_eq!(mesh.blocks[2].tags, [4, 5]);
        mesh.format = expected.format;
        mesh.blocks[2].tags.clone_from(&expected.blocks[2].tags);
        expected.source.clone_from(&mesh.source);
        assert_eq!(mesh, expected);
    }
    Ok(())
}

/// One element in both groups, one in each alone, one in none: counted once each.
#[test]
fn groups_may_share_some_of_an_entity() -> Result<(), String> {
    let mesh = small_v22(&[
        "1 3 2 10 1 1 2 5 6",
        "2 3 2 11 1 2 3 4 5",
        "3 3 2 10 1 2 3 4 5",
        "4 1 2 1 2 1 6",
        "5 3 2 11 1 1 3 4 6",
        "6 3 2 0 1 1 2 4 6",
    ])?;
    assert_eq!(mesh.blocks.len(), 2);
    assert_eq!(mesh.blocks[1].tags, [1, 2, 5, 6]);
    let members = |name: &str| -> Result<Vec<usize>, String> {
        let group = mesh.group(name).map_err(|error| error.to_string())?;
        Ok(group.elements.iter().map(|id| id.index).collect())
    };
    assert_eq!((members("plate")?, members("11")?), (vec![0, 1], vec![1, 2]));
    assert_eq!(mesh.inventory().ungrouped_elements, 1);
    Ok(())
}

/// Two elements on the same nodes in one group are a matter of the mesh, not of the format: both stay.
#[test]
fn elements_on_the_same_nodes_in_one_group_stay() -> Result<(), String> {
    let twice = small_v22(&["1 3 2 10 1 1 2 5 6", "2 3 2 10 1 1 2 5 6"])?;
    assert_eq!(twice.blocks[0].tags, [1, 2]);
    let both = small_v22(&["1 3 2 10 1 1 2 5 6", "2 3 2 10 1 1 2 5 6", "3 3 2 11 1 5 6 1 2", "4 3 2 10 1 2 3 4 5"])?;
    assert_eq!(both.blocks[0].tags, [1, 2, 4]);
    let group = both.group("11").map_err(|error| error.to_string())?;
    assert_eq!(group.elements.len(), 1);
    assert_eq!(group.elements[0].index, 0);
    Ok(())
}

/// The same nodes on another entity, or as another kind, are another element.
#[test]
fn other_entities_have_their_own_elements() -> Result<(), String> {
    let mesh = small_v22(&["1 3 2 10 1 1 2 5 6", "2 3 2 11 2 1 2 5 6"])?;
    assert_eq!(mesh.blocks.iter().map(|block| block.len()).collect::<Vec<_>>(), [1, 1]);
    Ok(())
}
