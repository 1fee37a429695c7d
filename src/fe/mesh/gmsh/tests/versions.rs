//! The same small mesh in every version, partitioned, with parameters, and with the names that old programs wrote.

use super::{SMALL, read};
use crate::fe::mesh::{Mesh, MshVersion};

/// The small mesh without its points, as MSH 4.0 has it.
const SMALL_40: &str = r#"$MeshFormat
4 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "left"
2 10 "plate"
$EndPhysicalNames
$Entities
1 1 1 0
1 0 0 0 0 0 0 1 7
1 0 0 0 0 1 0 2 -1 5 2 1 -2
1 0 0 0 2 1 0 1 10 1 1
$EndEntities
$Nodes
3 6
1 0 0 1
1 0 0 0
1 1 1 1
6 0 1 0 0.5
1 2 1 4
3 2 0 0 0.1 0.2
2 1 0 0 0.1 0.2
5 1 1 0 0.1 0.2
4 2 1 0 0.1 0.2
$EndNodes
$Elements
2 3
1 1 1 1
2 6 1
1 2 3 2
3 1 2 5 6
4 2 3 4 5
$EndElements
"#;

/// Groups as (name, dimension, tags of their nodes).
fn groups(mesh: &Mesh) -> Vec<(&str, usize, Vec<u64>)> {
    let tags = |nodes: &[usize]| nodes.iter().map(|&node| mesh.node_tags[node]).collect();
    mesh.groups.iter().map(|group| (group.name.as_str(), group.dimension, tags(&group.nodes))).collect()
}

#[test]
fn msh_4_0_with_parameters_is_the_same_mesh() -> Result<(), String> {
    let mesh = read(SMALL_40.as_bytes())?;
    let same = read(SMALL.as_bytes())?;
    assert_eq!(mesh.format.version, MshVersion::V40);
    assert_eq!((&mesh.nodes, &mesh.node_tags), (&same.nodes, &same.node_tags));
    assert_eq!(mesh.blocks, same.blocks[1..]);
    let found = groups(&mesh);
    assert_eq!(found[0], ("left", 1, vec![1, 6]));
    assert_eq!(found[1], ("5", 1, vec![1, 6]));
    assert_eq!(found[2], ("plate", 2, vec![1, 6, 3, 2, 5, 4]));
    Ok(())
}

#[test]
fn parameters_of_msh_4_1_are_passed_over() -> Result<(), String> {
    let with = SMALL
        .replace("1 1 0 1\n6\n0 1 0\n", "1 1 1 1\n6\n0 1 0 0.5\n")
        .replace("2 1 0 4\n", "2 1 1 4\n")
        .replace("2 0 0\n1 0 0\n1 1 0\n2 1 0\n$", "2 0 0 7 8\n1 0 0 7 8\n1 1 0 7 8\n2 1 0 7 8\n$");
    assert_ne!(with, SMALL);
    assert_eq!(read(with.as_bytes())?, read(SMALL.as_bytes())?);
    Ok(())
}

/// Each quadrilateral a part of its own, and the line between them, which is no geometry.
#[test]
fn parts_of_a_partitioned_mesh_are_joined() -> Result<(), String> {
    let parts = "$PartitionedEntities\n2\n0\n0 1 2 0\n9 2 1 2 1 2 1 0 0 1 1 0 0 0\n\
                 5 2 1 1 1 0 0 0 1 1 0 1 10 0\n6 2 1 1 2 1 0 0 2 1 0 1 10 0\n$EndPartitionedEntities\n$Nodes\n";
    let with = SMALL.replacen("$Nodes\n", parts, 1).replace(
        "3 4 1 4\n0 1 15 1\n1 1\n1 1 1 1\n2 6 1\n2 1 3 2\n3 1 2 5 6\n4 2 3 4 5\n",
        "5 5 1 5\n0 1 15 1\n1 1\n1 1 1 1\n2 6 1\n1 9 1 1\n5 2 5\n2 5 3 1\n3 1 2 5 6\n2 6 3 1\n4 2 3 4 5\n",
    );
    assert_ne!(with, SMALL);
    let (mesh, whole) = (read(with.as_bytes())?, read(SMALL.as_bytes())?);
    assert_eq!(groups(&mesh), groups(&whole));
    let plate: Vec<usize> = mesh.blocks[2..].iter().flat_map(|block| block.connectivity.clone()).collect();
    assert_eq!(plate, whole.blocks[2].connectivity);
    assert!(mesh.blocks[2..].iter().all(|block| block.entity == whole.blocks[2].entity));
    Ok(())
}

/// One file a partition, with the elements of others that touch its own and without them.
#[test]
fn one_partition_of_several_is_no_body() -> Result<(), String> {
    let entities =
        "$PartitionedEntities\n2\n0\n0 0 1 0\n5 2 1 1 1 0 0 0 1 1 0 1 10 0\n$EndPartitionedEntities\n$Nodes\n";
    let alone = SMALL.replacen("$Nodes\n", entities, 1).replace("2 1 3 2\n", "2 5 3 2\n");
    let refused = |text: &str| read(text.as_bytes()).expect_err("half a body");
    assert!(
        refused(&alone).contains("the file holds partition 1 of 2, which is not the whole body"),
        "{}",
        refused(&alone)
    );
    assert!(read(alone.replace("Entities\n2\n0\n", "Entities\n1\n0\n").as_bytes()).is_ok());
    let ghosts = |lines: &str| format!("{SMALL}$GhostElements\n{lines}$EndGhostElements\n");
    assert!(read(ghosts("2\n3 1 1 2\n4 2 1 1\n").as_bytes()).is_ok());
    assert!(refused(&ghosts("1\n4 2 1 1\n")).contains("partition 1 of a mesh of several"));
    let old = |partition: u32| {
        format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
             $Elements\n1\n1 3 4 10 1 1 {partition} 1 2 3 4\n$EndElements\n"
        )
    };
    assert!(refused(&old(2)).contains("partition 2 of 2 or more"));
    let first = read(old(1).as_bytes())?;
    assert!(first.notes.told[0].to_string().contains("partition 1 of a mesh"), "{:?}", first.notes.told);
    Ok(())
}

#[test]
fn names_of_old_programs_are_read() -> Result<(), String> {
    for (from, to) in [
        ("2 10 \"plate\"", "10\"plate\""),
        ("2 10 \"plate\"", "-1 10 \"plate\""),
        ("2 10 \"plate\"", "2 10 \"plate\" lower_dimensional_block"),
        ("1 9 \"nothing there\"", "1 0 \"nothing there\""),
        ("1 9 \"nothing there\"", "9 \"nothing there\""),
    ] {
        let mesh = read(SMALL.replace(from, to).as_bytes())?;
        let plates: Vec<_> = mesh.groups.iter().filter(|group| group.name == "plate").collect();
        assert_eq!(plates.iter().map(|group| (group.dimension, group.tag)).collect::<Vec<_>>(), [(2, 10)], "{to}");
        assert_eq!(mesh.groups.iter().any(|group| group.name == "nothing there"), from.contains("plate"), "{to}");
    }
    Ok(())
}

/// gmsh writes the box of an entity without points so.
#[test]
fn an_empty_box_is_passed_over() -> Result<(), String> {
    let (most, least) = ("1.797693134862316e+308", "-1.797693134862316e+308");
    let empty = format!("1 {most} {most} {most} {least} {least} {least} 2 -1 5 2 1 -2");
    let mesh = read(SMALL.replace("1 0 0 0 0 1 0 2 -1 5 2 1 -2", &empty).as_bytes())?;
    assert_eq!(groups(&mesh), groups(&read(SMALL.as_bytes())?));
    Ok(())
}

/// MSH 2 with parameters behind the coordinates, in three spellings of its version.
#[test]
fn msh_2_with_parameters_is_read() -> Result<(), String> {
    let file = |version: &str| {
        format!(
            "$MeshFormat\n{version} 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n10 \"plate\"\n$EndPhysicalNames\n\
             $ParametricNodes\n4\n1 0 0 0 0 1\n2 1 0 0 1 1 0.5\n3 1 1 0 2 1 0.5 0.5\n4 0 1 0 2 1 0.5 0.5\n\
             $EndParametricNodes\n$Elements\n1\n1 3 2 10 1 1 2 3 4\n$EndElements\n"
        )
    };
    for (text, version) in
        [("2", MshVersion::V20), ("2.0", MshVersion::V20), ("2.1", MshVersion::V21), ("2.200000", MshVersion::V22)]
    {
        let mesh = read(file(text).as_bytes())?;
        assert_eq!(mesh.format.version, version);
        assert_eq!(groups(&mesh), [("plate", 2, vec![1, 2, 3, 4])]);
    }
    Ok(())
}
